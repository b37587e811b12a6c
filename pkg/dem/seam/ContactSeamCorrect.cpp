// Errors of position, overlaps and what bonds have moved without having yielded, taken back by displacements after the
// solve of a step: what they are, and what they do to bodies; and clusters of bonded bodies, which are turned as one so
// that no such error arises. The equations stand in contact/plane/solver.hpp (correctPositions),
// contact/plane/rigid_clusters.hpp and doc/theory/stepping.rst.
#include "ContactSeam.hpp"
#include "Prefetch.hpp"
#include <algorithm>
#include <cmath>
#include <contact/plane/bond.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
namespace plane   = contact::plane;
using contact::Contact;
using contact::Impulse;
using contact::RelativeVelocity;
using contact::Twist;

namespace {
	/// What of an error of a bond's length, either way, goes beyond the slack.
	Real beyond(Real error, Real slack) { return error - std::max(-slack, std::min(slack, error)); }

	/// Nothing for all bodies, where only those of the step before have something.
	template <class Value> void forget(std::vector<Value>& of, const std::vector<int>& those, size_t count)
	{
		if (of.size() != count) of.assign(count, {});
		else
			for (const int body : those)
				of[body] = {};
	}
}

/// Bodies that were turned as one in the step before bear the centrifugal force.
void ContactSeam::loadClusters()
{
	findClusters();
	if (clusters.count() == 0 && loaded.empty()) return;
	forget(centrifugal, loaded, before.size());
	loaded.clear();
	const auto bodies = bodyArrays();
	for (size_t s = 0; s < clusters.count(); ++s) {
		const int *first = clusters.first(s), *last = clusters.last(s);
		const auto axes = plane::axesOf(bodies, before, first, last);
		if (!axes.turns) continue;
		plane::load(bodies, axes, relaxation.step, first, last, centrifugal);
		loaded.insert(loaded.end(), first, last);
		for (const int* b = first; b != last; ++b) {
			problem.freeVelocity[*b].x += centrifugal[*b].x;
			problem.freeVelocity[*b].y += centrifugal[*b].y;
		}
	}
}

/// Of the bodies of the contacts in `joints`.
void ContactSeam::findClusters()
{
	std::vector<plane::RigidClusters::Joint> pairs;
	for (const auto& part : joints)
		for (const size_t k : part)
			pairs.emplace_back(problem.contacts[k].i, problem.contacts[k].j);
	clusters.find(pairs, before.size());
}

/// Turns the bodies as one which move so: those that contacts in `joints` hold together.
void ContactSeam::turnClusters()
{
	findClusters();
	if (clusters.count() == 0 && turned.empty()) return;
	forget(clusterWay, turned, before.size());
	forget(clusterTurn, turned, before.size());
	forget(isTurned, turned, before.size());
	turned.clear();
	const auto bodies = bodyArrays();
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
	for (long s = 0; s < (long)clusters.count(); ++s) {
		const int *first = clusters.first(s), *last = clusters.last(s);
		const auto axes = plane::axesOf(bodies, problem.velocities, first, last);
		if (!axes.turns || !plane::movesRigidly(bodies, problem.velocities, axes, first, last)) continue;
		plane::turn(bodies, problem.velocities, axes, relaxation.step, first, last, clusterWay, clusterTurn);
		for (const int* body = first; body != last; ++body)
			isTurned[*body] = true;
	}
	for (size_t s = 0; s < clusters.count(); ++s)
		if (isTurned[*clusters.first(s)]) turned.insert(turned.end(), clusters.first(s), clusters.last(s));
	for (const auto& part : joints)
		for (const size_t k : part)
			if (isTurned[problem.contacts[k].i]) setJoins(resident->states[links[k].slot], true);
}

