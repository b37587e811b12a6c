#include "Gravity.hpp"
#include "ContactDynamicsEngine.hpp"

namespace yade::nscd {

Vector3r gravityOf(const Scene& scene)
{
	auto* newton = findNewton(scene);
	if (!newton) return Vector3r::Zero();
	for (const auto& engine : scene.engines)
		if (auto* solver = engine->dead ? nullptr : dynamic_cast<ContactDynamicsEngine*>(engine.get()))
			solver->growGravity(*newton, scene.time);
	return newton->gravity;
}

} // namespace yade::nscd
