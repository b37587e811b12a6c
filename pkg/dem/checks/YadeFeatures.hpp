// Where YADE's features change what its headers declare. No other file of the engines asks for a feature's macro.
//
//     OPENMP           whether there are threads to ask for
//     MPI              Collider::mayCollide also wants the subdomain of this process
//     MASK_ARBITRARY   a group mask is a set of bits and not an int; Body::maskOk takes both
// OpenGL, VTK, MPFR and the like add members and classes, which the macros of cmake/FindYADE.cmake lay out as YADE was
// built, and change no call of ours.
#pragma once

#include <algorithm>
#include <core/Scene.hpp>
#include <pkg/common/Collider.hpp>
#ifdef YADE_OPENMP
#include <omp.h>
#endif

namespace yade::nscd {

/// Bodies that give a thread enough to do for waiting for the others at each loop's end: on an idle machine a second
/// one begins to gain at 1,000 in all.
constexpr size_t bodiesForAThread = 500;

/// YADE's own number of threads, or what the engine's ompThreads allows of it; where that is not set, not more than a
/// small scene has a use for: on a busy machine threads that wait for each other make its steps many times longer. Bits
/// do not depend on it.
inline int threadsOf([[maybe_unused]] const Engine& engine)
{
#ifdef YADE_OPENMP
	const int all = omp_get_max_threads();
	return engine.ompThreads > 0 ? std::min(engine.ompThreads, all)
	                             : int(std::clamp<size_t>(engine.scene->bodies->size() / bodiesForAThread, 1, all));
#else
	return 1;
#endif
}

/// Whether a collider allows two bodies, which must be there, to interact: by clumps, masks and, with MPI, subdomains.
inline bool mayCollide(Collider& collider, const Body& a, const Body& b)
{
#ifdef YADE_MPI
	return collider.mayCollide(&a, &b, collider.scene->subdomain);
#else
	return collider.mayCollide(&a, &b);
#endif
}

} // namespace yade::nscd
