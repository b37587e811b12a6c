#include "wall_list.hpp"
#include <neighbours/thread_part.hpp>

namespace nonsmooth::packing {

WallList::WallList(const std::vector<Border>& borders, const std::vector<int>& number)
        : blockBegin(blocksOf(number.size()) + 1)
{
	for (const Border& one : borders) {
		edges.insert(edges.end(), one.edges.begin(), one.edges.end());
		border.resize(edges.size(), int(acts.size()));
		acts.emplace_back();
		if (one.acts.empty()) continue;
		for (const int k : number)
			acts.back().push_back(one.acts[k]);
	}
}

bool WallList::doesAct(int edge, int body) const
{
	const auto& on = acts[border[edge]];
	return on.empty() || on[body];
}

void WallList::findCandidates(const std::vector<Body>& bodies, double margin, int threads)
{
	const int                      count = int(bodies.size()), all = int(edges.size());
	std::vector<std::vector<Pair>> parts(threads);
#pragma omp parallel num_threads(threads)
	{
		std::vector<Pair> own;
#pragma omp for schedule(static) // each thread a stretch, one after the other
		for (int k = 0; k < count; ++k)
			for (int e = 0; e < all; ++e)
				if (isNear(edges[e], bodies[k].x, bodies[k].y, bodies[k].r, margin) && doesAct(e, k))
					own.push_back({ k, e });
		neighbours::partOfThread(parts) = std::move(own);
	}
	candidates.clear();
	for (const auto& part : parts)
		candidates.insert(candidates.end(), part.begin(), part.end());
}

void WallList::choose(const std::vector<Body>& bodies, double margin)
{
	pairs.clear();
	int block = 0;
	for (const Pair& c : candidates) {
		const Body& b = bodies[c.body];
		if (!isNear(edges[c.edge], b.x, b.y, b.r, margin)) continue;
		for (; block <= c.body / blockSize; ++block)
			blockBegin[block] = int(pairs.size());
		pairs.push_back(c);
	}
	for (; block < int(blockBegin.size()); ++block)
		blockBegin[block] = int(pairs.size());
}

} // namespace nonsmooth::packing