/// Whether the frame of a contact turns by so much in the step that its bodies, where a bond holds them, are turned as
/// one.
[[gnu::always_inline]] inline bool ContactSeam::turnsFar(const Contact& c) const
{
	constexpr Real far
	        = 1e-4; // rad; what less does is next to nothing: a third of its cube to angles, half of its square to lengths, which are taken back
	const auto &vi = problem.velocities[c.i], &vj = problem.velocities[c.j];
	const bool  passes = std::abs(relaxation.step * contact::passingSpeed(c, vi, vj))
	        > far * (c.leverTi - c.leverTj),
	           spins = std::abs(relaxation.step * vi.w) > far;
	if (!passes && !spins) return false; // most, of which the radius in memory is not asked for
	return radius[c.i] < 0 ? spins : passes;
}

/// Whether a bond holds along the normal and does not slide.
[[gnu::always_inline]] inline bool ContactSeam::sticks(size_t k, const RelativeVelocity& u) const
{
	const Contact& c = problem.contacts[k];
	const Impulse& p = problem.impulses[k];
	if (c.play > 0) { // at touch or at its length from the beginning of the step on, and pressed there or pulled
		const Real left = relaxation.step * (p.n > 0 ? c.biasN : c.play - c.biasN);
		if (p.n == 0 || left > relaxation.slack * c.length) return false;
	}
	return !plane::yieldsInTension(c, p, u) && !plane::yieldsInShear(c, p);
}

/// What a contact asks of the positions at the end of the step; `u`: its velocities then, `turns`: its bond is one of
/// bodies that turn as one.
[[gnu::always_inline]] inline contact::PositionError
ContactSeam::errorOf(size_t k, const RelativeVelocity& u, bool turns) const
{
	const Real             h = relaxation.step, most = h * relaxation.largestSpeed;
	const Contact&         c = problem.contacts[k];
	const Impulse&         p = problem.impulses[k];
	const ContactState&    r = stateOf(links[k]);
	contact::PositionError e;
	e.impulse = links[k].correction;
	// a bond that opens keeps its new length
	e.held = r.bonded && !plane::yieldsInTension(c, p, u);
	// of what was wrong before the step the share 1 − κ may stay; what the step adds may not
	const auto taken = [this](Real off, Real end, Real slack) {
		return beyond(end, slack) - (1 - relaxation.rate) * beyond(off, slack);
	};
	const auto limited = [](Real error, Real bound) { return std::max(-bound, std::min(bound, error)); };
	const Real slack = relaxation.slack * c.length, rest = e.held ? r.restGap : 0, off = r.gap - rest,
	           end = gapOf(c, r) - rest + h * u.n - (r.curved ? bendOf(r, c) : 0);
	e.error        = e.held ? taken(off, end, slack)
	                        : end + slack - (1 - relaxation.rate) * std::min(Real(0), off + slack);
	if (e.held || e.error < 0) e.error = limited(e.error, most);
	if (e.held && c.play > 0) { // between touch and its length nothing is wrong
		const Real stays   = 1 - relaxation.rate;
		const Real touched = end + rest + slack - stays * std::min(Real(0), r.gap + slack),
		           drawn   = end - slack - stays * std::max(Real(0), off - slack);
		e.error            = std::max(-most, touched);
		e.play             = std::max(Real(0), e.error - std::min(most, drawn));
	}
	if (!turns) return e;
	// what it has yielded it keeps too
	e.sticks = true;
	e.grips  = !plane::yieldsInTorque(c, p);
	// sweeps with three rows cost twice as much as along the normals alone: not for bonds that creep along the edge
	// of the slack
	constexpr Real asking = 1.25; // slacks
	const Real     angle  = 2 * relaxation.slack; // by which a rim is off by the slack
	const Real     slip = r.slip + h * u.t, turn = r.turn + h * u.r;
	if (std::abs(slip) > asking * slack) e.slip = static_cast<float>(limited(taken(r.slip, slip, slack), most));
	if (e.grips && std::abs(turn) > asking * angle)
		e.turn = static_cast<float>(limited(taken(r.turn, turn, angle), 2 * most / c.length));
	return e;
}

