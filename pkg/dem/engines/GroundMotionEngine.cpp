#include "GroundMotionEngine.hpp"
#include "../seam/EngineRoles.hpp"
#include "ListChecks.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((GroundMotionEngine));
[[maybe_unused]] static const bool groundMotionEngineRole = nscd::giveRole(
        typeid(GroundMotionEngine), nscd::EngineRole::TakesTurns);

namespace {
	[[noreturn]] void refuseMotion(const string& why) { throw std::invalid_argument("GroundMotionEngine: " + why); }
}

void GroundMotionEngine::validate() const
{
	for (const auto& [name, values] :
	     { std::pair("times", &times), std::pair("horizontal", &horizontal), std::pair("vertical", &vertical) })
		nscd::requireNumbers("GroundMotionEngine", name, *values);
	for (const auto& [name, values] : { std::pair("horizontal", &horizontal), std::pair("vertical", &vertical) })
		if (!values->empty() && values->size() != times.size())
			refuseMotion(
			        string(name) + " has " + std::to_string(values->size()) + " entries and times "
			        + std::to_string(times.size()) + ": give an acceleration for each time, or none");
	nscd::requireRising("GroundMotionEngine", times, true);
}

const nscd::AccelerationRecord& GroundMotionEngine::record()
{
	for (const auto& [name, value] : { std::pair("begin", begin), std::pair("scale", scale) })
		nscd::require(nscd::isNumber(value), "GroundMotionEngine", name, value, "finite");
	if (!isMade) {
		validate();
		made   = { times, horizontal, vertical };
		isMade = true;
	}
	return made;
}

Vector3r GroundMotionEngine::of(Pair (nscd::AccelerationRecord::*what)(double) const, Real time)
{
	return scaled((record().*what)(time - begin));
}

void GroundMotionEngine::action()
{
	nscd::Turn turn(
	        *this,
	        nscd::threadsOf(*this)); // first: a refusal shows what the engines before have left in the arrays
	const Real now = scene->time - begin, next = now + scene->dt;
	acceleration = scaled(record().mean(now, next));
	velocity     = scaled(made.velocity(next));
	displacement = scaled(made.displacement(next));
	totalForce   = Vector3r::Zero();

	auto& bodies = turn.resident().bodies;
	for (const Body::id_t id : ids) {
		if (id < 0 || id >= (Body::id_t)bodies.size() || !bodies[id].present)
			refuseMotion("ids has " + std::to_string(id) + ": there is no such body");
		auto& b = bodies[id];
		if ((b.blocked & nscd::inPlane) != nscd::inPlane)
			refuseMotion(
			        "ids has " + std::to_string(id)
			        + ": that body is free to move; give walls, and others whose motion in the plane is blocked");
		b.motion.velocity.x = velocity[0];
		b.motion.velocity.y = velocity[1];
		b.moved             = true;
		if (!b.planar) (*scene->bodies)[id]->state->vel = velocity;
	}
	if (ids.empty() && acceleration != Vector3r::Zero())
		for (size_t id = 0; id < bodies.size(); ++id) {
			const auto& b = bodies[id];
			if (!b.present || b.blocked == State::DOF_ALL
			    || (b.clumped && (*scene->bodies)[id]->isClumpMember()))
				continue;
			const Vector3r force = -b.mass * acceleration;
			scene->forces.addForce(id, force);
			totalForce += force;
		}
	turn.end();
}

} // namespace yade
