// Ways of a step that are too long for contacts to be seen. Between two steps a body goes along a straight line, and
// what was no contact when the step began is not looked for on it. A disk that goes no farther than its radius, against
// walls and given bodies, cannot have its centre behind one that it did not touch before; and two disks of which
// neither does cannot pass each other's centres. One that goes farther may:
//     w = h (|v − c| + g) / r        v: the disk's velocity, c: the middle of the given bodies' velocities, g: how far these lie from it at most
// Where w > 1 the paths of the step are looked at: what they cross without a contact is refused before anything is
// moved, and the rest is told of. Without given bodies c is the middle of all velocities, since disks that fly together
// cannot meet.
#include "ContactSeam.hpp"
#include "../walls/Arc.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/YadeFeatures.hpp"
#include <core/Aabb.hpp>
#include <neighbours/disk_grid.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/Wall.hpp>

namespace yade::nscd {

namespace {
	using nonsmooth::contact::Point;
	using nonsmooth::contact::Twist;
	using nonsmooth::neighbours::Disk;
	namespace plane = nonsmooth::contact::plane;

	constexpr Real grazes = 0.95; // sums of radii; disks that pass each other farther apart are let pass

	/// Velocities, from the least to the largest along each axis.
	struct Span {
		Real xMin = hugest, xMax = -hugest, yMin = hugest, yMax = -hugest;

		void take(const Twist& v)
		{
			xMin = std::min(xMin, v.x);
			xMax = std::max(xMax, v.x);
			yMin = std::min(yMin, v.y);
			yMax = std::max(yMax, v.y);
		}
		bool  any() const { return xMin <= xMax; }
		Point middle() const { return { 0.5 * (xMin + xMax), 0.5 * (yMin + yMax) }; }
		Real  half() const
		{
			const Real x = xMax - xMin, y = yMax - yMin;
			return 0.5 * std::sqrt(x * x + y * y);
		}
	};

	/// The way of a disk's centre in a step, as another body sees it from its own centre.
	struct Path {
		Point from, to; // [m]
		Real  radius; // of the disk

		Real length() const { return std::sqrt(std::pow(to.x - from.x, 2) + std::pow(to.y - from.y, 2)); }
	};

	/// Whether a centre goes through a line; its distance from it before and after, positive on the side of the
	/// normal. A one-sided wall pushes back what is behind it by less than a radius.
	bool goesThrough(Real before, Real after, int sense, Real radius)
	{
		if (before * after >= 0) return false;
		const int side = before > 0 ? 1 : -1;
		return sense == 0 || (sense == side && side * after < -radius);
	}

	bool crosses(const Segment& wall, const Point& along, const Path& p)
	{
		const Real before = along.x * p.from.y - along.y * p.from.x,
		           after  = along.x * p.to.y - along.y * p.to.x;
		if (!goesThrough(before, after, wall.sense, p.radius)) return false;
		const Real t = before / (before - after);
		const Real x = p.from.x + t * (p.to.x - p.from.x), y = p.from.y + t * (p.to.y - p.from.y);
		return std::abs(along.x * x + along.y * y) <= wall.halfLength;
	}

	bool crosses(const Arc& wall, const Point& along, const Path& p)
	{
		const Real dx = p.to.x - p.from.x, dy = p.to.y - p.from.y, a = dx * dx + dy * dy;
		const Real b = p.from.x * dx + p.from.y * dy,
		           c = p.from.x * p.from.x + p.from.y * p.from.y - wall.radius * wall.radius;
		if (!(b * b - a * c > 0)) return false;
		const Real root   = std::sqrt(b * b - a * c),
		           beyond = std::sqrt(p.to.x * p.to.x + p.to.y * p.to.y) - wall.radius;
		for (const int way : { -1, 1 }) { // into the circle, and out of it
			const Real t = (-b + way * root) / a, behind = way * beyond;
			if (!(t > 0 && t < 1) || wall.sense == -way) continue;
			if (wall.sense != 0 && behind >= 0 && behind <= p.radius) continue; // it is pushed back
			const Real x = p.from.x + t * dx, y = p.from.y + t * dy;
			if (std::abs(std::atan2(along.x * y - along.y * x, along.x * x + along.y * y))
			    <= wall.halfAngle)
				return true;
		}
		return false;
	}

