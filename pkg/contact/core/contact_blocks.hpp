// A contact problem laid out for sweeping: in strips (and what they leave over, as one more part), and inside a part in
// blocks of eight contacts (core/lanes.hpp), followed by the few that do not fit into blocks.
//
// Which contacts lie where rests on who touches whom, on strips, and on which contacts fit into blocks. While these
// stay, so does it, and a solve only fills in new numbers.
#pragma once

#include <contact/core/kernel_table.hpp>
#include <contact/core/classification.hpp>
#include <contact/core/sweep_order.hpp>
#include <vector>

namespace nonsmooth::contact {

template <class Dimension, class Number> struct BlocksIn {
	using Block = typename Dimension::template Block<Number>;

	std::vector<Block>           blocks;
	std::vector<Numbers<Number>> inverseLength; // 1/ℓ; apart, since only the residual needs it
	std::vector<Numbers<Number>> plays; // W⁻¹ p, see Contact::play; none where no contact of the problem has any

	/// Those from a block on, as kernels ask for them.
	const Numbers<Number>* playsFrom(std::size_t block) const { return plays.empty() ? nullptr : &plays[block]; }
};

template <class Dimension> struct ContactBlocksIn {
	static constexpr std::int32_t none = emptyLane;

	BlocksIn<Dimension, double> inDouble;
	BlocksIn<Dimension, float>  inSingle; // rounded from them where sweeps ask for it
	std::vector<std::int32_t>   contactOf; // of every lane of every block, in Problem::contacts
	std::vector<std::int32_t>   others; // contacts outside blocks
	std::vector<std::size_t>    blockBegin, otherBegin; // of every part of the order; one more than there are parts
	std::vector<std::int32_t>   placeOf; // of the problem's bodies in order.bodies
	Classification              classification;
	SweepOrder                  order;
	std::size_t                 partCount() const { return blockBegin.empty() ? 0 : blockBegin.size() - 1; }

	template <class Number> BlocksIn<Dimension, Number>& with()
	{
		if constexpr (std::is_same_v<Number, double>) return inDouble;
		else
			return inSingle;
	}

	/// What one part consists of, before its place in the whole is known. On cache lines of its own: threads fill
	/// one beside the other.
	struct alignas(64) Part {
		std::vector<std::int32_t> contactOf, others;
	};
	std::vector<Part> scratch;
	bool              complete = false; // whether the last layout came to its end, so that what it left can be kept
	bool              kept     = false; // whether it kept what stood there
};

/// Looks at the problem (core/classification.hpp, whose refusals it throws) and lays out which contacts lie where in `result`,
/// whose memory is used again. Numbers are left to fillIn(). Blocks name bodies by their places; an empty lane names
/// the place problem.bodyCount(), which the caller provides and which cannot move. Without `blocks` all contacts are
/// among the others, in the order of the sweep.
template <class Dimension>
void layOut(
        const typename Dimension::Problem& problem, int threads, ContactBlocksIn<Dimension>& result,
        bool blocks = true);

/// Fills the numbers of the contacts into the blocks of one part; impulses come from problem.impulses, projected on
/// their thresholds.
template <class Dimension>
void fillIn(
        const typename Dimension::Problem& problem, const BlockKernelsIn<Dimension>& kernels, std::size_t part,
        ContactBlocksIn<Dimension>& result);

} // namespace nonsmooth::contact
