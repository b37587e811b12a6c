#include <algorithm>
#include <cmath>
#include <contact/plane/rigid_clusters.hpp>

namespace nonsmooth::contact::plane {
namespace {

	constexpr int nobody = -1;

	bool isHeld(const InverseMass& w) { return w.x == 0 && w.y == 0; }
	bool isGuided(const InverseMass& w) { return (w.x == 0) != (w.y == 0); }
	bool isFree(const InverseMass& w) { return w.x > 0 && w.y > 0; }

	Point  minus(const Point& a, const Point& b) { return { a.x - b.x, a.y - b.y }; }
	double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
	double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

	/// u of a body at r.
	Point notTurning(const Twist& v, const TurningAxes& axes, const Point& r)
	{
		return { v.x - axes.velocity.x + axes.velocity.w * r.y, v.y - axes.velocity.y - axes.velocity.w * r.x };
	}

} // namespace

int RigidClusters::rootOf(int body)
{
	while (parent[body] != body)
		body = parent[body] = parent[parent[body]];
	return body;
}

void RigidClusters::find(const std::vector<Joint>& joints, std::size_t bodyCount)
{
	bodies.clear();
	begin.clear();
	if (joints.empty()) return;
	parent.resize(bodyCount, nobody);
	rank.resize(bodyCount);
	for (const auto& [i, j] : joints)
		for (const int body : { i, j })
			if (parent[body] == nobody) parent[body] = body;
	for (const auto& [i, j] : joints) {
		const int a = rootOf(i), b = rootOf(j);
		parent[std::max(a, b)] = std::min(a, b); // the root is the first of its set
	}
	// by id, so that roots come before the others of their sets
	int sets = 0;
	for (int body = 0; body < (int)bodyCount; ++body) {
		if (parent[body] == nobody) continue;
		const int root = rootOf(body);
		if (root == body) {
			rank[body] = sets++;
			begin.push_back(0);
		}
		++begin[rank[root]];
	}
	begin.push_back(0);
	for (int s = 0, before = 0; s <= sets; ++s)
		before += std::exchange(begin[s], before);
	next.assign(begin.begin(), begin.end() - 1);
	bodies.resize(begin.back());
	for (int body = 0; body < (int)bodyCount; ++body)
		if (parent[body] != nobody) bodies[next[rank[rootOf(body)]]++] = body;
	std::fill(parent.begin(), parent.end(), nobody);
}

TurningAxes axesOf(const BodyArrays& all, const std::vector<Twist>& velocities, const int* first, const int* last)
{
	TurningAxes axes;
	const int*  pin      = nullptr;
	bool        isDriven = false; // the turn is given
	double      mass     = 0;
	for (const int* b = first; b != last; ++b) {
		const InverseMass& w = all.inverseMass[*b];
		if (isGuided(w)) return axes;
		if (isHeld(w) && !pin) pin = b;
		if (w.w == 0 && !isDriven) {
			isDriven        = true;
			axes.velocity.w = velocities[*b].w;
		}
		mass += isHeld(w) ? 0 : all.mass[*b];
	}
	axes.held = pin;
	if (pin) {
		axes.centre     = all.positions[*pin];
		axes.velocity.x = velocities[*pin].x;
		axes.velocity.y = velocities[*pin].y;
	} else {
		// from the first body, so that a cluster far from the origin loses no digits
		const Point origin = all.positions[*first];
		Point       centre;
		for (const int* b = first; b != last; ++b) {
			const double m = all.mass[*b] / mass;
			const Point  r = minus(all.positions[*b], origin);
			centre.x += m * r.x;
			centre.y += m * r.y;
			axes.velocity.x += m * velocities[*b].x;
			axes.velocity.y += m * velocities[*b].y;
		}
		axes.centre = { origin.x + centre.x, origin.y + centre.y };
	}
	double turning = 0;
	for (const int* b = first; b != last; ++b) {
		if (!isFree(all.inverseMass[*b])) continue;
		const Point r = minus(all.positions[*b], axes.centre);
		const Twist v = velocities[*b];
		axes.inertia += all.mass[*b] * dot(r, r);
		turning += all.mass[*b] * cross(r, { v.x - axes.velocity.x, v.y - axes.velocity.y });
	}
	axes.turns = axes.inertia > 0;
	if (axes.turns && !isDriven) axes.velocity.w = turning / axes.inertia;
	return axes;
}

bool movesRigidly(
        const BodyArrays& all, const std::vector<Twist>& velocities, const TurningAxes& axes, const int* first,
        const int* last)
{
	double square = 0;
	for (const int* b = first; b != last; ++b) {
		if (!isFree(all.inverseMass[*b])) continue;
		const Point u = notTurning(velocities[*b], axes, minus(all.positions[*b], axes.centre));
		square += all.mass[*b] * dot(u, u);
	}
	const double turn = axes.velocity.w;
	return square <= rigidEnough * rigidEnough * turn * turn * axes.inertia;
}

void load(
        const BodyArrays& all, const TurningAxes& axes, double h, const int* first, const int* last,
        std::vector<Twist>& gain)
{
	const double share = h * axes.velocity.w * axes.velocity.w;
	for (const int* b = first; b != last; ++b) {
		if (!isFree(all.inverseMass[*b])) continue;
		const Point r = minus(all.positions[*b], axes.centre);
		gain[*b].x += share * r.x;
		gain[*b].y += share * r.y;
	}
}

void turn(
        const BodyArrays& all, const std::vector<Twist>& velocities, const TurningAxes& axes, double h,
        const int* first, const int* last, std::vector<Twist>& displacement, std::vector<Twist>& change)
{
	const double a = h * axes.velocity.w, c = std::cos(a), s = std::sin(a);
	const auto   turned = [c, s](const Point& p) { return Point { c * p.x - s * p.y, s * p.x + c * p.y }; };
	const auto   after  = [&](int b, const Point& r) { // r̃
                const Point u = notTurning(velocities[b], axes, r);
                return Point { r.x + h * u.x, r.y + h * u.y };
	};
	double spin = axes.velocity.w;
	if (!axes.held) {
		double inertia = 0; // Σ m r̃²
		for (const int* b = first; b != last; ++b) {
			const Point p = after(*b, minus(all.positions[*b], axes.centre));
			inertia += all.mass[*b] * dot(p, p);
		}
		if (inertia > 0) spin *= axes.inertia / inertia;
	}
	for (const int* b = first; b != last; ++b) {
		if (!isFree(all.inverseMass[*b])) continue;
		const Point r = minus(all.positions[*b], axes.centre), p = after(*b, r), place = turned(p);
		const Point u   = notTurning(velocities[*b], axes, r),
		            end = turned({ u.x - spin * p.y, u.y + spin * p.x });
		displacement[*b].x += place.x - r.x - h * end.x;
		displacement[*b].y += place.y - r.y - h * end.y;
		change[*b].x += end.x - (velocities[*b].x - axes.velocity.x);
		change[*b].y += end.y - (velocities[*b].y - axes.velocity.y);
	}
}

} // namespace nonsmooth::contact::plane
