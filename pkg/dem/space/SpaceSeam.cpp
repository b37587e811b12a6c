#include "SpaceSeam.hpp"
#include "Vectors.hpp"
#include "../Arc.hpp"
#include "../PlanarGridCollider.hpp"
#include "../PlanarNewtonIntegrator.hpp"
#include "../Gravity.hpp"
#include "../Refusal.hpp"
#include "../SceneCheck.hpp"
#include <contact/space/bond.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

namespace {
	[[noreturn]] void refuseBody(const Body& body, const string& why, const string& remedy)
	{
		fail("body #" + std::to_string(body.getId()) + " " + why + ": " + remedy);
	}

	/// Inverse of a number that resists, 0 in a blocked direction.
	Real inverseIn(unsigned blocked, unsigned axis, Real value) { return blocked & axis ? 0 : 1 / value; }

	/// What of an error of a bond's length, either way, goes beyond the slack.
	Real beyondSlack(Real error, Real slack) { return error - std::max(-slack, std::min(slack, error)); }

	Real kineticOf(Real mass, Real inertia, const space::Twist& t)
	{
		return 0.5 * (mass * dot(t.v, t.v) + inertia * dot(t.w, t.w));
	}
}

bool isInSpace(const Scene& scene, const std::vector<BodyReading>& bodies)
{
	for (const auto& engine : scene.engines)
		if (!engine->dead
		    && (dynamic_cast<const PlanarGridCollider*>(engine.get())
		        || dynamic_cast<const PlanarNewtonIntegrator*>(engine.get())))
			return false;
	constexpr unsigned out  = State::DOF_Z | State::DOF_RX | State::DOF_RY;
	const auto         free = std::find_if(bodies.begin(), bodies.end(), [](const BodyReading& b) {
                return b.present && b.radius > 0 && b.blocked != State::DOF_ALL && (b.blocked & out) != out;
        });
	if (free == bodies.end()) { // where no sphere is there yet, gravity tells
		const bool     empty = std::none_of(bodies.begin(), bodies.end(), [](const BodyReading& b) {
                        return b.present && b.radius > 0;
                });
		const Vector3r g     = gravityOf(scene);
		return empty && g[2] != 0 && std::isfinite(g[2]);
	}
	return std::none_of(scene.bodies->begin(), scene.bodies->end(), [](const shared_ptr<Body>& b) {
		const Shape* shape = b ? b->shape.get() : nullptr;
		return dynamic_cast<const Segment*>(shape) || dynamic_cast<const Arc*>(shape);
	});
}

void SpaceSeam::gather(Scene& scene, const Vector3r& gravity, const Relaxation& how, int threadCount)
{
	relaxation = how;
	threads    = threadCount;
	gatherBodies(scene, gravity);
	findContacts(scene);
	problem.contacts.assign(links.size(), {});
	problem.impulses.resize(links.size());
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < (long)links.size(); ++k)
		gatherContact(k);
	warmStart = problem.impulses;
}

void SpaceSeam::gatherBodies(Scene& scene, const Vector3r& gravity)
{
	const auto&  all  = *scene.bodies;
	const size_t size = all.size();
	scene.forces.addMaxId(Body::id_t(size));
	scene.forces.synced = false;
	scene.forces.sync();
	bodies.assign(size, {});
	problem.inverseMass.assign(size, {});
	problem.freeVelocity.assign(size, {});
	problem.positions.assign(size, {});
	const Real h   = relaxation.step;
	int        bad = -1; // refused after the loop, which must not throw
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : bad)
	for (long id = 0; id < (long)size; ++id) {
		const auto& b = all[id];
		if (!b || !b->state) continue;
		const State& s        = *b->state;
		BodyState&   own      = bodies[id];
		auto&        m        = problem.inverseMass[id];
		auto&        v        = problem.freeVelocity[id];
		const auto*  ball     = dynamic_cast<const Sphere*>(b->shape.get());
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

/// All real interactions of rigid contacts, in the order of ids.
void SpaceSeam::findContacts(Scene& scene)
{
	links.clear();
	for (const auto& I : *scene.interactions) {
		if (!I->isReal() || !I->isActive) continue;
		const int id1 = I->getId1(), id2 = I->getId2();
		if (!bodies[id1].present || !bodies[id2].present) continue;
		const string pair = "interaction #" + std::to_string(id1) + "+#" + std::to_string(id2);
		auto*        phys = physOf(*I->phys);
		if (!phys)
			fail(pair + " has a " + I->phys->getClassName()
			     + ": give both bodies an NscdMat and use Ip2_NscdMat_NscdMat_NscdPhys");
		if (problem.inverseMass[id1].isFixed() && problem.inverseMass[id2].isFixed()
		    && typeid(*phys) == typeid(NscdPhys))
			continue; // of two bodies that are held, as in no plane and no space
		if (typeid(*phys) != typeid(NscdSpacePhys))
			fail(pair + " has a " + phys->getClassName()
			     + ", and bodies move in space, where contacts have an NscdSpacePhys: walls that weaken by slip are for disks in the plane"
			       " (state.blockedDOFs = 'zXY'), and contacts that were made while all bodies were in the plane must be made anew (O.interactions.clear())");
		const auto& geom = static_cast<const ScGeom&>(*I->geom);
		if (!std::isfinite(geom.normal.sum()))
			fail(pair
			     + " has no normal: the centres are at one place, or a position is not finite: move one of them");
		phys->hearReset();
		if (phys->senseless().first || phys->unheard() || !(phys->length > 0)) {
			Reading     reading;
			BondReading bond;
			BondStrain  rest;
			read(look(*I), reading, bond, rest);
			reading.nz = 0; // nothing is wrong with that here
			refuseContact(scene, reading);
		}
		const bool both    = bodies[id1].radius > 0 && bodies[id2].radius > 0;
		const bool swapped = both ? id1 > id2 : bodies[id1].radius > 0;
		links.push_back(
		        { I.get(), phys, swapped ? id2 : id1, swapped ? id1 : id2, swapped, -geom.penetrationDepth });
	}
	std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
		return std::make_pair(std::min(a.i, a.j), std::max(a.i, a.j))
		        < std::make_pair(std::min(b.i, b.j), std::max(b.i, b.j));
	});
}

