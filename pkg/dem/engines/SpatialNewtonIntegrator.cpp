#include "SpatialNewtonIntegrator.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/EngineRoles.hpp"
#include "../seam/Prefetch.hpp"
#include "../seam/StageClock.hpp"
#include "Leapfrog.hpp"
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((SpatialNewtonIntegrator));
[[maybe_unused]] static const bool spatialNewtonIntegratorRole = nscd::giveRole(
        typeid(SpatialNewtonIntegrator), nscd::EngineRole::MovesBodies);

void SpatialNewtonIntegrator::action()
{
	using nscd::fetch, nscd::soon, nscd::later;
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Integrate);
	if (nscd::isMoreThanLeapfrog(*this)) {
		NewtonIntegrator::action();
		return;
	}
	nscd::syncForces(*this);
	const auto& bodies  = *scene->bodies;
	const long  count   = (long)bodies.size();
	const int   threads = nscd::threadsOf(*this);
	int         bad     = -1;
	Real        moved   = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : bad, moved)
	for (long id = 0; id < count; ++id) {
		if (id + (long)later < count) fetch<sizeof(Body)>(bodies[id + later].get());
		if (id + (long)soon < count && bodies[id + soon]) {
			fetch<sizeof(State)>(bodies[id + soon]->state.get());
			fetch<sizeof(Bound)>(bodies[id + soon]->bound.get());
		}
		const auto& b = bodies[id];
		if (!b || !b->state) continue;
		State& s = *b->state;
		if (b->isClump() || b->isClumpMember()
		    || (exactAsphericalRot && b->isAspherical() && !(s.blockedDOFs & State::DOF_RXRYRZ))) {
			bad = std::max(bad, (int)id);
			continue;
		}
		nscd::integrate(s, scene->forces.getForce(id), scene->forces.getTorque(id), gravity, scene->dt);
		if (b->bound) moved = std::max(moved, nscd::movedOutOf(*b->bound, s.pos));
	}
	nscd::refuseUnmoved(*this, bad);
	maxVelocitySq = moved;
}

} // namespace yade
