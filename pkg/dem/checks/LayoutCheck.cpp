// The gate of the plugin (libnonsmooth.so): opens nonsmooth_engines.so only if YADE's classes are laid
// out in memory as the headers said when the plugin was compiled.
//
// YADE's layouts depend on its version and on the features it was built with. A plugin compiled for
// others loads, registers its classes, and corrupts memory later. YADE loads every lib*.so of its library
// folder and aborts when one fails. So this library always loads; where something differs it leaves
// the engines out, says why on stderr, and keeps the message for `from yade import nonsmooth`.
//
// How a layout is compared: YADE makes an object, sets an attribute by its name as Python does (with the
// offsets compiled into YADE), and we read the same attribute through our headers (with ours).

#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/Serializable.hpp>
#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/Cell.hpp>
#include <core/Dispatching.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>
#include <core/State.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/Bo1_Aabb.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/ForceEngine.hpp>
#include <pkg/common/InsertionSortCollider.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/TorqueEngine.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/ScGeom.hpp>
#include <pkg/dem/TriaxialStressController.hpp>
#include <pkg/dem/UniaxialStrainer.hpp>
// clang-format off
// their headers have classes that draw too, whose code a YADE without OpenGL has not: this library must load whatever
// the macros were
#pragma push_macro("YADE_OPENGL")
#undef YADE_OPENGL
#include <pkg/common/Wall.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/dem/DomainLimiter.hpp>
#pragma pop_macro("YADE_OPENGL")
// clang-format on

#include <dlfcn.h>
#include <malloc.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

namespace py = boost::python;
using namespace yade;

const char* const REMEDY = "Build the plugin again for this YADE (scripts/setup.sh).";

// Why the engines were left out; empty when they were loaded.
std::string& refusal()
{
	static std::string reason;
	return reason;
}

[[noreturn]] void refuse(const std::string& reason) { throw std::runtime_error(reason); }

[[noreturn]] void misplaced(const std::string& attribute)
{
	refuse("YADE's " + attribute + " is not where its header says it is in memory.");
}

void checkVersionAndFeatures()
{
	const py::object  config  = py::import("yade.config");
	const std::string version = py::extract<std::string>(config.attr("version"));
	if (version != NONSMOOTH_YADE_VERSION)
		refuse("it was built for YADE " NONSMOOTH_YADE_VERSION ", and this is YADE " + version + ".");
	const std::string features = py::extract<std::string>(py::str(" ").join(config.attr("features")));
	if (features != NONSMOOTH_YADE_FEATURES)
		refuse("it was built for a YADE with the features '" NONSMOOTH_YADE_FEATURES "', and this one has '"
		       + features + "'.");
}

template <class Class> boost::shared_ptr<Serializable> make(const char* name)
{
	auto object = boost::static_pointer_cast<Serializable>(ClassFactory::instance().createShared(name));
	if (malloc_usable_size(object.get()) < sizeof(Class))
		refuse(std::string("YADE's class ") + name + " is smaller than its header says.");
	return object;
}

template <class Class, class Member, class Value>
void check(const char* name, const char* attribute, Member Class::*member, Value value)
{
	const auto object = make<Class>(name);
	object->pySetAttr(attribute, py::object(value));
	if (static_cast<const Class&>(*object).*member != value) misplaced(std::string(name) + "." + attribute);
}

