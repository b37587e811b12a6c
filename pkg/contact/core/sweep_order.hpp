// The order in which a Gauss-Seidel sweep visits contacts: independent of the number of threads and kind to caches.
//
// Bodies are cut into strips across the longer side of the packing (strip_cut.hpp), and a contact belongs to the first
// strip it touches, if it reaches into the next strip at most. So all even strips can be swept at once, then all odd
// ones, and any number of threads gives the same bits. Contacts that reach further, few or none, are left over: they
// come last, one thread's work. Inside a strip contacts are sorted by colour (neighbours in the order share no body),
// which lets a processor work on several at a time. Bodies are ordered by strips too, so that a strip finds its own
// side by side.
#pragma once

#include <contact/core/strip_cut.hpp>

namespace nonsmooth::contact {

/// Filled by arrange(), whose memory it keeps from one call to the next.
struct SweepOrder {
	std::vector<std::int32_t> order; // contacts: even strips, odd strips, those left over
	std::vector<std::size_t>
	        partBegin; // in `order`, of these parts; one more than there are. The last part is what is left over.
	std::size_t evenStrips = 0; // how many of the strips come in the first half
	std::vector<std::int32_t>
	        bodies; // those that move, strip after strip from one end of the packing to the other; then the others
	std::vector<std::size_t> bodyBegin; // in `bodies`; one more than there are strips
	std::size_t              partCount() const { return partBegin.size() - 1; }
	std::size_t              stripCount() const { return partCount() - 1; }

	struct {
		StripCut                               cut;
		std::vector<std::int32_t>              partOf; // of contacts
		std::vector<std::uint8_t>              colours;
		std::vector<std::uint64_t>             used; // colours at each body
		std::vector<std::size_t>               next;
		std::vector<std::vector<std::size_t>>  counts; // contacts of each part, by thread
		std::vector<std::vector<std::int32_t>> unsorted; // one part's contacts, by thread
	} scratch;
};

/// Greedy: each contact, in the order given, takes the lowest colour that neither of its movable bodies has; 63 is
/// shared by the rest. `used` is left with the colours at each body.
void colour(
        const std::vector<MovablePair>& pairs, std::size_t bodyCount, std::vector<std::uint8_t>& colours,
        std::vector<std::uint64_t>& used);

/// Without places all contacts make one strip. The result depends neither on `threads` nor on what `result` held.
/// Returns whether it is what it held
/// already: `classification` says which pairs are kept, and where strips are too, so is the order.
bool arrange(const Coordinates& places, const Classification& classification, int threads, SweepOrder& result);

} // namespace nonsmooth::contact
