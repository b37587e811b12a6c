// What a contact can bear in a step: the thresholds of the law in contact/plane/law.hpp from the strengths of the
// contact (Taboada and Estrada 2009, section 2.2).
//
//     bonded         F_a, μ_s, μ_r ℓ of the bond
//     touching       the residual ones: g ≤ r ℓ, with g the gap and r the range of adhesion
//     neither        residual μ_s and μ_r ℓ, F_a = 0
// Symbols: F_a = σ ℓ tensile force [N], μ_s friction, μ_r ℓ rolling arm [m], ℓ length of the contact [m]. All are
// positive or 0. What two materials agree on (Strengths) has no length in it: many contacts of different disks share
// it.
#pragma once

#include <tuple>

namespace nonsmooth::contact::plane {

/// Strengths of a contact, and what of them is in force.
struct Thresholds {
	double adhesion   = 0; // F_a [N]
	double friction   = 0; // μ_s
	double rollingArm = 0; // μ_r ℓ [m]
};

/// What contacts of two materials can bear, whatever their length.
struct Strengths {
	double tension = 0, residualTension = 0; // σ [Pa]
	double friction = 0, residualFriction = 0; // μ_s
	double rolling = 0, residualRolling = 0; // μ_r
	double restitution   = 0; // e
	double ellipseNormal = 0, ellipseTangential = 0; // ε_n, ε_t [ℓ]
	double creationDistance = 0; // Δ [ℓ]
	bool   bondable         = false;
	bool   closes           = false; // bonds over a gap close freely, see bond.hpp

	Thresholds ofBond(double length) const { return { length * tension, friction, length * rolling }; }
	Thresholds residual(double length) const
	{
		return { length * residualTension, residualFriction, length * residualRolling };
	}
	bool operator==(const Strengths& other) const
	{
		const auto all = [](const Strengths& s) {
			return std::tie(
			        s.tension, s.residualTension, s.friction, s.residualFriction, s.rolling,
			        s.residualRolling, s.restitution, s.ellipseNormal, s.ellipseTangential,
			        s.creationDistance, s.bondable, s.closes);
		};
		return all(*this) == all(other);
	}
};

/// Whether a contact of that gap and length [m] counts as touching; `range` in units of the length.
inline bool touches(double gap, double range, double length) { return gap <= range * length; }

/// The thresholds in force.
inline Thresholds thresholdsOf(const Thresholds& bond, const Thresholds& residual, bool bonded, bool touching)
{
	if (bonded) return bond;
	return { touching ? residual.adhesion : 0, residual.friction, residual.rollingArm };
}

} // namespace nonsmooth::contact::plane
