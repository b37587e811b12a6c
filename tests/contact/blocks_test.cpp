// Blocks of eight contacts: complete, without conflicts, and the same bits whatever instructions work on them.
#include "every_path.hpp"
#include "problems.hpp"
#include <algorithm>
#include <contact/core/contact_blocks.hpp>
#include <contact/plane/law.hpp>
#include <contact/plane/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Contacts between bodies at random: colours of all sizes, whose rests share blocks, and bodies that come first in one contact and second in the next.
Problem tangle(unsigned seed)
{
	std::mt19937                       random(seed);
	std::uniform_int_distribution<int> body(0, 39);
	Problem                            p;
	p.inverseMass.assign(40, { 1, 1, 1 });
	p.freeVelocity.assign(40, {});
	while (p.contacts.size() < 200) {
		Contact c;
		c.i = body(random);
		c.j = body(random);
		if (c.i == c.j) continue;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	}
	return p;
}

/// Moving bodies of a block's lanes first … last − 1, each as often as it is there.
std::vector<int>
movingBodies(const Problem& p, const ContactBlocks& b, std::size_t block, std::size_t first, std::size_t last)
{
	std::vector<int> bodies;
	for (std::size_t l = first; l < last; ++l) {
		const auto index = b.contactOf[block * lanes + l];
		if (index == ContactBlocks::none) continue;
		for (const int body : { p.contacts[index].i, p.contacts[index].j })
			if (!p.inverseMass[body].isFixed()) bodies.push_back(body);
	}
	std::sort(bodies.begin(), bodies.end());
	return bodies;
}

bool anyTwice(const std::vector<int>& sorted)
{
	return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// Expects every contact in one lane or outside the blocks, and no moving body twice in half a block; returns how many lanes idle.
std::size_t expectWhole(const Problem& p, const ContactBlocks& b)
{
	std::vector<int> seen(p.contactCount(), 0);
	std::size_t      empty = 0;
	for (const auto index : b.contactOf)
		if (index == ContactBlocks::none) ++empty;
		else
			++seen[index];
	for (std::size_t k = 0; k < b.inDouble.blocks.size(); ++k)
		for (const std::size_t first : { std::size_t(0), halfLanes })
			EXPECT_FALSE(anyTwice(movingBodies(p, b, k, first, first + halfLanes))) << "block " << k;
	for (const auto index : b.others)
		++seen[index];
	EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), long(p.contactCount()));
	return empty;
}

/// Expects that both halves of a block are visited at once where all its bodies move, each in one of its contacts; returns how many are.
std::size_t expectApart(const Problem& p, const ContactBlocks& b)
{
	std::size_t together = 0;
	for (std::size_t k = 0; k < b.inDouble.blocks.size(); ++k) {
		const auto moving = movingBodies(p, b, k, 0, lanes);
		EXPECT_EQ(b.inDouble.blocks[k].together, moving.size() == 2 * lanes && !anyTwice(moving))
		        << "block " << k;
		together += b.inDouble.blocks[k].together;
	}
	return together;
}

TEST(Blocks, HoldEveryContactOnceAndNoBodyTwice)
{
	const Problem p = mixedLattice();
	ContactBlocks b;
	layOut(p, 2, b);
	EXPECT_EQ(expectWhole(p, b), 11u) << "lanes idle; a tenth would be 350";
	// six or so contacts of the heavy body, one with a lever, one with a bias
	EXPECT_EQ(b.others.size(), 8u);
}

TEST(Blocks, AreVisitedAtOnceWhereNoBodyIsInBothHalves)
{
	const Problem p = mixedLattice();
	ContactBlocks b;
	layOut(p, 2, b);
	// colours of some ten blocks each: all but their ends, and the contacts with walls
	EXPECT_EQ(b.inDouble.blocks.size(), 438u);
	EXPECT_EQ(expectApart(p, b), 419u);
}

