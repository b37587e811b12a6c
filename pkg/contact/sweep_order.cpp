#include <algorithm>
#include <cmath>
#include <contact/sweep_order.hpp>

namespace nonsmooth::contact {

namespace {

	constexpr std::size_t contactsAStrip = 512; // wanted: a strip's rows and bodies stay in a second-level cache
	constexpr int         colourCount    = 64;

	/// How a packing is cut into strips.
	struct Cut {
		int          axis  = 0;
		double       low   = 0, scale = 0; // strips per metre
		std::int32_t count = 1;
	};

	/// The bodies that can move, contact by contact: what the order rests on, without the numbers that come with it in memory.
	void pairUp(const Problem& problem, int threads, std::vector<MovablePair>& pairs)
	{
		pairs.resize(problem.contactCount());
		const auto movable = [&](std::int32_t b) { return problem.inverseMass[b].isFixed() ? MovablePair::none : b; };
		const long count   = static_cast<long>(pairs.size());
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k)
			pairs[k] = { movable(problem.contacts[k].i), movable(problem.contacts[k].j) };
	}

	Cut cutOf(const Problem& problem, int threads, const std::vector<MovablePair>& pairs)
	{
		if (problem.positions.size() != problem.bodyCount() || pairs.size() < 2 * contactsAStrip) return {};
		double     lowX = HUGE_VAL, lowY = HUGE_VAL, highX = -HUGE_VAL, highY = -HUGE_VAL, longestX = 0, longestY = 0;
		const long bodyCount = static_cast<long>(problem.bodyCount()), contactCount = static_cast<long>(pairs.size());
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : lowX, lowY) reduction(max : highX, highY)
		for (long b = 0; b < bodyCount; ++b) {
			if (problem.inverseMass[b].isFixed()) continue;
			const Point& x = problem.positions[b];
			lowX           = std::min(lowX, x.x);
			lowY           = std::min(lowY, x.y);
			highX          = std::max(highX, x.x);
			highY          = std::max(highY, x.y);
		}
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : longestX, longestY)
		for (long k = 0; k < contactCount; ++k) {
			if (pairs[k].i == MovablePair::none || pairs[k].j == MovablePair::none) continue;
			const Point &a = problem.positions[pairs[k].i], &b = problem.positions[pairs[k].j];
			longestX = std::max(longestX, std::abs(a.x - b.x));
			longestY = std::max(longestY, std::abs(a.y - b.y));
		}
		const int    axis   = highX - lowX >= highY - lowY ? 0 : 1;
		const double low    = axis == 0 ? lowX : lowY, extent = axis == 0 ? highX - lowX : highY - lowY, longest = axis == 0 ? longestX : longestY;
		if (!(extent > 0)) return {};
		const double most = std::min(double(pairs.size() / contactsAStrip), std::floor(extent / (longest * 1.000001 + 1e-300)));
		if (!(most >= 2)) return {};
		return { axis, low, std::floor(most) / extent, static_cast<std::int32_t>(most) };
	}

	/// Strip of every body, -1 for those that can't move, and the order of the bodies that follows.
	void sortBodies(const Problem& problem, const Cut& cut, SweepOrder& result)
	{
		auto& strips = result.scratch.stripOfBody;
		auto& next   = result.scratch.next;
		strips.resize(problem.bodyCount());
		result.bodyBegin.assign(cut.count + 1, 0);
		for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
			strips[b] = -1;
			if (problem.inverseMass[b].isFixed()) continue;
			strips[b] = 0;
			if (cut.count > 1) {
				const Point& x = problem.positions[b];
				strips[b]      = std::min(cut.count - 1, static_cast<std::int32_t>(((cut.axis == 0 ? x.x : x.y) - cut.low) * cut.scale));
			}
			++result.bodyBegin[strips[b] + 1];
		}
		for (std::int32_t s = 0; s < cut.count; ++s)
			result.bodyBegin[s + 1] += result.bodyBegin[s];
		next.assign(result.bodyBegin.begin(), result.bodyBegin.end());
		result.bodies.resize(problem.bodyCount());
		for (std::size_t b = 0; b < problem.bodyCount(); ++b)
			result.bodies[strips[b] >= 0 ? next[strips[b]]++ : next[cut.count]++] = static_cast<std::int32_t>(b);
	}

	/// Counting sort by (place of the strip, colour); stable, so the contacts' own order decides the rest.
	void sortContacts(std::int32_t strips, int threads, SweepOrder& result)
	{
		auto&              scratch  = result.scratch;
		auto&              bucketOf = scratch.bucketOf;
		auto&              next     = scratch.next;
		const std::int32_t even     = (strips + 1) / 2;
		const auto         stripAt  = [&scratch](std::int32_t b) { return b == MovablePair::none ? -1 : scratch.stripOfBody[b]; };
		const long         count    = static_cast<long>(result.pairs.size());
		bucketOf.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k) {
			const std::int32_t i = stripAt(result.pairs[k].i), j = stripAt(result.pairs[k].j);
			const std::int32_t strip = i < 0 ? std::max(j, 0) : (j < 0 ? i : std::min(i, j));
			bucketOf[k]              = (strip % 2 == 0 ? strip / 2 : even + strip / 2) * colourCount + scratch.colours[k];
		}
		next.assign(colourCount * strips + 1, 0);
		for (const std::int32_t bucket : bucketOf)
			++next[bucket + 1];
		for (std::size_t k = 1; k < next.size(); ++k)
			next[k] += next[k - 1];
		result.evenStrips = even;
		result.stripBegin.clear();
		for (std::int32_t s = 0; s <= strips; ++s)
			result.stripBegin.push_back(next[s * colourCount]);
		result.order.resize(count);
		for (long k = 0; k < count; ++k)
			result.order[next[bucketOf[k]]++] = static_cast<std::int32_t>(k);
	}

} // namespace

void colour(const std::vector<MovablePair>& pairs, std::size_t bodyCount, std::vector<std::uint8_t>& colours, std::vector<std::uint64_t>& used)
{
	constexpr int last = colourCount - 1;
	used.assign(bodyCount, 0);
	colours.resize(pairs.size());
	for (std::size_t k = 0; k < pairs.size(); ++k) {
		const auto [i, j] = pairs[k];
		const auto taken  = (i != MovablePair::none ? used[i] : 0) | (j != MovablePair::none ? used[j] : 0);
		const int  best   = ~taken == 0 ? last : __builtin_ctzll(~taken);
		const auto bit    = std::uint64_t(1) << best;
		if (i != MovablePair::none) used[i] |= bit;
		if (j != MovablePair::none) used[j] |= bit;
		colours[k] = static_cast<std::uint8_t>(best);
	}
}

void arrange(const Problem& problem, int threads, SweepOrder& result)
{
	pairUp(problem, threads, result.pairs);
	const Cut cut = cutOf(problem, threads, result.pairs);
	// each of the two goes from one contact or body to the next, but they do not need each other
#pragma omp parallel sections num_threads(threads)
	{
#pragma omp section
		colour(result.pairs, problem.bodyCount(), result.scratch.colours, result.scratch.used);
#pragma omp section
		sortBodies(problem, cut, result);
	}
	sortContacts(cut.count, threads, result);
}

} // namespace nonsmooth::contact
