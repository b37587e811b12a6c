#include "SpaceSeam.hpp"
#include "Vectors.hpp"
#include "../walls/Arc.hpp"
#include "../engines/PlanarGridCollider.hpp"
#include "../engines/PlanarNewtonIntegrator.hpp"
#include "../engines/Gravity.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include "../seam/Prefetch.hpp"
#include "../seam/Resident.hpp"
#include <algorithm>
#include <contact/space/bond.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

namespace {
	[[noreturn]] void refuseBody(const Body& body, const string& why, const string& remedy)
	{
		fail("body #" + std::to_string(body.getId()) + " " + why + ": " + remedy);
	}

	/// The shape of a sphere, null of any other; its own class is recognised without a search.
	const Sphere* sphereOf(const Shape* shape)
	{
		if (shape && typeid(*shape) == typeid(Sphere)) return static_cast<const Sphere*>(shape);
		return dynamic_cast<const Sphere*>(shape);
	}

	/// Inverse of a number that resists, 0 in a blocked direction.
	Real inverseIn(unsigned blocked, unsigned axis, Real value) { return blocked & axis ? 0 : 1 / value; }
}

bool isInSpace(const Scene& scene, const Resident& resident)
{
	const auto& bodies = resident.bodies;
	for (const auto& engine : scene.engines)
		if (!engine->dead
		    && (dynamic_cast<const PlanarGridCollider*>(engine.get())
		        || dynamic_cast<const PlanarNewtonIntegrator*>(engine.get())))
			return false;
	constexpr unsigned out  = State::DOF_Z | State::DOF_RX | State::DOF_RY;
	const auto         free = std::find_if(bodies.begin(), bodies.end(), [](const BodyState& b) {
                return b.present && b.radius > 0 && b.blocked != State::DOF_ALL && (b.blocked & out) != out;
        });
	if (free == bodies.end()) { // where no sphere is there yet, gravity tells
		const bool     empty = std::none_of(bodies.begin(), bodies.end(), [](const BodyState& b) {
                        return b.present && b.radius > 0;
                });
		const Vector3r g     = gravityOf(scene);
		return empty && g[2] != 0 && std::isfinite(g[2]);
	}
	const auto isOfThePlane = [&](int id) {
		const auto&  body  = (*scene.bodies)[id];
		const Shape* shape = body ? body->shape.get() : nullptr;
		return dynamic_cast<const Segment*>(shape) || dynamic_cast<const Arc*>(shape);
	};
	return std::none_of(resident.shaped.begin(), resident.shaped.end(), isOfThePlane);
}

void SpaceSeam::gather(
        Scene& scene, Resident& resident, const Vector3r& gravity, const Relaxation& how, int threadCount)
{
	relaxation = how;
	threads    = threadCount;
	recalls    = 0;
	kept       = &SpaceContacts::of(resident);
	gatherBodies(scene, gravity);
	if (!kept->owned()) kept->take(scene, resident.bodies, threads);
	findContacts(scene, resident.bodies);
	const long count = (long)solved.size();
	problem.contacts.resize(count);
	problem.impulses.resize(count);
	warmStart.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		gatherContact(k);
		warmStart[k] = problem.impulses[k];
	}
}

