// Eight contacts at a time: the data and the inner loops of a sweep.
//
// A block holds two halves of four contacts; those of a half share no body that moves, nor do in most blocks those of both (Block::together). Each number of the
// eight lies side by side, and a body's motion is a vector of four doubles.
// The loops (block_kernels.inc) are written once and compiled thrice: lane after lane for any processor, half after half for AVX2, and for AVX-512 all lanes at
// once where they share no body; which runs is decided on the machine. None fuses multiplications with additions or
// reorders a sum, so all give the same bits.
//
// Only "simple" contacts fit in: bodies with one mass for x and y, no lever along the normal where a body can turn, no bias but the
// normal one. That is every contact between disks, or between a disk and a wall that does not turn.
#pragma once

#include <contact/problem.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nonsmooth::contact {

using Lanes = double __attribute__((vector_size(32)));

constexpr std::size_t lanes = 8, halfLanes = 4;

/// One number of each contact of a block.
struct alignas(64) Numbers {
	double v[lanes];
};

/// Velocity of a body and its inverse mass, (v_x, v_y, ω, 1/m).
struct alignas(32) Motion {
	Lanes v;
};

/// Numbers that sweeps over normals alone need come first.
struct alignas(64) Block {
	std::int32_t  i[lanes], j[lanes];
	Numbers       nx, ny;
	Numbers       inverseN, biasN, adhesion;
	Numbers       n, beforeN;
	unsigned char movesI, movesJ; // bit l: the body of lane l can move
	bool    together; // both halves may be visited at once: all lanes are full, all bodies move, none is in both
	Numbers leverTi, leverTj; // λt [m]
	Numbers inverseInertiaI, inverseInertiaJ;
	Numbers friction, rollingArm; // as in Contact, and so are biasN and adhesion
	Numbers inverseT, inverseR; // with inverseN the inverse diagonal of the Delassus operator
	Numbers t, r; // with n impulses P_k
	Numbers beforeT, beforeR; // with beforeN P_{k−1}
};

/// Sums over contacts: squared residual and impulse, and the largest squared residual.
struct ResidualSums {
	double square = 0, scale = 0, largest = 0;
};

/// Where the numbers of blocks come from.
struct BlockNumbers {
	static constexpr std::int32_t none = -1; // an empty lane
	const Contact*                contacts;
	const Impulse*                impulses;
	const InverseMass*            masses;
};

struct BlockKernels {
	const char* name;
	/// Fills in the numbers of contacts, one for each lane of each block in `contactOf`, whose bodies stand there; lanes of none are left alone.
	void (*fill)(
	        Block* blocks, Numbers* inverseLength, const std::int32_t* contactOf, std::size_t count,
	        const BlockNumbers& from);
	/// One Gauss-Seidel visit of every contact, from impulses extrapolated by beta (velocities must be so already).
	void (*sweep)(Block* blocks, std::size_t count, Motion* bodies, double beta);
	/// The same, and fetches from memory meanwhile what follows `ahead`: two cache lines for every block.
	void (*sweepAndFetch)(Block* blocks, std::size_t count, Motion* bodies, double beta, const Block* ahead);
	/// v += M⁻¹ Hᵀ P.
	void (*apply)(const Block* blocks, std::size_t count, Motion* bodies);
	/// Both for normal impulses alone, as if neither friction nor rolling resistance nor impulses of theirs were there: the same bits.
	void (*sweepNormals)(Block* blocks, std::size_t count, Motion* bodies, double beta);
	void (*applyNormals)(const Block* blocks, std::size_t count, Motion* bodies);
	/// before += M⁻¹ Hᵀ (P_k − P_{k−1}), P_{k−1} ← P_k: what is extrapolated next is zero.
	void (*rest)(Block* blocks, std::size_t count, Motion* before);
	/// Natural-map residual; `inverseLength`: 1/ℓ, 0 in an empty lane.
	ResidualSums (*measure)(
	        const Block* blocks, const Numbers* inverseLength, std::size_t count, const Motion* bodies);
	/// v ← v + β (v − before), before ← v.
	void (*extrapolate)(Motion* bodies, Motion* before, std::size_t count, double beta);
};

/// All that this processor can run, the fastest first and the portable ones last.
const std::vector<const BlockKernels*>& availableKernels();

} // namespace nonsmooth::contact
