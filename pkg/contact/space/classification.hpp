// A look at every body and contact of a problem in space before a solve; contact/core/classification.hpp says what for.
#pragma once

#include <contact/core/classification.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::contact::space {

inline Coordinates coordinatesOf(const Problem& problem)
{
	static_assert(sizeof(Vector) == 3 * sizeof(double), "three numbers side by side");
	return { problem.positions.empty() ? nullptr : &problem.positions.front().x, problem.positions.size(), 3 };
}

/// As in the plane. Contacts of balls fit into blocks, and so do those of a ball with a body that is fixed or whose
/// motion is given.
void classify(const Problem& problem, int threads, bool blocks, Classification& result);

} // namespace nonsmooth::contact::space
