#include "space_order.hpp"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace nonsmooth::packing {

std::vector<int> spaceOrder(const double* x, const double* y, int count, double width)
{
	if (count == 0) return {};
	const auto          xs = std::minmax_element(x, x + count), ys = std::minmax_element(y, y + count);
	const bool          wide   = *xs.second - *xs.first >= *ys.second - *ys.first;
	const double *const across = wide ? x : y, *const along = wide ? y : x;
	std::vector<std::tuple<double, double, int>> keys;
	for (int k = 0; k < count; ++k)
		keys.emplace_back(std::floor(across[k] / width), along[k], k);
	std::sort(keys.begin(), keys.end());
	std::vector<int> order;
	for (const auto& key : keys)
		order.push_back(std::get<2>(key));
	return order;
}

} // namespace nonsmooth::packing
