// Sets of bodies that bonds hold together move as one rigid body: how such a cluster goes through a step of length h.
//
// x⁺ = x + h v⁺ of each body by itself (motion.hpp) stretches a set that turns with Ω by √(1 + Ω²h²) and turns it by
// atan Ωh, while its spins go on by Ωh: no bond that holds can hear of it, and spin and orbit part in proportion to h².
// So where bodies move together their step is taken in axes that turn with them. With X and V place and velocity of the
// cluster's centre of mass, or of the body in it that is held, r = x − X, a = Ω h, R the turn by a, J that by 90°:
//     before the solve    v_free += Ω a r                            each body bears the centrifugal force m Ω² r, and the bonds bear it for it      (load)
//     after the solve     u = v − V − Ω J r ,   r̃ = r + h u           what is not turning, next to nothing                                            (turn)
//                         x⁺ = X + h V + R r̃ ,   v⁺ = V + R (Ω⁺ J r̃ + u) ,   Ω⁺ Σ m r̃² = Ω Σ m r²     (Ω⁺ = Ω about a body that is held)
// A rigid cluster turns by Ωh exactly, as its spins do, keeps its shape, its energy and its angular momentum at any Ωh,
// and its bonds bear m Ω² r; Ω⁺ keeps Σ m x × v exactly where something is not rigid. A body whose bonds give way in a
// step leaves with the velocity that it had before it was turned, but for a share of a²/2 of its speed. So load() takes
// the clusters that turn() turned in the step before, and no others. Ω is the mean of the orbits, Σ m r × (v − V) / Σ m
// r² ; where a body in it may not turn freely, that one's.
// Sign: Ω and turns counter-clockwise positive. Units: m, s, kg, rad. Derivation: from Newton's law in turning axes;
// not in the paper, which has no equation for a step of the positions.
#pragma once

#include <contact/plane/problem.hpp>
#include <utility>
#include <vector>

namespace nonsmooth::contact::plane {

class RigidClusters {
public:
	using Joint = std::pair<int, int>; // two bodies

	/// Finds the sets that are connected by joints; each has its bodies in the order of ids, and sets are in the
	/// order of their first bodies.
	void find(const std::vector<Joint>& joints, std::size_t bodyCount);

	std::size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
	/// Bodies of one set.
	const int* first(std::size_t cluster) const { return bodies.data() + begin[cluster]; }
	const int* last(std::size_t cluster) const { return bodies.data() + begin[cluster + 1]; }

private:
	int rootOf(int body);

	std::vector<int>         parent; // by body; `nobody` for those that no joint names
	std::vector<int>         bodies; // set by set
	std::vector<std::size_t> begin; // of the sets, and the end
	std::vector<int>         rank; // of a root's set, by body
	std::vector<std::size_t> next; // memory of find()
};

/// Bodies of the plane as arrays, by id.
struct BodyArrays {
	const Point*       positions; // [m]
	const InverseMass* inverseMass;
	const double*      mass; // [kg]
};

/// What a cluster turns about.
struct TurningAxes {
	bool turns
	        = false; // false where it cannot turn as one: a body in it is guided along a line, or it is one point
	bool   held = false; // about a body that is held
	Point  centre; // X
	Twist  velocity; // V and Ω
	double inertia = 0; // Σ m r² of the bodies that are not held [kg m²]
};
TurningAxes axesOf(const BodyArrays& bodies, const std::vector<Twist>& velocities, const int* first, const int* last);

/// How much of a cluster's speed about its axes may not be rigid for it to turn as one.
constexpr double rigidEnough = 0.01;
/// Whether it moves as one rigid body, but for that share (rms over its mass).
bool movesRigidly(
        const BodyArrays& bodies, const std::vector<Twist>& velocities, const TurningAxes& axes, const int* first,
        const int* last);

/// Change of velocity [m/s] that the centrifugal force gives a cluster's free bodies in a step, added to `gain`.
void load(
        const BodyArrays& bodies, const TurningAxes& axes, double h, const int* first, const int* last,
        std::vector<Twist>& gain);

/// What turning a cluster asks of its free bodies beside x + h v⁺, v⁺ = v + `change`: the displacement [m] and the
/// change of velocity [m/s], added by id.
void turn(
        const BodyArrays& bodies, const std::vector<Twist>& velocities, const TurningAxes& axes, double h,
        const int* first, const int* last, std::vector<Twist>& displacement, std::vector<Twist>& change);

} // namespace nonsmooth::contact::plane
