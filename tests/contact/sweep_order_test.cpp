// Strips let threads share a sweep without changing a bit.
#include "problems.hpp"
#include <algorithm>
#include <contact/core/strip_schedule.hpp>
#include <contact/core/sweep_order.hpp>
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

/// Four times the mass a disk has, far from all others and with no contact.
Problem withStray(Problem p, double x, double y)
{
	p.inverseMass.push_back({ 1e-4, 1e-4, 1e-4 });
	p.freeVelocity.emplace_back();
	p.positions.push_back({ x, y });
	return p;
}

Classification classified(const Problem& p, int threads = 1)
{
	Classification result;
	classify(p, threads, true, result);
	return result;
}

SweepOrder arranged(const Problem& p, int threads = 1)
{
	SweepOrder result;
	EXPECT_FALSE(arrange(coordinatesOf(p), classified(p, threads), threads, result)); // nothing stood there
	return result;
}

std::vector<std::uint8_t> coloursOf(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverse)
{
	std::vector<std::uint8_t>  colours;
	std::vector<std::uint64_t> used;
	Problem                    p;
	p.contacts    = contacts;
	p.inverseMass = inverse;
	p.freeVelocity.resize(inverse.size());
	p.impulses.resize(contacts.size());
	colour(classified(p).pairs, inverse.size(), colours, used);
	return colours;
}

/// Contacts of each strip, places as they are swept.
std::vector<std::size_t> sizesOf(const SweepOrder& sweep)
{
	std::vector<std::size_t> sizes;
	for (std::size_t s = 0; s < sweep.stripCount(); ++s)
		sizes.push_back(sweep.partBegin[s + 1] - sweep.partBegin[s]);
	return sizes;
}

std::size_t leftOver(const SweepOrder& sweep) { return sweep.order.size() - sweep.partBegin[sweep.stripCount()]; }

/// Each contact once, and no movable body in two strips that are swept at the same time.
void expectSound(const SweepOrder& sweep, const Problem& p)
{
	ASSERT_EQ(sweep.order.size(), p.contactCount());
	ASSERT_EQ(sweep.partBegin.front(), 0u);
	ASSERT_EQ(sweep.partBegin.back(), p.contactCount());
	ASSERT_TRUE(std::is_sorted(sweep.partBegin.begin(), sweep.partBegin.end()));
	ASSERT_EQ(sweep.evenStrips, (sweep.stripCount() + 1) / 2);
	auto order = sweep.order;
	std::sort(order.begin(), order.end());
	for (std::size_t k = 0; k < order.size(); ++k)
		ASSERT_EQ(order[k], static_cast<std::int32_t>(k));
	ASSERT_EQ(sweep.bodies.size(), p.bodyCount());
	ASSERT_EQ(sweep.bodyBegin.size(), sweep.stripCount() + 1);
	ASSERT_EQ(
	        long(sweep.bodyBegin.back()),
	        std::count_if(p.inverseMass.begin(), p.inverseMass.end(), [](const InverseMass& m) {
		        return !m.isFixed();
	        }));
	std::vector<std::size_t> place(p.bodyCount(), p.bodyCount());
	for (std::size_t k = 0; k < sweep.bodies.size(); ++k)
		place[sweep.bodies[k]] = k;
	ASSERT_EQ(std::count(place.begin(), place.end(), p.bodyCount()), 0);
	for (const bool even : { true, false }) {
		std::vector<long> owner(p.bodyCount(), -1);
		for (std::size_t s = even ? 0 : sweep.evenStrips; s < (even ? sweep.evenStrips : sweep.stripCount());
		     ++s)
			for (std::size_t k = sweep.partBegin[s]; k < sweep.partBegin[s + 1]; ++k) {
				const Contact& c = p.contacts[sweep.order[k]];
				for (const int body : { c.i, c.j }) {
					if (p.inverseMass[body].isFixed()) continue;
					ASSERT_TRUE(owner[body] < 0 || owner[body] == static_cast<long>(s))
					        << "body " << body << " in two strips";
					owner[body] = static_cast<long>(s);
					// a strip of the first half extrapolates its own bodies and those of the next one, the second half finds that done
					const std::size_t number = even ? 2 * s : 2 * (s - sweep.evenStrips) + 1,
					                  end    = std::min(number + 2, sweep.stripCount());
					ASSERT_GE(place[body], sweep.bodyBegin[number]);
					ASSERT_LT(place[body], sweep.bodyBegin[end]);
				}
			}
	}
}

TEST(SweepOrder, StripsOfOneHalfShareNoMovableBody)
{
	const Problem wide = lattice(60, 20).problem, high = lattice(20, 60).problem, crowd = crowded(),
	              platen = underPlaten(95, 95), stray = withStray(wide, 1e9, 3);
	for (const auto& [p, strips] :
	     { std::pair { &wide, 6u }, { &high, 6u }, { &crowd, 6u }, { &platen, 31u }, { &stray, 6u } }) {
		const SweepOrder sweep = arranged(*p);
		expectSound(sweep, *p);
		EXPECT_EQ(sweep.stripCount(), strips);
	}
}

