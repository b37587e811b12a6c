// How far bodies have moved since a list of theirs was made: a bound, which costs nothing, and exactly where that does
// not tell.
#pragma once

#include <cmath>
#include <limits>
#include <packing/body.hpp>
#include <vector>

namespace nonsmooth::packing {

class Travel {
public:
	/// From here on; before the first time bodies have moved any distance.
	void begin(const std::vector<Body>& bodies, int threads)
	{
		places.resize(bodies.size());
		const int count = int(bodies.size());
#pragma omp parallel for num_threads(threads) schedule(static)
		for (int k = 0; k < count; ++k)
			places[k] = { bodies[k].x, bodies[k].y };
		bound = 0;
	}
	/// For the bound alone, without `furthest`.
	void begin() { bound = 0; }
	void end() { bound = std::numeric_limits<double>::infinity(); }
	/// All have moved by `distance` [m] at most.
	void add(double distance) { bound += distance; }
	/// No body has moved farther [m].
	double atMost() const { return bound; }
	/// The largest value that of(dx² + dy², k) has for a body, dx and dy [m] from where it was.
	template <class Of> double furthest(const std::vector<Body>& bodies, int threads, Of of) const
	{
		double    found = 0;
		const int count = int(bodies.size());
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : found)
		for (int k = 0; k < count; ++k) {
			const double dx = bodies[k].x - places[k].x, dy = bodies[k].y - places[k].y;
			found = std::max(found, of(dx * dx + dy * dy, k));
		}
		return found;
	}
	/// It is known now.
	void tighten(double distance) { bound = distance; }

private:
	std::vector<Vector> places;
	double              bound = std::numeric_limits<double>::infinity();
};

} // namespace nonsmooth::packing
