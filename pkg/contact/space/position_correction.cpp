#include <contact/core/correct.tpp>
#include <contact/space/sweeper.hpp>

namespace nonsmooth::contact::space {
namespace {

	constexpr double without = 1e100; // a bond holds whatever it costs
	double           adhesionOf(const PositionError& e) { return e.held ? without : 0; }

} // namespace

/// What correct.tpp asks of a lane: the graph along its normal, and those across it.
[[gnu::always_inline]] inline void setLength(Block<double>& k, std::size_t l, const PositionError& e)
{
	const double adhesion = adhesionOf(e);
	const Vector impulse  = projectNormal(e.impulse, adhesion) * vectorOf(k.n, l);
	k.biasN.v[l]          = e.error;
	k.adhesion.v[l]       = adhesion;
	setVector(k.f, l, impulse);
	setVector(k.beforeF, l, impulse);
}

void setAcross(Block<double>& k, std::size_t l, const PositionError& e)
{
	setVector(k.biasT, l, e.slip);
	setVector(k.biasW, l, e.turn);
	k.friction.v[l]    = e.sticks ? 1 : 0;
	k.rollingArm.v[l]  = e.grips ? 1 : 0;
	k.twistingArm.v[l] = e.grips ? 1 : 0;
	setVector(k.m, l, {});
	setVector(k.beforeM, l, {});
}

/// All of them of a contact outside the blocks; returns the impulses to begin with.
Impulse setGraphs(Contact& c, const PositionError& e, bool across)
{
	c.biasN       = e.error;
	c.adhesion    = adhesionOf(e);
	c.play        = e.play;
	c.biasT       = across ? e.slip : Vector {};
	c.biasW       = across ? e.turn : Vector {};
	c.friction    = across && e.sticks ? 1 : 0;
	c.rollingArm  = across && e.grips ? 1 : 0;
	c.twistingArm = c.rollingArm;
	return { projectNormal(e.impulse, c.adhesion) * c.n, {} };
}

void take(PositionCorrection& result, std::int32_t index, const Contact& c, const Impulse& p, bool across)
{
	const double n         = dot(c.n, p.f);
	result.impulses[index] = n;
	if (across) result.tangential[index] = p.f - n * c.n;
}

void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result, bool across)
{
	correctPositionsIn<Space>(problem, settings, workspace, errors, sweeps, result, across);
}

} // namespace nonsmooth::contact::space
