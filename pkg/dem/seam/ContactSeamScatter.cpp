// What a step's solution means for YADE: reactions and forces written back, and the sums over contacts and bodies.
#include "ContactSeam.hpp"
#include "Prefetch.hpp"
#include <algorithm>
#include <atomic>
#include <contact/plane/law.hpp>
#include <contact/plane/bond.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;
using contact::Impulse;
using contact::RelativeVelocity;
using contact::Twist;
using contact::Wrench;

void StepSums::add(const StepSums& other)
{
	sliding += other.sliding;
	slidingOnWalls.insert(slidingOnWalls.end(), other.slidingOnWalls.begin(), other.slidingOnWalls.end());
	rolling += other.rolling;
	debonding += other.debonding;
	impact += other.impact;
	heldWork += other.heldWork;
	missed += other.missed;
	overlap += other.overlap;
	if (other.worstOverlap > worstOverlap) {
		worstOverlap = other.worstOverlap;
		std::copy_n(other.worstIds, 2, worstIds);
	}
	contactRate = std::max(contactRate, other.contactRate);
	bondRate    = std::max(bondRate, other.bondRate);
	touching += other.touching;
	bonds += other.bonds;
	for (size_t m = 0; m < std::size(broken); ++m)
		broken[m] += other.broken[m];
	kinetic += other.kinetic;
	potential += other.potential;
	external += other.external;
	wallWork += other.wallWork;
	correction += other.correction;
	kineticLeft += other.kineticLeft;
	potentialLeft += other.potentialLeft;
	size += other.size;
	mass += other.mass;
	speed += other.speed;
	largestSpeed = std::max(largestSpeed, other.largestSpeed);
	centre += other.centre;
	momentum += other.momentum;
	bodies += other.bodies;
}

/// Takes a contact's reactions to where it is kept, and what a bond has yielded; u: its velocities at the end of the
/// step. Returns whether it is a bond that opened neither in this step nor in the one before.
[[gnu::always_inline]] inline bool
ContactSeam::scatterContact(size_t k, const RelativeVelocity& u, ContactState& r) const
{
	const Real     h    = relaxation.step;
	const Contact& c    = problem.contacts[k];
	const Impulse  p    = followed ? impulseOfStep(k) : problem.impulses[k];
	r.normal            = p.n / h;
	r.tangential        = p.t / h;
	r.torque            = p.r / h;
	r.correction        = correction.displacements.empty() ? 0 : correction.impulses[k];
	r.reacts            = true;
	r.leftOut           = false;
	const bool inArrays = r.keeper == ContactState::Arrays;
	if (!inArrays) writeReactions(r);
	if (!inArrays || r.broken != NscdPhys::None) r.phys->yielded = r.phys->slid = r.phys->rolled = false;
	if (r.broken != NscdPhys::None) r.phys->breaks = false; // it is counted now
	if (!r.bonded) return false;
	const auto path  = contact::plane::yieldOfStep(c, p, u, h);
	const bool opens = contact::plane::yieldsInTension(c, p, u), slides = path.shear != 0, rolls = path.torque != 0;
	const bool held = !opens && !r.yielded;
	r.yielded       = opens;
	r.slid          = slides;
	r.rolled        = rolls;
	if (path.any()) r.path.add(path); // seldom, and what is not written need not go back to memory
	if (inArrays) return held;
	r.phys->yielded = opens;
	r.phys->slid    = slides;
	r.phys->rolled  = rolls;
	r.phys->yieldPath += vectorOf(path);
	return held;
}

/// How fast a contact turns and its bond crosses its ellipse at the end of the step. What divisions and roots give,
/// which are slow, is found only where it may be the largest.
[[gnu::always_inline]] inline void
ContactSeam::rateContact(size_t k, const RelativeVelocity& u, const ContactState& r, ContactSums& sums) const
{
	constexpr Real nearly = 1 - 1e-9; // more than rounding takes away
	const Contact& c      = problem.contacts[k];
	const Twist &  vi = problem.velocities[c.i], &vj = problem.velocities[c.j];
	const bool     wall = radius[c.i] < 0 || radius[c.j] < 0;
	const Real     dx = vj.x - vi.x, dy = vj.y - vi.y, most = sums.contactRate * c.length;
	if (wall) sums.contactRate = std::max(sums.contactRate, std::abs(u.n) / c.length);
	else if (!(dx * dx + dy * dy < nearly * most * most))
		sums.contactRate = std::max(sums.contactRate, std::sqrt(dx * dx + dy * dy) / c.length);
	if (!r.bonded) return;
	const bool  inArrays = r.keeper == ContactState::Arrays;
	const auto& zone     = resident->bonds[links[k].slot].zone;
	const Real  along    = inArrays ? zone.normal : r.phys->ellipseNormal,
	           across    = inArrays ? zone.tangential : r.phys->ellipseTangential;
	if (std::abs(u.n) < nearly * sums.bondRate * along && std::abs(u.t) < nearly * sums.bondRate * across) return;
	sums.bondRate = std::max(sums.bondRate, std::max(std::abs(u.n) / along, std::abs(u.t) / across));
}

