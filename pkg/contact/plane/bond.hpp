// A cohesive bond of two bodies in the plane (Taboada and Estrada 2009, section 2.2.2, Figure 2b): marked points, zone,
// yield, break.
//
// When a bond is made, the point P of the second body that is nearest to the first is marked on both, a₁ on the first
// and a₂ on the second, with the normal n₀ seen from the first. Later, with d the displacement of P from the place it
// had on the first body, in the axes of that moment,
//     d = x₂ + q₂ a₂ q₂* − x₁ − q₁ a₁ q₁* ,   n = q₁ n₀ q₁* ,   d_n = d·n ,   d_t = n × d ,
// the bond lives while (d_n / ε_n ℓ)² + (d_t / ε_t ℓ)² < 1 and is lost for good when it leaves. All comes from
// positions and rotations. With α₁ and α₂ the angles by which the contact has gone about each body, as seen from it, it
// has slipped by s = λ₁ α₁ + λ₂ α₂ (λ: centre to contact) and turned by ψ = α₁ − α₂, whose rates are U_t and w of
// contact/plane/law.hpp; on a straight wall s = d_t − r (ψ − sin ψ). A bond that holds has no such rates: what of s and
// ψ it has not yielded is an error of position. Where bodies turn as one (rigid_clusters.hpp) it would add up, and the
// next steps take it back (contact/plane/solver.hpp), as they do with its gap. A bond at its threshold yields. In a
// step of length h with relative velocities U and impulses P (thresholds as in contact/plane/law.hpp) it yields by
//     h U_n where P_n = −h F_a and U_n > 0 ,   |h U_t| where |P_t| = μ_s (h F_a + P_n) ,   |h w| ℓ/2 where |P_r| = μ_r ℓ (h F_a + P_n) .
// The sums over the bond's life are its yield paths; what has more than 0.6 of them all names the break. In tension it
// keeps the longest gap it has had. A bond that closes freely (contact/plane/law.hpp) has in such a step the gap g of
// its bodies and the length L that it keeps, which it may not leave:
//     b_n = max(g, 0) / h ,   p = max(L, g) / h .
// It yields by h (U_n + b_n − p) in tension, and as always across. A bond made at touch has L = 0 and is as any other.
// That the bodies draw together is no damage: d_n < 0 counts as 0. Opened up to L again it is what it was, since no
// force has done work in between.
// Sign: d_n > 0 where the bodies have parted, d_t > 0 where the second has gone counter-clockwise about the first.
// Units: m, s, N s. The first body is the wall, or that of lower id. Deviation from the paper: none; the 0.6 is ours,
// the paper tells no modes of mixed breaks.
#pragma once

#include <contact/plane/law.hpp>
#include <contact/plane/motion.hpp>

