#include <cmath>
#include <contact/law.hpp>
#include <contact/residual.hpp>

namespace nonsmooth::contact {

std::vector<Twist> velocitiesOf(const Problem& problem)
{
	std::vector<Twist> v = problem.freeVelocity;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const Contact& c = problem.contacts[k];
		applyImpulse(c, problem.impulses[k], problem.inverseMass[c.i], problem.inverseMass[c.j], v[c.i], v[c.j]);
	}
	return v;
}

Residual naturalMapResidual(const Problem& problem)
{
	const auto v = velocitiesOf(problem);
	double     sum = 0, scale = 0, largest = 0;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const Contact& c = problem.contacts[k];
		const Impulse& p = problem.impulses[k];
		const Impulse  u = relativeVelocity(c, v[c.i], v[c.j]);
		const Impulse  w = inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]);
		const double   square = naturalMapSquare(c, p, u, w);
		sum += square;
		largest = std::max(largest, square);
		scale += p.n * p.n + p.t * p.t + p.r * p.r / (c.length * c.length);
	}
	const double count = std::max<std::size_t>(problem.contactCount(), 1);
	return { std::sqrt(sum / count), std::sqrt(largest), std::sqrt(scale / count) };
}

} // namespace nonsmooth::contact
