// Clusters of bonded bodies turned as one: rigid motions exactly, balances exactly, and a body that leaves as if it had never been turned.
#include "problems.hpp"
#include <cmath>
#include <contact/plane/rigid_clusters.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::plane;

namespace {

using Joint = RigidClusters::Joint;

/// Five bodies of unlike masses that turn as one, far from the origin, and drift.
struct Cluster {
	explicit Cluster(double turning, double x = 1000, double y = -300)
	        : places { { x, y },
		           { x + 1, y + 0.2 },
		           { x - 0.7, y + 0.9 },
		           { x + 0.3, y - 1.1 },
		           { x + 2, y + 0.4 } }
	        , spin(turning)
	{
		const double all = 1 + 2 + 0.5 + 4 + 0.25;
		Point        centre;
		for (std::size_t k = 0; k < mass.size(); ++k) {
			centre.x += mass[k] / all * places[k].x;
			centre.y += mass[k] / all * places[k].y;
		}
		for (const Point& p : places)
			velocities.push_back({ 3 - spin * (p.y - centre.y), -2 + spin * (p.x - centre.x), spin });
		for (const double m : mass)
			inverse.push_back({ 1 / m, 1 / m, 8 / m });
	}
	BodyArrays  arrays() const { return { places.data(), inverse.data(), mass.data() }; }
	const int*  first() const { return ids.data(); }
	const int*  last() const { return ids.data() + ids.size(); }
	TurningAxes axes() const { return axesOf(arrays(), velocities, first(), last()); }

	/// Moves as the engines do: turned, then the path of the step.
	void step(double h)
	{
		std::vector<Twist> way(5), change(5);
		turn(arrays(), velocities, axes(), h, first(), last(), way, change);
		for (int b = 0; b < 5; ++b) {
			velocities[b].x += change[b].x;
			velocities[b].y += change[b].y;
			places[b].x += way[b].x + h * velocities[b].x;
			places[b].y += way[b].y + h * velocities[b].y;
		}
	}
	double momentum(std::size_t axis) const
	{
		double sum = 0;
		for (std::size_t b = 0; b < mass.size(); ++b)
			sum += mass[b] * (axis == 0 ? velocities[b].x : velocities[b].y);
		return sum;
	}
	double angularMomentum() const // about a point near by, for digits
	{
		double sum = 0;
		for (std::size_t b = 0; b < mass.size(); ++b)
			sum += mass[b]
			        * ((places[b].x - 1000) * velocities[b].y - (places[b].y + 300) * velocities[b].x);
		return sum;
	}
	double energy() const
	{
		double sum = 0;
		for (std::size_t b = 0; b < mass.size(); ++b)
			sum += 0.5 * mass[b] * (velocities[b].x * velocities[b].x + velocities[b].y * velocities[b].y);
		return sum;
	}

