#include "ContactSeam.hpp"
#include "Prefetch.hpp"
#include "Recall.hpp"
#include "../checks/PlaneCheck.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include <algorithm>
#include <contact/plane/law.hpp>
#include <contact/plane/bond.hpp>
#include <contact/plane/disk_contact.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;
using contact::Impulse;
using contact::Twist;

namespace {
	[[noreturn]] void refuse(const Body& body, const string& why, const string& remedy)
	{
		throw std::runtime_error(
		        "ContactDynamicsEngine: body #" + std::to_string(body.getId()) + " " + why + ": " + remedy);
	}
}

/// Sets bodies, directions and levers: from the lower id to the higher, from a wall to a sphere.
[[gnu::always_inline]] inline void ContactSeam::setFrame(const ContactState& state, Contact& c) const
{
	const int  id1 = state.first, id2 = state.second;
	const Real r1 = radius[id1], r2 = radius[id2]; // negative: not a sphere
	const bool s1 = r1 > 0, s2 = r2 > 0, swapped = s1 && s2 ? id1 > id2 : s1 && !s2;
	const Real nx = swapped ? -state.nx : state.nx, ny = swapped ? -state.ny : state.ny;
	const int  i = swapped ? id2 : id1, j = swapped ? id1 : id2;
	if (s1 && s2) {
		contact::plane::setDiskFrame(c, i, j, nx, ny, radius[i], radius[j], state.gap);
		return;
	}
	c.i              = i;
	c.j              = j;
	c.nx             = nx;
	c.ny             = ny;
	const auto lever = [&](int id) {
		return contact::Point { state.geom->contactPoint[0] - problem.positions[id].x,
			                state.geom->contactPoint[1] - problem.positions[id].y };
	};
	const auto ri = lever(i), rj = lever(j);
	c.leverNi = ny * ri.x - nx * ri.y;
	c.leverTi = ri.x * nx + ri.y * ny;
	// exactly none through a sphere's centre
	c.leverNj = s1 || s2 ? 0 : ny * rj.x - nx * rj.y;
	c.leverTj = rj.x * nx + rj.y * ny;
}

/// How far a bent wall, or the line that a disk's centre follows on it, turns away from its tangent along the path of
/// the step [m]; see Arc.
Real ContactSeam::bendOf(const ContactState& state, const Contact& c) const
{
	const Real curvature = static_cast<const SegmentGeom&>(*state.geom).curvature;
	Real       path      = relaxation.step * contact::passingSpeed(c, before[c.i], before[c.j]);
	// what a bond carries round with its wall is turned as one with it, see plane/rigid_clusters.hpp
	if (state.bonded && curvature != 0) path += relaxation.step * before[c.i].w / curvature;
	const Real turn = path * curvature;
	return path * turn / (1 + std::sqrt(std::max(Real(0), 1 - turn * turn)));
}

/// Of a bent wall the step's path is a chord.
void ContactSeam::bend(const ContactState& state, Contact& c) const
{
	const Real bias = bendOf(state, c) / relaxation.step;
	c.biasN         = c.biasN < 0 ? std::min(c.biasN, -bias) : c.biasN - bias;
}

/// Fills in a contact and its link, number by number: to copy a contact that was just put together would wait for each
/// of its parts. Returns the impulses of the step before.
[[gnu::always_inline]] inline Impulse ContactSeam::gatherContact(int slot, Contact& c, Link& link) const
{
	const ContactState& state = resident->states[slot];
	const Real          gap = state.gap, h = relaxation.step;
	setFrame(state, c);
	link    = { slot, -1, state.correction };
	c.biasN = !state.bonded && gap > 0 ? gap / h : 0;
	c.biasT = c.biasR = 0;
	c.adhesion        = h * state.adhesion;
	c.friction        = state.friction;
	c.rollingArm      = state.rollingArm;
	c.length          = state.length;
	c.play            = 0;
	if (state.bonded && state.closes) contact::plane::setPlay(c, state.restGap, gap, h);
	if (state.bounces && !state.bonded) {
		// an impact within the step counts at its full speed; one that does not happen yet is left alone
		const Real approach = contact::relativeVelocity(c, before[c.i], before[c.j]).n;
		if (approach < 0 && gap + h * approach <= 0) {
			// disks that pass each other come no nearer than their paths do
			const Real end = radius[c.i] > 0 && radius[c.j] > 0 && gap > 0 ? gapAtEnd(c, {}, {})
			                                                               : gap + h * approach;
			c.biasN        = end > 0 ? end / h - approach : state.restitution * approach;
#pragma omp atomic write
			meets = 1;
		}
	}
	if (state.curved) bend(state, c);
	if (problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed()) {
		const auto u = contact::relativeVelocity(c, before[c.i], before[c.j]);
		if (u.n != 0 || u.t != 0 || u.r != 0) {
#pragma omp atomic write
			slides = 1;
		}
		return {}; // no reaction is found, so none may stay
	}
	return { h * state.normal, h * state.tangential, h * state.torque };
}

