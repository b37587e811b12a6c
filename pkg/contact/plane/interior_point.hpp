// A few hundred contacts solved at once, whatever the ratio of masses: a primal-dual interior point method.
//
// With P̂ = P_n + F_a, thresholds T = μ_s P̂ and Γ = μ_r ℓ P̂, and slacks that are never negative, the three graphs of
// law.hpp are the equations
//     U_n + b_n = w ,   U_t + b_t = λ₋ − λ₊ ,   U_r + b_r = κ₋ − κ₊
//     P̂ w = 0 ,   (T ∓ P_t) λ± = 0 ,   (Γ ∓ P_r) κ± = 0
// and for a bond with the play p (law.hpp), with P_n = a − b, two more of them along the normal:
//     p − (U_n + b_n) = z₁ − z₂ ,   a w = 0 ,   b z₁ = 0 ,   (F_a − b) z₂ = 0    in the place of   P̂ w = 0 ,
// in which the products are put to a τ > 0 that is led to 0, Newton's step being taken as far as all stay positive
// (Mehrotra 1992, with his prediction and correction). The slacks are eliminated contact by contact, dP = α − G dU with
// a triangular G of three by three, and what is left has as many unknowns as bodies have velocities:
//     (M + Hᵀ G H) dv = Hᵀ α − (M Δv − Hᵀ ΔP)
// Products are weighted with the contact's 1/W, so that the units of neither masses nor lengths matter. Where pressure
// and speed give next to no resistance, a part regularisation of W is added, so that a packing with more contacts than
// it needs has one answer.
//
// Coulomb's friction is no gradient, so nothing proves convergence. The caller takes what came nearest, if it is better
// than what was there.
#pragma once

#include <algorithm>
#include <contact/plane/bordered_band.hpp>
#include <contact/plane/problem.hpp>
#include <contact/plane/residual.hpp>

namespace nonsmooth::contact {

/// Bodies and contacts of a patch; contacts name bodies by their places in it, and by bodies.size() what cannot move.
struct PatchProblem {
	std::vector<InverseMass> masses;
	std::vector<Twist>
	        changes; // what all impulses, also those of contacts outside, have changed of the free velocities
	std::vector<Contact> contacts; // with the free velocities' part in the biases; W_nn > 0
	std::vector<Impulse> impulses;
	std::size_t          hubs = 0, width = 0; // of mass_jumps.hpp
};

/// The mass of a body along the axis along which it is lightest; 0 of one that cannot move.
inline double massOf(const InverseMass& m)
{
	const double least = std::max(m.x, m.y);
	return least > 0 ? 1 / least : 0;
}

/// How far a patch is from its solution.
struct PatchResidual {
	double speed   = 0; // rms ϑ over its contacts that act (residual.hpp)
	double largest = 0; // the largest ϑ
	double work    = 0; // Σ max(m_i, m_j) V² [J], which no light body hides from
};

/// With the velocities that follow from its impulses.
PatchResidual residualOf(const PatchProblem& patch, const SpeedScale& scale);

/// Changes impulses and velocities to the nearest that the method found to a solution, until the largest ϑ is below
/// `tolerance`; returns whether that is nearer than what was there.
bool solvePatch(PatchProblem& patch, double tolerance, const SpeedScale& scale);

} // namespace nonsmooth::contact
