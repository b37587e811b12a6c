#include "Advance.hpp"
#include "PythonMade.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include "Audience.hpp"
#include "Resident.hpp"
#include <atomic>
#include <boost/python/stl_iterator.hpp>
#include <chrono>
#include <exception>
#include <core/Omega.hpp>
#include <limits>
#include <optional>

namespace yade::nscd {

namespace py = boost::python;

namespace {
	constexpr long endless = std::numeric_limits<long>::max();
	constexpr Real never   = std::numeric_limits<Real>::infinity();

	/// The advance() that is under way; a thread of Python may ask for it at any time.
	struct Course {
		std::atomic<const Scene*> scene { nullptr };
		std::atomic<long>         left { 0 };
		std::atomic<Real>         until { never };
		std::atomic<bool>         interactions { true };

		void set(const Scene* of, long steps, Real end, bool all)
		{
			scene        = of;
			left         = steps;
			until        = end;
			interactions = all;
		}
	} present;

	/// Makes a course the present one for as long as the block lasts; an engine of one scene may advance another.
	class Entered {
	public:
		Entered(const Scene& scene, long steps, Real until, bool interactions)
		{
			present.set(&scene, steps, until, interactions);
		}
		~Entered() { present.set(scene, left, until, interactions); }
		Entered(const Entered&)            = delete;
		Entered& operator=(const Entered&) = delete;

	private:
		const Scene* scene        = present.scene;
		const long   left         = present.left;
		const Real   until        = present.until;
		const bool   interactions = present.interactions;
	};

	/// The step that an exception ended within advance(), which may then go on with it, as O.step() does.
	struct Broken {
		const Scene* scene = nullptr;
		long         iter  = -1;

		bool is(const Scene& other) const { return scene == &other && iter == other.iter; }
	} broken;

	std::atomic<const Scene*> begun { nullptr }; // whose step has, see StepHasBegun

	/// The interpreter's lock is free for as long as the block lasts: threads of Python go on, and engines that
	/// need it take it.
	class Unlocked {
	public:
		Unlocked() = default;
		~Unlocked() { PyEval_RestoreThread(state); }
		Unlocked(const Unlocked&)            = delete;
		Unlocked& operator=(const Unlocked&) = delete;

		/// Lets Python's handlers of signals run, and throws what they raise.
		void hearSignals()
		{
			PyEval_RestoreThread(state);
			const bool raised = PyErr_CheckSignals() != 0;
			state             = PyEval_SaveThread();
			if (raised) py::throw_error_already_set();
		}

	private:
		PyThreadState* state = PyEval_SaveThread();
	};

	/// What is up to date in the end: all, or some bodies alone; all where an exception ends it.
	struct Shown {
		Scene&                                 scene;
		const std::optional<std::vector<int>>& some;
		const int                              exceptions = std::uncaught_exceptions();
		~Shown()
		{
			const auto resident = Resident::of(scene);
			if (some && std::uncaught_exceptions() == exceptions) resident->showOnly(*some);
			else
				resident->show({ "the end of advance()", true });
		}
	};

	[[noreturn]] void refuse(const string& why)
	{
		throw std::runtime_error("ContactDynamicsEngine.advance: " + why);
	}
	[[noreturn]] void refuseValue(const string& why)
	{
		throw std::invalid_argument("ContactDynamicsEngine.advance: " + why);
	}

	long countOf(const py::object& steps)
	{
		if (steps.is_none()) return endless;
		const py::object whole(
		        py::handle<>(PyNumber_Index(steps.ptr()))); // numbers of NumPy too; TypeError for a float
		const long count = PyLong_AsLong(whole.ptr());
		if (count == -1 && PyErr_Occurred()) py::throw_error_already_set();
		if (count < 0) refuseValue("steps = " + std::to_string(count) + ": give 0 or more");
		return count;
	}

	Real timeOf(const py::object& until)
	{
		if (until.is_none()) return never;
		const Real time = PyFloat_AsDouble(until.ptr());
		if (PyErr_Occurred()) py::throw_error_already_set();
		if (!std::isfinite(time)) refuseValue("until = " + nscd::number(time) + ": give a finite time [s]");
		return time;
	}

