// Contacts of spheres with facets, boxes and walls in space, also while the gap is open: YADE's own functors for facets
// and walls make none before touch, and where two facets meet each of them has one.
//
// With c the sphere's centre, r its radius, q the wall's point nearest to c:
//     n = (c − q)/|c − q| ,   g = |c − q| − r ,   x_c = c − (r + g/2) n .
// Inside a box, and behind a one-sided wall, n points to where the centre has come from (contact/space/nearest.hpp).
// Sign: n from the wall to the sphere; a gap is positive. Units: m.
#pragma once

#include "../checks/Refusal.hpp"
#include <core/Dispatching.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

/// A ScGeom that also knows whether the contact is still its wall's.
class FaceGeom : public ScGeom {
public:
	virtual ~FaceGeom() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(FaceGeom,ScGeom,"Contact of a :yref:`Facet`, a :yref:`Box` or a :yref:`Wall` with a sphere; "
	        ":yref:`normal<GenericSpheresContact.normal>` points from the wall to the sphere.",
		((bool,owned,true,Attr::readonly,"The contact is this facet's; false once the sphere has passed an edge to the facet behind it."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(FaceGeom, ScGeom);
};
REGISTER_SERIALIZABLE(FaceGeom);

namespace nscd {
	/// Where a sphere's centre stands to a face.
	struct FaceNearest {
		Vector3r normal; // from the wall to the sphere
		Real     distance; // of the centre from the wall, negative inside or behind
		bool     owned = true; // the contact is this wall's
	};

	/// Makes or updates the geometry of a wall, the interaction's first body, and a sphere; returns false where it
	/// is to have none. `factor`: interactionDetectionFactor.
	bool setFaceGeom(
	        const FaceNearest& near, Real radius, Real factor, const State& wall, const State& sphere,
	        const Vector3r& shift, bool force, Scene* scene, const shared_ptr<Interaction>& interaction);
}

class Ig2_Facet_Sphere_FaceGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& facet, const shared_ptr<Shape>& sphere, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override;
	bool goReverse(
	        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& facet, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override
	{
		interaction->swapOrder();
		return go(facet, sphere, state2, state1, -shift2, force, interaction);
	}
	void postLoad(Ig2_Facet_Sphere_FaceGeom&) const
	{
		nscd::require(
		        interactionDetectionFactor >= 1 && nscd::isNumber(interactionDetectionFactor), getClassName(),
		        "interactionDetectionFactor", interactionDetectionFactor,
		        "1 or more, and finite, as 1 + reach of the law");
	}
	FUNCTOR2D(Facet, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Facet, Sphere);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Facet_Sphere_FaceGeom,IGeomFunctor,
R"""(Make or update the geometry (:yref:`FaceGeom`) of a :yref:`Facet` and a :yref:`Sphere`, also while the gap is open. Facets that share an edge or a vertex are one
surface: a sphere has one contact where they go on straight or turn away from it, and two where they turn towards it.)""",
		((Real,interactionDetectionFactor,1,Attr::triggerPostLoad,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for "
		        ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ig2_Facet_Sphere_FaceGeom);

class Ig2_Box_Sphere_FaceGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& box, const shared_ptr<Shape>& sphere, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;
	bool goReverse(
	        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& box, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override
	{
		interaction->swapOrder();
		return go(box, sphere, state2, state1, -shift2, force, interaction);
	}
	void postLoad(Ig2_Box_Sphere_FaceGeom&) const
	{
		nscd::require(
		        interactionDetectionFactor >= 1 && nscd::isNumber(interactionDetectionFactor), getClassName(),
		        "interactionDetectionFactor", interactionDetectionFactor,
		        "1 or more, and finite, as 1 + reach of the law");
	}
	FUNCTOR2D(Box, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Box, Sphere);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Box_Sphere_FaceGeom,IGeomFunctor,"Make or update the geometry (:yref:`FaceGeom`) of a :yref:`Box` and a :yref:`Sphere`, also while the "
	        "gap is open.",
		((Real,interactionDetectionFactor,1,Attr::triggerPostLoad,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for "
		        ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ig2_Box_Sphere_FaceGeom);

class Ig2_Wall_Sphere_FaceGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& wall, const shared_ptr<Shape>& sphere, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override;
	bool goReverse(
	        const shared_ptr<Shape>& sphere, const shared_ptr<Shape>& wall, const State& state1,
	        const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& interaction) override
	{
		interaction->swapOrder();
		return go(wall, sphere, state2, state1, -shift2, force, interaction);
	}
	void postLoad(Ig2_Wall_Sphere_FaceGeom&) const
	{
		nscd::require(
		        interactionDetectionFactor >= 1 && nscd::isNumber(interactionDetectionFactor), getClassName(),
		        "interactionDetectionFactor", interactionDetectionFactor,
		        "1 or more, and finite, as 1 + reach of the law");
	}
	FUNCTOR2D(Wall, Sphere);
	DEFINE_FUNCTOR_ORDER_2D(Wall, Sphere);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Wall_Sphere_FaceGeom,IGeomFunctor,"Make or update the geometry (:yref:`FaceGeom`) of a :yref:`Wall` and a :yref:`Sphere`, also while "
	        "the gap is open.",
		((Real,interactionDetectionFactor,1,Attr::triggerPostLoad,"A contact exists where the gap is below (factor − 1) times the sphere's diameter; at least 1, as for "
		        ":yref:`Ig2_Sphere_Sphere_ScGeom.interactionDetectionFactor`."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ig2_Wall_Sphere_FaceGeom);

} // namespace yade
