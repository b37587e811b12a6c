// Which strips are visited, and that nothing but work depends on it.
#include "every_path.hpp"
#include "problems.hpp"
#include <contact/core/active_strips.hpp>
#include <contact/plane/solver.hpp>
#include <cmath>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

std::vector<ResidualSums> sumsOf(const std::vector<double>& squares)
{
	std::vector<ResidualSums> sums;
	for (const double s : squares)
		sums.push_back({ s, 1, s });
	return sums;
}

// seven strips in the order of places: 0, 2, 4, 6 and then 1, 3, 5; ten contacts in the first, eleven in the next, …
const std::vector<std::size_t> begin { 0, 10, 21, 33, 46, 60, 75, 91, 91 };
constexpr std::size_t          even = 4;

TEST(ActiveStrips, AreThoseAboveAShareOfTheMean)
{
	ActiveStrips strips;
	strips.reset(begin, even);
	EXPECT_EQ(strips.contacts(), 91u);
	EXPECT_EQ(strips.work(), begin);
	// mean 1, so the bound is 0.005
	EXPECT_TRUE(strips.choose(sumsOf({ 0.0049, 0.0051, 0, 6.9749, 0.0051, 0.0051, 0.0049, 0 })));
	const bool active[] = { false, true, false, true, true, true, false };
	for (std::size_t s = 0; s < 7; ++s) {
		EXPECT_EQ(strips.isActive(s), active[s]) << s;
		EXPECT_EQ(strips.comesToRest(s), !active[s]) << s;
	}
	EXPECT_TRUE(strips.anyComesToRest());
	EXPECT_EQ(strips.contacts(), 11u + 13 + 14 + 15);
	// a sixteenth of what rests, rounded down: all have less than sixteen contacts but the last
	EXPECT_EQ(strips.work(), (std::vector<std::size_t> { 0, 0, 11, 11, 24, 38, 53, 54, 54 }));
	// the same again: nothing comes to rest that did before
	EXPECT_FALSE(strips.choose(sumsOf({ 0.0049, 0.0051, 0, 6.9749, 0.0051, 0.0051, 0.0049, 0 })));
	EXPECT_FALSE(strips.anyComesToRest());
	EXPECT_TRUE(strips.wakeAll());
	EXPECT_EQ(strips.contacts(), 91u);
	EXPECT_FALSE(strips.wakeAll());
}

TEST(ActiveStrips, MoveTheBodiesOfTheirNeighbours)
{
	// one active strip after the other, by its number from one end of the packing
	for (std::size_t one = 0; one < 7; ++one) {
		ActiveStrips        strips;
		std::vector<double> squares(8, 0);
		squares[one % 2 == 0 ? one / 2 : even + one / 2] = 1;
		strips.reset(begin, even);
		strips.choose(sumsOf(squares));
		for (std::size_t other = 0; other < 7; ++other) {
			const std::size_t place  = other % 2 == 0 ? other / 2 : even + other / 2;
			const bool        beside = other <= one + 1 && one <= other + 1;
			EXPECT_EQ(strips.changes(place), beside) << one << " " << other;
			// bodies of an even strip and the next: contacts of these two, and of the one before, which reach into it
			if (other % 2 == 0) {
				EXPECT_EQ(strips.moves(place), one + 1 >= other && one <= other + 1)
				        << one << " " << other;
			}
		}
	}
}

TEST(ActiveStrips, WhatIsNoNumberDoesNotRest)
{
	ActiveStrips strips;
	strips.reset(begin, even);
	strips.choose(sumsOf({ 1, std::nan(""), 0, 1, 1, 1, 1, 0 }));
	EXPECT_TRUE(strips.isActive(1));
}

/// A lattice at rest of which a few disks are hit, each `fading` times as fast as the one before, so that most strips have nothing to do.
Problem hit(double fading = 1)
{
	Problem        p = lattice(300, 20).problem;
	SolverSettings s;
	s.tolerance     = 1e-9;
	s.maxIterations = 20000;
	EXPECT_TRUE(solve(p, s).converged);
	double speed = fading * 0.5;
	for (const int b : { 3000, 3050, 3110, 4521 }) {
		p.freeVelocity[b].x += speed;
		speed *= fading;
	}
	return p;
}

// Momentum is taken from strips again and again: were velocities not those of the impulses then, what has converged would not have when they are computed anew.
TEST(ActiveStrips, SolveTheSameProblemWithFewerVisits)
{
	for (const bool mixed : { false, true }) // with contacts that fit into no block, too
		for (const bool reference : { false, true }) {
			Problem p = hit(mixed ? 0.1 : 1); // fading: one strip after the other comes to rest
			for (std::size_t k = 8000; mixed && k < 9000; k += 7)
				p.contacts[k].biasT = 1e-5;
			SolverSettings s;
			s.tolerance      = 1e-8;
			s.maxIterations  = 5000;
			s.reference      = reference;
			Problem    all   = p;
			const auto rest  = solve(p, s);
			s.checkEvery     = 16; // too seldom for strips to rest
			const auto whole = solve(all, s);
			EXPECT_TRUE(rest.converged && whole.converged) << mixed << reference;
			EXPECT_LE(naturalMapResidual(p).relative(), 1e-8 * (1 + 1e-6)) << mixed << reference;
			// four disks of 300 columns are hit: most of it has nothing to do
			EXPECT_LT(rest.iterations, 0.7 * whole.iterations) << mixed << reference;
		}
}

TEST(ActiveStrips, AllThreadsAndInstructionsGiveTheSameBits)
{
	SolverSettings s;
	s.tolerance     = 1e-300;
	s.maxIterations = 60;
	expectTheSameBits(hit(), s);
}

} // namespace
