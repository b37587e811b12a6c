// Sweeps in single precision: what they find is held against the law in doubles, in any units and however fast everything moves.
#include "every_path.hpp"
#include "problems.hpp"
#include <contact/plane/law.hpp>
#include <contact/plane/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// A packing that falls, with spins, bonds, and some contacts outside blocks.
Problem packed()
{
	Problem p = mixedLattice();
	for (std::size_t b = 0; b < p.bodyCount(); b += 3)
		if (!p.inverseMass[b].isFixed()) p.freeVelocity[b].w = 0.1 * double(b % 7) - 0.3;
	for (std::size_t k = 0; k < p.contactCount(); k += 3)
		p.contacts[k].adhesion = 10;
	return p;
}

SolverSettings withTolerance(double tolerance)
{
	SolverSettings s;
	s.tolerance     = tolerance;
	s.maxIterations = 20000;
	return s;
}

/// Masses and impulses `scale` times as large.
Problem inUnits(Problem p, double scale)
{
	for (InverseMass& m : p.inverseMass)
		m = { m.x / scale, m.y / scale, m.w / scale };
	for (Contact& c : p.contacts)
		c.adhesion *= scale;
	return p;
}

/// Expects floats to have done everything but the end.
void expectSingle(const SolverStatistics& s)
{
	EXPECT_TRUE(s.converged);
	EXPECT_GT(s.inSingle, 0);
	EXPECT_EQ(s.iterations, s.inSingle);
}

/// Expects a solution in doubles, by formulas that are none of the sweeps'.
void expectSolved(const Problem& p, const SolverStatistics& s, double tolerance)
{
	EXPECT_TRUE(s.converged);
	const Residual found = naturalMapResidual(p);
	EXPECT_LE(found.relative(), tolerance * (1 + 1e-6)); // sums in another order
	EXPECT_NEAR(
	        s.residual.relative(), found.relative(), 1e-9 * tolerance); // rounding of velocities near 1e-15 of them
	EXPECT_LE(largestDifference(p.velocities, velocitiesOf(p)), 1e-12); // m/s; the same sums in another order
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		const Contact& c = p.contacts[k];
		const Impulse& i = p.impulses[k];
		ASSERT_GE(i.n, -c.adhesion) << k;
		ASSERT_LE(std::abs(i.t), slidingThreshold(c, i.n)) << k;
		ASSERT_LE(std::abs(i.r), rollingThreshold(c, i.n)) << k;
	}
}

} // namespace

TEST(Precision, DoublesHoldWhatFloatsHaveFound)
{
	for (const double tolerance : { 1e-3, 1e-4, finestInSingle })
		for (const Method method : methods) {
			if (method == Method::GaussSeidel && tolerance < 1e-3) continue; // thousands of sweeps
			SCOPED_TRACE(tolerance);
			Problem        p = packed();
			SolverSettings s = withTolerance(tolerance);
			s.method         = method;
			s.threads        = 2;
			const auto found = solve(p, s);
			expectSingle(found);
			expectSolved(p, found, tolerance);
		}
}

// who breaks and who slides is asked by comparing with the threshold: beside it by a rounding, bonds that open would hold
TEST(Precision, WhatIsOnItsThresholdIsOnThatOfDoubles)
{
	Problem p = packed();
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		p.contacts[k].adhesion   = k % 3 == 0 ? 0.1 + 0.7 * double(k % 11) : 0; // weak, and no floats
		p.contacts[k].friction   = 0.1 + 0.01 * double(k % 7);
		p.contacts[k].rollingArm = 0.003 + 0.001 * double(k % 5);
	}
	for (Twist& v : p.freeVelocity)
		v.x *= 1 + v.y; // shears
	for (std::size_t b = 0; b < p.bodyCount(); ++b)
		if (!p.inverseMass[b].isFixed()) p.freeVelocity[b].x += 0.02 * double(b % 60 % 7) - 0.06;
	expectSingle(solve(p, withTolerance(1e-4)));
	int        on[3] = {};
	const auto count = [](int& found, double value, double threshold) {
		if (!(value > 0) || value < (1 - 1e-6) * threshold) return; // a float has seven digits
		ASSERT_EQ(value, threshold);
		++found;
	};
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		const Contact& c = p.contacts[k];
		const Impulse& i = p.impulses[k];
		count(on[0], -i.n, c.adhesion);
		count(on[1], std::abs(i.t), slidingThreshold(c, i.n));
		count(on[2], std::abs(i.r), rollingThreshold(c, i.n));
	}
	for (const int found : on)
		EXPECT_GT(found, 50);
}