void SpaceSeam::gatherBodies(Scene& scene, const Vector3r& gravity)
{
	const auto&  all  = *scene.bodies;
	const size_t size = all.size();
	scene.forces.addMaxId(Body::id_t(size));
	scene.forces.synced = false;
	scene.forces.sync();
	bodies.resize(size);
	problem.inverseMass.resize(size);
	problem.freeVelocity.resize(size);
	problem.positions.resize(size);
	const Real h   = relaxation.step;
	int        bad = -1; // refused after the loop, which must not throw
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : bad)
	for (long id = 0; id < (long)size; ++id) {
		if (id + (long)later < (long)size) fetch<sizeof(Body)>(all[id + later].get());
		if (id + (long)soon < (long)size && all[id + soon]) {
			fetch<sizeof(State)>(all[id + soon]->state.get());
			fetch<sizeof(Sphere)>(all[id + soon]->shape.get());
		}
		const auto& b         = all[id];
		StepBody&   own       = bodies[id];
		auto&       m         = problem.inverseMass[id];
		auto&       v         = problem.freeVelocity[id];
		own                   = {};
		m                     = {};
		v                     = {};
		problem.positions[id] = {};
		if (!b || !b->state) continue;
		const State& s        = *b->state;
		const auto*  ball     = sphereOf(b->shape.get());
		own.present           = true;
		own.mass              = s.mass;
		own.inertia           = s.inertia[0];
		own.radius            = ball && !b->isClump() ? ball->radius : -1;
		own.before            = { ours(s.vel), ours(s.angVel) };
		own.external          = { ours(scene.forces.getForce(id)), ours(scene.forces.getTorque(id)) };
		const unsigned d      = s.blockedDOFs;
		m                     = { inverseIn(d, State::DOF_X, s.mass),
			                  inverseIn(d, State::DOF_Y, s.mass),
			                  inverseIn(d, State::DOF_Z, s.mass),
			                  {} };
		m.inertia.xx          = inverseIn(d, State::DOF_RX, s.inertia[0]);
		m.inertia.yy          = inverseIn(d, State::DOF_RY, s.inertia[1]);
		m.inertia.zz          = inverseIn(d, State::DOF_RZ, s.inertia[2]);
		problem.positions[id] = ours(s.pos);
		const auto pushed     = [&](Real speed, Real inverseMass, Real force, Real field) {
                        return inverseMass > 0 ? speed + h * (force * inverseMass + field) : speed;
		};
		const auto &f = own.external.v, &t = own.external.w;
		v.v            = { pushed(s.vel[0], m.x, f.x, gravity[0]), pushed(s.vel[1], m.y, f.y, gravity[1]),
			           pushed(s.vel[2], m.z, f.z, gravity[2]) };
		v.w            = { pushed(s.angVel[0], m.inertia.xx, t.x, 0), pushed(s.angVel[1], m.inertia.yy, t.y, 0),
			           pushed(s.angVel[2], m.inertia.zz, t.z, 0) };
		const Real sum = dot(v.v, { 1, 1, 1 }) + dot(v.w, { 1, 1, 1 }) + s.pos.sum() + m.x + m.y + m.z
		        + m.inertia.xx + m.inertia.yy + m.inertia.zz;
		const bool turns  = !m.inertia.isZero(),
		           uneven = s.inertia[0] != s.inertia[1] || s.inertia[1] != s.inertia[2];
		const bool weighs = s.mass > 0 || (m.x == 0 && m.y == 0 && m.z == 0);
		if (!std::isfinite(sum) || !weighs || b->isClump() || b->isClumpMember() || (turns && uneven)
		    || (ball && !(ball->radius > 0)))
			bad = std::max(bad, int(id));
	}
	if (bad < 0) return;
	const Body&  body = *all[bad];
	const State& s    = *body.state;
	if (body.isClump() || body.isClumpMember())
		refuseBody(
		        body, "belongs to a clump",
		        "clumps are not supported: use single spheres, which bonds can hold together (contactDynamics.bond())");
	if (const auto* ball = dynamic_cast<const Sphere*>(body.shape.get()); ball && !(ball->radius > 0))
		refuseBody(body, "is a Sphere of radius " + number(ball->radius), "give it a positive radius [m]");
	if (!std::isfinite(s.pos.sum() + s.vel.sum() + s.angVel.sum()))
		refuseBody(
		        body, "has a position or velocity that is not finite",
		        "check the forces and velocities that the script sets");
	if (!std::isfinite(dot(bodies[bad].external.v, { 1, 1, 1 }) + dot(bodies[bad].external.w, { 1, 1, 1 })))
		refuseBody(body, "has a force or torque that is not finite", "check the engines that add forces");
	if (!(s.mass > 0) || !(s.inertia.minCoeff() > 0))
		refuseBody(
		        body,
		        "can move but has mass = " + number(s.mass) + " kg and inertia = (" + number(s.inertia[0])
		                + ", " + number(s.inertia[1]) + ", " + number(s.inertia[2]) + ") kg m²",
		        "set state.mass and state.inertia to positive values of the body's size, or block its DOFs");
	refuseBody(
	        body, "is free to turn and has three different moments of inertia",
	        "only spheres turn: set state.blockedDOFs = 'XYZ' for a plate that moves without turning, or block all");
}

