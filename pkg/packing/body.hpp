// What all parts of the relaxation share: bodies side by side in memory, and blocks of them.
//
// SI units, the plane with x to the right and y up. Bodies are kept in an order of their own, near ones near in memory
// (space_order.hpp); "number" is a body's place in the arrays that the caller gave.
#pragma once

#include <algorithm>
#include <cstddef>

namespace nonsmooth::packing {

/// A disk [m]; `mobility`, the mean radius by its own, is what turns its force into a velocity per time.
struct Body {
	double x, y, r, mobility;
};

struct Vector {
	double x, y;
};

/// Bodies of which the forces are computed together, so that what lies between two steps of that stays in the nearest
/// memory.
constexpr int blockSize = 64;

inline int blocksOf(std::size_t bodies) { return int((bodies + blockSize - 1) / blockSize); }

/// The bodies of a block, from `first` to before `last`.
struct BlockRange {
	BlockRange(int block, std::size_t bodies)
	        : first(block * blockSize)
	        , last(std::min(first + blockSize, int(bodies)))
	{
	}
	int first, last;
};

} // namespace nonsmooth::packing
