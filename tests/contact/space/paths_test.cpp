// Every way through the solver in space: threads and instructions change no bit, blocks and the reference find the same
// motion, and the residual reported is that of
// the definition.
#include "balls.hpp"
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;
using nonsmooth::contact::Method;
using nonsmooth::contact::Precision;

namespace {

/// Bonds that hold, some with play; walls that turn, and a body that is no ball: something of all that a solve can
/// meet.
Problem mixed()
{
	Problem p = lattice(9, 9).problem;
	for (std::size_t k = 0; k < p.contactCount(); k += 3) {
		p.contacts[k].adhesion = 40;
		p.contacts[k].play     = k % 2 == 0 ? 0.01 : 0;
	}
	for (std::size_t b = 0; b < p.bodyCount(); b += 7)
		p.freeVelocity[b] = { { 0.1, -0.05 * double(b % 3), 0.02 }, { 0.3, 0.1, -0.2 } };
	p.freeVelocity.back()         = { { 0.1, 0, 0 }, { 0, 0, 0.5 } }; // the floor turns
	p.inverseMass[100].inertia.xy = 0.2 * p.inverseMass[100].inertia.xx;
	p.contacts[500].asideJ        = { 0.01, 0, 0 };
	return p;
}

/// Expects the same solution, to the last bit, on any number of threads and by any kernels.
void expectTheSameBits(const Problem& problem, const SolverSettings& common)
{
	Problem    first  = problem;
	const auto wanted = solve(first, common);
	EXPECT_GT(wanted.iterations, 0);
	for (const int threads : { 1, 2, 4, 7 })
		for (const BlockKernels* kernels : availableKernels()) {
			SCOPED_TRACE(kernels->name + (", threads " + std::to_string(threads)));
			Problem        other = problem;
			SolverSettings s     = common;
			s.threads            = threads;
			s.kernels            = kernels;
			const auto found     = solve(other, s);
			EXPECT_EQ(found.iterations, wanted.iterations);
			EXPECT_EQ(found.inSingle, wanted.inSingle);
			EXPECT_EQ(found.residual.rms, wanted.residual.rms);
			EXPECT_TRUE(sameBits(other.impulses, first.impulses));
			EXPECT_TRUE(sameBits(other.velocities, first.velocities));
		}
}

TEST(SpacePaths, AllInstructionsAndThreadsGiveTheSameBits)
{
	ASSERT_STREQ(availableKernels().back()->name, "portable");
	for (const Method method : methods)
		for (const double tolerance : { 1e-4, 1e-12 }) { // floats first, and doubles alone
			SolverSettings s;
			s.method        = method;
			s.maxIterations = 150;
			s.tolerance     = tolerance;
			expectTheSameBits(mixed(), s);
		}
}

// a solve without sweeps gives back what it began with, moved onto the thresholds by the law's own formulas
TEST(SpacePaths, AWarmStartIsMovedOntoItsThresholds)
{
	Problem begun = mixed();
	for (std::size_t k = 0; k < begun.contactCount(); ++k) {
		const double much = k % 2 == 0 ? 1e-3 : 1e3;
		begun.impulses[k] = { { much, -0.4 * much, 0.7 * much }, { 0.2 * much, 0.5 * much, -0.3 * much } };
	}
	SolverSettings none;
	none.maxIterations = 0;
	forEachPath(begun, none, [&begun](const SolverSettings& settings, const std::string& name) {
		Problem p = begun;
		solve(p, settings);
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			const Impulse wanted = project(p.contacts[k], begun.impulses[k]), &found = p.impulses[k];
			// rounding of a dozen operations on the largest number
			const double rounding = 1e-13 * (length(begun.impulses[k].f) + length(begun.impulses[k].m));
			EXPECT_LE(length(found.f - wanted.f), rounding) << name << ", contact " << k;
			EXPECT_LE(length(found.m - wanted.m), rounding) << name << ", contact " << k;
		}
	});
}

TEST(SpacePaths, TheResidualReportedIsTheIndependentOne)
{
	for (const bool solved : { false, true }) {
		SolverSettings s;
		s.maxIterations = solved ? 5000 : 30;
		s.tolerance     = solved ? 1e-6 : 1e-12;
		forEachPath(mixed(), s, [solved](const SolverSettings& settings, const std::string& name) {
			Problem    p          = mixed();
			const auto statistics = solve(p, settings);
			const auto found = statistics.residual, own = naturalMapResidual(p);
			EXPECT_EQ(statistics.converged, solved) << name;
			EXPECT_NEAR(found.rms / own.rms, 1, 1e-6) << name;
			EXPECT_NEAR(found.largest / own.largest, 1, 1e-6) << name;
			EXPECT_NEAR(found.scale / own.scale, 1, 1e-12) << name;
			EXPECT_LE(largestDifference(velocitiesOf(p), p.velocities), 1e-12) << name;
		});
	}
}

TEST(SpacePaths, FloatsFirstLeaveWhatDoublesHold)
{
	Problem        mixedPrecision = lattice(12, 12).problem, exact = mixedPrecision;
	SolverSettings s;
	s.tolerance      = 1e-4;
	const auto found = solve(mixedPrecision, s);
	EXPECT_TRUE(found.converged);
	EXPECT_GT(found.inSingle, 0);
	EXPECT_LE(found.iterations - found.inSingle, 10);
	EXPECT_LE(naturalMapResidual(mixedPrecision).relative(), s.tolerance * (1 + 1e-6));
	s.precision     = Precision::Double;
	const auto slow = solve(exact, s);
	EXPECT_EQ(slow.inSingle, 0);
	EXPECT_NEAR(double(found.iterations), double(slow.iterations), 20);
}

TEST(SpacePaths, BlocksAndTheReferenceFindTheSameMotion)
{
	// frictionless, so that the motion is unique
	Problem p = lattice(8, 6).problem;
	for (Contact& c : p.contacts)
		c.friction = c.rollingArm = c.twistingArm = 0;
	SolverSettings s;
	s.tolerance     = 1e-11;
	s.maxIterations = 20000;
	Problem first   = p;
	ASSERT_TRUE(solve(first, s).converged);
	forEachPath(p, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem other = p;
		EXPECT_TRUE(solve(other, settings).converged) << name;
		EXPECT_LE(largestDifference(other.velocities, first.velocities), 1e-9) << name;
	});
}

TEST(SpacePaths, AKeptLayoutChangesNoBit)
{
	Problem        p = mixed(), other = p;
	SolverSettings s;
	s.maxIterations = 40;
	Workspace kept;
	for (int k = 0; k < 3; ++k) {
		solve(p, s, &kept);
		solve(other, s);
		EXPECT_TRUE(sameBits(p.impulses, other.impulses)) << k;
		EXPECT_EQ(kept.laidOut.kept, k > 0);
	}
}

} // namespace