	std::vector<int>         ids { 0, 1, 2, 3, 4 };
	std::vector<double>      mass { 1, 2, 0.5, 4, 0.25 };
	std::vector<Point>       places;
	std::vector<InverseMass> inverse;
	std::vector<Twist>       velocities;
	double                   spin;
};

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(RigidClusters, AreFoundWhateverTheOrderOfJoints)
{
	const std::vector<Joint> joints { { 7, 3 }, { 9, 8 }, { 3, 1 }, { 2, 8 }, { 7, 1 } };
	RigidClusters            forth, back;
	forth.find(joints, 12);
	back.find({ joints.rbegin(), joints.rend() }, 12);
	const std::vector<std::vector<int>> sets { { 1, 3, 7 }, { 2, 8, 9 } };
	for (const RigidClusters* found : { &forth, &back }) {
		ASSERT_EQ(found->count(), 2u);
		for (std::size_t s = 0; s < 2; ++s)
			EXPECT_EQ(std::vector<int>(found->first(s), found->last(s)), sets[s]);
	}
	forth.find({ { 0, 5 } }, 12); // nothing of what was found before is left
	ASSERT_EQ(forth.count(), 1u);
	EXPECT_EQ(std::vector<int>(forth.first(0), forth.last(0)), (std::vector<int> { 0, 5 }));
	forth.find({}, 12);
	EXPECT_EQ(forth.count(), 0u);
}

TEST(RigidClusters, TurnByTheirSpinAndKeepTheirShapeAtAnyStep)
{
	for (const double h : { 1e-3, 0.01, 0.1, 0.5 }) {
		Cluster       c(2);
		const Cluster start = c;
		for (int k = 0; k < 100; ++k)
			c.step(h);
		const double turned = 2 * 100 * h;
		const Point  d { start.places[4].x - start.places[3].x, start.places[4].y - start.places[3].y };
		// rounding of coordinates of 1000 over a hundred steps
		EXPECT_NEAR(c.places[4].x - c.places[3].x, std::cos(turned) * d.x - std::sin(turned) * d.y, 1e-8) << h;
		EXPECT_NEAR(c.places[4].y - c.places[3].y, std::sin(turned) * d.x + std::cos(turned) * d.y, 1e-8) << h;
		for (int b = 1; b < 5; ++b)
			EXPECT_NEAR(
			        distance(c.places[b], c.places[0]), distance(start.places[b], start.places[0]), 1e-9)
			        << h;
		EXPECT_NEAR(c.momentum(0), start.momentum(0), 1e-10);
		EXPECT_NEAR(c.momentum(1), start.momentum(1), 1e-10);
		EXPECT_NEAR(c.energy(), start.energy(), 1e-10 * start.energy());
	}
}

TEST(RigidClusters, KeepTheAngularMomentumOfWhatIsNotQuiteRigidToo)
{
	Cluster c(3);
	c.velocities[1].x += 0.02;
	c.velocities[4].y -= 0.3;
	const double before = c.angularMomentum();
	for (int k = 0; k < 50; ++k) {
		c.step(0.05);
		ASSERT_NEAR(c.angularMomentum(), before, 1e-9 * std::abs(before)) << k; // rounding far from the origin
	}
}

TEST(RigidClusters, TheCentrifugalForceIsInBalanceAndThatOfAPendulum)
{
	Cluster            c(4);
	const double       h = 0.01;
	std::vector<Twist> gain(5);
	load(c.arrays(), c.axes(), h, c.first(), c.last(), gain);
	double x = 0, y = 0, moment = 0;
	for (int b = 0; b < 5; ++b) {
		x += c.mass[b] * gain[b].x;
		y += c.mass[b] * gain[b].y;
		moment += c.mass[b] * ((c.places[b].x - 1000) * gain[b].y - (c.places[b].y + 300) * gain[b].x);
	}
	for (const double sum : { x, y, moment })
		EXPECT_NEAR(sum, 0, 1e-12);

	c.inverse[0] = { 0, 0, 1 }; // a pin, on which all hangs
	c.velocities.assign(5, { 0, 0, 4 });
	for (int b = 1; b < 5; ++b)
		c.velocities[b] = { -4 * (c.places[b].y - c.places[0].y), 4 * (c.places[b].x - c.places[0].x), 4 };
	gain.assign(5, {});
	load(c.arrays(), c.axes(), h, c.first(), c.last(), gain);
	EXPECT_EQ(gain[0].x, 0);
	for (int b = 1; b < 5; ++b) // ω² r h
		EXPECT_NEAR(gain[b].x, 16 * h * (c.places[b].x - c.places[0].x), 1e-12);
}

TEST(RigidClusters, ABodyThatLeavesGoesOnAsItFlew)
{
	// turned in one step, loaded in the next: without bonds it has its old velocity again, but for the second order
	for (const double a : { 0.01, 0.1 }) {
		Cluster      c(2);
		const double h   = a / 2;
		const Twist  old = c.velocities[4];
		c.step(h);
		std::vector<Twist> gain(5);
		load(c.arrays(), c.axes(), h, c.first(), c.last(), gain);
		const double bound = a * a * 2 * distance(c.places[4], c.axes().centre);
		EXPECT_NEAR(c.velocities[4].x + gain[4].x, old.x, bound);
		EXPECT_NEAR(c.velocities[4].y + gain[4].y, old.y, bound);
		EXPECT_GT(std::hypot(c.velocities[4].x - old.x, c.velocities[4].y - old.y), 5 * bound); // had it none
	}
}

TEST(RigidClusters, GoWithABodyThatIsDriven)
{
	Cluster c(0);
	c.inverse[2]    = {}; // a rotor: driven, and turning whatever hangs on it
	c.velocities[2] = { 0.5, 0, 3 };
	for (const int b : { 0, 1, 3, 4 })
		c.velocities[b] = { 0.5 - 3 * (c.places[b].y - c.places[2].y), 3 * (c.places[b].x - c.places[2].x), 3 };
	const Cluster start = c;
	ASSERT_TRUE(movesRigidly(c.arrays(), c.velocities, c.axes(), c.first(), c.last()));
	Cluster late = c;
	late.velocities[4].y += 0.01;
	EXPECT_EQ(late.axes().velocity.w, 3); // what hangs on it does not say how fast it turns
	for (int k = 0; k < 40; ++k)
		c.step(0.05);
	EXPECT_NEAR(c.places[2].x, start.places[2].x + 40 * 0.05 * 0.5, 1e-10);
	for (const int b : { 0, 1, 3, 4 })
		EXPECT_NEAR(distance(c.places[b], c.places[2]), distance(start.places[b], start.places[2]), 1e-9);
	const double turned = 3 * 40 * 0.05;
	const Point  d { start.places[0].x - start.places[2].x, start.places[0].y - start.places[2].y };
	EXPECT_NEAR(c.places[0].x - c.places[2].x, std::cos(turned) * d.x - std::sin(turned) * d.y, 1e-8);
}

TEST(RigidClusters, WhatBendsOrIsGuidedIsLeftAlone)
{
	Cluster c(2);
	EXPECT_TRUE(movesRigidly(c.arrays(), c.velocities, c.axes(), c.first(), c.last()));
	c.velocities[4].x += 1;
	EXPECT_FALSE(movesRigidly(c.arrays(), c.velocities, c.axes(), c.first(), c.last()));
	Cluster guided(2);
	guided.inverse[1].y = 0;
	EXPECT_FALSE(guided.axes().turns);
	Cluster       still(0); // does not turn: nothing is asked of it
	const Cluster start = still;
	still.step(0.1);
	for (int b = 0; b < 5; ++b)
		EXPECT_NEAR(still.places[b].x, start.places[b].x + 0.3, 1e-12);
}

} // namespace
