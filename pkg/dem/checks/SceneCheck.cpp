#include "SceneCheck.hpp"
#include "../engines/ContactDynamicsEngine.hpp"
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "../engines/NscdInteractionLoop.hpp"
#include "../engines/PlanarGridCollider.hpp"
#include "Refusal.hpp"
#include "UnguardedHeaders.hpp"
#include <cmath>
#include <core/InteractionLoop.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/ForceResetter.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/UniaxialStrainer.hpp>
#include <map>
#include <set>
#include <typeindex>
#include <pkg/dem/TriaxialStressController.hpp>
#include <unordered_set>

namespace yade::nscd {

string named(const Engine& engine)
{
	return engine.getClassName() + (engine.label.empty() ? "" : " '" + engine.label + "'");
}

namespace {
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
			     + ": bodies outside of the mask would not move, and the solver would take them for moving: set mask=-1, "
			       "and block the DOFs of bodies that must stay");
		if (newton.densityScaling)
			fail("NewtonIntegrator.densityScaling = True, which changes masses that the solver does not see: set "
			     "densityScaling=False (rigid contacts do not need it)");
	}

	/// A triaxial controller that measures alone, and moves walls by rates of strain: with max_vel = 0 no stress moves
	/// one. harden() leaves it so, and loads walls itself.
	bool steersNoStress(const Engine& engine)
	{
		const auto* controller = dynamic_cast<const TriaxialStressController*>(&engine);
		return controller && controller->max_vel == 0 && engine.getClassName() != "ThreeDTriaxialEngine";
	}

	/// Engines of YADE's that steer by what rigid contacts and flat scenes have not, with what does their work; by
	/// name, since not every YADE has all of them.
	void refuseController(const Scene& scene, const Engine& engine)
	{
		thread_local std::unordered_set<std::type_index>
		        others; // classes that are none of these: a name costs more than a type
		if (others.count(typeid(engine))) return;
		static const string stress
		        = " moves walls by the stiffness of their contacts, and rigid contacts have none, so that walls would "
		          "go to and fro at max_vel: load plates instead (yade.nonsmooth.scene.plate, or in space harden(), which does so), set the state.vel of "
		          "walls that are to move at a given rate, or shear a sample by scripts/biaxial.py";
		static const string lid
		        = " holds the load on its lid by the stiffness of the contacts, and rigid contacts have none, so that "
		          "the lid would keep its height: load the lid by yade.nonsmooth.scene.plate, and set the state.vel of "
		          "the parts that are to move";
		static const string cell
		        = " steers a periodic cell, and periodic scenes are not supported: bound the scene by walls and load "
		          "them by yade.nonsmooth.scene.plate, or shear a sample by scripts/biaxial.py";
		static const string record
		        = " reads a triaxial engine, and those move walls by the stiffness of contacts, which rigid ones have "
		          "not: read O.forces.f of the walls after the integrator, or load and width of what "
		          "yade.nonsmooth.scene.plate returns";
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
		if (steersNoStress(engine)) return;
		if (engine.getClassName() == "TriaxialStateRecorder"
		    && std::any_of(scene.engines.begin(), scene.engines.end(), [](const auto& one) {
			       return steersNoStress(*one);
		       }))
			return;
		if (const auto found = refused.find(engine.getClassName()); found != refused.end())
			fail(named(engine) + *found->second);
		others.insert(typeid(engine));
	}

	/// Refuses paths of a LawTester that leave the plane: of its axes the third one, and of its angles the first
	/// two, do.
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

	/// Whether an engine of YADE's reads the forces on bodies when it acts.
	bool readsForces(const Engine& engine)
	{
		static const std::set<string> readers { "Disp2DPropLoadEngine", "ForceRecorder",  "KinemCNDEngine",
			                                "KinemCNLEngine",       "KinemCNSEngine", "KinemCTDEngine",
			                                "ServoPIDController",   "TimeAverager",   "TorqueRecorder",
			                                "UniaxialStrainer" };
		return readers.count(engine.getClassName());
	}
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
	        "O.engines has no InteractionLoop, so no contact would be known: add NscdInteractionLoop(...) before "
	        "ContactDynamicsEngine, see yade.nonsmooth.scene.engines");
	loops.requireBefore();
	colliders.require("O.engines has no collider, so no contact would be found: add PlanarGridCollider(...) before "
	                  "InteractionLoop, see yade.nonsmooth.scene.engines");
	colliders.requireBefore();
	if (between)
		fail(named(*between) + " stands between ContactDynamicsEngine and " + named(*newton)
		     + " in O.engines, where no reaction answers the forces and velocities that it changes: put it before "
		       "ContactDynamicsEngine if it adds forces, after the integrator if it reads them");
	if (resetters.dead && !resetters.first) resetters.require("");
	if (scene.forces.lastReset < scene.iter)
		fail("O.forces were last reset in step " + std::to_string(scene.forces.lastReset)
		     + ", and this is step " + std::to_string(scene.iter)
		     + ", so that reactions of steps before would act again: put ForceResetter() first in O.engines");
}

namespace {
	/// Engines that read forces where O.forces has none of this step: YADE's own refuse by a message that names
	/// nobody, or read zero.
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
				     + " reads forces and stands before ContactDynamicsEngine, where O.forces has no reaction of this step "
				       "yet: put it after the integrator (engines(after=[...]))"
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
		refuseController(scene, *engine);
		if (dynamic_cast<const DomainLimiter*>(engine.get()))
			throw std::runtime_error(
			        string(who) + ": O.engines has a " + named(*engine)
			        + ", which ends the process where it erases a body that Python has made: let a PyRunner at the end of "
			          "the list erase it, as PyRunner(command='for b in [b for b in O.bodies if b.state.pos[1] < -3]: "
			          "O.bodies.erase(b.id)', iterPeriod=20)");
	}
	if (const string why = halfConverted(scene); !why.empty()) throw std::runtime_error(string(who) + ": " + why);
	refuseReaders(scene);
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