// For each class the engines touch: its own first and last attributes of a plain type, so that a member
// missing or added before them, or in a base class, shows.
void checkLayout()
{
	check("Scene", "dt", &Scene::dt, 0.125);
	check("Scene", "stopAtTime", &Scene::stopAtTime, 0.375);
	check("Scene", "selectedBody", &Scene::selectedBody, 321);
	const auto        scene = make<Scene>("Scene");
	const std::size_t tags  = static_cast<const Scene&>(*scene).tags.size(); // every new scene has some
	if (tags < 1 or tags > 1000) misplaced("Scene.tags");

	// the containers of a scene, two of which have no attributes that could be set: what YADE's own code leaves in
	// them
	auto& live = static_cast<Scene&>(*scene);
	if (live.interactions->size() != 0 or live.interactions->iterColliderLastRun != -1)
		misplaced("InteractionContainer.iterColliderLastRun");
	if (not live.forces.synced or live.forces.lastReset != 0) misplaced("ForceContainer.synced");
	live.forces.addForce(0, Vector3r(1, 0, 0));
	if (live.forces.synced) misplaced("ForceContainer.synced");
	check("BodyContainer", "checkedByCollider", &BodyContainer::checkedByCollider, true);
	check("BodyContainer", "useRedirection", &BodyContainer::useRedirection, true);
	check("BodyContainer", "enableRedirection", &BodyContainer::enableRedirection, false);
	check("Cell", "homoDeform", &Cell::homoDeform, 1);
	check("Cell", "velGradChanged", &Cell::velGradChanged, true);
	check("Cell", "flipFlippable", &Cell::flipFlippable, true);
	make<EnergyTracker>("EnergyTracker");

	check("Body", "id", &Body::id, 44);
	check("Body", "flags", &Body::flags, 13);
	check("Body", "clumpId", &Body::clumpId, 77);
	check("Body", "timeBorn", &Body::timeBorn, 0.625);
	check("State", "mass", &State::mass, 2.125);
	check("State", "isDamped", &State::isDamped, false);
	check("State", "densityScaling", &State::densityScaling, 3.375);
	check("Aabb", "lastUpdateIter", &Aabb::lastUpdateIter, 45);
	check("Aabb", "sweepLength", &Aabb::sweepLength, 0.3125);
	make<Aabb>("Aabb");
	check("Sphere", "wire", &Sphere::wire, true);
	check("Sphere", "highlight", &Sphere::highlight, true);
	check("Sphere", "radius", &Sphere::radius, 4.625);
	check("Wall", "sense", &Wall::sense, 1);
	check("Wall", "axis", &Wall::axis, 2);
	make<Box>("Box"); // vectors have no converter yet when this is asked
	const auto facet = make<Facet>("Facet"); // a new one has three vertices
	if (static_cast<const Facet&>(*facet).vertices.size() != 3) misplaced("Facet.vertices");
	check("Interaction", "iterMadeReal", &Interaction::iterMadeReal, 987L);
	check("Interaction", "iterBorn", &Interaction::iterBorn, 654L);
	check("Interaction", "linIx", &Interaction::linIx, 46);
	check("FrictMat", "id", &FrictMat::id, 47);
	check("FrictMat", "young", &FrictMat::young, 2.875);
	check("FrictMat", "poisson", &FrictMat::poisson, 0.1875);
	check("FrictMat", "density", &FrictMat::density, 5.125);
	check("FrictMat", "frictionAngle", &FrictMat::frictionAngle, 0.875);
	check("CohFrictMat", "isCohesive", &CohFrictMat::isCohesive, false);
	check("CohFrictMat", "momentRotationLaw", &CohFrictMat::momentRotationLaw, true);
	check("ScGeom", "refR1", &ScGeom::refR1, 1.625);
	check("ScGeom", "refR2", &ScGeom::refR2, 1.875);
	check("ScGeom", "penetrationDepth", &ScGeom::penetrationDepth, 6.375);
	check("FrictPhys", "kn", &FrictPhys::kn, 7.625);
	check("FrictPhys", "ks", &FrictPhys::ks, 8.125);
	check("FrictPhys", "tangensOfFrictionAngle", &FrictPhys::tangensOfFrictionAngle, 9.375);
	check("CohFrictPhys", "kr", &CohFrictPhys::kr, 3.125);
	check("CohFrictPhys", "ktw", &CohFrictPhys::ktw, 3.625);
	check("CohFrictPhys", "cohesionDisablesFriction", &CohFrictPhys::cohesionDisablesFriction, true);
	check("CohFrictPhys", "fragile", &CohFrictPhys::fragile, false);
	check("CohFrictPhys", "unp", &CohFrictPhys::unp, 4.125);
	check("CohFrictPhys", "creep_viscosity", &CohFrictPhys::creep_viscosity, 4.375);

	check("GlobalEngine", "dead", &GlobalEngine::dead, true);
	check("GlobalEngine", "label", &GlobalEngine::label, std::string("probe"));
	check("PeriodicEngine", "virtPeriod", &PeriodicEngine::virtPeriod, 5.625);
	check("PeriodicEngine", "iterPeriod", &PeriodicEngine::iterPeriod, 52L);
	check("PeriodicEngine", "firstIterRun", &PeriodicEngine::firstIterRun, 53L);
	check("PeriodicEngine", "iterLast", &PeriodicEngine::iterLast, 54L);
	check("PeriodicEngine", "nDone", &PeriodicEngine::nDone, 48L);
	check("GlobalStiffnessTimeStepper", "active", &TimeStepper::active, false);
	check("GlobalStiffnessTimeStepper", "timeStepUpdateInterval", &TimeStepper::timeStepUpdateInterval, 49u);
	check("InteractionLoop", "loopOnSortedInteractions", &InteractionLoop::loopOnSortedInteractions, true);
	check("BoundDispatcher", "activated", &BoundDispatcher::activated, false);
	check("BoundDispatcher", "targetInterv", &BoundDispatcher::targetInterv, 5.875);
	check("IGeomDispatcher", "label", &IGeomDispatcher::label, std::string("probe"));
	check("Bo1_Sphere_Aabb", "aabbEnlargeFactor", &Bo1_Sphere_Aabb::aabbEnlargeFactor, 6.125);
	if constexpr (std::is_same<mask_t, int>::value) { // masks of many bits are no plain attributes
		check("Body", "groupMask", &Body::groupMask, mask_t(50));
		check("InsertionSortCollider", "avoidSelfInteractionMask", &Collider::avoidSelfInteractionMask,
		      mask_t(51));
	}
	const auto push = make<ForceEngine>("ForceEngine"), turn = make<TorqueEngine>("TorqueEngine");
	if (not static_cast<const ForceEngine&>(*push).ids.empty()
	    or static_cast<const ForceEngine&>(*push).force != Vector3r::Zero())
		misplaced("ForceEngine.force");
	if (not static_cast<const TorqueEngine&>(*turn).ids.empty()
	    or static_cast<const TorqueEngine&>(*turn).moment != Vector3r::Zero())
		misplaced("TorqueEngine.moment");
	check("LawTester", "displIsRel", &LawTester::displIsRel, false);
	check("LawTester", "rotWeight", &LawTester::rotWeight, 0.6875);
	const auto tester = make<LawTester>("LawTester");
	if (not static_cast<const LawTester&>(*tester).disPath.empty()
	    or not static_cast<const LawTester&>(*tester).rotPath.empty())
		misplaced("LawTester.disPath");
	check("TriaxialStressController", "max_vel", &TriaxialStressController::max_vel, 0.375);
	check("TriaxialStressController", "stressMask", &TriaxialStressController::stressMask, 5);
	check("UniaxialStrainer", "active", &UniaxialStrainer::active, false);
	check("UniaxialStrainer", "asymmetry", &UniaxialStrainer::asymmetry, 1);
	check("UniaxialStrainer", "crossSectionArea", &UniaxialStrainer::crossSectionArea, 2.375);
	check("UniaxialStrainer", "stressUpdateInterval", &UniaxialStrainer::stressUpdateInterval, 55);
	check("InsertionSortCollider", "numAction", &InsertionSortCollider::numAction, 7);
	check("NewtonIntegrator", "ompThreads", &NewtonIntegrator::ompThreads, 3);
	check("NewtonIntegrator", "damping", &NewtonIntegrator::damping, 0.0625);
	check("NewtonIntegrator", "mask", &NewtonIntegrator::mask, 5);
	check("Ig2_Sphere_Sphere_ScGeom", "label", &Ig2_Sphere_Sphere_ScGeom::label, std::string("probe"));
	check("Ig2_Sphere_Sphere_ScGeom", "interactionDetectionFactor",
	      &Ig2_Sphere_Sphere_ScGeom::interactionDetectionFactor, 1.5);
}

