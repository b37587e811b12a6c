// Sets of contacts that share no movable body, so that a Gauss-Seidel sweep over one set is order-free: it gives the same
// bits on any number of threads.
#pragma once

#include <contact/problem.hpp>

namespace nonsmooth::contact {

/// Contacts in sweep order and where each colour begins. `parallel[k]` is false for the rest that no colour was left for:
/// its contacts may share bodies and are swept one after the other.
struct Colouring {
	std::vector<std::int32_t> order;
	std::vector<std::size_t>  begin; // one more than there are colours
	std::vector<bool>         parallel;
	std::size_t               count() const { return parallel.size(); }
};

/// Greedy: each contact, in the order given, takes the lowest colour that neither of its movable bodies has. At most 64 colours.
Colouring colour(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverseMass);

} // namespace nonsmooth::contact
