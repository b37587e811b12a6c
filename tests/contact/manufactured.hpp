// Contact problems whose solution is known: impulses are drawn on the graphs of the law, velocities so that they are complementary, and the free velocity
// is computed backwards. So the solution is exact but for rounding, whatever the masses, levers, walls and loops.
//
// The mechanics is written anew, with arms as vectors and forces at points, without the functions of problem.hpp and law.hpp: an error in those shows as a
// disagreement. Numbers are made by + − × ÷ √ alone, so that every machine has the same problems.
#pragma once

#include <algorithm>
#include <cmath>
#include <contact/plane/problem.hpp>
#include <random>
#include <vector>

namespace nonsmooth::contact::testing {

/// Two bodies that touch: n from i to j, and the arms from their centres to the point.
struct Link {
	int   i, j;
	Point n, armI, armJ;
};

inline double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
inline Point  quarterTurn(const Point& a) { return { -a.y, a.x }; }

/// What `link` sees of its bodies' motion: n and t of the velocity of j's point from i's point, and the difference of their turning.
inline RelativeVelocity seen(const Link& link, const std::vector<Twist>& v)
{
	const auto at = [&v](int body, const Point& arm) {
		return Point { v[body].x - v[body].w * arm.y, v[body].y + v[body].w * arm.x };
	};
	const Point a = at(link.i, link.armI), b = at(link.j, link.armJ), d { b.x - a.x, b.y - a.y },
	            t = quarterTurn(link.n);
	return { d.x * link.n.x + d.y * link.n.y, d.x * t.x + d.y * t.y, v[link.j].w - v[link.i].w };
}

/// Adds what impulses p at the point of `link` do to the velocities of its bodies, `sign` times.
inline void
push(const Link& link, const Impulse& p, const std::vector<InverseMass>& inverse, double sign, std::vector<Twist>& v)
{
	const Point t  = quarterTurn(link.n), f { p.n * link.n.x + p.t * t.x, p.n * link.n.y + p.t * t.y };
	const auto  on = [&](int body, const Point& arm, double s) {
                v[body].x += s * inverse[body].x * f.x;
                v[body].y += s * inverse[body].y * f.y;
                v[body].w += s * inverse[body].w * (cross(arm, f) + p.r);
	};
	on(link.j, link.armJ, sign);
	on(link.i, link.armI, -sign);
}

struct Recipe {
	unsigned seed   = 1;
	int      bodies = 50;
	double   loops
	        = 0; // further contacts a body, beside the one by which it joins the tree; without any, W has full rank
	bool simple
	        = true; // all contacts fit into blocks; otherwise about half have levers along n, biases in t and r, or a body with two masses
	bool smooth = false; // neither friction nor rolling resistance
	bool bonded = false; // nothing moves: every contact holds in its three rows
	bool plays  = false; // half of what bears tension has play
};

struct Manufactured {
	Problem              problem; // with impulses 0
	std::vector<Link>    links;
	std::vector<Impulse> impulses; // the solution
	std::vector<Twist>   velocities; // that belong to it
	int                  counts[5] = {}; // contacts that are pressed, pulled, at their limit, open, in their play

	/// The natural map by its definition: what impulses miss of the fixed point x = proj(x − u/W), row by row.
	std::vector<Impulse> defects(const std::vector<Impulse>& p) const
	{
		std::vector<Twist> v = problem.freeVelocity;
		for (std::size_t k = 0; k < links.size(); ++k)
			push(links[k], p[k], problem.inverseMass, 1, v);
		std::vector<Impulse> found;
		for (std::size_t k = 0; k < links.size(); ++k) {
			const Contact&         c       = problem.contacts[k];
			const RelativeVelocity u       = seen(links[k], v);
			const Diagonal         w       = diagonal(k);
			const double           pressed = std::max(0.0, p[k].n + c.adhesion);
			const auto row = [](double x, double velocity, double w, double least, double most) {
				return x - std::clamp(x - velocity / w, least, most);
			};
			// with play: compression where z is above 0, tension where it is below −p/W, nothing between
			const double n = u.n + c.biasN, z = p[k].n - n / w.n, length = -c.play / w.n;
			const double along = c.play == 0 ? row(p[k].n, n, w.n, -c.adhesion, HUGE_VAL)
			        : z > 0                  ? p[k].n - z
			        : z > length             ? p[k].n
			                                 : row(p[k].n, n - c.play, w.n, -c.adhesion, 0);
			found.push_back(
			        { along, row(p[k].t, u.t + c.biasT, w.t, -c.friction * pressed, c.friction * pressed),
			          row(p[k].r, u.r + c.biasR, w.r, -c.rollingArm * pressed, c.rollingArm * pressed) });
		}
		return found;
	}