void SpaceSeam::gatherContact(size_t k)
{
	const Link& link = links[k];
	const auto& geom = static_cast<const ScGeom&>(*link.interaction->geom);
	auto&       phys = static_cast<NscdSpacePhys&>(*link.phys);
	const Real  h    = relaxation.step;
	auto&       c    = problem.contacts[k];
	const Real  sign = link.swapped ? -1 : 1;
	c.i              = link.i;
	c.j              = link.j;
	c.n              = sign * ours(geom.normal);
	const auto arm   = [&](int id, Real side, Real& lever, space::Vector& aside) {
                if (bodies[id].radius > 0) { // through a sphere's centre
                        lever = side * (bodies[id].radius + 0.5 * link.gap);
                        return;
                }
                const space::Vector a = ours(geom.contactPoint) - problem.positions[id];
                lever                 = dot(a, c.n);
                aside                 = acrossNormal(c.n, a);
	};
	arm(c.i, 1, c.leverI, c.asideI);
	arm(c.j, -1, c.leverJ, c.asideJ);
	c.adhesion    = h * phys.adhesion;
	c.friction    = phys.currentFriction;
	c.rollingArm  = phys.currentRollingArm;
	c.twistingArm = phys.currentTwistingArm;
	c.length      = phys.length;
	c.biasN       = !phys.bonded && link.gap > 0 ? link.gap / h : 0;
	if (phys.bonded && phys.closes && phys.restGap > 0) { // play, as in the plane (contact/plane/bond.hpp)
		c.biasN = std::max(link.gap, Real(0)) / h;
		c.play  = std::max(phys.restGap, link.gap) / h;
	}
	if (phys.restitution > 0 && !phys.bonded) {
		// an impact within the step counts at its full speed; one that does not happen yet is left alone
		const Real approach = relativeVelocity(c, bodies[c.i].before, bodies[c.j].before).n;
		if (approach < 0 && link.gap + h * approach <= 0) c.biasN = phys.restitution * approach;
	}
	if (problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed()) {
		problem.impulses[k] = {};
		return;
	}
	// the step before had another normal: what was along it or across it is so again
	const space::Vector shear = sign * h * ours(phys.shearForce), rolling = sign * h * ours(phys.rollingTorque);
	problem.impulses[k] = { h * phys.normal * c.n + acrossNormal(c.n, shear),
		                h * phys.twistingTorque * c.n + acrossNormal(c.n, rolling) };
}

Vector2i SpaceSeam::idsOf(size_t contact) const
{
	const Link& l = links[contact];
	return Vector2i(std::min(l.i, l.j), std::max(l.i, l.j));
}

int SpaceSeam::overlapsOf(Real least) const
{
	return int(std::count_if(links.begin(), links.end(), [&](const Link& l) {
		return -l.gap >= least * l.phys->length;
	}));
}

