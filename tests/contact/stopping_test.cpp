// Stopping tests by name: their figures by hand for one contact, and where they stop a solve.
#include "problems.hpp"
#include <contact/plane/residual.hpp>
#include <contact/plane/stopping.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Contacts of unit masses without levers (W = I), each with a fixed body of its own; free relative velocities q.
Problem apart(const std::vector<Impulse>& q)
{
	Problem p;
	for (const Impulse& one : q) {
		Contact c;
		c.i          = static_cast<int>(p.inverseMass.size());
		c.j          = c.i + 1;
		c.friction   = 0.3;
		c.rollingArm = 0.1;
		p.contacts.push_back(c);
		p.inverseMass.insert(p.inverseMass.end(), { {}, { 1, 1, 1 } });
		p.freeVelocity.insert(p.freeVelocity.end(), { {}, { one.n, one.t, one.r } });
		p.impulses.emplace_back();
	}
	return p;
}

constexpr double       rounding = 1e-14;
constexpr StoppingTest named[]  = { StoppingTest::Quad, StoppingTest::QM16, StoppingTest::Maxm }; // from lax to strict

TEST(Stopping, FiguresOfOneContactByHand)
{
	// From P = 0 a visit makes P' = (1, −0.3, −0.1): D = −P', R = P'/2, D² = 1.1, s = e = 0.55
	const VelocityChanges one = velocityChanges(apart({ { -1, 0.5, 0.2 } }));
	EXPECT_NEAR(one.velocity, std::sqrt(2), rounding);
	EXPECT_NEAR(one.largestVelocity, std::sqrt(2), rounding);
	EXPECT_NEAR(one.work, std::sqrt(1.1 * 0.275) / 0.55, rounding);
	EXPECT_NEAR(one.largestWork, one.work, rounding);
	EXPECT_NEAR(one.drift, -1, rounding);
	EXPECT_NEAR(one.figure(StoppingTest::Quad), std::sqrt(2), rounding);
	EXPECT_NEAR(one.figure(StoppingTest::QM16), std::sqrt(2), rounding);
}

TEST(Stopping, MeansAreOverActiveContactsAndMaximaAreNot)
{
	// one contact misses δ, one is exact, one open: D = (δ, 0, 0) in the first, N = 2, s = 1 + O(δ)
	Problem      p          = apart({ { -1, 0, 0 }, { -1, 0, 0 }, { 1, 0, 0 } });
	const double delta      = 1e-6;
	p.impulses              = { { 1 + delta, 0, 0 }, { 1, 0, 0 }, {} };
	const VelocityChanges c = velocityChanges(p);
	EXPECT_NEAR(c.velocity, delta / std::sqrt(2), 2 * delta * delta);
	EXPECT_NEAR(c.largestVelocity, delta, 2 * delta * delta);
	EXPECT_NEAR(c.work, delta / std::sqrt(2), 2 * delta * delta);
	EXPECT_NEAR(c.largestWork, delta, 2 * delta * delta);
	EXPECT_NEAR(c.drift, delta / 2, 2 * delta * delta);
	EXPECT_EQ(c.figure(StoppingTest::Maxm), std::max(c.largestVelocity, c.largestWork));
	EXPECT_EQ(c.figure(StoppingTest::QM16), std::max(c.velocity, c.work)); // δ/16.666 is less
}

TEST(Stopping, QM16TakesASixteenthOfTheWorst)
{
	// one of a thousand contacts misses δ: means see δ/√1000, the worst is δ, and its sixteenth is more
	std::vector<Impulse> q(1000, { -1, 0, 0 });
	Problem              p     = apart(q);
	const double         delta = 1e-6;
	p.impulses.assign(q.size(), { 1, 0, 0 });
	p.impulses[77].n += delta;
	const VelocityChanges c = velocityChanges(p);
	EXPECT_NEAR(c.figure(StoppingTest::Quad), delta / std::sqrt(1000), delta * delta);
	EXPECT_NEAR(c.figure(StoppingTest::Maxm), delta, 2 * delta * delta);
	EXPECT_NEAR(c.figure(StoppingTest::QM16), delta / 16.666, delta * delta);
}

TEST(Stopping, RollingCountsInVelocitiesTimesLength)
{
	// the same disk and bodies twice as large, velocities and masses alike: the figures have no unit
	VelocityChanges figures[2];
	for (const int scale : { 1, 2 }) {
		Scene scene({ { 0, 1.0 * scale, 1.0 * scale } });
		scene.density /= scale * scale;
		scene.problem.inverseMass[0] = { 1 / scene.mass(scene.disks[0]), 1 / scene.mass(scene.disks[0]),
			                         2 / (scene.mass(scene.disks[0]) * scale * scale) };
		scene.wall(0, 0, 0, 1, 0.1);
		scene.problem.freeVelocity[0] = { 0.2, -1, 0.5 / scale };
		figures[scale - 1]            = velocityChanges(scene.problem);
	}
	EXPECT_NEAR(figures[0].velocity, figures[1].velocity, rounding);
	EXPECT_NEAR(figures[0].work, figures[1].work, rounding);
}

