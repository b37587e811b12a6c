// The part of classify() that is the same in every dimension: contacts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/core/classification.hpp>
#include <contact/core/mass_ratio.hpp>

namespace nonsmooth::contact {

/// Pairs of contacts, how long they are, and whether they fit into blocks; bodies have their traits. Refuses what cannot
/// be used. isSimple(contact, traits of i, of j): whether the short formulas of the blocks hold; `isJump`: isMassJump();
/// way(position, position): from the one to the other, {x, y, z}.
template <class Problem, class Simple, class Jump, class Way>
void classifyContacts(
        const Problem& problem, int threads, bool blocks, Classification& result, Simple isSimple, Jump isJump, Way way)
{
	const long        count     = static_cast<long>(problem.contactCount());
	const auto        bodies    = static_cast<std::int32_t>(problem.bodyCount());
	const auto* const positions = problem.positions.empty() ? nullptr : problem.positions.data();
	double            longestX = 0, longestY = 0, longestZ = 0;
	long              bad      = count;
	const double      jump     = jumpOf(problem);
	bool              newPairs = result.pairs.size() != problem.contactCount(), newSimple = newPairs, jumps = false,
	     plays = false;
	result.pairs.resize(count);
	result.simple.resize(count);
// clang-format off
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad) reduction(max : longestX, longestY, longestZ) reduction(|| : newPairs, newSimple, jumps, plays)
	// clang-format on
	for (long k = 0; k < count; ++k) {
		const auto& c = problem.contacts[k];
		if (!usable(c, problem.impulses[k], bodies)) {
			bad = std::min(bad, k);
			continue;
		}
		const std::uint8_t i = result.traits[c.i], j = result.traits[c.j];
		const MovablePair  pair { i & Classification::moves ? c.i : ~c.i,
                                         j & Classification::moves ? c.j : ~c.j };
		MovablePair& before     = result.pairs[k];
		newPairs                = newPairs || pair.i != before.i || pair.j != before.j;
		before                  = pair;
		const std::uint8_t fits = blocks && isSimple(c, i, j);
		newSimple               = newSimple || fits != result.simple[k];
		plays                   = plays || c.play > 0;
		result.simple[k]        = fits;
		jumps                   = jumps || isJump(problem.inverseMass[c.i], problem.inverseMass[c.j], jump);
		if (!positions || !(i & j & Classification::moves)) continue;
		const std::array<double, 3> d = way(positions[c.i], positions[c.j]);
		longestX                      = std::max(longestX, std::abs(d[0]));
		longestY                      = std::max(longestY, std::abs(d[1]));
		longestZ                      = std::max(longestZ, std::abs(d[2]));
	}
	if (bad < count) refuseContact(problem, bad);
	result.longest[0] = longestX;
	result.longest[1] = longestY;
	result.longest[2] = longestZ;
	result.jumps      = jumps;
	result.plays      = plays;
	result.pairsKept  = !newPairs;
	result.simpleKept = !newSimple;
}

} // namespace nonsmooth::contact
