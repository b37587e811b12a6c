#include "disk_grid.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#ifdef _OPENMP
#include <omp.h>
#endif

namespace nonsmooth::neighbours {

namespace {
	constexpr int    mostLevels = 40; // sizes up to 1e12 apart
	constexpr double farthest   = 1 << 29; // cells from the origin; disks beyond share the last ones

	bool isThere(const Disk& d) { return d.r >= 0 && std::isfinite(d.x + d.y + d.r); }
}

DiskGrid::Cell DiskGrid::Level::cellOf(double x, double y) const
{
	const auto index = [this](double v) { return std::int32_t(std::clamp(std::floor(v / width), -farthest, farthest)); };
	return { index(x), index(y) };
}

/// Cells of a row stand side by side, so that three neighbours are one stretch of memory.
std::uint32_t DiskGrid::Level::bucketOf(Cell c) const { return (std::uint32_t(c.x) + 73856093u * std::uint32_t(c.y)) & mask; }

/// Calls `each` with the entries of a cell.
template <class F> void DiskGrid::Level::visit(Cell c, F&& each) const
{
	const std::uint32_t b = bucketOf(c);
	for (int k = bucket[b]; k < bucket[b + 1]; ++k)
		if (entries[k].cell == c) each(entries[k]);
}

/// Puts the entries into the order of their buckets, and by index within each.
void DiskGrid::Level::sort(std::vector<Entry>& from)
{
	std::uint32_t size = 16;
	while (size < 2 * entries.size())
		size *= 2;
	mask = size - 1;
	bucket.assign(size + 1, 0);
	for (Entry& e : entries) {
		e.cell = cellOf(e.x, e.y);
		++bucket[bucketOf(e.cell) + 1];
	}
	for (std::uint32_t b = 0; b < size; ++b)
		bucket[b + 1] += bucket[b];
	from.swap(entries);
	entries.resize(from.size());
	for (const Entry& e : from)
		entries[bucket[bucketOf(e.cell)]++] = e;
	// each bucket now ends where the next one began
	for (std::uint32_t b = size; b > 0; --b)
		bucket[b] = bucket[b - 1];
	bucket[0] = 0;
}

void DiskGrid::build(const std::vector<Disk>& disks, Reach wanted)
{
	reach          = wanted;
	count          = (int)disks.size();
	double smallest = std::numeric_limits<double>::infinity();
	for (const Disk& d : disks)
		if (isThere(d) && d.r > 0) smallest = std::min(smallest, d.r);
	for (Level& level : levels) {
		level.entries.clear();
		level.largest = 0;
	}
	for (int i = 0; i < count; ++i) {
		const Disk& d = disks[i];
		if (!isThere(d)) continue;
		const int size = d.r > smallest ? std::min(mostLevels - 1, std::ilogb(d.r / smallest)) : 0;
		if ((int)levels.size() <= size) levels.resize(size + 1);
		Level& level  = levels[size];
		level.largest = std::max(level.largest, d.r);
		level.entries.push_back({ d.x, d.y, d.r, {}, i });
	}
	for (Level& level : levels) {
		if (level.entries.empty()) continue;
		level.width = 2 * reach.factor * level.largest + reach.margin;
		if (!(level.width > 0)) level.width = 1; // points
		level.sort(spare);
	}
}

void DiskGrid::pairs(int threads, Pairs& found)
{
	parts.resize(std::max(1, threads));
	for (auto& part : parts)
		part.clear();
	for (size_t a = 0; a < levels.size(); ++a) {
		const Level& own = levels[a];
		const long   n   = (long)own.entries.size();
#pragma omp parallel num_threads(threads)
		{
#ifdef _OPENMP
			auto& part = parts[omp_get_thread_num()];
#else
			auto& part = parts[0];
#endif
#pragma omp for schedule(static)
			for (long k = 0; k < n; ++k) {
				const Entry& e = own.entries[k];
				for (size_t b = a; b < levels.size(); ++b) {
					const Level& other = levels[b];
					if (other.entries.empty()) continue;
					const Cell at = b == a ? e.cell : other.cellOf(e.x, e.y);
					for (std::int32_t dy = -1; dy <= 1; ++dy)
						for (std::int32_t dx = -1; dx <= 1; ++dx)
							other.visit({ at.x + dx, at.y + dy }, [&](const Entry& o) {
								if (b == a && o.disk <= e.disk) return;
								const double x = o.x - e.x, y = o.y - e.y, far = reach.factor * (e.r + o.r) + reach.margin;
								if (x * x + y * y < far * far) part.emplace_back(std::min(e.disk, o.disk), std::max(e.disk, o.disk));
							});
				}
			}
		}
	}
	found.begin.assign(count + 1, 0);
	size_t total = 0;
	for (const auto& part : parts) {
		total += part.size();
		for (const auto& [low, high] : part)
			++found.begin[low + 1];
	}
	for (int i = 0; i < count; ++i)
		found.begin[i + 1] += found.begin[i];
	found.second.resize(total);
	for (const auto& part : parts)
		for (const auto& [low, high] : part)
			found.second[found.begin[low]++] = high;
	for (int i = count; i > 0; --i)
		found.begin[i] = found.begin[i - 1];
	found.begin[0] = 0;
#pragma omp parallel for schedule(static) num_threads(threads)
	for (int i = 0; i < count; ++i)
		std::sort(found.second.begin() + found.begin[i], found.second.begin() + found.begin[i + 1]);
}

void DiskGrid::near(const Box& box, std::vector<int>& found) const
{
	found.clear();
	for (const Level& level : levels) {
		if (level.entries.empty()) continue;
		const auto inside = [&](const Entry& e) {
			const double out = reach.factor * e.r + reach.margin;
			if (e.x >= box.xMin - out && e.x <= box.xMax + out && e.y >= box.yMin - out && e.y <= box.yMax + out) found.push_back(e.disk);
		};
		const double out = reach.factor * level.largest + reach.margin;
		const Cell   low = level.cellOf(box.xMin - out, box.yMin - out), high = level.cellOf(box.xMax + out, box.yMax + out);
		const double cells = (double(high.x) - low.x + 1) * (double(high.y) - low.y + 1);
		if (cells < double(level.entries.size()))
			for (std::int32_t y = low.y; y <= high.y; ++y)
				for (std::int32_t x = low.x; x <= high.x; ++x)
					level.visit({ x, y }, inside);
		else
			for (const Entry& e : level.entries)
				inside(e);
	}
	std::sort(found.begin(), found.end());
}

} // namespace nonsmooth::neighbours
