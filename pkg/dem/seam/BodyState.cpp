#include "BodyState.hpp"
#include "PlaneMotion.hpp"
#include "Prefetch.hpp"
#include <algorithm>
#include <pkg/common/Sphere.hpp>

namespace yade::nscd {

BodyState readBody(const Body* body)
{
	BodyState r {};
	r.radius  = -1;
	r.present = body;
	if (!body || !body->state) return r;
	const State& s = *body->state;
	r.clumped      = body->isClump() || body->isClumpMember();
	if (const Shape* shape = body->shape.get()) {
		const bool exactly = typeid(*shape) == typeid(Sphere);
		if (exactly || dynamic_cast<const Sphere*>(shape)) r.radius = static_cast<const Sphere*>(shape)->radius;
		r.plain = exactly && !body->isClump();
	}
	readMotion(s, r);
	r.mass       = s.mass;
	r.inertia    = s.inertia[2];
	r.blocked    = s.blockedDOFs;
	r.planar     = staysInPlane(s);
	r.aspherical = body->isAspherical() && !(s.blockedDOFs & State::DOF_RXRYRZ);
	r.bounded    = (bool)body->bound;
	return r;
}

std::vector<FormerSize> readBodies(Scene& scene, int threads, std::vector<BodyState>& states)
{
	const auto& bodies = *scene.bodies;
	const long  count  = (long)bodies.size();
	states.resize(count);
	long                    stateless = -1; // reported after the loop, which must not throw
	std::vector<FormerSize> changed;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : stateless)
	for (long id = 0; id < count; ++id) {
		if (id + (long)later < count) fetch<sizeof(Body)>(bodies[id + later].get());
		if (id + (long)soon < count && bodies[id + soon]) {
			fetch<sizeof(State)>(bodies[id + soon]->state.get());
			fetch<sizeof(Sphere)>(bodies[id + soon]->shape.get());
		}
		const auto& body = bodies[id];
		if (body && !body->state) stateless = std::max(stateless, id);
		const FormerSize former { int(id), states[id].radius, states[id].mass, states[id].inertia };
		const bool       was = states[id].present;
		states[id]           = readBody(body.get());
		if (was && states[id].present && states[id].radius != former.radius)
#pragma omp critical
			changed.push_back(former);
	}
	std::sort(changed.begin(), changed.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
	if (stateless >= 0)
		throw std::runtime_error(
		        "body #" + std::to_string(stateless) + " has no state: set Body.state = State(...)");
	return changed;
}

void readMotion(const State& state, BodyState& result)
{
	result.motion = motionOf(state);
	result.z      = state.pos[2];
}

} // namespace yade::nscd
