// Displacements that take errors of position back, for the dimension that includes it (position_correction.cpp,
// space/position_correction.cpp); the method
// stands in solver.hpp. What an error asks of a contact's graphs is each dimension's own.
#pragma once

#include <algorithm>
#include <contact/core/extrapolation.hpp>
#include <contact/core/sweeper.hpp>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace correcting {

	template <class Dimension> class Correction {
	public:
		using PositionError      = typename Dimension::PositionError;
		using PositionCorrection = typename Dimension::PositionCorrection;

		Correction(
		        Sweeper<Dimension, double>& sweeper_, const BlockKernelsIn<Dimension>& kernels_,
		        const std::vector<PositionError>& errors_, PositionCorrection& result_, bool asked_)
		        : sweeper(sweeper_)
		        , kernels(kernels_)
		        , laidOut(sweeper_.laidOut)
		        , errors(errors_)
		        , result(result_)
		        , asked(asked_)
		{
		}
		void run(int sweeps);

	private:
		bool asksAcross(std::size_t strip) const;
		void begin(std::size_t strip);
		void end(std::size_t strip);

		Sweeper<Dimension, double>&       sweeper;
		const BlockKernelsIn<Dimension>&  kernels;
		const ContactBlocksIn<Dimension>& laidOut;
		const std::vector<PositionError>& errors;
		PositionCorrection&               result;
		const bool                        asked; // whether any error may ask for more than a length
		std::vector<char>                 across; // of strips: whether tangents and turns are corrected too
	};

	/// Whether a contact of a strip asks for more than a length.
	template <class Dimension> bool Correction<Dimension>::asksAcross(std::size_t s) const
	{
		const auto asks = [this](auto index) { return index != emptyLane && errors[index].asksAcross(); };
		const auto* const places = laidOut.contactOf.data();
		return std::any_of(
		               places + laidOut.blockBegin[s] * lanes, places + laidOut.blockBegin[s + 1] * lanes, asks)
		        || std::any_of(
		                laidOut.others.begin() + laidOut.otherBegin[s],
		                laidOut.others.begin() + laidOut.otherBegin[s + 1], asks);
	}

	/// Makes displacements of velocities: nothing has moved but what the impulses to begin with ask for.
	template <class Dimension> void Correction<Dimension>::begin(std::size_t s)
	{
		const PositionError* const all = errors.data();
		for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b) {
			auto&             k      = sweeper.own.blocks[b];
			const auto* const places = laidOut.contactOf.data() + b * lanes;
			for (std::size_t l = 0; l < lanes; ++l) {
				if (places[l] == emptyLane) continue;
				const PositionError& e = all[places[l]];
				setLength(k, l, e);
				if (sweeper.playsOf(s)) sweeper.own.plays[b].v[l] = playOf(k, l, e.play);
			}
		}
		const bool asks = asked && asksAcross(s);
		across[s]       = asks;
		for (std::size_t b = laidOut.blockBegin[s]; asks && b < laidOut.blockBegin[s + 1]; ++b) {
			auto& k = sweeper.own.blocks[b];
			for (std::size_t l = 0; l < lanes; ++l) {
				const auto index = laidOut.contactOf[b * lanes + l];
				if (index == emptyLane) continue;
				setAcross(k, l, errors[index]);
			}
		}
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const PositionError& e   = errors[laidOut.others[k]];
			auto&                row = sweeper.rows[k];
			row.p = row.before = setGraphs(row.contact, e, across[s]);
		}
		sweeper.setOut(s);
		kernels.applyNormals(sweeper.blocksOf(s), sweeper.countOf(s), sweeper.bodies.data());
		sweeper.applyRows(s);
	}

	template <class Dimension> void Correction<Dimension>::end(std::size_t s)
	{
		sweeper.forImpulses(s, [&](std::int32_t index, const auto& p) {
			take(result, index, sweeper.problem.contacts[index], p, across[s]);
		});
		sweeper.forNew(s, [&](std::size_t place, std::int32_t b) {
			result.displacements[b] = sweeper.twistAt(place);
		});
	}

	template <class Dimension> void Correction<Dimension>::run(int sweeps)
	{
		result.displacements.resize(sweeper.problem.bodyCount());
		result.impulses.resize(sweeper.problem.contactCount());
		across.assign(laidOut.partCount(), false);
		result.tangential.assign(asked ? sweeper.problem.contactCount() : 0, {});
		Extrapolation       extrapolation(sweeper.settings.method);
		std::vector<double> betas(sweeps);
		for (double& b : betas)
			b = extrapolation.next();
		const auto visit = [&](std::size_t s, int pass, const StripSchedule::Ahead&) {
			if (pass == 0) begin(s);
			else if (pass <= sweeps) {
				auto* const       blocks = sweeper.blocksOf(s);
				const std::size_t count  = sweeper.countOf(s);
				const double      beta   = betas[pass - 1];
				if (pass == 1) sweeper.keepBodies(s);
				sweeper.extrapolate(s, beta);
				const auto* const plays = sweeper.playsOf(s);
				if (across[s])
					kernels.inDouble.sweep(blocks, plays, count, sweeper.bodies.data(), beta);
				else
					kernels.sweepNormals(blocks, plays, count, sweeper.bodies.data(), beta);
				sweeper.sweepRows(s, beta);
			} else
				end(s);
		};
#pragma omp parallel num_threads(sweeper.threads)
		{
			sweeper.plan();
			sweeper.forFixed([&](long place, std::int32_t b) {
				sweeper.setOut(place, b);
				result.displacements[b] = {};
			});
			sweeper.schedule.passes(omp_get_thread_num(), sweeps + 2, visit);
		}
	}

} // namespace correcting

/// correctPositions() of a dimension.
template <class Dimension>
void correctPositionsIn(
        typename Dimension::Problem& problem, const typename Dimension::Settings& settings,
        WorkspaceIn<Dimension>& workspace, const std::vector<typename Dimension::PositionError>& errors, int sweeps,
        typename Dimension::PositionCorrection& result, bool across)
{
	const auto& blocks = workspace.laidOut;
	if (errors.size() != problem.contactCount() || blocks.order.order.size() != problem.contactCount()
	    || blocks.placeOf.size() != problem.bodyCount())
		throw std::invalid_argument(
		        "correctPositions: " + std::to_string(errors.size()) + " errors for "
		        + std::to_string(problem.contactCount()) + " contacts, of which the last solve laid out "
		        + std::to_string(blocks.order.order.size()));
	Sweeper<Dimension, double> sweeper(problem, settings, workspace);
	sweeper.fillRows();
	correcting::Correction<Dimension>(sweeper, kernelsFor(settings), errors, result, across).run(sweeps);
}

} // namespace nonsmooth::contact
