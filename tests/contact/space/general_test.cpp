// Contacts of bodies that are no balls, and of bodies whose motion is given: the numbers that the law makes of them,
// against definitions written anew.
#include "manufactured.hpp"
#include <contact/space/law.hpp>
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;
using nonsmooth::contact::SpeedScale;

namespace {

TEST(SpaceGeneral, TheDiagonalIsThatOfTheStiffestDirection)
{
	const Manufactured m      = manufactured({ 5, 200, 1.0, false });
	int                unlike = 0;
	for (std::size_t k = 0; k < m.links.size(); ++k) {
		const Contact&     c = m.problem.contacts[k];
		const InverseMass &i = m.problem.inverseMass[c.i], &j = m.problem.inverseMass[c.j];
		const Diagonal     w = delassus(c, i, j);
		const Link         alone { 0, 1, m.links[k].n, m.links[k].armI, m.links[k].armJ };
		const auto         changed = [&](const Impulse& unit) {
                        std::vector<Twist> v(2);
                        push(alone, unit, { i, j }, 1, v);
                        return seen(alone, v);
		};
		const Vector a = unit(cross(c.n, std::abs(c.n.x) < 0.8 ? Vector { 1, 0, 0 } : Vector { 0, 1, 0 })),
		             b = cross(c.n, a);
		double across = 0, least = HUGE_VAL, rolling = 0;
		for (int angle = 0; angle < 360; ++angle) {
			const Vector t   = std::cos(angle * pi / 360) * a + std::sin(angle * pi / 360) * b;
			const double one = inner(of(t), changed({ t, {} }).u);
			across           = std::max(across, one);
			least            = std::min(least, one);
			rolling          = std::max(rolling, inner(of(t), changed({ {}, t }).w));
		}
		EXPECT_NEAR(w.n, inner(of(c.n), changed({ c.n, {} }).u), 1e-12 * w.n);
		EXPECT_NEAR(w.s, inner(of(c.n), changed({ {}, c.n }).w), 1e-12 * (w.s + 1));
		EXPECT_NEAR(w.t, across, 1e-4 * w.t); // to half a degree
		EXPECT_GE(w.t, across * (1 - 1e-12));
		EXPECT_NEAR(w.r, rolling, 1e-4 * (w.r + 1));
		EXPECT_GE(w.r, rolling * (1 - 1e-12));
		unlike += least < 0.9 * across;
	}
	EXPECT_GT(unlike, 30);
}

TEST(SpaceGeneral, APlateOnThreeBallsIsBorneAsStaticsSays)
{
	// a plate of 4 m × 2 m × 0.1 m on three fixed balls: their forces follow from three balances
	const double m = 800, h = 0.01, g = 9.81;
	Problem      p;
	p.inverseMass = {
		{ 1 / m, 1 / m, 1 / m, { 12 / (m * (4 + 0.01)), 12 / (m * (16 + 0.01)), 12 / (m * 20), 0, 0, 0 } }, {}
	};
	p.freeVelocity        = { { { 0, 0, -g * h }, {} }, {} };
	const Vector points[] = { { -1.5, -0.8, -0.05 }, { 1.7, -0.5, -0.05 }, { 0.3, 0.9, -0.05 } };
	for (const Vector& x : points) {
		Contact c;
		c.i        = 1;
		c.j        = 0;
		c.n        = { 0, 0, 1 };
		c.leverJ   = dot(x, c.n);
		c.asideJ   = x - c.leverJ * c.n;
		c.friction = 0.3;
		p.contacts.push_back(c);
	}
	p.impulses.resize(3);
	SolverSettings s;
	s.tolerance     = 1e-13;
	s.maxIterations = 100000;
	ASSERT_TRUE(solve(p, s).converged);
	Vector force, moment;
	for (int k = 0; k < 3; ++k) {
		force  = force + p.impulses[k].f;
		moment = moment + cross(points[k], p.impulses[k].f);
		EXPECT_GT(p.impulses[k].f.z, 0.1 * m * g * h);
	}
	EXPECT_LE(length(force - Vector { 0, 0, m * g * h }), 1e-9);
	EXPECT_LE(length(moment), 1e-9);
	EXPECT_LE(length(p.velocities[0].v) + length(p.velocities[0].w), 1e-11);
}

TEST(SpaceGeneral, GivenMotionIsOpposedByAllRows)
{
	Contact c;
	c.n            = unit({ 1, 2, 2 });
	c.adhesion     = 3;
	c.friction     = 0.5;
	c.rollingArm   = 0.2;
	c.twistingArm  = 0.1;
	const Vector t = unit(cross(c.n, { 1, 0, 0 })), r = cross(c.n, t);
	const auto   of = [&](double n, double twist) {
                return impulseOfGivenMotion(c, { n, 2. * t, 5. * r + twist * c.n });
	};
	const Impulse held = of(0, -1);
	EXPECT_LE(length(held.f + 1.5 * t), 1e-15);
	EXPECT_LE(length(held.m + 0.6 * r - 0.3 * c.n), 1e-15);
	const Impulse open = of(1, 1); // pulls with all its strength, and has nothing left across
	EXPECT_LE(length(open.f + 3. * c.n), 1e-15);
	EXPECT_LE(length(open.m), 1e-15);
	const Impulse approach = of(-1, 1); // no finite impulse
	EXPECT_EQ(length(approach.f) + length(approach.m), 0);
	EXPECT_LE(length(impulseOfGivenMotion(c, {}).f), 0);
}

// Of two balls of 1 kg that miss 2 N s along the normal W_n = 2/kg makes 4 m/s; where impulses have changed the faster one by
// 3 m/s, 16 of 16 + 9 is the square of what is left open, whichever of the two it is.
TEST(SpaceGeneral, ASpeedIsHeldAgainstTheFasterBody)
{
	Contact c;
	c.n                    = { 0, 0, 1 };
	c.leverI               = 0.5;
	c.leverJ               = -0.5;
	const InverseMass ball = InverseMass::ofSphere(1, 10);
	const Impulse     defect { { 0, 0, 2 }, {} };
	const Twist       fast { { 3, 0, 0 }, {} }, slow { { 0, 1, 0 }, {} };
	const SpeedScale  none { 0, 0, 0 };
	for (const auto& [vi, vj] : { std::pair(slow, fast), std::pair(fast, slow) }) {
		const auto share = speedShare(c, {}, defect, ball, ball, vi, vj, none);
		EXPECT_NEAR(share.all, 16.0 / 25, 1e-15);
		EXPECT_NEAR(share.point, 16.0 / 25, 1e-15);
	}
}

} // namespace
