// What the solver refuses before it starts: numbers and sizes that it cannot compute with. Who reads bodies and
// contacts anyway asks usable() of each (classification.hpp), so that memory is gone through once.
#pragma once

#include <cmath>
#include <contact/core/check.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

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

/// Throw std::invalid_argument naming what cannot be used, and why.
[[noreturn]] void refuseBody(const Problem& problem, std::size_t body);
[[noreturn]] void refusePosition(const Problem& problem, std::size_t body);
[[noreturn]] void refuseContact(const Problem& problem, std::size_t contact);

} // namespace nonsmooth::contact
