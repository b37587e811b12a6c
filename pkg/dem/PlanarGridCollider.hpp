// YADE's collider for disks in the plane: a grid in the place of sorted bounds.
//
// Fast disks leave the boxes of a sorting collider after one or two steps, and every sort then goes through all boxes, all interactions, and all pairs whose
// boxes have crossed. Here pairs that can meet before anything has moved by half of a margin are looked up in a grid, and from then on only
// their distances are followed; O.interactions gets a pair when it comes within reach and loses it when it has left, so that it holds contacts and
// no candidates. Which contacts there are is the same, to the last bit, as with a sorting collider and the same reach.
#pragma once

#include "BodyReading.hpp"
#include <neighbours/disk_grid.hpp>
#include <pkg/common/Collider.hpp>

namespace yade {

class NscdInteractionLoop;

class PlanarGridCollider : public Collider {
public:
	void               action() override;
	vector<Body::id_t> probeBoundingVolume(const Bound& bound) override;
	void               invalidatePersistentData() override { begun = false; }
	/// For InteractionContainer::conditionalyEraseNonReal: none that is not real is kept.
	bool shouldBeErased(Body::id_t, Body::id_t, Scene*) const { return true; }
	/// Whether the bodies were read in step `iteration`.
	bool                                  hasRead(long iteration) const { return iteration == readIn; }
	const std::vector<nscd::BodyReading>& bodyReadings() const { return bodies; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PlanarGridCollider,Collider,
R"""(Collider for disks (:yref:`spheres<Sphere>` in the x-y plane) of any sizes, with bodies of other shapes among them: the place and the list of functors of an
:yref:`InsertionSortCollider`, several times faster where disks move fast. :yref:`Bo1_Sphere_Aabb.aabbEnlargeFactor` of its list is the distance,
in sums of radii, within which two disks have an interaction: give it the value of :yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`. A pair of disks is in
O.interactions while it is within that reach, or as long as its contact lives; potential interactions exist only with bodies that are no spheres, near their
bounding boxes. Disks get no :yref:`Body.bound`. Pairs of bodies that are no spheres are not looked for. Periodic scenes are refused.)""",
		((Real,verletDist,-0.7,,"Margin [m] by which pairs are looked up beyond their reach; negative: in smallest radii. It changes the speed alone: more pairs to follow against fewer searches."))
		((long,searches,0,(Attr::readonly|Attr::noSave),"Number of searches so far."))
		((int,candidates,0,(Attr::readonly|Attr::noSave),"Pairs whose distance is followed."))
	);
	// clang-format on
private:
	using Box = nonsmooth::neighbours::Box;
	/// A body that is no sphere, and where its box was when pairs were looked up.
	struct Side {
		Body::id_t id;
		Box        box, reference;
	};
	struct SidePair {
		int  side; // place in `sides`
		int  disk;
		bool known;
	};
	bool      changed();
	void      listSides();
	void      boundSides();
	void      forget();
	void      eraseUnreal(const NscdInteractionLoop& loop);
	bool      moved() const;
	void      search();
	void      searchSides();
	void      takeDisks();
	void      takeSides();
	void      insert(Body::id_t a, Body::id_t b);
	void      eraseIfUnreal(Body::id_t a, Body::id_t b);
	SidePair* sidePairOf(Body::id_t a, Body::id_t b);

	int                                       threads = 1;
	bool                                      begun   = false;
	size_t                                    sizeLeft = 0; // of O.interactions at the end of the last run
	Real                                      factor = 1, margin = 0; // reach of disks in sums of radii; of the search beyond it [m]
	Real                                      verletDistOfLists = 0; // the attribute as it was when they were made
	std::vector<nscd::BodyReading>            bodies;
	long                                      readIn = -1; // step
	std::vector<nonsmooth::neighbours::Disk>  disks, reference; // by body, now and when pairs were looked up
	nonsmooth::neighbours::DiskGrid           grid;
	nonsmooth::neighbours::Pairs              pairs, before;
	std::vector<char>                         known, knownBefore; // by pair: it is in O.interactions, or may not be
	std::vector<Side>                         sides;
	std::vector<SidePair>                     sidePairs; // by side, then disk
	std::vector<std::vector<std::pair<int, int>>> near; // by thread: pairs that came within reach, the lower body and the pair
};
REGISTER_SERIALIZABLE(PlanarGridCollider);

} // namespace yade