void SpaceSeam::correct(const space::SolverSettings& settings, space::Workspace& workspace, int sweeps)
{
	correction.displacements.clear();
	if (sweeps == 0 || relaxation.rate == 0) return;
	const Real h = relaxation.step, most = h * relaxation.largestSpeed;
	errors.assign(links.size(), {});
	bool any = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : any)
	for (long k = 0; k < (long)links.size(); ++k) {
		const auto& c     = problem.contacts[k];
		const Real  slack = relaxation.slack * c.length, gap = links[k].gap;
		const Real  end = gap + h * relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]).n;
		// of what was wrong before the step the share 1 − κ may stay; what the step adds may not
		auto&      e     = errors[k];
		const auto stays = [this](Real wrong) { return (1 - relaxation.rate) * wrong; };
		e.impulse        = links[k].phys->correction;
		e.held           = isHeld(k);
		if (!e.held) {
			e.error = end + slack - stays(std::min(Real(0), gap + slack));
			if (e.error < 0) e.error = std::max(-most, e.error);
			any = any || e.error < 0;
			continue;
		}
		const Real rest = links[k].phys->restGap;
		if (!(c.play > 0)) {
			e.error = beyondSlack(end - rest, slack) - stays(beyondSlack(gap - rest, slack));
			e.error = std::max(-most, std::min(most, e.error));
			any     = any || e.error != 0;
			continue;
		}
		// between touch and its length nothing is wrong
		const Real touched = end + slack - stays(std::min(Real(0), gap + slack)),
		           drawn   = end - rest - slack - stays(std::max(Real(0), gap - rest - slack));
		e.error            = std::max(-most, touched);
		e.play             = std::max(Real(0), e.error - std::min(most, drawn));
		any                = any || e.error < 0 || e.error > e.play;
	}
	if (any) correctPositions(problem, settings, workspace, errors, sweeps, correction);
}

/// Whether a bond holds its length in this step.
bool SpaceSeam::isHeld(size_t k) const
{
	if (!links[k].phys->bonded) return false;
	const auto& c = problem.contacts[k];
	const auto  u = relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
	return !space::yieldsInTension(c, rowsOf(c, problem.impulses[k]), u.n);
}

StepSums SpaceSeam::scatter(Scene& scene, const Vector3r& gravity)
{
	StepSums sums;
	broken.clear();
	reaction.assign(bodies.size(), {});
	for (size_t k = 0; k < links.size(); ++k)
		scatterContact(k, sums);
	const Real h = relaxation.step;
	for (size_t id = 0; id < bodies.size(); ++id) {
		if (!bodies[id].present) continue;
		const auto& r = reaction[id];
		if (!isZero(r.v) || !isZero(r.w)) {
			scene.forces.addForceUnsynced(id, theirs(1 / h * r.v)); // into the sums, see gatherBodies
			scene.forces.addTorqueUnsynced(id, theirs(1 / h * r.w));
		}
		sumBody(id, gravity, sums);
		if (correction.displacements.empty()) continue;
		const auto& d = correction.displacements[id];
		State&      s = *(*scene.bodies)[id]->state;
		if (isZero(d.v) && isZero(d.w)) continue;
		s.pos += theirs(d.v);
	}
	return sums;
}

void SpaceSeam::scatterContact(size_t k, StepSums& sums)
{
	const Link& link = links[k];
	const auto& c    = problem.contacts[k];
	const auto& p    = problem.impulses[k];
	auto&       phys = static_cast<NscdSpacePhys&>(*link.phys);
	const Real  h = relaxation.step, sign = link.swapped ? -1 : 1;
	const auto  rows    = rowsOf(c, p);
	phys.normal         = rows.n / h;
	phys.normalForce    = theirs(sign / h * rows.n * c.n);
	phys.shearForce     = theirs(sign / h * rows.t);
	phys.tangential     = std::sqrt(dot(rows.t, rows.t)) / h;
	phys.rollingTorque  = theirs(sign / h * rows.r);
	phys.torque         = std::sqrt(dot(rows.r, rows.r)) / h;
	phys.twistingTorque = rows.s / h;
	phys.correction     = correction.displacements.empty() ? 0 : correction.impulses[k];
	phys.noteForces();
	phys.touched = false;

	auto&               ri   = reaction[c.i];
	auto&               rj   = reaction[c.j];
	const space::Vector turn = cross(c.n, p.f);
	ri.v                     = ri.v - p.f;
	ri.w                     = ri.w - (c.leverI * turn + cross(c.asideI, p.f) + p.m);
	rj.v                     = rj.v + p.f;
	rj.w                     = rj.w + (c.leverJ * turn + cross(c.asideJ, p.f) + p.m);

	// work of the impulse over the step, exact for constant mass: P·(U⁻ + U⁺)/2
	const auto u0         = relativeVelocity(c, bodies[c.i].before, bodies[c.j].before),
	           u1         = relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
	const Real normalWork = 0.5 * rows.n * (u0.n + u1.n), shearWork = 0.5 * dot(rows.t, u0.t + u1.t);
	const bool held = phys.bonded && !space::yieldsInTension(c, rows, u1.n) && !phys.yielded;
	// tension in a bond that does not open loses nothing
	if (rows.n < 0 && held) sums.heldWork += normalWork;
	else
		(rows.n < 0 ? sums.debonding : sums.impact) -= normalWork;
	if (phys.brokenMode != NscdPhys::None && phys.breaks) {
		++sums.broken[phys.brokenMode];
		broken.emplace_back(phys.brokenMode, link.interaction);
		phys.breaks = false;
	}
	phys.yielded = phys.slid = phys.rolled = false;
	if (phys.bonded) {
		const auto y = space::yieldOfStep(c, rows, u1, h);
		phys.yielded = space::yieldsInTension(c, rows, u1.n);
		phys.slid    = y.shear > 0;
		phys.rolled  = y.rolling > 0;
		phys.yieldPath += Vector3r(y.tension, y.shear, y.rolling);
		phys.twistingPath += y.twisting;
	}
	sums.sliding -= shearWork;
	sums.rolling -= 0.5 * dot(p.m, u0.w + u1.w);
	if (bodies[c.i].radius < 0 && shearWork != 0) sums.slidingOnWalls.emplace_back(c.i, -shearWork);
	if (phys.restitution > 0 && !phys.bonded && c.biasN > 0 && rows.n > 0)
		sums.missed -= phys.restitution * phys.restitution * std::min(Real(0), normalWork);
	const bool placed  = problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed();
	const Real overlap = placed ? 0 : std::max(Real(0), -link.gap) / c.length;
	sums.overlap += overlap;
	if (overlap > sums.worstOverlap) {
		sums.worstOverlap = overlap;
		sums.worstIds[0]  = std::min(c.i, c.j);
		sums.worstIds[1]  = std::max(c.i, c.j);
	}
	sums.touching += rows.n != 0 || link.gap <= 0;
	sums.bonds += phys.bonded;
}

