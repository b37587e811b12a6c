// YADE's integrator, faster for single bodies in the plane: the same positions, velocities and rotations, bit by bit.
#pragma once

#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

class PlanarNewtonIntegrator : public NewtonIntegrator {
public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(PlanarNewtonIntegrator,NewtonIntegrator,
R"""(:yref:`NewtonIntegrator` for disks and walls, which asks for bodies before it needs them and is about twice as fast. No clumps and no aspherical
bodies. With damping, periodic boundaries, density scaling, a mask or O.trackEnergy it is the plain integrator.)""");
	// clang-format on
};
REGISTER_SERIALIZABLE(PlanarNewtonIntegrator);

} // namespace yade
