// Strips let threads share a sweep without changing a bit.
#include "problems.hpp"
#include <algorithm>
#include <contact/sweep_order.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

Contact between(int i, int j)
{
	Contact c;
	c.i = i;
	c.j = j;
	return c;
}

/// A heavy disk with more than 64 neighbours above the lattice's left end, which spoils colours there.
Problem crowded()
{
	Problem   p   = lattice(60, 20).problem;
	const int big = static_cast<int>(p.inverseMass.size());
	p.inverseMass.push_back({ 1e-6, 1e-6, 1e-6 });
	p.freeVelocity.push_back({ 0.01, -0.05, 0.1 });
	p.positions.push_back({ 5, 20 });
	for (int k = 0; k < 80; ++k) {
		Contact c    = between(60 * (k / 5) + k % 5, big);
		c.nx         = std::cos(k);
		c.ny         = std::sin(k);
		c.leverTi    = 0.5;
		c.leverTj    = -5;
		c.friction   = 0.3;
		c.rollingArm = 0.1;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	}
	return p;
}

/// Each contact once, and no movable body in two strips that are swept at the same time.
SweepOrder arranged(const Problem& p, int threads = 1)
{
	SweepOrder result;
	arrange(p, threads, result);
	return result;
}

std::vector<std::uint8_t> coloursOf(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverse)
{
	std::vector<std::uint8_t>  colours;
	std::vector<std::uint64_t> used;
	Problem                    p;
	p.contacts    = contacts;
	p.inverseMass = inverse;
	colour(arranged(p).pairs, inverse.size(), colours, used);
	return colours;
}

void expectSound(const SweepOrder& sweep, const Problem& p)
{
	ASSERT_EQ(sweep.order.size(), p.contactCount());
	ASSERT_EQ(sweep.stripBegin.front(), 0u);
	ASSERT_EQ(sweep.stripBegin.back(), p.contactCount());
	ASSERT_TRUE(std::is_sorted(sweep.stripBegin.begin(), sweep.stripBegin.end()));
	ASSERT_EQ(sweep.evenStrips, (sweep.stripCount() + 1) / 2);
	auto order = sweep.order;
	std::sort(order.begin(), order.end());
	for (std::size_t k = 0; k < order.size(); ++k)
		ASSERT_EQ(order[k], static_cast<std::int32_t>(k));
	ASSERT_EQ(sweep.bodies.size(), p.bodyCount());
	ASSERT_EQ(sweep.bodyBegin.size(), sweep.stripCount() + 1);
	ASSERT_EQ(long(sweep.bodyBegin.back()), std::count_if(p.inverseMass.begin(), p.inverseMass.end(), [](const InverseMass& m) { return !m.isFixed(); }));
	std::vector<std::size_t> place(p.bodyCount(), p.bodyCount());
	for (std::size_t k = 0; k < sweep.bodies.size(); ++k)
		place[sweep.bodies[k]] = k;
	ASSERT_EQ(std::count(place.begin(), place.end(), p.bodyCount()), 0);
	for (const bool even : { true, false }) {
		std::vector<long> owner(p.bodyCount(), -1);
		for (std::size_t s = even ? 0 : sweep.evenStrips; s < (even ? sweep.evenStrips : sweep.stripCount()); ++s)
			for (std::size_t k = sweep.stripBegin[s]; k < sweep.stripBegin[s + 1]; ++k) {
				const Contact& c = p.contacts[sweep.order[k]];
				for (const int body : { c.i, c.j }) {
					if (p.inverseMass[body].isFixed()) continue;
					ASSERT_TRUE(owner[body] < 0 || owner[body] == static_cast<long>(s)) << "body " << body << " in two strips";
					owner[body] = static_cast<long>(s);
					// a strip of the first half extrapolates its own bodies and those of the next one, the second half finds that done
					const std::size_t number = even ? 2 * s : 2 * (s - sweep.evenStrips) + 1, end = std::min(number + 2, sweep.stripCount());
					ASSERT_GE(place[body], sweep.bodyBegin[number]);
					ASSERT_LT(place[body], sweep.bodyBegin[end]);
				}
			}
	}
}

TEST(SweepOrder, StripsOfOneHalfShareNoMovableBody)
{
	const Problem wide = lattice(60, 20).problem, high = lattice(20, 60).problem, crowd = crowded();
	for (const Problem* p : { &wide, &high, &crowd }) {
		const SweepOrder sweep = arranged(*p);
		expectSound(sweep, *p);
	}
	EXPECT_GE(arranged(wide).stripCount(), 4u); // or the tests of threads would test nothing
	EXPECT_GE(arranged(high).stripCount(), 4u);
}

