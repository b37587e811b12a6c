// Contact problems whose solution is known, and what every solution must keep.
#include "problems.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

SolverSettings exact(Method method)
{
	SolverSettings s;
	s.method        = method;
	s.tolerance     = 1e-13;
	s.maxIterations = 20000;
	s.checkEvery    = 1;
	return s;
}

/// One contact of a unit mass without levers (W = I) with a fixed body; the free relative velocity is q.
Problem single(const Impulse& q, double angle = 0, double mass = 1)
{
	Problem p;
	p.inverseMass = { {}, { 1 / mass, 1 / mass, 1 / mass } };
	Contact c;
	c.i            = 0;
	c.j            = 1;
	c.nx           = std::cos(angle);
	c.ny           = std::sin(angle);
	c.friction     = 0.3;
	c.rollingArm   = 0.1;
	p.contacts     = { c };
	p.freeVelocity = { {}, { c.nx * q.n - c.ny * q.t, c.ny * q.n + c.nx * q.t, q.r } };
	p.impulses.resize(1);
	return p;
}

/// Of impulses, or of relative velocities.
template <class Rows> void expectNear(const Rows& a, const std::common_type_t<Rows>& b, double tolerance)
{
	EXPECT_NEAR(a.n, b.n, tolerance);
	EXPECT_NEAR(a.t, b.t, tolerance);
	EXPECT_NEAR(a.r, b.r, tolerance);
}

class OneContact : public ::testing::TestWithParam<Method> { };

// rounding of a handful of operations on numbers near one
constexpr double rounding = 1e-14;

TEST_P(OneContact, SiconosAnswer)
{
	// Siconos' rolling_fc2d_driver, W = I, q = (−1, 0.5, 0.2), μ = 0.3, μ_r = 0.1: r = (1, −0.3, −0.1), v = (0, 0.2, 0.1)
	Problem p = single({ -1, 0.5, 0.2 });
	EXPECT_TRUE(solve(p, exact(GetParam())).converged);
	expectNear(p.impulses[0], { 1, -0.3, -0.1 }, rounding);
	expectNear(relativeVelocity(p.contacts[0], p.velocities[0], p.velocities[1]), { 0, 0.2, 0.1 }, rounding);
}

TEST_P(OneContact, FrameAndMassScaleTheAnswer)
{
	for (const double angle : { 0.3, 1.7, -2.9 }) {
		Problem p = single({ -1, 0.5, 0.2 }, angle, 7);
		EXPECT_TRUE(solve(p, exact(GetParam())).converged);
		expectNear(p.impulses[0], { 7, -2.1, -0.7 }, 7 * rounding);
		expectNear(
		        relativeVelocity(p.contacts[0], p.velocities[0], p.velocities[1]), { 0, 0.2, 0.1 }, rounding);
	}
}

TEST_P(OneContact, SticksBelowTheThresholds)
{
	Problem p = single({ -1, 0.25, -0.05 });
	solve(p, exact(GetParam()));
	expectNear(p.impulses[0], { 1, -0.25, 0.05 }, rounding);
	expectNear(relativeVelocity(p.contacts[0], p.velocities[0], p.velocities[1]), {}, rounding);
}

TEST_P(OneContact, OpensFreely)
{
	Problem    p = single({ 1, 0.25, -0.05 });
	const auto s = solve(p, exact(GetParam()));
	EXPECT_TRUE(s.converged);
	EXPECT_EQ(s.residual.relative(), 0);
	expectNear(p.impulses[0], {}, 0);
}

TEST_P(OneContact, AdhesionShiftsTheThreeGraphs)
{
	// pulled apart less than F_a holds: tension, and thresholds from F_a + N = 0.5
	Problem p              = single({ 1.5, 0.5, 0.2 });
	p.contacts[0].adhesion = 2;
	solve(p, exact(GetParam()));
	expectNear(p.impulses[0], { -1.5, -0.15, -0.05 }, rounding);
	expectNear(relativeVelocity(p.contacts[0], p.velocities[0], p.velocities[1]), { 0, 0.35, 0.15 }, rounding);
	// pulled more: it yields at −F_a and keeps no friction
	p                      = single({ 2.5, 0.5, 0.2 });
	p.contacts[0].adhesion = 2;
	solve(p, exact(GetParam()));
	expectNear(p.impulses[0], { -2, 0, 0 }, rounding);
	expectNear(relativeVelocity(p.contacts[0], p.velocities[0], p.velocities[1]), { 0.5, 0.5, 0.2 }, rounding);
}

