// The functions of contact_blocks.hpp, for the dimension that includes them (contact_blocks.cpp, space/solver.cpp).
#pragma once

#include <algorithm>
#include <contact/core/contact_blocks.hpp>
#include <utility>

namespace nonsmooth::contact {
namespace layout {

	/// Half a block that is still being filled, and the bodies in it that can move.
	struct Open {
		static constexpr std::int32_t nobody = -1,
		                              other
		        = -2; // in place of the others: in the half, and in a contact that may join it
		using Ids = std::int32_t __attribute__((vector_size(16)));

		std::size_t half;
		int         filled = 0;
		Ids         first { nobody, nobody, nobody, nobody }, second { nobody, nobody, nobody, nobody };

		bool has(const MovablePair& pair) const
		{
			const auto i     = MovablePair::moves(pair.i) ? pair.i : other,
			           j     = MovablePair::moves(pair.j) ? pair.j : other;
			const Ids shared = (first == i) | (second == i) | (first == j) | (second == j);
			return shared[0] | shared[1] | shared[2] | shared[3];
		}
		void take(const MovablePair& pair)
		{
			first[filled]  = MovablePair::moves(pair.i) ? pair.i : nobody;
			second[filled] = MovablePair::moves(pair.j) ? pair.j : nobody;
			++filled;
		}
	};

	/// Fills halves of blocks in the order of the contacts, which is one of colours: whole colours give full ones,
	/// their rests share some.
	template <class Dimension>
	void distribute(
	        const ContactBlocksIn<Dimension>& all, std::size_t part,
	        typename ContactBlocksIn<Dimension>::Part& result)
	{
		constexpr std::size_t mostOpen = 16;
		result.contactOf.clear();
		result.others.clear();
		Open        open[mostOpen];
		std::size_t count = 0;
		const auto  close = [&](std::size_t at) { std::copy(open + at + 1, open + count--, open + at); };
		for (std::size_t k = all.order.partBegin[part]; k < all.order.partBegin[part + 1]; ++k) {
			const std::int32_t index = all.order.order[k];
			if (!all.classification.simple[index]) {
				result.others.push_back(index);
				continue;
			}
			const MovablePair& pair = all.classification.pairs[index];
			std::size_t        at   = 0;
			while (at < count && open[at].has(pair))
				++at;
			if (at == count) {
				if (count == mostOpen) close(0);
				at       = count++;
				open[at] = Open { result.contactOf.size() / halfLanes };
				result.contactOf.resize(result.contactOf.size() + halfLanes, all.none);
			}
			Open& o                                         = open[at];
			result.contactOf[o.half * halfLanes + o.filled] = index;
			o.take(pair);
			if (o.filled == int(halfLanes)) close(at);
		}
		if (result.contactOf.size() % lanes > 0)
			result.contactOf.resize(result.contactOf.size() + halfLanes, all.none);
	}

	inline bool hasEmptyLane(const std::int32_t* contactOf)
	{
		return std::find(contactOf, contactOf + lanes, emptyLane) != contactOf + lanes;
	}

	/// Whether no body is in both halves, see Block::together.
	inline bool goTogether(const BlockBodies& block)
	{
		if ((block.movesI & block.movesJ) != (1u << lanes) - 1) return false;
		using Ids        = std::int32_t __attribute__((vector_size(16)));
		const auto idsOf = [](const std::int32_t* id) { return Ids { id[0], id[1], id[2], id[3] }; };
		const Ids  i = idsOf(block.i), j = idsOf(block.j);
		Ids        shared {};
		for (std::size_t l = halfLanes; l < lanes; ++l)
			shared |= (i == block.i[l]) | (j == block.i[l]) | (i == block.j[l]) | (j == block.j[l]);
		return !(shared[0] | shared[1] | shared[2] | shared[3]);
	}

