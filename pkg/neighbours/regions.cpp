#include "regions.hpp"
#include "bucket_sort.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace nonsmooth::neighbours {

void Regions::build(const std::vector<Disk>& disks, double width)
{
	// numbers of squares by a hash, each in the first free place from there on
	const std::uint32_t mask = tableSize(disks.size()) - 1;
	table.assign(mask + 1, -1);
	places.clear();
	const auto numberOf = [&](Cell place) -> int& {
		std::uint32_t at = hashOf(place) & mask;
		while (table[at] >= 0 && !(places[table[at]] == place))
			at = (at + 1) & mask;
		return table[at];
	};
	square.assign(disks.size(), -1);
	for (std::size_t k = 0; k < disks.size(); ++k) {
		if (!isThere(disks[k])) continue;
		const Cell place  = cellAt(disks[k].x, disks[k].y, width);
		int&       number = numberOf(place);
		if (number < 0) {
			number = int(places.size());
			places.push_back(place);
		}
		square[k] = number;
	}
	const auto each = [this](auto take) {
		for (std::size_t k = 0; k < square.size(); ++k)
			if (square[k] >= 0) take(square[k], int(k));
	};
	sortIntoBuckets(places.size(), each, begin, member);
	around.resize(places.size());
	for (std::size_t s = 0; s < places.size(); ++s)
		for (int k = 0; k < 9; ++k) {
			const int other = numberOf({ places[s].x + k % 3 - 1, places[s].y + k / 3 - 1 });
			around[s][k]    = other < 0 ? int(s) : other;
		}
}

void Regions::differences(int threads, const std::vector<Vector>& vectors, std::vector<double>& found)
{
	const long size = (long)around.size();
	extents.resize(size);
	found.resize(size);
#pragma omp parallel num_threads(threads)
	{
#pragma omp for schedule(static)
		for (long s = 0; s < size; ++s) {
			constexpr double all = std::numeric_limits<double>::infinity();
			Extent           e { all, all, -all, -all };
			for (int k = begin[s]; k < begin[s + 1]; ++k) {
				const Vector& v = vectors[member[k]];
				e               = { std::min(e.xMin, v.x), std::min(e.yMin, v.y), std::max(e.xMax, v.x),
					            std::max(e.yMax, v.y) };
			}
			extents[s] = e;
		}
#pragma omp for schedule(static)
		for (long s = 0; s < size; ++s) {
			Extent e = extents[s];
			for (const int other : around[s]) {
				const Extent& o = extents[other];
				e = { std::min(e.xMin, o.xMin), std::min(e.yMin, o.yMin), std::max(e.xMax, o.xMax),
				      std::max(e.yMax, o.yMax) };
			}
			found[s] = std::sqrt(
			        (e.xMax - e.xMin) * (e.xMax - e.xMin) + (e.yMax - e.yMin) * (e.yMax - e.yMin));
		}
	}
}

void Regions::largestAround(const std::vector<double>& values, std::vector<double>& found) const
{
	found.assign(around.size(), 0);
	for (std::size_t s = 0; s < around.size(); ++s)
		for (const int other : around[s])
			found[s] = std::max(found[s], values[other]);
}

} // namespace nonsmooth::neighbours
