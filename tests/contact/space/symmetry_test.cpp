// What the law does not depend on: where the scene is turned to, which hand the world has, the units, the order of
// contacts and the names of their bodies.
#include "balls.hpp"
#include <algorithm>
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>
#include <numeric>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;

namespace {

/// A rotation, or one with a mirror: its rows.
struct Turn {
	Vector a { 1, 0, 0 }, b { 0, 1, 0 }, c { 0, 0, 1 };

	Vector operator()(const Vector& x) const { return { dot(a, x), dot(b, x), dot(c, x) }; }
	double hand() const { return dot(a, cross(b, c)) > 0 ? 1 : -1; }
	/// Of what turns a body: it keeps its sense where the world is mirrored.
	Vector  axial(const Vector& x) const { return hand() * (*this)(x); }
	Twist   operator()(const Twist& v) const { return { (*this)(v.v), axial(v.w) }; }
	Impulse operator()(const Impulse& p) const { return { (*this)(p.f), axial(p.m) }; }
};

Problem turned(const Problem& p, const Turn& turn)
{
	Problem q = p;
	for (auto& x : q.positions)
		x = turn(x);
	for (auto& v : q.freeVelocity)
		v = turn(v);
	for (auto& i : q.impulses)
		i = turn(i);
	for (Contact& c : q.contacts) {
		c.n     = turn(c.n);
		c.biasT = turn(c.biasT);
		c.biasW = turn.axial(c.biasW);
	}
	return q;
}

Problem moving()
{
	Problem p = lattice(6, 5).problem;
	for (std::size_t k = 0; k < p.contactCount(); k += 2)
		p.contacts[k].adhesion = 30;
	for (std::size_t b = 0; b + 1 < p.bodyCount(); ++b)
		p.freeVelocity[b] = p.freeVelocity[b].v.z < 0
		        ? Twist { p.freeVelocity[b].v + Vector { 0.1 * std::sin(double(b)), 0.1, 0 },
			          { 0, 0.5, std::cos(double(b)) } }
		        : Twist {};
	return p;
}

SolverSettings sweeping(int sweeps)
{
	SolverSettings s;
	s.tolerance     = 1e-300;
	s.maxIterations = sweeps;
	return s;
}

Turn anyTurn()
{
	const Vector a = unit({ 2, -1, 3 }), b = unit(cross(a, { 1, 1, 0 }));
	return { a, b, cross(a, b) };
}

TEST(SpaceSymmetry, ATurnedSceneHasTheTurnedResult)
{
	const Problem  p        = moving();
	Problem        straight = p, aslant = turned(p, anyTurn());
	SolverSettings s = sweeping(0);
	s.tolerance      = 1e-12;
	s.maxIterations  = 100000;
	ASSERT_TRUE(solve(straight, s).converged);
	ASSERT_TRUE(solve(aslant, s).converged);
	for (Twist& v : straight.velocities)
		v = anyTurn()(v);
	// of a frictional packing motion is found to the tolerance; sweep by sweep below
	EXPECT_LE(largestDifference(straight.velocities, aslant.velocities), 1e-9);
}

TEST(SpaceSymmetry, SweepBySweepTurnedAndMirrored)
{
	const Turn mirror { { -1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, other { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
	for (const Turn& turn : { anyTurn(), mirror, other })
		for (const bool reference : { false, true }) {
			SolverSettings s = sweeping(30);
			s.reference      = reference;
			Problem p = moving(), q = turned(p, turn);
			solve(p, s);
			solve(q, s);
			for (Twist& v : p.velocities)
				v = turn(v);
			for (Impulse& i : p.impulses)
				i = turn(i);
			EXPECT_LE(largestDifference(p.velocities, q.velocities), 1e-9);
			EXPECT_LE(largestDifference(p.impulses, q.impulses), 1e-7);
		}
}

TEST(SpaceSymmetry, AMirroredSceneHasTheMirroredBits)
{
	// large enough for several strips, which follow the bodies' numbers along any axis
	for (double Vector::*const axis : { &Vector::x, &Vector::y, &Vector::z }) {
		Problem p = lattice(12, 8).problem;
		for (auto& x : p.positions)
			x.*axis *= 5;
		Turn mirror;
		(axis == &Vector::x ? mirror.a.x : axis == &Vector::y ? mirror.b.y : mirror.c.z) = -1;
		Problem        q                                                                 = turned(p, mirror);
		SolverSettings s                                                                 = sweeping(30);
		EXPECT_GT(solve(p, s).strips, 4);
		solve(q, s);
		for (Twist& v : q.velocities)
			v = mirror(v);
		for (std::size_t b = 0; b < p.bodyCount(); ++b)
			ASSERT_EQ(
			        largest(p.velocities[b].v - q.velocities[b].v)
			                + largest(p.velocities[b].w - q.velocities[b].w),
			        0)
			        << b;
	}
}

TEST(SpaceSymmetry, PowersOfTwoInTheUnitsChangeNoDigit)
{
	Problem          p = moving(), q = p;
	constexpr double metre = 8, second = 4, kilogram = 0.5;
	const double     speed = metre / second, impulse = kilogram * speed;
	for (InverseMass& m : q.inverseMass)
		m = InverseMass::ofSphere(m.x / kilogram, m.inertia.xx / (kilogram * metre * metre));
	for (Twist& v : q.freeVelocity)
		v = { speed * v.v, 1 / second * v.w };
	for (Vector& x : q.positions)
		x = metre * x;
	for (Contact& c : q.contacts) {
		c.leverI *= metre;
		c.leverJ *= metre;
		c.length *= metre;
		c.rollingArm *= metre;
		c.twistingArm *= metre;
		c.biasN *= speed;
		c.adhesion *= impulse;
	}
	for (const double tolerance : { 1e-4, 1e-300 }) { // in floats and in doubles
		SolverSettings s = sweeping(40);
		s.tolerance      = tolerance;
		Problem    one = p, other = q;
		const auto a = solve(one, s), b = solve(other, s);
		EXPECT_EQ(a.iterations, b.iterations);
		EXPECT_EQ(a.residual.relative(), b.residual.relative());
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			ASSERT_EQ(largest(impulse * one.impulses[k].f - other.impulses[k].f), 0);
			ASSERT_EQ(largest(impulse * metre * one.impulses[k].m - other.impulses[k].m), 0);
		}
	}
}

TEST(SpaceSymmetry, OrderAndNamesDoNotMatterToTheMotion)
{
	Problem p = lattice(5, 4).problem;
	for (Contact& c : p.contacts) // one graph a contact, one motion
		c.friction = c.rollingArm = c.twistingArm = 0;
	const int        bodies = int(p.bodyCount());
	std::vector<int> name(bodies);
	std::iota(name.begin(), name.end(), 0);
	std::mt19937 dice(3);
	std::shuffle(name.begin(), name.end(), dice);
	Problem q = p;
	for (int b = 0; b < bodies; ++b) {
		q.inverseMass[name[b]]  = p.inverseMass[b];
		q.freeVelocity[name[b]] = p.freeVelocity[b];
		q.positions[name[b]]    = p.positions[b];
	}
	std::shuffle(q.contacts.begin(), q.contacts.end(), dice);
	for (std::size_t k = 0; k < q.contactCount(); ++k) {
		Contact& c = q.contacts[k];
		c.i        = name[c.i];
		c.j        = name[c.j];
		if (k % 2 == 0) { // told from the other body
			std::swap(c.i, c.j);
			std::swap(c.leverI, c.leverJ);
			c.leverI = -c.leverI;
			c.leverJ = -c.leverJ;
			c.n      = -1 * c.n;
		}
	}
	SolverSettings s;
	s.tolerance     = 1e-12;
	s.maxIterations = 100000;
	ASSERT_TRUE(solve(p, s).converged);
	ASSERT_TRUE(solve(q, s).converged);
	for (int b = 0; b < bodies; ++b)
		EXPECT_LE(length(p.velocities[b].v - q.velocities[name[b]].v), 1e-9);
}

} // namespace
