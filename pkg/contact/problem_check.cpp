#include <algorithm>
#include <cmath>
#include <contact/problem_check.hpp>
#include <contact/solver.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	constexpr double unitLength = 1e-6; // what a normal may miss of it

	template <class... Parts> [[noreturn]] void refuse(const Parts&... parts)
	{
		std::ostringstream text;
		text.precision(6);
		(text << ... << parts);
		throw std::invalid_argument(text.str());
	}

	template <class Number> void checkRange(const char* name, Number value, Number least, Number most)
	{
		if (value < least || value > most) refuse(name, " = ", value, ": it must be from ", least, " to ", most);
	}

	/// Whether none is infinite or not a number; a sum of large numbers could be.
	template <class... Numbers> bool finite(Numbers... x) { return ((x * 0) + ...) == 0; }

	bool usable(const InverseMass& m, const Twist& v) { return finite(m.x, m.y, m.w, v.x, v.y, v.w) && m.x >= 0 && m.y >= 0 && m.w >= 0; }

	bool usable(const Contact& c, const Impulse& p, std::int32_t bodies)
	{
		return c.i >= 0 && c.j >= 0 && c.i < bodies && c.j < bodies && c.i != c.j && std::abs(c.nx * c.nx + c.ny * c.ny - 1) <= 2 * unitLength
		        && finite(c.leverNi, c.leverTi, c.leverNj, c.leverTj, c.biasN, c.biasT, c.biasR, c.adhesion, c.friction, c.rollingArm, c.length)
		        && c.adhesion >= 0 && c.friction >= 0 && c.rollingArm >= 0 && c.length > 0 && finite(p.n, p.t, p.r);
	}

	[[noreturn]] void explain(const InverseMass& m, const Twist& v, std::size_t b)
	{
		if (finite(m.x, m.y, m.w, v.x, v.y, v.w))
			refuse("contact problem: body ", b, " has the inverse mass (", m.x, ", ", m.y, ", ", m.w, "): none may be negative; 0 where it is blocked");
		refuse("contact problem: body ", b, " has a velocity or mass that is not finite: velocity (", v.x, ", ", v.y, ", ", v.w, "), inverse mass (", m.x, ", ", m.y,
		       ", ", m.w, ")");
	}

	[[noreturn]] void explain(const Contact& c, const Impulse& p, std::size_t k, std::int32_t bodies)
	{
		const std::string it = "contact problem: contact " + std::to_string(k) + " between bodies " + std::to_string(c.i) + " and " + std::to_string(c.j);
		if (c.i < 0 || c.j < 0 || c.i >= bodies || c.j >= bodies) refuse(it, " names a body that is not there: there are ", bodies, ", counted from 0");
		if (c.i == c.j) refuse(it, " is one of a body with itself: it must name two");
		const struct {
			const char* name;
			double      value;
		} all[] = { { "normal x", c.nx },         { "normal y", c.ny },         { "lever n of i", c.leverNi }, { "lever t of i", c.leverTi },
			    { "lever n of j", c.leverNj }, { "lever t of j", c.leverTj }, { "normal bias", c.biasN },    { "tangential bias", c.biasT },
			    { "rolling bias", c.biasR },  { "adhesion", c.adhesion },   { "friction", c.friction },    { "rolling arm", c.rollingArm },
			    { "length", c.length },       { "normal impulse", p.n },    { "tangential impulse", p.t }, { "rolling impulse", p.r } };
		for (const auto& number : all)
			if (!finite(number.value)) refuse(it, " has the ", number.name, " ", number.value, ": it must be finite");
		for (const auto& number : { all[9], all[10], all[11] })
			if (number.value < 0) refuse(it, " has the ", number.name, " ", number.value, ": it must not be negative");
		if (!(c.length > 0)) refuse(it, " has the length ", c.length, ": it must be positive");
		refuse(it, " has the normal (", c.nx, ", ", c.ny, "): its length must be 1");
	}

	void checkSize(const char* name, std::size_t found, std::size_t wanted, const char* ofWhat)
	{
		if (found != wanted) refuse("contact problem: ", name, " has ", found, " entries for ", wanted, " ", ofWhat);
	}

} // namespace

void check(const SolverSettings& s)
{
	if (!(s.tolerance > 0) || !finite(s.tolerance)) refuse("tolerance = ", s.tolerance, ": it must be positive and finite");
	if (s.maxIterations < 0) refuse("maxIterations = ", s.maxIterations, ": it must not be negative");
	checkRange("checkEvery", s.checkEvery, 1, mostCheckEvery);
	checkRange("threads", s.threads, 1, mostThreads);
}

void check(const Problem& problem, int threads)
{
	checkSize("freeVelocity", problem.freeVelocity.size(), problem.bodyCount(), "bodies");
	if (!problem.positions.empty()) checkSize("positions", problem.positions.size(), problem.bodyCount(), "bodies");
	checkSize("impulses", problem.impulses.size(), problem.contactCount(), "contacts");
	for (std::size_t b = 0; b < problem.bodyCount(); ++b)
		if (!usable(problem.inverseMass[b], problem.freeVelocity[b])) explain(problem.inverseMass[b], problem.freeVelocity[b], b);
	for (std::size_t b = 0; b < problem.positions.size(); ++b)
		if (const Point& x = problem.positions[b]; !finite(x.x, x.y))
			refuse("contact problem: body ", b, " has the position (", x.x, ", ", x.y, "): it must be finite");
	const auto bodies = static_cast<std::int32_t>(problem.bodyCount());
	const long count  = static_cast<long>(problem.contactCount());
	long       bad    = count; // the first one, found by threads, which must not throw
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad)
	for (long k = 0; k < count; ++k)
		if (!usable(problem.contacts[k], problem.impulses[k], bodies)) bad = std::min(bad, k);
	if (bad < count) explain(problem.contacts[bad], problem.impulses[bad], bad, bodies);
}

} // namespace nonsmooth::contact
