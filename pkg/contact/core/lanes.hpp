// Eight contacts side by side: the vectors that hold their numbers, and whom they couple. What these numbers are is
// each dimension's own (block_kernels.hpp
// of the plane, space/block.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace nonsmooth::contact {

template <class Number> struct VectorsOf;
template <> struct VectorsOf<double> {
	using Four     = double __attribute__((vector_size(32)));
	using Eight    = double __attribute__((vector_size(64)));
	using TwoFours = double __attribute__((vector_size(64), aligned(32)));
};
template <> struct VectorsOf<float> {
	using Four     = float __attribute__((vector_size(16)));
	using Eight    = float __attribute__((vector_size(32)));
	using TwoFours = float __attribute__((vector_size(32), aligned(16)));
};
template <class Number> using Four = typename VectorsOf<Number>::Four;

constexpr std::size_t  lanes = 8, halfLanes = 4;
constexpr std::int32_t emptyLane = -1; // in the place of a contact's number

/// One number of each contact of a block.
template <class Number> struct alignas(lanes * sizeof(Number)) Numbers {
	Number v[lanes];
};

/// Whom the contacts of a block couple, whatever its numbers are.
struct BlockBodies {
	std::int32_t  i[lanes], j[lanes];
	unsigned char movesI, movesJ; // bit l: the body of lane l can move
	bool together; // both halves may be visited at once: all lanes are full, all bodies move, none is in both
};

} // namespace nonsmooth::contact
