// A problem of disks in a plane that is told in space has the plane's solution: the same velocities, and the same
// impulses where they are unique.
#include "../problems.hpp"
#include "balls.hpp"
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;
namespace plane = nonsmooth::contact;

namespace {

/// The same bodies and contacts in the plane of two axes of the world; what would leave the plane is free, but nothing
/// asks for it.
Problem inSpace(const plane::Problem& p, const Vector& x, const Vector& y)
{
	const Vector z      = cross(x, y);
	const auto   vector = [&](double a, double b) { return a * x + b * y; };
	Problem      s;
	for (std::size_t b = 0; b < p.bodyCount(); ++b) {
		const auto& m = p.inverseMass[b];
		s.inverseMass.push_back(InverseMass::ofSphere(m.x, m.w));
		s.freeVelocity.push_back({ vector(p.freeVelocity[b].x, p.freeVelocity[b].y), p.freeVelocity[b].w * z });
		s.positions.push_back(vector(p.positions[b].x, p.positions[b].y));
	}
	for (const plane::Contact& c : p.contacts) {
		Contact d;
		d.i          = c.i;
		d.j          = c.j;
		d.n          = vector(c.nx, c.ny);
		d.leverI     = c.leverTi;
		d.leverJ     = c.leverTj;
		d.biasN      = c.biasN;
		d.adhesion   = c.adhesion;
		d.friction   = c.friction;
		d.rollingArm = c.rollingArm;
		d.length     = c.length;
		d.play       = c.play;
		s.contacts.push_back(d);
	}
	s.impulses.resize(s.contactCount());
	return s;
}

/// Largest difference of velocities, told in the plane; HUGE_VAL where something has left it.
double difference(const plane::Problem& p, const Problem& s, const Vector& x, const Vector& y, double most = 0)
{
	const Vector z = cross(x, y);
	for (std::size_t b = 0; b < p.bodyCount(); ++b) {
		const Twist& v    = s.velocities[b];
		const auto&  w    = p.velocities[b];
		const double spin = dot(z, v.w), aside = std::abs(dot(z, v.v)) + length(v.w - spin * z);
		const double in[3] = { dot(x, v.v) - w.x, dot(y, v.v) - w.y, spin - w.w };
		most               = std::max({ most, aside, std::abs(in[0]), std::abs(in[1]), std::abs(in[2]) });
	}
	return most;
}

TEST(SpacePlane, DisksMoveAsInThePlane)
{
	const Vector axes[][2] = { { { 1, 0, 0 }, { 0, 0, 1 } },
		                   { unit({ 1, 2, -1 }), unit(cross({ 1, 2, -1 }, { 0, 1, 1 })) } };
	for (const bool bonds : { false, true }) {
		plane::Problem p = plane::testing::lattice(12, 8).problem;
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			plane::Contact& c = p.contacts[k];
			if (bonds && k % 3 > 0) c.adhesion = 50, c.play = k % 2 ? 0 : 0.01;
			// with one graph a contact there is one motion
			if (k % 2 == 0 || !bonds) c.friction = c.rollingArm = 0;
		}
		for (std::size_t b = 0; b + 1 < p.bodyCount(); ++b)
			p.freeVelocity[b].w = 0.3 * std::sin(double(b)),
			p.freeVelocity[b].x += 0.1 * std::cos(3. * double(b));
		plane::SolverSettings flat;
		flat.tolerance        = 1e-12;
		flat.maxIterations    = 200000;
		plane::Problem solved = p;
		ASSERT_TRUE(plane::solve(solved, flat).converged);
		for (const auto& [x, y] : axes)
			forEachPath(inSpace(p, x, y), {}, [&, x = x, y = y](SolverSettings s, const std::string& name) {
				Problem q       = inSpace(p, x, y);
				s.tolerance     = 1e-12;
				s.maxIterations = 200000;
				EXPECT_TRUE(solve(q, s).converged) << name;
				EXPECT_LE(difference(solved, q, x, y), 1e-6) << name << (bonds ? ", bonds" : "");
			});
	}
}

// sweep by sweep, not in the limit alone: the same order of the same contacts makes the same impulses
TEST(SpacePlane, SweepsAreThoseOfThePlane)
{
	plane::Problem p = plane::testing::lattice(12, 8).problem;
	for (std::size_t k = 0; k < p.contactCount(); k += 3)
		p.contacts[k].adhesion = 50;
	const Vector x { 1, 0, 0 }, y { 0, 0, 1 };
	for (const int sweeps : { 1, 7, 60 }) {
		plane::SolverSettings flat;
		flat.tolerance        = 1e-300;
		flat.maxIterations    = sweeps;
		plane::Problem solved = p;
		plane::solve(solved, flat);
		Problem        q = inSpace(p, x, y);
		SolverSettings s;
		s.tolerance     = 1e-300;
		s.maxIterations = sweeps;
		solve(q, s);
		EXPECT_LE(difference(solved, q, x, y), 1e-11);
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			const Vector n = q.contacts[k].n, t = cross(cross(x, y), n);
			const double most = std::abs(solved.impulses[k].n) + std::abs(solved.impulses[k].t) + 1;
			ASSERT_NEAR(dot(n, q.impulses[k].f), solved.impulses[k].n, 1e-10 * most);
			ASSERT_NEAR(dot(t, q.impulses[k].f), solved.impulses[k].t, 1e-10 * most);
			ASSERT_NEAR(dot(cross(x, y), q.impulses[k].m), solved.impulses[k].r, 1e-10 * most);
		}
	}
}

} // namespace
