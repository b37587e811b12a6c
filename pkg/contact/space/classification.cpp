#include <algorithm>
#include <contact/core/mass_ratio.hpp>
#include <contact/space/problem_check.hpp>
#include <contact/space/classification.hpp>

namespace nonsmooth::contact::space {
namespace {

	std::uint8_t traitsOf(const InverseMass& m)
	{
		return (m.inertia.isZero() ? 0 : Classification::turns) | (m.isBall() ? Classification::plain : 0)
		        | (m.isFixed() ? 0 : Classification::moves);
	}

	/// Whether the short formulas of the blocks hold: what turns has its arm along n.
	bool isSimple(const Contact& c, std::uint8_t i, std::uint8_t j)
	{
		return (i & j & Classification::plain) && (!(i & Classification::turns) || isZero(c.asideI))
		        && (!(j & Classification::turns) || isZero(c.asideJ));
	}

	bool isMassJump(const InverseMass& i, const InverseMass& j, double jump)
	{
		const double a = i.x + i.y + i.z, b = j.x + j.y + j.z;
		return a > 0 && b > 0 && (a >= jump * b || b >= jump * a);
	}

	double largest(const Vector& a) { return std::max({ std::abs(a.x), std::abs(a.y), std::abs(a.z) }); }
	double most(const InverseMass& m) { return std::max({ m.x, m.y, m.z }); }
	/// The least that is not 0.
	double least(const InverseMass& m)
	{
		const auto one = [](double x) { return x > 0 ? x : HUGE_VAL; };
		return std::min({ one(m.x), one(m.y), one(m.z) });
	}

	/// Traits of bodies and where they are. Refuses what cannot be used.
	void classifyBodies(const Problem& problem, int threads, Classification& result)
	{
		const long count     = static_cast<long>(problem.bodyCount());
		const bool hasPlaces = !problem.positions.empty(), counted = problem.bodyCount() <= fewBodies;
		double     lowX = HUGE_VAL, lowY = HUGE_VAL, lowZ = HUGE_VAL, highX = -HUGE_VAL, highY = -HUGE_VAL,
		       highZ = -HUGE_VAL, fast = 0, lightness = HUGE_VAL, lightest = 0, heaviest = HUGE_VAL;
		long bad = count, astray = count; // the first ones, found by threads, which must not throw
		result.traits.resize(count);
// clang-format off
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : lowX, lowY, lowZ, lightness, heaviest, bad, astray) reduction(max : highX, highY, highZ, fast, lightest)
		// clang-format on
		for (long b = 0; b < count; ++b) {
			const InverseMass& m = problem.inverseMass[b];
			const Twist&       v = problem.freeVelocity[b];
			if (!usable(m, v)) bad = std::min(bad, b);
			result.traits[b] = traitsOf(m);
			fast             = std::max(fast, largest(v.v));
			lightest         = std::max(lightest, most(m));
			lightness        = std::min(lightness, least(m));
			// plates, which go along one line, are heavy by their driving and not beside their neighbours
			if (counted || (m.x > 0 && m.y > 0 && m.z > 0)) heaviest = std::min(heaviest, least(m));
			if (!hasPlaces) continue;
			const Vector& x = problem.positions[b];
			if (!usable(x)) astray = std::min(astray, b);
			if (m.isFixed()) continue;
			lowX  = std::min(lowX, x.x);
			lowY  = std::min(lowY, x.y);
			lowZ  = std::min(lowZ, x.z);
			highX = std::max(highX, x.x);
			highY = std::max(highY, x.y);
			highZ = std::max(highZ, x.z);
		}
		if (bad < count) refuseBody(problem, bad);
		if (astray < count) refusePosition(problem, astray);
		result.fastest    = fast;
		result.lightness  = lightness;
		result.uneven     = lightest >= jumpOf(problem) * heaviest;
		result.extents[0] = { lowX, highX };
		result.extents[1] = { lowY, highY };
		result.extents[2] = { lowZ, highZ };
	}

	/// Pairs of contacts, how long they are, and whether they fit into blocks. Refuses what cannot be used.
	void classifyContacts(const Problem& problem, int threads, bool blocks, Classification& result)
	{
		const long    count     = static_cast<long>(problem.contactCount());
		const auto    bodies    = static_cast<std::int32_t>(problem.bodyCount());
		const Vector* positions = problem.positions.empty() ? nullptr : problem.positions.data();
		double        longestX = 0, longestY = 0, longestZ = 0;
		long          bad  = count;
		const double  jump = jumpOf(problem);
		bool newPairs = result.pairs.size() != problem.contactCount(), newSimple = newPairs, jumps = false,
		     plays = false;
		result.pairs.resize(count);
		result.simple.resize(count);
// clang-format off
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad) reduction(max : longestX, longestY, longestZ) reduction(|| : newPairs, newSimple, jumps, plays)
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
			const Vector d = positions[c.i] - positions[c.j];
			longestX       = std::max(longestX, std::abs(d.x));
			longestY       = std::max(longestY, std::abs(d.y));
			longestZ       = std::max(longestZ, std::abs(d.z));
		}
		if (bad < count) refuseContact(problem, bad);
		result.longest[0] = longestX;
		result.longest[1] = longestY;
		result.longest[2] = longestZ;
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

} // namespace nonsmooth::contact::space