TEST(Stopping, NothingActiveIsSolved)
{
	Problem p = apart({ { 1, 0.5, 0.2 } });
	for (const StoppingTest test : named) {
		EXPECT_EQ(velocityChanges(p).figure(test), 0);
		SolverSettings s;
		s.stopping            = test;
		const auto statistics = solve(p, s);
		EXPECT_TRUE(statistics.converged);
		EXPECT_EQ(statistics.iterations, 0);
	}
	p.impulses[0].n = std::nan("");
	EXPECT_EQ(velocityChanges(p).figure(StoppingTest::Quad), HUGE_VAL);
}

TEST(Stopping, EachStopsAtItsFirstFigureBelowTheTolerance)
{
	// Quad, QM/16, Maxm
	const std::map<Method, std::vector<int>> pinned { { Method::GaussSeidel, { 35, 35, 41 } },
		                                          { Method::Accelerated, { 28, 28, 35 } } };
	for (const auto& [method, wanted] : pinned) {
		std::size_t number = 0;
		for (const StoppingTest test : named) {
			SolverSettings s;
			s.method              = method;
			s.stopping            = test;
			s.tolerance           = 1e-4;
			s.maxIterations       = 20000;
			s.checkEvery          = 1;
			Scene      scene      = lattice(12, 8);
			const auto statistics = solve(scene.problem, s);
			EXPECT_TRUE(statistics.converged);
			EXPECT_LE(statistics.changes.figure(test), s.tolerance * (1 + 1e-6));
			// what is reported belongs to what is returned: the same sums in another order
			const VelocityChanges changes  = velocityChanges(scene.problem);
			const Residual        residual = naturalMapResidual(scene.problem);
			EXPECT_NEAR(statistics.changes.velocity / changes.velocity, 1, 1e-8);
			EXPECT_NEAR(statistics.changes.largestWork / changes.largestWork, 1, 1e-8);
			EXPECT_NEAR(statistics.residual.rms / residual.rms, 1, 1e-8);
			const int sweeps = wanted[number++];
			EXPECT_EQ(statistics.iterations, sweeps); // from lax to strict
			// not a sweep too late
			s.maxIterations  = sweeps - 1;
			Scene      again = lattice(12, 8);
			const auto early = solve(again.problem, s);
			EXPECT_FALSE(early.converged);
			EXPECT_GT(early.changes.figure(test), s.tolerance);
			EXPECT_EQ(early.iterations, sweeps - 1);
		}
	}
}

TEST(Stopping, AskingChangesNoBit)
{
	for (const StoppingTest test : named) {
		SolverSettings s;
		s.stopping    = test;
		s.tolerance   = 1e-3;
		s.checkEvery  = 20; // too seldom for strips to rest, which the natural map alone allows
		Scene     one = lattice(40, 20), two = lattice(40, 20), three = lattice(40, 20);
		const int sweeps = solve(one.problem, s).iterations;
		s.threads        = 2;
		s.kernels        = availableKernels().back();
		const auto other = solve(two.problem, s);
		EXPECT_EQ(other.iterations, sweeps);
		EXPECT_TRUE(sameBits(one.problem.impulses, two.problem.impulses));
		SolverSettings plain;
		plain.tolerance     = 1e-15; // never reached
		plain.maxIterations = sweeps;
		plain.checkEvery    = s.checkEvery;
		EXPECT_EQ(solve(three.problem, plain).iterations, sweeps);
		EXPECT_TRUE(sameBits(one.problem.impulses, three.problem.impulses));
	}
}

TEST(Stopping, QuadOverlooksOneNewContactMaxmDoesNot)
{
	Scene          scene = lattice(40, 30);
	SolverSettings s;
	s.tolerance     = 1e-8;
	s.maxIterations = 20000;
	ASSERT_TRUE(solve(scene.problem, s).converged);
	std::size_t strongest = 0;
	for (std::size_t k = 0; k < scene.problem.contactCount(); ++k)
		if (scene.problem.impulses[k].n > scene.problem.impulses[strongest].n) strongest = k;
	scene.problem.impulses[strongest] = {}; // as if it had just been made
	const VelocityChanges c           = velocityChanges(scene.problem);
	// one of N active contacts misses all of its reaction, and its neighbours feel it: rms 1/√N of the largest, N some thousand
	EXPECT_GT(c.figure(StoppingTest::Maxm), 1);
	EXPECT_LT(c.figure(StoppingTest::Quad), 0.2 * c.figure(StoppingTest::Maxm));
}

TEST(Stopping, Names)
{
	EXPECT_EQ(stoppingTestOf("naturalMap"), StoppingTest::NaturalMap);
	EXPECT_EQ(stoppingTestOf("Quad"), StoppingTest::Quad);
	EXPECT_EQ(stoppingTestOf("Maxm"), StoppingTest::Maxm);
	EXPECT_EQ(stoppingTestOf("QM/16"), StoppingTest::QM16);
	try {
		stoppingTestOf("quad");
		ADD_FAILURE() << "taken: quad";
	} catch (const std::invalid_argument& error) {
		EXPECT_STREQ(error.what(), "'quad': it must be 'naturalMap', 'Quad', 'Maxm' or 'QM/16'");
	}
}

} // namespace