/// In ℓ. Of two bodies that are held nothing is to be corrected: a floor may be made of disks that overlap.
[[gnu::always_inline]] inline Real ContactSeam::overlapOf(size_t k, const ContactState& r) const
{
	const Contact& c      = problem.contacts[k];
	const bool     placed = problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed() && r.gap < 0;
	return placed ? 0 : std::max(Real(0), -r.gap) / c.length;
}

int ContactSeam::overlapsOf(Real least) const
{
	int count = 0;
	for (size_t k = 0; k < links.size(); ++k)
		count += overlapOf(k, stateOf(links[k])) >= least;
	return count;
}

/// Returns what it has slid on a wall [J].
[[gnu::always_inline]] inline Real
ContactSeam::sumContact(size_t k, const RelativeVelocity& u1, const ContactState& r, bool held, ContactSums& sums) const
{
	const Contact&         c  = problem.contacts[k];
	const Impulse&         p  = problem.impulses[k];
	const RelativeVelocity u0 = contact::relativeVelocity(c, before[c.i], before[c.j]);
	// work of the impulse over the step, exact for constant mass: P·(U⁻ + U⁺)/2
	const Real normalWork = 0.5 * p.n * (u0.n + u1.n);
	// all, since which one it is cannot be told ahead; tension in a bond that does not open loses nothing
	const bool draws = p.n < 0;
	// but for what comes to its end in a bond that closes freely: that is an impact, as what comes to touch
	const bool jerks = draws && held && c.play > 0;
	sums.debonding -= draws && !held ? normalWork : 0;
	sums.heldWork += draws && held && !jerks ? normalWork : 0;
	sums.impact -= draws && !jerks ? 0 : normalWork;
	const Real shearWork = 0.5 * p.t * (u0.t + u1.t);
	sums.sliding -= shearWork;
	sums.rolling -= 0.5 * p.r * (u0.r + u1.r);
	// a gap that closes in the step as others push: its restitution is lost
	if (r.bounces && !r.bonded && c.biasN > 0 && p.n > 0)
		sums.missed -= r.restitution * r.restitution * std::min(Real(0), normalWork);
	const auto* impacts = impactsAt(links[k]); // which came before
	if (impacts) {
		sums.impact += impacts->normalLoss;
		sums.sliding += impacts->slidingLoss;
		sums.rolling += impacts->rollingLoss;
	}
	const Real overlap = overlapOf(k, r);
	sums.overlap += overlap;
	if (overlap > sums.worstOverlap) {
		sums.worstOverlap = overlap;
		sums.worstIds[0]  = std::min(c.i, c.j);
		sums.worstIds[1]  = std::max(c.i, c.j);
	}
	sums.touching += (p.n != 0) | (r.gap <= 0) | (impacts != nullptr);
	sums.bonds += r.bonded;
	if (r.broken != NscdPhys::None) ++sums.broken[r.broken];
	return radius[c.i] < 0 || radius[c.j] < 0 ? (impacts ? impacts->slidingLoss : 0) - shearWork : 0;
}

/// Reactions and sums of some contacts; `slips`: whether any of them counts the path of its slip.
void ContactSeam::scatterContacts(size_t begin, size_t end, bool rates, StepSums& result, char& slips)
{
	const size_t count = links.size();
	ContactSums
	        sums; // by themselves, since what lies in `result` shares cache lines with other threads', and no register may hold it
	bool anySlips = false;
	for (size_t k = begin; k < end; ++k) {
		if (k + later < count) {
			fetch<commonOfState>(&stateOf(links[k + later]));
			if (rates) fetch<1>(&resident->bonds[links[k + later].slot].zone);
		}
		const Contact&         c = problem.contacts[k];
		ContactState&          r = resident->states[links[k].slot];
		const RelativeVelocity u = contact::relativeVelocity(
		        c, problem.velocities[c.i], problem.velocities[c.j]);
		const bool held = scatterContact(k, u, r);
		anySlips |= r.slips;
		if (const Real slid = sumContact(k, u, r, held, sums); slid != 0)
			result.slidingOnWalls.emplace_back(radius[c.i] < 0 ? c.i : c.j, slid);
		if (rates) rateContact(k, u, r, sums);
	}
	static_cast<ContactSums&>(result) = sums;
	slips                             = anySlips;
}

