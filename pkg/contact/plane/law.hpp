// The cohesive contact law of Taboada and Estrada (2009), section 2.2.1, as one projection.
//
// Equations (paper), with N, T, Γ the normal force, shear force and torque and U^n, U^t, w the relative velocities:
//     Signorini with tension   (1)  U^n = 0, N ≥ −F_a   or   U^n > 0, N = −F_a ,      (2)  F_a = σ_ext ℓ
//     Coulomb                  (3)  T opposes U^t, |T| ≤ T_max ,                      (4)  T_max = μ_s (F_a + N)
//     rolling                  (5)  Γ opposes w,   |Γ| ≤ Γ_max ,                      (6)  Γ_max = μ_r ℓ (F_a + N)
// Time-discrete form (Moreau-Jean, implicit): forces become impulses over the step, thresholds are multiplied by h,
// and each velocity is shifted by a bias b:
//     N-graph:  0 ≤ (U^n + b_n)  ⟂  (N + F_a) ≥ 0 ,   T- and Γ-graphs in U^t + b_t and w + b_r .
//   open gap g > 0        b_n = g / h        the gap may close, not more
//   overlap or bond       b_n = 0            errors of position are taken back by displacements, see solver.hpp
//   impact                b_n = e U^n_before Newton's restitution
//                         impacts that follow from impacts in the same step are taken before: impact_sequence.hpp
// A bond of length L > 0 that closes freely bears tension at this length and compression where its bodies touch.
// Between the two it has play:
//     U^n + b_n = 0 and N ≥ 0 ,   0 < U^n + b_n < p and N = 0 ,   U^n + b_n = p and −F_a ≤ N ≤ 0 ,   U^n + b_n > p and N = −F_a ,
//     p = L / h the play, b_n = g / h. T_max and Γ_max as above with this N: those of N = 0 while it has play.
// It is a maximal monotone graph, too, that of −∂ψ with ψ(N) = p max(−N, 0) on N ≥ −F_a, and p = 0 gives (1).
// Each graph "x ∈ K, −u ∈ N_K(x)" is the fixed point x = proj_K(x − ρ u) for every ρ > 0; the residual of a solution is
// the distance from that fixed point with ρ the inverse diagonal of the Delassus operator (natural map).
// Sign: compression and opening positive, impulses positive on body j. Deviation from the paper: none in the graphs;
// the biases are the discretisation's.
#pragma once

#include <algorithm>
#include <contact/core/projections.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

/// The same of a contact.
inline double obeyNormal(const Contact& c, double n, double inverse)
{
	return obeyNormal(n, inverse, c.adhesion, c.play);
}

/// T_max h, eq (4); never negative.
inline double slidingThreshold(const Contact& c, double n) { return std::max(0.0, c.friction * (c.adhesion + n)); }

/// Γ_max h, eq (6); never negative.
inline double rollingThreshold(const Contact& c, double n) { return std::max(0.0, c.rollingArm * (c.adhesion + n)); }

/// Moves impulses onto the three graphs' admissible sets, normal first.
inline Impulse project(const Contact& c, const Impulse& p)
{
	const double n = projectNormal(p.n, c.adhesion);
	return { n, projectThreshold(p.t, slidingThreshold(c, n)), projectThreshold(p.r, rollingThreshold(c, n)) };
}

/// Diagonal of the Delassus operator at one contact: W_nn, W_tt [1/kg], W_rr [1/(kg m²)].
inline Diagonal delassus(const Contact& c, const InverseMass& mi, const InverseMass& mj)
{
	const double x = mi.x + mj.x, y = mi.y + mj.y;
	return { c.nx * c.nx * x + c.ny * c.ny * y + mi.w * c.leverNi * c.leverNi + mj.w * c.leverNj * c.leverNj,
		 c.ny * c.ny * x + c.nx * c.nx * y + mi.w * c.leverTi * c.leverTi + mj.w * c.leverTj * c.leverTj,
		 mi.w + mj.w };
}

/// Its inverse: 1/W_nn, 1/W_tt, 1/W_rr; from 1/W_nn where W_tt or W_rr is 0, 0 where W_nn is.
inline Diagonal inverseDelassus(const Contact& c, const InverseMass& mi, const InverseMass& mj)
{
	const auto [wn, wt, wr] = delassus(c, mi, mj);
	// A row that no impulse moves may still be driven (a wall drawn under a disk that is held): any factor leads to
	// its threshold.
	const double n = wn > 0 ? 1 / wn : 0;
	return { n, wt > 0 ? 1 / wt : n, wr > 0 ? 1 / wr : n * c.length * c.length };
}

/// One contact solved while all others keep their impulses, one after the other of its three graphs: from the impulses
/// `y` to those returned, with the velocities of its bodies.
inline Impulse
visit(const Contact& c, const Impulse& y, const Diagonal& inverse, const InverseMass& mi, const InverseMass& mj,
      Twist& vi, Twist& vj)
{
	const double n = obeyNormal(c, y.n - inverse.n * (relativeVelocity(c, vi, vj).n + c.biasN), inverse.n);
	applyImpulse(c, { n - y.n, 0, 0 }, mi, mj, vi, vj);
	const double t = projectThreshold(
	        y.t - inverse.t * (relativeVelocity(c, vi, vj).t + c.biasT), slidingThreshold(c, n));
	applyImpulse(c, { 0, t - y.t, 0 }, mi, mj, vi, vj);
	const double r = projectThreshold(
	        y.r - inverse.r * (relativeVelocity(c, vi, vj).r + c.biasR), rollingThreshold(c, n));
	applyImpulse(c, { 0, 0, r - y.r }, mi, mj, vi, vj);
	return { n, t, r };
}

/// Impulses of a contact whose relative velocities `u` are given, so that no impulse changes them: what the graphs say,
/// and where they allow a range the least of it. It is the limit of bodies whose masses grow without end. Where the
/// bodies approach (U_n < 0, or beyond touch what has play) no finite impulse obeys the law: none.
inline Impulse impulseOfGivenMotion(const Contact& c, const RelativeVelocity& u)
{
	const bool   plays = c.play > 0;
	const double lost  = plays ? u.n + c.biasN : u.n; // where the bodies touch, and
	const double free  = plays ? lost - c.play : u.n; // at the bond's length
	if (lost < 0) return {};
	const double n       = free > 0 ? 0 - c.adhesion : 0; // and no negative zero
	const auto   against = [](double speed, double threshold) {
                return speed > 0 ? 0 - threshold : speed < 0 ? threshold : 0;
	};
	return { n, against(u.t, slidingThreshold(c, n)), against(u.r, rollingThreshold(c, n)) };
}

/// Natural map: what one contact misses of its graphs, P − proj(P − (U + b)/W), row by row [N s, N s, N m s]; with play
/// the proximal point is in the place of the nearest. `u`: relative velocity without bias; `inverse`: inverseDelassus
/// of the contact.
inline Impulse naturalMapDefect(const Contact& c, const Impulse& p, const RelativeVelocity& u, const Diagonal& inverse)
{
	return { p.n - obeyNormal(c, p.n - inverse.n * (u.n + c.biasN), inverse.n),
		 p.t - projectThreshold(p.t - inverse.t * (u.t + c.biasT), slidingThreshold(c, p.n)),
		 p.r - projectThreshold(p.r - inverse.r * (u.r + c.biasR), rollingThreshold(c, p.n)) };
}

/// n² + t² + (r/ℓ)² [N² s²].
inline double squareNorm(const Contact& c, const Impulse& p)
{
	const double r = p.r / c.length;
	return p.n * p.n + p.t * p.t + r * r;
}

} // namespace nonsmooth::contact
