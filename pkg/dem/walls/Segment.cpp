#include "Segment.hpp"
#include "WallJoints.hpp"
#include <core/Aabb.hpp>
#include <boost/make_shared.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Segment)(Bo1_Segment_Aabb)(SegmentGeom)(Ig2_Segment_Sphere_ScGeom));

void Bo1_Segment_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	const auto* segment = static_cast<const Segment*>(shape.get());
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	auto*          aabb = static_cast<Aabb*>(bound.get());
	const Vector3r half = se3.orientation * Vector3r(segment->halfLength, 0, 0);
	aabb->min           = se3.position - half.cwiseAbs();
	aabb->max           = se3.position + half.cwiseAbs();
}

namespace nscd {
	inline WallNearest
	nearest(const Segment& segment, const State& state, const WallEnds& ends, const Vector3r& centre, Real radius)
	{
		const Vector3r along = state.ori * Vector3r(1, 0, 0), up = state.ori * Vector3r(0, 1, 0);
		const Vector3r d = centre - state.pos;
		const Real     s = d.dot(along), m = d.dot(up), half = segment.halfLength;
		const int      side = segment.sense != 0 ? segment.sense : (m < 0 ? -1 : 1);
		WallNearest    result { side * up, side * m, true };
		if ((ends[0].isFirst ? s > -half : s >= -half) && (ends[1].isFirst ? s < half : s <= half))
			return result;
		const bool beyondEnd = s > 0;
		takeEnd(ends[beyondEnd], centre - (state.pos + (beyondEnd ? half : -half) * along), segment.sense,
		        radius, result);
		return result;
	}

	void takeEnd(const WallEnd& end, const Vector3r& out, int sense, Real radius, WallNearest& result)
	{
		// not owned: as if the wall went on, for bonds that live until they leave their ellipse; behind a
		// one-sided wall there is nothing to touch
		result.owned = end.owns(out, radius) && !(sense != 0 && out.dot(result.normal) < 0);
		if (!result.owned) return;
		// outside a convex corner or a free end: the corner itself is the nearest point
		result.curvature = 0;
		result.distance  = out.norm();
		if (result.distance > 0) result.normal = out / result.distance;
	}

	bool setWallGeom(
	        const WallNearest& near, int sense, Real radius, Real factor, const State& wall, const State& sphere,
	        const Vector3r& shift, bool force, Scene* scene, const shared_ptr<Interaction>& interaction)
	{
		const Real gap = near.distance - radius;
		if (!interaction->isReal() && !force) {
			if (!near.owned || gap > (factor - 1) * 2 * radius || (sense != 0 && near.distance < -radius))
				return false;
		}
		const bool              isNew = !interaction->geom;
		shared_ptr<SegmentGeom> geom;
		if (isNew) interaction->geom = geom = boost::make_shared<SegmentGeom>();
		else
			geom = YADE_PTR_CAST<SegmentGeom>(interaction->geom);
		geom->owned     = near.owned;
		geom->curvature = near.curvature;
		// both radii the sphere's, as the box functor does it
		geom->doIg2Work(
		        sphere.pos + shift - near.normal * (radius + 0.5 * gap), -gap, radius, radius, wall, sphere,
		        scene, interaction, near.normal, shift, isNew, false);
		return true;
	}
}

bool Ig2_Segment_Sphere_ScGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto& segment = static_cast<const Segment&>(*shape1);
	const Real  radius  = static_cast<const Sphere&>(*shape2).radius;
	const auto& ends    = nscd::WallJoints::of(*scene).endsOf(*scene, interaction->getId1(), force);
	const auto  near    = nscd::nearest(segment, state1, ends, state2.pos + shift2, radius);
	return nscd::setWallGeom(
	        near, segment.sense, radius, interactionDetectionFactor, state1, state2, shift2, force, scene,
	        interaction);
}

bool Ig2_Segment_Sphere_ScGeom::goReverse(
        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& segment, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	interaction->swapOrder();
	return go(segment, sphere, state2, state1, -shift2, force, interaction);
}

} // namespace yade
