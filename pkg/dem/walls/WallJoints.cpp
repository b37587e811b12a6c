#include "WallJoints.hpp"
#include "Arc.hpp"
#include "Segment.hpp"
#include <algorithm>
#include <numeric>

namespace yade::nscd {

namespace {
	constexpr Real apart     = 1e-6,
	               saidApart = 1e-2; // of the shorter wall: ends that meet, and those that join() says meet

	/// What a sum of coordinates may have lost [m].
	Real rounding(const Vector3r& point)
	{
		return 16 * std::numeric_limits<Real>::epsilon() * point.cwiseAbs().maxCoeff();
	}
}

bool WallJoints::Wall::operator==(const Wall& o) const
{
	return id == o.id && shape == o.shape && position == o.position
	        && orientation.coeffs() == o.orientation.coeffs() && size == o.size && opening == o.opening
	        && sense == o.sense && mask == o.mask && owns == o.owns && yields == o.yields;
}

std::array<WallTip, 2> WallJoints::Wall::tips() const
{
	const auto at = [this](Real angle) {
		return Vector3r(orientation * Vector3r(std::cos(angle), std::sin(angle), 0));
	};
	if (!isArc()) {
		const Vector3r along = at(0), up = orientation * Vector3r(0, 1, 0);
		return { { { position - size * along, along, up }, { position + size * along, -along, up } } };
	}
	// counter-clockwise, so that + is the side of the centre
	const Vector3r from = at(-opening), to = at(opening), z(0, 0, 1);
	return { { { position + size * from, z.cross(from), -from }, { position + size * to, to.cross(z), -to } } };
}

bool WallJoints::Wall::holds(const Vector3r& point, Real tolerance, Vector3r& up) const
{
	const Vector3r here = orientation.conjugate() * (point - position); // in its own frame
	if (!isArc()) {
		up = orientation * Vector3r(0, 1, 0);
		return std::abs(here[1]) <= tolerance && std::abs(here[0]) < size;
	}
	const Real distance = here.norm();
	up                  = -(point - position) / distance;
	return std::abs(distance - size) <= tolerance && std::abs(std::atan2(here[1], here[0])) < opening;
}

const WallEnds& WallJoints::endsOf(const Scene& scene, Body::id_t id, bool anew)
{
	static const WallEnds free;
	if (anew || looked != stepOf(scene)) {
		const std::lock_guard<std::mutex> guard(mutex);
		if (anew || looked != stepOf(scene)) {
			std::vector<int> all(scene.bodies->size());
			std::iota(all.begin(), all.end(), 0);
			find(scene, all);
		}
	}
	const int place = id >= 0 && size_t(id) < placeOf.size() ? placeOf[id] : -1;
	return place < 0 ? free : ends[place];
}

void WallJoints::find(const Scene& scene, const std::vector<int>& ids)
{
	now.clear();
	for (const int id : ids)
		note((*scene.bodies)[id].get());
	if (now != walls) {
		walls.swap(now);
		placeOf.assign(scene.bodies->size(), -1);
		for (size_t k = 0; k < walls.size(); ++k)
			placeOf[walls[k].id] = int(k);
		meet();
	}
	looked = stepOf(scene);
}

/// Takes a body that is a wall in the plane and can be touched.
void WallJoints::note(const Body* body)
{
	if (!body || !body->shape || !body->state || !body->isBounded() || body->isClumpMember()) return;
	const auto&       type = typeid(*body->shape);
	const auto* const arc  = type == typeid(Arc) ? static_cast<const Arc*>(body->shape.get()) : nullptr;
	const auto* const line = type == typeid(Segment) ? static_cast<const Segment*>(body->shape.get()) : nullptr;
	if (!arc && !line) return;
	const State& state = *body->state;
	if (state.ori.x() != 0 || state.ori.y() != 0) return;
	Wall w { body->getId(), body->shape.get(), state.pos, state.ori, 0, 0, 0, int(body->groupMask), {}, {} };
	if (arc) {
		w.size    = arc->radius;
		w.opening = arc->halfAngle;
		w.sense   = arc->sense;
	} else {
		w.size   = line->halfLength;
		w.sense  = line->sense;
		w.owns   = { line->previousDirection != Vector3r::Zero(), line->nextDirection != Vector3r::Zero() };
		w.yields = { line->hasPrevious, line->hasNext };
	}
	now.push_back(w);
}

/// Whether the end of a wall goes before another one that it meets; `alone`: no third one is there.
bool WallJoints::isBefore(int wall, int end, const Meeting& other, bool alone) const
{
	const Wall &a = walls[wall], &b = walls[other.wall];
	if (alone && a.owns[end] && b.yields[other.end]) return true;
	if (alone && b.owns[other.end] && a.yields[end]) return false;
	return a.id < b.id;
}

/// Finds for all ends what meets them. Walls are gone through along x, so that far ones are not compared.
void WallJoints::meet()
{
	const int count = int(walls.size());
	tips.resize(count);
	ends.assign(count, {});
	std::vector<int>  order(count);
	std::vector<Real> left(count);
	Real              widest = 0;
	for (int k = 0; k < count; ++k) {
		const Wall& w = walls[k];
		tips[k]       = w.tips();
		order[k]      = k;
		left[k]       = w.isArc() ? w.position[0] - w.size : std::min(tips[k][0].point[0], tips[k][1].point[0]);
		const Real width = w.isArc() ? 2 * w.size : std::abs(tips[k][1].point[0] - tips[k][0].point[0]);
		widest           = std::max(widest, width);
	}
	std::sort(order.begin(), order.end(), [&](int a, int b) {
		return std::make_pair(left[a], a) < std::make_pair(left[b], b);
	});
	const auto isRing = [](const Wall& w) { return w.isArc() && w.opening >= Mathr::PI; };
	for (int k = 0; k < count; ++k)
		for (int end = 0; end < 2 && !isRing(walls[k]); ++end) {
			const WallTip&               tip  = tips[k][end];
			const Real                   most = saidApart * walls[k].length() + rounding(tip.point);
			std::vector<Meeting>         met;
			std::vector<WallEnd::Other>& others = ends[k][end].others;
			auto                         next   = std::lower_bound(
			                                  order.begin(), order.end(), tip.point[0] - widest - most,
			                                  [&](int place, Real x) { return left[place] < x; });
			for (; next != order.end() && left[*next] <= tip.point[0] + most; ++next) {
				const Wall& o = walls[*next];
				if (*next == k || o.mask != walls[k].mask) continue;
				const Real shorter = std::min(walls[k].length(), o.length()),
				           round   = rounding(tip.point);
				bool meets         = false;
				for (int there = 0; there < 2 && !isRing(o); ++there) {
					const bool said = (walls[k].owns[end] && o.yields[there])
					        || (o.owns[there] && walls[k].yields[end]);
					if ((tips[*next][there].point - tip.point).norm()
					    > (said ? saidApart : apart) * shorter + round)
						continue;
					met.push_back({ *next, there });
					meets = true;
				}
				Vector3r up;
				if (!meets && o.holds(tip.point, apart * shorter + round, up))
					others.push_back({ Vector3r::Zero(), up, o.sense, true, true });
			}
			for (const Meeting& m : met) {
				const WallTip& there = tips[m.wall][m.end];
				const bool     first = !isBefore(k, end, m, met.size() == 1);
				others.push_back({ there.along, there.up, walls[m.wall].sense, false, first });
				if (!first) ends[k][end].isFirst = true;
			}
		}
}

} // namespace yade::nscd