TEST(Blocks, OfATangleShareNoBodyEither)
{
	std::size_t empty = 0, together = 0;
	for (unsigned seed = 0; seed < 50; ++seed) {
		const Problem p = tangle(seed);
		ContactBlocks b;
		layOut(p, 1, b);
		empty += expectWhole(p, b);
		together += expectApart(p, b);
		EXPECT_TRUE(b.others.empty());
	}
	EXPECT_GT(empty, 0u); // a tangle that fills all lanes, or leaves all blocks alone, would try little
	EXPECT_GT(together, 50u);
}

TEST(Blocks, AllInstructionsGiveTheSameBits)
{
	ASSERT_STREQ(availableKernels().back()->name, "portable");
	for (const Method method : methods) {
		SolverSettings s;
		s.method        = method;
		s.maxIterations = 150;
		s.tolerance     = 1e-12;
		expectTheSameBits(mixedLattice(), s);
	}
}

// of bonds too: what they may pull and rub is cut where the general law cuts it
TEST(Blocks, AreFilledWithTheNumbersOfTheLaw)
{
	Problem                                p = mixedLattice();
	std::mt19937                           random(3);
	std::uniform_real_distribution<double> number(-1, 1);
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		p.contacts[k].adhesion = k % 3 == 0 ? 0 : 1;
		p.impulses[k]          = { 2 * number(random), number(random), 0.5 * number(random) };
	}
	for (const BlockKernels* kernels : availableKernels()) {
		ContactBlocks b;
		layOut(p, 1, b);
		for (std::size_t part = 0; part < b.partCount(); ++part)
			fillIn(p, *kernels, part, b);
		std::size_t cut[3] = {}, free[3] = {}; // impulses along n, t, r
		for (std::size_t k = 0; k < b.contactOf.size(); ++k) {
			if (b.contactOf[k] == ContactBlocks::none) continue;
			const Contact& c     = p.contacts[b.contactOf[k]];
			const Impulse &start = p.impulses[b.contactOf[k]], wanted = project(c, start);
			const Diagonal inverse = inverseDelassus(c, p.inverseMass[c.i], p.inverseMass[c.j]);
			const auto&    block   = b.inDouble.blocks[k / lanes];
			const auto     l       = k % lanes;
			const Impulse  now { block.n.v[l], block.t.v[l], block.r.v[l] },
			        before { block.beforeN.v[l], block.beforeT.v[l], block.beforeR.v[l] };
			ASSERT_TRUE(sameBits(std::vector<Impulse> { now, before }, { wanted, wanted }))
			        << kernels->name << ", contact " << b.contactOf[k];
			ASSERT_TRUE(sameBits(
			        std::vector<Diagonal> {
			                { block.inverseN.v[l], block.inverseT.v[l], block.inverseR.v[l] } },
			        { inverse }))
			        << kernels->name;
			ASSERT_EQ(b.inDouble.inverseLength[k / lanes].v[l], 1 / c.length);
			++(wanted.n == start.n ? free : cut)[0];
			++(wanted.t == start.t ? free : cut)[1];
			++(wanted.r == start.r ? free : cut)[2];
		}
		for (int row = 0; row < 3; ++row) { // a tenth at least on either side of the thresholds
			EXPECT_GT(10 * cut[row], p.contactCount()) << row;
			EXPECT_GT(10 * free[row], p.contactCount()) << row;
		}
	}
}

TEST(Blocks, FetchingAheadChangesNoBit)
{
	for (const BlockKernels* kernels : availableKernels())
		for (const double play : { 0.0, 0.1 }) { // m/s
			Problem p = mixedLattice();
			for (std::size_t k = 0; k < p.contactCount(); k += 2)
				p.contacts[k].adhesion = 100, p.contacts[k].play = play;
			ContactBlocks one;
			layOut(p, 1, one);
			for (std::size_t part = 0; part < one.partCount(); ++part)
				fillIn(p, *kernels, part, one);
			ContactBlocks other = one;
			EXPECT_EQ(one.inDouble.playsFrom(0) != nullptr, play > 0);
			std::vector<Motion<double>> bodies(p.bodyCount() + 1), same(bodies.size());
			for (std::size_t b = 0; b + 1 < bodies.size(); ++b)
				bodies[b].v = same[b].v = Four<double> { 0.01 * double(b % 7), -0.02 * double(b % 5), 0,
					                                 1e-4 };
			kernels->inDouble.sweep(
			        one.inDouble.blocks.data(), one.inDouble.playsFrom(0), one.inDouble.blocks.size(),
			        bodies.data(), 0);
			kernels->inDouble.sweepAndFetch(
			        other.inDouble.blocks.data(), other.inDouble.playsFrom(0), other.inDouble.blocks.size(),
			        same.data(), 0, one.inDouble.blocks.data());
			EXPECT_TRUE(sameBits(bodies, same)) << kernels->name;
		}
}