	/// Names the bodies of a block by their places; its numbers are left alone where all its lanes will have some.
	template <class Dimension>
	void
	name(typename Dimension::template Block<double>& block, const std::int32_t* contactOf,
	     const ContactBlocksIn<Dimension>& all)
	{
		const auto nobody = static_cast<std::int32_t>(all.placeOf.size());
		if (hasEmptyLane(contactOf)) block = {};
		block.movesI = block.movesJ = 0;
		for (std::size_t l = 0; l < lanes; ++l) {
			block.i[l] = block.j[l] = nobody;
			if (contactOf[l] == all.none) continue;
			const MovablePair& pair = all.classification.pairs[contactOf[l]];
			block.i[l]              = all.placeOf[MovablePair::bodyOf(pair.i)];
			block.j[l]              = all.placeOf[MovablePair::bodyOf(pair.j)];
			block.movesI |= (MovablePair::moves(pair.i) ? 1u : 0u) << l;
			block.movesJ |= (MovablePair::moves(pair.j) ? 1u : 0u) << l;
		}
		block.together = goTogether(block);
	}

} // namespace layout

template <class Dimension>
void layOut(const typename Dimension::Problem& problem, int threads, ContactBlocksIn<Dimension>& result, bool blocks)
{
	const bool      whole = std::exchange(result.complete, false);
	Classification& seen  = result.classification;
	classify(problem, threads, blocks, seen);
	if (!whole) seen.pairsKept = seen.simpleKept = false;
	const bool sameOrder = arrange(coordinatesOf(problem), seen, threads, result.order);
	result.kept = result.complete = sameOrder && seen.simpleKept;
	if (result.kept) {
		result.inDouble.plays.resize(seen.plays ? result.inDouble.blocks.size() : 0);
		return;
	}

	const SweepOrder& order     = result.order;
	const std::size_t partCount = order.partCount();
	const long        bodyCount = static_cast<long>(problem.bodyCount());
	auto&             parts     = result.scratch;
	parts.resize(partCount);
	result.placeOf.resize(problem.bodyCount());
#pragma omp parallel num_threads(threads)
	{
#pragma omp for schedule(static) nowait
		for (long b = 0; b < bodyCount; ++b)
			result.placeOf[order.bodies[b]] = static_cast<std::int32_t>(b);
#pragma omp for schedule(dynamic, 1)
		for (long s = 0; s < static_cast<long>(partCount); ++s)
			layout::distribute<Dimension>(result, s, parts[s]);
	}

	result.blockBegin.assign(1, 0);
	result.otherBegin.assign(1, 0);
	for (const auto& part : parts) {
		result.blockBegin.push_back(result.blockBegin.back() + part.contactOf.size() / lanes);
		result.otherBegin.push_back(result.otherBegin.back() + part.others.size());
	}
	result.inDouble.blocks.resize(result.blockBegin.back());
	result.contactOf.resize(result.inDouble.blocks.size() * lanes);
	result.inDouble.inverseLength.resize(result.inDouble.blocks.size());
	result.inDouble.plays.resize(seen.plays ? result.inDouble.blocks.size() : 0);
	result.others.resize(result.otherBegin.back());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
	for (long s = 0; s < static_cast<long>(partCount); ++s) {
		const auto&       part  = parts[s];
		const std::size_t begin = result.blockBegin[s], end = result.blockBegin[s + 1];
		std::copy(part.others.begin(), part.others.end(), result.others.begin() + result.otherBegin[s]);
		std::copy(part.contactOf.begin(), part.contactOf.end(), result.contactOf.begin() + begin * lanes);
		for (std::size_t b = begin; b < end; ++b) {
			layout::name<Dimension>(result.inDouble.blocks[b], &result.contactOf[b * lanes], result);
			if (layout::hasEmptyLane(&result.contactOf[b * lanes])) result.inDouble.inverseLength[b] = {};
		}
	}
	result.complete = true;
}

template <class Dimension>
void fillIn(
        const typename Dimension::Problem& problem, const BlockKernelsIn<Dimension>& kernels, std::size_t part,
        ContactBlocksIn<Dimension>& result)
{
	const std::size_t begin = result.blockBegin[part];
	kernels.fill(
	        result.inDouble.blocks.data() + begin, result.inDouble.inverseLength.data() + begin,
	        result.contactOf.data() + begin * lanes, result.blockBegin[part + 1] - begin,
	        { problem.contacts.data(), problem.impulses.data(), problem.inverseMass.data(),
	          problem.freeVelocity.data() });
	if (result.inDouble.plays.empty()) return;
	for (std::size_t b = begin; b < result.blockBegin[part + 1]; ++b)
		for (std::size_t l = 0; l < lanes; ++l) {
			const std::int32_t index      = result.contactOf[b * lanes + l];
			result.inDouble.plays[b].v[l] = index == result.none
			        ? 0
			        : playOf(result.inDouble.blocks[b], l, problem.contacts[index].play);
		}
}

} // namespace nonsmooth::contact
