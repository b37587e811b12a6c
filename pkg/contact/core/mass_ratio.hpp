// From which ratio of masses on a contact is a jump (plane/mass_jumps.hpp).
#pragma once

#include <cstddef>

namespace nonsmooth::contact {

constexpr double      massJump  = 30; // ratio of masses: in the plane a ratio of sizes of 5.5
constexpr std::size_t fewBodies = 100; // of a problem
constexpr double      fewsJump  = 10; // what is a jump among so few, where a patch costs next to nothing

/// The ratio of masses that is a jump in a problem.
template <class Problem> double jumpOf(const Problem& problem)
{
	return problem.bodyCount() <= fewBodies ? fewsJump : massJump;
}

} // namespace nonsmooth::contact
