// Contacts that are left out of a solve since they are open and will not close, and that are taken in where its velocities
// would close them; the step is then solved again. The same for the plane and for space.
#pragma once

#include <algorithm>
#include <cstddef>
#include <lib/base/Math.hpp>
#include <vector>

namespace yade::nscd {

/// Whether an open contact may be left out: whether it stays wider than `widest` [m] at 1.2 times its speed of approach.
/// `speed`: of parting [m/s], `h`: the step [s].
inline bool staysOpen(Real gap, Real speed, Real h, Real widest)
{
	return gap + 1.2 * h * std::min(Real(0), speed) > widest;
}

/// Which of `count` contacts that were left out are to be taken in: none where none would overlap by what counts, else
/// those that would close, and after a few rounds all. `gapAfter(k)`: at the step's end [m], `lengthOf(k)`: ℓ [m];
/// `rounds`: so far in this step.
template <class Gap, class Length>
std::vector<std::size_t> toBeTakenIn(std::size_t count, int& rounds, Gap gapAfter, Length lengthOf)
{
	constexpr Real           unseen = 0.005; // ℓ; what a contact may overlap that is not taken in
	constexpr int            most   = 4; // rounds after which all are
	std::vector<std::size_t> taken;
	bool                     needed = false;
	for (std::size_t k = 0; k < count && !needed; ++k)
		needed = gapAfter(k) < -unseen * lengthOf(k);
	if (!needed) return taken;
	++rounds;
	for (std::size_t k = 0; k < count; ++k)
		if (rounds > most || gapAfter(k) < 0) taken.push_back(k);
	return taken;
}

/// Merges `added` items, which are in order, into `old` ones that are, of which each array has a part: isBehind(o, a)
/// compares an old one with one of the others, place(a, to) puts one of these in.
template <class Behind, class Place, class... Parts>
void mergeInto(std::size_t old, std::size_t added, Behind isBehind, Place place, std::vector<Parts>&... arrays)
{
	(arrays.resize(old + added), ...);
	for (std::size_t to = old + added; added > 0;) { // from the back, where there is room
		--to;
		if (old > 0 && isBehind(old - 1, added - 1)) {
			--old;
			((arrays[to] = arrays[old]), ...);
		} else
			place(--added, to);
	}
}

/// Takes the items at `places`, which are in order, out of a list.
template <class Item> void eraseAt(std::vector<Item>& items, const std::vector<std::size_t>& places)
{
	auto        next = places.begin();
	std::size_t kept = 0;
	for (std::size_t k = 0; k < items.size(); ++k) {
		if (next != places.end() && *next == k) ++next;
		else if (kept != k)
			items[kept++] = std::move(items[k]);
		else
			++kept;
	}
	items.resize(kept);
}

/// Solves a step until no contact that is left out would close; returns the last solve's statistics, with the sweeps of
/// all.
template <class Seam, class Solve> auto solveWithRecalls(Seam& seam, Solve solve)
{
	auto statistics = solve();
	while (seam.recall() > 0) {
		const int before = statistics.iterations;
		statistics       = solve();
		statistics.iterations += before;
	}
	return statistics;
}

} // namespace yade::nscd
