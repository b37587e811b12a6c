// An engine's turn: what it takes when it begins, and to whom it shows what it has done when it ends.
#include "Advance.hpp"
#include "PythonMade.hpp"
#include "StageClock.hpp"
#include "Audience.hpp"
#include "Resident.hpp"
#include <core/Omega.hpp>
#include <lib/pyutil/gil.hpp>
#include <thread>

namespace yade::nscd {

namespace {
	/// Shows what a thread leaves when it ends: YADE starts one for each O.run, and O.pause() may end it behind our
	/// last look.
	struct ThreadEnd {
		std::weak_ptr<Resident> last;
		~ThreadEnd()
		{
			if (const auto resident = last.lock()) resident->show();
		}
	};
	thread_local ThreadEnd threadEnd;
}

Turn::Turn(Engine& engine_, int threads)
        : engine(engine_)
        , data(Resident::of(*engine_.scene))
        , locked(data->lock, std::defer_lock)
{
	while (data->waiting > 0)
		std::this_thread::yield();
	locked.lock();
	while (data->beingSaved) {
		locked.unlock(); // whoever saves may look again
		const gilLock saved;
		locked.lock();
		data->beingSaved = false;
	}
	endKept();
	Scene& scene  = *engine.scene;
	data->threads = threads;
	if (data->isBehind(scene)) {
		if (data->bodiesOwned || data->contactsOwned) data->show();
		data->contactsKnown = false;
	}
	// whoever comes after one of our turns is known at its end, unless O.engines was changed since
	if ((data->bodiesOwned || data->contactsOwned) && !Omega::instance().isRunning() && isTooLate(scene, engine)) {
		data->show();
		throw std::runtime_error(
		        engine.getClassName()
		        + ": O.engines was changed while O.bodies was not up to date (advance(view=False)), and engines of "
		          "YADE's own have acted in this step on bodies as they were before: call"
		          " ContactDynamicsEngine.view() before O.engines is changed. All is up to date now, and the step may be made again");
	}
	if (!data->bodiesOwned) data->takeBodies(scene);
	else if (!data->shownAlone.empty())
		data->takeShown(scene);
	if (data->contactsKnown && onlyPythonBefore(scene, engine)) data->takeKnown(scene);
	data->contactsKnown = false;
}

void Turn::end()
{
	Scene&       scene  = *engine.scene;
	const Viewer viewer = whoLooksAfter(scene, engine);
	if (!scene._nextEngines.empty()) // which take their places where the step ends, whoever has Python's lock then
		for (const auto& one : scene.engines)
			keepUntilLocked(one);
	const bool wanted = interactionsWanted(scene), others = othersMayLook(scene);
	if (viewer.name.empty() && others) {
		if (data->contactsOwned) data->hold(); // another thread may erase what the arrays point to
		threadEnd.last = data;
		if (data->looks.isDue(wanted)) data->show({ "others, now and then", true, wanted, false });
	}
	if (!viewer.name.empty()) {
		Resident::Look look { viewer.name, viewer.isPython };
		look.inSpace = !whoLooksAfter(scene, engine, LooksAt::Contacts).name.empty();
		data->show(look);
	}
	if (data->hasContactsInSpace() && others) {
		data->inSpace->hold();
		if (data->inSpace->isDue(wanted)) data->inSpace->show();
	}
	data->interactionsSeen = scene.interactions->size();
	ended                  = true;
}

Turn::~Turn()
{
	if (ended) return;
	data->show();
	engine.scene->forces
	        .sync(); // else ForceResetter leaves what was added, and the step that is made again has it twice
}

} // namespace yade::nscd
