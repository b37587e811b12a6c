// The look at bodies and contacts of a problem in the plane; what it finds stands in core/classification.hpp.
#pragma once

#include <contact/core/classification.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

inline Coordinates coordinatesOf(const Problem& problem)
{
	static_assert(sizeof(Point) == 2 * sizeof(double), "two numbers side by side");
	return { problem.positions.empty() ? nullptr : &problem.positions.front().x, problem.positions.size(), 2 };
}

/// Looks with so many threads; without `blocks` no contact fits into them. Throws std::invalid_argument naming the
/// first size, body or contact that cannot be used, and why; whatever `result` holds then is no last look for the next
/// one.
void classify(const Problem& problem, int threads, bool blocks, Classification& result);

} // namespace nonsmooth::contact
