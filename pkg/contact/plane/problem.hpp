// One step's contact problem as plain arrays: what the solver reads and writes.
//
// Bodies carry generalised velocities (v_x, v_y, ω); a contact couples bodies i and j through the frame (n, t),
// n from i to j and t = n turned by +90°. With ρ the lever from a body's centre to the contact point,
//
//     U_n = n·(v_j − v_i) + λn_j ω_j − λn_i ω_i ,   λn = n·(ẑ × ρ)   (0 for disks)
//     U_t = t·(v_j − v_i) + λt_j ω_j − λt_i ω_i ,   λt = ρ·n         (radius of i, minus radius of j)
//     w   = ω_j − ω_i
//
// Reactions are impulses over the step (P = h F), positive on body j: compression is positive.
// Units: SI; in two dimensions masses, forces and impulses are per metre of thickness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nonsmooth::contact {

/// Velocity of a body, or a change of it.
struct Twist {
	double x = 0, y = 0, w = 0;
};

/// Force and torque on a body [N, N m], or their impulses [N s, N m s].
struct Wrench {
	double x = 0, y = 0, w = 0;
};

/// A place in the plane [m].
struct Point {
	double x = 0, y = 0;
};

/// Inverse generalised mass; zero where a degree of freedom is blocked or driven.
struct InverseMass {
	double x = 0, y = 0, w = 0;
	bool   isFixed() const { return x == 0 && y == 0 && w == 0; }
};

/// Reaction impulses of one contact: normal [N s], tangential [N s], rolling [N m s].
struct Impulse {
	double n = 0, t = 0, r = 0;
};

/// Relative velocity at a contact: U_n, U_t [m/s] and w [rad/s].
struct RelativeVelocity {
	double n = 0, t = 0, r = 0;
};

/// W of each row of a contact, or its inverse.
struct Diagonal {
	double n = 0, t = 0, r = 0;
};

/// What is known of one contact before the solve. `bias*` are the right-hand sides b of the graphs in law.hpp [m/s,
/// m/s, rad/s].
struct Contact {
	std::int32_t i = 0, j = 0;
	double       nx = 1, ny = 0;
	double       leverNi = 0, leverTi = 0, leverNj = 0, leverTj = 0; // λ [m]
	double       biasN = 0, biasT = 0, biasR = 0;
	double       adhesion   = 0; // h F_a [N s]
	double       friction   = 0; // μ_s
	double       rollingArm = 0; // μ_r ℓ [m]
	double       length     = 1; // ℓ [m]: turns rolling residuals into impulses
	double       play       = 0; // L/h [m/s]: of a bond that closes freely, see law.hpp; 0 of all others
};

struct Problem {
	std::vector<InverseMass> inverseMass; // one a body
	std::vector<Twist>       freeVelocity; // velocity at the end of the step if no contact acted
	std::vector<Point>       positions; // of the bodies' centres; may be empty, serves the order of the sweep only
	std::vector<Contact>     contacts;
	std::vector<Impulse>     impulses; // warm start in, solution out
	std::vector<Twist>       velocities; // out: freeVelocity + M⁻¹ Hᵀ P

	std::size_t bodyCount() const { return inverseMass.size(); }
	std::size_t contactCount() const { return contacts.size(); }
};

/// Relative velocity (U_n, U_t, w) of a contact for given body velocities, without bias.
inline RelativeVelocity relativeVelocity(const Contact& c, const Twist& vi, const Twist& vj)
{
	const double dx = vj.x - vi.x, dy = vj.y - vi.y;
	return { c.nx * dx + c.ny * dy + c.leverNj * vj.w - c.leverNi * vi.w,
		 -c.ny * dx + c.nx * dy + c.leverTj * vj.w - c.leverTi * vi.w, vj.w - vi.w };
}

/// How fast the places of two bodies pass each other, along the tangent: without what their turning adds [m/s].
inline double passingSpeed(const Contact& c, const Twist& vi, const Twist& vj)
{
	return -c.ny * (vj.x - vi.x) + c.nx * (vj.y - vi.y);
}

/// v_j += M_j⁻¹ Hᵀ p and v_i −= M_i⁻¹ Hᵀ p.
inline void
applyImpulse(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist& vi, Twist& vj)
{
	const double fx = c.nx * p.n - c.ny * p.t, fy = c.ny * p.n + c.nx * p.t;
	vi.x -= mi.x * fx;
	vi.y -= mi.y * fy;
	vi.w -= mi.w * (c.leverNi * p.n + c.leverTi * p.t + p.r);
	vj.x += mj.x * fx;
	vj.y += mj.y * fy;
	vj.w += mj.w * (c.leverNj * p.n + c.leverTj * p.t + p.r);
}

/// What impulses become that are extrapolated by beta.
inline Impulse extrapolated(const Impulse& now, const Impulse& before, double beta)
{
	return { now.n + beta * (now.n - before.n), now.t + beta * (now.t - before.t),
		 now.r + beta * (now.r - before.r) };
}

inline Impulse difference(const Impulse& a, const Impulse& b) { return { a.n - b.n, a.t - b.t, a.r - b.r }; }

/// Adds a relative velocity to the biases of a contact.
inline void addBias(Contact& c, const RelativeVelocity& u)
{
	c.biasN += u.n;
	c.biasT += u.t;
	c.biasR += u.r;
}

inline Twist  difference(const Twist& a, const Twist& b) { return { a.x - b.x, a.y - b.y, a.w - b.w }; }
inline Twist  sum(const Twist& a, const Twist& b) { return { a.x + b.x, a.y + b.y, a.w + b.w }; }
inline double squaredSpeed(const Twist& v) { return v.x * v.x + v.y * v.y; }

} // namespace nonsmooth::contact
