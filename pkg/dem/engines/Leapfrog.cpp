#include "Leapfrog.hpp"

namespace yade::nscd {

CREATE_CPP_LOCAL_LOGGER("Leapfrog.cpp");

bool isMoreThanLeapfrog(const NewtonIntegrator& newton)
{
	const Scene& scene = *newton.scene;
	const Cell&  cell  = *scene.cell;
	return newton.damping != 0 || scene.isPeriodic || newton.densityScaling || newton.mask > 0 || scene.trackEnergy
	        || cell.velGradChanged || cell.nextVelGrad != Matrix3r::Zero();
}

void syncForces(const NewtonIntegrator& newton)
{
	Scene& scene = *newton.scene;
	scene.forces.sync();
	if (newton.warnNoForceReset && scene.forces.lastReset < scene.iter)
		LOG_WARN(
		        "O.forces were last reset in step " << scene.forces.lastReset
		                                            << ": put ForceResetter() first in O.engines.");
}

void refuseUnmoved(const NewtonIntegrator& newton, int id)
{
	if (id < 0) return;
	throw std::runtime_error(
	        newton.getClassName() + ": body #" + std::to_string(id)
	        + " is aspherical or belongs to a clump: use single spheres, or NewtonIntegrator");
}

} // namespace yade::nscd