/// What becomes of a contact; Refused: the step cannot be made with it, see refuse().
SpaceSeam::Use SpaceSeam::useOf(const SpaceContactState& s) const
{
	if (s.kept) return std::isfinite(s.normal.x + s.normal.y + s.normal.z) ? Use::Solved : Use::Refused;
	const Interaction& I = *s.interaction;
	if (!I.isReal() || !I.isActive) return Use::None;
	const int id1 = I.getId1(), id2 = I.getId2();
	if (!bodies[id1].present || !bodies[id2].present) return Use::None;
	if (s.phys) return SpaceContacts::isSound(*s.phys, *s.geom) ? Use::Solved : Use::Refused;
	// of two bodies that were held when it was made; the next loop gives one in space to those that are no longer
	const bool isPlain = typeid(*I.phys) == typeid(NscdPhys);
	return isPlain && !static_cast<const NscdPhys&>(*I.phys).senseless().first ? Use::None : Use::Refused;
}

/// Says why an interaction cannot be taken.
void SpaceSeam::refuse(const Scene& scene, Interaction& I) const
{
	const string pair = "interaction #" + std::to_string(I.getId1()) + "+#" + std::to_string(I.getId2());
	const auto*  phys = physOf(*I.phys);
	if (!phys)
		fail(pair + " has a " + I.phys->getClassName()
		     + ": give both bodies an NscdMat and use Ip2_NscdMat_NscdMat_NscdPhys");
	if (typeid(*phys) != typeid(NscdSpacePhys) && typeid(*phys) != typeid(NscdPhys))
		fail(pair + " has a " + phys->getClassName()
		     + ", and bodies move in space, where contacts have an NscdSpacePhys: walls that weaken by slip are for disks in the plane"
		       " (state.blockedDOFs = 'zXY')");
	if (!std::isfinite(static_cast<const ScGeom&>(*I.geom).normal.sum()))
		fail(pair
		     + " has no normal: the centres are at one place, or a position is not finite: move one of them");
	ContactState state;
	BondState    bond;
	BondStrain   rest;
	read(look(I), state, bond, rest);
	state.nz = 0; // nothing is wrong with that here
	refuseContact(scene, state);
}

/// Those to be solved for in the order of ids, and those that are left out. Contacts that are not kept in the arrays
/// alone are read.
void SpaceSeam::findContacts(const Scene& scene, const std::vector<BodyState>& all)
{
	auto&       states = kept->states;
	const auto& order  = kept->order;
	const long  count  = (long)order.size();
	long        bad    = count; // the first one that cannot be taken, refused after the loop, which must not throw
	uses.resize(count);
	std::vector<std::vector<Left>> parts(threads); // by thread, each in order, since each has a stretch of them
#pragma omp parallel num_threads(threads) reduction(min : bad)
	{
		std::vector<Left> out;
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			if (k + (long)soon < count && !states[order[k + soon].slot].kept) {
				fetch<sizeof(ScGeom)>(states[order[k + soon].slot].geom);
				fetch<sizeof(NscdSpacePhys)>(states[order[k + soon].slot].phys);
			}
			auto& s = states[order[k].slot];
			uses[k] = useOf(s);
			if (uses[k] == Use::Refused) bad = std::min(bad, k);
			if (uses[k] != Use::Solved) continue;
			if (!s.kept) SpaceContacts::read(s, all);
			if (const auto open = staysOut(s)) {
				out.push_back({ order[k], *open });
				forgetReactions(s);
				uses[k] = Use::None;
			}
		}
		nonsmooth::neighbours::partOfThread(parts).swap(out);
	}
	if (bad < count) {
		Interaction& refused = *states[order[bad].slot].interaction;
		kept->show();
		refuse(scene, refused);
	}
	solved.clear();
	for (long k = 0; k < count; ++k)
		if (uses[k] == Use::Solved) solved.push_back(order[k]);
	left.clear();
	for (const auto& part : parts)
		left.insert(left.end(), part.begin(), part.end());
}