Sliding ContactSeam::slidingOf(size_t k, long number) const
{
	const Contact&         c = problem.contacts[k];
	const Real             h = relaxation.step, pressed = impulseOfStep(k).n;
	const RelativeVelocity u0      = contact::relativeVelocity(c, before[c.i], before[c.j]);
	const RelativeVelocity u1      = contact::relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
	const auto*            impacts = impactsAt(links[k]);
	Sliding                s;
	s.number    = number;
	s.way       = std::abs(h * u1.t);
	s.speed     = std::abs(u1.t);
	s.meanSpeed = 0.5 * std::abs(u0.t + u1.t);
	s.pressed   = pressed;
	s.lost      = (impacts ? impacts->slidingLoss : 0)
	        - 0.5 * problem.impulses[k].t * (u0.t + u1.t); // as sumContact has it
	s.bears = pressed + c.adhesion > 0;
	s.place = stateOf(links[k]).geom->contactPoint;
	return s;
}

StepSums ContactSeam::scatter(Scene& scene, const Vector3r& gravity, int threadCount, bool rates)
{
	threads = threadCount;
	force.resize(before.size());
	const Real            h     = relaxation.step;
	const size_t          count = links.size(), chunksC = chunksOf(count), chunksB = chunksOf(before.size());
	std::vector<StepSums> parts(chunksC + chunksB);
	std::vector<char>     slip(chunksC, 0);
#pragma omp parallel num_threads(threads)
	{
		// each by one thread, since a sum depends on its order; the others go on, and take more of what follows
#pragma omp single nowait
		sumReactions();
#pragma omp single nowait
		turnBack();
#pragma omp for schedule(dynamic, 1)
		for (long part = 0; part < (long)chunksC; ++part)
			scatterContacts(
			        part * sumChunk, std::min((part + 1) * sumChunk, count), rates, parts[part],
			        slip[part]);
#pragma omp for schedule(static)
		for (long k = 0; k < (long)chunksB; ++k) {
			const size_t begin = k * sumChunk, end = std::min(begin + sumChunk, before.size());
			scatterForces(scene, begin, end);
			displace(begin, end);
			StepSums sums;
			sumBodies(gravity, begin, end, sums);
			parts[chunksC + k] = sums;
		}
	}

	// slip goes into materials that many contacts share, so one after the other; O.iter would come again after
	// O.resetTime()
	static std::atomic<long> allSteps { 0 };
	const long               number = ++allSteps;
	for (size_t part = 0; part < chunksC; ++part)
		for (size_t k = part * sumChunk; slip[part] && k < std::min((part + 1) * sumChunk, count); ++k) {
			const ContactState& r = stateOf(links[k]);
			if (r.slips) r.phys->noteSliding(slidingOf(k, number));
		}
	for (auto* surface : surfaces)
		surface->close(h);
	broken.clear();
	for (size_t part = 0; part < chunksC; ++part)
		for (size_t k = part * sumChunk; parts[part].anyBroken() && k < std::min((part + 1) * sumChunk, count);
		     ++k)
			if (stateOf(links[k]).broken != NscdPhys::None) broken.push_back(k);
	givenMotion.leave(scene, *resident, h);
	StepSums total;
	for (const StepSums& s : parts)
		total.add(s);
	return total;
}

/// The sum of the contacts' impulses on every body, walls included.
void ContactSeam::sumReactions()
{
	reaction.assign(before.size(), {});
	for (size_t k = 0; k < links.size(); ++k) {
		const Contact& c  = problem.contacts[k];
		const Impulse& p  = problem.impulses[k];
		const Real     fx = c.nx * p.n - c.ny * p.t, fy = c.ny * p.n + c.nx * p.t;
		Wrench &       ri = reaction[c.i], &rj = reaction[c.j];
		ri.x -= fx;
		ri.y -= fy;
		ri.w -= c.leverNi * p.n + c.leverTi * p.t + p.r;
		rj.x += fx;
		rj.y += fy;
		rj.w += c.leverNj * p.n + c.leverTj * p.t + p.r;
	}
}

/// O.forces gets them as the step's mean forces.
void ContactSeam::scatterForces(Scene& scene, size_t begin, size_t end)
{
	const Real h = relaxation.step;
	for (size_t id = begin; id < end; ++id) {
		force[id] = external[id];
		Wrench r  = reaction[id];
		r.x += turning[id].x;
		r.y += turning[id].y;
		if (!loaded.empty()) {
			r.x += mass[id] * centrifugal[id].x;
			r.y += mass[id] * centrifugal[id].y;
		}
		if (followed) {
			const Wrench& p = sequence.flights[id].impulse;
			r               = { r.x + p.x, r.y + p.y, r.w + p.w };
		}
		if (r.x == 0 && r.y == 0 && r.w == 0) continue;
		const Wrench mean { r.x / h, r.y / h, r.w / h };
		scene.forces.addForceUnsynced(id, Vector3r(mean.x, mean.y, 0)); // into the sums, see gatherBodies
		scene.forces.addTorqueUnsynced(id, Vector3r(0, 0, mean.w));
		Wrench& all = force[id]; // added as there
		all         = { all.x + mean.x, all.y + mean.y, all.w + mean.w };
	}
}

