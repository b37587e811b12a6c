// Contact of two disks: where it is, how wide its gap, and the levers of its impulses.
//
// With x the centres, r the radii, d = x₂ − x₁:
//     n = d/|d| ,   g = |d| − (r₁ + r₂) ,   x_c = x₁ + (r₁ + g/2) n ,   λt₁ = r₁ + g/2 ,   λt₂ = −(r₂ + g/2) ,   λn = 0
// (levers as in contact/plane/problem.hpp). Sign: n from the first disk to the second; a gap is positive, an overlap
// negative. Units: m. The contact lies midway between the two surfaces, so that both bodies are turned by one and the
// same force. Bits: as Ig2_Sphere_Sphere_ScGeom.
#pragma once

#include <cmath>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact::plane {

struct DiskContact {
	double nx, ny; // unit normal, the first disk's outward
	double gap; // [m]
	double distance; // of the centres [m]
	Point  point; // [m]
};

/// `dz`: how far the second centre lies above the first one [m], for spheres that are not exactly in one plane; n and
/// x_c are their parts in it. Centres that coincide have no normal: its components are not numbers then.
inline DiskContact diskContact(const Point& x1, const Point& x2, double r1, double r2, double dz = 0)
{
	const double dx = x2.x - x1.x, dy = x2.y - x1.y, distance = std::sqrt(dx * dx + (dy * dy + dz * dz));
	const double nx = dx / distance, ny = dy / distance, overlap = r1 + r2 - distance, arm = r1 - 0.5 * overlap;
	return { nx, ny, -overlap, distance, { x1.x + arm * nx, x1.y + arm * ny } };
}

/// Sets the bodies, directions and levers of a contact from disk i to disk j, whose radii are ri and rj [m]; the rest
/// is left as it is.
inline void setDiskFrame(Contact& c, int i, int j, double nx, double ny, double ri, double rj, double gap)
{
	c.i       = i;
	c.j       = j;
	c.nx      = nx;
	c.ny      = ny;
	c.leverNi = c.leverNj = 0;
	c.leverTi             = ri + 0.5 * gap;
	c.leverTj             = -(rj + 0.5 * gap);
}

} // namespace nonsmooth::contact::plane
