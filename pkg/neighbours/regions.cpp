#include "regions.hpp"
#include "bucket_sort.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace nonsmooth::neighbours {

namespace {
	constexpr double farthest = 1 << 29; // squares from the origin; disks beyond share the last ones
}

void Regions::build(const std::vector<Disk>& disks, double width)
{
	const auto index = [width](double v) {
		return std::int32_t(std::clamp(std::floor(v / width), -farthest, farthest));
	};
	// numbers of squares by a hash, each in the first free place from there on
	std::uint32_t size = 16;
	while (size < 2 * disks.size())
		size *= 2;
	table.assign(size, -1);
	places.clear();
	const auto numberOf = [&](Place p) -> int& {
		std::uint32_t at = std::uint32_t(p.x) + 73856093u * std::uint32_t(p.y);
		while (table[at & (size - 1)] >= 0 && !(places[table[at & (size - 1)]] == p))
			++at;
		return table[at & (size - 1)];
	};
	square.assign(disks.size(), -1);
	for (std::size_t k = 0; k < disks.size(); ++k) {
		if (!isThere(disks[k])) continue;
		const Place p { index(disks[k].x), index(disks[k].y) };
		int&        number = numberOf(p);
		if (number < 0) {
			number = int(places.size());
			places.push_back(p);
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
