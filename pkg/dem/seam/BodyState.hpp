// What a step takes from the bodies, side by side in memory: YADE's bodies, their states and their shapes lie all over
// it.
#pragma once

#include <contact/plane/motion.hpp>
#include <core/Scene.hpp>

namespace yade::nscd {

struct BodyState {
	nonsmooth::contact::plane::Motion motion;
	Real                              z;
	Real                              mass, inertia; // of motion in the plane
	Real                              radius; // of a sphere, negative for another shape and where there is none
	unsigned                          blocked; // State::blockedDOFs
	bool present; // false: there is no such body, and nothing else is set but the radius
	bool clumped; // a clump, or of one
	bool plain; // a sphere and not of a class derived from it, and not a clump
	bool aspherical; // free to turn, with three different inertias
	bool bounded; // has a Body::bound
	bool planar; // all of its velocity is here, and nothing can bring it out of the plane; the others' states are always up to date
	bool moved; // its state does not know it yet

	Vector3r place() const { return Vector3r(motion.position.x, motion.position.y, z); }
};

/// Whether two disks are farther apart than `factor` sums of their radii, as Ig2_Sphere_Sphere_ScGeom tells it.
inline bool areBeyond(Real factor, const BodyState& first, const BodyState& second)
{
	return std::pow(factor * (first.radius + second.radius), 2) - (second.place() - first.place()).squaredNorm()
	        < 0;
}

/// Directions of motion in the plane, as in State::blockedDOFs.
constexpr unsigned inPlane = State::DOF_X | State::DOF_Y | State::DOF_RZ;

/// Reads a body, null where there is none; one without a state has nothing else set, as where there is none.
BodyState readBody(const Body* body);

/// What a body was when it was last read, whose radius is another one now.
struct FormerSize {
	int  id;
	Real radius, mass, inertia; // [m, kg, kg m²]
};

/// Reads all bodies of a scene, by id; returns those of other radius than `states` had, in the order of ids.
std::vector<FormerSize> readBodies(Scene& scene, int threads, std::vector<BodyState>& states);

/// Reads place, orientation and velocity in the plane.
void readMotion(const State& state, BodyState& result);

} // namespace yade::nscd
