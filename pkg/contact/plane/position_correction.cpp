#include <contact/core/correct.tpp>
#include <contact/plane/law.hpp>
#include <contact/plane/solver.hpp>

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

} // namespace

/// What correct.tpp asks of a lane: the graph along its normal, and those across it.
[[gnu::always_inline]] inline void setLength(Block<double>& k, std::size_t l, const PositionError& e)
{
	const double adhesion = adhesionOf(e), impulse = projectNormal(e.impulse, adhesion);
	k.biasN.v[l]    = e.error;
	k.adhesion.v[l] = adhesion;
	k.n.v[l] = k.beforeN.v[l] = impulse;
}

void setAcross(Block<double>& k, std::size_t l, const PositionError& e)
{
	const Graphs graphs(e);
	k.biasT.v[l]      = graphs.biasT;
	k.biasR.v[l]      = graphs.biasR;
	k.friction.v[l]   = graphs.friction;
	k.rollingArm.v[l] = graphs.rollingArm;
	k.t.v[l] = k.r.v[l] = k.beforeT.v[l] = k.beforeR.v[l] = 0;
}

/// All of them of a contact outside the blocks; returns the impulses to begin with.
Impulse setGraphs(Contact& c, const PositionError& e, bool across)
{
	const Graphs graphs(e);
	c.biasN      = graphs.biasN;
	c.adhesion   = graphs.adhesion;
	c.play       = graphs.play;
	c.biasT      = across ? graphs.biasT : 0;
	c.biasR      = across ? graphs.biasR : 0;
	c.friction   = across ? graphs.friction : 0;
	c.rollingArm = across ? graphs.rollingArm : 0;
	return { projectNormal(e.impulse, c.adhesion), 0, 0 };
}

void take(PositionCorrection& result, std::int32_t index, const Contact&, const Impulse& p, bool across)
{
	result.impulses[index] = p.n;
	if (across) result.tangential[index] = p.t;
}

void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result, bool across)
{
	correctPositionsIn<Plane>(problem, settings, workspace, errors, sweeps, result, across);
}

} // namespace nonsmooth::contact
