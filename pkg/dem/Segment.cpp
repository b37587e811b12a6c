#include "Segment.hpp"
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
	/// Where a sphere's centre stands to a segment: distance vector from the nearest point and whose the contact is.
	struct SegmentNearest {
		Vector3r normal; // from the wall to the sphere
		Real     distance; // of the centre from the wall, negative behind a one-sided wall
		bool     owned;
	};

	inline SegmentNearest nearest(const Segment& segment, const State& state, const Vector3r& centre)
	{
		const Vector3r along = state.ori * Vector3r(1, 0, 0), up = state.ori * Vector3r(0, 1, 0);
		const Vector3r d = centre - state.pos;
		const Real     s = d.dot(along), m = d.dot(up), half = segment.halfLength;
		const bool     ownsEnd = segment.nextDirection != Vector3r::Zero(),
		           ownsStart   = segment.previousDirection != Vector3r::Zero();
		const bool inside      = (ownsStart ? s > -half : s >= -half) && (ownsEnd ? s < half : s <= half);

		SegmentNearest result;
		const int      side = segment.sense != 0 ? segment.sense : (m < 0 ? -1 : 1);
		result.normal       = side * up;
		result.distance     = side * m;
		result.owned        = inside;
		if (inside) return result;

		const bool     beyondEnd = s > 0;
		const Vector3r corner    = state.pos + (beyondEnd ? half : -half) * along;
		if (beyondEnd && ownsEnd) result.owned = (centre - corner).dot(state.ori * segment.nextDirection) < 0;
		else if (!beyondEnd && ownsStart)
			result.owned = (centre - corner).dot(state.ori * segment.previousDirection) > 0;
		else
			result.owned = beyondEnd ? !segment.hasNext : !segment.hasPrevious;
		if (result.owned) { // outside a convex corner or a free end: the corner itself is the nearest point
			const Vector3r out = centre - corner;
			if (segment.sense != 0 && out.dot(result.normal) < 0) {
				result.owned = false; // behind a one-sided wall there is nothing to touch
				return result;
			}
			result.distance = out.norm();
			if (result.distance > 0) result.normal = out / result.distance;
		}
		return result; // not owned: as if the segment went on, for bonds that live until they leave their ellipse
	}
}

bool Ig2_Segment_Sphere_ScGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto& segment = static_cast<const Segment&>(*shape1);
	const Real  radius  = static_cast<const Sphere&>(*shape2).radius;
	const auto  near    = nscd::nearest(segment, state1, state2.pos + shift2);
	const Real  gap     = near.distance - radius;
	if (!interaction->isReal() && !force) {
		if (!near.owned || gap > (interactionDetectionFactor - 1) * 2 * radius
		    || (segment.sense != 0 && near.distance < -radius))
			return false;
	}
	const bool              isNew = !interaction->geom;
	shared_ptr<SegmentGeom> geom;
	if (isNew) interaction->geom = geom = boost::make_shared<SegmentGeom>();
	else
		geom = YADE_PTR_CAST<SegmentGeom>(interaction->geom);
	geom->owned = near.owned;
	// both radii the sphere's, as the box functor does it
	geom->doIg2Work(
	        state2.pos + shift2 - near.normal * (radius + 0.5 * gap), -gap, radius, radius, state1, state2, scene,
	        interaction, near.normal, shift2, isNew, false);
	return true;
}

bool Ig2_Segment_Sphere_ScGeom::goReverse(
        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& segment, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	interaction->swapOrder();
	return go(segment, sphere, state2, state1, -shift2, force, interaction);
}

} // namespace yade
