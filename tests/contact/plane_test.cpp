// Bodies, disks and bonds in the plane: by hand, by exact motions, by symmetry.
#include <array>
#include <cmath>
#include <contact/plane/bond.hpp>
#include <contact/plane/disk_contact.hpp>
#include <contact/plane/motion.hpp>
#include <contact/plane/thresholds.hpp>
#include <gtest/gtest.h>
#include <limits>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::plane;

namespace {

constexpr double pi = 3.14159265358979323846;

Rotation turned(double angle) { return { std::sin(angle / 2), std::cos(angle / 2) }; }
double   angleOf(const Rotation& q) { return 2 * std::atan2(q.z, q.w); }

Contact bonded(double adhesion, double friction, double rollingArm, double length)
{
	Contact c;
	c.adhesion   = adhesion;
	c.friction   = friction;
	c.rollingArm = rollingArm;
	c.length     = length;
	return c;
}

// ---- motion

TEST(PlaneMotion, AStepTakesTheNewVelocity)
{
	Motion m { { 1, 2 }, {}, { 3, 4, 0.5 } };
	integrate(
	        m, { 8, -4, 6 }, 2, 3, 0, { 0.25, -10 },
	        0.5); // a = (8/2 + 0.25, −4/2 − 10), angular 6/3; all exact in binary
	EXPECT_EQ(m.velocity.x, 5.125);
	EXPECT_EQ(m.velocity.y, -2);
	EXPECT_EQ(m.velocity.w, 1.5);
	EXPECT_EQ(m.position.x, 1 + 0.5 * 5.125);
	EXPECT_EQ(m.position.y, 1);
	EXPECT_NEAR(angleOf(m.rotation), 0.75, 4e-16); // ω h, rounding of sine, cosine and arc tangent
}

TEST(PlaneMotion, EachDirectionIsBlockedByItself)
{
	const Motion start { { 0, 0 }, {}, { 1, 2, 3 } };
	for (const unsigned blocked : { 0u, blockedX, blockedY, blockedTurn, blockedX | blockedTurn, blockedAll }) {
		Motion m = start;
		integrate(m, { 1, 1, 1 }, 1, 1, blocked, { 1, 1 }, 1);
		EXPECT_EQ(m.velocity.x, blocked & blockedX ? 1 : 3) << blocked;
		EXPECT_EQ(m.velocity.y, blocked & blockedY ? 2 : 4) << blocked;
		EXPECT_EQ(m.velocity.w, blocked & blockedTurn ? 3 : 4) << blocked;
		EXPECT_EQ(m.position.x, m.velocity.x) << blocked; // a driven body moves with the velocity it was given
		EXPECT_NEAR(angleOf(m.rotation), m.velocity.w, 2e-15) << blocked; // rounding of numbers of about 4
	}
}

TEST(PlaneMotion, ABlockedBodyNeedsNoMass)
{
	Motion m { { 0, 0 }, {}, { 1, 2, 3 } };
	integrate(m, { 1, 1, 1 }, 0, 0, blockedX | blockedY | blockedTurn, { 1, 1 }, 1);
	EXPECT_EQ(m.velocity.x, 1);
	EXPECT_EQ(m.velocity.y, 2);
	EXPECT_EQ(m.velocity.w, 3);
}

TEST(PlaneMotion, ARotationStaysOneOverManySteps)
{
	Motion       m { { 0, 0 }, {}, { 0, 0, -2 } };
	const double h = pi / 8192; // a quarter of a turn clockwise in 2048 steps
	for (int k = 0; k < 2048; ++k)
		integrate(m, {}, 1, 1, 0, {}, h);
	EXPECT_NEAR(angleOf(m.rotation), -pi / 2, 2048 * 4e-16); // an ulp or two a step
	const double length = m.rotation.z * m.rotation.z + m.rotation.w * m.rotation.w;
	EXPECT_NEAR(length, 1, 4e-16); // normalised in the last step
}

TEST(PlaneMotion, ADisplacementMovesAndTurns)
{
	Motion m { { 1, 2 }, turned(0.3), { 5, 6, 7 } };
	displace(m, { 0.5, -0.25, 0.2 });
	EXPECT_EQ(m.position.x, 1.5);
	EXPECT_EQ(m.position.y, 1.75);
	EXPECT_NEAR(angleOf(m.rotation), 0.5, 4e-16); // rounding
	EXPECT_EQ(m.velocity.x, 5);
	EXPECT_EQ(m.velocity.y, 6);
	EXPECT_EQ(m.velocity.w, 7);
}

TEST(PlaneMotion, VectorsTurnWithTheBodyAndBack)
{
	const Point quarter = rotate(turned(pi / 2), { 2, 1 });
	EXPECT_NEAR(quarter.x, -1, 1e-15); // rounding of cos π/4
	EXPECT_NEAR(quarter.y, 2, 1e-15);
	for (const double angle : { -3., -0.7, 0., 0.4, 2.5 }) {
		const Point v { 0.3, -1.7 }, there = rotate(turned(angle), v), back = rotateBack(turned(angle), there);
		EXPECT_NEAR(there.x, v.x * std::cos(angle) - v.y * std::sin(angle), 2e-15)
		        << angle; // a few roundings of numbers below 2
		EXPECT_NEAR(there.y, v.x * std::sin(angle) + v.y * std::cos(angle), 2e-15) << angle;
		EXPECT_NEAR(back.x, v.x, 2e-15) << angle;
		EXPECT_NEAR(back.y, v.y, 2e-15) << angle;
	}
}

// ---- contact of disks

TEST(PlaneDisks, NormalGapAndPointByHand)
{
	const DiskContact c = diskContact({ 1, 1 }, { 4, 5 }, 2, 1.5); // distance 5, gap 1.5
	EXPECT_EQ(c.nx, 0.6);
	EXPECT_EQ(c.ny, 0.8);
	EXPECT_EQ(c.distance, 5);
	EXPECT_EQ(c.gap, 1.5);
	EXPECT_DOUBLE_EQ(c.point.x, 1 + 2.75 * 0.6); // midway between surfaces at 2 and at 3.5
	EXPECT_DOUBLE_EQ(c.point.y, 1 + 2.75 * 0.8);
	const DiskContact pressed = diskContact({ 0, 0 }, { 0, -3 }, 2, 1.5);
	EXPECT_EQ(pressed.gap, -0.5);
	EXPECT_EQ(pressed.point.y, -1.75); // between −1.5 and −2
	EXPECT_EQ(diskContact({ 0, 0 }, { 3, 4 }, 1, 1, 12).distance, 13); // a box of 3, 4, 12
}

TEST(PlaneDisks, ExchangedDisksHaveTheSameContactSeenFromTheOtherSide)
{
	const DiskContact a = diskContact({ 0.1, 0.7 }, { -1.3, 0.2 }, 0.8, 0.6),
	                  b = diskContact({ -1.3, 0.2 }, { 0.1, 0.7 }, 0.6, 0.8);
	EXPECT_EQ(a.nx, -b.nx);
	EXPECT_EQ(a.ny, -b.ny);
	EXPECT_EQ(a.gap, b.gap);
	EXPECT_NEAR(a.point.x, b.point.x, 4e-16); // rounding
	EXPECT_NEAR(a.point.y, b.point.y, 4e-16);
}

TEST(PlaneDisks, LeversAreThoseFromTheCentresToTheContact)
{
	const Point       x1 { 0.2, -0.1 }, x2 { 1.1, 1.3 };
	const DiskContact d = diskContact(x1, x2, 0.9, 0.7);
	Contact           c;
	setDiskFrame(c, 3, 8, d.nx, d.ny, 0.9, 0.7, d.gap);
	EXPECT_EQ(c.i, 3);
	EXPECT_EQ(c.j, 8);
	EXPECT_NEAR(c.leverTi, (d.point.x - x1.x) * d.nx + (d.point.y - x1.y) * d.ny, 4e-16); // ρ·n, rounding
	EXPECT_NEAR(c.leverTj, (d.point.x - x2.x) * d.nx + (d.point.y - x2.y) * d.ny, 4e-16);
	EXPECT_EQ(c.leverNi, 0);
	EXPECT_EQ(c.leverNj, 0);
	// U by the velocity of each body's point at the contact, v + ω ẑ × ρ
	const Twist vi { 1, -2, 3 }, vj { -4, 5, -6 };
	const auto  at = [&](const Twist& v, const Point& x) {
                return Point { v.x - v.w * (d.point.y - x.y), v.y + v.w * (d.point.x - x.x) };
	};
	const Point            ui = at(vi, x1), uj = at(vj, x2);
	const RelativeVelocity u = relativeVelocity(c, vi, vj);
	EXPECT_NEAR(u.n, d.nx * (uj.x - ui.x) + d.ny * (uj.y - ui.y), 1e-14); // rounding of numbers of about 10
	EXPECT_NEAR(u.t, -d.ny * (uj.x - ui.x) + d.nx * (uj.y - ui.y), 1e-14);
}

// ---- bonds

/// Two bonded disks of radii 1 and 0.5 that touch, and the bond's marks.
struct Pair {
	Motion    first { { 2, 3 }, turned(0.4), {} }, second { { 2 + 1.5 * 0.6, 3 + 1.5 * 0.8 }, turned(-1.1), {} };
	Point     normal { 0.6, 0.8 };
	BondMarks marks = markBond(first, second, normal, 0.5);

