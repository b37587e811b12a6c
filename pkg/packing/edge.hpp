// Edges of a region as walls of disks: whom an edge is near, and how it pushes.
//
// An edge has its inside on its left. Next to a convex corner (an angle of the region below 180°) it goes on as a line;
// at a reflex one the corner itself pushes, once, as the end of the edge before it. Lengths in m. Expressions are those
// of the packings made so far: their order decides the last bits.
#pragma once

#include <algorithm>
#include <cmath>

namespace nonsmooth::packing {

struct Edge {
	double startX, startY, directionX, directionY, length; // the direction is a unit vector
	bool   convexStart, convexEnd; // whether the region's angle there is convex
};

/// Where a point lies along an edge and off it, to the inside [m], from its start.
struct PlaceAtEdge {
	PlaceAtEdge(const Edge& e, double x, double y)
	        : dx(x - e.startX)
	        , dy(y - e.startY)
	        , along(dx * e.directionX + dy * e.directionY)
	        , off(dy * e.directionX - dx * e.directionY)
	{
	}
	double dx, dy, along, off;
};

/// Whether a disk has a gap below `margin` to an edge; also one that lies a little beyond it.
inline bool isNear(const Edge& e, double x, double y, double r, double margin)
{
	const PlaceAtEdge at(e, x, y);
	const double      reach = r + margin;
	return at.off < reach && at.off > -reach && at.along > -reach && at.along < e.length + reach;
}

/// How far a disk is in an edge [m], 0 where it is not, and the unit vector along which it is pushed out.
struct Push {
	double overlap, x, y;
};

inline Push pushOf(const Edge& e, double x, double y, double r)
{
	static constexpr double nearest = 1e-12; // of a corner to a centre: there it has no direction
	const PlaceAtEdge       at(e, x, y);
	const bool              before = at.along < 0 && !e.convexStart, after = at.along > e.length && !e.convexEnd;
	if (!before && !after) return { std::max(r - at.off, 0.0), -e.directionY, e.directionX };
	if (before || !(at.off > 0)) return { 0, 0, 0 }; // the corner belongs to the edge that ends there
	const double cx = at.dx - e.length * e.directionX, cy = at.dy - e.length * e.directionY,
	             distance = std::max(std::sqrt(cx * cx + cy * cy), nearest);
	return { std::max(r - distance, 0.0), cx / distance, cy / distance };
}

} // namespace nonsmooth::packing
