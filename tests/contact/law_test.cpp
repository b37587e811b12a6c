// The projections of the contact law, branch by branch, and the functions of slip.
#include <cmath>
#include <contact/plane/law.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;

namespace {

Contact contact(double adhesion, double friction, double arm)
{
	Contact c;
	c.adhesion   = adhesion;
	c.friction   = friction;
	c.rollingArm = arm;
	return c;
}

TEST(Law, NormalImpulseIsCutAtTheAdhesion)
{
	EXPECT_EQ(projectNormal(2, 0), 2); // compression stays
	EXPECT_EQ(projectNormal(-2, 0), 0); // Signorini: no tension
	EXPECT_EQ(projectNormal(-2, 3), -2); // eq. (1): tension below the threshold stays
	EXPECT_EQ(projectNormal(-4, 3), -3); // and is cut at it
}

TEST(Law, ThresholdCutsBothSigns)
{
	EXPECT_EQ(projectThreshold(0.5, 1), 0.5);
	EXPECT_EQ(projectThreshold(-0.5, 1), -0.5);
	EXPECT_EQ(projectThreshold(2, 1), 1);
	EXPECT_EQ(projectThreshold(-2, 1), -1);
	EXPECT_EQ(projectThreshold(2, 0), 0);
}

TEST(Law, ThresholdsFollowTheAdhesionPlusTheNormalImpulse)
{
	const Contact c = contact(3, 0.5, 0.25);
	EXPECT_DOUBLE_EQ(slidingThreshold(c, 1), 2); // 0.5 (3 + 1), eq. (4)
	EXPECT_DOUBLE_EQ(rollingThreshold(c, 1), 1); // 0.25 (3 + 1), eq. (6)
	EXPECT_EQ(slidingThreshold(c, -3), 0); // at the tensile threshold nothing is left
	EXPECT_EQ(rollingThreshold(c, -3), 0);
	EXPECT_EQ(slidingThreshold(c, -5), 0); // never negative
	EXPECT_EQ(rollingThreshold(c, -5), 0);
}

TEST(Law, ProjectionTakesTheNormalFirst)
{
	const Contact c      = contact(1, 0.5, 0.1);
	const Impulse inside = project(c, { 1, 0.9, -0.19 });
	EXPECT_DOUBLE_EQ(inside.n, 1);
	EXPECT_DOUBLE_EQ(inside.t, 0.9);
	EXPECT_DOUBLE_EQ(inside.r, -0.19);
	const Impulse cut = project(c, { 1, -7, 7 });
	EXPECT_DOUBLE_EQ(cut.t, -1);
	EXPECT_DOUBLE_EQ(cut.r, 0.2);
	const Impulse apart = project(c, { -7, 7, 7 }); // N is put at −F_a, where friction and rolling end
	EXPECT_EQ(apart.n, -1);
	EXPECT_EQ(apart.t, 0);
	EXPECT_EQ(apart.r, 0);
}

TEST(Law, InverseDelassusOfBodiesThatAreHeavierOneWay)
{
	Contact c;
	c.nx      = 0.6;
	c.ny      = 0.8;
	c.leverNi = 2;
	c.leverTi = -1;
	c.leverNj = 3;
	c.leverTj = -4;
	c.length  = 0.5;
	const InverseMass light { 0.2, 0.5, 0.1 }, heavy { 0.3, 0.4, 0.7 }, held {};
	const Diagonal    w = inverseDelassus(c, light, heavy);
	EXPECT_NEAR(
	        1 / w.n, 0.36 * 0.5 + 0.64 * 0.9 + 4 * 0.1 + 9 * 0.7, 1e-14); // n_x², n_y², levers squared; rounding
	EXPECT_NEAR(1 / w.t, 0.64 * 0.5 + 0.36 * 0.9 + 1 * 0.1 + 16 * 0.7, 1e-14);
	EXPECT_NEAR(1 / w.r, 0.1 + 0.7, 1e-15);
	const Diagonal none = inverseDelassus(c, held, held);
	EXPECT_EQ(none.n, 0);
	EXPECT_EQ(none.t, 0);
	EXPECT_EQ(none.r, 0);
	const Diagonal level = inverseDelassus(c, { 0.2, 0.2, 0 }, held); // a row that no impulse moves
	EXPECT_NEAR(level.n, 5, 1e-14);
	EXPECT_NEAR(level.r, 5 * 0.25, 1e-14);
}

TEST(Law, GivenMotionIsTheLimitOfGrowingMasses)
{
	// what one contact's solve leaves between bodies that already move so, the heavier the nearer; velocities as they would be without the contact
	const Contact c = contact(3, 0.5, 0.25);
	for (const double n : { 0.0, 0.2 })
		for (const double t : { -0.1, 0.0, 0.3 })
			for (const double r : { -0.4, 0.0, 0.1 }) {
				Contact at          = c;
				at.nx               = 1;
				at.leverTi          = 0.5;
				at.leverTj          = -0.5;
				const double      m = 1e-9; // inverse mass
				const InverseMass mass { m, m, m };
				Twist             vi { 0, 0, 0 }, vj { n, t + 0.5 * r, r };
				Impulse           solved {};
				for (int k = 0; k < 3; ++k)
					solved = visit(at, solved, inverseDelassus(at, mass, mass), mass, mass, vi, vj);
				const Impulse given = impulseOfGivenMotion(at, { n, t, r });
				// 1e-9 of velocities of 0.1 to 0.4: a zero of the three is met to what the other impulses give
				EXPECT_NEAR(given.n, solved.n, 1e-6) << n << " " << t << " " << r;
				EXPECT_NEAR(given.t, t == 0 ? 0 : solved.t, 1e-6) << n << " " << t << " " << r;
				EXPECT_NEAR(given.r, r == 0 ? 0 : solved.r, 1e-6) << n << " " << t << " " << r;
			}
}

TEST(Law, GivenMotionByHand)
{
	const Contact c     = contact(3, 0.5, 0.25);
	const auto    given = [&](double n, double t, double r) { return impulseOfGivenMotion(c, { n, t, r }); };
	const auto    is    = [](const Impulse& p, double n, double t, double r) {
                EXPECT_EQ(p.n, n);
                EXPECT_EQ(p.t, t);
                EXPECT_EQ(p.r, r);
	};
	is(given(0, 0, 0), 0, 0, 0); // where the law allows a range, the least of it
	is(given(0.1, 0, 0), -3, 0, 0); // eq. (1)
	is(given(0.1, 0.1, -0.1), -3, 0, 0); // a contact that opens bears neither shear nor torque, eqs (4) and (6)
	is(given(0, 0.1, 0), 0, -1.5, 0); // eq. (3) at N = 0
	is(given(0, -0.1, 0), 0, 1.5, 0);
	is(given(0, 0, 0.1), 0, 0, -0.75); // eq. (5)
	is(given(0, 0, -0.1), 0, 0, 0.75);
	is(given(-0.1, 0.1, 0.1), 0, 0, 0); // rigid bodies that are driven into each other: no finite impulse
	EXPECT_FALSE(std::signbit(impulseOfGivenMotion(contact(0, 0.5, 0), { 0.1, 0.1, 0.1 }).n));
}

TEST(Law, ProjectionIsIdempotent)
{
	const Contact c = contact(1, 0.5, 0.1);
	for (const Impulse& p : { Impulse { 1, 5, -5 }, Impulse { -4, 1, 1 }, Impulse { 0, 0.2, 0.05 } }) {
		const Impulse once = project(c, p), twice = project(c, once);
		EXPECT_EQ(once.n, twice.n);
		EXPECT_EQ(once.t, twice.t);
		EXPECT_EQ(once.r, twice.r);
	}
}

TEST(Law, InverseDelassusOfDisks)
{
	// two disks of mass 2 and 4, radius 0.5: W_nn = 1/2 + 1/4; W_tt and W_rr with I = m r²/2
	Contact c;
	c.nx      = 0.6;
	c.ny      = 0.8;
	c.leverTi = 0.5;
	c.leverTj = -0.5;
	const InverseMass mi { 0.5, 0.5, 4 }, mj { 0.25, 0.25, 2 };
	const Diagonal    w = inverseDelassus(c, mi, mj);
	EXPECT_NEAR(w.n, 1 / 0.75, 1e-15); // rounding of two products
	EXPECT_NEAR(w.t, 1 / (0.75 + 6 * 0.25), 1e-15);
	EXPECT_NEAR(w.r, 1 / 6.0, 1e-15);
	const Diagonal none = inverseDelassus(c, {}, {});
	EXPECT_EQ(none.n, 0); // two walls: nothing can move, and nothing is divided by zero
	EXPECT_EQ(none.t, 0);
	EXPECT_EQ(none.r, 0);
}

} // namespace
