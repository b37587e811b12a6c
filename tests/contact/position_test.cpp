// Displacements that take back errors of position: exact in small cases, symmetric, and the same bits on any number of threads and with any kernels.
#include "problems.hpp"
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Solves, then finds the displacements.
std::vector<Twist>
displaced(Problem problem, const std::vector<PositionError>& errors, int sweeps, SolverSettings settings = {})
{
	Workspace          workspace;
	PositionCorrection found;
	solve(problem, settings, &workspace);
	correctPositions(problem, settings, workspace, errors, sweeps, found);
	return found.displacements;
}

/// Disks of one radius side by side along x, with the gaps given; without gravity, so that nothing else moves them.
Scene row(const std::vector<double>& gaps, double firstRadius = 0.5)
{
	std::vector<Disk> disks { { 0, 0, firstRadius } };
	double            x = firstRadius;
	for (const double g : gaps) {
		x += g + 0.5;
		disks.push_back({ x, 0, 0.5 });
		x += 0.5;
	}
	Scene scene(std::move(disks));
	scene.touchDisks(0.1);
	for (Twist& v : scene.problem.freeVelocity)
		v = {};
	for (Contact& c : scene.problem.contacts)
		c.biasN = 0;
	return scene;
}

constexpr double rounding = 1e-15; // of a few operations on hundredths

TEST(Positions, TwoDisksShareAnOverlapAsTheirMasses)
{
	const Scene scene = row({ -0.02 }, 1.0); // four times the mass
	const auto  d     = displaced(scene.problem, { { -0.01, false } }, 1);
	EXPECT_NEAR(d[0].x, -0.01 / 5, rounding);
	EXPECT_NEAR(d[1].x, 0.01 * 4 / 5, rounding);
	for (const Twist& t : d) {
		EXPECT_EQ(t.y, 0);
		EXPECT_EQ(t.w, 0);
	}
}

TEST(Positions, AContactOnlyPushesAndABondAlsoPulls)
{
	const Scene scene = row({ 0.02 });
	for (const Twist& t : displaced(scene.problem, { { 0.01, false } }, 5))
		EXPECT_EQ(t.x, 0);
	const auto d = displaced(scene.problem, { { 0.01, true } }, 5);
	EXPECT_NEAR(d[0].x, 0.005, rounding);
	EXPECT_NEAR(d[1].x, -0.005, rounding);
}

TEST(Positions, AnOverlapIsNotTakenBackIntoANeighbour)
{
	// the middle one may go 0.001 before it touches the third, and takes it along from there: masses one, exact answer of the chain
	const Scene scene = row({ -0.03, 0.001 });
	const auto  d     = displaced(scene.problem, { { -0.03, false }, { 0.001, false } }, 200);
	const double q1 = (2 * 0.03 - 0.001) / 3, q2 = (0.03 - 2 * 0.001) / 3; // 2 q1 − q2 = 0.03, 2 q2 − q1 = −0.001
	EXPECT_NEAR(d[0].x, -q1, 1e-12);
	EXPECT_NEAR(d[1].x, q1 - q2, 1e-12);
	EXPECT_NEAR(d[2].x, q2, 1e-12);
}

TEST(Positions, AWallStandsAndADrivenOneDoesNotMove)
{
	Scene scene({ { 0, 0.49, 0.5 } });
	scene.wall(0, 0, 0, 1, 0.1);
	scene.problem.freeVelocity[1] = { 0, 0.3, 0 }; // it is being driven
	const auto d                  = displaced(scene.problem, { { -0.002, false } }, 1);
	EXPECT_NEAR(d[0].y, 0.002, rounding);
	EXPECT_EQ(d[1].y, 0);
}

TEST(Positions, BondsHoldTheirErrorsTogether)
{
	// two bonds: d1 − d0 = 2 q1 − q2 = −e1 and d2 − d1 = 2 q2 − q1 = −e2 for masses one; one is pulled, the other pushed
	const Scene    scene = row({ 0.01, -0.004 });
	const double   e1 = 0.01, e2 = -0.004, q1 = -(2 * e1 + e2) / 3, q2 = -(e1 + 2 * e2) / 3;
	SolverSettings settings;
	for (const bool reference : { false, true }) {
		settings.reference = reference;
		const auto d       = displaced(scene.problem, { { e1, true }, { e2, true } }, 200, settings);
		EXPECT_NEAR(d[0].x, -q1, 1e-12); // 200 sweeps, each a quarter of what the one before left
		EXPECT_NEAR(d[1].x, q1 - q2, 1e-12);
		EXPECT_NEAR(d[2].x, q2, 1e-12);
	}
}