	/// Of a body that fills a box along the axes, seen from its centre: whether the path goes in and comes out
	/// again.
	bool crosses(const Vector3r& half, const Path& p)
	{
		Real       in = 0, out = 1;
		const Real from[] = { p.from.x, p.from.y }, way[] = { p.to.x - p.from.x, p.to.y - p.from.y };
		for (int k = 0; k < 2; ++k) {
			if (way[k] == 0 && !(std::abs(from[k]) < half[k])) return false;
			if (way[k] == 0) continue;
			const Real one = (-half[k] - from[k]) / way[k], other = (half[k] - from[k]) / way[k];
			in  = std::max(in, std::min(one, other));
			out = std::min(out, std::max(one, other));
		}
		return in > 0 && out < 1 && in < out;
	}

	bool crossesWall(const Body& wall, const plane::Motion& motion, const Path& path)
	{
		const Shape& shape = *wall.shape;
		const Point  along = plane::rotate(motion.rotation, { 1, 0 });
		if (const auto* segment = dynamic_cast<const Segment*>(&shape)) return crosses(*segment, along, path);
		if (const auto* arc = dynamic_cast<const Arc*>(&shape)) return crosses(*arc, along, path);
		if (const auto* straight = dynamic_cast<const Wall*>(&shape))
			return straight->axis == 0 ? goesThrough(path.from.x, path.to.x, straight->sense, path.radius)
			        : straight->axis == 1
			        ? goesThrough(path.from.y, path.to.y, straight->sense, path.radius)
			        : false;
		const auto* box = dynamic_cast<const Aabb*>(wall.bound.get());
		return box && along.y == 0 && shape.getClassName() == "Box"
		        && crosses(0.5 * (box->max - box->min), path);
	}

	/// Whether two disks pass each other within the step, nearer than they may.
	bool passes(const Path& p, Real apart)
	{
		const Real dx = p.to.x - p.from.x, dy = p.to.y - p.from.y, square = dx * dx + dy * dy;
		const Real t = -(p.from.x * dx + p.from.y * dy) / square;
		if (!(t > 0 && t < 1)) return false;
		const Real x = p.from.x + t * dx, y = p.from.y + t * dy;
		return x * x + y * y < std::pow(grazes * apart, 2);
	}

	Collider* colliderOf(const Scene& scene)
	{
		for (const auto& engine : scene.engines)
			if (auto* found = engine->dead ? nullptr : dynamic_cast<Collider*>(engine.get())) return found;
		return nullptr;
	}

	[[noreturn]] void refuseWay(const Body& disk, const Body& other, const Path& path, Real h)
	{
		const Real way = path.length();
		fail("body #" + std::to_string(disk.getId()) + ", a disk of radius " + number(path.radius)
		     + " m, would go through body #" + std::to_string(other.getId()) + " ("
		     + other.shape->getClassName() + "), which it does not touch yet: against it the disk moves at "
		     + about(way / h) + " m/s, by " + about(way) + " m in a step of O.dt = " + number(h)
		     + " s. Set O.dt = " + about(enoughStep(h, way / path.radius))
		     + " s or less, with which it moves by half its radius, or a lower speed; where the two are not to "
		       "touch, give them different groupMasks, or the other one bounded = False");
	}
}

void ContactSeam::followWays(const Scene& scene)
{
	const auto& velocities = problem.velocities;
	const long  size       = (long)before.size();
	const auto  isFree     = [this](size_t id) {
                return present[id] && radius[id] > 0 && !problem.inverseMass[id].isFixed();
	};
	Span given;
	for (const int id : resident->driven)
		if (!isFree(id)) given.take(velocities[id]);
	const Real spread = given.any() ? given.half() : 0;
	Span       all    = given;
	for (long id = 0; id < size && !given.any(); ++id)
		if (isFree(id)) all.take(velocities[id]);
	const Point middle = all.any() ? all.middle() : Point { 0, 0 };
	Real        most   = 0; // of w², over h²
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : most)
	for (long id = 0; id < size; ++id) {
		if (!isFree(id)) continue;
		const Real x = velocities[id].x - middle.x, y = velocities[id].y - middle.y, square = x * x + y * y;
		const Real fastest = spread == 0 ? square : std::pow(std::sqrt(square) + spread, 2);
		most               = std::max(most, fastest / (radius[id] * radius[id]));
	}
	const Real h = relaxation.step;
	longest      = { h * std::sqrt(most), -1, 0, 0 };
	if (!(longest.radii > 1)) return;
	std::vector<int> far; // disks that go farther than their radius
	for (long id = 0; id < size; ++id) {
		if (!isFree(id)) continue;
		const Real x = velocities[id].x - middle.x, y = velocities[id].y - middle.y,
		           speed = std::sqrt(x * x + y * y) + spread;
		if (!(h * speed > radius[id])) continue;
		far.push_back(int(id));
		if (longest.body < 0 || speed * longest.radius > longest.speed * radius[id])
			longest = { longest.radii, int(id), speed, radius[id] };
	}
	refuseCrossings(scene, far, middle);
}

