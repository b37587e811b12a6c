#include <algorithm>
#include <contact/extrapolation.hpp>
#include <contact/law.hpp>
#include <contact/sweeper.hpp>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	constexpr double without = 1e100; // a bond holds whatever it costs
	double           adhesionOf(const PositionError& e) { return e.held ? without : 0; }

	/// The graphs of law.hpp that errors of position ask for: thresholds are none, or without bounds.
	struct Graphs {
		double biasN, biasT, biasR, adhesion, friction, rollingArm, play;

		explicit Graphs(const PositionError& e)
		        : biasN(e.error)
		        , biasT(e.slip)
		        , biasR(e.turn)
		        , adhesion(adhesionOf(e))
		        , friction(e.sticks ? 1 : 0)
		        , rollingArm(e.grips ? 1 : 0)
		        , play(e.play)
		{
		}
	};

	class Correction {
	public:
		Correction(
		        Sweeper<double>& sweeper_, const BlockKernels& kernels_,
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

		Sweeper<double>&                  sweeper;
		const BlockKernels&               kernels;
		const ContactBlocks&              laidOut;
		const std::vector<PositionError>& errors;
		PositionCorrection&               result;
		const bool                        asked; // whether any error may ask for more than a length
		std::vector<char>                 across; // of strips: whether tangents and turns are corrected too
	};

	/// Whether a contact of a strip asks for more than a length.
	bool Correction::asksAcross(std::size_t s) const
	{
		const auto asks = [this](auto index) {
			return index != ContactBlocks::none && errors[index].asksAcross();
		};
		const auto* const places = laidOut.contactOf.data();
		return std::any_of(
		               places + laidOut.blockBegin[s] * lanes, places + laidOut.blockBegin[s + 1] * lanes, asks)
		        || std::any_of(
		                laidOut.others.begin() + laidOut.otherBegin[s],
		                laidOut.others.begin() + laidOut.otherBegin[s + 1], asks);
	}

	/// Makes displacements of velocities: nothing has moved but what the impulses to begin with ask for.
	void Correction::begin(std::size_t s)
	{
		const PositionError* const all = errors.data();
		for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b) {
			auto&             k      = sweeper.own.blocks[b];
			const auto* const places = laidOut.contactOf.data() + b * lanes;
			for (std::size_t l = 0; l < lanes; ++l) {
				if (places[l] == ContactBlocks::none) continue;
				const PositionError& e = all[places[l]];
				const double adhesion = adhesionOf(e), impulse = projectNormal(e.impulse, adhesion);
				k.biasN.v[l]    = e.error;
				k.adhesion.v[l] = adhesion;
				k.n.v[l] = k.beforeN.v[l] = impulse;
				if (sweeper.playsOf(s)) sweeper.own.plays[b].v[l] = playOf(k, l, e.play);
			}
		}
		const bool asks = asked && asksAcross(s);
		across[s]       = asks;
		for (std::size_t b = laidOut.blockBegin[s]; asks && b < laidOut.blockBegin[s + 1]; ++b) {
			auto& k = sweeper.own.blocks[b];
			for (std::size_t l = 0; l < lanes; ++l) {
				const auto index = laidOut.contactOf[b * lanes + l];
				if (index == ContactBlocks::none) continue;
				const Graphs graphs(errors[index]);
				k.biasT.v[l]      = graphs.biasT;
				k.biasR.v[l]      = graphs.biasR;
				k.friction.v[l]   = graphs.friction;
				k.rollingArm.v[l] = graphs.rollingArm;
				k.t.v[l] = k.r.v[l] = k.beforeT.v[l] = k.beforeR.v[l] = 0;
			}
		}
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const PositionError& e = errors[laidOut.others[k]];
			const Graphs         graphs(e);
			Contact&             c = sweeper.rows[k].contact;
			c.biasN                = graphs.biasN;
			c.adhesion             = graphs.adhesion;
			c.play                 = graphs.play;
			c.biasT                = across[s] ? graphs.biasT : 0;
			c.biasR                = across[s] ? graphs.biasR : 0;
			c.friction             = across[s] ? graphs.friction : 0;
			c.rollingArm           = across[s] ? graphs.rollingArm : 0;
			sweeper.rows[k].p = sweeper.rows[k].before = { projectNormal(e.impulse, c.adhesion), 0, 0 };
		}
		sweeper.setOut(s);
		kernels.applyNormals(sweeper.blocksOf(s), sweeper.countOf(s), sweeper.bodies.data());
		sweeper.applyRows(s);
	}

	void Correction::end(std::size_t s)
	{
		sweeper.forImpulses(s, [&](std::int32_t index, const Impulse& p) {
			result.impulses[index] = p.n;
			if (across[s]) result.tangential[index] = p.t;
		});
		sweeper.forNew(s, [&](std::size_t place, std::int32_t b) {
			result.displacements[b] = sweeper.twistAt(place);
		});
	}

	void Correction::run(int sweeps)
	{
		result.displacements.resize(sweeper.problem.bodyCount());
		result.impulses.resize(sweeper.problem.contactCount());
		across.assign(laidOut.partCount(), false);
		result.tangential.assign(asked ? sweeper.problem.contactCount() : 0, 0);
		Extrapolation       extrapolation(sweeper.settings.method);
		std::vector<double> betas(sweeps);
		for (double& b : betas)
			b = extrapolation.next();
		const auto visit = [&](std::size_t s, int pass, const StripSchedule::Ahead&) {
			if (pass == 0) begin(s);
			else if (pass <= sweeps) {
				Block<double>* const blocks = sweeper.blocksOf(s);
				const std::size_t    count  = sweeper.countOf(s);
				const double         beta   = betas[pass - 1];
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

} // namespace

void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result, bool across)
{
	const ContactBlocks& blocks = workspace.laidOut;
	if (errors.size() != problem.contactCount() || blocks.order.order.size() != problem.contactCount()
	    || blocks.placeOf.size() != problem.bodyCount())
		throw std::invalid_argument(
		        "correctPositions: " + std::to_string(errors.size()) + " errors for "
		        + std::to_string(problem.contactCount()) + " contacts, of which the last solve laid out "
		        + std::to_string(blocks.order.order.size()));
	Sweeper<double> sweeper(problem, settings, workspace);
	sweeper.fillRows();
	Correction(sweeper, kernelsFor(settings), errors, result, across).run(sweeps);
}

} // namespace nonsmooth::contact