TEST(Positions, SweepsBeginWithTheImpulsesOfTheStepBefore)
{
	// none is made: what the impulses alone do, those that pull taken only where a bond holds
	const Scene    scene = row({ -0.02, 0.01, -0.01 });
	const double   m     = scene.mass(scene.disks[0]);
	SolverSettings settings;
	for (const bool reference : { false, true }) {
		settings.reference = reference;
		const auto d       = displaced(
		              scene.problem,
		              { { -0.02, false, false, false, 0.03 * m },
		                { 0.01, true, false, false, -0.02 * m },
		                { -0.01, false, false, false, -0.05 * m } },
		              0, settings);
		EXPECT_NEAR(d[0].x, -0.03, rounding);
		EXPECT_NEAR(d[1].x, 0.03 + 0.02, rounding);
		EXPECT_NEAR(d[2].x, -0.02, rounding);
		EXPECT_EQ(d[3].x, 0);
	}
}

TEST(Positions, SweepsAreExtrapolatedByNesterovsNumbers)
{
	// two contacts of three disks of one mass by hand, contact after contact
	const Scene  scene = row({ -0.03, 0.001 });
	const double e[2]  = { -0.03, 0.001 };
	for (const Method method : { Method::GaussSeidel, Method::Accelerated })
		for (const int sweeps : { 1, 2, 3, 5 })
			for (const bool reference : { false, true }) {
				double q[2] = {}, before[2] = {}, theta[2] = { 1, 1 };
				for (int k = 0; k < sweeps; ++k) {
					const double beta = method == Method::Accelerated && k > 0
					        ? (theta[0] - 1) / theta[1]
					        : 0;
					double       y[2];
					for (int c = 0; c < 2; ++c) {
						y[c]      = q[c] + beta * (q[c] - before[c]);
						before[c] = q[c];
					}
					q[0] = std::max(
					        0.0,
					        y[0]
					                - 0.5
					                        * (2 * y[0] - y[1]
					                           + e[0])); // W = 2 on the diagonal, −1 beside it
					q[1]     = std::max(0.0, y[1] - 0.5 * (2 * y[1] - q[0] + e[1]));
					theta[0] = k > 0 ? theta[1] : 1;
					theta[1] = 0.5 * (1 + std::sqrt(1 + 4 * theta[0] * theta[0]));
				}
				SolverSettings settings;
				settings.method    = method;
				settings.reference = reference;
				const auto d       = displaced(
				              scene.problem, { { e[0], false }, { e[1], false } }, sweeps, settings);
				EXPECT_NEAR(d[0].x, -q[0], rounding) << sweeps;
				EXPECT_NEAR(d[1].x, q[0] - q[1], rounding) << sweeps;
				EXPECT_NEAR(d[2].x, q[1], rounding) << sweeps;
			}
}

std::vector<PositionError> errorsOf(const Problem& problem)
{
	std::vector<PositionError> errors;
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		errors.push_back({ 1e-3 * std::sin(double(k)), k % 7 == 0, k % 7 == 0, k % 14 == 0, 0,
		                   k % 70 == 0 ? 1e-4f : 0, k % 98 == 0 ? 1e-4f : 0 });
	return errors;
}

TEST(Positions, TheSameBitsOnAnyThreadsAndKernels)
{
	const Scene    scene  = lattice(60, 40);
	const auto     errors = errorsOf(scene.problem);
	SolverSettings one;
	one.maxIterations = 20;
	const auto wanted = displaced(scene.problem, errors, 10, one);
	for (int threads = 1; threads <= 4; ++threads)
		for (const BlockKernels* kernels : availableKernels()) {
			SolverSettings settings = one;
			settings.threads        = threads;
			settings.kernels        = kernels;
			EXPECT_TRUE(sameBits(displaced(scene.problem, errors, 10, settings), wanted))
			        << threads << " threads, " << kernels->name;
		}
}

TEST(Positions, TheCentreOfMassStays)
{
	Scene scene = lattice(30, 20);
	// without the floor
	while (!scene.problem.contacts.empty() && scene.problem.contacts.back().i >= int(scene.disks.size()))
		scene.problem.contacts.pop_back(), scene.problem.impulses.pop_back();
	const auto d = displaced(scene.problem, errorsOf(scene.problem), 10);
	double     x = 0, y = 0, moved = 0;
	for (std::size_t k = 0; k < scene.disks.size(); ++k) {
		const double m = scene.mass(scene.disks[k]);
		x += m * d[k].x;
		y += m * d[k].y;
		moved += m * (std::abs(d[k].x) + std::abs(d[k].y));
	}
	EXPECT_GT(moved, 0);
	// equal and opposite pseudo-impulses, rounded some thousand times
	EXPECT_NEAR(x, 0, 1e-13 * moved);
	EXPECT_NEAR(y, 0, 1e-13 * moved);
}

