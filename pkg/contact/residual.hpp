// The natural-map residual of the three threshold graphs: how far impulses and velocities are from satisfying the law,
// whatever method made them.
#pragma once

#include <cmath>
#include <contact/problem.hpp>

namespace nonsmooth::contact {

struct Residual {
	double rms     = 0; // rms over contacts of |P − proj(P − (U+b)/W)| [N s], rolling divided by ℓ
	double largest = 0; // its largest value [N s]
	double scale   = 0; // rms over contacts of |P| [N s]
	/// The figure that tolerances are given for; 0 where nothing acts and nothing should.
	double relative() const
	{
		if (!std::isfinite(rms + scale)) return HUGE_VAL; // whatever is not a number is not a solution
		return scale > 0 ? rms / scale : (rms > 0 ? 1 : 0);
	}
};

/// freeVelocity + M⁻¹ Hᵀ P, the velocities that belong to problem.impulses. Serial, in the contacts' order.
std::vector<Twist> velocitiesOf(const Problem& problem);

/// What each contact of problem.impulses misses: P − proj(P − (U + b)/W), row by row [N s, N s, N m s].
std::vector<Impulse> naturalMapDefects(const Problem& problem);

/// The same distance as velocities, W (P − proj(P − (U + b)/W)) [m/s; rolling: times ℓ]: how far the relative velocities are from the graphs.
struct SpeedResidual {
	double rms = 0, largest = 0; // over contacts [m/s]
};
SpeedResidual naturalMapSpeeds(const Problem& problem);

/// Residual of problem.impulses with the velocities that follow from them (nothing of a solver's own state is used).
Residual naturalMapResidual(const Problem& problem);

} // namespace nonsmooth::contact
