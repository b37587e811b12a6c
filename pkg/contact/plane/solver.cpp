#include <contact/plane/patch_solver.hpp>
#include <contact/core/solve.tpp>
#include <contact/plane/problem_scale.hpp>

namespace nonsmooth::contact {

template <> struct PatchesIn<Plane> {
	using Type = PatchSolver;
};

SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace)
{
	return solveIn<Plane>(problem, settings, workspace);
}

} // namespace nonsmooth::contact
