// Nearest points of a triangle, a box and a plane to a point: where a sphere with its centre there can touch them.
//
// A triangle (a, b, c) with edges k = 0, 1, 2 from vertex k to vertex k + 1. The nearest point q of the triangle to p
// lies in its face where the foot of the perpendicular is inside of all three edges, else on an edge where its foot is
// between two vertices, else at a vertex (Voronoi regions; Ericson 2005, Real-Time Collision Detection, section 5.1.5).
// A foot that is inside by less than `edgeWidth` of the triangle's size counts as one on the edge, so that two
// triangles that share an edge never both have it in their faces.
// Units: m. Nothing here depends on the order in which a triangle's vertices are named but the numbers of its edges and
// vertices.
#pragma once

#include <algorithm>
#include <cmath>
#include <contact/space/vector.hpp>

namespace nonsmooth::contact::space {

/// Where on a body a nearest point lies.
struct Nearest {
	enum Feature { Face, Edge, Vertex };

	Vector  point;
	Feature feature = Face;
	int     place   = 0; // of the edge or the vertex
};

struct Triangle {
	Vector vertices[3];

	const Vector& at(int k) const { return vertices[k % 3]; }
};

constexpr double edgeWidth = 1e-9; // of the triangle's size

namespace detail {
	/// That of the three edges.
	inline Nearest nearestOnEdges(const Triangle& t, const Vector& p)
	{
		Nearest best;
		double  least = -1;
		for (int k = 0; k < 3; ++k) {
			const Vector from = t.at(k), along = t.at(k + 1) - from;
			const double length = dot(along, along), s = length > 0 ? dot(p - from, along) / length : 0;
			const bool   within = s > 0 && s < 1;
			const Vector q = within ? from + s * along : s <= 0 ? from : t.at(k + 1), out = p - q;
			const double square = dot(out, out);
			if (least >= 0 && !(square < least)) continue;
			least = square;
			best  = { q, within ? Nearest::Edge : Nearest::Vertex, within || s <= 0 ? k : (k + 1) % 3 };
		}
		return best;
	}
}

/// The nearest point of a triangle. One without an area is its longest edge.
inline Nearest nearest(const Triangle& t, const Vector& p)
{
	const Vector normal = cross(t.at(1) - t.at(0), t.at(2) - t.at(0));
	const double square = dot(normal, normal);
	if (!(square > 0)) return detail::nearestOnEdges(t, p);
	double depth
	        = square; // how far the foot is inside of the nearest edge, times that edge's length and twice the area
	for (int k = 0; k < 3; ++k)
		depth = std::min(depth, dot(cross(t.at(k + 1) - t.at(k), p - t.at(k)), normal));
	if (!(depth > edgeWidth * square)) return detail::nearestOnEdges(t, p);
	return { p - dot(p - t.at(0), normal) / square * normal, Nearest::Face, 0 };
}

/// What a sphere's centre is to a body: distance, negative inside, and the direction from the body to it.
struct Aside {
	double distance;
	Vector normal;
};

/// Of a box with these half sizes, for a point in its own frame. Inside, the nearest face pushes.
inline Aside asideOfBox(const Vector& half, const Vector& p)
{
	const double halves[] = { half.x, half.y, half.z }, at[] = { p.x, p.y, p.z };
	double       out[3];
	int          axis = 0; // of the nearest face, for a point inside
	for (int k = 0; k < 3; ++k) {
		out[k] = at[k] - std::max(-halves[k], std::min(halves[k], at[k]));
		if (halves[k] - std::abs(at[k]) < halves[axis] - std::abs(at[axis])) axis = k;
	}
	const Vector away { out[0], out[1], out[2] };
	if (const double far = std::sqrt(dot(away, away)); far > 0) return { far, 1 / far * away };
	const double side = at[axis] < 0 ? -1 : 1;
	return { std::abs(at[axis]) - halves[axis],
		 { axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0 } };
}

/// Of a plane across an axis, for a point at `offset` [m] from it along that axis. `sense`: the side that acts, 0 both.
/// One-sided, it also pushes back what is behind it.
inline Aside asideOfPlane(int axis, int sense, double offset)
{
	const double side = sense != 0 ? sense : (offset < 0 ? -1 : 1);
	return { side * offset, { axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0 } };
}

} // namespace nonsmooth::contact::space