/// Bodies, normal and levers of a contact.
void SpaceSeam::setFrame(const SpaceContactState& s, space::Contact& c) const
{
	c   = {};
	c.i = s.i;
	c.j = s.j;
	c.n = Real(s.swapped ? -1 : 1) * s.normal;
	// between spheres the point in the middle of the gap keeps the angular momentum; where one hits a wall within the
	// step its arm is the radius then
	const bool both = bodies[c.i].radius > 0 && bodies[c.j].radius > 0;
	const auto arm  = [&](int id, Real side, Real& lever, space::Vector& aside) {
                if (bodies[id].radius > 0) { // through a sphere's centre
                        lever = side * (bodies[id].radius + (both ? 0.5 * s.gap : 0));
                        return;
                }
                const space::Vector a = s.point - problem.positions[id];
                lever                 = dot(a, c.n);
                aside                 = acrossNormal(c.n, a);
	};
	arm(c.i, 1, c.leverI, c.asideI);
	arm(c.j, -1, c.leverJ, c.asideJ);
	c.length = s.length;
}

void SpaceSeam::gatherContact(size_t k)
{
	const auto& s = stateOf(k);
	const Real  h = relaxation.step, sign = s.swapped ? -1 : 1;
	auto&       c = problem.contacts[k];
	setFrame(s, c);
	c.adhesion    = h * s.adhesion;
	c.friction    = s.friction;
	c.rollingArm  = s.rollingArm;
	c.twistingArm = s.twistingArm;
	c.biasN       = !s.bonded && s.gap > 0 ? s.gap / h : 0;
	if (s.bonded && s.phys->closes && s.phys->restGap > 0) { // play, as in the plane (contact/plane/bond.hpp)
		c.biasN = std::max(s.gap, Real(0)) / h;
		c.play  = std::max(s.phys->restGap, s.gap) / h;
	}
	if (s.restitution > 0 && !s.bonded) {
		// an impact within the step counts at its full speed; one that does not happen yet is left alone
		const Real approach = relativeVelocity(c, bodies[c.i].before, bodies[c.j].before).n;
		if (approach < 0 && s.gap + h * approach <= 0) c.biasN = s.restitution * approach;
	}
	if (problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed()) {
		problem.impulses[k] = {};
		return;
	}
	// the step before had another normal: what was along it or across it is so again
	const space::Vector shear = sign * h * s.shearForce, rolling = sign * h * s.rollingTorque;
	problem.impulses[k] = { h * s.pressed * c.n + acrossNormal(c.n, shear),
		                h * s.twistingTorque * c.n + acrossNormal(c.n, rolling) };
}

Vector2i SpaceSeam::idsOf(size_t contact) const { return Vector2i(solved[contact].low, solved[contact].high); }

int SpaceSeam::overlapsOf(Real least) const
{
	return int(std::count_if(solved.begin(), solved.end(), [&](const auto& place) {
		const auto& s = kept->states[place.slot];
		return -s.gap >= least * s.length;
	}));
}

} // namespace yade::nscd
