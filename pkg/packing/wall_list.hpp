// Which bodies are near which edges of the region.
//
// Whether an edge pushes a body that lies beyond it, or beside its end, depends on the body being in the list: so the
// list decides bits, and is made anew exactly when the caller says so. Since an edge may have a million bodies to ask,
// they are asked among `candidates`, which are found more seldom.
#pragma once

#include <packing/body.hpp>
#include <packing/edge.hpp>
#include <vector>

namespace nonsmooth::packing {

/// Edges, and on which bodies they act (by the caller's numbers; empty: on all).
struct Border {
	std::vector<Edge> edges;
	std::vector<char> acts;
};

class WallList {
public:
	struct Pair {
		int body, edge; // bodies ascending, edges of each as well
	};
	/// `number` by body, as the borders have it.
	WallList(const std::vector<Border>& borders, const std::vector<int>& number);
	/// Finds those that can come as near as `margin` [m] before the next call.
	void findCandidates(const std::vector<Body>& bodies, double margin, int threads);
	/// Takes the candidates with a gap below `margin` [m].
	void choose(const std::vector<Body>& bodies, double margin);
	/// Pairs of a block's bodies.
	const Pair* begin(int block) const { return pairs.data() + blockBegin[block]; }
	const Pair* end(int block) const { return pairs.data() + blockBegin[block + 1]; }
	const Edge& edge(int k) const { return edges[k]; }

private:
	std::vector<Edge>              edges; // of all borders
	std::vector<std::vector<char>> acts; // by border, on which bodies; empty: on all
	std::vector<int>               border; // of each edge
	std::vector<Pair>              candidates, pairs;
	std::vector<int>               blockBegin;
	bool                           doesAct(int edge, int body) const;
};

} // namespace nonsmooth::packing
