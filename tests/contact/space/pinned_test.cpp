// The bits of a packing of spheres after twenty sweeps, and what floats leave of thresholds: whoever changes them
// decides so, and says it in a commit.
#include "balls.hpp"
#include <contact/space/law.hpp>
#include <gtest/gtest.h>
#include <iomanip>
#include <sstream>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;
using nonsmooth::contact::finestInSingle;

namespace {

/// FNV-1a of 64 bits.
std::string hashOf(const std::vector<Impulse>& impulses)
{
	std::uint64_t hash  = 14695981039346656037u;
	const auto*   bytes = reinterpret_cast<const unsigned char*>(impulses.data());
	for (std::size_t k = 0; k < impulses.size() * sizeof(Impulse); ++k)
		hash = (hash ^ bytes[k]) * 1099511628211u;
	std::ostringstream text;
	text << std::hex << std::setw(16) << std::setfill('0') << hash;
	return text.str();
}

/// 12 × 12 × 10 spheres above a floor, from numbers that every processor and library makes alike: no draws, no libm but
/// √. Some touch, some are bonded, and each moves.
Problem plainLattice()
{
	std::vector<Ball> balls;
	for (int c = 0; c < 10; ++c)
		for (int b = 0; b < 12; ++b)
			for (int a = 0; a < 12; ++a)
				balls.push_back({ { a + 0.5 * ((b + c) % 2), 0.8660254 * (b + (c % 2) / 3.0),
				                    0.5 + c * 0.8164966 },
				                  0.49 + 0.0001 * double(balls.size() * 7919 % 113) });
	Balls scene(balls);
	scene.touch(0.01);
	scene.wall({}, { 0, 0, 1 }, 0.01);
	Problem& p = scene.problem;
	for (std::size_t k = 0; k < p.contactCount(); k += 3)
		p.contacts[k].adhesion = 10 * double(k % 4);
	for (std::size_t b = 0; b + 1 < p.bodyCount(); ++b)
		p.freeVelocity[b] = { { 0.001 * double(b % 5), 0.002 * double(b % 3), -gravity * step },
			              { 0, 0.01 * double(b % 7), 0.02 } };
	return p;
}

TEST(SpacePinned, Lattice)
{
	const Problem problem = plainLattice();
	const auto    found   = [&](SolverSettings s, int threads) {
                Problem p       = problem;
                s.maxIterations = 20;
                s.threads       = threads;
                EXPECT_EQ(solve(p, s).iterations, 20);
                return hashOf(p.impulses);
	};
	const auto expect = [&](const std::string& hash, const char* pinned, const std::string& how) {
		EXPECT_EQ(hash, pinned) << how
		                        << ": the bits of the impulses have changed. If that is what you decided, put "
		                        << hash << " here and name the reason in the commit; else something is broken.";
	};
	for (const int threads : { 1, 2 }) {
		const std::string with = ", " + std::to_string(threads) + " thread(s)";
		SolverSettings    s;
		for (const BlockKernels* kernels : availableKernels()) {
			s.kernels   = kernels;
			s.tolerance = finestInSingle;
			expect(found(s, threads), "f9fb7532f5f6e7d6", kernels->name + (", in single precision" + with));
			s.tolerance = 1e-300;
			expect(found(s, threads), "4a6ef09f9c6aad0d", kernels->name + with);
		}
		s.reference = true;
		expect(found(s, threads), "43a6771eb9e6d8b8", "reference" + with);
	}
}

TEST(SpacePrecision, WhatIsOnAThresholdInFloatsIsSoInDoubles)
{
	Problem        p = plainLattice();
	SolverSettings s;
	s.tolerance      = 1e-4;
	s.maxIterations  = 60; // from floats, whether solved or not
	const auto found = solve(p, s);
	ASSERT_EQ(found.inSingle, found.iterations);
	int on[4] = {};
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		const Contact& c    = p.contacts[k];
		const Rows     q    = rowsOf(c, p.impulses[k]);
		const double   open = q.n + c.adhesion;
		if (c.adhesion > 0 && open < 1e-6 * c.adhesion) {
			ASSERT_LE(std::abs(open), 1e-15 * c.adhesion) << k;
			++on[0];
			continue;
		}
		const auto row = [&](double value, double threshold, int which) {
			if (open <= 0 || value < (1 - 1e-7) * threshold) return;
			ASSERT_NEAR(value / threshold, 1, 1e-14) << k << ", row " << which;
			++on[which];
		};
		row(length(q.t), slidingThreshold(c, q.n), 1);
		row(length(q.r), rollingThreshold(c, q.n), 2);
		row(std::abs(q.s), twistingThreshold(c, q.n), 3);
	}
	for (const int count : on)
		EXPECT_GT(count, 20);
}

} // namespace
