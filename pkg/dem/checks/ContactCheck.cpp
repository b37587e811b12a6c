// What is refused of shapes, reaches, materials and single contacts; of lists of engines: SceneCheck.cpp.
#include "SceneCheck.hpp"
#include "../walls/Arc.hpp"
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "../engines/PlanarGridCollider.hpp"
#include "Refusal.hpp"
#include "UnguardedHeaders.hpp"
#include "../walls/Segment.hpp"
#include <cmath>
#include <core/InteractionLoop.hpp>
#include <pkg/common/Bo1_Aabb.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <set>

namespace yade::nscd {

namespace {
	string body(Body::id_t id) { return "body #" + std::to_string(id); }

	/// Of an attribute of YADE's own classes of physics that was written to.
	[[noreturn]] void refuseWritten(const string& pair, const NscdPhys& phys, const string& name)
	{
		const auto vector = [](const Vector3r& v) {
			return "(" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + ")";
		};
		if (name == "kn" || name == "ks")
			fail(pair + " has phys." + name + " = " + number(name == "kn" ? phys.kn : phys.ks)
			     + " N/m, and a rigid contact has no stiffness: leave kn and ks 0");
		if (name == "tangensOfFrictionAngle")
			fail(pair + " was given phys.tangensOfFrictionAngle = " + number(phys.residualFriction)
			     + ", but slip rules the friction of this wall: set frictionAngle and weakenedFrictionAngle of a "
			       "SlipWeakeningMat and call ContactDynamicsEngine.updateStrengths(), or give the wall another law");
		fail(pair + " was given phys.normalForce = " + vector(phys.normalForce)
		     + " and phys.shearForce = " + vector(phys.shearForce)
		     + " N by a script, and the solver computes these forces in each step: press bodies by "
		       "O.forces.setPermF, or set both to zero if the solver is to begin without a first guess");
	}

	/// Sphere of a scene by id, null where the body is none.
	const Sphere* sphereOf(const Body& b) { return dynamic_cast<const Sphere*>(b.shape.get()); }

	/// Walls whose numbers no disk could touch.
	void checkWall(const Body& wall)
	{
		const auto refuseShape = [&](const string& name, Real value, const string& remedy) {
			fail(body(wall.getId()) + " is a wall with " + name + " = " + number(value) + ": " + remedy);
		};
		const auto check = [&](const char* name, Real length, int sense) {
			if (!(length > 0 && isNumber(length))) refuseShape(name, length, "give a positive length [m]");
			if (sense < -1 || sense > 1) refuseShape("sense", sense, "give 1, -1 or 0, the side that acts");
		};
		const auto* segment = dynamic_cast<const Segment*>(wall.shape.get());
		const auto* arc     = dynamic_cast<const Arc*>(wall.shape.get());
		if (segment) check("halfLength", segment->halfLength, segment->sense);
		else if (arc) {
			check("radius", arc->radius, arc->sense);
			if (!(arc->halfAngle > 0 && arc->halfAngle <= Mathr::PI * (1 + 1e-12)))
				refuseShape("halfAngle", arc->halfAngle, "give more than 0 and at most π [rad]");
		}
	}

