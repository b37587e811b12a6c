// A wall along a circle, inside or outside, exact: bowls, drums, rollers.
//
// With c the sphere's centre as seen from that of the circle, d = |c|, R the arc's radius, r the sphere's:
//     inside:  gap = R − d − r ,  n = −c/d        outside:  gap = d − R − r ,  n = c/d .
// While it touches, the sphere's centre goes along a circle of radius D = R − r or R + r. A step is a straight line; so
// that it ends on this circle again, the condition on the normal velocity of the step's end is, with w the path across
// n,
//     U_n ≥ −gap/h ± (D − √(D² − w²))/h      (+ inside, − outside) ,
// which ContactDynamicsEngine takes from SegmentGeom::curvature = ±1/D. Chords of a circle turn the velocity without
// changing its size, so that neither a swing in a bowl nor a disk that rolls around a drum loses energy to the steps.
// Sign and sides: as Segment, for an arc that is travelled counter-clockwise: + is the inside. The body's position is
// the circle's centre, so that a drum turns by its angular velocity alone.
#pragma once

#include "Segment.hpp"
#include <lib/high-precision/Constants.hpp>

namespace yade {

class Arc : public Shape {
public:
	virtual ~Arc() = default;
	/// A script has set a number: refused at once, since no disk could touch a wall of it.
	void postLoad(Arc&) const
	{
		nscd::require(radius > 0 && nscd::isNumber(radius), "Arc", "radius", radius, "positive and finite [m]");
		nscd::require(
		        halfAngle > 0 && halfAngle <= Mathr::PI * (1 + 1e-12), "Arc", "halfAngle", halfAngle,
		        "more than 0 and at most π [rad]");
		nscd::require(sense >= -1 && sense <= 1, "Arc", "sense", sense, "1, -1 or 0, the side that acts");
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Arc,Shape,
R"""(Part of a circle in the x-y plane, or all of it, as a wall: the body's position is the centre of the circle, its local x axis points to the middle of the arc.
Ends that meet those of :yref:`segments<Segment>` or other arcs are joints, see :yref:`Segment`. Spheres inside must be smaller than the circle. See :yref:`yade.nonsmooth.scene.arc`.)""",
		((Real,radius,1,Attr::triggerPostLoad,"Radius of the circle [m]."))
		((Real,halfAngle,Mathr::PI,Attr::triggerPostLoad,"Half of the angle of the arc [rad]; π: the whole circle, which has no ends."))
		((int,sense,1,Attr::triggerPostLoad,"Side that acts: 1 the inside, −1 the outside, 0 both. A one-sided arc also pushes back a sphere "
		        "whose centre is behind it by less than its radius."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(Arc, Shape);
};
REGISTER_SERIALIZABLE(Arc);

class Bo1_Arc_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override;
	FUNCTOR1D(Arc);
	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_Arc_Aabb,BoundFunctor,"Make or update the :yref:`Aabb` of an :yref:`Arc`. All spheres in it are looked at in each step: cut "
	        "an arc that is large beside many of them into pieces.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_Arc_Aabb);

namespace nscd {
	/// Whether a point is surely farther than `reach` [m] from an arc with its centre there.
	inline bool isBeyond(
	        Real reach, const Arc& arc, const nonsmooth::contact::Point& centre,
	        const nonsmooth::contact::Point& point)
	{
		const Real dx = point.x - centre.x, dy = point.y - centre.y, square = dx * dx + dy * dy;
		const Real least = std::max(Real(0), arc.radius - reach), most = arc.radius + reach;
		return square < least * least || square > most * most;
	}
}

class Ig2_Arc_Sphere_ScGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& arc, const shared_ptr<Shape>& sphere, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;
	bool goReverse(
	        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& arc, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;
	void postLoad(Ig2_Arc_Sphere_ScGeom&) const
	{
		nscd::require(
		        interactionDetectionFactor >= 1 && nscd::isNumber(interactionDetectionFactor), getClassName(),
		        "interactionDetectionFactor", interactionDetectionFactor,
		        "1 or more, and finite, as 1 + reach of the law");
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Arc_Sphere_ScGeom,IGeomFunctor,
R"""(Make or update the geometry (:yref:`SegmentGeom`) of an :yref:`Arc` and a :yref:`Sphere`, also while the gap is open.)""",
		((Real,interactionDetectionFactor,1,Attr::triggerPostLoad,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for "
		        ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
	FUNCTOR2D(Arc, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Arc, Sphere);
};
REGISTER_SERIALIZABLE(Ig2_Arc_Sphere_ScGeom);

} // namespace yade
