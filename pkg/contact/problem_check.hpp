// What the solver refuses before it starts: numbers and sizes that it cannot compute with. Who reads bodies and contacts anyway asks usable() of each
// (problem_survey.hpp), so that memory is gone through once.
#pragma once

#include <cmath>
#include <contact/problem.hpp>
#include <sstream>
#include <stdexcept>

namespace nonsmooth::contact {

struct SweepSettings;

constexpr int    mostThreads    = 1024;
constexpr int    mostCheckEvery = 1'000'000; // sweeps
constexpr double unitLength     = 1e-6; // what a normal may miss of it

/// Whether none is infinite or not a number; a sum of large numbers could be.
template <class... Numbers> bool finite(Numbers... x) { return ((x * 0) + ...) == 0; }

inline bool usable(const Point& x) { return finite(x.x, x.y); }

inline bool usable(const InverseMass& m, const Twist& v)
{
	return finite(m.x, m.y, m.w, v.x, v.y, v.w) && m.x >= 0 && m.y >= 0 && m.w >= 0;
}

inline bool usable(const Contact& c, const Impulse& p, std::int32_t bodies)
{
	return c.i >= 0 && c.j >= 0 && c.i < bodies && c.j < bodies && c.i != c.j
	        && std::abs(c.nx * c.nx + c.ny * c.ny - 1) <= 2 * unitLength
	        && finite(
	                c.leverNi, c.leverTi, c.leverNj, c.leverTj, c.biasN, c.biasT, c.biasR, c.adhesion, c.friction,
	                c.rollingArm, c.length, c.play)
	        && c.adhesion >= 0 && c.friction >= 0 && c.rollingArm >= 0 && c.length > 0 && c.play >= 0
	        && finite(p.n, p.t, p.r);
}

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

/// Throws std::invalid_argument naming the first of `bodies` that the contact `it` names and that is not there, or the one that it names twice.
void refuseBodies(const std::string& it, std::int32_t i, std::int32_t j, std::int32_t bodies);

/// Throw std::invalid_argument naming what cannot be used, and why.
[[noreturn]] void refuseBody(const Problem& problem, std::size_t body);
[[noreturn]] void refusePosition(const Problem& problem, std::size_t body);
[[noreturn]] void refuseContact(const Problem& problem, std::size_t contact);

} // namespace nonsmooth::contact