TEST_P(OneContact, BiasIsTheGapThatMayClose)
{
	Problem p           = single({ -1, 0, 0 });
	p.contacts[0].biasN = 0.4; // g/h
	solve(p, exact(GetParam()));
	expectNear(p.impulses[0], { 0.6, 0, 0 }, rounding);
	p                   = single({ -1, 0, 0 });
	p.contacts[0].biasN = 1.4; // the gap does not close within the step
	solve(p, exact(GetParam()));
	expectNear(p.impulses[0], {}, 0);
	p                   = single({ -1, 0, 0 });
	p.contacts[0].biasN = -0.5; // restitution 0.5
	solve(p, exact(GetParam()));
	EXPECT_NEAR(p.velocities[1].x, 0.5, rounding);
}

TEST_P(OneContact, EachRowHasItsBias)
{
	// W = I and nothing at a threshold but the first row's zero: P = −(q + b)
	const Impulse biases[] = { { 0.1, 0, 0 }, { 0, 0.02, 0 }, { 0, 0, -0.03 }, { 0.1, 0.02, -0.03 } };
	for (const Impulse& b : biases) {
		Problem p           = single({ -1, 0.1, 0.02 });
		p.contacts[0].biasN = b.n;
		p.contacts[0].biasT = b.t;
		p.contacts[0].biasR = b.r;
		solve(p, exact(GetParam()));
		expectNear(p.impulses[0], { 1 - b.n, -0.1 - b.t, -0.02 - b.r }, rounding);
	}
}

TEST_P(OneContact, ABodyThatIsTurnedPushesByItsLever)
{
	Problem p              = single({ 0, 0, 0 });
	p.freeVelocity[0]      = { 0, 0, 2 }; // held, and turned
	p.contacts[0].leverNi  = 0.5;
	p.contacts[0].friction = p.contacts[0].rollingArm = 0;
	solve(p, exact(GetParam()));
	EXPECT_NEAR(p.velocities[1].x, 0.5 * 2, rounding); // U_n = v − λ w = 0
	EXPECT_NEAR(p.impulses[0].n, 1, rounding);
}

TEST_P(OneContact, DiskWithALeverRolls)
{
	// a disk that slides with v = 1 on a floor: Coulomb's impulse is limited by what makes it roll, P_t = −m v/3
	for (const double friction : { 0.1, 0.5 }) {
		Scene scene({ { 0, 1, 1 } });
		scene.friction = friction;
		scene.rolling  = 0;
		scene.wall(0, 0, 0, 1, 0.1);
		scene.problem.freeVelocity[0] = { 1, -1, 0 };
		solve(scene.problem, exact(GetParam()));
		const double m = scene.mass(scene.disks[0]), t = std::min(friction, 1.0 / 3) * m;
		EXPECT_NEAR(
		        scene.problem.impulses[0].n, m,
		        1e-11 * m); // the sweep's own convergence, W_tr couples the rows
		EXPECT_NEAR(std::abs(scene.problem.impulses[0].t), t, 1e-11 * m);
		EXPECT_NEAR(scene.problem.velocities[0].x, 1 - t / m, 1e-11);
		EXPECT_NEAR(scene.problem.velocities[0].w, -2 * t / m, 1e-11);
	}
}

