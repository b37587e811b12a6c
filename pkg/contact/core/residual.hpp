// The natural-map residual of the three threshold graphs: how far impulses and velocities are from satisfying the law,
// whatever method made them. It is measured twice over, as impulses and as speeds, since neither sees all:
//
//   D = P − proj(P − W⁻¹ (U + b))       what the impulses of a contact miss; its rms beside that of all impulses is Residual::relative().
//                                        A light body among heavy ones hardly counts in either.
//   V = W D                              the same as speeds; rolling times the arm λ_i − λ_j
//   s² = max(|Δv_i|², |Δv_j|²)           Δv: what impulses have changed of a body's free velocity, with the speed of its turning at the contact,
//                                        |Δv|² = Δv_x² + Δv_y² + (λ Δω)²; under gravity alone g h for each body that is borne
//   ϑ = V / √(V² + s²)                   share of the contact's speed that its impulses leave open: 0 solved, 1 where nothing acts yet and something should
//   ϑ_p                                  the same with the normal and tangential rows of V alone: what the contact's point leaves open
//
// ϑ does not depend on units, or on how fast everything moves together. The square of the rms of all bodies' |Δv| is
// added to s² (SpeedScale): in a packing that is pressed without being accelerated nobody's own change is known to a
// share of itself. So is what rounding leaves of W P and of b, so that one which changes no velocity at all can be
// solved.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace nonsmooth::contact {

struct Residual {
	double rms          = 0; // rms over contacts of |P − proj(P − (U+b)/W)| [N s], rolling divided by ℓ
	double largest      = 0; // its largest value [N s]
	double scale        = 0; // rms over contacts of |P| [N s]
	double speed        = 0; // rms of ϑ over contacts that act or should [-]
	double largestSpeed = 0; // largest ϑ_p [-]
	/// The figure that tolerances are given for; 0 where nothing acts and nothing should.
	double relative() const
	{
		if (!std::isfinite(rms + scale)) return HUGE_VAL; // whatever is not a number is not a solution
		return scale > 0 ? rms / scale : (rms > 0 ? 1 : 0);
	}
	/// The largest of the three figures, each over what the tolerance allows it: solved up to 1. `uneven`: masses
	/// are so far apart that impulses do not show what a light body misses; then speeds decide, and else they see
	/// to it that no body falls.
	double missed(double tolerance, bool uneven) const
	{
		if (!std::isfinite(relative() + speed)) return HUGE_VAL;
		return std::max({ relative() / tolerance, speed / meanSpeed(tolerance, uneven),
		                  largestSpeed / mostSpeed(tolerance, uneven) });
	}
	/// What a tolerance allows the rms of ϑ and the largest ϑ_p. That of a body at rest which falls beside others
	/// that do not is 0.7.
	static double meanSpeed(double tolerance, bool uneven)
	{
		return uneven ? std::clamp(100 * tolerance, 1e-4, 0.1) : 0.1;
	}
	static double mostSpeed(double tolerance, bool uneven)
	{
		return uneven ? std::clamp(1000 * tolerance, 1e-2, 0.3) : std::clamp(3000 * tolerance, 0.3, 0.6);
	}
};

/// What is added to s², see above.
struct SpeedScale {
	double share = 1e-11; // of W P and of b, not squared
	double mean  = 0; // of |Δv|² over the bodies that can move [m²/s²]
	double least = 0; // what can be told from rounding, squared [m²/s²]
};
template <class Number> constexpr double roundedShare() { return std::is_same_v<Number, float> ? 1e-4 : 1e-11; }
/// The least square that can be told from rounding, for free velocities, which are always doubles. Never 0.
template <class Number> double leastSquaredSpeed(double fastest)
{
	const double least = 1e-12 * fastest;
	return std::max<double>(least * least, std::numeric_limits<Number>::min());
}
struct SpeedShare {
	double all, point; // ϑ² and ϑ_p²
};

/// Sums over contacts that the figures are made of; parts can be added in any fixed order.
struct ResidualSums {
	double square = 0, scale = 0, largest = 0; // of squared defects and impulses, and the largest defect
	double speed = 0, largestSpeed = 0, active = 0; // of ϑ², the largest ϑ_p², and contacts that act or should

	/// Add a contact: squares of what it misses and of its impulses, and its shares of speed if it acts or should.
	void     addSquares(double defect, double impulse);
	void     addShare(const SpeedShare& share, bool acts);
	void     add(const ResidualSums& other);
	Residual residual(std::size_t contacts) const;
};

/// A residual as velocities: how far the relative velocities are from the graphs.
struct SpeedResidual {
	double rms = 0, largest = 0; // over contacts [m/s]
};

} // namespace nonsmooth::contact
