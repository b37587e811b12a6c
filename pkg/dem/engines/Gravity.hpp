// The gravity that NewtonIntegrator adds, which is not among O.forces.
#pragma once

#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade::nscd {

inline NewtonIntegrator* findNewton(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (auto* newton = engine->dead ? nullptr : dynamic_cast<NewtonIntegrator*>(engine.get()))
			return newton;
	return nullptr;
}

/// That of the present step; while the ramp of the scene's ContactDynamicsEngine lasts the integrator gets it here,
/// whoever asks first.
Vector3r gravityOf(const Scene& scene);

} // namespace yade::nscd
