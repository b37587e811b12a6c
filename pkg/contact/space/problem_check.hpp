// What the solver refuses of a problem in space before it starts; contact/plane/problem_check.hpp says how it is asked.
#pragma once

#include <contact/core/check.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::contact::space {

inline bool usable(const Vector& x) { return finite(x.x, x.y, x.z); }

/// Whether a tensor may be an inverse inertia: none of its principal values is negative, but for rounding.
inline bool usable(const Symmetric& s)
{
	const auto minor = [](double a, double b, double c) { return c * c <= a * b * (1 + 1e-9); };
	return finite(s.xx, s.yy, s.zz, s.yz, s.zx, s.xy) && s.xx >= 0 && s.yy >= 0 && s.zz >= 0
	        && minor(s.yy, s.zz, s.yz) && minor(s.zz, s.xx, s.zx) && minor(s.xx, s.yy, s.xy);
}

inline bool usable(const InverseMass& m, const Twist& v)
{
	return finite(m.x, m.y, m.z) && usable(v.v) && usable(v.w) && m.x >= 0 && m.y >= 0 && m.z >= 0
	        && usable(m.inertia);
}

inline bool usable(const Contact& c, const Impulse& p, std::int32_t bodies)
{
	return c.i >= 0 && c.j >= 0 && c.i < bodies && c.j < bodies && c.i != c.j
	        && std::abs(dot(c.n, c.n) - 1) <= 2 * unitLength
	        && finite(
	                c.leverI, c.leverJ, c.biasN, c.adhesion, c.friction, c.rollingArm, c.twistingArm, c.length,
	                c.play)
	        && usable(c.asideI) && usable(c.asideJ) && usable(c.biasT) && usable(c.biasW) && c.adhesion >= 0
	        && c.friction >= 0 && c.rollingArm >= 0 && c.twistingArm >= 0 && c.length > 0 && c.play >= 0
	        && usable(p.f) && usable(p.m);
}

/// Throw std::invalid_argument naming what cannot be used, and why.
[[noreturn]] void refuseBody(const Problem& problem, std::size_t body);
[[noreturn]] void refusePosition(const Problem& problem, std::size_t body);
[[noreturn]] void refuseContact(const Problem& problem, std::size_t contact);

} // namespace nonsmooth::contact::space
