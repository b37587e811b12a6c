// YADE's collider for disks in the plane: a grid in the place of sorted bounds.
//
// Fast disks leave the boxes of a sorting collider after one or two steps, and every sort then goes through all boxes,
// all interactions, and all pairs whose boxes have crossed. Here pairs that can meet before disks near each other have
// moved by a margin against each other are looked up in a grid, and from then on only their distances are followed;
// O.interactions gets a pair when it comes within reach and loses it when it has left, so that it holds contacts and no
// candidates. Which contacts there are is the same, to the last bit, as with a sorting collider and the same reach.
//
// The reach has to be what the fastest disks may go in a step, which most never do. With `sureReach` a pair beyond that
// has an interaction only while one of the two is as fast against a disk near it as the gap asks for: for itself, and
// for the speed that it may be given within the step.
//
// When pairs are looked up anew. With c the factor of the sure reach, D_s the largest difference of velocities in
// square s and the eight around it (Regions), and D'_s the largest D of these nine, the margin of disks in s is a_s =
// verletDist + h (ahead D_s + foresight D'_s), and pairs are noted whose distance is below c (r_i + r_j) + min(a_s(i),
// a_s(j)). With S_s the largest difference of paths since then, a pair that was not noted is now at least c (r_i + r_j)
// + a_s - S_s apart, and it is not wanted before that is less than c (r_i + r_j) + foresight h D'_s, with today's h and
// D': so the list holds while S_s + foresight h D'_s <= a_s in all squares. Squares are wide enough that disks which
// meet have been in neighbouring ones until a disk has gone `farPath`.
#pragma once

#include <neighbours/disk_grid.hpp>
#include <neighbours/regions.hpp>
#include <pkg/common/Collider.hpp>

namespace yade {

namespace nscd {
	class Resident;
}

class PlanarGridCollider : public Collider {
public:
	void               action() override;
	vector<Body::id_t> probeBoundingVolume(const Bound& bound) override;
	void               invalidatePersistentData() override { reference.clear(); }
	/// For InteractionContainer::conditionalyEraseNonReal: none that is not real is kept.
	bool shouldBeErased(Body::id_t, Body::id_t, Scene*) const { return true; }
	/// Whether it ran in step `iteration`.
	bool hasRun(long iteration) const { return iteration == ranIn; }
	/// Whether two disks that far apart [m], within the reach, should have an interaction in this step.
	bool wants(Body::id_t a, Body::id_t b, Real distance) const
	{
		if (size_t(std::max(a, b)) >= fastest.size()) return true; // a body that came after it ran
		return distance <= wantedWithin(a, b, std::max(fastest[a], fastest[b]));
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PlanarGridCollider,Collider,
R"""(Collider for disks (:yref:`spheres<Sphere>` in the x-y plane) of any sizes, with bodies of other shapes among them: the place and the list of functors of an
:yref:`InsertionSortCollider`, several times faster where disks move fast. :yref:`Bo1_Sphere_Aabb.aabbEnlargeFactor` of its list is the distance,
in sums of radii, within which two disks have an interaction: give it the value of :yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`. A pair of disks is in
O.interactions while it is within that reach, or as long as its contact lives (behind :yref:`NscdInteractionLoop` from the first look on); potential interactions exist only with bodies that are no spheres, near their
bounding boxes. Disks get no :yref:`Body.bound`. Pairs of bodies that are no spheres are not looked for. Periodic scenes are refused.)""",
		((Real,verletDist,-0.7,,"Margin [m] by which pairs are looked up beyond their reach and what they may go in a few steps; "
		        "negative: in smallest radii. It changes the speed alone: more pairs to follow against fewer "
		        "searches."))
		((Real,sureReach,std::numeric_limits<Real>::max(),,"Gap [ℓ] up to which disks always have an interaction; beyond it, within the reach, only while one of "
		        "them is so fast against a disk near it that it may come as near in two steps. Not below "
		        "bondCreationDistance and :yref:`ContactDynamicsEngine.openGap`. By default all within the reach have "
		        "one."))
		((long,searches,0,(Attr::readonly|Attr::noSave),"Number of searches so far."))
		((int,candidates,0,(Attr::readonly|Attr::noSave),"Pairs whose distance is followed."))
	);
	// clang-format on
private:
	/// How far, in radii, a box reaches around a disk that it can touch: Ig2 functors know contacts with a wall up
	/// to (factor − 1) times the diameter.
	static Real reachAround(Real factor) { return 2 * factor - 1; }
	using Box = nonsmooth::neighbours::Box;
	/// A body that is no sphere, and where its box was when pairs were looked up.
	struct Side {
		Body::id_t             id;
		Box                    box, reference;
		boost::weak_ptr<Shape> shape; // that its contacts were made for
	};
	struct SidePair {
		int  side; // place in `sides`
		int  disk;
		bool known;
	};
	/// Distance [m] up to which two disks are wanted that may come nearer at that speed [m/s].
	Real wantedWithin(Body::id_t a, Body::id_t b, Real speed) const
	{
		return (1 + sureReach) * (disks[a].r + disks[b].r) + foresight * scene->dt * speed;
	}
	/// Whether a body is a disk now and was none when pairs were looked up, or the other way round.
	bool hasTurned(size_t id) const { return id < reference.size() && (disks[id].r < 0) != (reference[id].r < 0); }
	void validate() const;
	bool changed();
	bool renewShapes(bool turned);
	void listSides();
	void boundSides();
	void forget();
	void eraseUnreal();
	bool moved();
	Real listed() const { return std::min(factor, 1 + sureReach); }
	void search();
	void searchSides();
	void boundSpeeds();
	void findNear();
	bool isWanted(int i, int place) const;
	void takeDisks();
	void takeSides();
	void insert(Body::id_t a, Body::id_t b);
	void eraseIfUnreal(Body::id_t a, Body::id_t b);
	void unnote(Body::id_t a, Body::id_t b);
	bool mayBeBare(Body::id_t a, Body::id_t b) const;
	SidePair* sidePairOf(Body::id_t a, Body::id_t b);