// nothing is left over, so that several sweeps can be made at once, and strips hold about what is wanted, 512 contacts
TEST(SweepOrder, OrdinaryPackingsAreCutEvenlyAndLeaveNothingOver)
{
	const Problem even  = lattice(200, 60).problem;
	Problem       mixed = even; // contacts up to 1.8 times as long as there
	for (std::size_t k = 0; k < 200 * 60; k += 3)
		mixed.positions[k].x += k % 2 ? 0.4 : -0.4;
	for (const Problem* p : std::initializer_list<const Problem*> { &even, &mixed }) {
		const SweepOrder sweep = arranged(*p);
		expectSound(sweep, *p);
		EXPECT_EQ(leftOver(sweep), 0u);
		const auto   sizes = sizesOf(sweep);
		const double mean  = double(p->contactCount()) / double(sizes.size());
		EXPECT_NEAR(mean, 512, 26); // one strip more or less would make 7
		EXPECT_LT(
		        double(*std::max_element(sizes.begin(), sizes.end())),
		        1.5 * mean); // a column of the lattice has 180
		EXPECT_GT(double(*std::min_element(sizes.begin(), sizes.end())), 0.5 * mean);
	}
}

// a heap: thick in the middle, thin at its ends
TEST(SweepOrder, StripsAreNarrowWhereAPackingIsThick)
{
	const Problem block = lattice(300, 100).problem;
	Problem       heap  = block;
	heap.contacts.clear();
	heap.impulses.clear();
	for (const Contact& c : block.contacts) {
		const Point& x = block.positions[c.i < 300 * 100 ? c.i : c.j];
		if (x.y > 87 - 0.58 * std::abs(x.x - 150)) continue;
		heap.contacts.push_back(c);
		heap.impulses.emplace_back();
	}
	const SweepOrder sweep = arranged(heap);
	expectSound(sweep, heap);
	EXPECT_EQ(leftOver(sweep), 0u);
	const auto sizes = sizesOf(sweep);
	EXPECT_EQ(sizes.size(), 88u); // of 87 wanted
	// in the middle a column of the lattice has 300 contacts and so a strip of whole ones up to 600; strips of one width had 3 in the corners and 880 here
	EXPECT_EQ(*std::max_element(sizes.begin(), sizes.end()), 616u);
	EXPECT_EQ(*std::min_element(sizes.begin(), sizes.end()), 407u);
}

TEST(SweepOrder, AWidePlatenLeavesItsFarContactsOver)
{
	const Problem    p     = underPlaten(95, 95);
	const SweepOrder sweep = arranged(p);
	expectSound(sweep, p);
	EXPECT_EQ(sweep.stripCount(), 31u); // of 52 that 26,900 contacts would make
	const int platen = 95 * 95 + 1; // the floor comes before
	EXPECT_EQ(leftOver(sweep), 86u); // of 95; the nearest ones fit into strips
	for (std::size_t k = sweep.partBegin[sweep.stripCount()]; k < sweep.order.size(); ++k)
		EXPECT_EQ(p.contacts[sweep.order[k]].i, platen);
}

// what two threads gain at best: wall time is the benchmark's to measure
TEST(SweepOrder, TwoThreadsShareTheWorkUnderAPlaten)
{
	for (const Problem& p : { underPlaten(95, 95), withStray(lattice(95, 95).problem, 1e6, 0) }) {
		const SweepOrder sweep = arranged(p);
		StripSchedule    schedule;
		schedule.plan(sweep.partBegin, sweep.evenStrips, 2);
		ASSERT_EQ(schedule.workerCount(), 2);
		std::size_t of[2] = { 0, 0 };
		for (const int worker : { 0, 1 })
			schedule.each(worker, [&](std::size_t part) {
				if (part < sweep.stripCount())
					of[worker] += sweep.partBegin[part + 1] - sweep.partBegin[part];
			});
		EXPECT_GT(double(p.contactCount()) / double(std::max(of[0], of[1]) + leftOver(sweep)), 1.85);
	}
}

TEST(SweepOrder, AStrayDiskChangesNoStrip)
{
	const Problem    p     = lattice(200, 60).problem;
	const SweepOrder plain = arranged(p);
	for (const auto& [x, y] : { std::pair { 1e6, 3.0 }, { -1e6, 3.0 }, { 100.0, 1e6 }, { 1e300, 1e300 } }) {
		const Problem    strayed = withStray(p, x, y);
		const SweepOrder sweep   = arranged(strayed);
		expectSound(sweep, strayed);
		// its last strips are a little wider, as the end of the packing is not where its extent ends
		EXPECT_NEAR(double(sweep.stripCount()), double(plain.stripCount()), 2) << x << ", " << y;
		const auto sizes = sizesOf(sweep);
		EXPECT_LT(*std::max_element(sizes.begin(), sizes.end()), 800u);
		EXPECT_EQ(leftOver(sweep), 0u);
	}
}

