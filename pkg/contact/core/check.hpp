// How the solver refuses numbers and sizes that it cannot compute with, before it starts; for problems of any
// dimension.
#pragma once

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {

struct SweepSettings;

constexpr int    mostThreads    = 1024;
constexpr int    mostCheckEvery = 1'000'000; // sweeps
constexpr double unitLength     = 1e-6; // what a normal may miss of it

/// Whether none is infinite or not a number; a sum of large numbers could be.
template <class... Numbers> bool finite(Numbers... x) { return ((x * 0) + ...) == 0; }

/// Throws std::invalid_argument naming the setting, its value and what would do.
void check(const SweepSettings& settings);

/// Throws std::invalid_argument with the parts put together, numbers with six digits.
template <class... Parts> [[noreturn]] void refuse(const Parts&... parts)
{
	std::ostringstream text;
	text.precision(6);
	(text << ... << parts);
	throw std::invalid_argument(text.str());
}

/// Throws std::invalid_argument where arrays of one kind have not one size; for problems of any dimension.
template <class Problem> void checkSizes(const Problem& problem)
{
	const auto checkSize = [](const char* name, std::size_t found, std::size_t wanted, const char* ofWhat) {
		if (found != wanted)
			refuse("contact problem: ", name, " has ", found, " entries for ", wanted, " ", ofWhat);
	};
	checkSize("freeVelocity", problem.freeVelocity.size(), problem.bodyCount(), "bodies");
	if (!problem.positions.empty()) checkSize("positions", problem.positions.size(), problem.bodyCount(), "bodies");
	checkSize("impulses", problem.impulses.size(), problem.contactCount(), "contacts");
}

/// Throws std::invalid_argument naming the first of `bodies` that the contact `it` names and that is not there, or the
/// one that it names twice.
void refuseBodies(const std::string& it, std::int32_t i, std::int32_t j, std::int32_t bodies);

} // namespace nonsmooth::contact