/// Of disks that go farther than their radius, which are few or on the way to a wrong result: whether they cross what
/// is no contact of theirs.
void ContactSeam::refuseCrossings(const Scene& scene, const std::vector<int>& far, const Point& middle) const
{
	Collider* const collider = colliderOf(scene);
	if (!collider) return;
	const Real h     = relaxation.step;
	const auto wayOf = [&](size_t id) {
		const Twist &v = problem.velocities[id], d = displacementOf(id);
		return Point { h * (v.x - middle.x) + d.x, h * (v.y - middle.y) + d.y };
	};
	const auto pathOf = [&](int id, int other) {
		const auto &a = problem.positions[id], &b    = problem.positions[other];
		const Point from { a.x - b.x, a.y - b.y }, u = wayOf(id), v = wayOf(other);
		return Path { from, { from.x + u.x - v.x, from.y + u.y - v.y }, radius[id] };
	};
	const auto speedOf = [&](size_t id) {
		const Twist& v = problem.velocities[id];
		return v.x * v.x + v.y * v.y;
	};
	// what impacts have turned round within the step has gone no straight way
	const auto isStraight = [&](size_t id) {
		return !followed || (sequence.flights[id].shift.x == 0 && sequence.flights[id].shift.y == 0);
	};
	const auto mayMeet = [&](int one, int other) {
		const Body &a = *(*scene.bodies)[one], &b = *(*scene.bodies)[other];
		return a.isBounded() && b.isBounded() && mayCollide(*collider, a, b)
		        && !resident->isContact(std::min(one, other), std::max(one, other));
	};
	for (const int wall : resident->shaped) {
		const Body& body = *(*scene.bodies)[wall];
		if (!body.shape || !body.isBounded()) continue;
		for (const int id : far)
			if (const Path path = pathOf(id, wall); isStraight(id)
			    && crossesWall(body, resident->bodies[wall].motion, path) && mayMeet(id, wall))
				refuseWay(*(*scene.bodies)[id], body, path, h);
	}
	Real              farthest = 0; // that any disk goes
	std::vector<Disk> disks(before.size());
	for (size_t id = 0; id < disks.size(); ++id) {
		const auto& at = problem.positions[id];
		disks[id]      = { at.x, at.y, present[id] ? radius[id] : -1 };
		if (!(disks[id].r > 0)) continue;
		const Point way = wayOf(id);
		farthest        = std::max(farthest, std::sqrt(way.x * way.x + way.y * way.y));
	}
	nonsmooth::neighbours::DiskGrid grid;
	grid.build(disks, 1);
	std::vector<int> near;
	for (const int id : far) {
		if (!isStraight(id)) continue;
		const auto& at  = problem.positions[id];
		const Point way = wayOf(id);
		grid.near(
		        { std::min(at.x, at.x + way.x), std::min(at.y, at.y + way.y), std::max(at.x, at.x + way.x),
		          std::max(at.y, at.y + way.y) },
		        1, radius[id] + farthest, near);
		for (const int other : near)
			if (const Path path = pathOf(id, other); other != id && isStraight(other)
			    && passes(path, radius[id] + radius[other]) && mayMeet(id, other)) {
				const bool first = speedOf(id) >= speedOf(other); // the faster one is said to go
				refuseWay(
				        *(*scene.bodies)[first ? id : other], *(*scene.bodies)[first ? other : id],
				        { path.from, path.to, radius[first ? id : other] }, h);
			}
	}
}

} // namespace yade::nscd
