// What the solver refuses before it starts: numbers and sizes that it cannot compute with.
#pragma once

#include <contact/problem.hpp>

namespace nonsmooth::contact {

struct SolverSettings;

constexpr int mostThreads    = 1024;
constexpr int mostCheckEvery = 1'000'000; // sweeps

/// Throws std::invalid_argument naming the setting, its value and what would do.
void check(const SolverSettings& settings);

/// Throws std::invalid_argument naming the first body or contact that cannot be used, and why. `threads`: to look with.
void check(const Problem& problem, int threads);

} // namespace nonsmooth::contact