void ContactSeam::gather(Scene& scene, Resident& from, const Vector3r& gravity, const Relaxation& how, int threadCount)
{
	relaxation = how;
	recalls    = 0;
	meets      = 0;
	slides     = 0;
	followed   = false;
	threads    = threadCount;
	resident   = &from;
	gatherBodies(scene, gravity);
	takeGivenMotion(scene);
	checkShapes(scene, resident->bodies, resident->shaped);
	if (materialsOf != resident->taken) {
		checkMaterials(scene, resident->bodies);
		surfaces = slipSurfacesOf(scene);
		for (auto* surface : surfaces)
			surface->open(scene, relaxation.step);
	}
	materialsOf = resident->taken;
	divide(scene);
	const auto&  order = resident->order;
	const size_t count = order.size(), solved = solvedBefore.back(), leftOut = leftBefore.back();
	problem.contacts.resize(solved);
	problem.impulses.resize(solved);
	warmStart.resize(solved);
	links.resize(solved);
	leftContacts.resize(leftOut);
	leftLinks.resize(leftOut);
	joints.resize(chunksOf(count));
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long part = 0; part < (long)chunksOf(count); ++part) {
		const size_t begin = part * sumChunk;
		size_t       in = solvedBefore[part], left = leftBefore[part];
		joints[part].clear();
		for (size_t k = begin; k < std::min(begin + sumChunk, count); ++k) {
			const int slot = order[k].slot;
			if (k + later < count) fetch<commonOfState>(&resident->states[order[k + later].slot]);
			if (partOf[k] == Solved) {
				if (in + later < solved) {
					fetch<sizeof(Contact)>(&problem.contacts[in + later]);
					fetch<1>(&problem.impulses[in + later]);
					fetch<1>(&warmStart[in + later]);
				}
				problem.impulses[in] = warmStart[in] = gatherContact(
				        slot, problem.contacts[in], links[in]);
				if (ContactState& r = resident->states[slot]; r.joins) {
					joints[part].push_back(in);
					setJoins(r, false);
				}
				++in;
			} else if (partOf[k] == Left) {
				gatherContact(slot, leftContacts[left], leftLinks[left]);
				forgetReactions(slot);
				++left;
			}
		}
	}
	loadClusters();
}

/// A contact that is left out of the solve bears nothing.
void ContactSeam::forgetReactions(int slot)
{
	ContactState& r = resident->states[slot];
	r.leftOut = r.reacts = true;
	if (r.normal == 0) return;
	r.normal = r.tangential = r.torque = r.correction = 0;
	if (r.keeper != ContactState::Arrays) writeReactions(r);
}

