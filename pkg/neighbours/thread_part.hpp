// What each thread of a parallel region has for itself.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

namespace nonsmooth::neighbours {

/// The part of the thread that asks; `parts` has one for each.
template <class Parts> auto& partOfThread(Parts& parts)
{
#ifdef _OPENMP
	return parts[omp_get_thread_num()];
#else
	return parts[0];
#endif
}

} // namespace nonsmooth::neighbours
