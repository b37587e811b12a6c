// A cohesive bond of two bodies in space: that of the plane (contact/plane/bond.hpp) with an ellipsoid for the ellipse,
// whose third axis is the twist.
//
// When a bond is made, the point P of the second body that is nearest to the first is marked on both, with the normal
// n₀ seen from the first and the turn of the second against the first. Later, with d the displacement of P from the
// place it had on the first body, n = q₁ n₀ q₁*, and θ the rotation vector of what the second has turned since against
// the first,
//     d_n = d·n ,   d_t = |d − d_n n| ,   τ = θ·n ,
// the bond lives while (d_n / ε_n ℓ)² + (d_t / ε_t ℓ)² + (τ / ε_τ)² < 1 and is lost for good when it leaves. P lies on
// the bond's axis, so that a twist does not move it; that is why τ has an axis of its own. A roll moves P, as in the
// plane. A bond at its threshold yields. In a step of length h with relative velocities U, w and impulses P (thresholds
// as in space/law.hpp) it yields by
//     h U_n where P_n = −h F_a and U_n > 0 ,   |h U_t| where |P_t| = h T_max ,   |h w_r| ℓ/2 where |P_r| = h Γ_max ,   |h w_s| ℓ/2 where |P_s| = h Σ_max .
// The sums over the bond's life are its yield paths; what has more than 0.6 of them all names the break.
// Sign: d_n > 0 where the bodies have parted. Units: m, s, N s, rad. The first body is the wall, or that of lower id.
#pragma once

#include <cmath>
#include <contact/space/law.hpp>

namespace nonsmooth::contact::space {

struct BondDisplacement {
	double normal = 0, across = 0; // [m]
	double twist = 0; // [rad]
};

/// Half-axes of the zone: ε_n ℓ and ε_t ℓ [m], ε_τ [rad].
struct BondEllipsoid {
	double normal, tangential, twisting;
};

struct YieldPath {
	double tension = 0, shear = 0, rolling = 0, twisting = 0; // [m]

	double sum() const { return tension + (shear + (rolling + twisting)); }
};

enum class BreakMode { None = 0, Tension, Shear, Rolling, Mixed, Twisting };

/// Whether a bond is inside its zone. `closes`: that its bodies draw together is no damage.
inline bool bondLives(const BondDisplacement& d, const BondEllipsoid& zone, bool closes)
{
	const double n = (closes ? std::max(d.normal, 0.0) : d.normal) / zone.normal, t = d.across / zone.tangential,
	             s = d.twist / zone.twisting;
	return !(n * n + t * t + s * s >= 1);
}

/// A threshold counts as reached at this share of it.
constexpr double reached = 1 - 1e-9;

/// How fast a bond opens beyond its length [m/s].
inline double openingOf(const Contact& c, double normalVelocity)
{
	return c.play > 0 ? normalVelocity + c.biasN - c.play : normalVelocity;
}

/// Whether a bond with impulses p has reached its tensile threshold and opens: it keeps its new length.
inline bool yieldsInTension(const Contact& c, const Rows& p, double normalVelocity)
{
	return c.adhesion > 0 && p.n <= -reached * c.adhesion && openingOf(c, normalVelocity) > 0;
}

/// By how much a bond yields in a step of length h [s].
inline YieldPath yieldOfStep(const Contact& c, const Rows& p, const RelativeVelocity& u, double h)
{
	const auto   size     = [](const Vector& v) { return std::sqrt(dot(v, v)); };
	const double twisting = dot(c.n, u.w);
	YieldPath    y;
	if (yieldsInTension(c, p, u.n)) y.tension = std::max(0.0, h * openingOf(c, u.n));
	if (size(p.t) >= reached * slidingThreshold(c, p.n)) y.shear = h * size(u.t);
	if (size(p.r) >= reached * rollingThreshold(c, p.n))
		y.rolling = h * size(u.w - twisting * c.n) * 0.5 * c.length;
	if (std::abs(p.s) >= reached * twistingThreshold(c, p.n)) y.twisting = std::abs(h * twisting) * 0.5 * c.length;
	return y;
}

/// How a bond that has left its zone was broken.
inline BreakMode breakMode(const YieldPath& path)
{
	constexpr double clear = 0.6; // of the whole path, for one mode to name the break
	const double     bound = clear * path.sum();
	if (!(bound > 0)) return BreakMode::Mixed;
	if (path.tension > bound) return BreakMode::Tension;
	if (path.shear > bound) return BreakMode::Shear;
	if (path.rolling > bound) return BreakMode::Rolling;
	return path.twisting > bound ? BreakMode::Twisting : BreakMode::Mixed;
}

} // namespace nonsmooth::contact::space
