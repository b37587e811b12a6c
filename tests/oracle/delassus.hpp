// The contact problem in the contacts' own coordinates, u = W p + q, as solvers of other people want it.
#pragma once

#include "system.hpp"
#include <cstddef>
#include <vector>

namespace nonsmooth::oracle {

/// u = W p + q with W = H M⁻¹ Hᵀ in square blocks of `size` rows a contact.
///
/// Rows are in a scaled form: P = D p v₀ and u = D (U + b)/v₀ with D = 1/√(diagonal of H M⁻¹ Hᵀ), its mean over the rows of one vector, so the
/// diagonal of W is 1 (in space in the mean over a vector, and of balls everywhere), and
/// v₀ such that q is 1 in rms. Such a scaling keeps the law: thresholds |T| ≤ μ N become |p_t| ≤ (μ D_n/D_t) p_n.
/// Cohesion is shifted away: p stands for (N + h F_a, T, Γ) ≥ 0, and q holds what the shift takes, −W (h F_a, 0, 0).
struct Delassus {
	int                      dimension = 2, size = 2;
	std::vector<std::size_t> begin; // of each contact's row of blocks, and the end of the last
	std::vector<std::size_t> column; // contact of each block, ascending within a row
	std::vector<double>      blocks; // size² numbers each, column by column
	std::vector<double>      q, friction, rolling; // size, 1 and 1 a contact; thresholds in scaled units

	bool        rolls() const { return size > dimension; }
	std::size_t contactCount() const { return friction.size(); }
	/// Impulses [N s, N m s] that belong to scaled ones; without rolling rows those are 0.
	std::vector<RowValues> impulses(const System& system, const std::vector<double>& p) const;
	/// The other way round.
	std::vector<double> scaled(const System& system, const std::vector<RowValues>& impulses) const;

	std::vector<double> scale; // D, one a row
	double              speed = 1; // v₀
};

/// Throws std::invalid_argument where one component alone of a vector is driven and cannot be moved.
Delassus delassus(const System& system);

} // namespace nonsmooth::oracle
