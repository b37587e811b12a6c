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
	bool        aspherical;                  // free to turn, with three different inertias
	bool        bounded;                     // has a Body::bound
	bool        planar;                      // all of its velocity is here, and nothing can bring it out of the plane; the others' states are always up to date
	bool        moved;                       // its state does not know it yet
};

/// Reads all bodies of a scene, by id.
void readBodies(Scene& scene, int threads, std::vector<BodyReading>& readings);

/// Writes place, orientation and velocity in the plane.
void writeMotion(const BodyReading& reading, State& state);
void readMotion(const State& state, BodyReading& reading);

} // namespace yade::nscd
