// The contact problem in the contacts' own coordinates, u = W p + q, as solvers of other people want it.
//
// Built from the contacts' frames and levers alone, on purpose without the functions that our solver uses (relativeVelocity,
// applyImpulse, inverseDelassus): an error in those would then show as a disagreement.
#pragma once

#include <contact/plane/problem.hpp>
#include <cstddef>
#include <vector>

namespace nonsmooth::oracle {

/// u = W p + q with W = H M⁻¹ Hᵀ in square blocks of `size` rows a contact: 2 (normal, tangential) or 3 (and rolling).
///
/// Rows are in a scaled form: P = D p v₀ and u = D (U + b)/v₀ with D = 1/√(diagonal of H M⁻¹ Hᵀ), so the diagonal of W is 1, and
/// v₀ such that q is 1 in rms. Scaling by a diagonal keeps the law: thresholds |T| ≤ μ N become |p_t| ≤ (μ D_n/D_t) p_n.
/// Cohesion is shifted away: p stands for (N + h F_a, T, Γ) ≥ 0, and q holds what the shift takes, −W (h F_a, 0, 0).
struct Delassus {
	int                      size = 3;
	std::vector<std::size_t> begin; // of each contact's row of blocks, and the end of the last
	std::vector<std::size_t> column; // contact of each block, ascending within a row
	std::vector<double>      blocks; // size² numbers each, column by column
	std::vector<double>      q, friction, rolling; // size, 1 and 1 a contact; thresholds in scaled units

	std::size_t contactCount() const { return friction.size(); }
	/// Impulses [N s, N s, N m s] that belong to scaled ones; without rolling rows that impulse is 0.
	std::vector<contact::Impulse> impulses(const contact::Problem& problem, const std::vector<double>& p) const;
	/// The other way round.
	std::vector<double>
	scaled(const contact::Problem& problem, const std::vector<contact::Impulse>& impulses) const;

	std::vector<double> scale; // D, one a row
	double              speed = 1; // v₀
};

/// Throws std::invalid_argument where a contact names a body that is not there.
Delassus delassus(const contact::Problem& problem, bool withRolling);

/// v_free + M⁻¹ Hᵀ P.
std::vector<contact::Twist> velocities(const contact::Problem& problem, const std::vector<contact::Impulse>& impulses);

} // namespace nonsmooth::oracle
