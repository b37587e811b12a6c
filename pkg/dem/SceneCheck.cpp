#include "SceneCheck.hpp"
#include "Arc.hpp"
#include "ContactDynamicsEngine.hpp"
#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "NscdInteractionLoop.hpp"
#include "PlanarGridCollider.hpp"
#include "Refusal.hpp"
#include "UnguardedHeaders.hpp"
#include "Segment.hpp"
#include <cmath>
#include <core/InteractionLoop.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/Bo1_Aabb.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/ForceResetter.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/UniaxialStrainer.hpp>
#include <map>
#include <set>
#include <typeindex>
#include <unordered_set>

namespace yade::nscd {

string named(const Engine& engine)
{
	return engine.getClassName() + (engine.label.empty() ? "" : " '" + engine.label + "'");
}

namespace {
	string body(Body::id_t id) { return "body #" + std::to_string(id); }

	/// The engines of one kind in the list, see checkEngines.
	struct Kind {
		const Engine* first = nullptr; // that runs
		const Engine* dead  = nullptr;
		bool          after = false; // the solver

		void take(const Engine& engine, bool passed)
		{
			if (engine.dead) dead = &engine;
			else if (!first) {
				first = &engine;
				after = passed;
			}
		}
		void require(const char* remedy) const
		{
			if (first) return;
			if (dead)
				fail(named(*dead)
				     + " is dead: set dead = False, or take the engine out of O.engines and put another in its place");
			fail(remedy);
		}
		void requireBefore() const
		{
			if (after)
				fail(named(*first) + " stands after ContactDynamicsEngine in O.engines: put it before");
		}
	};

	void checkIntegrator(const NewtonIntegrator& newton)
	{
		if (newton.damping != 0)
			fail("NewtonIntegrator.damping = " + number(newton.damping)
			     + ", which would change the impulses: set damping=0 (rigid contacts dissipate by themselves)");
		if (newton.mask > 0)
			fail("NewtonIntegrator.mask = " + std::to_string(newton.mask)
			     + ": bodies outside of the mask would not move, and the solver would take them for moving: set mask=-1, and block the DOFs of bodies that must stay");
		if (newton.densityScaling)
			fail("NewtonIntegrator.densityScaling = True, which changes masses that the solver does not see: set densityScaling=False (rigid contacts do not need it)");
	}

	/// Engines of YADE's that steer by what rigid contacts and flat scenes have not, with what does their work; by name, since not every YADE has all of them.
	void refuseController(const Engine& engine)
	{
		thread_local std::unordered_set<std::type_index>
		        others; // classes that are none of these: a name costs more than a type
		if (others.count(typeid(engine))) return;
		static const string stress
		        = " moves walls by the stiffness of their contacts, and rigid contacts have none, so that walls would go to and fro at max_vel: load plates instead (yade.nonsmooth.scene.plate), set the state.vel of walls that are to move at a given rate, or shear a sample by scripts/biaxial.py";
		static const string lid
		        = " holds the load on its lid by the stiffness of the contacts, and rigid contacts have none, so that the lid would keep its height: load the lid by yade.nonsmooth.scene.plate, and set the state.vel of the parts that are to move";
		static const string cell
		        = " steers a periodic cell, and periodic scenes are not supported: bound the scene by walls and load them by yade.nonsmooth.scene.plate, or shear a sample by scripts/biaxial.py";
		static const string record
		        = " reads a triaxial engine, and those move walls by the stiffness of contacts, which rigid ones have not: read O.forces.f of the walls after the integrator, or load and width of what yade.nonsmooth.scene.plate returns";
		static const std::map<string, const string*> refused {
			{ "TriaxialStressController", &stress },
			{ "TriaxialCompressionEngine", &stress },
			{ "ThreeDTriaxialEngine", &stress },
			{ "SampleCapillaryPressureEngine", &stress },
			{ "KinemCNLEngine", &lid },
			{ "KinemCNSEngine", &lid },
			{ "PeriIsoCompressor", &cell },
			{ "PeriTriaxController", &cell },
			{ "Peri3dController", &cell },
			{ "TriaxialStateRecorder", &record },
		};
		if (const auto found = refused.find(engine.getClassName()); found != refused.end())
			fail(named(engine) + *found->second);
		others.insert(typeid(engine));
	}

