#include <contact/problem_check.hpp>
#include <contact/solver.hpp>
#include <string>

namespace nonsmooth::contact {
namespace {

	template <class Number> void checkRange(const char* name, Number value, Number least, Number most)
	{
		if (value < least || value > most)
			refuse(name, " = ", value, ": it must be from ", least, " to ", most);
	}

	/// The value of two that has a name.
	template <class Value> Value named(const char* name, const char* first, const char* second, Value a, Value b)
	{
		const std::string given(name);
		if (given != first && given != second)
			refuse("'", given, "': it must be '", first, "' or '", second, "'");
		return given == first ? a : b;
	}

} // namespace

Method methodOf(const char* name)
{
	return named(name, "accelerated", "gaussSeidel", Method::Accelerated, Method::GaussSeidel);
}

Precision precisionOf(const char* name) { return named(name, "mixed", "double", Precision::Mixed, Precision::Double); }

void check(const SweepSettings& s)
{
	if (!(s.tolerance > 0) || !finite(s.tolerance))
		refuse("tolerance = ", s.tolerance, ": it must be positive and finite");
	if (s.maxIterations < 0) refuse("maxIterations = ", s.maxIterations, ": it must not be negative");
	checkRange("checkEvery", s.checkEvery, 1, mostCheckEvery);
	checkRange("threads", s.threads, 1, mostThreads);
}

void refuseBodies(const std::string& it, std::int32_t i, std::int32_t j, std::int32_t bodies)
{
	if (i < 0 || j < 0 || i >= bodies || j >= bodies)
		refuse(it, " names a body that is not there: there are ", bodies, ", counted from 0");
	if (i == j) refuse(it, " is one of a body with itself: it must name two");
}

void refuseBody(const Problem& problem, std::size_t b)
{
	const InverseMass& m = problem.inverseMass[b];
	const Twist&       v = problem.freeVelocity[b];
	if (finite(m.x, m.y, m.w, v.x, v.y, v.w))
		refuse("contact problem: body ", b, " has the inverse mass (", m.x, ", ", m.y, ", ", m.w,
		       "): none may be negative; 0 where it is blocked");
	refuse("contact problem: body ", b, " has a velocity or mass that is not finite: velocity (", v.x, ", ", v.y,
	       ", ", v.w, "), inverse mass (", m.x, ", ", m.y, ", ", m.w, ")");
}

void refusePosition(const Problem& problem, std::size_t b)
{
	const Point& x = problem.positions[b];
	refuse("contact problem: body ", b, " has the position (", x.x, ", ", x.y, "): it must be finite");
}

void refuseContact(const Problem& problem, std::size_t k)
{
	const Contact&    c      = problem.contacts[k];
	const Impulse&    p      = problem.impulses[k];
	const auto        bodies = static_cast<std::int32_t>(problem.bodyCount());
	const std::string it     = "contact problem: contact " + std::to_string(k) + " between bodies "
	        + std::to_string(c.i) + " and " + std::to_string(c.j);
	refuseBodies(it, c.i, c.j, bodies);
	const struct {
		const char* name;
		double      value;
	} all[] = { { "normal x", c.nx },
		    { "normal y", c.ny },
		    { "lever n of i", c.leverNi },
		    { "lever t of i", c.leverTi },
		    { "lever n of j", c.leverNj },
		    { "lever t of j", c.leverTj },
		    { "normal bias", c.biasN },
		    { "tangential bias", c.biasT },
		    { "rolling bias", c.biasR },
		    { "adhesion", c.adhesion },
		    { "friction", c.friction },
		    { "rolling arm", c.rollingArm },
		    { "play", c.play },
		    { "length", c.length },
		    { "normal impulse", p.n },
		    { "tangential impulse", p.t },
		    { "rolling impulse", p.r } };
	for (const auto& number : all)
		if (!finite(number.value))
			refuse(it, " has the ", number.name, " ", number.value, ": it must be finite");
	for (const auto& number : { all[9], all[10], all[11], all[12] })
		if (number.value < 0)
			refuse(it, " has the ", number.name, " ", number.value, ": it must not be negative");
	if (!(c.length > 0)) refuse(it, " has the length ", c.length, ": it must be positive");
	refuse(it, " has the normal (", c.nx, ", ", c.ny, "): its length must be 1");
}

} // namespace nonsmooth::contact