	/// W of one contact: what a unit impulse in each row changes of the velocity in that row. A row that none moves has that of the normal, in its unit.
	Diagonal diagonal(std::size_t k) const
	{
		const Link                     alone { 0, 1, links[k].n, links[k].armI, links[k].armJ };
		const std::vector<InverseMass> inverse { problem.inverseMass[links[k].i],
			                                 problem.inverseMass[links[k].j] };
		const auto                     changed = [&](const Impulse& unit) {
                        std::vector<Twist> v(2);
                        push(alone, unit, inverse, 1, v);
                        return seen(alone, v);
		};
		const double n = changed({ 1, 0, 0 }).n, t = changed({ 0, 1, 0 }).t, r = changed({ 0, 0, 1 }).r,
		             l = problem.contacts[k].length;
		return { n, t > 0 ? t : n, r > 0 ? r : n / (l * l) };
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
			addTreeContact(k);
			for (double wanted = recipe.loops; k > 1 && wanted > 0 && uniform() < wanted; --wanted)
				add(linkBetween(k, near(k)), {}, false);
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
	double either() { return uniform() < 0.5 ? -1 : 1; }
	bool   odd() { return !recipe.simple && uniform() < 0.2; } // something that blocks have no room for
	int    near(int k) { return std::max(0, k - 6) + int(uniform(0, std::min(k, 6))); }

	/// Every 37th body is a wall, which stands or moves; one in ten of the others cannot turn. In a tree the first one alone is a wall, and all others turn.
	bool isWall(int k) const { return recipe.loops > 0 ? k % 37 == 0 : k == 0; }
	void addBody(int k)
	{
		const double r = uniform(0.5, 1), mass = uniform(0.3, 3), inertia = 0.5 * mass * r * r;
		InverseMass  inverse { 1 / mass, 1 / mass, recipe.loops > 0 && uniform() < 0.1 ? 0 : 1 / inertia };
		if (odd()) inverse.y *= 0.5;
		radius.push_back(r);
		made.problem.inverseMass.push_back(isWall(k) ? InverseMass {} : inverse);
		made.problem.positions.push_back(
		        { 0.8 * k + uniform(0, 0.5), uniform(0, 4) }); // a long packing: strips lie across it
		Twist v;
		if (k > 0 && uniform() < 0.5)
			v = { uniform(-1, 1), uniform(-1, 1), isWall(k) && !odd() ? 0 : uniform(-1, 1) };
		if (inverse.w == 0 && !isWall(k)) v.w = 0;
		if (recipe.bonded) v = {};
		made.velocities.push_back(v);
	}

	Link linkBetween(int a, int b)
	{
		if (uniform() < 0.5) std::swap(a, b);
		const double q = uniform(-1, 1), s = either(), d = 1 + q * q;
		Link         link { a, b, { s * (1 - q * q) / d, s * 2 * q / d }, {}, {} };
		const Point  t   = quarterTurn(link.n);
		const auto   arm = [&](int body, double sign) {
                        const double aside = odd() ? uniform(-0.3, 0.3) : 0, out = sign * radius[body];
                        return Point { out * link.n.x + aside * t.x, out * link.n.y + aside * t.y };
		};
		link.armI = arm(a, 1);
		link.armJ = arm(b, -1);
		return link;
	}

	/// By which body k joins: a body that can move in all ways gets the velocity that the graphs want.
	void addTreeContact(int k)
	{
		const int          parent  = near(k);
		const Link         link    = linkBetween(k, parent);
		const InverseMass& inverse = made.problem.inverseMass[k];
		const bool         still   = made.velocities[parent].w == 0;
		if (still && inverse.x > 0
		    && (recipe.bonded
		        || uniform()
		                < 0.4)) { // goes along with its parent, so that loops among such bodies do not slide
			made.velocities[k] = made.velocities[parent];
			add(link, {}, false);
		} else
			add(link, { k, parent }, inverse.x > 0 && inverse.w > 0);
	}

	struct Join {
		int child, parent;
	};

	/// A contact in a state by chance. `free`: the child's velocity follows from it; otherwise the state from the velocities, but for biases.
	void add(const Link& link, const Join& join, bool free)
	{
		Contact c;
		c.i = link.i, c.j = link.j, c.nx = link.n.x, c.ny = link.n.y;
		const auto lever = [&](const Point& arm, double& n, double& t) {
			const Point turned = quarterTurn(arm); // velocity of the point for a unit turn
			n                  = link.n.x * turned.x + link.n.y * turned.y;
			t                  = arm.x * link.n.x + arm.y * link.n.y;
			if (recipe.simple) n = 0; // but for rounding
		};
		lever(link.armI, c.leverNi, c.leverTi);
		lever(link.armJ, c.leverNj, c.leverTj);
		c.length     = radius[link.i] + radius[link.j];
		c.adhesion   = recipe.bonded || uniform() < 0.5 ? uniform(0.5, 2) : 0;
		c.friction   = recipe.smooth || (!recipe.bonded && uniform() < 0.1) ? 0 : uniform(0.1, 0.6);
		c.rollingArm = recipe.smooth || (!recipe.bonded && uniform() < 0.3) ? 0 : uniform(0.05, 0.3) * c.length;
		c.biasN      = uniform() < 0.4 ? 0 : uniform(-0.5, 0.5); // restitution, or a gap

		if (recipe.plays && c.adhesion > 0 && uniform() < 0.5) c.play = uniform(0.1, 0.5);

		// velocities in the graphs, bias included; impulses complementary to them
		RelativeVelocity u;
		Impulse          p;
		const double     chance = recipe.bonded ? uniform(0, 0.5) : uniform();
		int              state  = chance < 0.4 ? 0 : chance < 0.55 && c.adhesion > 0 ? 1 : chance < 0.7 ? 2 : 3;
		if (c.play > 0 && uniform() < 0.3) state = 4;
		++made.counts[state];
		p.n                              = state == 4     ? 0
		                                     : state == 0 ? uniform(0.2, 2)
		                                     : state == 1 ? -uniform(0.1, 0.9) * c.adhesion
		                                                  : -c.adhesion;
		u.n                              = state == 4     ? uniform(0.1, 0.9) * c.play
		                                     : state == 3 ? uniform(0.1, 1) + c.play
		                                     : state == 0 ? 0
		                                                  : c.play;
		const RelativeVelocity now       = seen(link, made.velocities);
		const bool             turnsBias = !free && odd();
		if (turnsBias || (free && odd())) c.biasT = uniform(-0.2, 0.2), c.biasR = uniform(-0.2, 0.2);
		const auto row = [&](double threshold, double found, double& velocity, double& impulse) {
			const bool   chosen = free || turnsBias;
			const double sign   = either(),
			             moving = recipe.bonded || uniform() < 0.4
			        ? 0
			        : sign * uniform(0.1, 1); // drawn one after the other
			velocity            = chosen ? moving : found;
			if (std::abs(velocity) < 1e-12)
				velocity = 0; // rounding of bodies that go along with each other
			const double held = recipe.bonded || uniform() < 0.8 ? uniform(-0.9, 0.9)
			                                                     : either(); // a fifth at the threshold
			impulse           = velocity == 0 ? held * threshold : std::copysign(threshold, -velocity);
		};
		row(c.friction * (c.adhesion + p.n), now.t, u.t, p.t);
		row(c.rollingArm * (c.adhesion + p.n), now.r, u.r, p.r);
		if (free) moveChild(link, join, { u.n - c.biasN, u.t - c.biasT, u.r - c.biasR });
		else {
			c.biasN = u.n - now.n;
			if (turnsBias) c.biasT = u.t - now.t, c.biasR = u.r - now.r;
		}
		made.links.push_back(link);
		made.problem.contacts.push_back(c);
		made.impulses.push_back(p);
	}

	/// Gives the child the velocity with which the link sees u.
	void moveChild(const Link& link, const Join& join, const RelativeVelocity& u)
	{
		const double s    = join.child == link.j ? 1 : -1;
		const Point  armP = s > 0 ? link.armI : link.armJ, armC = s > 0 ? link.armJ : link.armI,
		            t  = quarterTurn(link.n);
		const Twist& v = made.velocities[join.parent];
		const double w = v.w + s * u.r;
		const Point  point { v.x - v.w * armP.y + s * (u.n * link.n.x + u.t * t.x),
                                    v.y + v.w * armP.x + s * (u.n * link.n.y + u.t * t.y) };
		made.velocities[join.child] = { point.x + w * armC.y, point.y - w * armC.x, w };
	}

	Recipe              recipe;
	std::mt19937        dice;
	std::vector<double> radius;
	Manufactured        made;
};

inline Manufactured manufactured(const Recipe& recipe) { return Manufacture(recipe).make(); }

} // namespace nonsmooth::contact::testing