void loadEngines()
{
	Dl_info here;
	if (not dladdr(reinterpret_cast<void*>(&loadEngines), &here)) refuse("its folder could not be found.");
	const std::string path(here.dli_fname);
	const std::string engines = path.substr(0, path.rfind('/') + 1) + "nonsmooth_engines.so";
	if (not dlopen(engines.c_str(), RTLD_NOW | RTLD_GLOBAL)) refuse(dlerror());
}

// Runs when YADE opens this library: after YADE's own libraries, before any class becomes known to Python.
__attribute__((constructor)) void open()
{
	if (not Py_IsInitialized()) {
		refusal() = "it was loaded outside YADE.";
		return;
	}
	const PyGILState_STATE gil = PyGILState_Ensure();
	try {
		checkVersionAndFeatures();
		checkLayout();
		loadEngines();
	} catch (const py::error_already_set&) {
		PyErr_Print();
		refusal() = "YADE's classes could not be examined (see the Python error above).";
	} catch (const std::exception& error) {
		refusal() = error.what();
	}
	if (not refusal().empty()) {
		refusal() = "the plugin yade-nonsmooth was not loaded: " + refusal() + " " + REMEDY;
		std::fprintf(stderr, "error: %s\n", refusal().c_str());
	}
	PyGILState_Release(gil);
}

} // namespace

// For yade.nonsmooth: the reason why the engines are missing, or an empty string.
extern "C" const char* nonsmooth_refusal() { return refusal().c_str(); }
