#include <contact/plane/problem_check.hpp>
#include <string>

namespace nonsmooth::contact {
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
