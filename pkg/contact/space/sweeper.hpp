// The sweeps of the driver (contact/sweeper.hpp) in space.
#pragma once

#include <contact/space/solver.hpp>
#include <contact/sweeper.hpp>

namespace nonsmooth::contact::space {

inline const BlockKernels& kernelsFor(const SolverSettings& settings)
{
	return settings.kernels ? *settings.kernels : *availableKernels().front();
}

} // namespace nonsmooth::contact::space
