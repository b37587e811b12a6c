#include "PlanarNewtonIntegrator.hpp"
#include "../seam/EngineRoles.hpp"
#include "Leapfrog.hpp"
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
}

void PlanarNewtonIntegrator::action()
{
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Integrate);
	const int              threads = nscd::threadsOf(*this);
	nscd::Turn             turn(*this, threads);
	nscd::Resident&        resident = turn.resident();
	if (nscd::isMoreThanLeapfrog(*this)) {
		resident.show();
		NewtonIntegrator::action();
		turn.end();
		return;
	}
	nscd::syncForces(*this);
	auto&      bodies = resident.bodies;
	const long count  = (long)bodies.size();
	int        bad    = -1;
	Real       moved  = 0;
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
			nscd::integrate(s, force, torque, gravity, scene->dt);
			nscd::readMotion(s, b);
		}
		if (!b.bounded) continue;
		moved = std::max(moved, nscd::movedOutOf(*(*scene->bodies)[id]->bound, b.place()));
	}
	nscd::refuseUnmoved(*this, bad);
	maxVelocitySq = moved;
	turn.end();
}

} // namespace yade
