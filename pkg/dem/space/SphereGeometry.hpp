// Geometry of two spheres in the order of operations of Ig2_Sphere_Sphere_ScGeom, without what soft laws need.
#pragma once

#include "../seam/BodyState.hpp"

namespace yade::nscd {

struct SphereGeometry {
	Vector3r normal, point; // from the first to the second; the contact point [m]
	Real     depth; // by which they overlap [m]
};

inline SphereGeometry geometryOf(const BodyState& first, const BodyState& second)
{
	const Vector3r from = first.place(), way = second.place() - from;
	const Real     distance = way.norm();
	const Vector3r normal   = way / distance;
	const Real     depth    = first.radius + second.radius - distance;
	return { normal, from + (first.radius - 0.5 * depth) * normal, depth };
}

} // namespace yade::nscd
