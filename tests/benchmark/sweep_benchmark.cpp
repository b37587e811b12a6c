// Wall time of a sweep: by the general formulas one contact at a time, in blocks by instructions of any processor, and by the best of this one.
//
// Timed is a sweep of the accelerated method, extrapolation included and residuals not: the difference between two solves of the same problem
// that make 20 and 120 sweeps and look at the residual at their ends only. What a solve does once (layout, velocities anew) cancels.
#include "problem.hpp"
#include <benchmark/benchmark.h>
#include <chrono>
#include <contact/plane/solver.hpp>

using namespace nonsmooth::contact;

namespace {

constexpr int few = 20, many = 120;

enum class Path { Reference, Portable, Best };

double seconds(const Problem& problem, SolverSettings settings, int sweeps, Workspace& workspace)
{
	Problem p = problem;
	p.impulses.assign(p.contactCount(), {}); // far from solved
	settings.maxIterations = settings.checkEvery = sweeps;
	const auto begin                             = std::chrono::steady_clock::now();
	solve(p, settings, &workspace);
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void sweep(benchmark::State& state, Path path, const Problem& (*problem)() = benchmarks::problem)
{
	SolverSettings settings;
	settings.tolerance = finestInSingle; // not met in so few sweeps
	settings.threads   = static_cast<int>(state.range(0));
	settings.kernels   = path == Path::Portable ? availableKernels().back() : nullptr;
	settings.reference = path == Path::Reference;
	try {
		Workspace workspace;
		seconds(problem(), settings, few, workspace); // takes the memory
		double spent = 0;
		for (auto _ : state) {
			const double one = std::max(
			                           0.0,
			                           seconds(problem(), settings, many, workspace)
			                                   - seconds(problem(), settings, few, workspace))
			        / (many - few);
			state.SetIterationTime(one);
			spent += one;
		}
		const auto contacts              = static_cast<double>(problem().contactCount());
		state.counters["ns_per_contact"] = 1e9 * spent / (static_cast<double>(state.iterations()) * contacts);
		state.counters["contacts"]       = contacts;
	} catch (const std::exception& error) {
		state.SkipWithError(error.what());
	}
}

/// 9,000 disks below a platen that follows their pressure.
const Problem& platen()
{
	static const Problem made = testing::underPlaten(95, 95);
	return made;
}

// a fixed number of repetitions: the time that counts is a small part of what each takes
#define NONSMOOTH_SWEEP(name, ...)                                                                                     \
	BENCHMARK_CAPTURE(sweep, name, __VA_ARGS__)                                                                    \
	        ->ArgName("threads")                                                                                   \
	        ->Arg(1)                                                                                               \
	        ->Arg(2)                                                                                               \
	        ->UseManualTime()                                                                                      \
	        ->Iterations(10)                                                                                       \
	        ->Unit(benchmark::kMicrosecond)
NONSMOOTH_SWEEP(reference, Path::Reference);
NONSMOOTH_SWEEP(portable, Path::Portable);
NONSMOOTH_SWEEP(best, Path::Best);
NONSMOOTH_SWEEP(platen, Path::Best, platen);

} // namespace
