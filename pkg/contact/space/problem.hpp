// One step's contact problem in space as plain arrays: what the solver reads and writes. The plane's is
// contact/plane/problem.hpp.
//
// A contact couples bodies i and j through its normal n, from i to j. With a the arm from a body's centre to the
// contact point, v and ω its velocity and angular velocity,
//
//     U   = v_j + ω_j × a_j − v_i − ω_i × a_i   relative velocity of the points that touch:  U_n = n·U,  U_t = U − U_n n
//     w   = ω_j − ω_i                           relative angular velocity:  twisting w_s = n·w,  rolling w_r = w − w_s n
//     a   = λ n + a_⊥                           λ the lever (radius of i, minus radius of j); a_⊥ = 0 of spheres
//
// Impulses over the step (P = h F) are vectors of the world, positive on body j: f = P_n n + P_t at the contact point,
// and a moment m = P_s n + P_r. Compression is
// positive. No frame of tangents is kept, so a contact that turns needs no other numbers than its normal.
// Units: SI.
#pragma once

#include <contact/space/vector.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nonsmooth::contact::space {

/// Velocity [m/s] and angular velocity [rad/s] of a body, or a change of them.
struct Twist {
	Vector v, w;
};

/// Inverse masses along the axes of the world [1/kg] and inverse tensor of inertia [1/(kg m²)]; zero where a degree of
/// freedom is blocked or driven. The tensor is that of the
/// step's beginning.
struct InverseMass {
	double    x = 0, y = 0, z = 0;
	Symmetric inertia;

	static InverseMass ofSphere(double inverse, double inertia)
	{
		return { inverse, inverse, inverse, Symmetric::multiple(inertia) };
	}
	bool isFixed() const { return x == 0 && y == 0 && z == 0 && inertia.isZero(); }
	/// One mass and one moment of inertia for all directions, as a sphere has them, or a body that is fixed.
	bool isBall() const { return x == y && y == z && inertia.isMultiple(); }
};

/// Reaction impulses of one contact: force [N s] at its point, and moment [N m s].
struct Impulse {
	Vector f, m;
};

/// Relative velocity at a contact: U_n [m/s], U_t [m/s] and w [rad/s].
struct RelativeVelocity {
	double n = 0;
	Vector t, w;
};

/// What is known of one contact before the solve. `bias*` are the right-hand sides b of the graphs in space/law.hpp;
/// those across need no more than to be vectors,
/// biasT being perpendicular to n.
struct Contact {
	std::int32_t i = 0, j = 0;
	Vector       n { 1, 0, 0 };
	double       leverI = 0, leverJ = 0; // λ [m]
	Vector       asideI, asideJ; // a_⊥ [m]
	double       biasN = 0; // [m/s]
	Vector       biasT, biasW; // [m/s], [rad/s]
	double       adhesion    = 0; // h F_a [N s]
	double       friction    = 0; // μ_s
	double       rollingArm  = 0; // μ_r ℓ [m]
	double       twistingArm = 0; // μ_tw ℓ [m]
	double       length      = 1; // ℓ [m]: turns residuals of moments into impulses
	double       play = 0; // L/h [m/s]: of a bond that closes freely, see contact/plane/law.hpp; 0 of all others
};

struct Problem {
	std::vector<InverseMass> inverseMass; // one a body
	std::vector<Twist>       freeVelocity; // velocity at the end of the step if no contact acted
	std::vector<Vector>  positions; // of the bodies' centres [m]; may be empty, serves the order of the sweep only
	std::vector<Contact> contacts;
	std::vector<Impulse> impulses; // warm start in, solution out
	std::vector<Twist>   velocities; // out: freeVelocity + M⁻¹ Hᵀ P

	std::size_t bodyCount() const { return inverseMass.size(); }
	std::size_t contactCount() const { return contacts.size(); }
};

inline Vector operator*(const InverseMass& m, const Vector& f) { return { m.x * f.x, m.y * f.y, m.z * f.z }; }
inline Vector acrossNormal(const Vector& n, const Vector& a) { return a - dot(n, a) * n; }

/// Without bias. Inline by force: a call costs as much as what it computes.
[[gnu::always_inline]] inline RelativeVelocity relativeVelocity(const Contact& c, const Twist& vi, const Twist& vj)
{
	// what turns about the arm's part along n moves the point across n alone, which rounding would forget
	const Vector aside = cross(vj.w, c.asideJ) - cross(vi.w, c.asideI), d = vj.v - vi.v + aside;
	const double n = dot(c.n, d);
	return { n, d - n * c.n + cross(c.leverJ * vj.w - c.leverI * vi.w, c.n), vj.w - vi.w };
}

/// v_j += M_j⁻¹ Hᵀ p and v_i −= M_i⁻¹ Hᵀ p.
inline void
applyImpulse(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist& vi, Twist& vj)
{
	const Vector turn = cross(c.n, p.f);
	vi.v              = vi.v - mi * p.f;
	vi.w              = vi.w - mi.inertia * (c.leverI * turn + cross(c.asideI, p.f) + p.m);
	vj.v              = vj.v + mj * p.f;
	vj.w              = vj.w + mj.inertia * (c.leverJ * turn + cross(c.asideJ, p.f) + p.m);
}

/// What impulses become that are extrapolated by beta.
inline Impulse extrapolated(const Impulse& now, const Impulse& before, double beta)
{
	return { now.f + beta * (now.f - before.f), now.m + beta * (now.m - before.m) };
}

inline Impulse difference(const Impulse& a, const Impulse& b) { return { a.f - b.f, a.m - b.m }; }

/// Adds a relative velocity to the biases of a contact.
inline void addBias(Contact& c, const RelativeVelocity& u)
{
	c.biasN += u.n;
	c.biasT = c.biasT + u.t;
	c.biasW = c.biasW + u.w;
}

inline Twist  difference(const Twist& a, const Twist& b) { return { a.v - b.v, a.w - b.w }; }
inline Twist  sum(const Twist& a, const Twist& b) { return { a.v + b.v, a.w + b.w }; }
inline double squaredSpeed(const Twist& v) { return dot(v.v, v.v); }

} // namespace nonsmooth::contact::space
