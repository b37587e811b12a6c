#include <algorithm>
#include <contact/core/classification.tpp>
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

} // namespace

void classify(const Problem& problem, int threads, bool blocks, Classification& result)
{
	checkSizes(problem);
	classifyBodies(problem, threads, result);
	classifyContacts(
	        problem, threads, blocks, result, [](const auto&... all) { return isSimple(all...); },
	        [](const auto&... all) { return isMassJump(all...); },
	        [](const Vector& a, const Vector& b) {
		        return std::array<double, 3> { a.x - b.x, a.y - b.y, a.z - b.z };
	        });
}

} // namespace nonsmooth::contact::space
