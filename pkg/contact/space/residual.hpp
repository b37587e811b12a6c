// The natural-map residual in space: definitions and figures are those of the plane (contact/core/residual.hpp), with
// |P_t|² in the place of P_t², and with rolling and twisting as one moment, divided by ℓ as an impulse and times the
// arm λ_i − λ_j as a speed.
#pragma once

#include <contact/core/residual.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::contact::space {

double fastest(const std::vector<Twist>& velocities);

/// As in the plane, of a contact in space.
SpeedShare speedShare(
        const Contact& c, const Impulse& p, const Impulse& defect, const InverseMass& mi, const InverseMass& mj,
        const Twist& vi, const Twist& vj, const SpeedScale& scale);

/// As in the plane: velocities that belong to problem.impulses; what contacts miss as impulses [N s, N m s], and as
/// speeds.
std::vector<Twist>      velocitiesOf(const Problem& problem);
std::vector<Impulse>    naturalMapDefects(const Problem& problem);
SpeedResidual           naturalMapSpeeds(const Problem& problem);
std::vector<SpeedShare> speedShares(const Problem& problem);
Residual                naturalMapResidual(const Problem& problem);

} // namespace nonsmooth::contact::space
