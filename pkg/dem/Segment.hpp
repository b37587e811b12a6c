// A wall in two dimensions: a line segment at any angle, alone or as a piece of a polyline.
#pragma once

#include <core/Dispatching.hpp>
#include <core/Shape.hpp>
#include <contact/plane/motion.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

class Segment : public Shape {
public:
	virtual ~Segment() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Segment,Shape,
R"""(Line segment in the x-y plane: centred on the body's position, along the body's local x axis. In a polyline each segment knows the
directions of its neighbours, so that a sphere at a joint has one contact: the segment above whose length the sphere's centre stands,
or the earlier one of two (the later one, where that has :yref:`previousDirection<Segment.previousDirection>`) where the centre stands in the wedge outside a convex corner. See :yref:`yade.nonsmooth.scene.segments`.)""",
		((Real,halfLength,1,,"Half of the length [m]."))
		((int,sense,0,,"Side that acts: 0 both, 1 that of local +y only, −1 that of local −y only. A one-sided segment also pushes back a sphere whose centre is behind it by less than its radius."))
		((Vector3r,nextDirection,Vector3r::Zero(),,"Direction of the segment that begins at this one's local +x end, in this one's frame, pointing away from the joint; zero: none."))
		((bool,hasPrevious,false,,"Another segment ends at this one's local −x end and owns the joint."))
		((Vector3r,previousDirection,Vector3r::Zero(),,"Direction of the segment that ends at this one's local −x end, in this one's frame, pointing to the joint, which this one owns; zero: none."))
		((bool,hasNext,false,,"Another segment begins at this one's local +x end and owns the joint."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(Segment, Shape);
};
REGISTER_SERIALIZABLE(Segment);

class Bo1_Segment_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override;
	FUNCTOR1D(Segment);
	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_Segment_Aabb,BoundFunctor,"Make or update the :yref:`Aabb` of a :yref:`Segment`. A long oblique segment has a large box: cut it into pieces of a few sphere diameters.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_Segment_Aabb);

namespace nscd {
	/// Whether a point is surely farther than `reach` [m] from a segment that lies in the plane with that motion.
	inline bool isBeyond(
	        Real reach, const Segment& segment, const nonsmooth::contact::plane::Motion& wall,
	        const nonsmooth::contact::Point& point)
	{
		const auto along = nonsmooth::contact::plane::rotate(wall.rotation, { 1, 0 });
		const Real dx = point.x - wall.position.x, dy = point.y - wall.position.y;
		return std::abs(along.x * dy - along.y * dx) > reach
		        || std::abs(along.x * dx + along.y * dy) > segment.halfLength + reach;
	}
}

/// A ScGeom that also knows whether its segment still owns the sphere.
class SegmentGeom : public ScGeom {
public:
	virtual ~SegmentGeom() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SegmentGeom,ScGeom,"Contact of a :yref:`Segment` with a sphere; :yref:`normal<GenericSpheresContact.normal>` points from the wall to the sphere.",
		((bool,owned,true,Attr::readonly,"The sphere is this segment's; false once it has passed a joint to the neighbour."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SegmentGeom, ScGeom);
};
REGISTER_SERIALIZABLE(SegmentGeom);

class Ig2_Segment_Sphere_ScGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& segment, const shared_ptr<Shape>& sphere, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override;
	bool goReverse(
	        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& segment, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Segment_Sphere_ScGeom,IGeomFunctor,
R"""(Make or update the geometry of a :yref:`Segment` and a :yref:`Sphere`, also while the gap is open.)""",
		((Real,interactionDetectionFactor,1,,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for :yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
	FUNCTOR2D(Segment, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Segment, Sphere);
};
REGISTER_SERIALIZABLE(Ig2_Segment_Sphere_ScGeom);

} // namespace yade
