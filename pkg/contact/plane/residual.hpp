// The residual of the plane's problems; what it is made of stands in core/residual.hpp.
#pragma once

#include <contact/core/residual.hpp>
#include <contact/plane/problem.hpp>
#include <vector>

namespace nonsmooth::contact {

double fastest(const std::vector<Twist>& velocities);

/// V² of a contact that misses `defect` [m²/s²].
double missedSpeed(const Contact& c, const Impulse& defect, const InverseMass& mi, const InverseMass& mj);

/// Whether a contact acts, or should.
inline bool acts(const Contact& c, const Impulse& p, const Impulse& defect)
{
	return p.n + c.adhesion > 0 || defect.n != 0;
}
/// That of a contact with the impulses `p` that misses `defect`; `vi`, `vj`: what impulses have changed of its bodies'
/// velocities.
SpeedShare speedShare(
        const Contact& c, const Impulse& p, const Impulse& defect, const InverseMass& mi, const InverseMass& mj,
        const Twist& vi, const Twist& vj, const SpeedScale& scale);

/// freeVelocity + M⁻¹ Hᵀ P, the velocities that belong to problem.impulses. Serial, in the contacts' order.
std::vector<Twist> velocitiesOf(const Problem& problem);

/// What each contact of problem.impulses misses: P − proj(P − (U + b)/W), row by row [N s, N s, N m s].
std::vector<Impulse> naturalMapDefects(const Problem& problem);

/// The same distance as velocities, W (P − proj(P − (U + b)/W)) [m/s; rolling: times ℓ]: how far the relative
/// velocities are from the graphs.
SpeedResidual naturalMapSpeeds(const Problem& problem);

/// Of every contact of problem.impulses.
std::vector<SpeedShare> speedShares(const Problem& problem);

/// Residual of problem.impulses with the velocities that follow from them (nothing of a solver's own state is used).
Residual naturalMapResidual(const Problem& problem);

} // namespace nonsmooth::contact