TEST(SweepOrder, ManyLongContactsMakeWideStrips)
{
	// every tenth contact spans a tenth of the packing: too many for one thread
	Problem p = lattice(200, 60).problem;
	for (std::size_t k = 0; k < p.contactCount(); k += 10)
		if (p.contacts[k].i < 60 * 200 && p.contacts[k].i % 200 < 180) p.contacts[k].j = p.contacts[k].i + 20;
	const SweepOrder sweep = arranged(p);
	expectSound(sweep, p);
	EXPECT_EQ(leftOver(sweep), 0u);
	EXPECT_EQ(sweep.stripCount(), 10u);
}

TEST(SweepOrder, PositionsThatSayNothingMakeOneStrip)
{
	Problem p = lattice(60, 20).problem;
	for (Point& x : p.positions)
		x = { 3, 4 };
	EXPECT_EQ(arranged(p).stripCount(), 1u);
	expectSound(arranged(p), p);
	for (std::size_t b = 0; b < p.bodyCount(); ++b)
		p.positions[b].x = b % 2 ? 1e308 : -1e308; // farther apart than numbers go
	expectSound(arranged(p), p);
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
	EXPECT_EQ(most, 5); // six neighbours on the lattice; greedy: at most 2·6 − 1 colours
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
	for (const Problem& p : { lattice(60, 20).problem, underPlaten(95, 95) }) {
		const SweepOrder one = arranged(p);
		for (const int threads : { 1, 2, 3, 4 }) {
			const SweepOrder other = arranged(p, threads);
			EXPECT_EQ(one.order, other.order);
			EXPECT_EQ(one.bodies, other.bodies);
			EXPECT_EQ(one.partBegin, other.partBegin);
		}
	}
}

TEST(Threads, SameBitsForOneToFour)
{
	const struct {
		Problem problem;
		int     strips;
	} cases[] = { { lattice(60, 20).problem, 6 },
		      { crowded(), 6 },
		      { underPlaten(60, 40), 8 },
		      { withStray(lattice(60, 20).problem, 1e6, 0), 6 } };
	for (const Method method : { Method::GaussSeidel, Method::Accelerated })
		for (const auto& [problem, strips] : cases)
			for (const StoppingTest test : { StoppingTest::NaturalMap, StoppingTest::QM16 }) {
				SolverSettings s;
				s.method        = method;
				s.stopping      = test;
				s.tolerance     = 1e-9;
				s.maxIterations = 30;
				std::vector<Problem>          solved;
				std::vector<SolverStatistics> statistics;
				for (const int threads : { 1, 2, 3, 4 }) {
					s.threads = threads;
					solved.push_back(problem);
					statistics.push_back(solve(solved.back(), s));
					EXPECT_EQ(statistics.back().strips, strips);
					EXPECT_EQ(statistics.back().iterations, statistics[0].iterations);
					EXPECT_EQ(statistics.back().residual.rms, statistics[0].residual.rms);
					EXPECT_EQ(statistics.back().changes.work, statistics[0].changes.work);
					EXPECT_TRUE(sameBits(solved.back().impulses, solved[0].impulses));
					EXPECT_TRUE(sameBits(solved.back().velocities, solved[0].velocities));
				}
			}
}

// what is left over is swept as all else: the platen ends where it must, and the residual is that of all contacts
TEST(Threads, APlatensSolutionIsOne)
{
	Problem        p = underPlaten(95, 95);
	SolverSettings s;
	s.tolerance           = 1e-6;
	s.maxIterations       = 20000;
	s.threads             = 2;
	const auto statistics = solve(p, s);
	EXPECT_TRUE(statistics.converged);
	const Residual independent = naturalMapResidual(p);
	EXPECT_LE(independent.relative(), 1e-6 * (1 + 1e-6));
	EXPECT_NEAR(independent.rms / statistics.residual.rms, 1, 1e-9); // the same sum in another order
	double carried = 0;
	for (std::size_t k = 0; k < p.contactCount(); ++k)
		if (p.contacts[k].i == 95 * 95 + 1) carried += p.impulses[k].n;
	// what 2 m of rock, 95 m wide, do not fall freely: some hundred roundings
	const double mass = 2 * 2500 * 95;
	EXPECT_GT(carried, 0.01 * mass * gravity * step);
	EXPECT_NEAR(carried / (mass * (gravity * step + p.velocities.back().y)), 1, 1e-11);
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
		EXPECT_EQ(statistics.back().strips, 233);
		EXPECT_EQ(statistics.back().residual.rms, statistics[0].residual.rms) << threads;
		EXPECT_TRUE(sameBits(solved.back().impulses, solved[0].impulses)) << threads;
		EXPECT_TRUE(sameBits(solved.back().velocities, solved[0].velocities)) << threads;
	}
}

} // namespace
