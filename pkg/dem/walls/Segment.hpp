// A wall in two dimensions: a line segment at any angle, alone or as a piece of a polyline.
#pragma once

#include "../checks/Refusal.hpp"

#include <core/Dispatching.hpp>
#include <core/Shape.hpp>
#include <contact/plane/motion.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

class Segment : public Shape {
public:
	virtual ~Segment() = default;
	/// A script has set a number: refused at once, since no disk could touch a wall of it.
	void postLoad(Segment&) const
	{
		nscd::require(
		        halfLength > 0 && nscd::isNumber(halfLength), "Segment", "halfLength", halfLength,
		        "positive and finite [m]");
		nscd::require(sense >= -1 && sense <= 1, "Segment", "sense", sense, "1, -1 or 0, the side that acts");
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Segment,Shape,
R"""(Line segment in the x-y plane: centred on the body's position, along the body's local x axis. Segments and :yref:`arcs<Arc>` whose ends meet are one wall, however
they were made, and as long as they meet: a sphere at a joint has one contact, with the wall above whose length the sphere's centre stands,
or with that of lower id where the centre stands in the wedge outside a convex corner. Walls meet where their ends are nearer than a millionth of the shorter one's length, or where an end lies on
the other wall; those of different :yref:`groupMask<Body.groupMask>` do not. See :yref:`yade.nonsmooth.scene.segments`.)""",
		((Real,halfLength,1,Attr::triggerPostLoad,"Half of the length [m]."))
		((int,sense,0,Attr::triggerPostLoad,"Side that acts: 0 both, 1 that of local +y only, −1 that of local −y only. A one-sided segment also "
		        "pushes back a sphere whose centre is behind it by less than its radius."))
		((Vector3r,nextDirection,Vector3r::Zero(),,"Not zero: this segment has the corner at its local +x end before the one that begins there with "
		        ":yref:`hasPrevious<Segment.hasPrevious>`, whichever has the lower id. Direction of that one in this "
		        "one's frame, pointing away from the joint."))
		((bool,hasPrevious,false,,"The segment that ends at this one's local −x end has their corner, see "
		        ":yref:`nextDirection<Segment.nextDirection>`."))
		((Vector3r,previousDirection,Vector3r::Zero(),,"The same as :yref:`nextDirection<Segment.nextDirection>` at the local −x end, for one that ends "
		        "there with :yref:`hasNext<Segment.hasNext>`; pointing to the joint."))
		((bool,hasNext,false,,"The segment that begins at this one's local +x end has their corner, see "
		        ":yref:`previousDirection<Segment.previousDirection>`."))
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
	YADE_CLASS_BASE_DOC(Bo1_Segment_Aabb,BoundFunctor,"Make or update the :yref:`Aabb` of a :yref:`Segment`. A long oblique segment has a large box: cut it "
	        "into pieces of a few sphere diameters.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_Segment_Aabb);

namespace nscd {
	struct WallEnd;

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

namespace nscd {
	/// Where a sphere's centre stands to a wall: distance vector from the nearest point and whose the contact is.
	struct WallNearest {
		Vector3r normal; // from the wall to the sphere
		Real     distance; // of the centre from the wall, negative behind a one-sided wall
		bool     owned;
		Real     curvature = 0; // see SegmentGeom
	};

	/// What becomes of it beyond the end of the wall, for a centre that stands at `out` from the end point.
	void takeEnd(const WallEnd& end, const Vector3r& out, int sense, Real radius, WallNearest& result);

	/// Makes or updates the geometry of a wall, the interaction's first body, and a sphere; returns false where it
	/// is to have none.
	bool setWallGeom(
	        const WallNearest& near, int sense, Real radius, Real factor, const State& wall, const State& sphere,
	        const Vector3r& shift, bool force, Scene* scene, const shared_ptr<Interaction>& interaction);
}

/// A ScGeom that also knows whether its wall still owns the sphere, and how the wall is bent.
class SegmentGeom : public ScGeom {
public:
	virtual ~SegmentGeom() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SegmentGeom,ScGeom,"Contact of a :yref:`Segment` or an :yref:`Arc` with a sphere; "
	        ":yref:`normal<GenericSpheresContact.normal>` points from the wall to the sphere.",
		((bool,owned,true,Attr::readonly,"The sphere is this wall's; false once it has passed a joint to the neighbour."))
		((Real,curvature,0,Attr::readonly,"Of the line along which the sphere's centre goes while it touches [1/m], positive where that turns "
		        "towards the normal, as inside an arc; 0 on a segment and at the end of a wall."))
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
	void postLoad(Ig2_Segment_Sphere_ScGeom&) const
	{
		nscd::require(
		        interactionDetectionFactor >= 1 && nscd::isNumber(interactionDetectionFactor), getClassName(),
		        "interactionDetectionFactor", interactionDetectionFactor,
		        "1 or more, and finite, as 1 + reach of the law");
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Segment_Sphere_ScGeom,IGeomFunctor,
R"""(Make or update the geometry of a :yref:`Segment` and a :yref:`Sphere`, also while the gap is open.)""",
		((Real,interactionDetectionFactor,1,Attr::triggerPostLoad,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for "
		        ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
	FUNCTOR2D(Segment, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Segment, Sphere);
};
REGISTER_SERIALIZABLE(Ig2_Segment_Sphere_ScGeom);

} // namespace yade
