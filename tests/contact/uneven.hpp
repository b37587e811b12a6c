// Problems with masses far apart, and an independent reference for them.
#pragma once

#include "problems.hpp"
#include <array>
#include <contact/plane/law.hpp>
#include <random>

namespace nonsmooth::contact::testing {

/// The disk weighs so many times as much; its shape stays.
inline void makeHeavier(Problem& p, std::size_t disk, double ratio)
{
	InverseMass& m = p.inverseMass[disk];
	m              = { m.x / ratio, m.y / ratio, m.w / ratio };
}

/// Disks of 1 m on a floor, one above the other, from the lowest up; `ratios`: of their masses to the first that has 1.
inline Problem column(const std::vector<double>& ratios)
{
	std::vector<Disk> disks;
	for (std::size_t k = 0; k < ratios.size(); ++k)
		disks.push_back({ 0, 0.5 + double(k), 0.5 });
	Scene scene(disks);
	scene.touchDisks(1e-9);
	scene.wall(0, 0, 0, 1, 1e-9);
	for (std::size_t k = 0; k < ratios.size(); ++k)
		makeHeavier(scene.problem, k, ratios[k]);
	return scene.problem;
}

inline std::vector<double> heavyOn(int light, double ratio)
{
	std::vector<double> ratios(light, 1);
	ratios.push_back(ratio);
	return ratios;
}

/// Rows of pebbles between two walls, wider than the boulder on them, which is so many times as large.
struct OnPebbles {
	Problem     problem;
	std::size_t boulder;
	double      weight; // impulse of all weights in a step [N s]
};
inline OnPebbles onPebbles(double sizes, int rows, double friction = 0.3)
{
	const double      large = 0.5, small = large / sizes;
	const int         columns = std::max(6, int(1.3 * sizes));
	std::vector<Disk> disks;
	for (int b = 0; b < rows; ++b)
		for (int a = 0; a < columns - b % 2; ++a)
			disks.push_back({ (2 * a + 1 + b % 2) * small, (1 + b * std::sqrt(3.0)) * small, small });
	const double middle = columns * small;
	double       y      = 0;
	for (const Disk& d : disks)
		if (std::abs(d.x - middle) < large + d.r)
			y = std::max(
			        y, d.y + std::sqrt((large + d.r) * (large + d.r) - (d.x - middle) * (d.x - middle)));
	disks.push_back({ middle, y, large });
	Scene scene(disks);
	scene.friction = friction;
	scene.rolling  = 0;
	scene.touchDisks(0.1 * small);
	for (const auto& [x, nx, ny] : { std::array { 0.0, 0.0, 1.0 }, { 0.0, 1.0, 0.0 }, { 2 * middle, -1.0, 0.0 } })
		scene.wall(x, 0, nx, ny, 0.1 * small);
	return { scene.problem, disks.size() - 1, scene.weightImpulse() };
}

/// Impulse that the walls give upwards.
inline double carried(const Problem& p)
{
	double sum = 0;
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		const Contact& c = p.contacts[k];
		if (p.inverseMass[c.i].isFixed()) sum += c.ny * p.impulses[k].n + c.nx * p.impulses[k].t;
		if (p.inverseMass[c.j].isFixed()) sum -= c.ny * p.impulses[k].n + c.nx * p.impulses[k].t;
	}
	return sum;
}

/// Plain Gauss-Seidel with nothing of the solver but the formulas of one contact, and in long doubles: velocities of the bodies after so many sweeps from zero.
/// Contacts of disks and walls, without bias along the tangent.
inline std::vector<Twist> plainReference(const Problem& p, int sweeps)
{
	using Real = long double;
	struct Motion {
		Real x, y, w;
	};
	std::vector<Motion>              v;
	std::vector<std::array<Real, 3>> impulse(p.contactCount());
	for (const Twist& f : p.freeVelocity)
		v.push_back({ f.x, f.y, f.w });
	for (int sweep = 0; sweep < sweeps; ++sweep)
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			const Contact&     c  = p.contacts[k];
			const InverseMass &mi = p.inverseMass[c.i], &mj = p.inverseMass[c.j];
			Motion &           a = v[c.i], &b = v[c.j];
			const Real         nx = c.nx, ny = c.ny, mass = Real(mi.x) + mj.x;
			const auto         push = [&](Real n, Real t, Real r) {
                                const Real fx = nx * n - ny * t, fy = ny * n + nx * t;
                                a.x -= mi.x * fx, a.y -= mi.y * fy, a.w -= mi.w * (c.leverTi * t + r);
                                b.x += mj.x * fx, b.y += mj.y * fy, b.w += mj.w * (c.leverTj * t + r);
			};
			auto&      old = impulse[k];
			const Real n   = std::max<Real>(
                                old[0] - (nx * (b.x - a.x) + ny * (b.y - a.y) + c.biasN) / mass, -c.adhesion);
			push(n - old[0], 0, 0);
			const Real pressed = c.adhesion + n, most = c.friction * pressed, arm = c.rollingArm * pressed;
			const Real wt = mass + mi.w * c.leverTi * c.leverTi + mj.w * c.leverTj * c.leverTj,
			           wr = Real(mi.w) + mj.w;
			const Real ut = nx * (b.y - a.y) - ny * (b.x - a.x) + c.leverTj * b.w - c.leverTi * a.w;
			const Real t  = std::clamp<Real>(old[1] - ut / wt, -most, most);
			push(0, t - old[1], 0);
			const Real r = wr > 0 ? std::clamp<Real>(old[2] - (b.w - a.w) / wr, -arm, arm) : 0;
			push(0, 0, r - old[2]);
			old = { n, t, r };
		}
	std::vector<Twist> result;
	for (const Motion& m : v)
		result.push_back({ double(m.x), double(m.y), double(m.w) });
	return result;
}

/// Largest speed, or difference of two, beside g h.
inline double worstSpeed(const std::vector<Twist>& v, const std::vector<Twist>& other = {})
{
	double most = 0;
	for (std::size_t b = 0; b < v.size(); ++b) {
		const Twist from = other.empty() ? Twist {} : other[b];
		most             = std::max({ most, std::abs(v[b].x - from.x), std::abs(v[b].y - from.y) });
	}
	return most / (gravity * step);
}

} // namespace nonsmooth::contact::testing
