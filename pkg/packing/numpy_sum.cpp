#include "numpy_sum.hpp"
#include <algorithm>

namespace nonsmooth::packing {

namespace {
	constexpr std::size_t lanes = 8, leaf = 128, stretch = 8192; // as NumPy has them

	/// Of numbers that lie `stride` apart, at most as many as a leaf has.
	double leafSum(const double* values, std::size_t count, std::size_t stride)
	{
		std::size_t k   = 0;
		double      sum = 0;
		if (count >= lanes) {
			double s[lanes] = {};
			for (; k + lanes <= count; k += lanes)
				for (std::size_t l = 0; l < lanes; ++l)
					s[l] += values[(k + l) * stride];
			sum = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
		}
		for (; k < count; ++k)
			sum += values[k * stride];
		return sum;
	}

	double pairwise(const double* values, std::size_t count, std::size_t stride)
	{
		if (count <= leaf) return leafSum(values, count, stride);
		const std::size_t half = count / 2 / lanes * lanes;
		return pairwise(values, half, stride) + pairwise(values + half * stride, count - half, stride);
	}
} // namespace

double numpySum(const double* values, std::size_t count)
{
	double sum = 0;
	for (std::size_t first = 0; first < count; first += stretch)
		sum += pairwise(values + first, std::min(stretch, count - first), 1);
	return sum;
}

TripleSum::Triple TripleSum::of(const std::vector<Triple>& items, int threads)
{
	sums.resize((items.size() + stretch - 1) / stretch);
	const long all = long(sums.size());
#pragma omp parallel for num_threads(threads) schedule(static)
	for (long p = 0; p < all; ++p) {
		const std::size_t first = std::size_t(p) * stretch, count = std::min(stretch, items.size() - first);
		for (std::size_t q = 0; q < 3; ++q)
			sums[p][q] = pairwise(items[first].data() + q, count, 3);
	}
	Triple sum {};
	for (const Triple& part : sums)
		for (std::size_t q = 0; q < 3; ++q)
			sum[q] += part[q];
	return sum;
}

} // namespace nonsmooth::packing
