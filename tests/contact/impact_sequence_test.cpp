// Impacts one after the other within a step: by hand, against impacts in the order of time in one dimension, by balances and symmetry.
#include <cmath>
#include <contact/plane/impact_sequence.hpp>
#include <contact/plane/disk_contact.hpp>
#include <gtest/gtest.h>
#include <random>

using namespace nonsmooth::contact;

namespace {

constexpr double R = 0.5, h = 1e-3; // m, s

/// Disks of a density, and what may meet of them.
struct Row {
	Problem                 problem;
	std::vector<double>     radius;
	std::vector<Twist>      before;
	std::vector<double>     mass, inertia;
	std::vector<ImpactPair> pairs;
	ImpactSequence          sequence;

	int add(Point x, Twist v, double r = R, double m = 1)
	{
		const double inertia_ = 0.5 * m * r * r;
		problem.positions.push_back(x);
		problem.inverseMass.push_back(m > 0 ? InverseMass { 1 / m, 1 / m, 1 / inertia_ } : InverseMass {});
		problem.freeVelocity.push_back(v);
		radius.push_back(r);
		before.push_back(v);
		mass.push_back(m);
		inertia.push_back(inertia_);
		return static_cast<int>(radius.size()) - 1;
	}
	/// A wall that moves or not; its pairs get their normal and gap by hand.
	int addWall(Twist v = {})
	{
		const int id = add({}, v, -1, 0);
		return id;
	}
	void meet(Contact c, double gap, double e)
	{
		problem.contacts.push_back(c);
		pairs.push_back({ nullptr, gap, e, radius[c.i] > 0 && radius[c.j] > 0, false });
	}
	void meetDisks(int i, int j, double e, double friction = 0, double rolling = 0)
	{
		const auto d = plane::diskContact(problem.positions[i], problem.positions[j], radius[i], radius[j]);
		Contact    c;
		plane::setDiskFrame(c, i, j, d.nx, d.ny, radius[i], radius[j], d.gap);
		c.friction   = friction;
		c.rollingArm = rolling;
		c.length     = radius[i] + radius[j];
		meet(c, d.gap, e);
	}
	void meetWall(int wall, int disk, double nx, double gap, double e)
	{
		Contact c;
		c.i = wall, c.j = disk, c.nx = nx, c.leverTj = -radius[disk];
		meet(c, gap, e);
	}
	int follow(int most = 1000)
	{
		for (size_t k = 0; k < pairs.size(); ++k)
			pairs[k].contact = &problem.contacts[k];
		return sequence.follow({ problem, radius, before, h, most }, pairs);
	}
	const Twist& v(int id) const { return sequence.flights[id].velocity; }
	/// Where a body is at the end of the step.
	Point end(int id) const
	{
		const auto& f = sequence.flights[id];
		return { problem.positions[id].x + f.shift.x + h * f.velocity.x,
			 problem.positions[id].y + f.shift.y + h * f.velocity.y };
	}
	double kinetic(bool after) const
	{
		double sum = 0;
		for (size_t b = 0; b < mass.size(); ++b) {
			const Twist& u = after ? v((int)b) : before[b];
			if (mass[b] > 0) sum += 0.5 * (mass[b] * (u.x * u.x + u.y * u.y) + inertia[b] * u.w * u.w);
		}
		return sum;
	}
	double lost() const
	{
		double sum = 0;
		for (const auto& p : sequence.impacts)
			sum += p.normalLoss + p.slidingLoss + p.rollingLoss;
		return sum;
	}
};

/// Disks in a row, the first with a speed; gap[k] is that before disk k + 1.
Row chain(const std::vector<double>& gaps, double e, double speed = 10, const std::vector<double>& masses = {})
{
	Row    row;
	double x = 0;
	for (size_t k = 0; k <= gaps.size(); ++k) {
		if (k > 0) x += 2 * R + gaps[k - 1];
		row.add({ x, 0 }, { k == 0 ? speed : 0.0, 0, 0 }, R, masses.empty() ? 1.0 : masses[k]);
	}
	for (size_t k = 0; k < gaps.size(); ++k)
		row.meetDisks((int)k, (int)k + 1, e);
	return row;
}

/// The same in one dimension: the next pair to meet, found anew each time.
void inOrderOfTime(std::vector<double>& x, std::vector<double>& v, const std::vector<double>& m, double e, double time)
{
	for (;;) {
		double next = time;
		size_t pair = 0;
		for (size_t k = 0; k + 1 < x.size(); ++k) {
			const double closing = v[k] - v[k + 1], gap = x[k + 1] - x[k] - 2 * R;
			if (closing > 1e-4 && gap / closing < next) next = std::max(0.0, gap / closing), pair = k + 1;
		}
		for (size_t k = 0; k < x.size(); ++k)
			x[k] += next * v[k];
		time -= next;
		if (pair == 0) return;
		double &     a = v[pair - 1], &b = v[pair];
		const double p = (1 + e) * (a - b) / (1 / m[pair - 1] + 1 / m[pair]);
		a -= p / m[pair - 1];
		b += p / m[pair];
	}
}

TEST(ImpactSequence, EqualDisksHandTheirSpeedOn)
{
	Row row = chain({ 3e-3, 1e-3, 2e-3 }, 1);
	EXPECT_EQ(row.follow(), 3); // 6 mm of the step's 10
	for (int k = 0; k < 3; ++k)
		EXPECT_NEAR(row.v(k).x, 0, 1e-12) << k; // rounding of 10 m/s
	EXPECT_NEAR(row.v(3).x, 10, 1e-12);
	// each stands where it handed on, the last has what is left of the step
	EXPECT_NEAR(row.end(0).x, 3e-3, 1e-15);
	EXPECT_NEAR(row.end(1).x, 1.004, 1e-15);
	EXPECT_NEAR(row.end(2).x, 2.006, 1e-15);
	EXPECT_NEAR(row.end(3).x, 3.010, 1e-15);
}

TEST(ImpactSequence, ADiskThatIsNotReachedInTheStepStands)
{
	Row row = chain({ 3e-3, 4e-3, 4e-3 }, 1); // 11 mm
	EXPECT_EQ(row.follow(), 2);
	EXPECT_NEAR(row.v(2).x, 10, 1e-12);
	EXPECT_EQ(row.v(3).x, 0);
	EXPECT_NEAR(row.end(2).x, 2.007 + 3e-3, 1e-15); // 3 of its 4 mm
}

TEST(ImpactSequence, InTheOrderOfTimeForAnyMassesAndRestitution)
{
	std::mt19937                           dice(5);
	std::uniform_real_distribution<double> uniform(0, 1);
	int                                    impacts = 0;
	for (const double e : { 0.5, 0.7, 0.9, 1.0 })
		for (int trial = 0; trial < 50; ++trial) {
			const int           count = 3 + trial % 18;
			std::vector<double> gaps, masses, x, v;
			for (int k = 0; k < count; ++k) {
				if (k > 0) gaps.push_back(1e-3 * uniform(dice));
				masses.push_back(std::exp(2 * uniform(dice)));
			}
			Row row = chain(gaps, e, 10, masses);
			for (int k = 0; k < count; ++k)
				x.push_back(row.problem.positions[k].x), v.push_back(row.before[k].x);
			inOrderOfTime(x, v, masses, e, h);
			impacts += row.follow();
			for (int k = 0; k < count; ++k) {
				// pairs up to 1e-7 of a diameter apart touch, which moves an impact by 1e-8 s and its place by as much
				EXPECT_NEAR(row.end(k).x, x[k], 1e-6) << e << " " << count << " " << k;
				EXPECT_NEAR(row.v(k).x, v[k], 1e-3) << e << " " << count << " " << k;
			}
			EXPECT_NEAR(row.kinetic(true), row.kinetic(false) - row.lost(), 1e-11) << count;
		}
	EXPECT_GT(impacts, 500); // it does happen
}

TEST(ImpactSequence, AnImpactOnAWallThatStaysAloneIsLeftToTheSolve)
{
	for (const bool near : { false, true }) {
		Row       row;
		const int wall = row.addWall(), disk = row.add({ 0, 0 }, { -10, 0, 0 });
		// back from the wall it could not, or could, reach the other in a whole step; it does not in what is left of this one
		const int other = row.add({ 1 + (near ? 9.99e-3 : 10.01e-3), 0 }, {});
		row.meetWall(wall, disk, 1, 3e-3, 1);
		row.meetDisks(disk, other, 1);
		EXPECT_EQ(row.follow(), near ? 1 : 0);
		EXPECT_EQ(row.sequence.flights[disk].struck, near);
		EXPECT_NEAR(row.v(disk).x, near ? 10 : -10, 1e-12);
		EXPECT_NEAR(row.sequence.flights[disk].shift.x, near ? -6e-3 : 0, 1e-15); // −t (v′ − v), t = 0.3 ms
		EXPECT_FALSE(row.sequence.flights[other].struck);
	}
}

TEST(ImpactSequence, ABodyThatIsTurnedAwayBeforeAnImpactHasNone)
{
	Row       row;
	const int wall = row.addWall(), disk = row.add({ 0, 0 }, { 10, 0, 0 }),
	          post = row.add({ 0.9, 0.4445 }, {}, R, 0);
	row.meetWall(wall, disk, -1, 1e-3, 0.5);
	row.meetDisks(disk, post, 1); // 3.8 mm away: the solve would take both impacts at once
	EXPECT_EQ(row.follow(), 1);
	EXPECT_NEAR(row.v(disk).x, -5, 1e-12);
	EXPECT_EQ(row.v(disk).y, 0);
}

TEST(ImpactSequence, ABodyThatIsHitOnTheWayIsMetLater)
{
	Row       row;
	const int wall = row.addWall({ 2.5, 0, 0 }), disk = row.add({ 0, 0 }, { 10, 0, 0 }),
	          other = row.add({ 1.005, 0 }, {});
	row.meetDisks(
	        disk, other,
	        1); // at 0.5 ms, were it not for a wall that makes the other 5 m/s fast at 0.4 ms: so at 0.6 ms
	row.meetWall(wall, other, 1, 1e-3, 1);
	EXPECT_EQ(row.follow(), 2);
	EXPECT_NEAR(row.v(disk).x, 5, 1e-12);
	EXPECT_NEAR(row.v(other).x, 10, 1e-12);
	EXPECT_NEAR(row.end(disk).x, 8e-3, 1e-15);
	EXPECT_NEAR(row.end(other).x, 1.010, 1e-15);
}

TEST(ImpactSequence, TwoFreeDisksThatMeetAreFollowed)
{
	Row row = chain({ 3e-3, 20e-3 }, 1);
	EXPECT_EQ(row.follow(), 1);
	EXPECT_NEAR(row.end(0).x, 3e-3, 1e-15);
	EXPECT_NEAR(row.end(1).x, 1.003 + 7e-3, 1e-15);
	row.problem.inverseMass[0].y = 0; // held in one direction
	EXPECT_EQ(row.follow(), 0);
}

TEST(ImpactSequence, ABodyBetweenWallsGoesToAndFro)
{
	Row       row;
	const int left = row.addWall(), right = row.addWall(), disk = row.add({ 0, 0 }, { 10, 0, 0 });
	row.meetWall(left, disk, 1, 1e-3, 1);
	row.meetWall(right, disk, -1, 1e-3, 1);
	EXPECT_EQ(row.follow(), 5); // at 1, 3, 5, 7, 9 of its 10 mm
	EXPECT_NEAR(row.v(disk).x, -10, 1e-12);
	EXPECT_NEAR(row.end(disk).x, 0, 1e-14); // from +1 at 9 mm back to 0 at 10
	EXPECT_NEAR(row.sequence.flights[left].impulse.x, -40, 1e-12); // two blows of 2 m v, three to the other
	EXPECT_NEAR(row.sequence.flights[right].impulse.x, 60, 1e-12);
}

TEST(ImpactSequence, NobodyHasMoreImpactsThanAreAllowed)
{
	Row       row;
	const int left = row.addWall(), right = row.addWall(), disk = row.add({ 0, 0 }, { 10, 0, 0 });
	row.meetWall(left, disk, 1, 1e-3, 1);
	row.meetWall(right, disk, -1, 1e-3, 1);
	EXPECT_EQ(row.follow(3), 3);
	EXPECT_EQ(row.sequence.overrun, 1);
	EXPECT_NEAR(std::abs(row.v(disk).x), 10, 1e-12); // with its energy: what comes next is the solve's
	EXPECT_EQ(row.follow(5), 5);
	EXPECT_EQ(row.sequence.overrun, 0);
}

TEST(ImpactSequence, TouchingDisksAreHitAtOnce)
{
	// a row of three that touch, as Newton's law has it: the first comes back, they leave together; then the next one is hit by the last
	Row row = chain({ 1e-3, 0, 0, 1e-3 }, 1);
	EXPECT_EQ(row.follow() > 1, true);
	EXPECT_NEAR(row.v(0).x, -5, 1e-12); // momentum and energy of 1 against 3: −v/2, v/2
	EXPECT_NEAR(row.kinetic(true), 50, 1e-11);
	EXPECT_GT(row.v(4).x, 4.9); // the fifth got the speed of the fourth
}

TEST(ImpactSequence, WhatHangsByABondIsLeft)
{
	Row row           = chain({ 1e-3, 1e-3, 0 }, 1);
	row.pairs[2].held = true;
	EXPECT_EQ(row.follow(), 1); // the second comes with 10 m/s
	EXPECT_NEAR(row.v(1).x, 10, 1e-12);
	EXPECT_EQ(row.v(2).x, 0);
	EXPECT_FALSE(row.sequence.flights[2].struck);
}

/// Three disks that come together obliquely with friction and spin; `mirrored` in the x axis.
Row scramble(bool mirrored, double friction, double e)
{
	const double s = mirrored ? -1 : 1;
	Row          row;
	row.add({ 0, 0 }, { 10, 2 * s, 3 * s });
	row.add({ 0.9, 0.4385 * s }, { -5, 1 * s, -20 * s });
	row.add({ 1.8, 0.002 * s }, { -11, -4 * s, 7 * s }, 0.5, 3);
	row.meetDisks(0, 1, e, friction, 0.1 * friction);
	row.meetDisks(0, 2, e, friction, 0.1 * friction);
	row.meetDisks(1, 2, e, friction, 0.1 * friction);
	return row;
}

TEST(ImpactSequence, KeepsMomentumAngularMomentumAndTheBalanceOfEnergy)
{
	for (const double friction : { 0.0, 0.3 })
		for (const double e : { 0.4, 1.0 }) {
			Row row = scramble(false, friction, e);
			ASSERT_GE(row.follow(), 2);
			double px = 0, py = 0, spin = 0;
			for (int b = 0; b < 3; ++b) {
				const Twist &u = row.before[b], &v = row.v(b);
				const Point  x = row.problem.positions[b], y = row.end(b);
				px += row.mass[b] * (v.x - u.x);
				py += row.mass[b] * (v.y - u.y);
				spin += row.mass[b] * (y.x * v.y - y.y * v.x - x.x * u.y + x.y * u.x)
				        + row.inertia[b] * (v.w - u.w);
			}
			EXPECT_NEAR(px, 0, 1e-13); // rounding of 30 N s
			EXPECT_NEAR(py, 0, 1e-13);
			EXPECT_NEAR(spin, 0, 1e-13); // about the origin, in N m s
			EXPECT_NEAR(row.kinetic(true), row.kinetic(false) - row.lost(), 1e-11);
			if (friction == 0 && e == 1) EXPECT_NEAR(row.lost(), 0, 1e-11);
			else
				EXPECT_GT(row.lost(), 1);
		}
}

TEST(ImpactSequence, TheMirrorImageHasTheMirroredBits)
{
	Row a = scramble(false, 0.3, 0.4), b = scramble(true, 0.3, 0.4);
	EXPECT_EQ(a.follow(), b.follow());
	for (int k = 0; k < 3; ++k) {
		EXPECT_EQ(a.v(k).x, b.v(k).x);
		EXPECT_EQ(a.v(k).y, -b.v(k).y);
		EXPECT_EQ(a.v(k).w, -b.v(k).w);
		EXPECT_EQ(a.sequence.flights[k].shift.y, -b.sequence.flights[k].shift.y);
	}
}

TEST(ImpactSequence, TwoThatAreHitAtOnceStaySymmetric)
{
	// one comes between two, which then hit two walls: both at the same time
	Row       row;
	const int ball = row.add({ 0, 0 }, { 10, 0, 0 }), up = row.add({ 0.8664, 0.5003 }, {}),
	          down = row.add({ 0.8664, -0.5003 }, {});
	const int wall = row.addWall();
	row.meetDisks(ball, up, 1);
	row.meetDisks(ball, down, 1);
	row.meetWall(wall, up, -1, 1e-3, 1);
	row.meetWall(wall, down, -1, 1e-3, 1);
	EXPECT_GE(row.follow(), 4);
	EXPECT_NEAR(row.v(up).x, row.v(down).x, 1e-13); // sweeps take one before the other, to rounding
	EXPECT_NEAR(row.v(up).y, -row.v(down).y, 1e-13);
	EXPECT_LT(row.v(up).x, -5); // back from the wall
	EXPECT_NEAR(row.v(ball).y, 0, 1e-13);
	EXPECT_NEAR(row.kinetic(true), 50, 1e-11);
}

TEST(ImpactSequence, AMovingWallGivesEnergy)
{
	Row       row;
	const int wall = row.addWall({ 5, 0, 0 }), a = row.add({ 0.5, 0 }, {}), b = row.add({ 1.502, 0 }, {});
	row.meetWall(wall, a, 1, 1e-3, 1);
	row.meetDisks(a, b, 1);
	EXPECT_EQ(row.follow(), 3); // at 0.2 ms, at 0.4 ms, and the wall meets the first one again at 0.6 ms
	EXPECT_NEAR(row.v(a).x, 10, 1e-12);
	EXPECT_NEAR(row.v(b).x, 10, 1e-12);
	// the wall's work −P·v on it is what the disks have
	EXPECT_NEAR(-row.sequence.flights[wall].impulse.x * 5, row.kinetic(true), 1e-11);
	EXPECT_NEAR(row.lost(), 0, 1e-11);
}

} // namespace
