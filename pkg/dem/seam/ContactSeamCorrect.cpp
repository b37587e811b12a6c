// Errors of position, overlaps and what bonds have moved without having yielded, taken back by displacements after the solve of a step: what they are, and what they
// do to bodies; and clusters of bonded bodies, which are turned as one so that no such error arises.
// The equations stand in contact/solver.hpp (correctPositions), contact/plane/rigid_clusters.hpp and doc/theory/stepping.rst.
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
using contact::Twist;

namespace {
	/// What of an error of a bond's length, either way, goes beyond the slack.
	Real beyond(Real error, Real slack) { return error - std::max(-slack, std::min(slack, error)); }
}

/// Bodies that were turned as one in the step before bear the centrifugal force.
void ContactSeam::loadClusters()
{
	centrifugal.clear();
	findClusters();
	if (clusters.count() == 0) return;
	centrifugal.resize(before.size());
	const auto bodies = bodyArrays();
	for (size_t s = 0; s < clusters.count(); ++s) {
		const int *first = clusters.first(s), *last = clusters.last(s);
		const auto axes = plane::axesOf(bodies, before, first, last);
		if (!axes.turns) continue;
		plane::load(bodies, axes, relaxation.step, first, last, centrifugal);
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
	clusterWay.clear();
	clusterTurn.clear();
	findClusters();
	if (clusters.count() == 0) return;
	clusterWay.resize(before.size());
	clusterTurn.resize(before.size());
	const auto        bodies = bodyArrays();
	std::vector<char> turned(before.size(), false);
	for (size_t s = 0; s < clusters.count(); ++s) {
		const int *first = clusters.first(s), *last = clusters.last(s);
		const auto axes = plane::axesOf(bodies, problem.velocities, first, last);
		if (!axes.turns || !plane::movesRigidly(bodies, problem.velocities, axes, first, last)) continue;
		plane::turn(bodies, problem.velocities, axes, relaxation.step, first, last, clusterWay, clusterTurn);
		for (const int* b = first; b != last; ++b)
			turned[*b] = true;
	}
	for (const auto& part : joints)
		for (const size_t k : part)
			if (turned[problem.contacts[k].i]) setJoins(resident->readings[links[k].slot], true);
}

/// Whether the frame of a contact turns by so much in the step that its bodies, where a bond holds them, are turned as one.
[[gnu::always_inline]] inline bool ContactSeam::turnsFar(const Contact& c) const
{
	constexpr Real far = 1e-4; // rad; what less does to a bond is taken back like any other error of position
	const auto &   vi = problem.velocities[c.i], &vj = problem.velocities[c.j];
	if (radius[c.i] < 0) return std::abs(relaxation.step * vi.w) > far;
	return std::abs(relaxation.step * contact::passingSpeed(c, vi, vj)) > far * (c.leverTi - c.leverTj);
}

/// What a contact asks of the positions at the end of the step; `u`: its velocities then.
[[gnu::always_inline]] inline contact::PositionError ContactSeam::errorOf(size_t k, const Impulse& u, bool sticks) const
{
	const Real             h = relaxation.step, most = h * relaxation.largestSpeed;
	const Contact&         c = problem.contacts[k];
	const Impulse&         p = problem.impulses[k];
	const Reading&         r = readingOf(links[k]);
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
	if (!r.bonded) return e;
	// what it has yielded it keeps too
	e.sticks = sticks;
	e.grips  = e.held && !plane::yieldsInTorque(c, p);
	// sweeps with three rows cost twice as much as along the normals alone: not for bonds that creep along the edge of the slack
	constexpr Real asking = 1.25; // slacks
	const Real     angle  = 2 * relaxation.slack; // by which a rim is off by the slack
	const Real     slip = r.slip + h * u.t, turn = r.turn + h * u.r;
	if (e.sticks && std::abs(slip) > asking * slack)
		e.slip = static_cast<float>(limited(taken(r.slip, slip, slack), most));
	if (e.grips && std::abs(turn) > asking * angle)
		e.turn = static_cast<float>(limited(taken(r.turn, turn, angle), 2 * most / c.length));
	return e;
}

void ContactSeam::correct(const contact::SolverSettings& settings, contact::Workspace& workspace, int sweeps)
{
	correction.displacements.clear();
	const bool   corrects = sweeps > 0 && relaxation.rate > 0;
	const size_t count    = links.size();
	bool         any      = false;
	errors.resize(count);
	joints.resize(chunksOf(count));
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : any)
	for (long part = 0; part < (long)chunksOf(count); ++part) {
		joints[part].clear();
		for (size_t k = part * sumChunk; k < std::min((part + 1) * sumChunk, count); ++k) {
			if (k + later < count) fetch<1>(&readingOf(links[k + later]));
			const Contact& c = problem.contacts[k];
			const Impulse& p = problem.impulses[k];
			const Impulse  u = contact::relativeVelocity(
			         c, problem.velocities[c.i], problem.velocities[c.j]);
			const bool sticks = readingOf(links[k]).bonded && !plane::yieldsInTension(c, p, u)
			        && !plane::yieldsInShear(c, p);
			if (sticks && turnsFar(c)) joints[part].push_back(k);
			if (!corrects) continue;
			const auto& e = errors[k] = errorOf(k, u, sticks);
			any                       = any || (e.held ? e.error != 0 : e.error < 0) || e.asksAcross();
		}
	}
	turnClusters();
	if (any) contact::correctPositions(problem, settings, workspace, errors, sweeps, correction);
}