TEST(SweepOrder, OneStripWithoutPositionsOrForFewContacts)
{
	Problem p = lattice(60, 20).problem;
	p.positions.clear();
	EXPECT_EQ(arranged(p).stripCount(), 1u);
	expectSound(arranged(p), p);
	const Problem small = lattice(10, 10).problem;
	EXPECT_EQ(arranged(small).stripCount(), 1u);
	expectSound(arranged(small), small);
	expectSound(arranged(Problem {}), Problem {});
}

TEST(SweepOrder, ColoursShareNoMovableBody)
{
	const Problem p       = lattice(30, 20).problem;
	const auto    colours = coloursOf(p.contacts, p.inverseMass);
	ASSERT_EQ(colours.size(), p.contactCount());
	std::vector<std::uint64_t> used(p.bodyCount(), 0);
	for (std::size_t k = 0; k < p.contactCount(); ++k)
		for (const int body : { p.contacts[k].i, p.contacts[k].j }) {
			if (p.inverseMass[body].isFixed()) continue;
			const auto bit = std::uint64_t(1) << colours[k];
			ASSERT_EQ(used[body] & bit, 0u) << "body " << body << " twice in colour " << int(colours[k]);
			used[body] |= bit;
		}
	const int most = *std::max_element(colours.begin(), colours.end());
	EXPECT_GE(most, 5); // six neighbours on the lattice
	EXPECT_LE(most, 10); // greedy: at most 2·6 − 1 colours
}

TEST(SweepOrder, FixedBodiesAreFreeAndTheLastColourIsShared)
{
	std::vector<InverseMass> inverse(101, { 1, 1, 1 });
	std::vector<Contact>     contacts;
	for (int k = 1; k <= 100; ++k)
		contacts.push_back(between(0, k));
	const auto crowd = coloursOf(contacts, inverse);
	EXPECT_EQ(std::count(crowd.begin(), crowd.end(), 63), 37); // 63 colours, and the rest in the last
	inverse[0]       = {};
	const auto fixed = coloursOf(contacts, inverse);
	EXPECT_EQ(std::count(fixed.begin(), fixed.end(), 0), 100);
}

TEST(SweepOrder, SameInputSameOrder)
{
	const SweepOrder one = arranged(lattice(60, 20).problem), again = arranged(lattice(60, 20).problem), two = arranged(lattice(60, 20).problem, 2);
	for (const SweepOrder* other : { &again, &two }) {
		EXPECT_EQ(one.order, other->order);
		EXPECT_EQ(one.bodies, other->bodies);
		EXPECT_EQ(one.stripBegin, other->stripBegin);
	}
}

TEST(Threads, SameBitsForOneAndTwo)
{
	for (const Method method : { Method::GaussSeidel, Method::Accelerated }) {
		for (const bool crowd : { false, true }) {
			SolverSettings s;
			s.method        = method;
			s.tolerance     = 1e-9;
			s.maxIterations = 60;
			std::vector<Problem>          solved;
			std::vector<SolverStatistics> statistics;
			for (const int threads : { 1, 2 }) {
				s.threads = threads;
				solved.push_back(crowd ? crowded() : lattice(60, 20).problem);
				statistics.push_back(solve(solved.back(), s));
			}
			EXPECT_GE(statistics[0].strips, crowd ? 1 : 4);
			EXPECT_EQ(statistics[1].iterations, statistics[0].iterations);
			EXPECT_EQ(statistics[1].residual.rms, statistics[0].residual.rms);
			EXPECT_TRUE(sameBits(solved[1].impulses, solved[0].impulses));
			EXPECT_TRUE(sameBits(solved[1].velocities, solved[0].velocities));
		}
	}
}

// one thread makes ten sweeps of so many strips at once, two make seven, sixteen have no room for more than one
TEST(Threads, SameBitsForSweepsAtOnce)
{
	const Problem  wide = lattice(400, 100).problem;
	SolverSettings s;
	s.tolerance     = 1e-300; // never met
	s.maxIterations = 25;
	std::vector<Problem>          solved;
	std::vector<SolverStatistics> statistics;
	for (const int threads : { 16, 1, 2 }) {
		s.threads = threads;
		solved.push_back(wide);
		statistics.push_back(solve(solved.back(), s));
		EXPECT_GE(statistics.back().strips, 160);
		EXPECT_EQ(statistics.back().residual.rms, statistics[0].residual.rms) << threads;
		EXPECT_TRUE(sameBits(solved.back().impulses, solved[0].impulses)) << threads;
		EXPECT_TRUE(sameBits(solved.back().velocities, solved[0].velocities)) << threads;
	}
}

} // namespace
