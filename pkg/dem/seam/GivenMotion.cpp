#include "GivenMotion.hpp"
#include "../checks/Refusal.hpp"
#include "SameBody.hpp"
#include "Audience.hpp"
#include <algorithm>

namespace yade::nscd {

namespace plane = nonsmooth::contact::plane;

namespace {
	/// Diameter of the smallest disk [m]; 0 where there is none.
	Real smallestDisk(const std::vector<BodyState>& bodies)
	{
		Real smallest = std::numeric_limits<Real>::max();
		for (const BodyState& b : bodies)
			if (b.present && b.radius > 0) smallest = std::min(smallest, 2 * b.radius);
		return smallest < std::numeric_limits<Real>::max() ? smallest : 0;
	}

	/// Angle from one rotation to another [rad], from −π to π; of bodies that are turned out of the plane the part
	/// about z.
	Real angleBetween(const plane::Rotation& from, const plane::Rotation& to)
	{
		const Real s = to.z * from.w - to.w * from.z, c = to.w * from.w + to.z * from.z;
		return c < 0 ? 2 * std::atan2(-s, -c) : 2 * std::atan2(s, c);
	}

	/// Whether a move is more than rounding, of a number of that size that has changed by `way` in the step.
	bool isMove(Real moved, Real size, Real way)
	{
		return std::abs(moved) > 1e-12 * std::abs(size) + 1e-9 * std::abs(way);
	}
}

/// What a move means; `own`: the body's own velocity.
void GivenMotion::takeMove(
        Series& series, Real moved, Real own, bool far, bool jumps, const Body& body, const char* what)
{
	const bool back  = own != 0 && std::signbit(moved) != std::signbit(own);
	const bool again = series.steps > 0;
	const bool late  = !again || series.steps > Real(longest);
	if (back || late || far || (jumps && series.steps > 1)) {
		series.interval = series.velocity = 0;
		if (again && !back)
			told = "body #" + std::to_string(body.id) + ", whose DOFs are blocked, was moved by " + what
			        + " again, " + number(moved) + (what == string("state.ori") ? " rad" : " m")
			        + " at once after " + std::to_string(long(series.steps))
			        + " steps. That is taken for a new place and not for a motion, and what it meets gets no velocity: set "
			          "state.vel (state.angVel) where it is to push or to drag, and the integrator moves it";
	} else {
		series.interval = series.steps;
		series.velocity = moved / series.time;
	}
	series.steps = series.time = 0;
}

void GivenMotion::followBody(Body& body, const BodyState& now, Real smallest)
{
	const plane::Motion &m = now.motion, &was = body.left;
	const auto           one = [&](int k, unsigned direction, Real moved, Real size, Real own, Real far, Real jump_,
                             const char* what) {
                Series& s = body.series[k];
                if (!(now.blocked & direction)) {
                        s = Series {};
                        return;
                }
                if (s.steps >= 0) ++s.steps;
                if (isMove(moved, size, own * s.time))
                        takeMove(s, moved, own, std::abs(moved) > far, std::abs(moved) > jump_, body, what);
                else if (s.steps >= s.interval)
                        s.interval = s.velocity = 0;
	};
	const Real far = farthest * smallest, jumps = jump * smallest;
	one(0, State::DOF_X, m.position.x - was.position.x, m.position.x, m.velocity.x, far, jumps, "state.pos");
	one(1, State::DOF_Y, m.position.y - was.position.y, m.position.y, m.velocity.y, far, jumps, "state.pos");
	one(2, State::DOF_RZ, angleBetween(was.rotation, m.rotation), 1, m.velocity.w, widest, widest, "state.ori");
}

/// A velocity that another thread has set between the solve and the integrator moves the body otherwise than it was
/// left to: that is no move of the body by its position.
void GivenMotion::expectVelocity(Body& body, const plane::Motion& m) const
{
	auto&      was    = body.left;
	const auto follow = [this](Real& left, Real now, Real velocity, Real before) {
		const Real way = step * (velocity - before);
		if (!isMove(now - left - way, now, step * velocity)) left = now;
	};
	follow(was.position.x, m.position.x, m.velocity.x, was.velocity.x);
	follow(was.position.y, m.position.y, m.velocity.y, was.velocity.y);
	const Real turned = angleBetween(was.rotation, m.rotation);
	if (!isMove(turned - step * (m.velocity.w - was.velocity.w), 1, step * m.velocity.w)) was.rotation = m.rotation;
}

const std::vector<GivenMotion::Given>& GivenMotion::take(const Scene& scene, const Resident& resident)
{
	given.clear();
	told.clear();
	if (taken) bodies = before; // the step was refused, and begins anew
	else
		before = bodies;
	taken               = true;
	Real       smallest = -1; // asked for where somebody has moved
	auto       at       = bodies.begin();
	const bool beside   = othersMayLook(scene);
	for (const int id : resident.driven) {
		while (at != bodies.end() && at->id < id)
			++at;
		if (at == bodies.end()) break;
		if (at->id != id) continue;
		const BodyState& now = resident.bodies[id];
		const auto &     m = now.motion, &was = at->left;
		if (beside) expectVelocity(*at, m);
		const bool stands = m.position.x == was.position.x && m.position.y == was.position.y
		        && m.rotation.z == was.rotation.z && m.rotation.w == was.rotation.w;
		const bool idle = std::all_of(at->series.begin(), at->series.end(), [](const Series& s) {
			return s.steps < 0;
		});
		if (stands && idle) continue;
		if (at->known && !isSame(at->body, (*scene.bodies)[id])) {
			at->series = {};
			continue;
		}
		if (smallest < 0) smallest = smallestDisk(resident.bodies);
		followBody(*at, now, smallest);
		const auto& s = at->series;
		if (s[0].velocity != 0 || s[1].velocity != 0 || s[2].velocity != 0)
			given.push_back({ id, { s[0].velocity, s[1].velocity, s[2].velocity } });
	}
	return given;
}

void GivenMotion::leave(const Scene& scene, const Resident& resident, Real h)
{
	taken            = false;
	step             = h;
	const auto& ids  = resident.driven;
	const bool  same = bodies.size() == ids.size()
	        && std::equal(bodies.begin(), bodies.end(), ids.begin(),
	                      [](const Body& b, int id) { return b.id == id; });
	if (!same) {
		std::vector<Body> kept(ids.size());
		auto              at = bodies.begin();
		for (size_t k = 0; k < ids.size(); ++k) {
			while (at != bodies.end() && at->id < ids[k])
				++at;
			if (at != bodies.end() && at->id == ids[k]) kept[k] = std::move(*at);
			kept[k].id = ids[k];
		}
		bodies.swap(kept);
	}
	for (Body& b : bodies) {
		b.left = resident.bodies[b.id].motion;
		plane::integrate(b.left, {}, 1, 1, plane::blockedAll, {}, h);
		for (Series& s : b.series)
			if (s.steps >= 0) s.time += h;
		if (const auto& body = (*scene.bodies)[b.id]; !b.known || !isSame(b.body, body)) {
			if (b.known) b.series = {};
			b.body  = body;
			b.known = true;
		}
	}
}

std::vector<Real> GivenMotion::numbers() const
{
	std::vector<Real> all;
	for (const Body& b : taken ? before : bodies) {
		const auto& m = b.left;
		all.insert(all.end(), { Real(b.id), m.position.x, m.position.y, m.rotation.z, m.rotation.w });
		for (const Series& s : b.series)
			all.insert(all.end(), { s.steps, s.time, s.interval, s.velocity });
	}
	return all;
}

void GivenMotion::setNumbers(const std::vector<Real>& all)
{
	constexpr size_t width = 17;
	bodies.clear();
	for (size_t k = 0; k + width <= all.size(); k += width) {
		Body b;
		b.id            = int(all[k]);
		b.left.position = { all[k + 1], all[k + 2] };
		b.left.rotation = { all[k + 3], all[k + 4] };
		for (size_t d = 0; d < 3; ++d) {
			const Real* s = &all[k + 5 + 4 * d];
			b.series[d]   = { s[0], s[1], s[2], s[3] };
		}
		bodies.push_back(std::move(b));
	}
}

} // namespace yade::nscd
