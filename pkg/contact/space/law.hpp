// The cohesive contact law in space, as one projection: that of the plane (contact/plane/law.hpp) with discs in the
// place of intervals, and a fourth graph for twisting.
//
// Equations. N, T, Γ, Σ are the normal force, the shear force, the rolling torque and the twisting torque of a contact,
// T ⟂ n, Γ ⟂ n; U_n, U_t, w_r, w_s the relative
// velocities that they belong to (space/problem.hpp), ℓ the sum of the radii:
//     Signorini with tension     U_n = 0, N ≥ −F_a   or   U_n > 0, N = −F_a ,      F_a = σ_ext A [N]
//     Coulomb                    |T| ≤ T_max ,  T = −T_max U_t/|U_t| where U_t ≠ 0 ,  T_max = μ_s (F_a + N)
//     rolling                    |Γ| ≤ Γ_max ,  Γ = −Γ_max w_r/|w_r| where w_r ≠ 0 ,  Γ_max = μ_r ℓ (F_a + N)
//     twisting                   |Σ| ≤ Σ_max ,  Σ = −Σ_max sign w_s where w_s ≠ 0 ,   Σ_max = μ_tw ℓ (F_a + N)
// Time-discrete form (Moreau-Jean, implicit), biases and the play of bonds that close freely are those of the plane:
// impulses over the step in the place of forces,
// thresholds times h, U_n + b_n for U_n and so on.
//
// Derivation. For a threshold that is given, each graph "x ∈ K, −u ∈ N_K(x)" is the fixed point x = proj_K(x − ρ u) for
// any ρ > 0, K being the half line N ≥ −F_a, a disc in the
// plane across n, or an interval. The thresholds follow the normal impulse at hand. That is Coulomb's law, not the cone
// of maximal dissipation: a contact that slides does not open.
// For balls (space/problem.hpp) the block of the Delassus operator that belongs to U_t is a multiple of the identity,
//     W_n = 1/m_i + 1/m_j ,   W_t = W_n + λ_i²/I_i + λ_j²/I_j ,   W_r = W_s = 1/I_i + 1/I_j ,
// so that with ρ = 1/W one projection solves a row while the others stand. The one coupling is that a change of T turns
// the balls, and is known when the torques are projected. Of
// other bodies W_t and W_r are the largest eigenvalues of their blocks, and a projection is a step towards the row's
// solution.
//
// Units: impulses N s, moments N m s, W in 1/kg and 1/(kg m²). Signs: compression and opening positive, impulses
// positive on body j.
// Deviations from Taboada and Estrada (2009), who write the law for disks: discs for intervals, which the plane's law
// is a section of; Σ, which a disk has not.
#pragma once

#include <cmath>
#include <contact/core/projections.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::contact::space {

/// Impulses of a contact row by row; t and r are perpendicular to n.
struct Rows {
	double n = 0;
	Vector t, r;
	double s = 0;
};

inline Rows rowsOf(const Contact& c, const Impulse& p)
{
	const double n = dot(c.n, p.f), s = dot(c.n, p.m);
	return { n, p.f - n * c.n, p.m - s * c.n, s };
}
inline Impulse impulseOf(const Contact& c, const Rows& p) { return { p.n * c.n + p.t, p.s * c.n + p.r }; }

/// W of each row, or its inverse.
struct Diagonal {
	double n = 0, t = 0, r = 0, s = 0;
};

/// Nearest vector in the disc |x| ≤ threshold.
inline Vector projectDisc(const Vector& x, double threshold)
{
	const double square = dot(x, x);
	return square > threshold * threshold ? threshold / std::sqrt(square) * x : x;
}

/// As in the plane, of a contact in space.
inline double obeyNormal(const Contact& c, double n, double inverse)
{
	return contact::obeyNormal(n, inverse, c.adhesion, c.play);
}

/// h T_max, h Γ_max and h Σ_max; never negative.
inline double slidingThreshold(const Contact& c, double n) { return std::max(0.0, c.friction * (c.adhesion + n)); }
inline double rollingThreshold(const Contact& c, double n) { return std::max(0.0, c.rollingArm * (c.adhesion + n)); }
inline double twistingThreshold(const Contact& c, double n) { return std::max(0.0, c.twistingArm * (c.adhesion + n)); }

/// Moves impulses onto the four graphs' admissible sets, normal first.
inline Impulse project(const Contact& c, const Impulse& p)
{
	const Rows   q = rowsOf(c, p);
	const double n = projectNormal(q.n, c.adhesion);
	return impulseOf(
	        c,
	        { n, projectDisc(q.t, slidingThreshold(c, n)), projectDisc(q.r, rollingThreshold(c, n)),
	          projectThreshold(q.s, twistingThreshold(c, n)) });
}

/// W_n, W_t [1/kg], W_r, W_s [1/(kg m²)].
Diagonal        delassusOfAny(const Contact& c, const InverseMass& mi, const InverseMass& mj); // law.cpp
inline Diagonal delassus(const Contact& c, const InverseMass& mi, const InverseMass& mj)
{
	const auto simple = [](const InverseMass& m, const Vector& aside) {
		return m.isBall() && (m.inertia.xx == 0 || isZero(aside));
	};
	if (!simple(mi, c.asideI) || !simple(mj, c.asideJ)) return delassusOfAny(c, mi, mj);
	const double n = mi.x + mj.x, wi = mi.inertia.xx, wj = mj.inertia.xx;
	return { n, n + wi * c.leverI * c.leverI + wj * c.leverJ * c.leverJ, wi + wj, wi + wj };
}