TEST(Blocks, ReferencePutsNoContactIntoABlock)
{
	const Problem p = mixedLattice();
	ContactBlocks b;
	layOut(p, 2, b, false);
	EXPECT_TRUE(b.inDouble.blocks.empty());
	std::vector<int> seen(p.contactCount(), 0);
	for (const auto index : b.others)
		++seen[index];
	EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), long(p.contactCount()));
}

TEST(Blocks, ReferenceFindsTheSameSolution)
{
	const double tolerance = 1e-9;
	Problem      blocked = mixedLattice(), reference = blocked;
	// a frictional packing has many sets of forces; with one graph a contact there is one motion, which both must find
	for (Problem* p : { &blocked, &reference })
		for (Contact& c : p->contacts)
			c.friction = c.rollingArm = 0;
	SolverSettings s;
	s.maxIterations = 20000;
	s.tolerance     = tolerance;
	const auto x    = solve(blocked, s);
	s.reference     = true;
	const auto y    = solve(reference, s);
	for (const auto& [statistics, problem] :
	     { std::pair<const SolverStatistics&, const Problem&> { x, blocked }, { y, reference } }) {
		EXPECT_TRUE(statistics.converged);
		EXPECT_LE(naturalMapResidual(problem).relative(), tolerance * (1 + 1e-6));
	}
	EXPECT_EQ(x.strips, y.strips);
	// 1e-9 of an impulse, carried through a packing of 20 layers, in the speed that gravity gives in a step
	for (std::size_t b = 0; b < blocked.bodyCount(); ++b) {
		EXPECT_NEAR(blocked.velocities[b].x, reference.velocities[b].x, 1e-6 * gravity * step) << "body " << b;
		EXPECT_NEAR(blocked.velocities[b].y, reference.velocities[b].y, 1e-6 * gravity * step) << "body " << b;
	}
}

TEST(Blocks, ReferenceSweepsTheSameContactsByTheSameFormulas)
{
	// One sweep in the order of the blocks: whole colours are independent, so order inside them does not matter, and the first sweeps differ by
	// the contacts that share a block with another colour only. Many plain sweeps lead both to one and the same residual.
	Problem        blocked = mixedLattice(), reference = blocked;
	SolverSettings s;
	s.method        = Method::GaussSeidel;
	s.maxIterations = 200;
	s.tolerance     = 1e-12;
	const auto x    = solve(blocked, s);
	s.reference     = true;
	const auto y    = solve(reference, s);
	EXPECT_EQ(x.iterations, y.iterations);
	EXPECT_NEAR(y.residual.relative() / x.residual.relative(), 1, 0.1);
}

TEST(Blocks, ReportedResidualIsTheIndependentOne)
{
	Problem        p = mixedLattice();
	SolverSettings s;
	s.maxIterations           = 40;
	s.tolerance               = 1e-12;
	const auto     statistics = solve(p, s);
	const Residual own = statistics.residual, independent = naturalMapResidual(p);
	// the same formula summed in another order: rounding only
	EXPECT_NEAR(own.rms / independent.rms, 1, 1e-9);
	EXPECT_NEAR(own.largest / independent.largest, 1, 1e-9);
	EXPECT_NEAR(own.scale / independent.scale, 1, 1e-9);
}

} // namespace
