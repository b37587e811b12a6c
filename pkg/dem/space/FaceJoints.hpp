// Which facets meet, so that a surface of triangles is one wall to a sphere that rolls over its edges.
//
// With q the point of a facet that is nearest to a sphere's centre, the contact is this facet's
//   - where q lies within its face;
//   - where q lies on an edge or at a vertex, unless another facet that has q too is nearer to the centre elsewhere (it goes on below the sphere), or is of lower id and
//     has q for its nearest point as well (a convex edge or corner, whose first facet has the contact).
// So coplanar facets and convex edges have one contact, and concave edges, at which the faces of two facets are
// touched, have two.
//
// Facets meet where they have a vertex of the other on them, up to 1e-6 of the shorter one's size and rounding. It is
// looked up by positions in the step in which facets have come, gone, moved or been changed. Those of different
// groupMask are not joined, nor what no sphere can touch (Body.bounded False).
#pragma once

#include "../seam/PerScene.hpp"
#include <atomic>
#include <contact/space/nearest.hpp>
#include <core/Scene.hpp>
#include <mutex>

namespace yade::nscd {

class FaceJoints : public PerScene<FaceJoints> {
public:
	/// Whether a contact at the nearest point of that facet is its own, for a sphere's centre there.
	bool
	owns(const Scene& scene, Body::id_t facet, const nonsmooth::contact::space::Nearest& at,
	     const nonsmooth::contact::space::Vector& centre);

private:
	/// A facet as it was at the last look.
	struct Face {
		Body::id_t                          id;
		int                                 mask;
		nonsmooth::contact::space::Triangle corners; // [m]

		bool operator==(const Face& other) const;
		Real size() const;
	};
	void look(const Scene& scene);
	void meet();

	std::mutex                    mutex;
	std::atomic<long>             looked { std::numeric_limits<long>::min() }; // step, see stepOf
	std::vector<Face>             faces, now; // of the last look, and of this one
	std::vector<std::vector<int>> others; // by place in faces: places of those that it meets
	std::vector<int>              placeOf; // by id; −1 where there is no facet
};

} // namespace yade::nscd
