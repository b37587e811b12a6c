// YADE's thread of O.run() notes the exception that ends it, and O.wait() throws what it finds noted, but only where it
// has come before the end. Where the end was first, and in a script that never waits, nobody hears of it, and the next
// O.run() forgets it. Here Python gets at the note.
#include "BackgroundRun.hpp"
#include <lib/base/Math.hpp>
#include <boost/python.hpp>
#include <core/Omega.hpp>
#include <core/ThreadRunner.hpp>
#include <mutex>

namespace yade::nscd {

namespace py = boost::python;

namespace {
	// YADE shows neither of the two; a template's explicit instantiation may name what is private.
	template <class Whose, typename Whose::Member member> struct Opened {
		friend typename Whose::Member open(Whose) { return member; }
	};
	struct Runner {
		using Member = shared_ptr<ThreadRunner> Omega::*;
		friend Member                           open(Runner);
	};
	struct StepLock {
		using Member = std::mutex ThreadRunner::*;
		friend Member             open(StepLock);
	};
	template struct Opened<Runner, &Omega::simulationLoop>;
	template struct Opened<StepLock, &ThreadRunner::m_runmutex>;

	shared_ptr<ThreadRunner> runner() { return Omega::instance().*open(Runner {}); }

	/// The message of the exception that ended the last run and that nobody has heard of, which forgets it; None if
	/// there is none.
	py::object takeFailure()
	{
		const auto last = runner();
		if (!last || last->looping() || !last->workerThrew.exchange(false)) return {};
		return py::str(last->workerException.what());
	}

	/// Whether no step of a run is under way; O.running says so as soon as one is to be the last. Not to be asked
	/// in the run's own thread.
	bool isOver()
	{
		const auto last = runner();
		if (!last) return true;
		const std::unique_lock<std::mutex> free(last.get()->*open(StepLock {}), std::try_to_lock);
		return free.owns_lock();
	}
}

void watchBackgroundRuns()
{
	try {
		py::import("yade.nonsmooth.world.background")
		        .attr("watch")(py::make_function(&takeFailure), py::make_function(&isOver));
	} catch (const py::error_already_set&) {
		PyErr_Print(); // YADE's loop over classes would hide it, and try this one a hundred times
	}
}

} // namespace yade::nscd