/// Two bodies that are drawn together or apart while they pass each other would change their angular momentum, Σ m D × v: a pair of tangential impulses takes
/// that back, as for bodies on a string that is shortened. Exact for the positions at the end of the step.
void ContactSeam::turnBack(size_t k)
{
	const Contact& c    = problem.contacts[k];
	const auto     free = [this](int body) {
                return problem.inverseMass[body].x > 0 && problem.inverseMass[body].x == problem.inverseMass[body].y;
	};
	if (!free(c.i) || !free(c.j)) return; // what holds a body takes its angular momentum
	const auto after = [this](int body) {
		Twist v = problem.velocities[body];
		if (clusterTurn.empty()) return v;
		v.x += clusterTurn[body].x;
		v.y += clusterTurn[body].y;
		return v;
	};
	const Twist vi = after(c.i), vj = after(c.j), di = displacementOf(c.i), dj = displacementOf(c.j);
	const Real  dx = vj.x - vi.x, dy = vj.y - vi.y;
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
	for (size_t id = 0; id < clusterTurn.size(); ++id)
		turning[id] = { mass[id] * clusterTurn[id].x, mass[id] * clusterTurn[id].y, 0 };
	if (correction.displacements.empty()) return;
	for (size_t k = 0; k < links.size(); ++k)
		if (correction.impulses[k] != 0 || (!correction.tangential.empty() && correction.tangential[k] != 0))
			turnBack(k);
}

/// How far a body is moved for errors of position, and because it turns with a cluster.
Twist ContactSeam::correctionOf(size_t id) const
{
	const Twist d = correction.displacements.empty() ? Twist {} : correction.displacements[id];
	if (clusterWay.empty()) return d;
	const Twist& turned = clusterWay[id];
	return { d.x + turned.x, d.y + turned.y, d.w + turned.w };
}

/// How far it is moved in all beside the path of the step: impacts may have taken place within it, too.
Twist ContactSeam::displacementOf(size_t id) const
{
	const Twist d = correctionOf(id);
	if (!followed) return d;
	const Twist& s = sequence.flights[id].shift;
	return { d.x + s.x, d.y + s.y, d.w + s.w };
}

/// Moves bodies by their displacements. NewtonIntegrator adds the path of the step.
void ContactSeam::displace(size_t begin, size_t end)
{
	if (correction.displacements.empty() && clusterWay.empty() && !followed) return;
	for (size_t id = begin; id < end; ++id) {
		const Twist d = displacementOf(id);
		if (!present[id] || (d.x == 0 && d.y == 0 && d.w == 0)) continue;
		resident->displace(id, d);
	}
}

} // namespace yade::nscd