TEST(Positions, ReferenceAndBlocksAgree)
{
	const Scene    scene  = lattice(30, 20);
	const auto     errors = errorsOf(scene.problem);
	SolverSettings blocks, reference;
	reference.reference = true;
	// another order of contacts, the same answer once it has settled
	const auto a   = displaced(scene.problem, errors, 3000, blocks),
	           b   = displaced(scene.problem, errors, 3000, reference);
	double largest = 0, apart = 0;
	for (std::size_t k = 0; k < a.size(); ++k) {
		largest = std::max(largest, std::abs(a[k].x) + std::abs(a[k].y));
		apart   = std::max(apart, std::abs(a[k].x - b[k].x) + std::abs(a[k].y - b[k].y));
	}
	EXPECT_GT(largest, 1e-4);
	EXPECT_LT(apart, 1e-3 * largest);
}

/// A bond of two disks that has slipped and turned, with the place of an unbonded third disk beside it.
PositionError strained(double slip, double turn)
{
	return { 0, true, true, true, 0, static_cast<float>(slip), static_cast<float>(turn) };
}

TEST(Positions, ABondGoesBackWhatItHasSlipped)
{
	const double slip = float(0.004), turn = float(0.006);
	for (const double radius : { 0.5, 1.0 })
		for (const bool reference : { false, true }) {
			const Scene        scene   = row({ 0.0 }, radius);
			Problem            problem = scene.problem;
			Workspace          workspace;
			PositionCorrection found;
			SolverSettings     settings;
			settings.reference = reference;
			solve(problem, settings, &workspace);
			correctPositions(problem, settings, workspace, { strained(slip, turn) }, 200, found);
			const auto& d = found.displacements;
			// along the tangent, about the contact, and along the normal
			EXPECT_NEAR(d[1].y - d[0].y - 0.5 * d[1].w - radius * d[0].w, -slip, 1e-12) << radius;
			EXPECT_NEAR(d[1].w - d[0].w, -turn, 1e-12);
			EXPECT_NEAR(d[1].x - d[0].x, 0, 1e-12);
			// by equal and opposite pseudo-impulses: neither the centre moves nor what turns about it
			const double m0 = scene.mass(scene.disks[0]), m1 = scene.mass(scene.disks[1]);
			const double about = m1 * (radius + 0.5) * d[1].y + 0.5 * m0 * radius * radius * d[0].w
			        + 0.5 * m1 * 0.25 * d[1].w;
			EXPECT_NEAR(m0 * d[0].y + m1 * d[1].y, 0, 1e-12 * m1);
			EXPECT_NEAR(about, 0, 1e-12 * m1);
			ASSERT_EQ(found.tangential.size(), 1u);
			EXPECT_NEAR(found.tangential[0], m1 * d[1].y, 1e-12 * m1);
		}
}

TEST(Positions, WhereABondMayGiveNothingIsAskedOfIt)
{
	const Scene   scene  = row({ 0.0 });
	PositionError slides = strained(0, 0.006), turns = strained(0.004, 0);
	slides.sticks   = false;
	turns.grips     = false;
	const auto slid = displaced(scene.problem, { slides }, 200), turned = displaced(scene.problem, { turns }, 200);
	// alone: opposite turns by half each, and a slip that the masses share with the turns as m : m/2 = 1/3 : 2/3
	EXPECT_NEAR(slid[1].w, -0.003, 1e-9);
	EXPECT_EQ(slid[1].y, 0);
	EXPECT_NEAR(turned[1].y - turned[0].y, -0.004 / 3, 1e-9);
	EXPECT_NEAR(turned[0].w, turned[1].w, 1e-12);
}

TEST(Positions, RefusesErrorsOfOtherContacts)
{
	Problem            problem = row({ -0.02 }).problem;
	Workspace          workspace;
	PositionCorrection found;
	EXPECT_THROW(
	        correctPositions(problem, {}, workspace, { { -0.01, false } }, 1, found),
	        std::invalid_argument); // nothing was solved yet
	solve(problem, {}, &workspace);
	EXPECT_THROW(correctPositions(problem, {}, workspace, {}, 1, found), std::invalid_argument);
}

} // namespace
