// Contact problems in space that several tests share, made of spheres and half-spaces by formulas of their own.
#pragma once

#include <algorithm>
#include <cmath>
#include <contact/space/solver.hpp>
#include <cstring>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace nonsmooth::contact::space::testing {

constexpr double pi = 3.14159265358979323846, gravity = 9.81, step = 5e-3;

template <class T> bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
	return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
inline Vector unit(const Vector& a) { return 1 / length(a) * a; }

struct Ball {
	Vector x;
	double r;
};

/// Spheres and half-spaces in a step of gravity, which pulls along −z. Spheres first, then the walls (fixed).
class Balls {
public:
	double friction = 0.3, rolling = 0.05, twisting = 0.05, density = 2500;

	explicit Balls(std::vector<Ball> balls_)
	        : balls(std::move(balls_))
	{
		for (const Ball& b : balls) {
			problem.inverseMass.push_back(InverseMass::ofSphere(1 / mass(b), 2.5 / (mass(b) * b.r * b.r)));
			problem.freeVelocity.push_back({ { 0, 0, -gravity * step }, {} });
			problem.positions.push_back(b.x);
		}
	}

	double mass(const Ball& b) const { return density * 4 / 3 * pi * b.r * b.r * b.r; }

	/// All pairs with a gap below `alert` [m], found on a grid.
	void touch(double alert)
	{
		double largest = 0;
		for (const Ball& b : balls)
			largest = std::max(largest, b.r);
		const double                                             cell = 2 * largest + alert;
		std::map<std::tuple<long, long, long>, std::vector<int>> grid;
		const auto at = [cell](const Vector& x, int a = 0, int b = 0, int c = 0) {
			return std::tuple<long, long, long>(
			        std::floor(x.x / cell) + a, std::floor(x.y / cell) + b, std::floor(x.z / cell) + c);
		};
		for (std::size_t k = 0; k < balls.size(); ++k) {
			for (int n = 0; n < 27; ++n)
				if (const auto found = grid.find(at(balls[k].x, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
				    found != grid.end())
					for (const int other : found->second)
						pair(other, static_cast<int>(k), alert);
			grid[at(balls[k].x)].push_back(static_cast<int>(k));
		}
	}

	/// A half-space through `point` with the inward normal n; returns its body.
	int wall(const Vector& point, const Vector& n, double alert)
	{
		const int body = static_cast<int>(problem.inverseMass.size());
		problem.inverseMass.push_back({});
		problem.freeVelocity.push_back({});
		problem.positions.push_back(point);
		for (std::size_t k = 0; k < balls.size(); ++k) {
			const Ball&  b   = balls[k];
			const double gap = dot(b.x - point, n) - b.r;
			if (gap >= alert) continue;
			Contact c = base(body, static_cast<int>(k), n, gap, 2 * b.r);
			c.leverJ  = -(b.r + 0.5 * gap);
			add(c);
		}
		return body;
	}

	std::vector<Ball> balls;
	Problem           problem;

private:
	void pair(int i, int j, double alert)
	{
		const Ball & a = balls[i], &b = balls[j];
		const Vector d   = b.x - a.x;
		const double gap = length(d) - a.r - b.r;
		if (gap >= alert) return;
		Contact c = base(i, j, unit(d), gap, a.r + b.r);
		c.leverI  = a.r + 0.5 * gap;
		c.leverJ  = -(b.r + 0.5 * gap);
		add(c);
	}

	Contact base(int i, int j, const Vector& n, double gap, double l) const
	{
		Contact c;
		c.i           = i;
		c.j           = j;
		c.n           = n;
		c.biasN       = gap > 0 ? gap / step : 0.2 * gap / step;
		c.friction    = friction;
		c.rollingArm  = rolling * l;
		c.twistingArm = twisting * l;
		c.length      = l;
		return c;
	}

	void add(const Contact& c)
	{
		problem.contacts.push_back(c);
		problem.impulses.emplace_back();
	}
};

/// `columns` × `columns` × `rows` spheres of slightly different radii, in layers that lie in each other's hollows above
/// a floor; some contacts open, some overlapping.
inline Balls lattice(int columns, int rows, double alert = 0.03)
{
	std::mt19937                           random(7);
	std::uniform_real_distribution<double> radius(0.49, 0.502);
	std::vector<Ball>                      balls;
	for (int c = 0; c < rows; ++c)
		for (int b = 0; b < columns; ++b)
			for (int a = 0; a < columns; ++a)
				balls.push_back({ { a + 0.5 * ((b + c) % 2), std::sqrt(0.75) * (b + (c % 2) / 3.0),
				                    0.5 + c * std::sqrt(2.0 / 3) },
				                  radius(random) });
	Balls scene(std::move(balls));
	scene.touch(alert);
	scene.wall({}, { 0, 0, 1 }, alert);
	return scene;
}

constexpr Method methods[] = { Method::GaussSeidel, Method::Accelerated };

/// Calls check(settings, name) for every set of kernels and the reference, with one thread and, where the solver takes
/// more, with two.
template <class Check> void forEachPath(const Problem& problem, const SolverSettings& common, Check check)
{
	for (int threads = 1; threads <= (problem.contactCount() < 1000 ? 1 : 2); ++threads) {
		SolverSettings s = common;
		s.threads        = threads;
		const auto with  = ", " + std::to_string(threads) + " thread(s)";
		for (const BlockKernels* kernels : availableKernels()) {
			s.kernels = kernels;
			check(s, kernels->name + with);
		}
		s.reference = true;
		check(s, "reference" + with);
	}
}

inline double largest(const Vector& a) { return std::max({ std::abs(a.x), std::abs(a.y), std::abs(a.z) }); }

inline double largestDifference(const std::vector<Impulse>& a, const std::vector<Impulse>& b)
{
	double most = a.size() == b.size() ? 0 : HUGE_VAL;
	for (std::size_t k = 0; k < a.size() && most < HUGE_VAL; ++k)
		most = std::max({ most, largest(a[k].f - b[k].f), largest(a[k].m - b[k].m) });
	return most;
}

inline double largestDifference(const std::vector<Twist>& a, const std::vector<Twist>& b)
{
	double most = a.size() == b.size() ? 0 : HUGE_VAL;
	for (std::size_t k = 0; k < a.size() && most < HUGE_VAL; ++k)
		most = std::max({ most, largest(a[k].v - b[k].v), largest(a[k].w - b[k].w) });
	return most;
}

} // namespace nonsmooth::contact::space::testing
