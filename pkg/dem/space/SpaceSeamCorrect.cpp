// Errors of position in space, overlaps and wrong lengths of bonds, taken back by displacements after the solve of a step.
// Equations: doc/theory/stepping.rst, as in the plane (seam/ContactSeamCorrect.cpp).
#include "SpaceSeam.hpp"
#include <contact/space/bond.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

namespace {
	/// What of an error of a bond's length, either way, goes beyond the slack.
	Real beyondSlack(Real error, Real slack) { return error - std::max(-slack, std::min(slack, error)); }
}

void SpaceSeam::correct(const space::SolverSettings& settings, space::Workspace& workspace, int sweeps)
{
	correction.displacements.clear();
	if (sweeps == 0 || relaxation.rate == 0) return;
	const Real h = relaxation.step, most = h * relaxation.largestSpeed;
	errors.resize(solved.size());
	bool any = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : any)
	for (long k = 0; k < (long)solved.size(); ++k) {
		const auto& c     = problem.contacts[k];
		const auto& s     = stateOf(k);
		const Real  slack = relaxation.slack * c.length, gap = s.gap;
		const Real  end = gap + h * relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]).n;
		// of what was wrong before the step the share 1 − κ may stay; what the step adds may not
		auto& e          = errors[k];
		e                = {};
		const auto stays = [this](Real wrong) { return (1 - relaxation.rate) * wrong; };
		e.impulse        = s.correction;
		e.held           = isHeld(k);
		if (!e.held) {
			e.error = end + slack - stays(std::min(Real(0), gap + slack));
			if (e.error < 0) e.error = std::max(-most, e.error);
			any = any || e.error < 0;
			continue;
		}
		const Real rest = s.phys->restGap;
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
	if (!stateOf(k).bonded) return false;
	const auto& c = problem.contacts[k];
	const auto  u = relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
	return !space::yieldsInTension(c, rowsOf(c, problem.impulses[k]), u.n);
}

} // namespace yade::nscd