namespace nonsmooth::contact::plane {

/// Points and normal as seen from their bodies.
struct BondMarks {
	Point first, second; // P in the frame of each body [m]
	Point normal; // in that of the first
};

/// Half-axes of the zone [m].
struct BondEllipse {
	double normal, tangential; // ε_n ℓ, ε_t ℓ
};

struct BondDisplacement {
	double normal, tangential; // [m]
};

struct YieldPath {
	double tension = 0, shear = 0, torque = 0; // [m]
	bool   any() const { return tension != 0 || shear != 0 || torque != 0; }
	void   add(const YieldPath& other)
	{
		tension += other.tension;
		shear += other.shear;
		torque += other.torque;
	}
};

/// How a bond ended; None while it lives.
enum class BreakMode { None = 0, Tension, Shear, Torque, Mixed };

/// Marks a bond; `normal` from the first body to the second, `secondRadius` of the second body, which is a disk [m].
inline BondMarks markBond(const Motion& first, const Motion& second, const Point& normal, double secondRadius)
{
	const Point &x1 = first.position, &x2 = second.position;
	const Point  p { x2.x - secondRadius * normal.x, x2.y - secondRadius * normal.y };
	return { rotateBack(first.rotation, { p.x - x1.x, p.y - x1.y }),
		 rotateBack(second.rotation, { p.x - x2.x, p.y - x2.y }), rotateBack(first.rotation, normal) };
}

inline BondDisplacement bondDisplacement(const BondMarks& marks, const Motion& first, const Motion& second)
{
	const Point a1 = rotate(first.rotation, marks.first), a2 = rotate(second.rotation, marks.second),
	            n   = rotate(first.rotation, marks.normal);
	const double dx = second.position.x + a2.x - first.position.x - a1.x,
	             dy = second.position.y + a2.y - first.position.y - a1.y;
	return { dx * n.x + dy * n.y, n.x * dy - n.y * dx };
}

/// How far the bodies of a bond have gone about each other since it was made.
struct BondStrain {
	double slip; // slid along the tangent [m]; rate U_t
	double turn; // of the second against the first [rad]; rate w
};

/// Arc sine to the fifth order: angles in a bond are small.
inline double smallAngle(double sine) { return sine * (1 + sine * sine / 6); }

/// That of two disks; `normal` now, from the first to the second, with what lies along it from each centre to the
/// contact, and the second's radius [m].
inline BondStrain bondStrain(
        const BondMarks& marks, const Motion& first, const Motion& second, const Point& normal, double leverFirst,
        double leverSecond, double secondRadius)
{
	const Point  n = rotate(first.rotation, marks.normal), a2 = rotate(second.rotation, marks.second);
	const double aboutFirst  = smallAngle(n.x * normal.y - n.y * normal.x),
	             aboutSecond = smallAngle((a2.y * normal.x - a2.x * normal.y) / secondRadius);
	return { leverFirst * aboutFirst + leverSecond * aboutSecond, aboutFirst - aboutSecond };
}

/// What of a bond's strain it has not yielded: its error of position. `rest`: what it has yielded, which follows where
/// it slid or rolled in the step before.
inline BondStrain unyielded(const BondStrain& strain, bool slid, bool rolled, BondStrain& rest)
{
	if (slid) rest.slip = strain.slip;
	if (rolled) rest.turn = strain.turn;
	return { strain.slip - rest.slip, strain.turn - rest.turn };
}

/// What counts of a displacement where a bond closes freely.
inline BondDisplacement ofClosing(const BondDisplacement& d) { return { std::max(d.normal, 0.0), d.tangential }; }

/// Whether a bond is inside its zone.
inline bool bondLives(const BondDisplacement& d, const BondEllipse& zone)
{
	// most are well inside, which is told without divisions
	if (std::abs(d.normal) <= 0.5 * zone.normal && std::abs(d.tangential) <= 0.5 * zone.tangential) return true;
	const double n = d.normal / zone.normal, t = d.tangential / zone.tangential;
	return !(n * n + t * t >= 1);
}

/// The gap [m] that a bond keeps which is made over `gap`, negative where the bodies overlap.
inline double firstRestGap(double gap) { return std::max(gap, 0.0); }

/// That of a bond which yielded in tension in the step before and now spans `gap` [m].
inline double grownRestGap(double restGap, double gap) { return std::max(restGap, gap); }

/// Gives a bond of that length L that closes freely its play in a step of length h [s], over `gap` [m].
inline void setPlay(Contact& c, double restGap, double gap, double h)
{
	if (!(restGap > 0)) return;
	c.biasN = firstRestGap(gap) / h;
	c.play  = grownRestGap(restGap, gap) / h;
}

/// How fast a bond opens beyond its length [m/s].
inline double openingOf(const Contact& c, const RelativeVelocity& u)
{
	return c.play > 0 ? u.n + c.biasN - c.play : u.n;
}

/// A threshold counts as reached at this share of it.
constexpr double reached = 1 - 1e-9;

/// Whether a bond with impulses p and velocities u at the end of the step has reached its tensile threshold and opens:
/// it keeps its new length.
inline bool yieldsInTension(const Contact& c, const Impulse& p, const RelativeVelocity& u)
{
	return c.adhesion > 0 && p.n <= -reached * c.adhesion && openingOf(c, u) > 0;
}

/// Whether it slides, and whether it rolls.
inline bool yieldsInShear(const Contact& c, const Impulse& p)
{
	return std::abs(p.t) >= reached * slidingThreshold(c, p.n);
}
inline bool yieldsInTorque(const Contact& c, const Impulse& p)
{
	return std::abs(p.r) >= reached * rollingThreshold(c, p.n);
}

/// By how much a bond yields in a step of length h [s].
inline YieldPath yieldOfStep(const Contact& c, const Impulse& p, const RelativeVelocity& u, double h)
{
	YieldPath y;
	if (yieldsInTension(c, p, u)) y.tension = std::max(0.0, h * openingOf(c, u));
	if (yieldsInShear(c, p)) y.shear = std::abs(h * u.t);
	if (yieldsInTorque(c, p)) y.torque = std::abs(h * u.r) * 0.5 * c.length;
	return y;
}

/// How a bond that has left its zone was broken.
inline BreakMode breakMode(const YieldPath& path)
{
	constexpr double clear = 0.6; // of the whole path, for one mode to name the break
	const double     bound = clear * (path.tension + (path.shear + path.torque));
	if (!(bound > 0)) return BreakMode::Mixed;
	if (path.tension > bound) return BreakMode::Tension;
	if (path.shear > bound) return BreakMode::Shear;
	return path.torque > bound ? BreakMode::Torque : BreakMode::Mixed;
}

} // namespace nonsmooth::contact::plane
