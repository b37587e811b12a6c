// The loops over blocks of eight contacts that a solve calls, as a table for each dimension and each instruction set.
// The solver's driver (sweeper.tpp,
// solve.tpp, correct.tpp) knows no other; block_kernels.hpp fills the table in the plane, space/kernels.hpp in space.
#pragma once

#include <contact/core/lanes.hpp>
#include <contact/core/residual.hpp>
#include <type_traits>

namespace nonsmooth::contact {

/// Where the numbers of blocks come from.
template <class Dimension> struct BlockNumbersIn {
	const typename Dimension::Contact*     contacts;
	const typename Dimension::Impulse*     impulses;
	const typename Dimension::InverseMass* masses;
	const typename Dimension::Twist*       freeVelocities;
};

/// What a sweep needs, in doubles or floats. `plays`: W⁻¹ p of the contacts of every block; null where none has play
/// (law.hpp), which costs nothing then.
template <class Dimension, class Number> struct KernelsIn {
	using Block  = typename Dimension::template Block<Number>;
	using Motion = typename Dimension::template Motion<Number>;

	/// One Gauss-Seidel visit of every contact, from impulses extrapolated by beta (velocities must be so already).
	void (*sweep)(Block* blocks, const Numbers<Number>* plays, std::size_t count, Motion* bodies, Number beta);
	/// The same, and fetches from memory meanwhile what follows `ahead`: two cache lines for every block in the
	/// plane, four in space.
	void (*sweepAndFetch)(
	        Block* blocks, const Numbers<Number>* plays, std::size_t count, Motion* bodies, Number beta,
	        const Block* ahead);
	/// before += M⁻¹ Hᵀ (P_k − P_{k−1}), P_{k−1} ← P_k: what is extrapolated next is zero.
	void (*rest)(Block* blocks, std::size_t count, Motion* before);
	/// Natural-map residual of impulses alone; `inverseLength`: 1/ℓ, 0 in an empty lane.
	ResidualSums (*measureImpulses)(
	        const Block* blocks, const Numbers<Number>* inverseLength, const Numbers<Number>* plays,
	        std::size_t count, const Motion* bodies);
	/// That of speeds, too; `share`, `mean`, `least`: SpeedScale.
	ResidualSums (*measure)(
	        const Block* blocks, const Numbers<Number>* inverseLength, const Numbers<Number>* plays,
	        std::size_t count, const Motion* bodies, Number share, Number mean, Number least);
	/// v ← v + β (v − before), before ← v.
	void (*extrapolate)(Motion* bodies, Motion* before, std::size_t count, Number beta);
};

template <class Dimension> struct BlockKernelsIn {
	using Exact        = typename Dimension::template Block<double>;
	using Rounded      = typename Dimension::template Block<float>;
	using Motion       = typename Dimension::template Motion<double>;
	using BlockNumbers = BlockNumbersIn<Dimension>;

	const char*                  name;
	KernelsIn<Dimension, double> inDouble;
	KernelsIn<Dimension, float>  inSingle;

	/// Fills in the numbers of contacts, one for each lane of each block in `contactOf`, whose bodies stand there;
	/// lanes of none are left alone.
	void (*fill)(
	        Exact* blocks, Numbers<double>* inverseLength, const std::int32_t* contactOf, std::size_t count,
	        const BlockNumbers& from);
	/// v += M⁻¹ Hᵀ P.
	void (*apply)(const Exact* blocks, std::size_t count, Motion* bodies);
	/// Sweep and apply for normal impulses alone, as if neither friction nor rolling resistance nor impulses of
	/// theirs were there: the same bits.
	void (*sweepNormals)(
	        Exact* blocks, const Numbers<double>* plays, std::size_t count, Motion* bodies, double beta);
	void (*applyNormals)(const Exact* blocks, std::size_t count, Motion* bodies);
	/// Blocks of the same contacts with all numbers rounded to floats; what is too large for those becomes the
	/// largest whose thresholds are still numbers.
	void (*narrow)(
	        const Exact* from, const Numbers<double>* inverseLength, std::size_t count, Rounded* to,
	        Numbers<float>* inverseLengthTo);
	/// Takes impulses P_k back, projected on the thresholds in doubles; those on a threshold of floats are on that
	/// of doubles. P_{k−1} is P_k.
	void (*widen)(const Rounded* from, std::size_t count, Exact* to);

	template <class Number> const KernelsIn<Dimension, Number>& with() const
	{
		if constexpr (std::is_same_v<Number, double>) return inDouble;
		else
			return inSingle;
	}
};

} // namespace nonsmooth::contact