void ContactSeam::sumBodies(const Vector3r& gravity, size_t begin, size_t end, StepSums& sums) const
{
	for (size_t id = begin; id < end; ++id) {
		if (!present[id]) continue;
		const Twist & v0 = before[id], &v1 = problem.velocities[id];
		const Wrench &r = reaction[id], &f = external[id];
		const auto&   w = problem.inverseMass[id];
		// where the motion is given, the work that the contacts do on it goes outside; elsewhere other engines'
		// forces work
		const Real half = 0.5 * relaxation.step, x = v0.x + v1.x, y = v0.y + v1.y, a = v0.w + v1.w;
		sums.wallWork -= 0.5 * ((w.x > 0 ? 0 : r.x * x) + (w.y > 0 ? 0 : r.y * y) + (w.w > 0 ? 0 : r.w * a));
		if (followed) sumImpacts(id, gravity, sums);
		if (w.isFixed()) continue;
		// and so does the work of what holds the weight of a body that is free along another direction
		sums.wallWork -= relaxation.step * mass[id]
		        * ((w.x > 0 ? 0 : gravity[0] * v1.x) + (w.y > 0 ? 0 : gravity[1] * v1.y));
		sums.external += half * ((w.x > 0 ? f.x * x : 0) + (w.y > 0 ? f.y * y : 0) + (w.w > 0 ? f.w * a : 0));
		// energies at the beginning of the step, like the positions they belong to
		const Twist& start     = followed ? begun[id] : v0;
		const auto   kineticOf = [&](const Twist& v) {
                        return 0.5 * (mass[id] * (v.x * v.x + v.y * v.y) + inertia[id] * v.w * v.w);
		};
		const Real     kinetic = kineticOf(start);
		const Vector3r at(problem.positions[id].x, problem.positions[id].y, 0);
		const Real     potential = mass[id] * gravity.dot(at);
		sums.kinetic += kinetic;
		sums.potential -= potential;
		sums.size += kinetic + std::abs(potential);
		// as the integrator will have them, with its own operations: nobody has brought anything where the next
		// step begins with the same bits
		const Real    h   = relaxation.step;
		const Wrench& all = force[id];
		const Twist   left { start.x + h * (w.x > 0 ? 0.0 + (all.x / mass[id] + gravity[0]) : 0.0),
                                   start.y + h * (w.y > 0 ? 0.0 + (all.y / mass[id] + gravity[1]) : 0.0),
                                   start.w + h * (w.w > 0 ? 0.0 + all.w / inertia[id] : 0.0) };
		const Twist   way = displacementOf(id);
		sums.kineticLeft += kineticOf(left);
		sums.potentialLeft -= mass[id]
		        * gravity.dot(Vector3r(at[0] + way.x + left.x * h, at[1] + way.y + left.y * h, 0));
		// what errors of position cost: the way of the weight, and what the pairs of impulses give
		Twist v2 = v1;
		if (!correction.displacements.empty() || !turned.empty()) {
			const Twist   d = correctionOf(id);
			const Wrench& p = turning[id];
			v2.x += w.x * p.x;
			v2.y += w.y * p.y;
			sums.correction += 0.5 * (p.x * (v1.x + v2.x) + p.y * (v1.y + v2.y))
			        - mass[id] * gravity.dot(Vector3r(d.x, d.y, 0));
			// gravity works on the mean velocity of the step, also of what a cluster that hangs on a body
			// that is held turns; in pairs it is none
			if (turnsAsOne(id))
				sums.correction -= 0.5 * h * mass[id]
				        * gravity.dot(Vector3r(clusterTurn[id].x, clusterTurn[id].y, 0));
		}
		// the centrifugal force does no work on what turns as one, but on what leaves it
		if (!loaded.empty())
			sums.correction += 0.5 * mass[id] * (centrifugal[id].x * x + centrifugal[id].y * y);
		sums.mass += mass[id];
		sums.centre += mass[id] * at;
		sums.momentum += mass[id] * Vector3r(v2.x, v2.y, 0);
		const Real speed = std::sqrt(
		        v2.x * v2.x + v2.y * v2.y); // not hypot, whose last bit is the C library's own
		sums.speed += speed;
		sums.largestSpeed = std::max(sums.largestSpeed, speed);
		++sums.bodies;
	}
}

} // namespace yade::nscd