void SpaceSeam::sumBody(size_t id, const Vector3r& gravity, StepSums& sums) const
{
	const BodyState& b  = bodies[id];
	const auto&      m  = problem.inverseMass[id];
	const auto &     v0 = b.before, &v1 = problem.velocities[id], &r = reaction[id], &f = b.external;
	const Real       h    = relaxation.step;
	const auto       mean = space::Twist { 0.5 * (v0.v + v1.v), 0.5 * (v0.w + v1.w) };
	const auto given = [](Real inverseMass, Real force, Real speed) { return inverseMass > 0 ? 0 : force * speed; };
	const auto free  = [](Real inverseMass, Real force, Real speed) { return inverseMass > 0 ? force * speed : 0; };
	// where the motion is given, the work that the contacts do on it goes outside; elsewhere other engines' forces work
	sums.wallWork -= given(m.x, r.v.x, mean.v.x) + given(m.y, r.v.y, mean.v.y) + given(m.z, r.v.z, mean.v.z)
	        + given(m.inertia.xx, r.w.x, mean.w.x) + given(m.inertia.yy, r.w.y, mean.w.y)
	        + given(m.inertia.zz, r.w.z, mean.w.z);
	if (m.isFixed()) return;
	sums.wallWork -= h * b.mass
	        * (given(m.x, gravity[0], v1.v.x) + given(m.y, gravity[1], v1.v.y) + given(m.z, gravity[2], v1.v.z));
	sums.external += h
	        * (free(m.x, f.v.x, mean.v.x) + free(m.y, f.v.y, mean.v.y) + free(m.z, f.v.z, mean.v.z)
	           + free(m.inertia.xx, f.w.x, mean.w.x) + free(m.inertia.yy, f.w.y, mean.w.y)
	           + free(m.inertia.zz, f.w.z, mean.w.z));
	const Vector3r at        = theirs(problem.positions[id]);
	const Real     potential = -b.mass * gravity.dot(at), moving = kineticOf(b.mass, b.inertia, v0);
	sums.kinetic += moving;
	sums.potential += potential;
	sums.size += moving + std::abs(potential);
	const bool          moved = !correction.displacements.empty();
	const space::Vector d     = moved ? correction.displacements[id].v : space::Vector {};
	sums.kineticLeft += kineticOf(b.mass, b.inertia, v1);
	sums.potentialLeft -= b.mass * gravity.dot(Vector3r(at + theirs(d) + h * theirs(v1.v)));
	sums.correction -= b.mass * gravity.dot(theirs(d));
	sums.mass += b.mass;
	sums.centre += b.mass * at;
	sums.momentum += b.mass * theirs(v1.v);
	const Real speed = std::sqrt(dot(v1.v, v1.v));
	sums.speed += speed;
	sums.largestSpeed = std::max(sums.largestSpeed, speed);
	++sums.bodies;
}

} // namespace yade::nscd
