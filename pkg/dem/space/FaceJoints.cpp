#include "FaceJoints.hpp"
#include "Vectors.hpp"
#include <algorithm>
#include <numeric>
#include <pkg/common/Facet.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

namespace {
	constexpr Real apartOfFaces = 1e-6; // of the shorter facet's size: how far from each other what meets may lie

	Real meetingTolerance(Real size, const space::Vector& at)
	{
		const Real farthest = std::max({ std::abs(at.x), std::abs(at.y), std::abs(at.z) });
		return apartOfFaces * size + 16 * std::numeric_limits<Real>::epsilon() * farthest;
	}

	Real distanceOf(const space::Vector& a, const space::Vector& b) { return std::sqrt(dot(b - a, b - a)); }
}

bool FaceJoints::Face::operator==(const Face& o) const
{
	return id == o.id && mask == o.mask
	        && std::equal(
	                std::begin(corners.vertices), std::end(corners.vertices), std::begin(o.corners.vertices),
	                [](const space::Vector& a, const space::Vector& b) {
		                return a.x == b.x && a.y == b.y && a.z == b.z;
	                });
}

Real FaceJoints::Face::size() const
{
	Real longest = 0;
	for (int k = 0; k < 3; ++k)
		longest = std::max(longest, distanceOf(corners.at(k), corners.at(k + 1)));
	return longest;
}

bool FaceJoints::owns(const Scene& scene, Body::id_t facet, const space::Nearest& at, const space::Vector& centre)
{
	if (at.feature == space::Nearest::Face) return true;
	if (looked != stepOf(scene)) {
		const std::lock_guard<std::mutex> guard(mutex);
		if (looked != stepOf(scene)) look(scene);
	}
	const int place = size_t(facet) < placeOf.size() ? placeOf[facet] : -1;
	if (place < 0) return true;
	const Face& own = faces[place];
	for (const int k : others[place]) {
		const Face& other = faces[k];
		const Real  near  = meetingTolerance(std::min(own.size(), other.size()), at.point);
		if (distanceOf(space::nearest(other.corners, at.point).point, at.point) > near)
			continue; // q is not on it
		const auto there = space::nearest(other.corners, centre);
		if (there.feature == space::Nearest::Face || distanceOf(there.point, at.point) > near) return false;
		if (other.id < own.id) return false;
	}
	return true;
}

void FaceJoints::look(const Scene& scene)
{
	now.clear();
	for (const auto& b : *scene.bodies) {
		const auto* facet = b && b->isBounded() ? dynamic_cast<const Facet*>(b->shape.get()) : nullptr;
		if (!facet || !b->state || facet->vertices.size() != 3) continue;
		Face face { b->getId(), int(b->groupMask), {} };
		for (int k = 0; k < 3; ++k)
			face.corners.vertices[k] = ours(b->state->pos + b->state->ori * facet->vertices[k]);
		now.push_back(face);
	}
	if (now != faces) {
		faces.swap(now);
		placeOf.assign(scene.bodies->size(), -1);
		for (size_t k = 0; k < faces.size(); ++k)
			placeOf[faces[k].id] = int(k);
		meet();
	}
	looked = stepOf(scene);
}

/// Finds for all facets those that meet them. They are gone through along x, so that far ones are not compared.
void FaceJoints::meet()
{
	struct Extent {
		Vector3r least, most;
	};
	const int           count = int(faces.size());
	std::vector<Extent> extents(count);
	for (int k = 0; k < count; ++k) {
		const Vector3r c[]  = { theirs(faces[k].corners.at(0)), theirs(faces[k].corners.at(1)),
			                theirs(faces[k].corners.at(2)) };
		const Real     near = apartOfFaces * faces[k].size();
		const Vector3r room = Vector3r(near, near, near);
		extents[k] = { c[0].cwiseMin(c[1]).cwiseMin(c[2]) - room, c[0].cwiseMax(c[1]).cwiseMax(c[2]) + room };
	}
	std::vector<int> order(count);
	std::iota(order.begin(), order.end(), 0);
	std::sort(order.begin(), order.end(), [&](int a, int b) {
		return std::make_pair(extents[a].least[0], a) < std::make_pair(extents[b].least[0], b);
	});
	others.assign(count, {});
	const auto touches = [&](const Face& a, const Face& b) {
		for (const auto& [one, other] : { std::pair(&a, &b), std::pair(&b, &a) })
			for (const auto& corner : one->corners.vertices)
				if (distanceOf(space::nearest(other->corners, corner).point, corner)
				    <= meetingTolerance(std::min(a.size(), b.size()), corner))
					return true;
		return false;
	};
	for (int m = 0; m < count; ++m)
		for (int n = m + 1; n < count; ++n) {
			const int a = order[m], b = order[n];
			if (extents[b].least[0] > extents[a].most[0]) break;
			const bool near = extents[a].least[1] <= extents[b].most[1]
			        && extents[b].least[1] <= extents[a].most[1]
			        && extents[a].least[2] <= extents[b].most[2]
			        && extents[b].least[2] <= extents[a].most[2];
			if (!near || faces[a].mask != faces[b].mask || !touches(faces[a], faces[b])) continue;
			others[a].push_back(b);
			others[b].push_back(a);
		}
}

} // namespace yade::nscd
