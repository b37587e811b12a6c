// What YADE's integrator does to one body that moves in space, bit by bit; and what the plugin's integrators
// (PlanarNewtonIntegrator, SpatialNewtonIntegrator) have in common.
#pragma once

#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade::nscd {

/// Velocity and place at the end of a step, as NewtonIntegrator without damping has them.
inline void integrate(State& s, const Vector3r& force, const Vector3r& torque, const Vector3r& gravity, Real dt)
{
	if (s.blockedDOFs != State::DOF_ALL) {
		Vector3r a = Vector3r::Zero(), w = Vector3r::Zero();
		for (int i = 0; i < 3; ++i) {
			if (!(s.blockedDOFs & State::axisDOF(i, false))) a[i] += force[i] / s.mass + gravity[i];
			if (!(s.blockedDOFs & State::axisDOF(i, true))) w[i] += torque[i] / s.inertia[i];
		}
		s.vel += dt * a;
		s.angVel += dt * w;
	}
	s.pos += s.vel * dt;
	const Real square = s.angVel.squaredNorm();
	if (square != 0) {
		const Real speed = std::sqrt(square);
		s.ori            = Quaternionr(AngleAxisr(speed * dt, s.angVel / speed)) * s.ori;
	}
	s.ori.normalize();
}

/// Whether an integrator is asked for more than that, which YADE's own has.
bool isMoreThanLeapfrog(const NewtonIntegrator& newton);

/// Adds up O.forces, and warns where nobody has reset them.
void syncForces(const NewtonIntegrator& newton);

/// Throws std::runtime_error for the body of that id, which was not moved; none is at −1.
void refuseUnmoved(const NewtonIntegrator& newton, int id);

/// What NewtonIntegrator.maxVelocitySq tells the collider of a body: 2 where it has left its bounding box's margin, 0.5
/// where it has not.
inline Real movedOutOf(const Bound& bound, const Vector3r& place)
{
	const Real farthest = (place - bound.refPos).cwiseAbs().maxCoeff();
	return farthest == 0 || farthest < bound.sweepLength ? 0.5 : 2.0;
}

} // namespace yade::nscd
