// What a step takes from the bodies, side by side in memory: YADE's bodies, their states and their shapes lie all over it.
#pragma once

#include <core/Scene.hpp>

namespace yade::nscd {

struct BodyReading {
	Vector3r    pos;
	Quaternionr ori;
	Real        vx, vy, spin, mass, inertia; // of motion in the plane
	Real        radius;                      // of a sphere, negative for another shape and where there is none
	unsigned    blocked;                     // State::blockedDOFs
	bool        present;                     // false: there is no such body, and nothing else is set but the radius
	bool        clumped;                     // a clump, or of one
	bool        plain;                       // a sphere and not of a class derived from it, and not a clump
};

/// Reads all bodies of a scene, by id.
void readBodies(Scene& scene, int threads, std::vector<BodyReading>& readings);

} // namespace yade::nscd
