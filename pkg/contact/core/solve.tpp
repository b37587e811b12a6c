// One solve, for the dimension that includes it (solver.cpp, space/solver.cpp); the method stands in solver.hpp.
#pragma once

#include <cmath>
#include <contact/core/contact_blocks.hpp>
#include <contact/core/check.hpp>
#include <contact/core/scaling.hpp>
#include <contact/core/sweeper.hpp>
#include <optional>

namespace nonsmooth::contact {

/// What solves patches of contacts around mass jumps at once, in its member Type.
template <class Dimension> struct PatchesIn;

namespace solving {

	inline bool sweepsInSingle(const SweepSettings& settings)
	{
		return settings.precision == Precision::Mixed && settings.stopping == StoppingTest::NaturalMap
		        && !settings.reference && settings.tolerance >= finestInSingle;
	}

	/// One solve, whose functions every thread runs through.
	template <class Dimension> class Solve {
	public:
		using Problem  = typename Dimension::Problem;
		using Settings = typename Dimension::Settings;
		using Patches  = typename PatchesIn<Dimension>::Type;

		Solve(Problem& problem, const Settings& settings, WorkspaceIn<Dimension>& workspace);
		SolverStatistics run();

	private:
		void begin();
		void narrowStrip(std::size_t strip);
		void round();
		void finish(bool take);
		bool sweepAndPatch();
		void writeFixed();
		void applyStrip(std::size_t strip);
		void writeStrip(std::size_t strip);

		Problem&                                 problem;
		const Settings&                          settings;
		const BlockKernelsIn<Dimension>&         kernels;
		const ContactBlocksIn<Dimension>&        laidOut;
		Sweeper<Dimension, double>               exact;
		std::optional<Sweeper<Dimension, float>> rounded;
		std::optional<Patches>                   patches; // where masses jump
		bool                                     patched = false; // in the last round
	};

	template <class Dimension>
	Solve<Dimension>::Solve(Problem& problem_, const Settings& settings_, WorkspaceIn<Dimension>& workspace)
	        : problem(problem_)
	        , settings(settings_)
	        , kernels(kernelsFor(settings_))
	        , laidOut(workspace.laidOut)
	        , exact(problem_, settings_, workspace)
	{
		exact.fillRows();
		if (laidOut.classification.jumps && laidOut.classification.uneven
		    && settings.stopping == StoppingTest::NaturalMap)
			patches.emplace(exact);
		if (patches && !patches->any()) patches.reset();
		// floats have no digits for a light body between heavy ones
		if (sweepsInSingle(settings) && !patches) rounded.emplace(problem, settings, workspace);
		problem.velocities.resize(problem.bodyCount());
	}

	/// Adds M⁻¹ Hᵀ P.
	template <class Dimension> void Solve<Dimension>::applyStrip(std::size_t s)
	{
		kernels.apply(exact.blocksOf(s), exact.countOf(s), exact.bodies.data());
		exact.applyRows(s);
	}

	/// Velocities and impulses of the warm start, and their residual. A strip's numbers are filled in and used
	/// while they are at hand.
	template <class Dimension> void Solve<Dimension>::begin()
	{
		exact.plan();
		exact.forFixed([this](long place, std::int32_t b) { exact.setOut(place, b); });
		exact.schedule.passes(
		        omp_get_thread_num(), 2, [this](std::size_t s, int pass, const StripSchedule::Ahead&) {
			        if (pass == 0) {
				        fillIn(problem, kernels, s, exact.laidOut);
				        exact.setOut(s);
				        applyStrip(s);
			        } else {
				        exact.keepBodies(s);
				        exact.measureStrip(s, false);
				        if (rounded) narrowStrip(s);
			        }
		        });
		if (settings.maxIterations == 0) exact.judgeAll();
		else
			exact.judge(settings.tolerance);
	}

	/// What sweeps in floats begin with, of the bodies and blocks of a strip.
	template <class Dimension> void Solve<Dimension>::narrowStrip(std::size_t s)
	{
		const std::size_t begin = laidOut.blockBegin[s];
		kernels.narrow(
		        exact.blocksOf(s), exact.own.inverseLength.data() + begin, exact.countOf(s),
		        rounded->blocksOf(s), rounded->own.inverseLength.data() + begin);
		for (std::size_t b = begin; exact.playsOf(s) && b < laidOut.blockBegin[s + 1]; ++b)
			for (std::size_t l = 0; l < lanes; ++l)
				rounded->own.plays[b].v[l] = static_cast<float>(exact.own.plays[b].v[l]);
		exact.forNew(s, [this](std::size_t place, std::int32_t) {
			narrow(exact.bodies[place], rounded->bodies[place]);
		});
		rounded->keepBodies(s);
	}

	/// The same state in floats: strips have been rounded while they were at hand, in begin().
	template <class Dimension> void Solve<Dimension>::round()
	{
		rounded->plan();
		exact.forFixed([this](std::size_t place, std::int32_t) {
			narrow(exact.bodies[place], rounded->bodies[place]);
		});
#pragma omp single
		{
			rounded->rows       = exact.rows;
			rounded->sums       = exact.sums;
			rounded->residual   = exact.residual;
			rounded->scale.mean = exact.scale.mean;
		}
	}

	/// Gives back the impulses of a part, and the velocities of the bodies that it is the first to touch.
	template <class Dimension> void Solve<Dimension>::writeStrip(std::size_t s)
	{
		exact.forImpulses(s, [this](std::int32_t index, const auto& p) { problem.impulses[index] = p; });
		exact.forNew(s, [this](std::size_t, std::int32_t b) { problem.velocities[b] = exact.twist(b); });
	}