	BondDisplacement displacement() const { return bondDisplacement(marks, first, second); }
};

TEST(PlaneBond, IsMarkedWhereTheDisksTouch)
{
	const Pair p;
	const auto in = [](const Motion& m, const Point& mark) {
		const Point r = rotate(m.rotation, mark);
		return Point { m.position.x + r.x, m.position.y + r.y };
	};
	for (const Point& at : { in(p.first, p.marks.first), in(p.second, p.marks.second) }) {
		EXPECT_NEAR(at.x, 2.6, 2e-15); // first centre + 1 n; rounding
		EXPECT_NEAR(at.y, 3.8, 2e-15);
	}
	EXPECT_NEAR(p.displacement().normal, 0, 2e-15);
	EXPECT_NEAR(p.displacement().tangential, 0, 2e-15);
}

TEST(PlaneBond, DisplacementIsSeenInTheAxesOfTheFirstBody)
{
	Pair p;
	displace(p.second, { 0.01 * 0.6 - 0.003 * 0.8, 0.01 * 0.8 + 0.003 * 0.6, 0 }); // 0.01 along n, 0.003 along t
	EXPECT_NEAR(p.displacement().normal, 0.01, 2e-15); // rounding of coordinates of about 4
	EXPECT_NEAR(p.displacement().tangential, 0.003, 2e-15);
	// the second disk turned by δ about its centre: its point goes by −0.5 δ along t, to first order
	Pair turning;
	displace(turning.second, { 0, 0, 1e-4 });
	EXPECT_NEAR(turning.displacement().tangential, -0.5e-4, 1e-12); // δ³ is below
	EXPECT_NEAR(turning.displacement().normal, 0.5 * 0.5e-8, 1e-14); // 0.5 (1 − cos δ)
}

TEST(PlaneBond, MotionOfThePairAsOneBodyIsNoDisplacement)
{
	Pair p;
	displace(p.second, { 0.007, -0.004, 0.02 });
	const BondDisplacement before = p.displacement();
	const double           angle  = 1.9;
	const Point            arm    = rotate(
	                      turned(angle), { p.second.position.x - p.first.position.x, p.second.position.y - p.first.position.y });
	p.first.rotation  = product(turned(angle), p.first.rotation);
	p.second.rotation = product(turned(angle), p.second.rotation);
	p.first.position  = { -5, 7 };
	p.second.position = { -5 + arm.x, 7 + arm.y };
	EXPECT_NEAR(p.displacement().normal, before.normal, 1e-14); // rounding of coordinates of about 8
	EXPECT_NEAR(p.displacement().tangential, before.tangential, 1e-14);
}

/// What a pair has slipped and turned, as the interaction loop asks it.
BondStrain strainOf(const Pair& p)
{
	const DiskContact d = diskContact(p.first.position, p.second.position, 1, 0.5);
	return bondStrain(p.marks, p.first, p.second, { d.nx, d.ny }, 1 + 0.5 * d.gap, 0.5 + 0.5 * d.gap, 0.5);
}

/// The second disk goes by an angle about the first one's centre, and both turn.
Pair moved(double orbit, double turnFirst, double turnSecond)
{
	Pair        p;
	const Point arm = rotate(
	        turned(orbit), { p.second.position.x - p.first.position.x, p.second.position.y - p.first.position.y });
	p.second.position = { p.first.position.x + arm.x, p.first.position.y + arm.y };
	p.first.rotation  = product(turned(turnFirst), p.first.rotation);
	p.second.rotation = product(turned(turnSecond), p.second.rotation);
	return p;
}

TEST(PlaneBond, SlipsAndTurnsByTheIntegralsOfItsVelocities)
{
	// U_t = 1.5 θ' − 1 ω₁ − 0.5 ω₂ and w = ω₂ − ω₁, radii 1 and 0.5; angles of 0.1 miss the arc sine's fifth order, 1e-6
	for (const double angle : { 0.001, 0.1, -0.08 }) {
		const double margin = 1e-15 + 0.1 * std::pow(std::abs(angle), 5);
		const auto   whole = strainOf(moved(angle, angle, angle)), orbit = strainOf(moved(angle, 0, 0)),
		           first = strainOf(moved(0, angle, 0)), second = strainOf(moved(0, 0, angle)),
		           rolled = strainOf(moved(angle / 3, 0, angle)); // without slip
		EXPECT_NEAR(whole.slip, 0, 1e-15);
		EXPECT_NEAR(whole.turn, 0, 1e-15);
		EXPECT_NEAR(orbit.slip, 1.5 * angle, 2 * margin);
		EXPECT_NEAR(orbit.turn, 0, margin);
		EXPECT_NEAR(first.slip, -angle, margin);
		EXPECT_NEAR(first.turn, -angle, margin);
		EXPECT_NEAR(second.slip, -0.5 * angle, margin);
		EXPECT_NEAR(second.turn, angle, margin);
		EXPECT_NEAR(rolled.slip, 0, margin);
		EXPECT_NEAR(rolled.turn, angle, margin);
	}
}

TEST(PlaneBond, LivesInsideItsEllipse)
{
	const BondEllipse zone { 0.02, 0.05 };
	EXPECT_TRUE(bondLives({ 0.019, 0 }, zone));
	EXPECT_TRUE(bondLives({ 0, -0.049 }, zone));
	EXPECT_FALSE(bondLives({ 0.02, 0 }, zone)); // the edge is outside
	EXPECT_FALSE(bondLives({ -0.02, 0 }, zone));
	EXPECT_FALSE(bondLives({ 0, 0.05 }, zone));
	EXPECT_TRUE(bondLives({ 0.012 - 1e-6, 0.04 }, zone)); // 0.6² + 0.8² = 1
	EXPECT_FALSE(bondLives({ 0.012 + 1e-6, 0.04 }, zone));
	for (int k = 0; k < 360; ++k) { // all around; 1e-9 is much more than rounding
		const double x = zone.normal * std::cos(k * 0.0174532925),
		             y = zone.tangential * std::sin(k * 0.0174532925);
		EXPECT_TRUE(bondLives({ (1 - 1e-9) * x, (1 - 1e-9) * y }, zone)) << k << "°";
		EXPECT_FALSE(bondLives({ (1 + 1e-9) * x, (1 + 1e-9) * y }, zone)) << k << "°";
	}
}

TEST(PlaneBond, KeepsTheLongestGapItHasHad)
{
	EXPECT_EQ(firstRestGap(0.01), 0.01);
	EXPECT_EQ(firstRestGap(-0.01), 0); // disks that overlap are to part
	EXPECT_EQ(grownRestGap(0.01, 0.02), 0.02);
	EXPECT_EQ(grownRestGap(0.01, 0.005), 0.01);
}

TEST(PlaneBond, YieldsAtItsThresholdsOnly)
{
	const Contact          c = bonded(10, 0.5, 0.25, 2); // h F_a, μ_s, μ_r ℓ, ℓ
	const RelativeVelocity u { 0.5, -0.25, 0.125 };
	// at P_n = −6 the thresholds are 0.5 · 4 and 0.25 · 4
	const YieldPath none = yieldOfStep(c, { -6, 1.99, -0.99 }, u, 0.1);
	EXPECT_EQ(none.tension, 0);
	EXPECT_EQ(none.shear, 0);
	EXPECT_EQ(none.torque, 0);
	const YieldPath sheared = yieldOfStep(c, { -6, -2, 0 }, u, 0.1);
	EXPECT_EQ(sheared.tension, 0);
	EXPECT_DOUBLE_EQ(sheared.shear, 0.025); // a path, whatever its direction
	EXPECT_EQ(sheared.torque, 0);
	const YieldPath rolled = yieldOfStep(c, { -6, 0, 1 }, u, 0.1);
	EXPECT_EQ(rolled.shear, 0);
	EXPECT_DOUBLE_EQ(rolled.torque, 0.0125); // h w times half of ℓ
	const YieldPath drawn = yieldOfStep(
	        c, { -10, 0, 0 }, u, 0.1); // nothing is left for shear and rolling, which yield with it
	EXPECT_DOUBLE_EQ(drawn.tension, 0.05);
	EXPECT_DOUBLE_EQ(drawn.shear, 0.025);
	EXPECT_DOUBLE_EQ(drawn.torque, 0.0125);
}

TEST(PlaneBond, TensionYieldsWhereItOpens)
{
	const Contact c = bonded(10, 0.5, 0.25, 2);
	EXPECT_TRUE(yieldsInTension(c, { -10, 0, 0 }, { 0.5, 0, 0 }));
	EXPECT_TRUE(yieldsInTension(c, { -10 * (1 - 1e-10), 0, 0 }, { 0.5, 0, 0 })); // within the solver's last digits
	EXPECT_FALSE(yieldsInTension(c, { -10 * (1 - 1e-8), 0, 0 }, { 0.5, 0, 0 }));
	EXPECT_FALSE(yieldsInTension(c, { -10, 0, 0 }, { 0, 0, 0 })); // held
	EXPECT_FALSE(yieldsInTension(c, { -10, 0, 0 }, { -0.5, 0, 0 }));
	EXPECT_FALSE(yieldsInTension(
	        bonded(0, 0.5, 0.25, 2), { 0, 0, 0 },
	        { 0.5, 0, 0 })); // without a strength a bond does not yield, it just opens
}

TEST(PlaneBond, OneThatClosesHasThePlayOfItsLength)
{
	const double h = 0.01;
	Contact      c = bonded(100, 0.5, 0, 1);
	setPlay(c, 0, 0.001, h); // made at touch
	EXPECT_EQ(c.play, 0);
	EXPECT_EQ(c.biasN, 0);
	for (const auto& [gap, biasN, play] : { std::array { 0.005, 0.5, 2.0 },
	                                        { 0.02, 2.0, 2.0 },
	                                        { 0.0, 0.0, 2.0 },
	                                        { -0.003, 0.0, 2.0 },
	                                        { 0.03, 3.0, 3.0 } }) {
		setPlay(c, 0.02, gap, h); // beyond its length it does not open further
		EXPECT_DOUBLE_EQ(c.biasN, biasN) << gap;
		EXPECT_DOUBLE_EQ(c.play, play) << gap;
	}
	setPlay(c, 0.02, 0.005, h);
	EXPECT_DOUBLE_EQ(openingOf(c, { 1.75, 0, 0 }), 0.25); // of 1.75 m/s it may open by 1.5
	EXPECT_FALSE(yieldsInTension(c, { -100, 0, 0 }, { 1.4, 0, 0 }));
	EXPECT_TRUE(yieldsInTension(c, { -100, 0, 0 }, { 1.75, 0, 0 }));
	EXPECT_DOUBLE_EQ(yieldOfStep(c, { -100, 0, 0 }, { 1.75, 0, 0 }, h).tension, 0.0025);
	EXPECT_EQ(ofClosing({ -0.5, 0.25 }).normal, 0); // that it closes is no damage
	EXPECT_EQ(ofClosing({ -0.5, 0.25 }).tangential, 0.25);
	EXPECT_EQ(ofClosing({ 0.5, 0 }).normal, 0.5);
}

TEST(PlaneBond, ABreakIsNamedByMostOfThePath)
{
	EXPECT_EQ(breakMode({ 0.61, 0.2, 0.19 }), BreakMode::Tension);
	EXPECT_EQ(breakMode({ 0.2, 0.61, 0.19 }), BreakMode::Shear);
	EXPECT_EQ(breakMode({ 0.2, 0.19, 0.61 }), BreakMode::Torque);
	EXPECT_EQ(breakMode({ 0.59, 0.41, 0 }), BreakMode::Mixed);
	EXPECT_EQ(breakMode({ 0, 0, 0 }), BreakMode::Mixed); // taken apart without a yield
	EXPECT_EQ(breakMode({ 0, 1e-300, 0 }), BreakMode::Shear); // whatever its length
}

// ---- thresholds

TEST(PlaneThresholds, BondTouchOrNeither)
{
	const Thresholds bond { 100, 0.5, 0.25 }, residual { 10, 0.3, 0.125 };
	for (const bool touching : { false, true }) {
		const Thresholds t = thresholdsOf(bond, residual, true, touching); // a bond holds over a gap as well
		EXPECT_EQ(t.adhesion, 100);
		EXPECT_EQ(t.friction, 0.5);
		EXPECT_EQ(t.rollingArm, 0.25);
		const Thresholds r = thresholdsOf(bond, residual, false, touching);
		EXPECT_EQ(r.adhesion, touching ? 10 : 0);
		EXPECT_EQ(r.friction, 0.3);
		EXPECT_EQ(r.rollingArm, 0.125);
	}
}

TEST(PlaneThresholds, TouchingIsAGapWithinTheRange)
{
	EXPECT_TRUE(touches(-0.1, 0.001, 2)); // overlapping
	EXPECT_TRUE(touches(0.002, 0.001, 2)); // at the range, in units of the length
	EXPECT_FALSE(touches(std::nextafter(0.002, 1), 0.001, 2));
	EXPECT_FALSE(touches(std::numeric_limits<double>::quiet_NaN(), 0.001, 2));
}

} // namespace
