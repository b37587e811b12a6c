// Contact problems in space whose solution is known: impulses are drawn on the graphs of the law and relative
// velocities complementary to them; biases are what these differ by
// from bodies' velocities that are drawn too, and the free velocity is computed backwards. So the solution is exact but
// for rounding.
//
// The mechanics is written anew, with forces at points and full arms, without the functions of space/problem.hpp and
// space/law.hpp.
#pragma once

#include "balls.hpp"
#include <array>

namespace nonsmooth::contact::space::testing {

using Three = std::array<double, 3>;
inline Three  of(const Vector& a) { return { a.x, a.y, a.z }; }
inline Vector back(const Three& a) { return { a[0], a[1], a[2] }; }
inline Three  plus(const Three& a, const Three& b, double s = 1)
{
	return { a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2] };
}
inline Three  times(double s, const Three& a) { return { s * a[0], s * a[1], s * a[2] }; }
inline double inner(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Three  outer(const Three& a, const Three& b)
{
	return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
inline Three part(const Three& a, const Three& along) { return times(inner(a, along), along); }

/// Two bodies that touch: n from i to j, and the arms from their centres to the point.
struct Link {
	int   i, j;
	Three n, armI, armJ;
};

/// Velocity of a point relative to another, and of one body's turning relative to the other's.
struct Seen {
	Three u, w;
};

inline Seen seen(const Link& link, const std::vector<Twist>& v)
{
	const auto at = [&v](int body, const Three& arm) { return plus(of(v[body].v), outer(of(v[body].w), arm)); };
	return { plus(at(link.j, link.armJ), at(link.i, link.armI), -1), plus(of(v[link.j].w), of(v[link.i].w), -1) };
}

inline Three product(const Symmetric& s, const Three& a)
{
	const Three rows[3] = { { s.xx, s.xy, s.zx }, { s.xy, s.yy, s.yz }, { s.zx, s.yz, s.zz } };
	return { inner(rows[0], a), inner(rows[1], a), inner(rows[2], a) };
}

/// Adds what impulses at the point of `link` do to the velocities of its bodies, `sign` times.
inline void
push(const Link& link, const Impulse& p, const std::vector<InverseMass>& inverse, double sign, std::vector<Twist>& v)
{
	const Three f  = of(p.f);
	const auto  on = [&](int body, const Three& arm, double s) {
                const InverseMass& m = inverse[body];
                v[body].v            = back(plus(of(v[body].v), { m.x * f[0], m.y * f[1], m.z * f[2] }, s));
                v[body].w            = back(plus(of(v[body].w), product(m.inertia, plus(outer(arm, f), of(p.m))), s));
	};
	on(link.j, link.armJ, sign);
	on(link.i, link.armI, -sign);
}

struct Recipe {
	unsigned seed   = 1;
	int      bodies = 50;
	double   loops  = 0; // further contacts a body, beside the one by which it joins the tree
	bool     simple
	        // all contacts fit into blocks; otherwise some bodies are no balls and some arms are not along n
	        = true;
	bool plays = false; // half of what bears tension has play
};

/// States of the rows: pressed, pulled, open, in its play; and sticks or slips, rolls or not, twists or not.
struct Manufactured {
	Problem              problem; // with impulses 0
	std::vector<Link>    links;
	std::vector<Impulse> impulses; // the solution
	std::vector<Twist>   velocities; // that belong to it
	int counts[8] = {}; // pressed, pulled, open, in its play; slips, rolls, twists, holds in all rows

	/// The natural map by its definition, for problems of balls: what impulses miss of the fixed point x = proj(x −
	/// u/W), row by row and put together.
	std::vector<Impulse> defects(const std::vector<Impulse>& p) const
	{
		std::vector<Twist> v = problem.freeVelocity;
		for (std::size_t k = 0; k < links.size(); ++k)
			push(links[k], p[k], problem.inverseMass, 1, v);
		std::vector<Impulse> found;
		for (std::size_t k = 0; k < links.size(); ++k) {
			const Contact& c = problem.contacts[k];
			const Three&   n = links[k].n;
			const Seen     s = seen(links[k], v);
			const auto     w = diagonal(k);
			const Three    f = of(p[k].f), m = of(p[k].m), u = plus(s.u, of(c.biasT)),
			            turn = plus(s.w, of(c.biasW));
			const double pn = inner(n, f), un = inner(n, s.u) + c.biasN,
			             pressed = std::max(0.0, pn + c.adhesion);
			const auto disc      = [](const Three& x, double threshold) {
                                const double size = std::sqrt(inner(x, x));
                                return size > threshold ? times(threshold / size, x) : x;
			};
			const double z = pn - un / w[0], beyond = pn - (un - c.play) / w[0];
			const double nearest = z > 0 || c.play == 0 ? std::max(z, -c.adhesion)
			        : beyond > 0                        ? 0
			                                            : std::max(beyond, -c.adhesion);
			const Three  t = plus(f, part(f, n), -1), ut = plus(u, part(u, n), -1),
			            r = plus(m, part(m, n), -1), wr = plus(turn, part(turn, n), -1);
			const Three  dt   = plus(t, disc(plus(t, ut, -1 / w[1]), c.friction * pressed), -1);
			const Three  dr   = plus(r, disc(plus(r, wr, -1 / w[2]), c.rollingArm * pressed), -1);
			const double most = c.twistingArm * pressed, ps = inner(n, m);
			const double ds = ps - std::clamp(ps - inner(n, turn) / w[3], -most, most);
			found.push_back({ back(plus(dt, n, pn - nearest)), back(plus(dr, n, ds)) });
		}
		return found;
	}

	/// W of a contact of balls row by row: what a unit impulse changes of the velocity in its direction. A row that
	/// none moves has that of the normal, in its unit.
	std::array<double, 4> diagonal(std::size_t k) const
	{
		const Link                     alone { 0, 1, links[k].n, links[k].armI, links[k].armJ };
		const std::vector<InverseMass> inverse { problem.inverseMass[links[k].i],
			                                 problem.inverseMass[links[k].j] };
		const auto                     changed = [&](const Impulse& unit) {
                        std::vector<Twist> v(2);
                        push(alone, unit, inverse, 1, v);
                        return seen(alone, v);
		};
		const Three  n = links[k].n, aside = std::abs(n[0]) < 0.8 ? Three { 1, 0, 0 } : Three { 0, 1, 0 };
		const Three  across = outer(n, aside), t = times(1 / std::sqrt(inner(across, across)), across);
		const double wn = inner(n, changed({ back(n), {} }).u), wt = inner(t, changed({ back(t), {} }).u),
		             wr = inner(t, changed({ {}, back(t) }).w), ws = inner(n, changed({ {}, back(n) }).w),
		             l2 = problem.contacts[k].length * problem.contacts[k].length;
		return { wn, wt > 0 ? wt : wn, wr > 0 ? wr : wn / l2, ws > 0 ? ws : wn / l2 };
	}
};

class Manufacture {
public:
	explicit Manufacture(const Recipe& recipe_)
	        : recipe(recipe_)
	        , dice(recipe_.seed)
	{
	}

	Manufactured make()
	{
		for (int k = 0; k < recipe.bodies; ++k)
			addBody(k);
		for (int k = 1; k < recipe.bodies; ++k) {
			add(k, near(k));
			for (double wanted = recipe.loops; k > 1 && wanted > 0 && uniform() < wanted; --wanted)
				add(k, near(k));
		}
		Problem& p     = made.problem;
		p.freeVelocity = made.velocities;
		for (std::size_t k = 0; k < made.links.size(); ++k)
			push(made.links[k], made.impulses[k], p.inverseMass, -1, p.freeVelocity);
		p.impulses.resize(p.contactCount());
		return made;
	}

private:
	double uniform(double low = 0, double high = 1) { return low + (high - low) * (dice() / 4294967296.0); }
	bool   odd() { return !recipe.simple && uniform() < 0.2; } // something that blocks have no room for
	int    near(int k) { return std::max(0, k - 6) + int(uniform(0, std::min(k, 6))); }
	Three  direction()
	{
		for (;;) {
			const Three  a { uniform(-1, 1), uniform(-1, 1), uniform(-1, 1) };
			const double square = inner(a, a);
			if (square > 0.05 && square < 1) return times(1 / std::sqrt(square), a);
		}
	}
	Three across(const Three& n)
	{
		for (;;) {
			const Three  a = direction(), b = plus(a, part(a, n), -1);
			const double square = inner(b, b);
			if (square > 0.1) return times(1 / std::sqrt(square), b);
		}
	}

	/// Every 37th body is a wall, which stands or moves; one in ten of the others cannot turn. In a tree the first
	/// one alone is a wall.
	void addBody(int k)
	{
		const bool   wall = recipe.loops > 0 ? k % 37 == 0 : k == 0;
		const double r = uniform(0.5, 1), mass = uniform(0.3, 3), inertia = 0.4 * mass * r * r;
		InverseMass  inverse = InverseMass::ofSphere(
		         1 / mass, recipe.loops > 0 && uniform() < 0.1 ? 0 : 1 / inertia);
		if (odd()) {
			inverse.y *= 0.5;
			inverse.inertia.yy *= 0.7;
			inverse.inertia.xy = 0.2 * inverse.inertia.xx;
		}
		radius.push_back(r);
		made.problem.inverseMass.push_back(wall ? InverseMass {} : inverse);
		made.problem.positions.push_back({ uniform(0, 4), 0.8 * k + uniform(0, 0.5), uniform(0, 4) });
		made.velocities.push_back(
		        { back(times(uniform(0, 2), direction())), back(times(uniform(0, 2), direction())) });
		if (wall && uniform() < 0.5) made.velocities.back() = {};
	}

	void add(int a, int b)
	{
		if (uniform() < 0.5) std::swap(a, b);
		Link       link { a, b, direction(), {}, {} };
		Contact    c;
		const auto arm = [&](int body, double sign, double& lever, Vector& aside) {
			lever            = sign * radius[body];
			const Three wide = odd() ? times(0.3, across(link.n)) : Three {};
			aside            = back(wide);
			return plus(times(lever, link.n), wide);
		};
		link.armI     = arm(a, 1, c.leverI, c.asideI);
		link.armJ     = arm(b, -1, c.leverJ, c.asideJ);
		c.i           = a;
		c.j           = b;
		c.n           = back(link.n);
		c.length      = radius[a] + radius[b];
		c.adhesion    = uniform() < 0.5 ? uniform(0.5, 2) : 0;
		c.friction    = uniform() < 0.1 ? 0 : uniform(0.1, 0.6);
		c.rollingArm  = uniform() < 0.3 ? 0 : uniform(0.05, 0.3) * c.length;
		c.twistingArm = uniform() < 0.3 ? 0 : uniform(0.05, 0.3) * c.length;
		if (recipe.plays && c.adhesion > 0 && uniform() < 0.5) c.play = uniform(0.1, 0.5);

		const double chance = uniform();
		int          state  = chance < 0.5 ? 0 : chance < 0.75 && c.adhesion > 0 ? 1 : 2;
		if (c.play > 0 && uniform() < 0.3) state = 3;
		++made.counts[state];
		const double n       = state == 0 ? uniform(0.2, 2)
		              : state == 1        ? -uniform(0.1, 0.9) * c.adhesion
		              : state == 2        ? -c.adhesion
		                                  : 0;
		const double un      = state == 0 ? 0
		             : state == 1         ? c.play
		             : state == 2         ? c.play + uniform(0.1, 1)
		                                  : uniform(0.1, 0.9) * c.play;
		const double pressed = n + c.adhesion;
		bool         holds   = state < 2;
		// a row holds inside its threshold, or moves against what it bears
		const auto row = [&](double arm, const Three& way, int count, Three& impulse, Three& velocity) {
			const bool moves = uniform() < 0.4 || arm * pressed == 0;
			impulse          = times((moves ? 1 : uniform(0, 0.9)) * arm * pressed, way);
			velocity         = moves ? times(-uniform(0.1, 1), way) : Three {};
			made.counts[count] += moves;
			holds = holds && !moves;
		};
		Three t, ut, r, wr, s, ws;
		row(c.friction, across(link.n), 4, t, ut);
		row(c.rollingArm, across(link.n), 5, r, wr);
		row(c.twistingArm, times(uniform() < 0.5 ? -1 : 1, link.n), 6, s, ws);
		made.counts[7] += holds;

		const Seen now = seen(link, made.velocities);
		c.biasN        = un - inner(link.n, now.u);
		c.biasT        = back(plus(ut, plus(now.u, part(now.u, link.n), -1), -1));
		c.biasW        = back(plus(plus(wr, ws), now.w, -1));
		made.links.push_back(link);
		made.problem.contacts.push_back(c);
		made.impulses.push_back({ back(plus(t, link.n, n)), back(plus(r, s)) });
	}

	Recipe              recipe;
	std::mt19937        dice;
	std::vector<double> radius;
	Manufactured        made;
};

inline Manufactured manufactured(const Recipe& recipe) { return Manufacture(recipe).make(); }

} // namespace nonsmooth::contact::space::testing
