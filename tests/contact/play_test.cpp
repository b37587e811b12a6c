// Bonds that close freely: each branch of their graph by hand, one contact against its analytic answer on every path, chains, displacements, and heavy bodies.
#include "every_path.hpp"
#include "uneven.hpp"
#include <contact/plane/law.hpp>
#include <contact/plane/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

constexpr double rounding = 1e-14; // of a few operations on numbers near one

/// A bond of 0.02 m in a step of 0.01 s, of which 0.015 m are left: b_n = 1.5 m/s, p = 2 m/s.
Contact bond()
{
	Contact c;
	c.adhesion   = 3;
	c.friction   = 0.5;
	c.rollingArm = 0.25;
	c.biasN      = 1.5;
	c.play       = 2;
	return c;
}

TEST(Play, EachBranchOfTheGraphByHand)
{
	const Contact c       = bond();
	const double  inverse = 2; // 1/W: the play is an impulse of 4
	EXPECT_EQ(obeyNormal(c, 1.5, inverse), 1.5); // pressed at touch
	EXPECT_EQ(obeyNormal(c, 0, inverse), 0);
	EXPECT_EQ(obeyNormal(c, -1, inverse), 0); // in its play
	EXPECT_EQ(obeyNormal(c, -4, inverse), 0); // at its length, where nothing pulls yet
	EXPECT_EQ(obeyNormal(c, -5, inverse), -1); // pulled at its length
	EXPECT_EQ(obeyNormal(c, -7, inverse), -3);
	EXPECT_EQ(obeyNormal(c, -9, inverse), -3); // it yields
	Contact loose  = c;
	loose.adhesion = 0;
	EXPECT_EQ(obeyNormal(loose, -9, inverse), 0); // what bears no tension lets go
	Contact rigid = c;
	rigid.play    = 0;
	for (const double n : { -9.0, -1.0, 0.0, 2.0 })
		EXPECT_EQ(obeyNormal(rigid, n, inverse), projectNormal(n, c.adhesion));
}

TEST(Play, GivenMotionByHand)
{
	const Contact c  = bond();
	const auto    is = [&](double n, double t, double normal, double shear) {
                const Impulse p = impulseOfGivenMotion(c, { n, t, 0 });
                EXPECT_EQ(p.n, normal) << n;
                EXPECT_EQ(p.t, shear) << n;
	};
	is(-1.75, 0.1, 0, 0); // driven into each other
	is(-1.5, 0.1, 0, -1.5); // they touch at the end of the step; the least of the range
	is(-1, 0.1, 0, -1.5); // closing, and opening within the length: μ_s F_a of shear
	is(0.25, -0.1, 0, 1.5);
	is(0.5, 0.1, 0, -1.5);
	is(0.75, 0.1, -3, 0); // beyond it
}

/// Two disks side by side that a bond of length L holds, g apart, and come together or part at the speed given; masses one, no turning.
Problem pair(double speed, double gap, double length, double adhesion, double h)
{
	Problem p;
	p.inverseMass  = { { 1, 1, 2 }, { 1, 1, 2 } };
	p.freeVelocity = { {}, { speed, 0, 0 } };
	Contact c;
	c.i = 0, c.j = 1;
	c.leverTi = 0.5, c.leverTj = -0.5;
	c.biasN    = gap / h;
	c.play     = length / h;
	c.adhesion = adhesion;
	c.friction = 0.5;
	p.contacts = { c };
	p.impulses.resize(1);
	return p;
}

struct Pair {
	double speed; // of the free motion
	double normal, opening; // what the law says
};

TEST(Play, OnePairIsTheAnalyticAnswerOnEveryPath)
{
	// g = 0.015, L = 0.02, h = 0.01: free from −1.5 to 0.5 m/s; 1/W = 1/2; F_a h = 1, which stops 2 m/s beyond
	const Pair pairs[] = { { -4, 1.25, -1.5 }, { -1.6, 0.05, -1.5 }, { -1.4, 0, -1.4 }, { 0, 0, 0 },
		               { 0.4, 0, 0.4 },    { 0.6, -0.05, 0.5 },  { 2.5, -1, 0.5 },  { 3, -1, 1 } };
	for (const Pair& one : pairs)
		for (const Method method : methods) {
			SolverSettings s;
			s.method    = method;
			s.tolerance = 1e-12;
			for (const bool rows : { false, true }) { // in a block, and outside
				Problem p = pair(one.speed, 0.015, 0.02, 1, 0.01);
				if (rows) p.contacts[0].leverNj = 1e-30;
				forEachPath(p, s, [&](const SolverSettings& settings, const std::string& name) {
					SCOPED_TRACE(name + ", " + std::to_string(one.speed));
					Problem    at         = p;
					const auto statistics = solve(at, settings);
					EXPECT_TRUE(statistics.converged);
					EXPECT_NEAR(at.impulses[0].n, one.normal, rounding);
					EXPECT_NEAR(at.velocities[1].x - at.velocities[0].x, one.opening, rounding);
					EXPECT_LE(naturalMapResidual(at).largest, rounding);
				});
			}
		}
}

