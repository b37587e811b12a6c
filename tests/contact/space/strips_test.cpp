// Strips of spheres that have nothing to do are not visited, and nothing but work depends on it.
#include "balls.hpp"
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;

namespace {

/// A layer of 150 × 8 spheres on a floor, of which four are hit, each a tenth as fast as the one before and all with a
/// spin: one strip after the other comes to rest.
Problem hitLayer()
{
	std::vector<Ball> balls;
	for (int a = 0; a < 150; ++a)
		for (int b = 0; b < 8; ++b)
			balls.push_back({ { a + 0.5 * (b % 2), 0.8660254 * b, 0.4999 }, 0.4999 });
	Balls scene(balls);
	scene.touch(0.01);
	scene.wall({}, { 0, 0, 1 }, 0.01);
	Problem&       p = scene.problem;
	SolverSettings s;
	s.tolerance     = 1e-9;
	s.maxIterations = 20000;
	EXPECT_TRUE(solve(p, s).converged);
	double speed = 0.5;
	for (const int b : { 600, 603, 621, 900 }) {
		p.freeVelocity[b].v.x += speed;
		p.freeVelocity[b].w = p.freeVelocity[b].w + Vector { 0.3 * speed, speed, -0.7 * speed };
		speed *= 0.1;
	}
	return p;
}

// Momentum and spin are taken from strips again and again: were velocities not those of the impulses then, what has
// converged would not have when they are computed anew.
TEST(SpaceStrips, SolveTheSameProblemWithFewerVisits)
{
	for (const bool reference : { false, true }) {
		Problem        p = hitLayer();
		SolverSettings s;
		s.tolerance      = 1e-8;
		s.maxIterations  = 5000;
		s.reference      = reference;
		Problem    all   = p;
		const auto rest  = solve(p, s);
		s.checkEvery     = 16; // too seldom for strips to rest
		const auto whole = solve(all, s);
		EXPECT_TRUE(rest.converged && whole.converged) << reference;
		EXPECT_LE(naturalMapResidual(p).relative(), 1e-8 * (1 + 1e-6)) << reference;
		// four of 150 rows are hit: much of it has nothing to do
		EXPECT_LT(rest.iterations, 0.8 * whole.iterations) << reference;
	}
}

} // namespace
