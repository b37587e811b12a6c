#include <algorithm>
#include <cmath>
#include <contact/space/problem_scale.hpp>

namespace nonsmooth::contact::space {
namespace {

	Vector scaledBy(const Vector& a, int by)
	{
		return { std::ldexp(a.x, by), std::ldexp(a.y, by), std::ldexp(a.z, by) };
	}
	InverseMass scaledBy(const InverseMass& m, int by)
	{
		const Symmetric& s   = m.inertia;
		const auto       one = [by](double x) { return std::ldexp(x, by); };
		return { one(m.x),
			 one(m.y),
			 one(m.z),
			 { one(s.xx), one(s.yy), one(s.zz), one(s.yz), one(s.zx), one(s.xy) } };
	}

} // namespace

Impulse scaled(const Impulse& p, const Scaling& s)
{
	return { scaledBy(p.f, s.speed + s.mass), scaledBy(p.m, s.speed + s.mass) };
}

Twist scaled(const Twist& v, int speed) { return { scaledBy(v.v, speed), scaledBy(v.w, speed) }; }

Problem scaled(const Problem& problem, const Scaling& s)
{
	Problem p = problem;
	for (Twist& v : p.freeVelocity)
		v = scaled(v, s.speed);
	for (InverseMass& m : p.inverseMass)
		m = scaledBy(m, -s.mass);
	for (Impulse& i : p.impulses)
		i = scaled(i, s);
	for (Contact& c : p.contacts) {
		c.biasN    = std::ldexp(c.biasN, s.speed);
		c.biasT    = scaledBy(c.biasT, s.speed);
		c.biasW    = scaledBy(c.biasW, s.speed);
		c.play     = std::ldexp(c.play, s.speed);
		c.adhesion = std::min(std::ldexp(c.adhesion, s.speed + s.mass), unreachedStrength);
	}
	return p;
}

} // namespace nonsmooth::contact::space
