#include "FaceGeom.hpp"
#include "FaceJoints.hpp"
#include "Vectors.hpp"
#include <boost/make_shared.hpp>
#include <contact/space/nearest.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((FaceGeom)(Ig2_Facet_Sphere_FaceGeom)(Ig2_Box_Sphere_FaceGeom)(Ig2_Wall_Sphere_FaceGeom));

namespace space = nonsmooth::contact::space;

bool nscd::setFaceGeom(
        const FaceNearest& near, Real radius, Real factor, const State& wall, const State& sphere,
        const Vector3r& shift, bool force, Scene* scene, const shared_ptr<Interaction>& interaction)
{
	const Real gap = near.distance - radius;
	if (!interaction->isReal() && !force && (!near.owned || gap > (factor - 1) * 2 * radius)) return false;
	const bool           isNew = !interaction->geom;
	shared_ptr<FaceGeom> geom;
	if (isNew) interaction->geom = geom = boost::make_shared<FaceGeom>();
	else
		geom = YADE_PTR_CAST<FaceGeom>(interaction->geom);
	geom->owned = near.owned;
	// both radii the sphere's, as YADE's functor for boxes does it
	geom->doIg2Work(
	        sphere.pos + shift - near.normal * (radius + 0.5 * gap), -gap, radius, radius, wall, sphere, scene,
	        interaction, near.normal, shift, isNew, false);
	return true;
}

bool Ig2_Facet_Sphere_FaceGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto&     facet  = static_cast<const Facet&>(*shape1);
	const Real      radius = static_cast<const Sphere&>(*shape2).radius;
	const Vector3r  centre = state2.pos + shift2;
	space::Triangle corners;
	for (int k = 0; k < 3; ++k)
		corners.vertices[k] = nscd::ours(state1.pos + state1.ori * facet.vertices[k]);
	const auto     at  = space::nearest(corners, nscd::ours(centre));
	const Vector3r out = centre - nscd::theirs(at.point);
	const Real     far = out.norm();
	// most of what the collider proposes is out of reach
	if (!interaction->isReal() && !force && far - radius > (interactionDetectionFactor - 1) * 2 * radius)
		return false;
	const bool     owned = nscd::FaceJoints::of(*scene).owns(*scene, interaction->getId1(), at, nscd::ours(centre));
	const Vector3r normal = far > 0 ? Vector3r(out / far) : Vector3r(state1.ori * facet.normal);
	// a centre that has been pressed through the face is pushed back to the side from which it came
	const auto* known = interaction->isReal() ? static_cast<const ScGeom*>(interaction->geom.get()) : nullptr;
	const Real  side  = known && at.feature == space::Nearest::Face && known->normal.dot(normal) < 0 ? -1 : 1;
	return nscd::setFaceGeom(
	        { side * normal, side * far, owned }, radius, interactionDetectionFactor, state1, state2, shift2, force,
	        scene, interaction);
}

bool Ig2_Box_Sphere_FaceGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto& box    = static_cast<const Box&>(*shape1);
	const Real  radius = static_cast<const Sphere&>(*shape2).radius;
	const auto  aside  = space::asideOfBox(
	          nscd::ours(box.extents),
	          nscd::ours(state1.ori.conjugate() * Vector3r(state2.pos + shift2 - state1.pos)));
	return nscd::setFaceGeom(
	        { state1.ori * nscd::theirs(aside.normal), aside.distance }, radius, interactionDetectionFactor, state1,
	        state2, shift2, force, scene, interaction);
}

bool Ig2_Wall_Sphere_FaceGeom::go(
        const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction)
{
	const auto& wall   = static_cast<const Wall&>(*shape1);
	const Real  radius = static_cast<const Sphere&>(*shape2).radius;
	const auto  aside  = space::asideOfPlane(
	          wall.axis, wall.sense, state2.pos[wall.axis] + shift2[wall.axis] - state1.pos[wall.axis]);
	// of a wall that acts to both sides the side on which the sphere was stays
	const auto* known  = interaction->isReal() ? static_cast<const ScGeom*>(interaction->geom.get()) : nullptr;
	const bool  turned = known && wall.sense == 0 && known->normal.dot(nscd::theirs(aside.normal)) < 0;
	const Real  sign   = turned ? -1 : 1;
	// what is farther behind a one-sided wall than its radius has passed it
	if (wall.sense != 0 && aside.distance < -radius && !interaction->isReal() && !force) return false;
	return nscd::setFaceGeom(
	        { sign * nscd::theirs(aside.normal), sign * aside.distance }, radius, interactionDetectionFactor,
	        state1, state2, shift2, force, scene, interaction);
}

} // namespace yade
