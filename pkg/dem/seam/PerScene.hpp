// What belongs to one scene but to no engine of it, because functors ask for it: Kind is derived from PerScene<Kind>.
#pragma once

#include <core/Scene.hpp>
#include <map>
#include <memory>
#include <mutex>

namespace yade::nscd {

template <class Kind> class PerScene {
public:
	/// That of a scene; made where there is none.
	static Kind& of(Scene& scene)
	{
		// asked for each body that a functor looks at, by all threads
		thread_local std::shared_ptr<Kind> last;
		if (last && last->isOf(scene)) return *last;
		static std::mutex                                    mutex;
		static std::map<const Scene*, std::shared_ptr<Kind>> all;
		const std::lock_guard<std::mutex>                    guard(mutex);
		auto&                                                found = all[&scene];
		if (!found || !found->isOf(scene)) { // a new scene may lie where an old one was
			found            = std::make_shared<Kind>();
			found->container = scene.bodies;
			found->bodies    = scene.bodies.get();
			for (auto it = all.begin(); it != all.end();)
				it = it->second->container.expired() ? all.erase(it) : std::next(it);
		}
		return *(last = found);
	}

	/// A number that is another one in the next step, also after O.resetTime().
	static long stepOf(const Scene& scene) { return scene.iter + long(scene.forces.syncCount << 32); }

private:
	bool isOf(const Scene& scene) const { return !container.expired() && bodies == scene.bodies.get(); }

	boost::weak_ptr<BodyContainer> container;
	const BodyContainer*           bodies = nullptr;
};

} // namespace yade::nscd