// T_max is that of N = 0 while the bond has play, and follows N where it is pressed or pulled
TEST(Play, ShearIsBornAsNSays)
{
	for (const auto& [speed, most] :
	     { std::pair(-4.0, 0.5 * (1 + 1.25)), { 0.0, 0.5 * 1 }, { 0.6, 0.5 * (1 - 0.05) }, { 3.0, 0.0 } }) {
		Problem p           = pair(speed, 0.015, 0.02, 1, 0.01);
		p.freeVelocity[1].y = 100; // slides on
		SolverSettings s;
		s.tolerance = 1e-12;
		solve(p, s);
		EXPECT_NEAR(p.impulses[0].t, -most, rounding) << speed;
	}
}

TEST(Play, AsLittleAsNothingIsARigidBond)
{
	for (const double speed : { -2.0, 0.5, 5.0 }) {
		Problem rigid = pair(speed, 0, 0, 1, 0.01), nearly = pair(speed, 0, 1e-12, 1, 0.01);
		solve(rigid, {});
		solve(nearly, {});
		EXPECT_NEAR(rigid.impulses[0].n, nearly.impulses[0].n, 1e-9) << speed; // p = 1e-10 m/s
	}
}

TEST(Play, TheResidualSeesWhatLiesOffTheGraph)
{
	Problem p     = pair(0, 0.015, 0.02, 1, 0.01);
	p.impulses[0] = { 0.25, 0, 0 }; // pressed without touch: the bodies part at 0.5, up to the length
	EXPECT_NEAR(naturalMapDefects(p)[0].n, 0.25, rounding);
	p.impulses[0] = { -0.25, 0, 0 }; // pulled below the length: −0.25 for 0
	EXPECT_NEAR(naturalMapDefects(p)[0].n, -0.25, rounding);
	p.impulses[0]       = {};
	p.freeVelocity[1].x = 2; // 1.5 beyond the length, of which nothing is taken: 1.5/W
	EXPECT_NEAR(naturalMapDefects(p)[0].n, 0.75, rounding);
}

TEST(Play, WhatMakesNoSenseIsRefused)
{
	for (const double play : { -1.0, HUGE_VAL, std::nan("") }) {
		Problem p          = pair(0, 0, 0, 1, 0.01);
		p.contacts[0].play = play;
		try {
			solve(p, {});
			FAIL() << play;
		} catch (const std::invalid_argument& error) {
			EXPECT_NE(std::string(error.what()).find("has the play"), std::string::npos) << error.what();
		}
	}
}

/// A row of disks along x between a wall and a pushed end, bonded over gaps; positions error and play given.
std::vector<Twist> displaced(const PositionError& error, bool across)
{
	Problem            p = pair(0, 0.015, 0.02, 1, 0.01);
	Workspace          workspace;
	PositionCorrection found;
	solve(p, {}, &workspace);
	correctPositions(p, {}, workspace, { error }, 5, found, across);
	return found.displacements;
}

TEST(Play, DisplacementsLeaveItAloneAndTakeBackWhatLiesBeyond)
{
	PositionError e;
	e.held = true;
	e.play = 0.02;
	for (const bool across : { false, true })
		for (const auto& [error, way] :
		     { std::pair(0.015, 0.0), { 0.0, 0.0 }, { 0.02, 0.0 }, { -0.004, 0.004 }, { 0.023, -0.003 } }) {
			e.error      = error;
			const auto d = displaced(e, across);
			EXPECT_NEAR(d[1].x - d[0].x, way, 1e-15) << error;
			EXPECT_NEAR(d[1].x + d[0].x, 0, 1e-15) << error;
		}
}

/// A heap of bonded disks of which every bond has play, some of it used.
Problem loose(int columns, int rows)
{
	Problem p = lattice(columns, rows).problem;
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		Contact& c = p.contacts[k];
		c.adhesion = 60.0 * double(k % 4);
		if (k % 3 > 0) c.play = std::max(c.biasN, 0.0) + 0.004 * double(k % 5);
	}
	return p;
}