	/// Refuses paths of a LawTester that leave the plane: of its axes the third one, and of its angles the first two, do.
	void checkTester(const LawTester& tester)
	{
		const auto flat = [&](const char* name, const vector<Vector3r>& path, auto leaves, const char* what) {
			for (size_t k = 0; k < path.size(); ++k)
				if (leaves(path[k]))
					fail(named(tester) + "." + name + "[" + std::to_string(k) + "] = ("
					     + number(path[k][0]) + ", " + number(path[k][1]) + ", "
					     + number(path[k][2]) + ") " + what);
		};
		flat(
		        "disPath", tester.disPath, [](const Vector3r& p) { return p[2] != 0; },
		        "moves a disk out of the x-y plane: leave the third number 0, the first one pulls and the second one shears");
		flat(
		        "rotPath", tester.rotPath, [](const Vector3r& p) { return p[0] != 0 || p[1] != 0; },
		        "turns a disk out of the x-y plane: leave the first two numbers 0, the third one rolls");
	}

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
			     + ", but slip rules the friction of this wall: set frictionAngle and weakenedFrictionAngle of a SlipWeakeningMat and call ContactDynamicsEngine.updateStrengths(), or give the wall another law");
		fail(pair + " was given phys.normalForce = " + vector(phys.normalForce)
		     + " and phys.shearForce = " + vector(phys.shearForce)
		     + " N by a script, and the solver computes these forces in each step: press bodies by O.forces.setPermF, or set both to zero if the solver is to begin without a first guess");
	}

	/// Whether an engine of YADE's reads the forces on bodies when it acts.
	bool readsForces(const Engine& engine)
	{
		static const std::set<string> readers { "Disp2DPropLoadEngine", "ForceRecorder",  "KinemCNDEngine",
			                                "KinemCNLEngine",       "KinemCNSEngine", "KinemCTDEngine",
			                                "ServoPIDController",   "TimeAverager",   "TorqueRecorder",
			                                "UniaxialStrainer" };
		return readers.count(engine.getClassName());
	}

	/// Sphere of a scene by id, null where the body is none.
	const Sphere* sphereOf(const Body& b) { return dynamic_cast<const Sphere*>(b.shape.get()); }
}

void checkEngines(const Scene& scene, const Engine& solver)
{
	Kind                    resetters, colliders, loops, integrators;
	bool                    passed  = false;
	const Engine*           between = nullptr;
	const NewtonIntegrator* newton  = nullptr;
	refuseEarly(scene, "ContactDynamicsEngine");
	for (const auto& pointer : scene.engines) {
		const Engine& engine = *pointer;
		if (&engine == &solver) {
			passed = true;
			continue;
		}
		if (dynamic_cast<const ContactDynamicsEngine*>(&engine) && !engine.dead)
			fail("O.engines has two engines ContactDynamicsEngine, and each would add its own reactions: take one out");
		if (const auto* found = dynamic_cast<const NewtonIntegrator*>(&engine)) {
			integrators.take(engine, passed);
			if (engine.dead) continue;
			if (newton)
				fail("O.engines has a second integrator, " + named(engine)
				     + ", which would move bodies twice a step: take one out");
			newton = found;
			continue;
		}
		const auto* stepper = dynamic_cast<const TimeStepper*>(&engine);
		if (stepper && stepper->active && !stepper->dead)
			fail(stepper->getClassName()
			     + " sets the time step of soft contacts: remove it and set O.dt (milliseconds are usual)");
		if (dynamic_cast<const ForceResetter*>(&engine)) {
			resetters.take(engine, passed);
		} else if (dynamic_cast<const Collider*>(&engine))
			colliders.take(engine, passed);
		else if (dynamic_cast<const InteractionLoop*>(&engine) || dynamic_cast<const LawDispatcher*>(&engine))
			loops.take(engine, passed);
		if (const auto* tester = dynamic_cast<const LawTester*>(&engine); tester && !tester->dead)
			checkTester(*tester);
		if (passed && !newton && !engine.dead && !between) between = &engine;
	}
	integrators.require(
	        "O.engines has no NewtonIntegrator: add NewtonIntegrator(damping=0, gravity=...) after ContactDynamicsEngine");
	if (!integrators.after)
		fail("the engine stands after NewtonIntegrator in O.engines: put it before the integrator");
	checkIntegrator(*newton);
	loops.require(
	        "O.engines has no InteractionLoop, so no contact would be known: add NscdInteractionLoop(...) before ContactDynamicsEngine, see yade.nonsmooth.scene.engines");
	loops.requireBefore();
	colliders.require(
	        "O.engines has no collider, so no contact would be found: add PlanarGridCollider(...) before InteractionLoop, see yade.nonsmooth.scene.engines");
	colliders.requireBefore();
	if (between)
		fail(named(*between) + " stands between ContactDynamicsEngine and " + named(*newton)
		     + " in O.engines, where no reaction answers the forces and velocities that it changes: put it before ContactDynamicsEngine if it adds forces, after the integrator if it reads them");
	if (resetters.dead && !resetters.first) resetters.require("");
	if (scene.forces.lastReset < scene.iter)
		fail("O.forces were last reset in step " + std::to_string(scene.forces.lastReset)
		     + ", and this is step " + std::to_string(scene.iter)
		     + ", so that reactions of steps before would act again: put ForceResetter() first in O.engines");
}

