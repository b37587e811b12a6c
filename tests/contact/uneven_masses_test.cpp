// Light bodies among heavy ones: what is called solved is solved for each, and such problems are solved at all.
#include "every_path.hpp"
#include "uneven.hpp"
#include <contact/plane/bordered_band.hpp>
#include <contact/plane/law.hpp>
#include <contact/plane/mass_jumps.hpp>
#include <contact/plane/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// As the engine asks.
SolverSettings usual(Precision precision = Precision::Mixed)
{
	SolverSettings s;
	s.maxIterations = 2000;
	s.precision     = precision;
	return s;
}

constexpr double ofWeight = 1e-3; // what is asked of weights; left are some 1e-5

TEST(UnevenMasses, AColumnBearsItsWeightAtEveryContact)
{
	for (const double ratio : { 1e1, 1e2, 1e4, 1e6 })
		for (const auto& ratios :
		     { heavyOn(1, ratio), heavyOn(10, ratio), std::vector<double> { ratio, 1, ratio, 1, ratio },
		       std::vector<double> { ratio, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 } })
			for (const Precision precision : { Precision::Mixed, Precision::Double }) {
				SCOPED_TRACE(
				        std::to_string(ratio) + ", " + std::to_string(ratios.size())
				        + " disks, the first " + std::to_string(ratios[0]));
				Problem    p = column(ratios);
				const auto s = solve(p, usual(precision));
				EXPECT_TRUE(s.converged);
				double weight
				        = 0; // of what lies above, from the top down; contacts: disk on disk from below, then the floor
				for (std::size_t k = ratios.size(); k-- > 0;) {
					weight += gravity * step / p.inverseMass[k].y;
					const std::size_t contact = k > 0 ? k - 1 : ratios.size() - 1;
					EXPECT_NEAR(p.impulses[contact].n / weight, 1, ofWeight);
				}
				EXPECT_LE(worstSpeed(p.velocities), ofWeight);
			}
}

TEST(UnevenMasses, ABoulderOnPebblesWeighsWhatItWeighs)
{
	for (const auto& [sizes, rows] : { std::pair(6.0, 4), { 10.0, 1 }, { 50.0, 3 }, { 200.0, 1 } }) {
		SCOPED_TRACE(sizes);
		auto       on = onPebbles(sizes, rows);
		const auto s  = solve(on.problem, usual());
		EXPECT_TRUE(s.converged);
		EXPECT_GE(s.patches, 1);
		EXPECT_NEAR(carried(on.problem) / on.weight, 1, ofWeight);
		EXPECT_LE(std::abs(on.problem.velocities[on.boulder].y), ofWeight * gravity * step);
	}
}

TEST(UnevenMasses, ALidOfAHundredMillionKilogramsOnTwentyFiveDisks)
{
	std::vector<Disk> disks;
	for (int k = 0; k < 25; ++k)
		disks.push_back({ double(k % 5), 0.5 + k / 5, 0.5 });
	Scene scene(disks);
	scene.touchDisks(1e-9);
	scene.wall(0, 0, 0, 1, 1e-9);
	Problem      p    = scene.problem;
	const auto   lid  = static_cast<std::int32_t>(p.bodyCount());
	const double mass = 1e8;
	p.inverseMass.push_back({ 0, 1 / mass, 0 });
	p.freeVelocity.push_back({ 0, -gravity * step, 0 });
	p.positions.push_back({ 2, 5 });
	for (int k = 20; k < 25; ++k) {
		Contact c;
		c.i = lid, c.j = k, c.nx = 0, c.ny = -1, c.leverTj = -0.5, c.friction = 0.3;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	}
	EXPECT_TRUE(solve(p, usual()).converged);
	EXPECT_NEAR(carried(p) / (mass * gravity * step + scene.weightImpulse()), 1, ofWeight);
	EXPECT_LE(worstSpeed(p.velocities), ofWeight);
}

TEST(UnevenMasses, AHeavyDiskInALatticeMovesAsByPlainSweepsInLongDoubles)
{
	for (const double ratio : { 30.5, 60.0 }) { // plain sweeps need a hundred times the ratio
		Scene scene = lattice(5, 4);
		makeHeavier(scene.problem, 12, ratio);
		const auto wanted = plainReference(scene.problem, 20000);
		EXPECT_LE(worstSpeed(wanted, plainReference(scene.problem, 15000)), 1e-5); // it has come to its end
		const auto s = solve(scene.problem, usual());
		EXPECT_TRUE(s.converged);
		EXPECT_LE(worstSpeed(scene.problem.velocities, wanted), 1e-2);
	}
}