/// Its inverse; from 1/W_n where another row has 0, 0 where W_n is.
inline Diagonal inverseDelassus(const Contact& c, const InverseMass& mi, const InverseMass& mj)
{
	const Diagonal w = delassus(c, mi, mj);
	// A row that no impulse moves may still be driven: any factor leads to its threshold.
	const double n = w.n > 0 ? 1 / w.n : 0, moment = n * c.length * c.length;
	return { n, w.t > 0 ? 1 / w.t : n, w.r > 0 ? 1 / w.r : moment, w.s > 0 ? 1 / w.s : moment };
}

/// One contact solved while all others keep their impulses, one after the other of its graphs: from the impulses `y` to
/// those returned, with the velocities of its bodies.
inline Impulse
visit(const Contact& c, const Impulse& y, const Diagonal& inverse, const InverseMass& mi, const InverseMass& mj,
      Twist& vi, Twist& vj)
{
	const Rows   from = rowsOf(c, y);
	Rows         to;
	const double opening = relativeVelocity(c, vi, vj).n + c.biasN;
	to.n                 = obeyNormal(c, from.n - inverse.n * opening, inverse.n);
	applyImpulse(c, { (to.n - from.n) * c.n, {} }, mi, mj, vi, vj);
	const Vector sliding = acrossNormal(c.n, relativeVelocity(c, vi, vj).t + c.biasT);
	to.t                 = projectDisc(from.t - inverse.t * sliding, slidingThreshold(c, to.n));
	applyImpulse(c, { to.t - from.t, {} }, mi, mj, vi, vj);
	const Vector turning  = relativeVelocity(c, vi, vj).w + c.biasW;
	const double twisting = dot(c.n, turning);
	to.r                  = projectDisc(from.r - inverse.r * (turning - twisting * c.n), rollingThreshold(c, to.n));
	to.s                  = projectThreshold(from.s - inverse.s * twisting, twistingThreshold(c, to.n));
	applyImpulse(c, { {}, to.r - from.r + (to.s - from.s) * c.n }, mi, mj, vi, vj);
	return impulseOf(c, to);
}

/// As in the plane (contact/plane/law.hpp): impulses of a contact whose relative velocity `u` is given, so that no
/// impulse changes it.
inline Impulse impulseOfGivenMotion(const Contact& c, const RelativeVelocity& u)
{
	const bool   plays = c.play > 0;
	const double lost  = plays ? u.n + c.biasN : u.n; // where the bodies touch, and
	const double free  = plays ? lost - c.play : u.n; // at the bond's length
	if (lost < 0) return {};
	const double n       = free > 0 ? 0 - c.adhesion : 0;
	const auto   against = [](const Vector& velocity, double threshold) {
                const double speed = std::sqrt(dot(velocity, velocity));
                return speed > 0 ? -threshold / speed * velocity : Vector {};
	};
	const double twisting = dot(c.n, u.w), most = twistingThreshold(c, n);
	return impulseOf(
	        c,
	        { n, against(u.t, slidingThreshold(c, n)), against(u.w - twisting * c.n, rollingThreshold(c, n)),
	          twisting > 0           ? 0 - most
	                  : twisting < 0 ? most
	                                 : 0 });
}

/// Natural map: what one contact misses of its graphs, P − proj(P − (U + b)/W), row by row and put together [N s, N m
/// s]. `u`: relative velocity without bias.
inline Impulse naturalMapDefect(const Contact& c, const Impulse& p, const RelativeVelocity& u, const Diagonal& inverse)
{
	const Rows   q       = rowsOf(c, p);
	const Vector sliding = acrossNormal(c.n, u.t + c.biasT), turning = u.w + c.biasW;
	const double twisting = dot(c.n, turning);
	const double n        = obeyNormal(c, q.n - inverse.n * (u.n + c.biasN), inverse.n);
	const Vector t        = projectDisc(q.t - inverse.t * sliding, slidingThreshold(c, q.n));
	const Vector r        = projectDisc(q.r - inverse.r * (turning - twisting * c.n), rollingThreshold(c, q.n));
	const double s        = projectThreshold(q.s - inverse.s * twisting, twistingThreshold(c, q.n));
	return impulseOf(c, { q.n - n, q.t - t, q.r - r, q.s - s });
}

/// |f|² + |m|²/ℓ² [N² s²].
inline double squareNorm(const Contact& c, const Impulse& p)
{
	return dot(p.f, p.f) + dot(p.m, p.m) / (c.length * c.length);
}

/// Whether a contact acts, or should.
inline bool acts(const Contact& c, const Impulse& p, const Impulse& defect)
{
	return dot(c.n, p.f) + c.adhesion > 0 || dot(c.n, defect.f) != 0;
}

} // namespace nonsmooth::contact::space
