// YADE's interaction loop, faster for contacts of disks.
//
// Interactions, their geometry, their physics and the states of their bodies lie all over the memory, so the loop of 50,000 of them waits
// for memory most of the time. This one asks for what it will need some interactions ahead, and writes a disk's contact without the
// shear increments that soft laws need. Everything else goes through the functors as ever. Fields that both loops write have the same bits.
// What the solver takes of a contact is read on the way, while it is at hand.
#pragma once

#include "ContactReading.hpp"
#include <core/InteractionLoop.hpp>

namespace yade {

class NscdInteractionLoop : public InteractionLoop {
public:
	void action() override;
	/// Of the scene's interactions in step `iteration`, in the order of their list; null where this loop did not go through them.
	const nscd::Readings* readingsOf(long iteration) const { return iteration == readIn ? &readings : nullptr; }
	// clang-format off
	YADE_CLASS_BASE_DOC(NscdInteractionLoop,InteractionLoop,
R"""(:yref:`InteractionLoop` for simulations of :yref:`ContactDynamicsEngine`: the same lists of functors, the same results, about twice
as fast. Contacts of two :yref:`spheres<Sphere>` with :yref:`NscdPhys` are kept up to date without their functor: position, normal and overlap are those
of :yref:`Ig2_Sphere_Sphere_ScGeom`; ``shearInc`` and the axes of rotation, which rigid contacts have no use for, stay as they were when the
contact began. With periodic boundaries, callbacks or sorted interactions it is the plain loop.)""");
	// clang-format on
private:
	struct Place {
		Vector3r    pos;
		Quaternionr ori;
		Real        radius; // negative where the body is not a sphere
	};
	void               gatherPlaces(int threads);
	std::vector<Place> places; // by id
	nscd::Readings     readings;
	long               readIn = -1; // step
};
REGISTER_SERIALIZABLE(NscdInteractionLoop);

} // namespace yade
