// Eight contacts at a time: the data and the inner loops of a sweep.
//
// A block holds two halves of four contacts; those of a half share no body that moves, nor do in most blocks those of both (BlockBodies::together). Each number of the
// eight lies side by side, and a body's motion is a vector of four numbers, which are doubles or floats (solver.hpp says when).
// The loops (block_kernels.inc) are written once and compiled thrice: lane after lane for any processor, and for AVX2 and AVX-512 all lanes at
// once where they share no body and a register holds them, half after half elsewhere; which runs is decided on the machine. None fuses multiplications with
// additions or reorders a sum, so all give the same bits.
//
// Bodies carry what impulses have changed of their free velocities, and contacts have in their biases what free velocities make of them: so digits are kept
// for what the sweeps are about, however fast everything moves.
//
// Only "simple" contacts fit in: bodies with one mass for x and y, no lever along the normal where a body can turn, no bias but the
// normal one. That is every contact between disks, or between a disk and a wall that does not turn.
#pragma once

#include <contact/problem.hpp>
#include <contact/residual.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

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

constexpr std::size_t lanes = 8, halfLanes = 4;

/// One number of each contact of a block.
template <class Number> struct alignas(lanes * sizeof(Number)) Numbers {
	Number v[lanes];
};

/// Change of a body's velocity and its inverse mass, (v_x, v_y, ω, 1/m).
template <class Number> struct alignas(halfLanes * sizeof(Number)) Motion {
	Four<Number> v;
};

/// Whom the contacts of a block couple, whatever its numbers are.
struct BlockBodies {
	std::int32_t  i[lanes], j[lanes];
	unsigned char movesI, movesJ; // bit l: the body of lane l can move
	bool together; // both halves may be visited at once: all lanes are full, all bodies move, none is in both
};

/// Numbers that sweeps over normals alone need come first.
template <class Number> struct alignas(64) Block : BlockBodies {
	Numbers<Number> nx, ny;
	Numbers<Number> inverseN, biasN, adhesion;
	Numbers<Number> n, beforeN;
	Numbers<Number> leverTi, leverTj; // λt [m]
	Numbers<Number> inverseInertiaI, inverseInertiaJ;
	Numbers<Number> friction, rollingArm; // as in Contact, and so is adhesion
	Numbers<Number> biasT,
	        biasR; // with biasN relative velocity of the bodies' free velocities, and the contact's bias
	Numbers<Number> inverseT, inverseR; // with inverseN the inverse diagonal of the Delassus operator
	Numbers<Number> t, r; // with n impulses P_k
	Numbers<Number> beforeT, beforeR; // with beforeN P_{k−1}
};

/// W⁻¹ p of a lane with the play p, of which law.hpp speaks.
inline double playOf(const Block<double>& block, std::size_t lane, double play)
{
	return block.inverseN.v[lane] * play;
}

/// Where the numbers of blocks come from.
struct BlockNumbers {
	static constexpr std::int32_t none = -1; // an empty lane
	const Contact*                contacts;
	const Impulse*                impulses;
	const InverseMass*            masses;
	const Twist*                  freeVelocities;
};

/// What a sweep needs, in doubles or floats. `plays`: W⁻¹ p of the contacts of every block; null where none has play (law.hpp), which costs nothing then.
template <class Number> struct KernelsOf {
	/// One Gauss-Seidel visit of every contact, from impulses extrapolated by beta (velocities must be so already).
	void (*sweep)(
	        Block<Number>* blocks, const Numbers<Number>* plays, std::size_t count, Motion<Number>* bodies,
	        Number beta);
	/// The same, and fetches from memory meanwhile what follows `ahead`: two cache lines for every block.
	void (*sweepAndFetch)(
	        Block<Number>* blocks, const Numbers<Number>* plays, std::size_t count, Motion<Number>* bodies,
	        Number beta, const Block<Number>* ahead);
	/// before += M⁻¹ Hᵀ (P_k − P_{k−1}), P_{k−1} ← P_k: what is extrapolated next is zero.
	void (*rest)(Block<Number>* blocks, std::size_t count, Motion<Number>* before);
	/// Natural-map residual of impulses alone; `inverseLength`: 1/ℓ, 0 in an empty lane.
	ResidualSums (*measureImpulses)(
	        const Block<Number>* blocks, const Numbers<Number>* inverseLength, const Numbers<Number>* plays,
	        std::size_t count, const Motion<Number>* bodies);
	/// That of speeds, too; `share`, `mean`, `least`: SpeedScale.
	ResidualSums (*measure)(
	        const Block<Number>* blocks, const Numbers<Number>* inverseLength, const Numbers<Number>* plays,
	        std::size_t count, const Motion<Number>* bodies, Number share, Number mean, Number least);
	/// v ← v + β (v − before), before ← v.
	void (*extrapolate)(Motion<Number>* bodies, Motion<Number>* before, std::size_t count, Number beta);
};

struct BlockKernels {
	const char*       name;
	KernelsOf<double> inDouble;
	KernelsOf<float>  inSingle;

	/// Fills in the numbers of contacts, one for each lane of each block in `contactOf`, whose bodies stand there; lanes of none are left alone.
	void (*fill)(
	        Block<double>* blocks, Numbers<double>* inverseLength, const std::int32_t* contactOf, std::size_t count,
	        const BlockNumbers& from);
	/// v += M⁻¹ Hᵀ P.
	void (*apply)(const Block<double>* blocks, std::size_t count, Motion<double>* bodies);
	/// Sweep and apply for normal impulses alone, as if neither friction nor rolling resistance nor impulses of theirs were there: the same bits.
	void (*sweepNormals)(
	        Block<double>* blocks, const Numbers<double>* plays, std::size_t count, Motion<double>* bodies,
	        double beta);
	void (*applyNormals)(const Block<double>* blocks, std::size_t count, Motion<double>* bodies);
	/// Blocks of the same contacts with all numbers rounded to floats; what is too large for those becomes the largest whose thresholds are still numbers.
	void (*round)(
	        const Block<double>* from, const Numbers<double>* inverseLength, std::size_t count, Block<float>* to,
	        Numbers<float>* inverseLengthTo);
	/// Takes impulses P_k back, projected on the thresholds in doubles; those on a threshold of floats are on that of doubles. P_{k−1} is P_k.
	void (*take)(const Block<float>* from, std::size_t count, Block<double>* to);

	template <class Number> const KernelsOf<Number>& with() const;
};
template <> inline const KernelsOf<double>& BlockKernels::with() const { return inDouble; }
template <> inline const KernelsOf<float>&  BlockKernels::with() const { return inSingle; }

/// All that this processor can run, the fastest first and the portable ones last.
const std::vector<const BlockKernels*>& availableKernels();

} // namespace nonsmooth::contact
