// Every way through the solver, and how far two results are apart.
#pragma once

#include "problems.hpp"
#include <algorithm>
#include <cmath>
#include <contact/plane/solver.hpp>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace nonsmooth::contact::testing {

constexpr Method methods[] = { Method::GaussSeidel, Method::Accelerated };

/// Calls check(settings, name) for every set of kernels and the reference, with one thread and, where the solver takes more, with two.
template <class Check> void forEachPath(const Problem& problem, const SolverSettings& common, Check check)
{
	for (int threads = 1; threads <= (problem.contactCount() < 1000 ? 1 : 2); ++threads) {
		SolverSettings s = common;
		s.threads        = threads;
		const auto with  = ", " + std::to_string(threads) + " thread(s)";
		for (const BlockKernels* kernels : availableKernels()) {
			s.kernels = kernels;
			check(s, kernels->name + with);
		}
		s.reference = true;
		check(s, "reference" + with);
	}
}

inline double largestDifference(const std::vector<Impulse>& a, const std::vector<Impulse>& b)
{
	double most = a.size() == b.size() ? 0 : HUGE_VAL;
	for (std::size_t k = 0; k < a.size() && most < HUGE_VAL; ++k)
		most = std::max(
		        { most, std::abs(a[k].n - b[k].n), std::abs(a[k].t - b[k].t), std::abs(a[k].r - b[k].r) });
	return most;
}

inline double largestDifference(const std::vector<Twist>& a, const std::vector<Twist>& b)
{
	double most = a.size() == b.size() ? 0 : HUGE_VAL;
	for (std::size_t k = 0; k < a.size() && most < HUGE_VAL; ++k)
		most = std::max(
		        { most, std::abs(a[k].x - b[k].x), std::abs(a[k].y - b[k].y), std::abs(a[k].w - b[k].w) });
	return most;
}

/// Expects the same solution, to the last bit, on any number of threads and by any kernels.
inline void expectTheSameBits(const Problem& problem, const SolverSettings& common)
{
	Problem    first  = problem;
	const auto wanted = solve(first, common);
	for (const int threads : { 1, 2, 4, 7 })
		for (const BlockKernels* kernels : availableKernels()) {
			SCOPED_TRACE(kernels->name + (", threads " + std::to_string(threads)));
			Problem        other = problem;
			SolverSettings s     = common;
			s.threads            = threads;
			s.kernels            = kernels;
			const auto found     = solve(other, s);
			EXPECT_EQ(found.iterations, wanted.iterations);
			EXPECT_EQ(found.inSingle, wanted.inSingle);
			EXPECT_EQ(found.residual.rms, wanted.residual.rms);
			EXPECT_TRUE(sameBits(other.impulses, first.impulses));
			EXPECT_TRUE(sameBits(other.velocities, first.velocities));
		}
}

} // namespace nonsmooth::contact::testing
