// Sums with the last bits of NumPy's (those of 1.24): of 8192 numbers at a time halves are summed apart, down to 128
// numbers, and those in eight sums side by side; what these stretches give is added in their order.
//
// Packings are kept by their bits, and those rest on sums that NumPy made.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace nonsmooth::packing {

/// Sum of `count` numbers.
double numpySum(const double* values, std::size_t count);

/// Sums of three numbers of each item, the same on any number of threads.
class TripleSum {
public:
	using Triple = std::array<double, 3>;
	Triple of(const std::vector<Triple>& items, int threads);

private:
	std::vector<Triple> sums; // of stretches
};

} // namespace nonsmooth::packing