TEST(UnevenMasses, SharesOfSpeedAreThoseOfTheirDefinitionOnEveryPath)
{
	// by hand: a light disk (twice as fast as it changed) comes down on a heavy one at rest that has changed by 3 of its speed
	Problem p;
	p.inverseMass      = { { 0.25, 0.25, 0 }, { 1, 1, 0 }, {} };
	p.freeVelocity     = { { 0, -3, 0 }, { 0, -1, 0 }, {} };
	const auto contact = [](int i, int j) {
		Contact c;
		c.i = i, c.j = j, c.nx = 0, c.ny = 1;
		return c;
	};
	p.contacts          = { contact(2, 0), contact(0, 1), contact(2, 1) };
	p.impulses          = { { 12, 0, 0 }, {}, {} }; // the floor holds the heavy one
	p.contacts[2].biasN = 100; // open, so that it does not count
	SolverSettings s;
	s.maxIterations = 0;
	s.tolerance
	        = 1; // what impulses miss is less, so that the rms of Δv is in the scale: 3 of one body and nothing of the other
	const double share = 1
	        / (1 + 9 + 4.5); // the light one misses 1, beside the 3 of the heavy one; two contacts act or should
	forEachPath(p, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem    copy = p;
		const auto r    = solve(copy, settings).residual;
		EXPECT_NEAR(r.largestSpeed, std::sqrt(share), 1e-12) << name;
		EXPECT_NEAR(r.speed, std::sqrt(share / 2), 1e-12) << name;
	});
	s.tolerance = 1e-4; // impulses decide, and the scale is each body's own
	forEachPath(p, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem copy = p;
		EXPECT_NEAR(solve(copy, settings).residual.largestSpeed, std::sqrt(1 / 10.0), 1e-12) << name;
	});
	std::swap(p.contacts[1].i, p.contacts[1].j);
	p.contacts[1].ny = -1;
	EXPECT_NEAR(naturalMapResidual(p).largestSpeed, std::sqrt(share), 1e-12);
	// and of a packing, with contacts outside blocks and open ones
	Problem packing = mixedLattice();
	s.tolerance     = 1e-300;
	s.maxIterations = 7; // impulses are far from solved, so that the scale is each body's own
	forEachPath(packing, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem    copy    = packing;
		const auto found   = solve(copy, settings).residual;
		const auto defects = naturalMapDefects(copy);
		double     sum = 0, most = 0, active = 0;
		for (std::size_t k = 0; k < copy.contactCount(); ++k) {
			const Contact& c      = copy.contacts[k];
			const auto     change = [&](int b) {
                                const Twist &v = copy.velocities[b], &from = copy.freeVelocity[b];
                                return Twist { v.x - from.x, v.y - from.y, v.w - from.w };
			};
			const auto share = speedShare(
			        c, copy.impulses[k], defects[k], copy.inverseMass[c.i], copy.inverseMass[c.j],
			        change(c.i), change(c.j), SpeedScale { 1e-11, 0, 1e-30 });
			sum += share.all;
			most = std::max(most, share.point);
			active += copy.impulses[k].n + c.adhesion > 0 || defects[k].n != 0;
		}
		EXPECT_NEAR(found.speed, std::sqrt(sum / active), 1e-9)
		        << name; // velocities are added up in another order
		EXPECT_NEAR(found.largestSpeed, std::sqrt(most), 1e-9) << name;
		EXPECT_GT(found.speed, 1e-3) << name;
	});
}

TEST(UnevenMasses, ALightDiskBesideASolvedStackIsBorne)
{
	for (const double ratio : { 1e3, 1e6 })
		for (const Precision precision : { Precision::Mixed, Precision::Double }) {
			Problem        p = column(std::vector<double>(10, 1));
			SolverSettings s = usual(precision);
			s.tolerance      = 1e-6;
			solve(p, s);
			const auto light = static_cast<std::int32_t>(p.bodyCount());
			p.inverseMass.push_back(p.inverseMass[0]);
			makeHeavier(p, light, 1 / ratio);
			p.freeVelocity.push_back(p.freeVelocity[0]);
			p.positions.push_back({ 3, 0.5 });
			Contact c = p.contacts.back(); // the lowest disk's with the floor
			c.j       = light;
			p.contacts.push_back(c);
			p.impulses.emplace_back();
			EXPECT_GT(solve(p, usual(precision)).iterations, 0);
			EXPECT_LE(std::abs(p.velocities[light].y), 1e-2 * gravity * step);
		}
}

