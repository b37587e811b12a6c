#include "near_lists.hpp"
#include <utility>

namespace nonsmooth::packing {

NearLists::NearLists(std::vector<int> number_)
        : number(std::move(number_))
        , wideBegin(number.size() + 1)
        , narrowEnd(blocksOf(number.size()))
        , disks(number.size())
{
}

void NearLists::widen(const std::vector<Body>& bodies, double margin, int threads)
{
	for (std::size_t k = 0; k < bodies.size(); ++k)
		disks[k] = { bodies[k].x, bodies[k].y, bodies[k].r, margin };
	grid.build(disks, 1);
	grid.pairs(threads, pairs);
	bothWays();
	const int blocks = blocksOf(bodies.size());
	int       found  = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : found)
	for (int block = 0; block < blocks; ++block) {
		sortBlock(block);
		const BlockRange range(block, number.size());
		found = std::max(found, wideBegin[range.last] - wideBegin[range.first]);
	}
	most = found;
	narrowItem.resize(wideItem.size() + ahead);
	narrowSegment.resize(wideItem.size());
}

/// From pairs, each once, the neighbours of each body.
void NearLists::bothWays()
{
	const int count = int(number.size());
	next.assign(count, 0);
	for (const int j : pairs.second)
		++next[j];
	wideBegin[0] = 0;
	for (int k = 0; k < count; ++k) {
		const int own    = next[k] + pairs.begin[k + 1] - pairs.begin[k];
		next[k]          = wideBegin[k];
		wideBegin[k + 1] = wideBegin[k] + own;
	}
	wideItem.resize(wideBegin[count]);
	for (int i = 0; i < count; ++i)
		for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
			const int j         = pairs.second[p];
			wideItem[next[i]++] = j;
			wideItem[next[j]++] = i;
		}
	wideSegment.resize(wideItem.size());
}

/// Puts the neighbours of a block's bodies into their order.
void NearLists::sortBlock(int block)
{
	const BlockRange range(block, number.size());
	for (int k = range.first; k < range.last; ++k) {
		const auto begin = wideItem.begin() + wideBegin[k], end = wideItem.begin() + wideBegin[k + 1];
		std::sort(begin, end, [this](int a, int b) { return number[a] < number[b]; });
		for (int e = wideBegin[k]; e < wideBegin[k + 1]; ++e)
			wideSegment[e] = (unsigned char)segmentOf(k - range.first, number[wideItem[e]] > number[k]);
	}
}

void NearLists::narrow(const std::vector<Body>& bodies, double margin, int threads)
{
	const int blocks = blocksOf(bodies.size());
#pragma omp parallel for num_threads(threads) schedule(static)
	for (int block = 0; block < blocks; ++block) {
		const BlockRange range(block, bodies.size());
		int              to = wideBegin[range.first];
		for (int e = to; e < wideBegin[range.last]; ++e) {
			const Body & own = bodies[range.first + inBlock(wideSegment[e])], &other = bodies[wideItem[e]];
			const double x = own.x - other.x, y = own.y - other.y, far = own.r + other.r + margin;
			// what is not near is overwritten: no branch, which nobody could foresee
			narrowItem[to]    = wideItem[e];
			narrowSegment[to] = wideSegment[e];
			to += x * x + y * y < far * far;
		}
		narrowEnd[block] = to;
	}
}

} // namespace nonsmooth::packing
