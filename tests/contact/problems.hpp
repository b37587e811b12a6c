// Contact problems that several tests share, made of disks by the same formulas as the engine's seam.
#pragma once

#include <cmath>
#include <contact/plane/problem.hpp>
#include <contact/plane/solver.hpp>
#include <cstring>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>

namespace nonsmooth::contact::testing {

constexpr double pi = 3.14159265358979323846, gravity = 9.81, step = 5e-3;

template <class T> bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
	return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

struct Disk {
	double x, y, r;
};

/// Disks and half-planes in a step of gravity. Disks first, then the walls (fixed).
class Scene {
public:
	double friction = 0.3, rolling = 0.1, density = 2500;
	double relaxationRate = 0.2; // share of an overlap taken back in the step

	explicit Scene(std::vector<Disk> disks_)
	        : disks(std::move(disks_))
	{
		for (const Disk& d : disks) {
			problem.inverseMass.push_back({ 1 / mass(d), 1 / mass(d), 2 / (mass(d) * d.r * d.r) });
			problem.freeVelocity.push_back({ 0, -gravity * step, 0 });
			problem.positions.push_back({ d.x, d.y });
		}
	}

	double mass(const Disk& d) const { return density * pi * d.r * d.r; }
	double weightImpulse() const
	{
		double sum = 0;
		for (const Disk& d : disks)
			sum += mass(d) * gravity * step;
		return sum;
	}

	/// All pairs with a gap below `alert` [m], found on a grid.
	void touchDisks(double alert)
	{
		double largest = 0;
		for (const Disk& d : disks)
			largest = std::max(largest, d.r);
		const double                                      cell = 2 * largest + alert;
		std::map<std::pair<long, long>, std::vector<int>> grid;
		const auto                                        at = [cell](const Disk& d) {
                        return std::pair<long, long>(std::floor(d.x / cell), std::floor(d.y / cell));
		};
		for (std::size_t k = 0; k < disks.size(); ++k) {
			const auto here = at(disks[k]);
			for (long a = -1; a <= 1; ++a)
				for (long b = -1; b <= 1; ++b)
					if (const auto found = grid.find({ here.first + a, here.second + b });
					    found != grid.end())
						for (const int other : found->second)
							pair(other, static_cast<int>(k), alert);
			grid[here].push_back(static_cast<int>(k));
		}
	}

	/// A half-plane through (px, py) with the inward normal (nx, ny); returns its body.
	int wall(double px, double py, double nx, double ny, double alert)
	{
		const int body = static_cast<int>(problem.inverseMass.size());
		problem.inverseMass.push_back({});
		problem.freeVelocity.push_back({});
		problem.positions.push_back({ px, py });
		for (std::size_t k = 0; k < disks.size(); ++k) {
			const Disk&  d   = disks[k];
			const double gap = (d.x - px) * nx + (d.y - py) * ny - d.r;
			if (gap >= alert) continue;
			Contact c = base(body, static_cast<int>(k), nx, ny, gap, 2 * d.r);
			c.leverTj = -(d.r + 0.5 * gap);
			add(c);
		}
		return body;
	}

	std::vector<Disk> disks;
	Problem           problem;

private:
	void pair(int i, int j, double alert)
	{
		const Disk & a = disks[i], &b = disks[j];
		const double dx = b.x - a.x, dy = b.y - a.y, distance = std::hypot(dx, dy), gap = distance - a.r - b.r;
		if (gap >= alert) return;
		Contact c = base(i, j, dx / distance, dy / distance, gap, a.r + b.r);
		c.leverTi = a.r + 0.5 * gap;
		c.leverTj = -(b.r + 0.5 * gap);
		add(c);
	}

	Contact base(int i, int j, double nx, double ny, double gap, double length) const
	{
		Contact c;
		c.i          = i;
		c.j          = j;
		c.nx         = nx;
		c.ny         = ny;
		c.biasN      = gap > 0 ? gap / step : relaxationRate * gap / step;
		c.friction   = friction;
		c.rollingArm = rolling * length;
		c.length     = length;
		return c;
	}

	void add(const Contact& c)
	{
		problem.contacts.push_back(c);
		problem.impulses.emplace_back();
	}
};

/// `columns` × `rows` disks of slightly different radii on a triangular lattice above a floor; some contacts open, some overlapping.
inline Scene lattice(int columns, int rows)
{
	std::mt19937                           random(7);
	std::uniform_real_distribution<double> radius(0.49, 0.502);
	std::vector<Disk>                      disks;
	for (int b = 0; b < rows; ++b)
		for (int a = 0; a < columns; ++a)
			disks.push_back({ a + 0.5 * (b % 2), 0.5 + b * std::sqrt(0.75), radius(random) });
	Scene scene(std::move(disks));
	scene.touchDisks(0.03);
	scene.wall(0, 0, 0, 1, 0.03);
	return scene;
}

/// The same below a platen as wide as it, which moves down only: one body, with the disks of the uppermost layer.
inline Problem underPlaten(int columns, int rows)
{
	const Scene  scene = lattice(columns, rows);
	Problem      p     = scene.problem;
	const auto   body  = static_cast<std::int32_t>(p.bodyCount());
	const double mass = 2 * scene.density * columns, x = 0.5 * columns,
	             y = 0.5 + (rows - 1) * std::sqrt(0.75) + 0.5; // 2 m of rock
	p.inverseMass.push_back({ 0, 1 / mass, 0 });
	p.freeVelocity.push_back({ 0, -gravity * step, 0 });
	p.positions.push_back({ x, y });
	for (std::size_t k = scene.disks.size() - columns; k < scene.disks.size(); ++k) {
		const Disk& d = scene.disks[k];
		Contact     c;
		c.i          = body;
		c.j          = static_cast<std::int32_t>(k);
		c.nx         = 0;
		c.ny         = -1;
		c.leverNi    = x - d.x;
		c.leverTj    = -d.r;
		c.friction   = scene.friction;
		c.rollingArm = scene.rolling * 2 * d.r;
		c.length     = 2 * d.r;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	}
	return p;
}

/// A packing in which some contacts do not fit into blocks: a body that is heavier in y, a lever along the normal, a tangential bias.
inline Problem mixedLattice()
{
	Problem p = lattice(60, 20).problem;
	p.inverseMass[100].y *= 0.5;
	p.contacts[500].leverNj = 0.01;
	p.contacts[900].biasT   = 0.02;
	return p;
}

} // namespace nonsmooth::contact::testing
