// Diffusion across a slip zone: finite volumes on one half of it (the other mirrors it), backward Euler.
//
//     ∂u/∂t = α ∂²u/∂y² ,   no flux at y = 0 (symmetry) and at the outer edge .
// Nodes are finest where the source ends, at |y| = h/2, and grow geometrically to both sides, out to h/2 + 6 √(α t)
// of the fastest of what diffuses. The step of one length h is linear, u* = (1 − h A)⁻¹ u: factors and unit responses
// are kept while h is. Unconditionally stable; error of first order in h (pressurization.hpp says what that makes of
// a strength).
// Units: m, s, m²/s.
#pragma once

#include <cstddef>
#include <vector>

namespace nonsmooth::contact::slip {

/// Nodes from the middle of a zone outwards.
struct Nodes {
	std::vector<double> width; // [m]
	std::size_t         inside = 0; // how many lie in the zone

	std::size_t count() const { return width.size(); }
	/// Distance [m] of a node's middle from that of the zone.
	double place(std::size_t node) const;
	/// Mean of a profile over the zone.
	double mean(const double* profile) const;
};

/// What diffusion is to resolve.
struct NodeSizes {
	double thickness = 0; // h [m]; 0 stands for a plane, which is the first node
	double finest    = 5e-5; // [m]
	double growth    = 1.4; // of a node over its neighbour nearer to the edge of the zone
	double reach     = 0; // beyond the zone [m]
};
Nodes nodesOf(const NodeSizes& sizes);

/// (1 − h A)⁻¹ for one diffusivity.
class Diffusion {
public:
	/// α [m²/s], 0 or more, and h [s].
	void prepare(const Nodes& nodes, double diffusivity, double h);
	/// u → u*, in place allowed.
	void apply(const double* u, double* after) const;

private:
	std::vector<double> lower, ratio, inverse; // of the factors of a tridiagonal matrix
};

} // namespace nonsmooth::contact::slip
