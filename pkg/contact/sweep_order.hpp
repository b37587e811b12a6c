// The order in which a Gauss-Seidel sweep visits contacts: independent of the number of threads and kind to caches.
//
// Bodies are cut into strips across the longer side of the packing, each at least as wide as the longest contact, and a contact belongs
// to the first strip it touches: it reaches into the next strip at most. So all even strips can be swept at once, then all odd ones,
// and any number of threads gives the same bits. Inside a strip contacts are sorted by colour (neighbours in the order share no body),
// which lets a processor work on several at a time.
#pragma once

#include <contact/problem.hpp>

namespace nonsmooth::contact {

struct SweepOrder {
	std::vector<std::int32_t> order;      // contacts, even strips first
	std::vector<std::size_t>  stripBegin; // in `order`; one more than there are strips
	std::size_t               evenStrips = 0; // how many of the strips come in the first half
	std::size_t               stripCount() const { return stripBegin.size() - 1; }
};

/// Greedy: each contact, in the order given, takes the lowest colour that neither of its movable bodies has; 63 is shared by the rest.
std::vector<std::uint8_t> coloursOf(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverseMass);

/// Without problem.positions all contacts make one strip.
SweepOrder arrange(const Problem& problem);

} // namespace nonsmooth::contact