TEST(UnevenMasses, AClampedDiskIsHeldByTheFrictionThatItHasNotYet)
{
	Scene scene({ { 0, 0, 0.5 } });
	scene.wall(-0.5, 0, 1, 0, 1e-9);
	scene.wall(0.5, 0, -1, 0, 1e-9);
	Problem& p = scene.problem;
	for (Impulse& i : p.impulses)
		i.n = 1e6 * scene.weightImpulse();
	EXPECT_GT(solve(p, usual()).iterations, 0);
	EXPECT_LE(worstSpeed(p.velocities), 1e-2);
}

TEST(UnevenMasses, NoBodyIsOverlookedWhoseContactsAreForgotten)
{
	Problem p = lattice(60, 20).problem;
	solve(p, usual());
	const auto solved = p.impulses;
	for (std::size_t body = 0; body < 1200; body += 53) {
		p.impulses  = solved;
		double lost = 0;
		for (std::size_t k = 0; k < p.contactCount(); ++k)
			if (std::size_t(p.contacts[k].i) == body || std::size_t(p.contacts[k].j) == body) {
				lost += p.impulses[k].n;
				p.impulses[k] = {};
			}
		const double weight = gravity * step / p.inverseMass[body].y;
		const auto   s      = solve(p, usual());
		EXPECT_EQ(lost > 0.5 * weight && s.iterations == 0, false) << body;
		EXPECT_TRUE(s.converged) << body;
	}
}

/// Everything in other units: speeds, masses and lengths times powers of two.
Problem inUnits(Problem p, int speed, int mass)
{
	for (Twist& v : p.freeVelocity)
		v = { std::ldexp(v.x, speed), std::ldexp(v.y, speed), std::ldexp(v.w, speed) };
	for (InverseMass& m : p.inverseMass)
		m = { std::ldexp(m.x, -mass), std::ldexp(m.y, -mass), std::ldexp(m.w, -mass) };
	for (Contact& c : p.contacts)
		c.biasN = std::ldexp(c.biasN, speed), c.adhesion = std::ldexp(c.adhesion, speed + mass);
	return p;
}

TEST(UnevenMasses, UnitsChangeNothingEvenWhereSquaresVanish)
{
	const Problem first  = lattice(8, 6).problem;
	Problem       one    = first;
	const auto    wanted = solve(one, usual(Precision::Double));
	for (const auto& [speed, mass] : { std::pair(40, -20), { -600, 0 }, { 0, -600 }, { -550, 20 } }) {
		SCOPED_TRACE(std::to_string(speed) + ", " + std::to_string(mass));
		Problem    other = inUnits(first, speed, mass);
		const auto found = solve(other, usual(Precision::Double));
		EXPECT_TRUE(found.converged);
		EXPECT_EQ(found.iterations, wanted.iterations);
		for (std::size_t b = 0; b < one.bodyCount(); ++b) {
			EXPECT_EQ(std::ldexp(other.velocities[b].y, -speed), one.velocities[b].y);
			EXPECT_EQ(std::ldexp(other.velocities[b].w, -speed), one.velocities[b].w);
		}
	}
}

TEST(UnevenMasses, WhatMovesTogetherIsSolvedAlike)
{
	Problem p = onPebbles(20, 3).problem, moving = p;
	for (Twist& v : moving.freeVelocity)
		v.x += 10, v.y -= 20;
	const auto rests = solve(p, usual()), moves = solve(moving, usual());
	EXPECT_EQ(rests.iterations, moves.iterations);
	EXPECT_TRUE(moves.converged);
	for (std::size_t b = 0; b < p.bodyCount();
	     ++b) // velocities are rounded at 20 m/s, and the patch amplifies that
		EXPECT_NEAR(moving.velocities[b].y + 20, p.velocities[b].y, ofWeight * gravity * step);
}

TEST(UnevenMasses, PatchesAreOneThreadsWorkAndBitsAreTheSame)
{
	const auto on = onPebbles(110, 3);
	ASSERT_GT(on.problem.contactCount(), 1000u); // fewer would take one thread
	expectTheSameBits(on.problem, usual());
}

