// The contact problem that the benchmarks sweep.
#pragma once

#include "problems.hpp"
#include <contact/plane/problem_file.hpp>
#include <cstdlib>

namespace nonsmooth::contact::benchmarks {

/// What the file in NONSMOOTH_BENCHMARK_PROBLEM had to solve, from its warm start; without it, a lattice of 20,000 disks at rest.
/// Throws std::runtime_error where the file cannot be read.
inline const Problem& problem()
{
	static const Problem chosen = [] {
		const char* path = std::getenv("NONSMOOTH_BENCHMARK_PROBLEM");
		if (!path) return testing::lattice(200, 100).problem;
		RecordedProblem recorded  = read(path);
		recorded.problem.impulses = recorded.warmStart;
		return recorded.problem;
	}();
	return chosen;
}

} // namespace nonsmooth::contact::benchmarks
