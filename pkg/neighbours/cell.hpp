// Square cells of the plane, and their places in a table. The plane has no bounds: cells are kept by a hash.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nonsmooth::neighbours {

struct Cell {
	std::int32_t x, y;
	bool         operator==(const Cell& o) const { return x == o.x && y == o.y; }
};

/// The cell in which a point lies where cells are `width` wide [m]. Those farther than 2²⁹ cells from the origin share
/// the last ones.
inline Cell cellAt(double x, double y, double width)
{
	static constexpr double farthest = 1 << 29;
	const auto              index    = [width](double v) {
                return std::int32_t(std::clamp(std::floor(v / width), -farthest, farthest));
	};
	return { index(x), index(y) };
}

/// Cells of a row follow each other, so that neighbours in it are one stretch of a table.
inline std::uint32_t hashOf(Cell c) { return std::uint32_t(c.x) + 73856093u * std::uint32_t(c.y); }

/// A power of two, of which so many items fill half at most.
inline std::uint32_t tableSize(std::size_t items)
{
	std::uint32_t size = 16;
	while (size < 2 * items)
		size *= 2;
	return size;
}

} // namespace nonsmooth::neighbours
