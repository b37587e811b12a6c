#include "PlateLoadEngine.hpp"
#include "../seam/EngineRoles.hpp"
#include "Gravity.hpp"
#include "../materials/NscdPhys.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include "../walls/Segment.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <boost/make_shared.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Wall.hpp>

namespace yade {

YADE_PLUGIN((PlateLoadEngine));
[[maybe_unused]] static const bool plateLoadEngineRole = nscd::giveRole(
        typeid(PlateLoadEngine), nscd::EngineRole::TakesTurns);

namespace {
	[[noreturn]] void refusePlate(const string& why) { throw std::runtime_error("PlateLoadEngine: " + why); }

	Real cross(const Vector3r& a, const Vector3r& b) { return a[0] * b[1] - a[1] * b[0]; }

	/// Along a wall; zero where the shape has no direction.
	Vector3r alongWall(const Body& wall)
	{
		if (dynamic_cast<const Segment*>(wall.shape.get())) return wall.state->ori * Vector3r(1, 0, 0);
		if (const auto* plane = dynamic_cast<const Wall*>(wall.shape.get()))
			return plane->axis == 0 ? Vector3r(0, 1, 0) : Vector3r(1, 0, 0);
		return Vector3r::Zero();
	}

	constexpr Real holdsAll = 1e30; // N
}

void PlateLoadEngine::validate() const
{
	using nscd::number;
	const auto exists = [this](Body::id_t body) {
		return body >= 0 && body < Body::id_t(scene->bodies->size()) && (*scene->bodies)[body];
	};
	if (!exists(id)) refusePlate("id = " + std::to_string(id) + ": there is no such body");
	const Body& plate = *(*scene->bodies)[id];
	if (!(plate.state->mass > 0))
		refusePlate(
		        "id = " + std::to_string(id) + ": body #" + std::to_string(id) + " has the mass "
		        + number(plate.state->mass) + ": give it a mass [kg], which says how fast it moves");
	if (!(direction.norm() > 0) || !std::isfinite(direction.norm()) || direction[2] != 0)
		refusePlate(
		        "direction = (" + number(direction[0]) + ", " + number(direction[1]) + ", "
		        + number(direction[2]) + "): give a vector in the x-y plane");
	for (const auto& [name, value] :
	     { std::pair("force", force), std::pair("stress", stress), std::pair("damping", damping) })
		if (!nscd::isNumber(value)) refusePlate(string(name) + " = " + number(value) + ": it must be finite");
	if (damping < 0) refusePlate("damping = " + number(damping) + ": it must be 0 or more [N s/m]");
	if (!between.empty() && between.size() != 2)
		refusePlate("between has " + std::to_string(between.size()) + " ids: give two bodies, or none");
	for (const int wall : between)
		if (!exists(wall))
			refusePlate("between has the id " + std::to_string(wall) + ": there is no such body");
	if (rail >= 0 && !exists(rail))
		refusePlate(
		        "rail = " + std::to_string(rail)
		        + ": there is no such body, which would hold the plate in its way");
	if (rail >= 0 && (*scene->bodies)[rail]->shape)
		refusePlate(
		        "rail = " + std::to_string(rail)
		        + ": that body has a shape, and the guide is no contact of shapes: give a body without one");
	for (int k = 0; rail >= 0 && k < 3; ++k)
		if (!nscd::isNumber(origin[k]))
			refusePlate(
			        "origin[" + std::to_string(k) + "] = " + number(origin[k]) + ": it must be finite [m]");
	if (stress != 0 && between.empty() && !dynamic_cast<const Segment*>(plate.shape.get()))
		refusePlate(
		        "body #" + std::to_string(id)
		        + " is no Segment, so its width is not known: give two bodies it stands between, or a force instead of a stress");
}

/// Of the plate at its present place [m], and of the walls at theirs.
Real PlateLoadEngine::presentWidth(const nscd::Resident& resident, const Vector3r& way) const
{
	const Body& plate   = *(*scene->bodies)[id];
	const auto* segment = dynamic_cast<const Segment*>(plate.shape.get());
	const Real  length  = segment ? 2 * segment->halfLength : std::numeric_limits<Real>::max();
	if (between.empty()) return segment ? length : 0;
	const Vector3r along = segment ? alongWall(plate) : Vector3r(-way[1], way[0], 0),
	               at    = resident.bodies[id].place();
	Real ends[2];
	for (int k = 0; k < 2; ++k) {
		const Vector3r to    = resident.bodies[between[k]].place() - at;
		const Vector3r b     = alongWall(*(*scene->bodies)[between[k]]);
		const Real     meets = cross(along, b);
		if (b != Vector3r::Zero() && std::abs(meets) < 1e-6)
			refusePlate(
			        "between has the id " + std::to_string(between[k]) + ": body #"
			        + std::to_string(between[k]) + " is parallel to the plate #" + std::to_string(id)
			        + ", which cannot stand between it and another: give the walls at its sides");
		ends[k] = b == Vector3r::Zero() ? to.dot(along) : cross(to, b) / meets;
	}
	return std::min(length, std::abs(ends[1] - ends[0]));
}

/// The guide's interaction; null where there is none yet.
Interaction* PlateLoadEngine::guide()
{
	const auto& found = scene->interactions->find(rail, id);
	return found && found->isReal() ? found.get() : nullptr;
}

/// Ends the guide to another rail than the present one.
void PlateLoadEngine::dropFormerGuide(nscd::Resident& resident)
{
	if (guidedBy == rail) return;
	std::vector<shared_ptr<Interaction>> former;
	for (const auto& [other, contact] : (*scene->bodies)[id]->intrs)
		if (const auto& body = Body::byId(other, scene); other != rail && (!body || !body->shape))
			former.push_back(contact);
	if (!former.empty()) resident.show();
	for (const auto& contact : former)
		scene->interactions->erase(contact->getId1(), contact->getId2(), contact->linIx);
	guidedBy = rail;
}

/// Keeps the plate in its way: by a contact that bears all across it and nothing along it.
void PlateLoadEngine::hold(nscd::Resident& resident, const Vector3r& way)
{
	const Vector3r across(-way[1], way[0], 0), at = resident.bodies[id].place();
	const auto*    shape  = dynamic_cast<const Segment*>((*scene->bodies)[id]->shape.get());
	const Real     length = 1e-3 * (shape ? 2 * shape->halfLength : 1); // by which errors of position are measured
	const Real     beside = (at - origin).dot(across);
	if (!(std::abs(beside) <= length))
		refusePlate(
		        "origin = (" + nscd::number(origin[0]) + ", " + nscd::number(origin[1]) + "): the plate #"
		        + std::to_string(id) + " stands " + nscd::number(beside)
		        + " m beside the way through it: give a point of its way [m]");
	dropFormerGuide(resident);
	if (!guide()) {
		resident.show(); // contacts are taken anew, with this one
		const auto made = boost::make_shared<Interaction>(rail, id);
		const auto geom = boost::make_shared<ScGeom>();
		const auto phys = boost::make_shared<NscdPhys>();
		geom->normal    = across;
		geom->refR1 = geom->refR2 = geom->radius1 = geom->radius2 = 0;
		geom->penetrationDepth                                    = 0;
		geom->contactPoint                                        = at;
		phys->length                                              = length;
		made->geom                                                = geom;
		made->phys                                                = phys;
		made->iterMadeReal                                        = scene->iter;
		scene->interactions->insert(made);
	}
	Interaction* const found = guide();
	auto&              phys  = static_cast<NscdPhys&>(*found->phys);
	auto&              geom  = static_cast<ScGeom&>(*found->geom);
	if (phys.adhesion != holdsAll) { // new, or loaded
		resident.show();
		phys.adhesion        = holdsAll;
		phys.currentFriction = phys.tangensOfFrictionAngle = phys.currentRollingArm = 0;
	}
	geom.normal           = across;
	geom.contactPoint     = at;
	geom.penetrationDepth = -(at - origin).dot(across); // which the loop reads in the next step
}

void PlateLoadEngine::action()
{
	nscd::Turn turn(
	        *this,
	        nscd::threadsOf(*this)); // first: a refusal shows what the engines before have left in the arrays
	validate();
	nscd::Resident& resident = turn.resident();
	const auto&     plate    = resident.bodies[id];
	const Vector3r  way = direction.normalized(), gravity = nscd::gravityOf(*scene);
	const Vector3r  velocity(plate.motion.velocity.x, plate.motion.velocity.y, 0);
	width = presentWidth(resident, way);
	load  = force;
	if (stress != 0) {
		Vector3r normal = way; // of a plate without a direction of its own
		if (const Vector3r along = alongWall(*(*scene->bodies)[id]); along != Vector3r::Zero())
			normal = Vector3r(-along[1], along[0], 0);
		load += stress * width * std::abs(normal.dot(way));
	}
	Vector3r total = (load - damping * velocity.dot(way) / (1 + damping * scene->dt / plate.mass)) * way;
	if (weightless) total -= plate.mass * gravity;
	if (rail < 0) dropFormerGuide(resident);
	if (rail >= 0 && nscd::hasSolver(*scene)) hold(resident, way);
	else if (rail >= 0) {
		scene->forces.sync();
		const Vector3r all = scene->forces.getForce(id) + total + plate.mass * gravity;
		total -= all - all.dot(way) * way;
	}
	scene->forces.addForce(id, total);
	turn.end();
}

} // namespace yade