	template <class Dimension> void Solve<Dimension>::writeFixed()
	{
		exact.forFixed([this](long, std::int32_t b) { problem.velocities[b] = exact.twist(b); });
	}

	/// Velocities anew, so that the residual reported owes nothing to rounding gathered over the sweeps; with
	/// `take` of the impulses that sweeps in single precision
	/// have found.
	template <class Dimension> void Solve<Dimension>::finish(bool take)
	{
		writeFixed();
		exact.schedule.passes(
		        omp_get_thread_num(), 2, [&](std::size_t s, int pass, const StripSchedule::Ahead&) {
			        if (pass == 0) {
				        if (take) {
					        kernels.widen(
					                rounded->blocksOf(s), exact.countOf(s), exact.blocksOf(s));
					        for (std::size_t k = laidOut.otherBegin[s];
					             k < laidOut.otherBegin[s + 1]; ++k)
						        exact.rows[k].p = exact.rows[k].before = rounded->rows[k].p;
				        }
				        exact.setOut(s);
				        applyStrip(s);
			        } else {
				        exact.keepBodies(s);
				        writeStrip(s);
			        }
		        });
		exact.judgeAll();
	}

	/// Sweeps and patches in turn, with more sweeps in each round; returns whether anything was changed.
	template <class Dimension> bool Solve<Dimension>::sweepAndPatch()
	{
		constexpr int firstSweeps = 30, rounds = 4;
		const double  tolerance = settings.tolerance;
		bool          changed   = false;
		for (int round = 0, sweeps = firstSweeps;; ++round, sweeps *= 4) {
			const int  before = exact.iterations, left = settings.maxIterations - before;
			const bool last = round == rounds;
			exact.iterate({ tolerance, last ? left : std::min(left, sweeps) });
			const bool swept = exact.iterations > before;
			changed          = changed || swept;
#pragma omp barrier
#pragma omp single
			patched = patches->settle(
			        tolerance, last ? 0 : 0.5 * settings.maxIterations * double(problem.contactCount()));
			if (patched) {
				changed = true;
				exact.schedule.each(omp_get_thread_num(), [this](std::size_t s) {
					exact.measureStrip(s, false);
				});
				exact.judge(tolerance);
			}
			if (last || exact.solved(tolerance)) break;
		}
		return changed;
	}

	template <class Dimension> SolverStatistics Solve<Dimension>::run()
	{
		// in single precision a little further, so that doubles, which round otherwise, find it solved
		constexpr double further   = 0.999;
		const double     tolerance = settings.tolerance;
#pragma omp parallel num_threads(exact.threads)
		{
			bool written = false;
			begin();
			int left = settings.maxIterations;
			if (patches && sweepAndPatch()) {
				finish(false);
				left    = 0;
				written = true;
			}
			if (rounded && !exact.solved(tolerance)) {
				round();
				rounded->iterate({ further * tolerance, left });
				left -= rounded->iterations;
				written = rounded->iterations > 0 && std::isfinite(rounded->residual.rms);
				if (written) finish(true);
			}
			if (!patches) exact.iterate({ tolerance, left });
			if (!patches && exact.iterations > 0) finish(false);
			else if (!written) { // as it was begun with
				writeFixed();
				exact.schedule.each(omp_get_thread_num(), [this](std::size_t s) { writeStrip(s); });
			}
		}
		SolverStatistics statistics;
		statistics.inSingle   = rounded ? rounded->iterations : 0;
		statistics.iterations = exact.iterations + statistics.inSingle;
		statistics.restarts   = exact.restarts + (rounded ? rounded->restarts : 0);
		statistics.strips     = static_cast<int>(laidOut.order.stripCount());
		statistics.residual   = exact.residual;
		statistics.changes    = exact.changes;
		statistics.uneven     = laidOut.classification.uneven;
		statistics.converged  = exact.solved(
		         tolerance * (1 + 1e-6)); // velocities computed anew may round the other way
		if (patches) {
			statistics.patches    = patches->solved();
			statistics.patchSpeed = patches->speed();
			statistics.converged  = statistics.converged
			        && statistics.patchSpeed <= Residual::meanSpeed(tolerance, true);
		}
		return statistics;
	}

} // namespace solving

/// solve() of a dimension.
template <class Dimension>
SolverStatistics
solveIn(typename Dimension::Problem& problem, const typename Dimension::Settings& settings,
        WorkspaceIn<Dimension>* workspace)
{
	check(settings);
	WorkspaceIn<Dimension>  own;
	WorkspaceIn<Dimension>& memory = workspace ? *workspace : own;
	layOut<Dimension>(problem, threadsFor(problem, settings), memory.laidOut, !settings.reference);
	const auto scaling = scalingOfLostSquares(memory.laidOut.classification);
	if (!scaling) return solving::Solve<Dimension>(problem, settings, memory).run();
	auto       other      = scaled(problem, *scaling);
	auto       statistics = solveIn<Dimension>(other, settings, &memory);
	const auto back       = inverse(*scaling);
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		problem.impulses[k] = scaled(other.impulses[k], back);
	problem.velocities.resize(problem.bodyCount());
	for (std::size_t b = 0; b < problem.bodyCount(); ++b)
		problem.velocities[b] = scaled(other.velocities[b], back.speed);
	for (double* const impulse :
	     { &statistics.residual.rms, &statistics.residual.largest, &statistics.residual.scale })
		*impulse = std::ldexp(*impulse, back.speed + back.mass);
	return statistics;
}

} // namespace nonsmooth::contact