TEST(Precision, FloatsGoTheWayOfDoubles)
{
	Problem        single = packed(), twice = packed();
	SolverSettings s  = withTolerance(1e-4);
	const auto     in = solve(single, s);
	s.precision       = Precision::Double;
	const auto both   = solve(twice, s);
	EXPECT_EQ(both.inSingle, 0);
	EXPECT_EQ(in.iterations, both.iterations);
	// Rounding of 1e-7 in each of some hundred sweeps, beside a residual of 1e-4; that of another way would be another number.
	EXPECT_NEAR(in.residual.relative(), both.residual.relative(), 0.02 * both.residual.relative());
}

TEST(Precision, TheSameBitsOnAnyThreadsAndInstructions) { expectTheSameBits(packed(), withTolerance(finestInSingle)); }

// a float has seven digits: of 10 km/s it does not see the step's 5 cm/s
TEST(Precision, HoweverFastEverythingMoves)
{
	Problem p = packed();
	for (Twist& v : p.freeVelocity)
		v.x += 1e4;
	const auto found = solve(p, withTolerance(1e-4));
	expectSingle(found);
	EXPECT_LE(naturalMapResidual(p).relative(), 1e-4 * (1 + 1e-6));
}

TEST(Precision, BondsThatHoldWhateverItCosts)
{
	Problem p = packed();
	for (std::size_t k = 0; k < p.contactCount(); k += 5) {
		p.contacts[k].adhesion = 1e100;
		p.contacts[k].friction = p.contacts[k].rollingArm = 0; // times infinity this would be no number
	}
	const auto found = solve(p, withTolerance(1e-4));
	expectSingle(found);
	expectSolved(p, found, 1e-4);
}

TEST(Precision, InAnyUnits)
{
	// doubles are scaled without rounding by a power of two, and so are floats
	Problem        plain  = packed();
	const auto     wanted = solve(plain, withTolerance(1e-4));
	constexpr auto exact  = [](int power) { return std::ldexp(1.0, power); };
	for (const int power : { -30, 30 }) { // 1e9 times as much and as little
		Problem    p     = inUnits(packed(), exact(power));
		const auto found = solve(p, withTolerance(1e-4));
		expectSingle(found);
		EXPECT_EQ(found.iterations, wanted.iterations);
		for (std::size_t k = 0; k < p.contactCount(); ++k)
			ASSERT_EQ(p.impulses[k].n, plain.impulses[k].n * exact(power)) << k;
	}
	for (const int power : { -150, 150 }) { // no numbers for floats
		SCOPED_TRACE(power);
		Problem    p     = inUnits(packed(), exact(power));
		const auto found = solve(p, withTolerance(1e-4));
		EXPECT_TRUE(found.converged);
		EXPECT_GT(found.iterations, found.inSingle);
		EXPECT_LE(naturalMapResidual(p).relative(), 1e-4 * (1 + 1e-6));
	}
}

TEST(Precision, WhatFloatsCannotReachIsLeftToDoubles)
{
	const auto inSingle = [](const SolverSettings& s) {
		Problem p = packed();
		return solve(p, s).inSingle;
	};
	EXPECT_GT(inSingle(withTolerance(finestInSingle)), 0);
	EXPECT_EQ(inSingle(withTolerance(0.99 * finestInSingle)), 0);
	SolverSettings s = withTolerance(1e-3);
	s.precision      = Precision::Double;
	EXPECT_EQ(inSingle(s), 0);
	s           = withTolerance(1e-3);
	s.reference = true;
	EXPECT_EQ(inSingle(s), 0);
	s          = withTolerance(1e-3);
	s.stopping = StoppingTest::Quad;
	EXPECT_EQ(inSingle(s), 0);
}

TEST(Precision, BothShareTheSweepsThatMayBeMade)
{
	Problem        p = packed();
	SolverSettings s = withTolerance(finestInSingle);
	s.maxIterations  = 20;
	const auto found = solve(p, s);
	EXPECT_FALSE(found.converged);
	EXPECT_EQ(found.iterations, 20);
	EXPECT_EQ(found.inSingle, 20);
	EXPECT_LE(largestDifference(p.velocities, velocitiesOf(p)), 1e-12);
}

TEST(Precision, NamesOfSettings)
{
	EXPECT_EQ(precisionOf("mixed"), Precision::Mixed);
	EXPECT_EQ(precisionOf("double"), Precision::Double);
	EXPECT_EQ(methodOf("accelerated"), Method::Accelerated);
	EXPECT_EQ(methodOf("gaussSeidel"), Method::GaussSeidel);
	const auto refusal = [](auto look, const char* name) -> std::string {
		try {
			look(name);
		} catch (const std::invalid_argument& error) {
			return error.what();
		}
		return "taken";
	};
	EXPECT_EQ(refusal(precisionOf, "half"), "'half': it must be 'mixed' or 'double'");
	EXPECT_EQ(refusal(methodOf, ""), "'': it must be 'accelerated' or 'gaussSeidel'");
}
