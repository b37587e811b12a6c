#include "close_pairs.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::packing {

void closePairs(
        const std::vector<neighbours::Disk>& disks, double margin, int threads, std::vector<int>& first,
        std::vector<int>& second)
{
	// the grid asks by squares and gets a little more, so that rounding loses none of those that the root decides
	constexpr double              more   = 1 + 1e-12;
	std::vector<neighbours::Disk> marked = disks;
	for (neighbours::Disk& d : marked)
		d.margin = std::max(margin, 0.0) * more;
	neighbours::DiskGrid grid;
	neighbours::Pairs    pairs;
	grid.build(marked, more);
	grid.pairs(threads, pairs);
	first.clear();
	second.clear();
	for (std::size_t i = 0; i < disks.size(); ++i)
		for (int k = pairs.begin[i]; k < pairs.begin[i + 1]; ++k) {
			const neighbours::Disk &a = disks[i], &b = disks[pairs.second[k]];
			const double            x = a.x - b.x, y = a.y - b.y;
			if (std::sqrt(x * x + y * y) < a.r + b.r + margin) {
				first.push_back(int(i));
				second.push_back(pairs.second[k]);
			}
		}
}

} // namespace nonsmooth::packing
