// A scalar field that is linear on each of some triangles, in time linear between given states.
//
//     p(x, t) = Σ N_i(x) p_i(t)      ∇p constant on each triangle
// N_i the linear shape functions. Points are found by a grid of cells, each of which knows the triangles that meet it.
// A point on an edge belongs to the triangle that comes first in the list, so that who finds it does not depend on the
// order of questions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace yade::nscd {

class TriangleField {
public:
	struct Node {
		double x, y;
	};
	using Triangle = std::array<int, 3>;
	struct Value {
		double value, x, y; // and the gradient along x and y
	};

	TriangleField() = default;
	/// Throws std::invalid_argument where a triangle has no area or names a node that there is not.
	TriangleField(std::vector<Node> nodes, std::vector<Triangle> triangles);

	std::size_t size() const { return nodes.size(); }
	/// The number of the triangle that a point is in; −1 outside.
	int find(double x, double y) const;
	/// Of the field with these values at the nodes, at a point of a triangle.
	Value at(int triangle, double x, double y, const std::vector<double>& values) const;

private:
	std::array<double, 3> shares(int triangle, double x, double y) const;
	int                   column(double x) const;
	int                   row(double y) const;

	std::vector<Node>     nodes;
	std::vector<Triangle> triangles;
	std::vector<double>   twice; // areas, with their signs
	std::vector<int>      first, inCells; // triangles by cell, one cell after the other
	double                left = 0, low = 0, cell = 1;
	int                   columns = 0, rows = 0;
};

} // namespace yade::nscd
