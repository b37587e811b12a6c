#include "disk_grid.hpp"
#include "bucket_sort.hpp"
#include <algorithm>
#include <limits>
#include <neighbours/thread_part.hpp>
#include <utility>

namespace nonsmooth::neighbours {

namespace {
	constexpr int mostLevels = 40; // sizes up to 1e12 apart
}

/// Calls `each` with the entries of all cells that a box touches, and perhaps with others.
template <class F> void DiskGrid::Level::visit(const Box& box, F&& each) const
{
	const Cell   low = cellAt(box.xMin, box.yMin, width), high = cellAt(box.xMax, box.yMax, width);
	const double cells = (double(high.x) - low.x + 1) * (double(high.y) - low.y + 1);
	if (!(cells < double(entries.size()))) { // or something is not a number
		for (const Entry& e : entries)
			each(e);
		return;
	}
	if (high.x < low.x) return;
	for (std::int32_t y = low.y; y <= high.y; ++y) {
		// a row, from where it begins to where the table ends, and on from where that begins
		const std::uint32_t first  = hashOf({ low.x, y }) & mask,
		                    length = std::uint32_t(high.x) - std::uint32_t(low.x) + 1,
		                    inOne  = std::min(length, mask + 1 - first);
		for (const auto& [begin, end] : { std::pair(first, first + inOne), std::pair(0u, length - inOne) })
			for (int k = bucket[begin]; k < bucket[end]; ++k)
				if (entries[k].cell.y == y) each(entries[k]);
	}
}

/// Puts the entries into the order of their buckets, and by index within each.
void DiskGrid::Level::sort(std::vector<Entry>& from)
{
	const std::uint32_t size = tableSize(entries.size());
	mask                     = size - 1;
	for (Entry& e : entries)
		e.cell = cellAt(e.x, e.y, width);
	from.swap(entries);
	const auto each = [&](auto take) {
		for (const Entry& e : from)
			take(hashOf(e.cell) & mask, e);
	};
	sortIntoBuckets(size, each, bucket, entries);
}

void DiskGrid::build(const std::vector<Disk>& disks, double factor_)
{
	factor          = factor_;
	count           = (int)disks.size();
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
		level.entries.push_back({ d.x, d.y, d.r, d.margin, {}, i });
	}
	for (Level& level : levels) {
		if (level.entries.empty()) continue;
		level.width = 2 * factor * level.largest;
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
			auto part = std::move(
			        partOfThread(parts)); // which lie side by side, and would share a cache line
#pragma omp for schedule(dynamic, 256)
			for (long k = 0; k < n; ++k) {
				const Entry& e = own.entries[k];
				for (size_t b = a; b < levels.size(); ++b) {
					const Level& other = levels[b];
					if (other.entries.empty()) continue;
					const double out  = factor * (e.r + other.largest) + e.margin;
					const auto   take = [&](const Entry& o, bool isAfter) {
                                                const double x = o.x - e.x, y = o.y - e.y,
                                                             far = factor * (e.r + o.r) + std::min(e.margin, o.margin);
                                                // both, since neither can be told ahead
                                                if (isAfter & (x * x + y * y < far * far))
                                                        part.emplace_back(
							          std::min(e.disk, o.disk), std::max(e.disk, o.disk));
					};
					// of its own level, those in the rows below find it
					if (b == a)
						other.visit(
						        { e.x - out, e.y, e.x + out, e.y + out }, [&](const Entry& o) {
							        const bool above  = o.cell.y > e.cell.y,
							                   beside = o.cell.y == e.cell.y;
							        take(o, above | (beside & (o.disk > e.disk)));
						        });
					else
						other.visit(
						        { e.x - out, e.y - out, e.x + out, e.y + out },
						        [&](const Entry& o) { take(o, true); });
				}
			}
			partOfThread(parts) = std::move(part);
		}
	}
	sortPairs(threads, found);
}

/// Puts the pairs that threads have found into the order of their first disks, then of their second ones.
void DiskGrid::sortPairs(int threads, Pairs& found)
{
	const long all = (long)parts.size();
	next.resize(all);
	found.begin.resize(count + 1);
#pragma omp parallel num_threads(threads)
	{
#pragma omp for schedule(static, 1)
		for (long p = 0; p < all; ++p) {
			next[p].assign(count, 0);
			for (const auto& pair : parts[p])
				++next[p][pair.first];
		}
#pragma omp single
		{
			int place = 0;
			for (int i = 0; i < count; ++i) {
				found.begin[i] = place;
				for (auto& n : next)
					place += std::exchange(n[i], place);
			}
			found.begin[count] = place;
			found.second.resize(place);
		}
#pragma omp for schedule(static, 1)
		for (long p = 0; p < all; ++p)
			for (const auto& [low, high] : parts[p])
				found.second[next[p][low]++] = high;
#pragma omp for schedule(static)
		for (int i = 0; i < count; ++i)
			std::sort(found.second.begin() + found.begin[i], found.second.begin() + found.begin[i + 1]);
	}
}

void DiskGrid::near(const Box& box, double reach, double margin, std::vector<int>& found) const
{
	found.clear();
	for (const Level& level : levels) {
		if (level.entries.empty()) continue;
		const double out = reach * level.largest + margin;
		level.visit({ box.xMin - out, box.yMin - out, box.xMax + out, box.yMax + out }, [&](const Entry& e) {
			if (isNear(box, e.x, e.y, reach * e.r + margin)) found.push_back(e.disk);
		});
	}
	std::sort(found.begin(), found.end());
}

} // namespace nonsmooth::neighbours
