// Errors of position, overlaps and bonds' errors of length, taken back by displacements after the solve of a step: what they are, and what they do to bodies.
// The equations stand in contact/solver.hpp (correctPositions) and doc/theory/stepping.rst.
#include "ContactSeam.hpp"
#include "Prefetch.hpp"
#include <algorithm>
#include <cmath>
#include <contact/plane/bond.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;
using contact::Impulse;
using contact::Twist;

namespace {
	/// What of an error of a bond's length, either way, goes beyond the slack.
	Real beyond(Real error, Real slack) { return error - std::max(-slack, std::min(slack, error)); }
}

void ContactSeam::correct(const contact::SolverSettings& settings, contact::Workspace& workspace, int sweeps)
{
	correction.displacements.clear();
	if (sweeps == 0 || relaxation.rate == 0) return;
	const Real h = relaxation.step, most = h * relaxation.largestSpeed;
	const long count = (long)links.size();
	bool       any   = false;
	errors.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : any)
	for (long k = 0; k < count; ++k) {
		if (k + (long)later < count) fetch<1>(&readingOf(links[k + later]));
		const Contact& c = problem.contacts[k];
		const Impulse  u = contact::relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
		auto&          e = errors[k];
		const Reading& r = readingOf(links[k]);
		e.impulse        = links[k].correction;
		// a bond that opens keeps its new length
		e.held = r.bonded && !contact::plane::yieldsInTension(c, problem.impulses[k], u);
		// of what was wrong before the step the share 1 − κ may stay; what the step adds may not
		const Real slack = relaxation.slack * c.length, off = r.gap - (e.held ? r.restGap : 0);
		e.error = e.held ? beyond(off + h * u.n, slack) - (1 - relaxation.rate) * beyond(off, slack)
		                 : off + h * u.n + slack - (1 - relaxation.rate) * std::min(Real(0), off + slack);
		if (!e.held && e.error >= 0) continue;
		e.error = std::max(-most, std::min(most, e.error));
		any     = any || e.error != 0;
	}
	if (!any) return;
	contact::correctPositions(problem, settings, workspace, errors, sweeps, correction);
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
	const auto &vi = problem.velocities[c.i], &vj = problem.velocities[c.j];
	const auto &di = correction.displacements[c.i], &dj = correction.displacements[c.j];
	const Real  passing = -c.ny * (vj.x - vi.x) + c.nx * (vj.y - vi.y);
	const auto &xi = problem.positions[c.i], &xj = problem.positions[c.j];
	const Real  distance = c.nx * (xj.x + dj.x - xi.x - di.x) + c.ny * (xj.y + dj.y - xi.y - di.y);
	if (!(distance > 0)) return;
	const Real p = -correction.impulses[k] * passing / distance;
	turning[c.i].x += c.ny * p;
	turning[c.i].y -= c.nx * p;
	turning[c.j].x -= c.ny * p;
	turning[c.j].y += c.nx * p;
}

/// All of them, in the order of contacts.
void ContactSeam::turnBack()
{
	turning.assign(before.size(), {});
	if (correction.displacements.empty()) return;
	for (size_t k = 0; k < links.size(); ++k)
		if (correction.impulses[k] != 0) turnBack(k);
}

/// Moves bodies by their displacements. NewtonIntegrator adds the path of the step.
void ContactSeam::displace(size_t begin, size_t end)
{
	if (correction.displacements.empty()) return;
	for (size_t id = begin; id < end; ++id) {
		const Twist& d = correction.displacements[id];
		if (!present[id] || (d.x == 0 && d.y == 0 && d.w == 0)) continue;
		resident->displace(id, d);
	}
}

} // namespace yade::nscd
