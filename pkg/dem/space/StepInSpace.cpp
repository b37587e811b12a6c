// The step of ContactDynamicsEngine where bodies move in space: gather, solve, correct, scatter, as in the plane.
#include "../engines/ContactDynamicsEngine.hpp"
#include "../seam/Recall.hpp"
#include <contact/space/residual.hpp>
#include <sstream>

namespace yade {

namespace contact = nonsmooth::contact;

void ContactDynamicsEngine::stepInSpace(
        nscd::Resident& resident, nscd::StageTimer& timer, const Vector3r& gravity, int threads)
{
	using nscd::Stage;
	problemIsWhole = false;
	wasInSpace     = true;
	inSpace.gather(
	        *scene, resident, gravity, { scene->dt, relaxationRate, correctionSpeed, correctionSlack, openGap },
	        threads);
	stepSolved = scene->dt;
	timer.next(Stage::Solve);
	contact::space::SolverSettings how;
	static_cast<contact::SweepSettings&>(how) = settings();
	const auto statistics                     = nscd::solveWithRecalls(inSpace, [&] {
                return contact::space::solve(inSpace.problem, how, &workspaceInSpace);
        });
	timer.next(Stage::Correct);
	inSpace.correct(how, workspaceInSpace, correctionSweeps);
	timer.next(Stage::Scatter);
	const auto sums = inSpace.scatter(*scene, gravity);
	problemIsWhole  = true;
	candidates      = int(inSpace.contacts());
	wayWorst        = 0;
	account(sums);
	for (const auto& [mode, interaction] : inSpace.broken) {
		const auto&    ids = *interaction;
		const Vector3r at  = static_cast<const ScGeom&>(*interaction->geom).contactPoint;
		breakLog.insert(
		        breakLog.end(),
		        { Real(scene->iter), scene->time, Real(std::min(ids.getId1(), ids.getId2())),
		          Real(std::max(ids.getId1(), ids.getId2())), Real(mode), at[0], at[1] });
	}
	reportOverlap([this](Real depth) { return inSpace.overlapsOf(depth); });
	reportRestitution(sums.mass * (scene->dt * scene->dt) * gravity.squaredNorm());
	report(statistics, sums.bodies > 0 ? sums.mass / sums.bodies * gravity.norm() : 0);
}

string ContactDynamicsEngine::tellWorstPairInSpace()
{
	const auto shares = contact::space::speedShares(inSpace.problem);
	if (shares.empty()) return "there are no contacts";
	const auto worst  = std::max_element(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
                return a.point < b.point;
        });
	residualSpeedPair = inSpace.idsOf(worst - shares.begin());
	std::ostringstream text;
	text << "worst are bodies #" << residualSpeedPair[0] << " and #" << residualSpeedPair[1] << ", which leave "
	     << 100 * std::sqrt(worst->point) << " % of their speed open";
	return text.str();
}

} // namespace yade
