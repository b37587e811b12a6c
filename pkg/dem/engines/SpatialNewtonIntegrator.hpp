// YADE's integrator, faster for single bodies in space: the same positions, velocities and rotations, bit by bit.
#pragma once

#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

class SpatialNewtonIntegrator : public NewtonIntegrator {
public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(SpatialNewtonIntegrator,NewtonIntegrator,
R"""(:yref:`NewtonIntegrator` for spheres and walls in space, which asks for bodies before it needs them and is about twice as fast. No clumps
and no aspherical bodies that are free to turn. With damping, periodic boundaries, density scaling, a mask or O.trackEnergy it is the plain integrator.)""");
	// clang-format on
};
REGISTER_SERIALIZABLE(SpatialNewtonIntegrator);

} // namespace yade