void ContactSeam::gatherBodies(Scene& scene, const Vector3r& gravity)
{
	const auto& read = resident->bodies;
	const long  size = (long)read.size();
	// also what a script or an engine after the integrator has added to a list that counts as summed up:
	// ForceResetter does not see it
	scene.forces.addMaxId(Body::id_t(size));
	scene.forces.synced = false;
	scene.forces.sync();
	for (auto* v : { &problem.freeVelocity, &before })
		v->resize(size);
	external.resize(size);
	for (auto* v : { &radius, &mass, &inertia })
		v->resize(size);
	problem.inverseMass.resize(size);
	problem.positions.resize(size);
	present.resize(size);
	const Real h     = relaxation.step;
	const auto first = std::find_if(read.begin(), read.end(), [](const BodyState& b) {
		return b.present && b.radius > 0;
	});
	const Real plane = first == read.end() ? 0 : first->z; // in which all disks lie
	int        bad   = -1; // body with an unusable state; reported after the loop, which must not throw
	bool       odd   = false; // some motion is not in the plane
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : bad) reduction(|| : odd)
	for (long id = 0; id < size; ++id) {
		const BodyState& s = read[id];
		auto&            w = problem.inverseMass[id];
		w                  = {};
		present[id]        = s.present;
		radius[id]         = s.radius;
		if (!s.present) {
			problem.freeVelocity[id] = before[id] = {};
			external[id]                          = {};
			problem.positions[id]                 = {};
			mass[id] = inertia[id] = 0;
			continue;
		}
		const unsigned d = s.blocked;
		odd              = odd || !s.planar;
		before[id]       = s.motion.velocity;
		mass[id]         = s.mass;
		inertia[id]      = s.inertia;
		if (!(d & State::DOF_X)) w.x = 1 / s.mass;
		if (!(d & State::DOF_Y)) w.y = 1 / s.mass;
		if (!(d & State::DOF_RZ)) w.w = 1 / s.inertia;
		const Vector3r &f = scene.forces.getForce(id), &m = scene.forces.getTorque(id);
		external[id]          = { f[0], f[1], m[2] };
		problem.positions[id] = s.motion.position;
		Twist v               = before[id];
		if (w.x > 0) v.x += h * (f[0] * w.x + gravity[0]);
		if (w.y > 0) v.y += h * (f[1] * w.y + gravity[1]);
		if (w.w > 0) v.w += h * m[2] * w.w;
		problem.freeVelocity[id] = v;

		const bool     moves = !w.isFixed(), out = f[2] != 0 || m[0] != 0 || m[1] != 0;
		const unsigned planar = State::DOF_Z | State::DOF_RX | State::DOF_RY;
		if (!std::isfinite(
		            v.x + v.y + v.w + s.motion.position.x + s.motion.position.y + s.motion.rotation.z
		            + s.motion.rotation.w + w.x + w.y + w.w)
		    || s.radius > hugest || (moves && (d & planar) != planar) || s.clumped
		    || (!(d & State::DOF_X) && !(w.x > 0)) || (!(d & State::DOF_Y) && !(w.y > 0))
		    || (!(d & State::DOF_RZ) && !(w.w > 0))
		    || (moves && out && leavesPlane(f, m, s.mass, s.inertia, gravity))
		    || (s.radius > 0 && !(std::abs(s.z - plane) <= flatness * s.radius)))
			bad = std::max(bad, (int)id);
	}
	turningOut = -1;
	for (long id = 0; id < size && odd && turningOut < 0; ++id)
		if (read[id].present && !read[id].planar) {
			const Vector3r& turn = (*scene.bodies)[id]->state->angVel;
			if (turn[0] != 0 || turn[1] != 0) turningOut = int(id);
		}
	if (bad >= 0) {
		const Body& body = *(*scene.bodies)[bad];
		if (body.isClump() || body.isClumpMember())
			refuse(body, "belongs to a clump",
			       "clumps are not supported: use single disks, which bonds can hold together (contactDynamics.bond())");
		if (read[bad].radius > hugest)
			refuse(body, "is a Sphere of radius " + number(read[bad].radius),
			       "give it a positive radius [m]");
		resident->showBody(bad);
		const State& s = *body.state;
		if (!std::isfinite(s.pos.sum() + s.vel.sum() + s.angVel.sum()))
			refuse(body, "has a position or velocity that is not finite",
			       "check the forces and velocities that the script sets");
		if (!std::isfinite(s.ori.coeffs().sum()))
			refuse(body, "has an orientation that is not finite",
			       "set state.ori = Quaternion((0, 0, 1), angle)");
		const unsigned free    = ~s.blockedDOFs;
		const auto     resists = [](Real value) {
                        return value > 0 && std::isfinite(value) && std::isfinite(1 / value);
		};
		if (((free & (State::DOF_X | State::DOF_Y)) && !resists(s.mass))
		    || ((free & State::DOF_RZ) && !resists(s.inertia[2])))
			refuse(body,
			       "can move but has mass = " + number(s.mass) + " kg and inertia = " + number(s.inertia[2])
			               + " kg m² about z",
			       "set state.mass and state.inertia to positive values of the body's size, or block its DOFs");
		if (read[bad].radius > 0 && !(std::abs(s.pos[2] - plane) <= flatness * read[bad].radius))
			refuse(body,
			       "is at z = " + number(s.pos[2]) + " m and body #" + std::to_string(first - read.begin())
			               + " at z = " + number(plane) + " m",
			       "put all disks at one z, since only the part of a contact in the x-y plane would act");
		for (const auto& [what, value] : { std::pair("force", scene.forces.getForce(bad)),
		                                   std::pair("torque", scene.forces.getTorque(bad)) })
			if (!std::isfinite(value.sum()))
				refuse(body, string("has a ") + what + " that is not finite",
				       "check the engines that add forces");
		const unsigned planar = State::DOF_Z | State::DOF_RX | State::DOF_RY;
		if ((s.blockedDOFs & planar) == planar) refuseForce(scene, bad);
		refuse(body, "can leave the x-y plane",
		       "set state.blockedDOFs = 'zXY' (the contact problem is two-dimensional)" + whoFrees(scene, bad));
	}
}

