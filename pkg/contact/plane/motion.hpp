// Motion of a rigid body in the plane: a step of its motion, a displacement, vectors turned with it.
//
// With h the step, f and M force and torque, m and I mass and moment of inertia about z, g gravity, q = cos φ/2 + ẑ sin
// φ/2:
//     v⁺ = v + h (f/m + g) ,   ω⁺ = ω + h M/I ,   x⁺ = x + h v⁺ ,   q⁺ = (cos ½hω⁺ + ẑ sin ½hω⁺) q / |q|        (integrate)
//     x⁺ = x + d ,   q⁺ = (cos ½δ + ẑ sin ½δ) q / |q| for a displacement (d, δ)                                  (displace)
//     q v q* and q* v q, vectors of the body's frame in the plane's and back                                    (rotate, rotateBack)
// which is Moreau-Jean with θ = 1, as f holds the contacts' mean forces. In a blocked direction a velocity stays as it
// is.
// Sign: ω, M and φ counter-clockwise positive. Units: m, s, kg, N, rad; masses and forces per metre of thickness.
//
// The bits are those of YADE's integrator and of Eigen in space where all that is out of the plane is +0: terms of such
// zeros are left out, but where they decide the sign of a zero.
#pragma once

#include <cmath>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact::plane {

/// A unit quaternion about z.
struct Rotation {
	double z = 0, w = 1; // sin φ/2, cos φ/2
};

struct Motion {
	Point    position; // of the centre of mass
	Rotation rotation;
	Twist    velocity;
};

/// Directions in which a body keeps its velocity, as in YADE's State::blockedDOFs; with `blockedAll`, out of the plane
/// too, nothing is even added to it.
constexpr unsigned blockedX = 1, blockedY = 2, blockedTurn = 32, blockedAll = 63;

/// v seen from the plane, for v in the frame of a body with that rotation. A zero may have the other sign than Eigen's.
inline Point rotate(const Rotation& q, const Point& v)
{
	// v + w u + q × u with u = 2 q × v
	const double ux = -2 * (q.z * v.y), uy = 2 * (q.z * v.x);
	return { v.x + q.w * ux - q.z * uy, v.y + q.w * uy + q.z * ux };
}

/// v seen from the body, for v in the plane.
inline Point rotateBack(const Rotation& q, const Point& v)
{
	const double ux = 2 * (q.z * v.y), uy = 2 * (0.0 - q.z * v.x), uz = 0.0 * v.x - 0.0 * v.y;
	return { v.x + q.w * ux + (q.z * uy - uz), v.y + q.w * uy + (uz - q.z * ux) };
}

/// first b, then a.
inline Rotation product(const Rotation& a, const Rotation& b)
{
	return { a.w * b.z + a.z * b.w, a.w * b.w - a.z * b.z };
}

/// Of length 1 again; what has no length stays.
inline Rotation normalized(const Rotation& q)
{
	const double square = q.z * q.z + q.w * q.w;
	if (!(square > 0)) return q;
	const double length = std::sqrt(square);
	return { q.z / length, q.w / length };
}

/// Velocity and place at the end of a step of length h [s], with force and torque [N, N m]; mass and moment of inertia
/// [kg, kg m²] are not looked at where blocked.
inline void
integrate(Motion& m, const Twist& force, double mass, double inertia, unsigned blocked, const Point& gravity, double h)
{
	Twist& v = m.velocity;
	if (blocked != blockedAll) {
		v.x += h * (blocked & blockedX ? 0.0 : 0.0 + (force.x / mass + gravity.x));
		v.y += h * (blocked & blockedY ? 0.0 : 0.0 + (force.y / mass + gravity.y));
		v.w += h * (blocked & blockedTurn ? 0.0 : 0.0 + force.w / inertia);
	}
	m.position.x += v.x * h;
	m.position.y += v.y * h;
	const double square = v.w * v.w;
	if (square != 0) {
		const double speed = std::sqrt(square), half = 0.5 * (speed * h);
		m.rotation = product({ std::sin(half) * (v.w / speed), std::cos(half) }, m.rotation);
	}
	m.rotation = normalized(m.rotation);
}

/// Moves a body by d [m, m, rad]; velocities stay.
inline void displace(Motion& m, const Twist& d)
{
	if (d.x == 0 && d.y == 0 && d.w == 0) return;
	m.position.x += d.x;
	m.position.y += d.y;
	if (d.w == 0) return;
	const double half = 0.5 * d.w;
	m.rotation        = normalized(product({ std::sin(half), std::cos(half) }, m.rotation));
}

} // namespace nonsmooth::contact::plane
