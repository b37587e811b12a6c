// All pairs of disks with a gap below a margin.
#pragma once

#include <neighbours/disk_grid.hpp>
#include <vector>

namespace nonsmooth::packing {

/// Pairs (i, j), i < j, of disks with √((x_i − x_j)² + (y_i − y_j)²) < r_i + r_j + `margin` [m], with the bits of this
/// expression, by i and then by j.
void closePairs(
        const std::vector<neighbours::Disk>& disks, double margin, int threads, std::vector<int>& first,
        std::vector<int>& second);

} // namespace nonsmooth::packing
