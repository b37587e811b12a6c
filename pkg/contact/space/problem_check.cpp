#include <contact/space/problem_check.hpp>
#include <string>

namespace nonsmooth::contact::space {
namespace {

	struct Named {
		const char* name;
		double      value;
	};

	std::string textOf(const Vector& a)
	{
		std::ostringstream text;
		text.precision(6);
		text << "(" << a.x << ", " << a.y << ", " << a.z << ")";
		return text.str();
	}

} // namespace

void refuseBody(const Problem& problem, std::size_t b)
{
	const InverseMass& m = problem.inverseMass[b];
	const Symmetric&   s = m.inertia;
	const Twist&       v = problem.freeVelocity[b];
	if (!usable(v.v) || !usable(v.w))
		refuse("contact problem: body ", b, " has the free velocity ", textOf(v.v), " and angular velocity ",
		       textOf(v.w), ": they must be finite");
	if (!finite(m.x, m.y, m.z) || !(m.x >= 0 && m.y >= 0 && m.z >= 0))
		refuse("contact problem: body ", b, " has the inverse mass ", textOf({ m.x, m.y, m.z }),
		       ": it must be finite, and none may be negative; 0 where it is blocked");
	refuse("contact problem: body ", b, " has the inverse inertia (", s.xx, ", ", s.yy, ", ", s.zz, ", ", s.yz,
	       ", ", s.zx, ", ", s.xy,
	       ") of xx, yy, zz, yz, zx, xy: it must be finite, and no principal value may be negative; "
	       "0 where turning is blocked");
}

void refusePosition(const Problem& problem, std::size_t b)
{
	refuse("contact problem: body ", b, " has the position ", textOf(problem.positions[b]), ": it must be finite");
}

void refuseContact(const Problem& problem, std::size_t k)
{
	const Contact&    c  = problem.contacts[k];
	const Impulse&    p  = problem.impulses[k];
	const std::string it = "contact problem: contact " + std::to_string(k) + " between bodies "
	        + std::to_string(c.i) + " and " + std::to_string(c.j);
	refuseBodies(it, c.i, c.j, static_cast<std::int32_t>(problem.bodyCount()));
	for (const auto& [name, vector] : { std::pair("normal", c.n),
	                                    { "arm aside of i", c.asideI },
	                                    { "arm aside of j", c.asideJ },
	                                    { "tangential bias", c.biasT },
	                                    { "rotational bias", c.biasW },
	                                    { "impulse", p.f },
	                                    { "moment", p.m } })
		if (!usable(vector)) refuse(it, " has the ", name, " ", textOf(vector), ": it must be finite");
	for (const auto& [name, value] : { Named { "lever of i", c.leverI },
	                                   { "lever of j", c.leverJ },
	                                   { "normal bias", c.biasN },
	                                   { "length", c.length } })
		if (!finite(value)) refuse(it, " has the ", name, " ", value, ": it must be finite");
	for (const auto& [name, value] : { Named { "adhesion", c.adhesion },
	                                   { "friction", c.friction },
	                                   { "rolling arm", c.rollingArm },
	                                   { "twisting arm", c.twistingArm },
	                                   { "play", c.play } }) {
		if (!finite(value)) refuse(it, " has the ", name, " ", value, ": it must be finite");
		if (value < 0) refuse(it, " has the ", name, " ", value, ": it must not be negative");
	}
	if (!(c.length > 0)) refuse(it, " has the length ", c.length, ": it must be positive");
	refuse(it, " has the normal ", textOf(c.n), ": its length must be 1");
}

} // namespace nonsmooth::contact::space
