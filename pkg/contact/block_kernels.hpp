// Four contacts at a time: the data and the inner loops of a sweep.
//
// A block holds four contacts that share no body that moves, as lanes of vectors of four doubles; a body's motion is one such vector too.
// The loops (block_kernels.inc) are written once and compiled thrice: lane after lane for any processor, four lanes at once for AVX2, and for AVX-512
// the eight of two blocks where these share no body; which runs is decided on the machine. None fuses multiplications with additions or
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

constexpr std::size_t lanes = 4;

/// Velocity of a body and its inverse mass, (v_x, v_y, ω, 1/m).
struct alignas(32) Motion {
	Lanes v;
};

/// Numbers that sweeps over normals alone need come first.
struct alignas(32) Block {
	std::int32_t  i[lanes], j[lanes];
	Lanes         nx, ny;
	Lanes         inverseN, biasN, adhesion;
	Lanes         n, beforeN;
	unsigned char movesI, movesJ; // bit l: the body of lane l can move
	bool withNext; // it and the next block may be visited at once: all lanes are full, all bodies move, none is in both
	Lanes leverTi, leverTj; // λt [m]
	Lanes inverseInertiaI, inverseInertiaJ;
	Lanes friction, rollingArm; // as in Contact, and so are biasN and adhesion
	Lanes inverseT, inverseR; // with inverseN the inverse diagonal of the Delassus operator
	Lanes t, r; // with n impulses P_k
	Lanes beforeT, beforeR; // with beforeN P_{k−1}
};

/// 1/ℓ of a block's contacts, 0 in an empty lane.
struct alignas(32) InverseLength {
	Lanes v;
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
	/// Fills in the numbers of contacts, four for each block in `contactOf`, whose bodies stand there; lanes of none are left alone.
	void (*fill)(
	        Block* blocks, InverseLength* inverseLength, const std::int32_t* contactOf, std::size_t count,
	        const BlockNumbers& from);
	/// One Gauss-Seidel visit of every contact, from impulses extrapolated by beta (velocities must be so already).
	void (*sweep)(Block* blocks, std::size_t count, Motion* bodies, double beta);
	/// The same, and fetches from memory meanwhile what follows `ahead`: a cache line for every block.
	void (*sweepAndFetch)(Block* blocks, std::size_t count, Motion* bodies, double beta, const Block* ahead);
	/// v += M⁻¹ Hᵀ P.
	void (*apply)(const Block* blocks, std::size_t count, Motion* bodies);
	/// Both for normal impulses alone, as if neither friction nor rolling resistance nor impulses of theirs were there: the same bits.
	void (*sweepNormals)(Block* blocks, std::size_t count, Motion* bodies, double beta);
	void (*applyNormals)(const Block* blocks, std::size_t count, Motion* bodies);
	/// before += M⁻¹ Hᵀ (P_k − P_{k−1}), P_{k−1} ← P_k: what is extrapolated next is zero.
	void (*rest)(Block* blocks, std::size_t count, Motion* before);
	/// Natural-map residual; one `inverseLength` a block.
	ResidualSums (*measure)(
	        const Block* blocks, const InverseLength* inverseLength, std::size_t count, const Motion* bodies);
	/// v ← v + β (v − before), before ← v.
	void (*extrapolate)(Motion* bodies, Motion* before, std::size_t count, double beta);
};

/// All that this processor can run, the fastest first and the portable ones last.
const std::vector<const BlockKernels*>& availableKernels();

} // namespace nonsmooth::contact