TEST(Play, AllKernelsAndThreadsHaveTheSameBits)
{
	for (const Method method : methods)
		for (const Precision precision : { Precision::Mixed, Precision::Double }) {
			SolverSettings s;
			s.method        = method;
			s.precision     = precision;
			s.maxIterations = 60;
			expectTheSameBits(loose(50, 30), s);
		}
}

TEST(Play, BothMethodsFindOneMotion)
{
	Problem        plain = loose(8, 5), fast = plain;
	SolverSettings s;
	s.tolerance     = 1e-9;
	s.maxIterations = 20000;
	EXPECT_TRUE(solve(fast, s).converged);
	s.method = Method::GaussSeidel;
	EXPECT_TRUE(solve(plain, s).converged);
	EXPECT_LE(worstSpeed(plain.velocities, fast.velocities), 1e-6); // the tolerance times some hundred contacts
	int pressed = 0, pulled = 0, free = 0;
	for (std::size_t k = 0; k < fast.contactCount(); ++k) {
		const double n = fast.impulses[k].n;
		if (fast.contacts[k].play > 0) ++(n > 0 ? pressed : n < 0 ? pulled : free);
	}
	EXPECT_GT(std::min({ pressed, pulled, free }), 3); // all of them are there
}

TEST(Play, AWorkspaceKeptFromAProblemWithoutItServesOneWithIt)
{
	Workspace workspace;
	Problem   without = loose(30, 10), with = without, wanted = with;
	for (Contact& c : without.contacts)
		c.play = 0;
	Problem again = without, alone = without;
	solve(without, {}, &workspace);
	solve(with, {}, &workspace);
	solve(again, {}, &workspace);
	solve(wanted, {});
	solve(alone, {});
	EXPECT_TRUE(sameBits(with.impulses, wanted.impulses));
	EXPECT_TRUE(sameBits(again.impulses, alone.impulses));
	EXPECT_FALSE(sameBits(with.impulses, again.impulses));
}

// the patch around a mass jump is solved at once, play and all
TEST(Play, AHeavyDiskOnBondsThatCloseOrHold)
{
	for (const double ratio : { 1e3, 1e5 }) {
		// it presses a light one through its play onto the floor: n = all weights, the light one's speed the play of the lower bond
		Problem p = column({ 1, ratio });
		for (Contact& c : p.contacts) {
			c.adhesion = 1e-3 / p.inverseMass[0].y;
			c.biasN    = 0.01; // m/s, of the 0.05 that weights gain in a step
			c.play     = 0.04;
		}
		SolverSettings s;
		s.maxIterations    = 2000;
		const auto   found = solve(p, s);
		const double light = gravity * step / p.inverseMass[0].y, heavy = gravity * step / p.inverseMass[1].y;
		EXPECT_TRUE(found.converged) << ratio;
		EXPECT_NEAR(p.velocities[0].y, -0.01, 1e-3 * 0.05) << ratio; // as far as the floor, ofWeight
		EXPECT_NEAR(p.velocities[1].y, -0.02, 1e-3 * 0.05) << ratio;
		EXPECT_NEAR(p.impulses[0].n / (heavy * (1 - 0.02 / (gravity * step))), 1, 1e-3) << ratio;
		EXPECT_NEAR(
		        p.impulses[1].n
		                / (heavy * (1 - 0.02 / (gravity * step)) + light * (1 - 0.01 / (gravity * step))),
		        1, 1e-3)
		        << ratio;
		// it hangs on a light one that hangs on a ceiling: as far down as the plays let both
		Problem q = column({ 1, ratio });
		for (Contact& c : q.contacts) {
			c.ny       = -1; // the floor is a ceiling, the heavy one the lowest
			c.adhesion = 10 * heavy;
			c.biasN    = 0.03;
			c.play     = 0.04;
		}
		const auto hung = solve(q, s);
		EXPECT_TRUE(hung.converged) << ratio;
		EXPECT_NEAR(q.velocities[0].y, -0.01, 1e-3 * 0.05) << ratio;
		EXPECT_NEAR(q.velocities[1].y, -0.02, 1e-3 * 0.05) << ratio;
		EXPECT_NEAR(q.impulses[0].n / -(heavy * (1 - 0.02 / (gravity * step))), 1, 1e-3) << ratio;
		EXPECT_GT(found.patches + hung.patches, 0) << ratio;
	}
}

} // namespace
