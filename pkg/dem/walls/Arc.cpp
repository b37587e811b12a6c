#include "Arc.hpp"
#include "WallJoints.hpp"
#include <core/Aabb.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Arc)(Bo1_Arc_Aabb)(Ig2_Arc_Sphere_ScGeom));

namespace {
	/// Direction of a vector in the arc's own frame, counter-clockwise from its middle, from −π to π.
	Real angleOf(const Vector3r& d, const Quaternionr& orientation)
	{
		const Vector3r here = orientation.conjugate() * d;
		return std::atan2(here[1], here[0]);
	}
}

void Bo1_Arc_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	const auto& arc = static_cast<const Arc&>(*shape);
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	Vector3r   low = Vector3r::Constant(std::numeric_limits<Real>::max()), high = -low;
	const auto take = [&](const Vector3r& d) {
		low  = low.cwiseMin(arc.radius * d);
		high = high.cwiseMax(arc.radius * d);
	};
	for (const Real angle : { -arc.halfAngle, arc.halfAngle })
		take(se3.orientation * Vector3r(std::cos(angle), std::sin(angle), 0));
	for (const Vector3r& d : { Vector3r(1, 0, 0), Vector3r(0, 1, 0), Vector3r(-1, 0, 0), Vector3r(0, -1, 0) })
		if (std::abs(angleOf(d, se3.orientation)) <= arc.halfAngle) take(d);
	auto& aabb = static_cast<Aabb&>(*bound);
	aabb.min   = se3.position + low;
	aabb.max   = se3.position + high;
}

namespace nscd {
	inline WallNearest
	nearest(const Arc& arc, const State& state, const WallEnds& ends, const Vector3r& centre, Real radius)
	{
		const Vector3r d        = centre - state.pos;
		const Real     distance = d.norm(), m = arc.radius - distance; // inside positive
		const int      side = arc.sense != 0 ? arc.sense : (m < 0 ? -1 : 1);
		const Vector3r up   = distance > 0 ? Vector3r(-d / distance) : Vector3r(state.ori * Vector3r(-1, 0, 0));
		WallNearest    result { side * up, side * m, true };
		const Real     path = arc.radius - side * radius; // radius of the centre's circle
		if (path > 0) result.curvature = side / path;
		const Real angle = angleOf(d, state.ori), half = arc.halfAngle;
		if (half >= Mathr::PI) return result;
		if ((ends[0].isFirst ? angle > -half : angle >= -half)
		    && (ends[1].isFirst ? angle < half : angle <= half))
			return result;
		const bool     beyondEnd = angle > 0;
		const Vector3r tip       = state.ori
		        * Vector3r(std::cos(half), beyondEnd ? std::sin(half) : -std::sin(half), 0);
		result.normal = -side * tip; // of the end, which tells what is behind
		takeEnd(ends[beyondEnd], d - arc.radius * tip, arc.sense, radius, result);
		if (!result.owned) result.normal = side * up;
		return result;
	}
}

bool Ig2_Arc_Sphere_ScGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto& arc    = static_cast<const Arc&>(*shape1);
	const Real  radius = static_cast<const Sphere&>(*shape2).radius;
	const auto& ends   = nscd::WallJoints::of(*scene).endsOf(*scene, interaction->getId1(), force);
	const auto  near   = nscd::nearest(arc, state1, ends, state2.pos + shift2, radius);
	return nscd::setWallGeom(
	        near, arc.sense, radius, interactionDetectionFactor, state1, state2, shift2, force, scene, interaction);
}

bool Ig2_Arc_Sphere_ScGeom::goReverse(
        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& arc, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	interaction->swapOrder();
	return go(arc, sphere, state2, state1, -shift2, force, interaction);
}

} // namespace yade
