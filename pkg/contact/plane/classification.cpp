#include <algorithm>
#include <contact/plane/mass_jumps.hpp>
#include <contact/plane/problem_check.hpp>
#include <contact/plane/classification.hpp>

namespace nonsmooth::contact {
namespace {

	std::uint8_t traitsOf(const InverseMass& m, const Twist& freeVelocity)
	{
		// a wall that turns enters the velocities through levers too
		const bool isPlain = m.x == m.y && (m.w != 0 || freeVelocity.w == 0);
		return (m.w != 0 ? Classification::turns : 0) | (isPlain ? Classification::plain : 0)
		        | (m.isFixed() ? 0 : Classification::moves);
	}

	/// Whether the short formulas of the blocks hold: no rows coupled but T and Γ, no bias but the normal one.
	bool isSimple(const Contact& c, std::uint8_t i, std::uint8_t j)
	{
		return (i & j & Classification::plain) && c.biasT == 0 && c.biasR == 0
		        && (!(i & Classification::turns) || c.leverNi == 0)
		        && (!(j & Classification::turns) || c.leverNj == 0);
	}

	/// Traits of bodies and where they are. Refuses what cannot be used.
	void classifyBodies(const Problem& problem, int threads, Classification& result)
	{
		const long count     = static_cast<long>(problem.bodyCount());
		const bool hasPlaces = !problem.positions.empty();
		double     lowX = HUGE_VAL, lowY = HUGE_VAL, highX = -HUGE_VAL, highY = -HUGE_VAL, most = 0,
		       lightness = HUGE_VAL, lightest = 0, heaviest = HUGE_VAL; // the last one as an inverse mass
		// plates of presses and boxes, which go along one line, are heavy by their driving and not beside their
		// neighbours
		const bool counted = problem.bodyCount() <= fewBodies;
		long       bad = count, astray = count; // the first ones, found by threads, which must not throw
		result.traits.resize(count);
// clang-format off
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : lowX, lowY, lightness, heaviest, bad, astray) reduction(max : highX, highY, most, lightest)
		// clang-format on
		for (long b = 0; b < count; ++b) {
			const InverseMass& m = problem.inverseMass[b];
			const Twist&       v = problem.freeVelocity[b];
			if (!usable(m, v)) bad = std::min(bad, b);
			result.traits[b] = traitsOf(m, v);
			most             = std::max({ most, std::abs(v.x), std::abs(v.y) });
			lightest         = std::max({ lightest, m.x, m.y });
			lightness        = std::min({ lightness, m.x > 0 ? m.x : HUGE_VAL, m.y > 0 ? m.y : HUGE_VAL });
			if (counted || (m.x > 0 && m.y > 0))
				heaviest = std::min({ heaviest, m.x > 0 ? m.x : HUGE_VAL, m.y > 0 ? m.y : HUGE_VAL });
			if (!hasPlaces) continue;
			const Point& x = problem.positions[b];
			if (!usable(x)) astray = std::min(astray, b);
			if (m.isFixed()) continue;
			lowX  = std::min(lowX, x.x);
			lowY  = std::min(lowY, x.y);
			highX = std::max(highX, x.x);
			highY = std::max(highY, x.y);
		}
		if (bad < count) refuseBody(problem, bad);
		if (astray < count) refusePosition(problem, astray);
		result.fastest    = most;
		result.lightness  = lightness;
		result.uneven     = lightest >= jumpOf(problem) * heaviest;
		result.extents[0] = { lowX, highX };
		result.extents[1] = { lowY, highY };
	}

	/// Pairs of contacts, how long they are, and whether they fit into blocks. Refuses what cannot be used.
	void classifyContacts(const Problem& problem, int threads, bool blocks, Classification& result)
	{
		const long   count     = static_cast<long>(problem.contactCount());
		const auto   bodies    = static_cast<std::int32_t>(problem.bodyCount());
		const Point* positions = problem.positions.empty() ? nullptr : problem.positions.data();
		double       longestX = 0, longestY = 0;
		long         bad  = count;
		const double jump = jumpOf(problem);
		bool newPairs = result.pairs.size() != problem.contactCount(), newSimple = newPairs, jumps = false,
		     plays = false;
		result.pairs.resize(count);
		result.simple.resize(count);
// clang-format off
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad) reduction(max : longestX, longestY) reduction(|| : newPairs, newSimple, jumps, plays)
		// clang-format on
		for (long k = 0; k < count; ++k) {
			const Contact& c = problem.contacts[k];
			if (!usable(c, problem.impulses[k], bodies)) {
				bad = std::min(bad, k);
				continue;
			}
			const std::uint8_t i = result.traits[c.i], j = result.traits[c.j];
			const MovablePair  pair { i & Classification::moves ? c.i : ~c.i,
                                                 j & Classification::moves ? c.j : ~c.j };
			MovablePair& before     = result.pairs[k];
			newPairs                = newPairs || pair.i != before.i || pair.j != before.j;
			before                  = pair;
			const std::uint8_t fits = blocks && isSimple(c, i, j);
			newSimple               = newSimple || fits != result.simple[k];
			plays                   = plays || c.play > 0;
			result.simple[k]        = fits;
			jumps = jumps || isMassJump(problem.inverseMass[c.i], problem.inverseMass[c.j], jump);
			if (!positions || !(i & j & Classification::moves)) continue;
			longestX = std::max(longestX, std::abs(positions[c.i].x - positions[c.j].x));
			longestY = std::max(longestY, std::abs(positions[c.i].y - positions[c.j].y));
		}
		if (bad < count) refuseContact(problem, bad);
		result.longest[0] = longestX;
		result.longest[1] = longestY;
		result.jumps      = jumps;
		result.plays      = plays;
		result.pairsKept  = !newPairs;
		result.simpleKept = !newSimple;
	}

} // namespace

void classify(const Problem& problem, int threads, bool blocks, Classification& result)
{
	checkSizes(problem);
	classifyBodies(problem, threads, result);
	classifyContacts(problem, threads, blocks, result);
}

} // namespace nonsmooth::contact