TEST_P(OneContact, DrivenBodyPushes)
{
	Problem p         = single({ 0, 0, 0 });
	p.freeVelocity[0] = { 2, 0, 0 }; // fixed masses, given velocity
	solve(p, exact(GetParam()));
	EXPECT_NEAR(p.velocities[1].x, 2, rounding);
	EXPECT_NEAR(p.velocities[0].x, 2, 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, OneContact, ::testing::Values(Method::GaussSeidel, Method::Accelerated));

TEST(Residual, IsASpeedRowByRow)
{
	// W = I, thresholds out of reach: what is missed is the velocity itself, a turn times the length
	Problem p              = single({ 0.3, 0.2, 0.05 });
	p.contacts[0].adhesion = 10;
	p.contacts[0].length   = 2;
	const SpeedResidual s  = naturalMapSpeeds(p);
	EXPECT_NEAR(s.rms, std::sqrt(0.09 + 0.04 + 0.01), rounding);
	EXPECT_NEAR(s.largest, s.rms, rounding);
}

TEST(Residual, ZeroAtTheAnalyticSolution)
{
	Problem p  = single({ -1, 0.5, 0.2 });
	p.impulses = { { 1, -0.3, -0.1 } };
	EXPECT_LE(naturalMapResidual(p).rms, 1e-16); // one rounding of 0.5 − 0.3
	const auto s = solve(p, exact(Method::Accelerated));
	EXPECT_EQ(s.iterations, 0); // a warm start that is right needs no sweep
}

TEST(Residual, MeasuresTheDistanceWhateverMadeIt)
{
	Problem p  = single({ -1, 0.5, 0.2 });
	p.impulses = { { 0, 0, 0 } };
	// with P = 0 the normal row misses 1; the thresholds are zero, so the other rows are satisfied
	EXPECT_NEAR(naturalMapResidual(p).rms, 1, rounding);
	p.impulses = { { 1.5, -0.3, -0.1 } };
	EXPECT_NEAR(naturalMapResidual(p).largest, std::sqrt(0.25 + 0.15 * 0.15 + 0.05 * 0.05), rounding);
}

TEST(Residual, ReportedOneIsThatOfTheReturnedImpulses)
{
	for (const Method method : { Method::GaussSeidel, Method::Accelerated }) {
		Scene          scene = lattice(12, 8);
		SolverSettings s;
		s.method                   = method;
		s.tolerance                = 1e-6;
		s.maxIterations            = 37; // stopped anywhere
		const auto     statistics  = solve(scene.problem, s);
		const Residual independent = naturalMapResidual(scene.problem);
		EXPECT_GT(statistics.residual.rms, 0);
		// the same sums in another order
		EXPECT_NEAR(statistics.residual.rms / independent.rms, 1, 1e-9);
		EXPECT_NEAR(statistics.residual.scale / independent.scale, 1, 1e-12);
		EXPECT_NEAR(statistics.residual.largest / independent.largest, 1, 1e-9);
		const auto v = velocitiesOf(scene.problem);
		for (std::size_t b = 0; b < v.size(); ++b)
			EXPECT_NEAR(v[b].y, scene.problem.velocities[b].y, 1e-12); // velocities are below 1 m/s
	}
}

TEST(Column, FiftyDisksCarryTheirWeight)
{
	std::vector<Disk> disks;
	for (int k = 0; k < 50; ++k)
		disks.push_back({ 0, 0.5 + k, 0.5 });
	for (const Method method : { Method::GaussSeidel, Method::Accelerated }) {
		Scene scene(disks);
		scene.touchDisks(0.01);
		scene.wall(0, 0, 0, 1, 0.01);
		ASSERT_EQ(scene.problem.contactCount(), 50u);
		SolverSettings s      = exact(method);
		s.tolerance           = 1e-11;
		const auto statistics = solve(scene.problem, s);
		EXPECT_TRUE(statistics.converged);
		for (std::size_t k = 0; k < 50; ++k) {
			const Contact& c     = scene.problem.contacts[k];
			const double   above = c.i >= 50 ? 50
			                                 : 50 - std::max(c.i, c.j); // disks that stand on this contact
			// residual 1e-11 times the condition number of a chain of 50, (4·50/π)² ≈ 4e3, gives 4e-8 of the rms impulse at worst
			EXPECT_NEAR(
			        scene.problem.impulses[k].n, above / 50 * scene.weightImpulse(),
			        1e-7 * scene.weightImpulse());
			EXPECT_NEAR(scene.problem.impulses[k].t, 0, 1e-12 * scene.weightImpulse());
		}
	}
}

TEST(Momentum, ConservedWithoutFixedBodies)
{
	Scene scene = lattice(10, 10);
	// no floor, random velocities
	scene.problem.contacts.erase(
	        std::remove_if(
	                scene.problem.contacts.begin(), scene.problem.contacts.end(),
	                [](const Contact& c) { return c.i >= 100; }),
	        scene.problem.contacts.end());
	scene.problem.impulses.resize(scene.problem.contactCount());
	std::mt19937                     random(3);
	std::normal_distribution<double> velocity(0, 1);
	for (auto& v : scene.problem.freeVelocity)
		v = { velocity(random), velocity(random), velocity(random) };
	for (auto& c : scene.problem.contacts)
		c.adhesion = 10;
	const auto momenta = [&](const std::vector<Twist>& v) {
		Impulse sum;
		for (std::size_t b = 0; b < scene.disks.size(); ++b) {
			const Disk&  d = scene.disks[b];
			const double m = scene.mass(d);
			sum.n += m * v[b].x;
			sum.t += m * v[b].y;
			sum.r += m * (d.x * v[b].y - d.y * v[b].x) + 0.5 * m * d.r * d.r * v[b].w;
		}
		return sum;
	};
	SolverSettings s;
	s.maxIterations = 25; // whether solved or not
	solve(scene.problem, s);
	double scale = 0;
	for (const auto& p : scene.problem.impulses)
		scale += std::abs(p.n) + std::abs(p.t) + std::abs(p.r);
	EXPECT_GT(scale, 0);
	// rounding: 300 contacts, levers of 10 m, 1e-16 each
	expectNear(momenta(scene.problem.velocities), momenta(scene.problem.freeVelocity), 1e-13 * scale);
}

TEST(Driven, HeldDiskFeelsTheFullFriction)
{
	// W_tt = W_rr = 0: the disk can only move along the normal, the floor below it is drawn to the right and turned
	for (const int side : { 1, -1 }) {
		Problem p;
		p.inverseMass  = { {}, { 0, 0.5, 0 } };
		p.freeVelocity = { { 1.0 * side, 0, 2.0 * side }, { 0, -3, 0 } };
		Contact c;
		c.i = 0, c.j = 1, c.nx = 0, c.ny = 1, c.leverTj = -1, c.friction = 0.3, c.rollingArm = 0.2,
		c.length   = 2;
		p.contacts = { c };
		p.impulses.resize(1);
		SolverSettings s;
		s.tolerance = 1e-12;
		EXPECT_TRUE(solve(p, s).converged);
		const Impulse found = p.impulses[0];
		EXPECT_NEAR(found.n, 6, 1e-12); // stops 2 kg at 3 m/s
		const double slip = relativeVelocity(c, p.velocities[0], p.velocities[1]).t;
		EXPECT_NEAR(found.t, -std::copysign(0.3 * 6, slip), 1e-12);
		EXPECT_NEAR(found.r, 0.2 * 6 * side, 1e-12); // the floor's turn takes the disk along
		EXPECT_LE(naturalMapResidual(p).relative(), 1e-12);
	}
}

/// What solve() complains about.
std::string complaint(Problem p, const SolverSettings& s = {})
{
	const Problem before = p;
	try {
		solve(p, s);
	} catch (const std::invalid_argument& error) {
		EXPECT_TRUE(sameBits(p.impulses, before.impulses) && p.velocities.size() == before.velocities.size())
		        << "changed before it was refused";
		return error.what();
	}
	return "taken";
}

TEST(Refusal, SizesAndNumbers)
{
	const auto refused = [](auto change, const char* words) {
		Problem p = single({ -1, 0.5, 0.2 });
		change(p);
		const std::string text = complaint(p);
		EXPECT_EQ(text.rfind("contact problem: ", 0), 0u) << text;
		EXPECT_NE(text.find(words), std::string::npos) << text << "; wanted: " << words;
	};
	const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
	refused([](Problem& p) { p.freeVelocity.pop_back(); }, "freeVelocity has 1");
	refused([](Problem& p) { p.impulses.clear(); }, "impulses has 0");
	refused([](Problem& p) { p.positions.resize(1); }, "positions has 1 entries for 2 bodies");
	refused(
	        [=](Problem& p) {
		        p.positions = { { 0, 0 }, { nan, 0 } };
	        },
	        "body 1 has the position (nan, 0): it must be finite");
	refused(
	        [=](Problem& p) {
		        p.positions = { { 0, -infinite }, { 0, 0 } };
	        },
	        "body 0 has the position (0, -inf)"); // a fixed one too
	refused([=](Problem& p) { p.freeVelocity[1].w = nan; }, "body 1 has a velocity");
	refused([=](Problem& p) { p.freeVelocity[1].x = infinite; }, "body 1 has a velocity");
	refused([=](Problem& p) { p.inverseMass[0].w = nan; }, "body 0 has a velocity or mass");
	refused([](Problem& p) { p.inverseMass[1].y = -1; },
	        "body 1 has the inverse mass (1, -1, 1): none may be negative");
	refused([=](Problem& p) { p.impulses[0].r = nan; },
	        "contact 0 between bodies 0 and 1 has the rolling impulse nan: it must be finite");
	refused([=](Problem& p) { p.contacts[0].leverTi = infinite; }, "has the lever t of i inf");
	refused([=](Problem& p) { p.contacts[0].biasN = nan; }, "has the normal bias nan");
	refused([=](Problem& p) { p.contacts[0].friction = nan; }, "has the friction nan");
	refused([=](Problem& p) { p.contacts[0].nx = nan; }, "has the normal x nan");
	refused([](Problem& p) { p.contacts[0].friction = -0.1; }, "has the friction -0.1: it must not be negative");
	refused([](Problem& p) { p.contacts[0].rollingArm = -2; }, "has the rolling arm -2: it must not be negative");
	refused([](Problem& p) { p.contacts[0].adhesion = -3; }, "has the adhesion -3: it must not be negative");
	refused([](Problem& p) { p.contacts[0].length = 0; }, "has the length 0: it must be positive");
	refused([](Problem& p) { p.contacts[0].nx = 0.5; }, "has the normal (0.5, 0): its length must be 1");
	refused([](Problem& p) { p.contacts[0].j = 2; }, "bodies 0 and 2 names a body that is not there: there are 2");
	refused([](Problem& p) { p.contacts[0].i = -1; }, "bodies -1 and 1");
	refused([](Problem& p) { p.contacts[0].i = 1; }, "is one of a body with itself");
	// large numbers are numbers
	Problem large     = single({ 1e308, 1e308, 1e308 });
	large.impulses[0] = { 1e308, 1e308, 1e308 };
	large.positions   = { { 1e308, 1e308 }, { -1e308, 1e308 } };
	EXPECT_EQ(complaint(large), "taken");
}

TEST(Refusal, Settings)
{
	const auto refused = [](auto change, const char* words) {
		SolverSettings s;
		change(s);
		EXPECT_EQ(complaint(single({ -1, 0.5, 0.2 }), s), words);
	};
	const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
	refused([=](SolverSettings& s) { s.tolerance = nan; }, "tolerance = nan: it must be positive and finite");
	refused([=](SolverSettings& s) { s.tolerance = infinite; }, "tolerance = inf: it must be positive and finite");
	refused([](SolverSettings& s) { s.tolerance = 0; }, "tolerance = 0: it must be positive and finite");
	refused([](SolverSettings& s) { s.maxIterations = -1; }, "maxIterations = -1: it must not be negative");
	refused([](SolverSettings& s) { s.checkEvery = 0; }, "checkEvery = 0: it must be from 1 to 1000000");
	refused([](SolverSettings& s) { s.checkEvery = std::numeric_limits<int>::max(); },
	        "checkEvery = 2147483647: it must be from 1 to 1000000");
	refused([](SolverSettings& s) { s.threads = 0; }, "threads = 0: it must be from 1 to 1024");
	refused([](SolverSettings& s) { s.threads = 100000; }, "threads = 100000: it must be from 1 to 1024");
	SolverSettings none;
	none.maxIterations = 0; // asks for the residual alone
	EXPECT_EQ(complaint(single({ -1, 0.5, 0.2 }), none), "taken");
}

TEST(Empty, NoContactsAndNoBodies)
{
	Problem p;
	EXPECT_TRUE(solve(p, {}).converged);
	p = single({ -1, 0, 0 });
	p.contacts.clear();
	p.impulses.clear();
	EXPECT_TRUE(solve(p, {}).converged);
	EXPECT_EQ(p.velocities[1].x, -1);
}

} // namespace