	static constexpr Real foresight = 2; // steps in which a pair beyond the sure reach may come to be within it
	static constexpr Real ahead     = 12; // steps for which pairs are looked up, as fast as they are then

	int  threads = 1;
	long sizeLeft
	        = 0; // of O.interactions at the end of the last run, without those that were made for the arrays' contacts
	Real            factor            = 1; // reach of disks in sums of radii
	Real            verletDistOfLists = 0, sureReachOfLists = -1; // attributes as they were when they were made
	nscd::Resident* resident                       = nullptr; // during a turn
	static constexpr long                    never = std::numeric_limits<long>::min();
	long                                     ranIn = never; // step
	std::vector<nonsmooth::neighbours::Disk> disks,
	        reference; // by body, now and when pairs were looked up; none where that must be done anew
	nonsmooth::neighbours::DiskGrid grid;
	nonsmooth::neighbours::Pairs    pairs, before;
	std::vector<char>               known, knownBefore; // by pair: it is in O.interactions, or may not be
	std::vector<Real>               fastest; // by body: largest speed of a disk against those near it [m/s]
	std::vector<std::vector<Real>>  fastestOf; // the same of the pairs of each thread
	std::vector<nonsmooth::neighbours::Vector> velocities, paths; // by body, paths since pairs were looked up
	nonsmooth::neighbours::Regions             regions;
	std::vector<Real>                          rates, widestRates, spreads, allowances; // D, D', S, a by region
	Real                                       farPath = 0; // of a disk or a box, in any direction
	std::vector<Side>                          sides;
	std::vector<SidePair>                      sidePairs; // by side, then disk
	std::vector<std::vector<std::pair<int, int>>>
	        near; // by thread: wanted pairs that O.interactions has not, the lower body and the place of the pair
};
REGISTER_SERIALIZABLE(PlanarGridCollider);

} // namespace yade
