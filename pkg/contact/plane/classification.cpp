#include <algorithm>
#include <contact/core/classification.tpp>
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

} // namespace

void classify(const Problem& problem, int threads, bool blocks, Classification& result)
{
	checkSizes(problem);
	classifyBodies(problem, threads, result);
	classifyContacts(
	        problem, threads, blocks, result, [](const auto&... all) { return isSimple(all...); },
	        [](const auto&... all) { return isMassJump(all...); },
	        [](const Point& a, const Point& b) {
		        return std::array<double, 3> { a.x - b.x, a.y - b.y, 0 };
	        });
}

} // namespace nonsmooth::contact