/// Bodies that others move by their positions are met with the velocity of that motion.
void ContactSeam::takeGivenMotion(const Scene& scene)
{
	for (const auto& [id, u] : givenMotion.take(scene, *resident))
		for (auto* velocities : { &before, &problem.freeVelocity }) {
			Twist& v = (*velocities)[id];
			v.x += u.x;
			v.y += u.y;
			v.w += u.w;
		}
}

/// Tells the contacts that need not be solved for from the others, and counts these, so that each can be gathered where
/// it stays.
void ContactSeam::divide(const Scene& scene)
{
	const auto&  order = resident->order;
	const size_t count = order.size();
	long         bad   = (long)count; // the first one that cannot be taken, reported after the loop
	partOf.resize(count);
	solvedBefore.assign(chunksOf(count) + 1, 0);
	leftBefore.assign(chunksOf(count) + 1, 0);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad)
	for (long part = 0; part < (long)chunksOf(count); ++part) {
		size_t solved = 0, left = 0;
		for (size_t k = part * sumChunk; k < std::min((part + 1) * sumChunk, count); ++k) {
			if (k + later < count && !resident->surelySolved[order[k + later].slot])
				fetch<1>(&resident->states[order[k + later].slot]);
			partOf[k] = None;
			if (resident->surelySolved[order[k].slot]) partOf[k] = Solved;
			else {
				const ContactState& state = resident->states[order[k].slot];
				if (!state.active || !present[state.first] || !present[state.second]) continue;
				if (!state.usable) bad = std::min(bad, (long)k);
				if (!state.cohesive) continue;
				partOf[k] = mustBeSolved(state) ? Solved : Left;
			}
			++(partOf[k] == Solved ? solved : left);
		}
		solvedBefore[part + 1] = solved;
		leftBefore[part + 1]   = left;
	}
	if (bad < (long)count) {
		resident->show();
		refuseContact(scene, resident->states[order[bad].slot]);
	}
	for (size_t part = 1; part < solvedBefore.size(); ++part) {
		solvedBefore[part] += solvedBefore[part - 1];
		leftBefore[part] += leftBefore[part - 1];
	}
}

/// A contact is left out where it is open and will not close in the step.
bool ContactSeam::mustBeSolved(const ContactState& state) const
{
	const Real widest = relaxation.openGap * state.length;
	if (state.bonded || state.broken != NscdPhys::None || state.gap <= widest) return true;
	Contact c;
	setFrame(state, c);
	const Real speed = contact::relativeVelocity(c, problem.freeVelocity[c.i], problem.freeVelocity[c.j]).n;
	return !staysOpen(state.gap, speed, relaxation.step, widest);
}

} // namespace yade::nscd
