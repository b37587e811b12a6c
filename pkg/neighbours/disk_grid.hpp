// Which disks are near each other, and which are near a box: a grid for disks of any sizes, in time and memory that
// grow with their number.
//
// Disks are sorted into levels by size, each a factor of two, and each level has a grid of its own, whose cells are as
// wide as its largest disks. A pair is looked for in the grid of the larger of the two, in the cells that the smaller
// reaches. Cells are kept by a hash, so the plane has no bounds, and one disk that has fallen far costs nothing. What
// is found does not depend on the number of threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <neighbours/cell.hpp>
#include <utility>
#include <vector>

namespace nonsmooth::neighbours {

/// A disk in the plane [m], with its margin; it is left out where its radius is negative or a number is not finite.
struct Disk {
	double x, y, r, margin = 0;
};

/// Whether a disk is one that can be near others.
inline bool isThere(const Disk& d) { return d.r >= 0 && std::isfinite(d.x + d.y + d.r + d.margin); }

/// Corners [m]; they may be infinite.
struct Box {
	double xMin, yMin, xMax, yMax;
};

/// Whether a point is in the box, extended by `out` [m] on all sides.
inline bool isNear(const Box& box, double x, double y, double out)
{
	return x >= box.xMin - out && x <= box.xMax + out && y >= box.yMin - out && y <= box.yMax + out;
}

/// Pairs (i, second[k]) for k from begin[i] to begin[i + 1], with i < second[k], ascending.
struct Pairs {
	std::vector<int> begin, second;
};

class DiskGrid {
public:
	/// Sorts the disks in; their index is their place in the list.
	void build(const std::vector<Disk>& disks, double factor);
	/// All pairs of disks whose distance is below `factor` times the sum of their radii, plus the smaller of their
	/// margins.
	void pairs(int threads, Pairs& found);
	/// Indices, ascending, of the disks whose centres are in the box, extended by `factor` times their radius plus
	/// `margin` [m] on all sides.
	void near(const Box& box, double factor, double margin, std::vector<int>& found) const;

private:
	struct Entry {
		double x, y, r, margin;
		Cell   cell;
		int    disk;
	};
	/// Disks of one range of sizes by cells; entries of bucket b lie from bucket[b] to bucket[b + 1].
	struct Level {
		double                  largest = 0, width = 0; // of its disks' radii, of a cell
		std::vector<Entry>      entries;
		std::vector<int>        bucket;
		std::uint32_t           mask = 0;
		template <class F> void visit(const Box& box, F&& each) const;
		void                    sort(std::vector<Entry>& spare);
	};
	std::vector<Level>                            levels;
	std::vector<Entry>                            spare;
	void                                          sortPairs(int threads, Pairs& found);
	std::vector<std::vector<std::pair<int, int>>> parts; // found by each thread
	std::vector<std::vector<int>> next; // by thread and first disk: where the next pair of theirs goes
	double                        factor = 1;
	int                           count  = 0;
};

} // namespace nonsmooth::neighbours
