// The plane's formulas and Eigen's in space, of which YADE's integrator, its geometry of spheres and our bonds of walls are made: the same bits for a million inputs
// each, zeros of both signs, numbers near the ends of the range and exact turns among them. Compiled without Eigen's vectorisation, as YADE is.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <contact/plane/bond.hpp>
#include <contact/plane/disk_contact.hpp>
#include <contact/plane/motion.hpp>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <random>
#include <string>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::plane;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr int    inputs = 1000000;
constexpr double height = 0.37; // of the plane above z = 0, which must not matter

/// Half of all numbers.
constexpr std::array<double, 18> odd {
	0.0,    -0.0,    1.0,    -1.0,    0.5,    -0.5,  2.0,  -3.0,   1.4142135623730951,
	5e-324, -5e-324, 1e-310, -1e-170, 1e-160, 1e-17, 1e17, -1e150, 1e200
};

class Inputs {
public:
	/// From the table or between −most and most.
	double number(double most = 10) { return bits() % 2 ? spread(most) : odd[bits() % odd.size()]; }
	double spread(double most) { return most * (2 * double(bits() >> 11) * 0x1p-53 - 1); }
	double positive() { return 0.01 + std::abs(spread(10)); }
	Point  point(double most = 10) { return { number(most), number(most) }; }
	/// Any, a whole number of half turns, or next to none.
	Rotation rotation()
	{
		switch (bits() % 4) {
			case 0: return exact[bits() % exact.size()];
			case 1: return { 1e-9 * spread(1), 1 };
			default: {
				const double half = spread(4);
				return { std::sin(half), std::cos(half) };
			}
		}
	}
	Motion   motion() { return { point(), rotation(), { number(), number(), number(bits() % 8 ? 10 : 1e4) } }; }
	unsigned blocked() { return bits() % 4 ? 0 : unsigned(bits() % 64); }
	std::uint64_t bits() { return engine(); }

private:
	static constexpr std::array<Rotation, 8> exact { Rotation { 0, 1 }, { -0.0, 1 }, { 0, -1 },   { -0.0, -1 },
		                                         { 1, 0 },          { -1, 0 },   { 1, -0.0 }, { -1, -0.0 } };
	std::mt19937_64                          engine { 20091 };
};

bool same(double a, double b)
{
	return std::memcmp(&a, &b, sizeof a) == 0
	        || (std::isnan(a) && std::isnan(b)); // the bits of what is no number mean nothing
}
/// The same but for the sign of a zero, where nothing is made of it but sums and squares.
bool sameNumber(double a, double b) { return same(a, b) || (a == 0 && b == 0); }
bool same(const Point& a, const Vector3d& b) { return same(a.x, b[0]) && same(a.y, b[1]); }

Vector3d    space(const Point& p) { return Vector3d(p.x, p.y, 0); }
Quaterniond space(const Rotation& q) { return Quaterniond(q.w, 0, 0, q.z); }

/// YADE's State as far as it moves.
struct State {
	Vector3d    pos, vel, angVel;
	Quaterniond ori;

	explicit State(const Motion& m)
	        : pos(m.position.x, m.position.y, height)
	        , vel(m.velocity.x, m.velocity.y, 0)
	        , angVel(0, 0, m.velocity.w)
	        , ori(space(m.rotation))
	{
	}
	/// Empty where it is the same as m, else what is not.
	std::string difference(const Motion& m) const
	{
		const double ours[]  = { m.position.x, m.position.y, m.rotation.z, m.rotation.w,
			                 m.velocity.x, m.velocity.y, m.velocity.w };
		const double its[]   = { pos[0], pos[1], ori.z(), ori.w(), vel[0], vel[1], angVel[2] };
		const char*  names[] = { "x", "y", "qz", "qw", "vx", "vy", "w" };
		for (int k = 0; k < 7; ++k)
			if (!same(ours[k], its[k]))
				return std::string(names[k]) + " is " + std::to_string(ours[k]) + " and in space "
				        + std::to_string(its[k]);
		return "";
	}
};

TEST(PlaneBits, AStepIsThatOfNewtonIntegrator)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		Motion         m = in.motion();
		State          s(m);
		const Twist    force { in.number(1e3), in.number(1e3), in.number(1e3) };
		const Point    gravity = in.bits() % 2 ? Point { 0, -9.81 } : in.point();
		const double   mass = in.positive(), inertia = in.positive(), h = 1e-3 * in.positive();
		const unsigned blocked = in.blocked() | 4 | 8 | 16; // in the plane
		// as it stands in YADE, without damping
		if (blocked != 63) {
			const Vector3d f(force.x, force.y, 0), t(0, 0, force.w), g(gravity.x, gravity.y, 0);
			Vector3d       a = Vector3d::Zero(), w = Vector3d::Zero();
			for (int i = 0; i < 3; ++i) {
				if (!(blocked & 1u << i)) a[i] += f[i] / mass + g[i];
				if (!(blocked & 8u << i)) w[i] += t[i] / inertia;
			}
			s.vel += h * a;
			s.angVel += h * w;
		}
		s.pos += s.vel * h;
		const double square = s.angVel.squaredNorm();
		if (square != 0) {
			const double speed = std::sqrt(square);
			s.ori              = Quaterniond(AngleAxisd(speed * h, s.angVel / speed)) * s.ori;
		}
		s.ori.normalize();
		integrate(m, force, mass, inertia, blocked, gravity, h);
		ASSERT_EQ(s.difference(m), "") << "input " << k;
	}
}

