// An order of points in which near ones stand near each other.
//
// Strips across the longer side of all, one after the other, and points in each along it: the neighbours of points that
// follow each other are three such rows, of the same strip and of those beside it, which memory can bring as they come.
#pragma once

#include <vector>

namespace nonsmooth::packing {

/// Numbers of `count` points (x, y) [m] in that order, strips `width` wide [m].
std::vector<int> spaceOrder(const double* x, const double* y, int count, double width);

} // namespace nonsmooth::packing
