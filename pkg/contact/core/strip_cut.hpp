// Where a packing is cut into strips: across its longest side, with about as many contacts in each.
//
// A contact may reach into the next strip but no further, so a strip is at least as wide as a contact is long. One body
// with long contacts (a wide platen whose centre is far from the disks below it) would make strips so wide that few are
// left. Where that happens and few contacts are that long, strips are as wide as the others ask, and those that reach
// too far are left over. Nor does a body far from all others widen strips: ends take in whatever lies beyond.
#pragma once

#include <contact/core/classification.hpp>

namespace nonsmooth::contact {

/// Filled by cutIntoStrips(), whose memory it keeps from one call to the next.
struct StripCut {
	std::int32_t              count = 1; // strips
	std::vector<std::int32_t> stripOfBody; // -1: it can't move

	struct {
		std::vector<std::int32_t> binOfBody,
		        stripOfBin; // the packing is first cut into many bins of one width; -1: it can't move
		std::int32_t bins = 0,
		             width
		        = 0; // how many, and as how many of them a strip must be wide; none where there is one strip
		std::vector<std::vector<std::int32_t>> counts; // contacts in each bin, by thread
		std::vector<std::int32_t>              sums; // all of them
		std::vector<double>                    samples[3]; // of each axis
	} scratch;
};

/// One strip where places are missing or contacts few. The result depends neither on `threads` nor on what `result`
/// held. Returns whether strips stayed as they were, which is asked where pairs did: bodies that stay in their bins
/// need no counting.
bool cutIntoStrips(const Coordinates& places, const Classification& classification, int threads, StripCut& result);

} // namespace nonsmooth::contact