void ContactSeam::correct(const contact::SolverSettings& settings, contact::Workspace& workspace, int sweeps)
{
	correction.displacements.clear();
	correction.tangential.clear();
	const bool   corrects = sweeps > 0 && relaxation.rate > 0;
	const size_t count    = links.size();
	bool         any = false, anyAcross = false;
	errors.resize(count);
	joints.resize(chunksOf(count));
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : any, anyAcross)
	for (long part = 0; part < (long)chunksOf(count); ++part) {
		joints[part].clear();
		for (size_t k = part * sumChunk; k < std::min((part + 1) * sumChunk, count); ++k) {
			if (k + later < count) fetch<1>(&stateOf(links[k + later]));
			const Contact&         c = problem.contacts[k];
			const RelativeVelocity u = contact::relativeVelocity(
			        c, problem.velocities[c.i], problem.velocities[c.j]);
			const bool turns = stateOf(links[k]).bonded && turnsFar(c) && sticks(k, u);
			if (turns) joints[part].push_back(k);
			if (!corrects) continue;
			const auto& e = errors[k] = errorOf(k, u, turns);
			any                       = any
			        || (!e.held || e.play > 0 ? e.error < 0 || (e.held && e.error > e.play) : e.error != 0);
			anyAcross = anyAcross || e.asksAcross();
		}
	}
	turnClusters();
	if (any || anyAcross)
		contact::correctPositions(problem, settings, workspace, errors, sweeps, correction, anyAcross);
}

/// Two bodies that are drawn together or apart while they pass each other would change their angular momentum, Σ m D ×
/// v: a pair of tangential impulses takes that back, as for bodies on a string that is shortened. Exact for the
/// positions at the end of the step, and the velocities then.
[[gnu::always_inline]] inline void ContactSeam::turnBack(size_t k)
{
	const Contact& c    = problem.contacts[k];
	const auto     free = [this](int body) {
                return problem.inverseMass[body].x > 0 && problem.inverseMass[body].x == problem.inverseMass[body].y;
	};
	if (!free(c.i) || !free(c.j)) return; // what holds a body takes its angular momentum
	const Twist &vi = problem.velocities[c.i], &vj = problem.velocities[c.j];
	Real         dx = vj.x - vi.x, dy = vj.y - vi.y;
	if (turnsAsOne(c.i) || turnsAsOne(c.j)) {
		dx = (vj.x + clusterTurn[c.j].x) - (vi.x + clusterTurn[c.i].x);
		dy = (vj.y + clusterTurn[c.j].y) - (vi.y + clusterTurn[c.i].y);
	}
	const Twist di = displacementOf(c.i), dj = displacementOf(c.j);
	const auto &xi = problem.positions[c.i], &xj = problem.positions[c.j];
	const Real  distance = c.nx * (xj.x + dj.x - xi.x - di.x) + c.ny * (xj.y + dj.y - xi.y - di.y);
	if (!(distance > 0)) return;
	Real moment = correction.impulses[k] * (-c.ny * dx + c.nx * dy); // Q × v
	if (!correction.tangential.empty()) moment -= correction.tangential[k] * (c.nx * dx + c.ny * dy);
	const Real p = -moment / distance;
	turning[c.i].x += c.ny * p;
	turning[c.i].y -= c.nx * p;
	turning[c.j].x -= c.ny * p;
	turning[c.j].y += c.nx * p;
}

/// What turns clusters, and what keeps the angular momentum of all contacts that are corrected, in their order.
void ContactSeam::turnBack()
{
	turning.assign(before.size(), {});
	for (const int id : turned)
		turning[id] = { mass[id] * clusterTurn[id].x, mass[id] * clusterTurn[id].y, 0 };
	if (correction.displacements.empty()) return;
	for (size_t k = 0; k < links.size(); ++k)
		if (correction.impulses[k] != 0 || (!correction.tangential.empty() && correction.tangential[k] != 0))
			turnBack(k);
}

/// Moves bodies by their displacements. NewtonIntegrator adds the path of the step.
void ContactSeam::displace(size_t begin, size_t end)
{
	if (correction.displacements.empty() && turned.empty() && !followed) return;
	for (size_t id = begin; id < end; ++id) {
		const Twist d = displacementOf(id);
		if (!present[id] || (d.x == 0 && d.y == 0 && d.w == 0)) continue;
		resident->displace(id, d);
	}
}

} // namespace yade::nscd
