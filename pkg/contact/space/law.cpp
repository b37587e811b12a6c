#include <contact/space/law.hpp>

namespace nonsmooth::contact::space {
namespace {

	/// Largest eigenvalue of a symmetric tensor that is not negative, in the plane across a unit vector.
	double largestAcross(const Symmetric& k, const Vector& n)
	{
		// any two directions across n will do: from the axis that is farthest from it
		const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
		const Vector axis   = x <= y && x <= z ? Vector { 1, 0, 0 }
		          : y <= z                     ? Vector { 0, 1, 0 }
		                                       : Vector { 0, 0, 1 };
		const Vector across = cross(n, axis), a = 1 / std::sqrt(dot(across, across)) * across, b = cross(n, a);
		const double aa = dot(a, k * a), bb = dot(b, k * b), ab = dot(a, k * b);
		return 0.5 * (aa + bb + std::hypot(aa - bb, 2 * ab));
	}

	/// Adds −[a]× J [a]×: what a force at the arm's end makes of the velocity there by turning a body with the
	/// inverse inertia J.
	void addTurning(Symmetric& k, const Symmetric& inverse, const Vector& arm)
	{
		const auto   at = [&](const Vector& f) { return cross(inverse * cross(arm, f), arm); };
		const Vector x = at({ 1, 0, 0 }), y = at({ 0, 1, 0 }), z = at({ 0, 0, 1 });
		k.xx += x.x;
		k.yy += y.y;
		k.zz += z.z;
		k.yz += 0.5 * (y.z + z.y);
		k.zx += 0.5 * (z.x + x.z);
		k.xy += 0.5 * (x.y + y.x);
	}

} // namespace

Diagonal delassusOfAny(const Contact& c, const InverseMass& mi, const InverseMass& mj)
{
	Symmetric point { mi.x + mj.x, mi.y + mj.y, mi.z + mj.z, 0, 0, 0 };
	addTurning(point, mi.inertia, c.leverI * c.n + c.asideI);
	addTurning(point, mj.inertia, c.leverJ * c.n + c.asideJ);
	const Symmetric &i = mi.inertia, &j = mj.inertia;
	const Symmetric  turning { i.xx + j.xx, i.yy + j.yy, i.zz + j.zz, i.yz + j.yz, i.zx + j.zx, i.xy + j.xy };
	return { dot(c.n, point * c.n), largestAcross(point, c.n), largestAcross(turning, c.n),
		 dot(c.n, turning * c.n) };
}

} // namespace nonsmooth::contact::space
