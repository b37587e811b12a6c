// YADE's interaction loop, faster for contacts of disks.
//
// Interactions, their geometry, their physics and the states of their bodies lie all over the memory, so the loop of 50,000 of them waits
// for memory most of the time. This one asks for what it will need some interactions ahead, and writes a disk's contact without the
// shear increments that soft laws need: these are zero. Everything else goes through the functors as ever. All other fields have the bits of YADE's loop.
// What the solver takes of a contact is read on the way, while it is at hand.
#pragma once

#include "BodyReading.hpp"
#include "ContactReading.hpp"
#include <core/InteractionLoop.hpp>

namespace yade {

class PlanarGridCollider;

class NscdInteractionLoop : public InteractionLoop {
public:
	void action() override;
	/// The loop of the engine's scene whose readings hold for `engine` in this step: null where an engine that may have changed bodies or contacts stands
	/// between the two, or where a script may have.
	static const NscdInteractionLoop* before(const Engine& engine);
	/// The loop that visited every interaction in the step before this one; null where another may have been at work.
	static const NscdInteractionLoop* ofLastStep(const Scene& scene);
	/// Whether this loop went through the interactions of step `iteration`, and so has readings of them, in the order of their list, and of the bodies.
	bool                                  hasRead(long iteration) const { return iteration == readIn; }
	const nscd::Readings&                 contactReadings() const { return readings; }
	const std::vector<nscd::BodyReading>& bodyReadings() const { return *bodies; }
	/// Pairs of bodies whose interactions were not real after that step, in the order of the list.
	const std::vector<std::pair<Body::id_t, Body::id_t>>& unrealPairs() const { return unreal; }
	// clang-format off
	YADE_CLASS_BASE_DOC(NscdInteractionLoop,InteractionLoop,
R"""(:yref:`InteractionLoop` for simulations of :yref:`ContactDynamicsEngine`: the same lists of functors, the same results, about twice
as fast. Contacts of two :yref:`spheres<Sphere>` with :yref:`NscdPhys` are kept up to date without their functor: position, normal and overlap are those
of :yref:`Ig2_Sphere_Sphere_ScGeom`; ``shearInc`` and the axes of rotation, which rigid contacts have no use for, are zero. :yref:`ContactDynamicsEngine`
takes from it what it has read of bodies and contacts, and spares itself the way, unless an engine other than
:yref:`PorePressureEngine` stands between the two and may have changed them: engines that only add forces are better put before this one. With periodic
boundaries, callbacks or sorted interactions it is the plain loop.)""");
	// clang-format on
private:
	const PlanarGridCollider* colliderBefore() const;

	const std::vector<nscd::BodyReading>*          bodies = nullptr; // own, or those of the collider
	std::vector<nscd::BodyReading>                 ownBodies;
	nscd::Readings                                 readings;
	std::vector<std::pair<Body::id_t, Body::id_t>> unreal;
	static constexpr long                          never  = std::numeric_limits<long>::min();
	long                                           readIn = never; // step
};
REGISTER_SERIALIZABLE(NscdInteractionLoop);

} // namespace yade
