// What a solve does once, whatever the number of sweeps, beside the time of a sweep; and the same of the correction of positions.
//
// Solves of 1 and 101 sweeps, each with one look at the residual, give the sweep and what is left at none: `once`. Problems alternate in one workspace. Where the
// packing rests, they differ in numbers alone; where it moves, contacts come and go and bodies go to another strip. All times are the shortest of some.
#include "problem.hpp"
#include <benchmark/benchmark.h>
#include <chrono>
#include <contact/plane/solver.hpp>

using namespace nonsmooth::contact;

namespace {

constexpr int few = 1, many = 101, correctionSweeps = 10, repetitions = 25;

enum class State { Rests, Moves };

/// Disks on a lattice of which a quarter of the contacts is open, in the order of ids as a step has them: 2.2 contacts a disk.
Problem packing(int columns, int rows)
{
	Problem p = testing::lattice(columns, rows).problem;
	std::sort(p.contacts.begin(), p.contacts.end(), [](const Contact& a, const Contact& b) {
		return std::minmax(a.i, a.j) < std::minmax(b.i, b.j);
	});
	std::size_t kept = 0;
	for (std::size_t k = 0; k < p.contactCount(); ++k)
		if (k * 2654435761u >> 30 & 3) p.contacts[kept++] = p.contacts[k];
	p.contacts.resize(kept);
	p.impulses.assign(kept, {});
	return p;
}

/// The problem of the step after: bodies have moved, a little or a hundredth of their size, and then one contact in 200 is gone.
Problem stepAfter(Problem p, State state)
{
	for (std::size_t b = 0; b < p.bodyCount(); ++b)
		p.positions[b].x += (state == State::Rests ? 1e-10 : 1e-2) * std::sin(double(b));
	for (Contact& c : p.contacts)
		c.biasN *= 1.001;
	if (state == State::Moves) {
		std::size_t kept = 0;
		for (std::size_t k = 0; k < p.contactCount(); ++k)
			if (k % 200) p.contacts[kept++] = p.contacts[k];
		p.contacts.resize(kept);
		p.impulses.resize(kept);
	}
	return p;
}

/// Two problems, one after the other and again.
struct Steps {
	std::vector<Problem>                    problems;
	std::vector<std::vector<PositionError>> errors; // of their contacts

	explicit Steps(const Problem& first, State state)
	        : problems { first, stepAfter(first, state) }
	{
		for (Problem& p : problems) {
			SolverSettings s;
			s.maxIterations = 50; // a warm start
			solve(p, s);
			std::vector<PositionError> e(p.contactCount());
			for (std::size_t k = 0; k < e.size(); ++k)
				e[k] = { 1e-6 * std::sin(double(k)), k % 3 == 0, false, false,
					 1e-6 * (1 + std::sin(double(k))) };
			errors.push_back(e);
		}
	}
};

template <class Work> double seconds(Work work)
{
	const auto begin = std::chrono::steady_clock::now();
	work();
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Times {
	double few = HUGE_VAL, many = HUGE_VAL, correctNone = HUGE_VAL, correct = HUGE_VAL, layOut = HUGE_VAL;
};

Times timesOf(const Steps& steps, SolverSettings settings)
{
	Workspace          workspace;
	ContactBlocks      laidOut;
	PositionCorrection correction;
	Times              t;
	settings.tolerance = finestInSingle; // not met in so few sweeps
	for (int k = 0; k < 2 * repetitions; ++k) {
		const auto& errors = steps.errors[k % 2];
		Problem     p      = steps.problems[k % 2];
		const auto  least  = [k](double& time, double found) {
                        if (k >= 2) time = std::min(time, found); // the first ones take the memory
		};
		const auto solveBy = [&](int sweeps) {
			p.impulses             = steps.problems[k % 2].impulses;
			settings.maxIterations = settings.checkEvery = sweeps;
			return seconds([&] { solve(p, settings, &workspace); });
		};
		least(t.few, solveBy(few));
		least(t.correctNone, seconds([&] { correctPositions(p, settings, workspace, errors, 0, correction); }));
		least(t.correct,
		      seconds([&] { correctPositions(p, settings, workspace, errors, correctionSweeps, correction); }));
		least(t.layOut, seconds([&] { layOut(p, settings.threads, laidOut); }));
	}
	for (int k = 0; k < 2 * repetitions; ++k) {
		Problem p              = steps.problems[k % 2];
		settings.maxIterations = settings.checkEvery = many;
		t.many = std::min(t.many, seconds([&] { solve(p, settings, &workspace); }));
	}
	return t;
}

void once(benchmark::State& state, State what, int columns)
{
	const Steps    steps(packing(columns, 100), what);
	SolverSettings settings;
	settings.threads = static_cast<int>(state.range(0));
	for (auto _ : state) {
		const Times  t     = timesOf(steps, settings);
		const double sweep = (t.many - t.few) / (many - few), once = t.few - few * sweep,
		             correction = t.correct - t.correctNone;
		state.SetIterationTime(once);
		state.counters["contacts"]         = double(steps.problems[0].contactCount());
		state.counters["sweep_us"]         = 1e6 * sweep;
		state.counters["once_in_sweeps"]   = once / sweep;
		state.counters["layout_us"]        = 1e6 * t.layOut;
		state.counters["correct_us"]       = 1e6 * t.correct;
		state.counters["correct_once_us"]  = 1e6 * t.correctNone;
		state.counters["correct_sweep_us"] = 1e6 * correction / correctionSweeps;
	}
}

#define NONSMOOTH_ONCE(name, ...)                                                                                      \
	BENCHMARK_CAPTURE(once, name, __VA_ARGS__)                                                                     \
	        ->ArgName("threads")                                                                                   \
	        ->Arg(1)                                                                                               \
	        ->Arg(2)                                                                                               \
	        ->UseManualTime()                                                                                      \
	        ->Iterations(1)                                                                                        \
	        ->Unit(benchmark::kMicrosecond)
NONSMOOTH_ONCE(rests_20000, State::Rests, 200);
NONSMOOTH_ONCE(moves_20000, State::Moves, 200);
NONSMOOTH_ONCE(rests_200000, State::Rests, 2000);
NONSMOOTH_ONCE(moves_200000, State::Moves, 2000);

} // namespace
