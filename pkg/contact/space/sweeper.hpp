// The sweeps of the driver (contact/core/sweeper.hpp) in space.
#pragma once

#include <contact/space/solver.hpp>
#include <contact/core/sweeper.hpp>

namespace nonsmooth::contact::space {

inline const BlockKernels& kernelsFor(const SolverSettings& settings)
{
	return settings.kernels ? *settings.kernels : *availableKernels().front();
}

} // namespace nonsmooth::contact::space
