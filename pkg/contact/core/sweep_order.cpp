#include <algorithm>
#include <contact/core/sweep_order.hpp>
#include <cstdlib>
#include <omp.h>
#include <utility>

namespace nonsmooth::contact {

namespace {

	constexpr int colourCount = 64;

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

	/// Sorts contacts by their parts; stable, so the contacts' own order decides the rest. Threads take shares of
	/// them that do not depend on what they find.
	void sortIntoParts(const Classification& classification, int threads, SweepOrder& result)
	{
		auto&              scratch = result.scratch;
		auto&              partOf  = scratch.partOf;
		const std::int32_t strips = scratch.cut.count, even = (strips + 1) / 2;
		const auto         stripAt = [&scratch](std::int32_t b) {
                        return MovablePair::moves(b) ? scratch.cut.stripOfBody[b] : -1;
		};
		const long count = static_cast<long>(classification.pairs.size());
		partOf.resize(count);
		result.order.resize(count);
		result.evenStrips = even;
		result.partBegin.resize(strips + 2);
		scratch.counts.resize(std::max<std::size_t>(scratch.counts.size(), threads));
#pragma omp parallel num_threads(threads)
		{
			const int  thread = omp_get_thread_num(), all = omp_get_num_threads();
			const long begin = count * thread / all, end = count * (thread + 1) / all;
			auto&      next = scratch.counts[thread];
			next.assign(strips + 1, 0);
			for (long k = begin; k < end; ++k) {
				const std::int32_t i     = stripAt(classification.pairs[k].i),
				                   j     = stripAt(classification.pairs[k].j);
				const std::int32_t strip = i < 0 ? std::max(j, 0) : (j < 0 ? i : std::min(i, j));
				const bool         far   = i >= 0 && j >= 0 && std::abs(i - j) > 1;
				partOf[k] = far ? strips : (strip % 2 == 0 ? strip / 2 : even + strip / 2);
				++next[partOf[k]];
			}
#pragma omp barrier
#pragma omp          single
                        {
                                std::size_t place = 0;
                                for (std::int32_t s = 0; s <= strips; ++s) {
					         result.partBegin[s] = place;
					         for (int t = 0; t < all; ++t)
                                                place += std::exchange(scratch.counts[t][s], place);
                                }
				         result.partBegin[strips + 1] = place;
                        }
                        for (long k = begin; k < end; ++k)
                                result.order[next[partOf[k]]++] = static_cast<std::int32_t>(k);
		}
	}

	/// Counting sort of one part's contacts by colour; stable.
	void sortByColour(
	        std::int32_t* begin, std::int32_t* end, const std::vector<std::uint8_t>& colours,
	        std::vector<std::int32_t>& unsorted)
	{
		std::size_t next[colourCount + 1] = {};
		unsorted.assign(begin, end);
		for (const std::int32_t k : unsorted)
			++next[colours[k] + 1];
		for (int c = 1; c < colourCount; ++c)
			next[c] += next[c - 1];
		for (const std::int32_t k : unsorted)
			begin[next[colours[k]]++] = k;
	}

} // namespace

void colour(
        const std::vector<MovablePair>& pairs, std::size_t bodyCount, std::vector<std::uint8_t>& colours,
        std::vector<std::uint64_t>& used)
{
	constexpr int last = colourCount - 1;
	used.assign(bodyCount, 0);
	colours.resize(pairs.size());
	for (std::size_t k = 0; k < pairs.size(); ++k) {
		const auto [i, j] = pairs[k];
		const auto taken  = (MovablePair::moves(i) ? used[i] : 0) | (MovablePair::moves(j) ? used[j] : 0);
		const int  best   = ~taken == 0 ? last : __builtin_ctzll(~taken);
		const auto bit    = std::uint64_t(1) << best;
		if (MovablePair::moves(i)) used[i] |= bit;
		if (MovablePair::moves(j)) used[j] |= bit;
		colours[k] = static_cast<std::uint8_t>(best);
	}
}

bool arrange(const Coordinates& places, const Classification& classification, int threads, SweepOrder& result)
{
	auto&      scratch    = result.scratch;
	const bool sameStrips = cutIntoStrips(places, classification, threads, scratch.cut);
	if (classification.pairsKept && sameStrips && !result.partBegin.empty()) return true;
		// each of the two goes from one contact or body to the next, but they do not need each other
#pragma omp parallel sections num_threads(threads)
	{
#pragma omp section
		if (!classification.pairsKept)
			colour(classification.pairs, classification.traits.size(), scratch.colours, scratch.used);
#pragma omp section
		sortBodies(result);
	}
	sortIntoParts(classification, threads, result);
	scratch.unsorted.resize(std::max<std::size_t>(scratch.unsorted.size(), threads));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
	for (std::size_t s = 0; s < result.partCount(); ++s)
		sortByColour(
		        result.order.data() + result.partBegin[s], result.order.data() + result.partBegin[s + 1],
		        scratch.colours, scratch.unsorted[omp_get_thread_num()]);
	return false;
}

} // namespace nonsmooth::contact
