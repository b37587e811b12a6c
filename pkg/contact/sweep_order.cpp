#include <algorithm>
#include <contact/sweep_order.hpp>
#include <cstdlib>

namespace nonsmooth::contact {

namespace {

	constexpr int colourCount = 64;

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

	/// The order of bodies that follows from their strips.
	void sortBodies(SweepOrder& result)
	{
		const StripCut& cut    = result.scratch.cut;
		const auto&     strips = cut.stripOfBody;
		auto&           next   = result.scratch.next;
		result.bodyBegin.assign(cut.count + 1, 0);
		for (const std::int32_t strip : strips)
			if (strip >= 0) ++result.bodyBegin[strip + 1];
		for (std::int32_t s = 0; s < cut.count; ++s)
			result.bodyBegin[s + 1] += result.bodyBegin[s];
		next.assign(result.bodyBegin.begin(), result.bodyBegin.end());
		result.bodies.resize(strips.size());
		for (std::size_t b = 0; b < strips.size(); ++b)
			result.bodies[next[strips[b] >= 0 ? strips[b] : cut.count]++] = static_cast<std::int32_t>(b);
	}

	/// Counting sort by (place of the strip, colour); stable, so the contacts' own order decides the rest.
	void sortContacts(int threads, SweepOrder& result)
	{
		auto&              scratch  = result.scratch;
		auto&              bucketOf = scratch.bucketOf;
		auto&              next     = scratch.next;
		const std::int32_t strips = scratch.cut.count, even = (strips + 1) / 2;
		const auto         stripAt = [&scratch](std::int32_t b) { return b == MovablePair::none ? -1 : scratch.cut.stripOfBody[b]; };
		const long         count   = static_cast<long>(result.pairs.size());
		bucketOf.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k) {
			const std::int32_t i = stripAt(result.pairs[k].i), j = stripAt(result.pairs[k].j);
			const std::int32_t strip = i < 0 ? std::max(j, 0) : (j < 0 ? i : std::min(i, j));
			const bool         far   = i >= 0 && j >= 0 && std::abs(i - j) > 1;
			const std::int32_t part  = far ? strips : (strip % 2 == 0 ? strip / 2 : even + strip / 2);
			bucketOf[k]              = part * colourCount + scratch.colours[k];
		}
		next.assign(colourCount * (strips + 1) + 1, 0);
		for (const std::int32_t bucket : bucketOf)
			++next[bucket + 1];
		for (std::size_t k = 1; k < next.size(); ++k)
			next[k] += next[k - 1];
		result.evenStrips = even;
		result.partBegin.clear();
		for (std::int32_t s = 0; s <= strips + 1; ++s)
			result.partBegin.push_back(next[s * colourCount]);
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
	cutIntoStrips(problem, result.pairs, threads, result.scratch.cut);
	// each of the two goes from one contact or body to the next, but they do not need each other
#pragma omp parallel sections num_threads(threads)
	{
#pragma omp section
		colour(result.pairs, problem.bodyCount(), result.scratch.colours, result.scratch.used);
#pragma omp section
		sortBodies(result);
	}
	sortContacts(threads, result);
}

} // namespace nonsmooth::contact