TEST(MassJumps, AreThoseBetweenBodiesThatMove)
{
	const InverseMass one { 1, 1, 1 }, heavy { 1 / 30.5, 1 / 30.5, 1 }, less { 1 / 29.5, 1 / 29.5, 1 },
	        held { 0, 1 / 61.0, 0 };
	EXPECT_TRUE(isMassJump(one, heavy, massJump));
	EXPECT_TRUE(isMassJump(heavy, one, massJump));
	EXPECT_TRUE(isMassJump(one, held, massJump));
	EXPECT_FALSE(isMassJump(one, less, massJump));
	EXPECT_TRUE(isMassJump(one, less, fewsJump));
	EXPECT_FALSE(isMassJump(one, {}, massJump));
	EXPECT_FALSE(isMassJump({}, {}, massJump));
	EXPECT_EQ(jumpOf(column(heavyOn(10, 10))), fewsJump);
	EXPECT_EQ(jumpOf(lattice(20, 20).problem), massJump);
}

TEST(MassJumps, APatchHasTheNearestBodiesAndNoneIsMadeOfMany)
{
	const auto on      = onPebbles(250, 4);
	const auto patches = massPatches(on.problem);
	ASSERT_EQ(patches.size(), 1u);
	EXPECT_EQ(patches[0].bodies.size(), mostInPatch); // of 1,299
	EXPECT_NE(std::find(patches[0].bodies.begin(), patches[0].bodies.end(), on.boulder), patches[0].bodies.end());
	EXPECT_LE(patches[0].width, 20u); // four rows deep, and what lies under the boulder side by side
	Problem mixture = lattice(20, 20).problem;
	for (std::size_t k = 0; k < 400; k += 4)
		makeHeavier(mixture, k, 100);
	EXPECT_TRUE(massPatches(mixture).empty()); // one in four is heavy: sweeps' work
	Problem like = lattice(20, 20).problem;
	EXPECT_EQ(solve(like, usual()).patches, 0);
}

TEST(BorderedBand, SolvesWhatItWasMultipliedFrom)
{
	constexpr std::size_t                  inner = 40, border = 3, width = 5, all = inner + border;
	std::mt19937                           random(1);
	std::uniform_real_distribution<double> draw(-1, 1);
	std::vector<std::vector<double>>       a(all, std::vector<double>(all, 0));
	BorderedBand                           band;
	band.reset(inner, border, width);
	for (std::size_t r = 0; r < all; ++r)
		for (std::size_t c = 0; c < all; ++c)
			if (r >= inner || c >= inner || (r > c ? r - c : c - r) <= width)
				band.at(r, c) = a[r][c] = r == c ? 0 : draw(random); // pivots are needed
	std::vector<double> wanted(all), x(all, 0);
	for (double& w : wanted)
		w = draw(random);
	for (std::size_t r = 0; r < all; ++r)
		for (std::size_t c = 0; c < all; ++c)
			x[r] += a[r][c] * wanted[c];
	ASSERT_TRUE(band.factorise());
	band.solve(x);
	for (std::size_t r = 0; r < all; ++r)
		EXPECT_NEAR(x[r], wanted[r], 1e-10); // rounding times a condition of some hundreds
	band.reset(inner, border, width);
	EXPECT_FALSE(band.factorise());
}

// gaps of up to half of what a body falls in a step, and much friction: the acceleration runs in circles
TEST(Stagnation, PlainSweepsGoOnWhereTheAccelerationGetsNowhere)
{
	int converged = 0;
	for (unsigned seed = 0; seed < 8; ++seed) {
		std::mt19937                           random(seed);
		std::uniform_real_distribution<double> lack(0, 0.25 * 0.1 * gravity * step * step);
		std::vector<Disk>                      disks;
		for (int b = 0; b < 5; ++b)
			for (int a = 0; a < 7; ++a)
				disks.push_back({ a + 0.5 * (b % 2), 0.5 + b * std::sqrt(0.75), 0.5 - lack(random) });
		Scene scene(disks);
		scene.friction = 0.7;
		scene.rolling  = 0;
		scene.touchDisks(1e-3);
		scene.wall(0, 0, 0, 1, 1e-3);
		SolverSettings s = usual(Precision::Double);
		s.maxIterations  = 3000;
		converged += solve(scene.problem, s).converged;
	}
	EXPECT_GE(converged, 7);
}

} // namespace
