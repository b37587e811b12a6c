// YADE's interaction loop, faster for contacts of disks.
//
// Interactions, their geometry, their physics and the states of their bodies lie all over the memory, so the loop of
// 50,000 of them waits for memory most of the time. This one keeps contacts of disks in arrays (seam/Resident.hpp),
// without the shear increments that soft laws need, which are zero; their interactions follow when somebody looks. So
// it keeps contacts of spheres that move in space (space/SpaceContacts.hpp).
// Everything else goes through the functors as ever. All other fields have the bits of YADE's loop.
#pragma once

#include "../seam/Resident.hpp"
#include <core/InteractionLoop.hpp>

namespace yade {

namespace nscd {
	class SpaceContacts;
	struct SpaceContactState;
}
class Law2_ScGeom_NscdPhys_SignoriniCoulomb;
class Ig2_Arc_Sphere_ScGeom;
class Ig2_Segment_Sphere_ScGeom;
class Ig2_Sphere_Sphere_ScGeom;
class PlanarGridCollider;

class NscdInteractionLoop : public InteractionLoop {
public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(NscdInteractionLoop,InteractionLoop,
R"""(:yref:`InteractionLoop` for simulations of :yref:`ContactDynamicsEngine`: the same lists of functors, the same results, about twice
as fast. Contacts of two :yref:`spheres<Sphere>` with :yref:`NscdPhys` are kept up to date without their functor: position, normal and overlap are those
of :yref:`Ig2_Sphere_Sphere_ScGeom`; ``shearInc`` and the axes of rotation, which rigid contacts have no use for, are zero. Such a contact gets its interaction
when somebody looks, see :yref:`ContactDynamicsEngine.advance`, and until then has all that its functors would have given it. In space such
a contact has an interaction, which follows when somebody looks while there is no bond. With periodic boundaries, callbacks, sorted interactions or a LawTester it is the
plain loop.)""");
	// clang-format on
private:
	/// The functors that contacts, or disks out of their reach, may do without, each null where there is none; and
	/// the collider whose reach holds.
	struct Ours {
		const Ig2_Sphere_Sphere_ScGeom*              spheres;
		const Ig2_Segment_Sphere_ScGeom*             segments;
		const Ig2_Arc_Sphere_ScGeom*                 arcs;
		const Law2_ScGeom_NscdPhys_SignoriniCoulomb* law;
		const PlanarGridCollider*                    collider;
	};
	const PlanarGridCollider* colliderBefore() const;
	/// What becomes of a contact in a step: it may be forgotten, or need an interaction first, which it does not
	/// have.
	enum class Next { Stays, Gone, Unmade };

	Next follow(nscd::Resident& resident, int slot, const Ours& ours) const;
	void takeProposed(nscd::Resident& resident, const Ours& ours, int threads);
	bool prepare(nscd::Resident& resident, const nscd::Resident::Pair& pair, const Ours& ours);
	void visitOthers(nscd::Resident& resident, const std::vector<int>& others, const Ours& ours, int threads);
	bool visit(const shared_ptr<Interaction>& interaction);
	bool
	     visit(const shared_ptr<Interaction>& interaction, const std::vector<nscd::BodyState>& bodies,
	           std::string& error);
	bool areOutOfReach(const Interaction& interaction, const std::vector<nscd::BodyState>& bodies) const;
	bool isOfSpheres(const Interaction& interaction, const std::vector<nscd::BodyState>& bodies) const;
	void actInSpace(nscd::Resident& resident, int threads);
	void visitAll(const nscd::Resident& resident, int threads);
	bool followKept(nscd::SpaceContacts& contacts, const nscd::Resident& resident, int threads);
	bool follow(nscd::SpaceContactState& contact, const std::vector<nscd::BodyState>& bodies) const;
	void keep(nscd::SpaceContactState& contact, const std::vector<nscd::BodyState>& bodies) const;
	void keepAll(nscd::SpaceContacts& contacts, const nscd::Resident& resident, int threads) const;

	void keepFunctors();

	Ours ours {}; // of the last turn
	std::vector<shared_ptr<Functor>>
	        used; // contacts and shapes keep theirs, and may be the last to do so where Python's lock is not held
};
REGISTER_SERIALIZABLE(NscdInteractionLoop);

} // namespace yade