TEST(PlaneBits, ADisplacementIsThatOfTheSeam)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		Motion m = in.motion();
		State  s(m);
		Twist  d { in.number(0.1), in.number(0.1), in.number(0.1) };
		if (0.5 * d.w == 0) d.w = 0; // no angle
		if (d.x != 0 || d.y != 0 || d.w != 0) {
			s.pos += Vector3d(d.x, d.y, 0);
			if (d.w != 0) s.ori = (Quaterniond(AngleAxisd(d.w, Vector3d::UnitZ())) * s.ori).normalized();
		}
		displace(m, d);
		ASSERT_EQ(s.difference(m), "") << "input " << k;
	}
}

TEST(PlaneBits, VectorsTurnAsEigensDo)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		const Rotation q     = in.rotation();
		const Point    v     = in.point();
		const Vector3d there = space(q) * space(v);
		const Point    ours  = rotate(q, v);
		ASSERT_TRUE(sameNumber(ours.x, there[0]) && sameNumber(ours.y, there[1]))
		        << q.z << " " << q.w << " " << v.x << " " << v.y;
		ASSERT_TRUE(same(rotateBack(q, v), space(q).conjugate() * space(v)))
		        << q.z << " " << q.w << " " << v.x << " " << v.y;
	}
}

TEST(PlaneBits, AContactOfDisksIsThatOfSpheres)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		const Point    p1 = in.point(), p2 = in.point();
		const double   r1 = in.positive(), r2 = in.positive(), dz = in.bits() % 4 ? 0 : in.number(1e-6);
		const Vector3d x1(p1.x, p1.y, 0), x2(p2.x, p2.y, dz);
		Vector3d       normal = x2 - x1;
		const double   norm   = normal.norm();
		normal /= norm;
		const double      overlap = r1 + r2 - norm;
		const Vector3d    point   = x1 + (r1 - 0.5 * overlap) * normal;
		const DiskContact c       = dz == 0 ? diskContact(p1, p2, r1, r2) : diskContact(p1, p2, r1, r2, dz);
		ASSERT_TRUE(same({ c.nx, c.ny }, normal)) << "input " << k;
		ASSERT_TRUE(same(c.distance, norm)) << "input " << k;
		ASSERT_TRUE(same(c.gap, -overlap)) << "input " << k;
		ASSERT_TRUE(same(c.point, point)) << "input " << k;
	}
}

TEST(PlaneBits, ABondIsMarkedAndFollowedAsInSpace)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		const Motion first = in.motion(), second = in.motion();
		const State  s1(first), s2(second);
		const double angle  = in.spread(4);
		const Point  normal = in.bits() % 4 ? Point { std::cos(angle), std::sin(angle) }
		                                    : Point { in.number(1), in.number(1) };
		const double radius = in.positive();

		const Vector3d n = space(normal), point = s2.pos - radius * n;
		const Vector3d anchor1 = s1.ori.conjugate() * (point - s1.pos),
		               anchor2 = s2.ori.conjugate() * (point - s2.pos), axis = s1.ori.conjugate() * n;
		const BondMarks marks = markBond(first, second, normal, radius);
		ASSERT_TRUE(same(marks.first, anchor1) && same(marks.second, anchor2) && same(marks.normal, axis))
		        << "input " << k;

		const Motion           later1 = in.motion(), later2 = in.motion();
		const State            l1(later1), l2(later2);
		const Vector3d         d = l2.pos + l2.ori * anchor2 - l1.pos - l1.ori * anchor1, axes = l1.ori * axis;
		const BondDisplacement moved = bondDisplacement(marks, later1, later2);
		const double           dn = d.dot(axes), dt = axes[0] * d[1] - axes[1] * d[0];
		ASSERT_TRUE(sameNumber(moved.normal, dn) && sameNumber(moved.tangential, dt)) << "input " << k;
	}
}

TEST(PlaneBits, ABreakIsNamedAsBySumAndLargestOfAVector)
{
	Inputs in;
	for (int k = 0; k < inputs; ++k) {
		const Vector3d path(
		        std::abs(in.number(1)), std::abs(in.number(1)), std::abs(in.number(in.bits() % 2 ? 1 : 4)));
		const double sum  = path.sum();
		BreakMode    mode = BreakMode::Mixed;
		if (sum > 0) {
			int          most;
			const double largest = path.maxCoeff(&most);
			if (largest > 0.6 * sum) mode = static_cast<BreakMode>(int(BreakMode::Tension) + most);
		}
		ASSERT_EQ(breakMode({ path[0], path[1], path[2] }), mode) << "input " << k;
	}
}

} // namespace
