// The order in which a Gauss-Seidel sweep visits contacts: independent of the number of threads and kind to caches.
//
// Bodies are cut into strips across the longer side of the packing, each at least as wide as the longest contact, and a contact belongs
// to the first strip it touches: it reaches into the next strip at most. So all even strips can be swept at once, then all odd ones,
// and any number of threads gives the same bits. Inside a strip contacts are sorted by colour (neighbours in the order share no body),
// which lets a processor work on several at a time. Bodies are ordered by strips too, so that a strip finds its own side by side.
#pragma once

#include <contact/problem.hpp>

namespace nonsmooth::contact {

/// The bodies of a contact that can move; `none` in place of one that can't.
struct MovablePair {
	static constexpr std::int32_t none = -1;
	std::int32_t                  i, j;
};

/// Filled by arrange(), whose memory it keeps from one call to the next.
struct SweepOrder {
	std::vector<std::int32_t> order;      // contacts, even strips first
	std::vector<std::size_t>  stripBegin; // in `order`; one more than there are strips
	std::size_t               evenStrips = 0; // how many of the strips come in the first half
	std::vector<std::int32_t> bodies;         // those that move, strip after strip from one end of the packing to the other; then the others
	std::vector<std::size_t>  bodyBegin;      // in `bodies`; one more than there are strips
	std::vector<MovablePair>  pairs;          // of the contacts
	std::size_t               stripCount() const { return stripBegin.size() - 1; }

	struct {
		std::vector<std::int32_t>  bucketOf, stripOfBody; // bucket: what a contact is sorted by
		std::vector<std::uint8_t>  colours;
		std::vector<std::uint64_t> used; // colours at each body
		std::vector<std::size_t>   next;
	} scratch;
};

/// Greedy: each contact, in the order given, takes the lowest colour that neither of its movable bodies has; 63 is shared by the rest.
/// `used` is left with the colours at each body.
void colour(const std::vector<MovablePair>& pairs, std::size_t bodyCount, std::vector<std::uint8_t>& colours, std::vector<std::uint64_t>& used);

/// Without problem.positions all contacts make one strip. The result does not depend on `threads`.
void arrange(const Problem& problem, int threads, SweepOrder& result);

} // namespace nonsmooth::contact
