#include <algorithm>
#include <cmath>
#include <contact/plane/problem_scale.hpp>

namespace nonsmooth::contact {

Impulse scaled(const Impulse& p, const Scaling& s)
{
	const int by = s.speed + s.mass;
	return { std::ldexp(p.n, by), std::ldexp(p.t, by), std::ldexp(p.r, by) };
}

Twist scaled(const Twist& v, int speed)
{
	return { std::ldexp(v.x, speed), std::ldexp(v.y, speed), std::ldexp(v.w, speed) };
}

Problem scaled(const Problem& problem, const Scaling& s)
{
	Problem p = problem;
	for (Twist& v : p.freeVelocity)
		v = scaled(v, s.speed);
	for (InverseMass& m : p.inverseMass)
		m = { std::ldexp(m.x, -s.mass), std::ldexp(m.y, -s.mass), std::ldexp(m.w, -s.mass) };
	for (Impulse& i : p.impulses)
		i = scaled(i, s);
	for (Contact& c : p.contacts) {
		c.biasN    = std::ldexp(c.biasN, s.speed);
		c.biasT    = std::ldexp(c.biasT, s.speed);
		c.biasR    = std::ldexp(c.biasR, s.speed);
		c.play     = std::ldexp(c.play, s.speed);
		c.adhesion = std::min(std::ldexp(c.adhesion, s.speed + s.mass), unreachedStrength);
	}
	return p;
}

} // namespace nonsmooth::contact
