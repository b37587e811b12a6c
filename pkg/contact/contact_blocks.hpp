// A contact problem laid out for sweeping: in strips (and what they leave over, as one more part), and inside a part in blocks of four contacts that share no movable body (nor do most blocks
// with the next one, which Block::withNext says), followed by the few contacts that do not fit into blocks.
#pragma once

#include <contact/block_kernels.hpp>
#include <contact/problem.hpp>
#include <contact/sweep_order.hpp>
#include <vector>

namespace nonsmooth::contact {

struct ContactBlocks {
	static constexpr std::int32_t none = -1; // an empty lane

	std::vector<Block>        blocks;
	std::vector<std::int32_t> contactOf;     // of every lane of every block, in Problem::contacts
	std::vector<std::int32_t> others;        // contacts outside blocks
	std::vector<std::size_t>  blockBegin, otherBegin; // of every part of the order; one more than there are parts
	std::vector<InverseLength> inverseLength; // of every block; apart, since only the residual needs it
	std::vector<std::int32_t> placeOf; // of the problem's bodies in order.bodies
	SweepOrder                order;
	std::size_t               partCount() const { return blockBegin.empty() ? 0 : blockBegin.size() - 1; }

	/// What one part consists of, before its place in the whole is known.
	struct Part {
		std::vector<std::int32_t> contactOf, others;
	};
	std::vector<Part>         scratch;
	std::vector<std::uint8_t> traits, simple; // of bodies, of contacts
};

/// Lays out the contacts' data in `result`, whose memory is used again; impulses come from problem.impulses, projected on their thresholds.
/// Blocks name bodies by their places; an empty lane names the place problem.bodyCount(), which the caller provides and which cannot move. Without `blocks`
/// all contacts are among the others, in the order of the sweep.
void layOut(const Problem& problem, int threads, ContactBlocks& result, bool blocks = true);

} // namespace nonsmooth::contact
