// How many threads an engine runs on.
#pragma once

#include <algorithm>
#include <core/Engine.hpp>
#ifdef YADE_OPENMP
#include <omp.h>
#endif

namespace yade::nscd {

/// YADE's own number, or what the engine's ompThreads allows of it.
inline int threadsOf([[maybe_unused]] const Engine& engine)
{
#ifdef YADE_OPENMP
	return engine.ompThreads > 0 ? std::min(engine.ompThreads, omp_get_max_threads()) : omp_get_max_threads();
#else
	return 1;
#endif
}

} // namespace yade::nscd
