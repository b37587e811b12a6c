#include "PlanarNewtonIntegrator.hpp"
#include "../seam/EngineRoles.hpp"
#include "../seam/StageClock.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((PlanarNewtonIntegrator));
[[maybe_unused]] static const bool planarNewtonIntegratorRole = nscd::giveRole(
        typeid(PlanarNewtonIntegrator), nscd::EngineRole::TakesTurns);

namespace {
	namespace plane = nonsmooth::contact::plane;
	static_assert(
	        plane::blockedX == State::DOF_X && plane::blockedY == State::DOF_Y
	        && plane::blockedTurn == State::DOF_RZ && plane::blockedAll == State::DOF_ALL);

	/// Velocity and place at the end of a step, as NewtonIntegrator without damping has them, of a body that moves
	/// in space.
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
	const int              threads = nscd::threadsOf(*this);
	nscd::Turn             turn(*this, threads);
	nscd::Resident&        resident = turn.resident();
	const Cell&            cell     = *scene->cell;
	if (damping != 0 || scene->isPeriodic || densityScaling || mask > 0 || scene->trackEnergy || cell.velGradChanged
	    || cell.nextVelGrad != Matrix3r::Zero()) {
		resident.show();
		NewtonIntegrator::action();
		turn.end();
		return;
	}
	scene->forces.sync();
	if (warnNoForceReset && scene->forces.lastReset < scene->iter)
		LOG_WARN(
		        "O.forces were last reset in step " << scene->forces.lastReset
		                                            << ": put ForceResetter() first in O.engines.");
	auto&      bodies = resident.bodies;
	const long count  = (long)bodies.size();
	int        bad    = -1;
	Real       moved
	        = 0; // 2 where a body has left its bounding box's margin, 0.5 where it has not: what the collider asks for
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : bad, moved)
	for (long id = 0; id < count; ++id) {
		nscd::BodyState& b = bodies[id];
		if (!b.present) continue;
		if (b.clumped || b.aspherical) {
			bad = std::max(bad, (int)id);
			continue;
		}
		const Vector3r &force = scene->forces.getForce(id), &torque = scene->forces.getTorque(id);
		if (b.planar) {
			plane::integrate(
			        b.motion, { force[0], force[1], torque[2] }, b.mass, b.inertia, b.blocked,
			        { gravity[0], gravity[1] }, scene->dt);
			b.moved = true;
		} else { // with motions that the arrays do not know
			State& s = *(*scene->bodies)[id]->state;
			integrate(s, force, torque, gravity, scene->dt);
			nscd::readMotion(s, b);
		}
		if (!b.bounded) continue;
		const Bound& bound    = *(*scene->bodies)[id]->bound;
		const Real   farthest = (b.place() - bound.refPos).cwiseAbs().maxCoeff();
		moved                 = std::max(moved, farthest == 0 || farthest < bound.sweepLength ? 0.5 : 2.0);
	}
	if (bad >= 0)
		throw std::runtime_error(
		        "PlanarNewtonIntegrator: body #" + std::to_string(bad)
		        + " is aspherical or belongs to a clump: use single spheres, or NewtonIntegrator");
	maxVelocitySq = moved;
	turn.end();
}

} // namespace yade
