// Counting sort.
#pragma once

#include <cstddef>
#include <vector>

namespace nonsmooth::neighbours {

/// `each(take)` calls take(bucket, item) for all items, and is called twice; then those of bucket b lie from
/// sorted[begin[b]] to sorted[begin[b + 1]], in the order given.
template <class Item, class Each>
void sortIntoBuckets(std::size_t buckets, Each each, std::vector<int>& begin, std::vector<Item>& sorted)
{
	begin.assign(buckets + 2, 0); // one bucket ahead, so that each begins in the end where its first item went
	each([&](std::size_t b, const Item&) { ++begin[b + 2]; });
	for (std::size_t b = 1; b <= buckets; ++b)
		begin[b + 1] += begin[b];
	sorted.resize(begin.back());
	each([&](std::size_t b, const Item& item) { sorted[begin[b + 1]++] = item; });
	begin.pop_back();
}

} // namespace nonsmooth::neighbours
