#include "regions.hpp"
#include "bucket_sort.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace nonsmooth::neighbours {

namespace {
	constexpr double farthest = 1 << 29; // squares from the origin; disks beyond share the last ones
}

void Regions::build(const std::vector<Disk>& disks, double width)
{
	const auto index = [width](double v) {
		return std::int64_t(std::clamp(std::floor(v / width), -farthest, farthest));
	};
	const auto keyOf = [](std::int64_t x, std::int64_t y) { return (std::int64_t(1) << 32) * x + y; };
	std::unordered_map<std::int64_t, int>              numbers;
	std::vector<std::pair<std::int64_t, std::int64_t>> places;
	square.assign(disks.size(), -1);
	for (std::size_t k = 0; k < disks.size(); ++k) {
		if (!isThere(disks[k])) continue;
		const std::int64_t x = index(disks[k].x), y = index(disks[k].y);
		const auto [at, isNew] = numbers.try_emplace(keyOf(x, y), int(places.size()));
		if (isNew) places.emplace_back(x, y);
		square[k] = at->second;
	}
	const auto each = [this](auto take) {
		for (std::size_t k = 0; k < square.size(); ++k)
			if (square[k] >= 0) take(square[k], int(k));
	};
	sortIntoBuckets(places.size(), each, begin, member);
	around.resize(places.size());
	for (std::size_t s = 0; s < places.size(); ++s)
		for (int k = 0; k < 9; ++k) {
			const auto at = numbers.find(keyOf(places[s].first + k % 3 - 1, places[s].second + k / 3 - 1));
			around[s][k]  = at == numbers.end() ? int(s) : at->second;
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