	/// How far functors and the law look: less than a touching contact, or what is no number, would let disks pass
	/// through each other.
	void checkReach(const InteractionLoop& loop, const Collider& collider)
	{
		const auto refuseReach = [](const Engine& engine, const string& functor, const string& name, Real value,
		                            const string& remedy) {
			fail(named(engine) + ": " + functor + "." + name + " = " + number(value) + ": " + remedy);
		};
		const auto factor = [&](const auto* functor) {
			if (functor
			    && !(functor->interactionDetectionFactor >= 1
			         && std::isfinite(functor->interactionDetectionFactor)))
				refuseReach(
				        loop, functor->getClassName(), "interactionDetectionFactor",
				        functor->interactionDetectionFactor, "give 1 or more, as 1 + reach of the law");
		};
		for (const auto& functor : loop.geomDispatcher->functors) {
			factor(dynamic_cast<const Ig2_Sphere_Sphere_ScGeom*>(functor.get()));
			factor(dynamic_cast<const Ig2_Segment_Sphere_ScGeom*>(functor.get()));
			factor(dynamic_cast<const Ig2_Arc_Sphere_ScGeom*>(functor.get()));
		}
		for (const auto& functor : loop.lawDispatcher->functors)
			if (const auto* law = dynamic_cast<const Law2_ScGeom_NscdPhys_SignoriniCoulomb*>(functor.get()))
				for (const auto& [name, value] :
				     { std::pair("reach", law->reach), std::pair("adhesionRange", law->adhesionRange) })
					if (!(value >= 0 && std::isfinite(value)))
						refuseReach(
						        loop, law->getClassName(), name, value, "give 0 or more [ℓ]");
		for (const auto& functor : collider.boundDispatcher->functors)
			if (const auto* box = dynamic_cast<const Bo1_Sphere_Aabb*>(functor.get());
			    box && !std::isfinite(box->aabbEnlargeFactor))
				refuseReach(
				        collider, box->getClassName(), "aabbEnlargeFactor", box->aabbEnlargeFactor,
				        "give a finite factor, as 1 + reach of the law");
	}
}

void checkSureReach(const Scene& scene, Real openGap)
{
	const PlanarGridCollider* collider = nullptr;
	for (const auto& engine : scene.engines)
		if (const auto* found = engine->dead ? nullptr : dynamic_cast<const PlanarGridCollider*>(engine.get()))
			collider = found;
	if (!collider) return;
	Real reach = 0;
	for (const auto& functor : collider->boundDispatcher->functors)
		if (const auto* box = dynamic_cast<const Bo1_Sphere_Aabb*>(functor.get()))
			reach = std::max(reach, box->aabbEnlargeFactor - 1);
	const auto refuse = [&](const string& what, Real least) {
		// what nobody has within the reach does not matter
		if (collider->sureReach < std::min(least, reach))
			fail("PlanarGridCollider.sureReach = " + number(collider->sureReach) + " is below " + what
			     + " = " + number(least)
			     + ": slow disks so far apart would have no contact: raise it to that");
	};
	refuse("openGap", openGap);
	for (const auto& material : scene.materials)
		if (const auto* nscd = dynamic_cast<const NscdMat*>(material.get()))
			refuse("bondCreationDistance of " + nscd->getClassName() + " '" + nscd->label + "'",
			       nscd->bondCreationDistance);
}

void checkShapes(const Scene& scene, const std::vector<BodyState>& bodies, const std::vector<int>& shaped)
{
	InteractionLoop* loop     = nullptr;
	Collider*        collider = nullptr;
	for (const auto& engine : scene.engines) {
		if (engine->dead) continue;
		if (auto* found = dynamic_cast<InteractionLoop*>(engine.get())) loop = found;
		else if (auto* sorter = dynamic_cast<Collider*>(engine.get()))
			collider = sorter;
	}
	if (!loop || !collider) return; // separate dispatchers, which are YADE's own affair
	checkReach(*loop, *collider);
	const auto isDisk = [](const BodyState& b) { return b.present && b.radius > 0 && !b.clumped; };
	for (const int id : shaped) {
		const auto& b = (*scene.bodies)[id];
		if (!b->shape && b->isBounded() && (bodies[id].blocked & inPlane) != inPlane)
			fail(body(id)
			     + " may move and has no shape (shape = None), so that it goes through everything: give it one, as "
			       "Sphere(radius=...), erase it, or set its bounded = False if nothing is to touch it");
		if (const Sphere* sphere = b->shape && b->isBounded() ? sphereOf(*b) : nullptr)
			fail(body(id) + " is a Sphere of radius " + number(sphere->radius)
			     + ": give it a positive radius [m]");
	}
	const auto first = std::find_if(bodies.begin(), bodies.end(), isDisk);
	if (first == bodies.end()) return;
	auto&      disk  = (*scene.bodies)[first - bodies.begin()]->shape;
	const auto known = [&](shared_ptr<Shape>& shape) {
		bool swap = false;
		return shape->getClassIndex() >= 0 && loop->geomDispatcher->getFunctor2D(shape, disk, swap);
	};
	const auto second = std::find_if(first + 1, bodies.end(), isDisk);
	if (second != bodies.end() && !known((*scene.bodies)[second - bodies.begin()]->shape))
		fail("InteractionLoop has no functor for two " + disk->getClassName()
		     + "s, so disks would pass through each other: add Ig2_Sphere_Sphere_ScGeom to its list");
	for (const int id : shaped) {
		const auto& b     = (*scene.bodies)[id];
		auto&       shape = b->shape;
		if (!shape || !b->isBounded()) continue; // meant to touch nothing
		checkWall(*b);
		const auto lacks = [&](const Engine& engine, const string& functor) {
			fail(body(id) + " has a " + shape->getClassName() + ", for which " + named(engine) + " has no "
			     + functor
			     + ", so disks would pass through it: add one to its list, or set the body's bounded = False if nothing is to touch it");
		};
		if (!known(shape)) lacks(*loop, "Ig2 functor with a " + disk->getClassName());
		if (!collider->boundDispatcher->getFunctor1D(shape)) lacks(*collider, "Bo1 functor");
	}
}

void checkMaterials(const Scene& scene, const std::vector<BodyState>& bodies)
{
	InteractionLoop* loop = nullptr;
	for (const auto& engine : scene.engines)
		if (auto* found = engine->dead ? nullptr : dynamic_cast<InteractionLoop*>(engine.get())) loop = found;
	if (!loop) return;
	const auto rigid = [](const Body& b) { return dynamic_cast<const NscdMat*>(b.material.get()); };
	const auto disk  = std::find_if(bodies.begin(), bodies.end(), [&](const BodyState& b) {
                return b.present && b.radius > 0 && rigid(*(*scene.bodies)[&b - bodies.data()]);
        });
	if (disk == bodies.end()) return; // nothing here is rigid
	auto&         ours = (*scene.bodies)[disk - bodies.begin()]->material;
	std::set<int> known; // classes of materials
	for (size_t id = 0; id < bodies.size(); ++id) {
		const auto& b = (*scene.bodies)[id];
		if (!b || !b->material || !b->isBounded() || bodies[id].clumped || rigid(*b)) continue;
		bool swap = false;
		if (b->material->getClassIndex() >= 0
		    && (known.count(b->material->getClassIndex())
		        || loop->physDispatcher->getFunctor2D(b->material, ours, swap))) {
			known.insert(b->material->getClassIndex());
			continue;
		}
		fail(body(id) + " has another material, a " + b->material->getClassName()
		     + (b->material->label.empty() ? "" : " '" + b->material->label + "'") + ", and " + named(*loop)
		     + " has no Ip2 functor for it and an NscdMat, so that its first contact would end the run: give it an "
		       "NscdMat, or set the body's bounded = False if nothing is to touch it");
	}
}

void refuseContact(const Scene& scene, const ContactState& state)
{
	const Interaction& i    = *state.interaction;
	const string       pair = "interaction #" + std::to_string(i.getId1()) + "+#" + std::to_string(i.getId2());
	const auto &       b1 = (*scene.bodies)[i.getId1()], &b2 = (*scene.bodies)[i.getId2()];
	for (const auto& b : { b1, b2 }) { // what is wrong with a material is wrong with its contacts
		if (!b->material) fail(body(b->getId()) + " has no material: give it an NscdMat");
		const auto* material = dynamic_cast<const NscdMat*>(b->material.get());
		if (!material)
			fail(pair + " has a " + i.phys->getClassName() + ", and " + body(b->getId()) + " a "
			     + b->material->getClassName()
			     + ": give both bodies an NscdMat and use Ip2_NscdMat_NscdMat_NscdPhys");
		try {
			material->validate();
		} catch (const std::invalid_argument& error) {
			fail(body(b->getId()) + ": " + error.what());
		}
	}
	if (!state.phys)
		fail(pair + " has a " + i.phys->getClassName()
		     + ": give both bodies an NscdMat and use Ip2_NscdMat_NscdMat_NscdPhys");
	if (!std::isfinite(state.nx + state.ny + state.nz)) {
		const auto place = [](const Body& b) {
			return number(b.state->pos[0]) + ", " + number(b.state->pos[1]);
		};
		fail(pair + " has no normal: the centres are at one place, (" + place(*b1) + ") and (" + place(*b2)
		     + ") m, or a position is not finite. A script has put them there, or a load has pressed one through the "
		       "other in steps that were not solved: check"
		       " contactDynamics.overlapWorst and .unconverged of the steps before, and move one of them");
	}
	if (!state.usable && std::abs(state.nz) > flatness)
		fail(pair + " has a normal that leaves the x-y plane, of which only a part would act (z component "
		     + number(state.nz) + "; centres at z = " + number(b1->state->pos[2]) + " and "
		     + number(b2->state->pos[2]) + " m): put all disks at one z, and walls upright to the plane");
	if (const char* name = state.phys->unheard()) refuseWritten(pair, *state.phys, name);
	const auto [name, value] = state.phys->senseless();
	fail(pair + " has values out of their range: friction " + number(state.friction) + ", tensile force "
	     + number(state.adhesion) + " N, rolling arm " + number(state.rollingArm) + " m, mean diameter "
	     + number(state.length) + " m, restitution " + number(state.restitution)
	     + (name ? string(", phys.") + name + " " + number(value) : "")
	     + "; all must be finite and not negative, the diameter and a bond's ellipse positive, restitution from "
	       "0 to 1: set them in its phys, or take the values of the materials with "
	       "ContactDynamicsEngine.updateStrengths()");
}

} // namespace yade::nscd
