// Errors of position in space are taken back by displacements: by hand for pairs, by their conditions for a packing.
#include "balls.hpp"
#include <contact/space/law.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;

namespace {

PositionCorrection corrected(Problem p, const std::vector<PositionError>& errors, int sweeps, SolverSettings s = {})
{
	Workspace workspace;
	s.maxIterations = 1;
	solve(p, s, &workspace);
	PositionCorrection result;
	correctPositions(p, s, workspace, errors, sweeps, result);
	return result;
}

/// Two balls of unequal size.
Problem pair(double friction = 0.3)
{
	Balls scene({ { { 0, 0, 0 }, 0.5 }, { { 0.4, 0.6, 0.7 }, 0.55 } });
	scene.friction = friction;
	scene.touch(0.1);
	for (Twist& v : scene.problem.freeVelocity)
		v = {};
	return scene.problem;
}

RelativeVelocity moved(const Problem& p, const PositionCorrection& c)
{
	return relativeVelocity(p.contacts[0], c.displacements[p.contacts[0].i], c.displacements[p.contacts[0].j]);
}

class SpacePositions : public ::testing::TestWithParam<bool> {
protected:
	SolverSettings settings() const
	{
		SolverSettings s;
		s.reference = GetParam();
		return s;
	}
};
INSTANTIATE_TEST_SUITE_P(InBlocksAndByTheLaw, SpacePositions, ::testing::Bool());

TEST_P(SpacePositions, AnOverlapIsTakenBackByMass)
{
	const Problem p = pair();
	PositionError e;
	e.error           = -0.01;
	const auto result = corrected(p, { e }, 3, settings());
	const auto u      = moved(p, result);
	EXPECT_NEAR(u.n, 0.01, 1e-15);
	EXPECT_LE(length(u.t) + length(u.w), 1e-15);
	const Vector balance = 1 / p.inverseMass[0].x * result.displacements[0].v
	        + 1 / p.inverseMass[1].x * result.displacements[1].v;
	EXPECT_LE(length(balance), 1e-10);
	EXPECT_NEAR(result.impulses[0], 0.01 / (p.inverseMass[0].x + p.inverseMass[1].x), 1e-9);
	e.error = 0.01; // a gap is nobody's error
	EXPECT_EQ(length(corrected(p, { e }, 3, settings()).displacements[0].v), 0);
}

TEST_P(SpacePositions, ABondGoesBackInLengthSlipAndTurn)
{
	const Problem p = pair();
	const Vector  n = p.contacts[0].n, t = unit(cross(n, { 1, 0, 0 }));
	PositionError e;
	e.error = 0.01;
	e.held = e.sticks = e.grips = true;
	e.slip                      = 0.003 * t;
	e.turn                      = 0.02 * t - 0.01 * n; // rolled, and twisted
	const auto result           = corrected(p, { e }, 60, settings());
	const auto u                = moved(p, result);
	EXPECT_NEAR(u.n, -0.01, 1e-12);
	EXPECT_LE(length(u.t + e.slip), 1e-12);
	EXPECT_LE(length(u.w + e.turn), 1e-12);
	EXPECT_EQ(result.tangential.size(), 1u);
	EXPECT_LE(std::abs(dot(n, result.tangential[0])), 1e-9);
	EXPECT_GT(length(result.tangential[0]), 0);
	e.sticks = e.grips = false; // may slip and turn: nothing across is taken back
	const auto free    = moved(p, corrected(p, { e }, 60, settings()));
	EXPECT_NEAR(free.n, -0.01, 1e-12);
	EXPECT_LE(length(free.t) + length(free.w), 1e-14);
}

TEST_P(SpacePositions, OfAPackingNoneIsLeftShortAndBondsAreKept)
{
	Balls                      scene = lattice(5, 5);
	const Problem&             p     = scene.problem;
	std::vector<PositionError> errors(p.contactCount());
	for (std::size_t k = 0; k < errors.size(); ++k) {
		errors[k].error = 1e-3 * std::sin(double(k));
		errors[k].held  = k % 40 == 0;
		if (k % 80 == 0)
			errors[k].sticks = true, errors[k].slip = 1e-3 * unit(cross(p.contacts[k].n, { 0.6, 0.8, 1 }));
	}
	const auto result = corrected(p, errors, 3000, settings());
	for (std::size_t k = 0; k < errors.size(); ++k) {
		const Contact& c = p.contacts[k];
		const auto     u = relativeVelocity(c, result.displacements[c.i], result.displacements[c.j]);
		EXPECT_GE(u.n + errors[k].error, -1e-9) << k;
		if (errors[k].held) {
			EXPECT_LE(u.n + errors[k].error, 1e-9) << k;
		}
		if (errors[k].sticks) {
			EXPECT_LE(length(u.t + errors[k].slip), 1e-8) << k;
		}
		if (!errors[k].held) {
			EXPECT_GE(result.impulses[k], 0) << k;
		}
		if (!errors[k].held && u.n + errors[k].error > 1e-8) {
			EXPECT_EQ(result.impulses[k], 0) << k;
		}
	}
}

TEST(SpacePositionBits, AreTheSameByAllInstructionsAndThreads)
{
	const Problem p = lattice(10, 9).problem;
	for (const bool bonds : { false, true }) {
		std::vector<PositionError> errors(p.contactCount());
		for (std::size_t k = 0; k < errors.size(); ++k) {
			errors[k].error   = 1e-3 * std::sin(double(k));
			errors[k].impulse = 1e-3;
			if (bonds && k % 5 == 0)
				errors[k].held = errors[k].sticks = true,
				errors[k].slip = 1e-3 * unit(cross(p.contacts[k].n, { 0.6, 0.8, 1 }));
		}
		const auto first = corrected(p, errors, 10);
		for (const int threads : { 1, 2, 4 })
			for (const BlockKernels* kernels : availableKernels()) {
				SolverSettings s;
				s.threads        = threads;
				s.kernels        = kernels;
				const auto other = corrected(p, errors, 10, s);
				EXPECT_TRUE(sameBits(other.displacements, first.displacements))
				        << kernels->name << threads;
				EXPECT_TRUE(sameBits(other.impulses, first.impulses)) << kernels->name << threads;
				EXPECT_TRUE(sameBits(other.tangential, first.tangential)) << kernels->name << threads;
			}
	}
}

} // namespace
