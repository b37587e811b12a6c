// Vectors and symmetric tensors of the world, as the law in space needs them.
#pragma once

namespace nonsmooth::contact::space {

struct Vector {
	double x = 0, y = 0, z = 0;
};

[[gnu::always_inline]] inline Vector operator+(const Vector& a, const Vector& b)
{
	return { a.x + b.x, a.y + b.y, a.z + b.z };
}
inline Vector operator-(const Vector& a, const Vector& b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }
inline Vector operator*(double s, const Vector& a) { return { s * a.x, s * a.y, s * a.z }; }
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[gnu::always_inline]] inline Vector cross(const Vector& a, const Vector& b)
{
	return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
inline bool isZero(const Vector& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/// A symmetric tensor; of a sphere a multiple of the identity.
struct Symmetric {
	double xx = 0, yy = 0, zz = 0, yz = 0, zx = 0, xy = 0;

	static Symmetric multiple(double s) { return { s, s, s, 0, 0, 0 }; }
	bool             isMultiple() const { return xx == yy && yy == zz && yz == 0 && zx == 0 && xy == 0; }
	bool             isZero() const { return xx == 0 && isMultiple(); }
};

inline Vector operator*(const Symmetric& s, const Vector& a)
{
	return { s.xx * a.x + s.xy * a.y + s.zx * a.z, s.xy * a.x + s.yy * a.y + s.yz * a.z,
		 s.zx * a.x + s.yz * a.y + s.zz * a.z };
}

} // namespace nonsmooth::contact::space