	/// Bodies that are to be up to date in the end; none where all are.
	std::optional<std::vector<int>> bodiesOf(const py::object& view, const Scene& scene)
	{
		if (view.ptr() == Py_True) return {};
		std::vector<int> ids;
		if (view.ptr() == Py_False) return ids;
		const py::object all(py::handle<>(PyObject_GetIter(view.ptr()))); // TypeError for what is no list
		for (py::stl_input_iterator<py::object> at(all), end; at != end; ++at) {
			const py::object whole(py::handle<>(PyNumber_Index(py::object(*at).ptr())));
			const long       id = PyLong_AsLong(whole.ptr());
			if (id == -1 && PyErr_Occurred()) py::throw_error_already_set();
			if (id < 0 || size_t(id) >= scene.bodies->size() || !(*scene.bodies)[id])
				refuseValue("view: there is no body #" + std::to_string(id) + ": give ids of O.bodies");
			ids.push_back(int(id));
		}
		return ids;
	}

	/// Whether the time has come, to half a step, at the end of a step of a scene.
	bool hasCome(Real until, Real time, Real step) { return !(time < until - 0.5 * step); }

	void check(const Scene& scene)
	{
		if (Omega::instance().isRunning())
			refuse("O.run() is making steps in the background: call O.pause() or O.wait() first");
		if (scene.subStepping)
			refuse("O.subStepping is on, and a step is more than one call then: set O.subStepping = False, or call O.step()");
		if (present.scene == &scene)
			refuse("it is making steps of this scene already: call it between two steps, not from an engine or another thread");
		if (begun == &scene || (scene.subStep >= 0 && !broken.is(scene)))
			refuse("step " + std::to_string(scene.iter)
			       + " has begun and is not over: call it between two steps and not from an engine; where an error has "
			         "ended the step, call O.step() to finish it");
	}
}

StepHasBegun::StepHasBegun(const Scene& scene)
        : before(begun.exchange(&scene))
{
}

StepHasBegun::~StepHasBegun() { begun = before; }

long stepsLeft(const Scene& scene)
{
	if (present.scene != &scene) return 0;
	return hasCome(present.until, scene.time + scene.dt, scene.dt) ? 1 : present.left.load();
}

bool interactionsWanted(const Scene& scene) { return present.scene != &scene || present.interactions; }

long advance(const py::object& steps, const py::object& until, const py::object& view)
{
	const long count = countOf(steps);
	const Real end   = timeOf(until);
	if (count == endless && end == never) refuseValue("give steps, until [s], or both");
	const shared_ptr<Scene> scene = Omega::instance()
	                                        .getScene(); // held: an engine may end it, and its step goes on
	check(*scene);
	const auto some = bodiesOf(view, *scene);
	if (count == 0) return 0;
	if (const auto* first = whoLooksFirst(
	            *scene)) // engines may have been exchanged since an advance() showed nothing
	{
		Resident::Look look { named(*first) };
		look.inSpace = whoLooksFirst(*scene, LooksAt::Contacts) != nullptr;
		Resident::of(*scene)->show(look);
	}
	const Entered entered(*scene, count, end, !some);
	const struct Ending {
		~Ending() { endKept(); }
	} ending; // after the lock is back
	Unlocked unlocked;
	using Steady                = std::chrono::steady_clock;
	constexpr auto betweenLooks = std::chrono::milliseconds(20);
	auto           looked       = Steady::now();
	long           made         = 0;
	const Shown    shown { *scene, some };
	while (made < count && !hasCome(end, scene->time, scene->dt)) {
		broken = {};
		try {
			scene->moveToNextTimeStep();
		} catch (...) {
			broken = { scene.get(), scene->iter };
			throw;
		}
		++made;
		if (count != endless) --present.left;
		else if (!(scene->dt > 0))
			refuse("after " + std::to_string(made) + " steps O.dt = " + nscd::number(scene->dt)
			       + ", and until = " + nscd::number(end)
			       + " s never comes: set a positive O.dt, or give steps");
		if (Omega::instance().getScene() != scene)
			refuse("after " + std::to_string(made)
			       + " steps an engine has put another scene in the place of the one that was to be advanced (O.reset, O.load, O.switchScene)");
		if (Steady::now() - looked < betweenLooks) continue;
		unlocked.hearSignals();
		looked = Steady::now();
	}
	return made;
}

} // namespace yade::nscd
