#include <contact/patch_solver.hpp>
#include <contact/solve.tpp>

namespace nonsmooth::contact {

template <> struct PatchesIn<Plane> {
	using Type = PatchSolver;
};

SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace)
{
	return solveIn<Plane>(problem, settings, workspace);
}

} // namespace nonsmooth::contact
