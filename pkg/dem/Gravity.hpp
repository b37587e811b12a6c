// The gravity that NewtonIntegrator adds, which is not among O.forces.
#pragma once

#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade::nscd {

inline const NewtonIntegrator* findNewton(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (const auto* newton = engine->dead ? nullptr : dynamic_cast<const NewtonIntegrator*>(engine.get())) return newton;
	return nullptr;
}

inline Vector3r gravityOf(const Scene& scene)
{
	const auto* newton = findNewton(scene);
	return newton ? newton->gravity : Vector3r(Vector3r::Zero());
}

} // namespace yade::nscd