namespace {
	/// Engines that read forces where O.forces has none of this step: YADE's own refuse by a message that names nobody, or read zero.
	void refuseReaders(const Scene& scene)
	{
		if (!hasSolver(scene)) return;
		bool reset = false; // forces of the step before are gone
		for (const auto& engine : scene.engines) {
			if (engine->dead) continue;
			if (dynamic_cast<const ContactDynamicsEngine*>(engine.get())) return;
			reset = reset || dynamic_cast<const ForceResetter*>(engine.get());
			if (reset && readsForces(*engine))
				fail(named(*engine)
				     + " reads forces and stands before ContactDynamicsEngine, where O.forces has no reaction of this step yet: put it after the integrator (engines(after=[...]))"
				     + (dynamic_cast<const UniaxialStrainer*>(engine.get())
				                ? ", with blockDisplacements=True and blockRotations=True"
				                : ""));
		}
	}

	template <class Functor, class List> const Functor* anyOf(const List& functors)
	{
		for (const auto& one : functors)
			if (const auto* found = dynamic_cast<const Functor*>(one.get())) return found;
		return nullptr;
	}
}

string halfConverted(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		const auto* loop = engine->dead ? nullptr : dynamic_cast<const InteractionLoop*>(engine.get());
		if (!loop) continue;
		const auto& laws       = loop->lawDispatcher->functors;
		const auto& physics    = loop->physDispatcher->functors;
		const bool  areRigid   = anyOf<Ip2_NscdMat_NscdMat_NscdPhys>(physics);
		const bool  takesRigid = anyOf<Law2_ScGeom_NscdPhys_SignoriniCoulomb>(laws);
		if (areRigid == takesRigid || laws.empty() || physics.empty()) continue;
		if (takesRigid && (laws.size() > 1 || dynamic_cast<const NscdInteractionLoop*>(loop)))
			continue; // others take what comes, or it is refused at the first contact, with its bodies
		return (areRigid ? named(*loop)
		                        + " has Ip2_NscdMat_NscdMat_NscdPhys, whose contacts are rigid, and the law "
		                        + laws.front()->getClassName()
		                        + ", which finds forces by a stiffness that they have not, so that contacts would bear nothing"
		                 : named(*loop)
		                        + " has Law2_ScGeom_NscdPhys_SignoriniCoulomb, the law of rigid contacts, and "
		                        + physics.front()->getClassName()
		                        + ", which makes others, so that the first contact would end the process")
		        + ": for rigid contacts give it Ip2_NscdMat_NscdMat_NscdPhys() and Law2_ScGeom_NscdPhys_SignoriniCoulomb()"
		        + (hasSolver(scene)
		                   ? ""
		                   : ", and O.engines a ContactDynamicsEngine before NewtonIntegrator (yade.nonsmooth.scene.engines makes the whole list)")
		        + "; for soft ones an Ip2 functor and a law of YADE's";
	}
	return "";
}

void refuseEarly(const Scene& scene, const char* who)
{
	for (const auto& engine : scene.engines) {
		if (engine->dead) continue;
		refuseController(*engine);
		if (dynamic_cast<const DomainLimiter*>(engine.get()))
			throw std::runtime_error(
			        string(who) + ": O.engines has a " + named(*engine)
			        + ", which ends the process where it erases a body that Python has made: let a PyRunner at the end of the list erase it, as PyRunner(command='for b in [b for b in O.bodies if b.state.pos[1] < -3]: O.bodies.erase(b.id)', iterPeriod=20)");
	}
	if (const string why = halfConverted(scene); !why.empty()) throw std::runtime_error(string(who) + ": " + why);
	refuseReaders(scene);
}

