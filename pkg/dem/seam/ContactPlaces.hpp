// The order of contacts, by (lower id, higher id), over slots of arrays: contacts that come and go move no others.
#pragma once

#include <algorithm>
#include <neighbours/bucket_sort.hpp>
#include <utility>
#include <vector>

namespace yade::nscd {

/// A contact's place in the order of (lower id, higher id), and in the arrays.
struct ContactPlace {
	int low, high, slot;
};

/// Of places, or of anything else with `low` and `high`: in the order of ids.
template <class Item> bool isBefore(const Item& a, const Item& b)
{
	return std::make_pair(a.low, a.high) < std::make_pair(b.low, b.high);
}

/// Puts places into that order. `each(take)` calls take(low, place) for all, and is called twice; `begins`: for its use.
template <class Each>
void orderByIds(std::size_t bodies, Each each, int threads, std::vector<int>& begins, std::vector<ContactPlace>& order)
{
	nonsmooth::neighbours::sortIntoBuckets(bodies, each, begins, order);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long id = 0; id < (long)bodies; ++id)
		std::sort(order.begin() + begins[id], order.begin() + begins[id + 1], isBefore<ContactPlace>);
}

/// Whether so many contacts have come since slots were in their order that it is time for packBySlot().
inline bool areStrewn(std::size_t came, const std::vector<ContactPlace>& order) { return came > order.size() / 20; }

/// Puts the items of arrays, by slot, into the order, whose slots are their places from now on: whoever goes through
/// them meets neighbours in memory. An array without items stays so.
template <class... Items> void packBySlot(std::vector<ContactPlace>& order, int threads, std::vector<Items>&... arrays)
{
	const long count = (long)order.size();
	const auto pack  = [&](auto& items) {
                if (items.empty()) return;
                std::remove_reference_t<decltype(items)> sorted(count);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k)
			sorted[k] = std::move(items[order[k].slot]);
		items.swap(sorted);
	};
	(pack(arrays), ...);
	for (long k = 0; k < count; ++k)
		order[k].slot = int(k);
}

} // namespace yade::nscd
