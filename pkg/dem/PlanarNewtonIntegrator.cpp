#include "PlanarNewtonIntegrator.hpp"
#include "Prefetch.hpp"
#include "StageClock.hpp"
#include "YadeFeatures.hpp"
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((PlanarNewtonIntegrator));

namespace {
	/// Velocity and place at the end of a step, as NewtonIntegrator without damping has them.
	void integrate(State& s, const Vector3r& force, const Vector3r& torque, const Vector3r& gravity, Real dt)
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
}

void PlanarNewtonIntegrator::action()
{
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Integrate);
	const Cell& cell = *scene->cell;
	if (damping != 0 || scene->isPeriodic || densityScaling || mask > 0 || scene->trackEnergy || cell.velGradChanged || cell.nextVelGrad != Matrix3r::Zero()) {
		NewtonIntegrator::action();
		return;
	}
	scene->forces.sync();
	if (warnNoForceReset && scene->forces.lastReset < scene->iter)
		LOG_WARN("O.forces were last reset in step " << scene->forces.lastReset << ": put ForceResetter() first in O.engines.");
	const auto& bodies = *scene->bodies;
	const long  count  = (long)bodies.size();
	int         bad    = -1;
	Real        moved  = 0; // 2 where a body has left its bounding box's margin, 0.5 where it has not: what the collider asks for
#pragma omp parallel for schedule(static) num_threads(nscd::threadsOf(*this)) reduction(max : bad, moved)
	for (long id = 0; id < count; ++id) {
		if (id + (long)nscd::later < count) nscd::fetch<sizeof(Body)>(bodies[id + nscd::later].get());
		if (id + (long)nscd::soon < count && bodies[id + nscd::soon]) {
			nscd::fetch<sizeof(State)>(bodies[id + nscd::soon]->state.get());
			nscd::fetch<sizeof(Bound)>(bodies[id + nscd::soon]->bound.get());
		}
		const auto& body = bodies[id];
		if (!body) continue;
		State& s = *body->state;
		if (body->isClump() || body->isClumpMember() || (body->isAspherical() && !(s.blockedDOFs & State::DOF_RXRYRZ))) {
			bad = std::max(bad, (int)id);
			continue;
		}
		integrate(s, scene->forces.getForce(id), scene->forces.getTorque(id), gravity, scene->dt);
		if (!body->bound) continue;
		const Real farthest = (s.pos - body->bound->refPos).cwiseAbs().maxCoeff();
		moved               = std::max(moved, farthest == 0 || farthest < body->bound->sweepLength ? 0.5 : 2.0);
	}
	if (bad >= 0)
		throw std::runtime_error(
		        "PlanarNewtonIntegrator: body #" + std::to_string(bad) + " is aspherical or belongs to a clump: use single spheres, or NewtonIntegrator");
	maxVelocitySq = moved;
}

} // namespace yade