namespace {
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

	/// How far functors and the law look: less than a touching contact, or what is no number, would let disks pass through each other.
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

void checkShapes(const Scene& scene, const std::vector<BodyReading>& bodies, const std::vector<int>& shaped)
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
	const auto isDisk = [](const BodyReading& b) { return b.present && b.radius > 0 && !b.clumped; };
	for (const int id : shaped) {
		const auto& b = (*scene.bodies)[id];
		if (!b->shape && b->isBounded() && (bodies[id].blocked & inPlane) != inPlane)
			fail(body(id)
			     + " may move and has no shape (shape = None), so that it goes through everything: give it one, as Sphere(radius=...), erase it, or set its bounded = False if nothing is to touch it");
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

void checkMaterials(const Scene& scene, const std::vector<BodyReading>& bodies)
{
	InteractionLoop* loop = nullptr;
	for (const auto& engine : scene.engines)
		if (auto* found = engine->dead ? nullptr : dynamic_cast<InteractionLoop*>(engine.get())) loop = found;
	if (!loop) return;
	const auto rigid = [](const Body& b) { return dynamic_cast<const NscdMat*>(b.material.get()); };
	const auto disk  = std::find_if(bodies.begin(), bodies.end(), [&](const BodyReading& b) {
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
		     + " has no Ip2 functor for it and an NscdMat, so that its first contact would end the run: give it an NscdMat, or set the body's bounded = False if nothing is to touch it");
	}
}

void refuseContact(const Scene& scene, const Reading& reading)
{
	const Interaction& i    = *reading.interaction;
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
	if (!reading.phys)
		fail(pair + " has a " + i.phys->getClassName()
		     + ": give both bodies an NscdMat and use Ip2_NscdMat_NscdMat_NscdPhys");
	if (!std::isfinite(reading.nx + reading.ny + reading.nz)) {
		const auto place = [](const Body& b) {
			return number(b.state->pos[0]) + ", " + number(b.state->pos[1]);
		};
		fail(pair + " has no normal: the centres are at one place, (" + place(*b1) + ") and (" + place(*b2)
		     + ") m, or a position is not finite. A script has put them there, or a load has pressed one through the other in steps that were not solved: check"
		       " contactDynamics.overlapWorst and .unconverged of the steps before, and move one of them");
	}
	if (!reading.usable && std::abs(reading.nz) > flatness)
		fail(pair + " has a normal that leaves the x-y plane, of which only a part would act (z component "
		     + number(reading.nz) + "; centres at z = " + number(b1->state->pos[2]) + " and "
		     + number(b2->state->pos[2]) + " m): put all disks at one z, and walls upright to the plane");
	if (const char* name = reading.phys->unheard()) refuseWritten(pair, *reading.phys, name);
	const auto [name, value] = reading.phys->senseless();
	fail(pair + " has values out of their range: friction " + number(reading.friction) + ", tensile force "
	     + number(reading.adhesion) + " N, rolling arm " + number(reading.rollingArm) + " m, mean diameter "
	     + number(reading.length) + " m, restitution " + number(reading.restitution)
	     + (name ? string(", phys.") + name + " " + number(value) : "")
	     + "; all must be finite and not negative, the diameter and a bond's ellipse positive, restitution from 0 to 1: set them in its phys, or take the values of the materials with "
	       "ContactDynamicsEngine.updateStrengths()");
}

bool hasSolver(const Scene& scene)
{
	return std::any_of(scene.engines.begin(), scene.engines.end(), [](const auto& e) {
		return !e->dead && dynamic_cast<const ContactDynamicsEngine*>(e.get());
	});
}

string noSolver(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (dynamic_cast<const ContactDynamicsEngine*>(engine.get()))
			return "contacts bear nothing, since " + named(*engine)
			        + " in O.engines is dead: set its dead = False";
	return "contacts bear nothing, since O.engines has no ContactDynamicsEngine: add one before NewtonIntegrator, see yade.nonsmooth.scene.engines";
}

} // namespace yade::nscd
