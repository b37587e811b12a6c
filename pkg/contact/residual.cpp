#include <cmath>
#include <contact/law.hpp>
#include <contact/residual.hpp>

namespace nonsmooth::contact {

std::vector<Twist> velocitiesOf(const Problem& problem)
{
	std::vector<Twist> v = problem.freeVelocity;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const Contact& c = problem.contacts[k];
		applyImpulse(
		        c, problem.impulses[k], problem.inverseMass[c.i], problem.inverseMass[c.j], v[c.i], v[c.j]);
	}
	return v;
}

std::vector<Impulse> naturalMapDefects(const Problem& problem)
{
	const auto           v = velocitiesOf(problem);
	std::vector<Impulse> defects;
	defects.reserve(problem.contactCount());
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const Contact& c = problem.contacts[k];
		defects.push_back(naturalMapDefect(
		        c, problem.impulses[k], relativeVelocity(c, v[c.i], v[c.j]),
		        inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j])));
	}
	return defects;
}

SpeedResidual naturalMapSpeeds(const Problem& problem)
{
	const auto defects = naturalMapDefects(problem);
	double     sum = 0, largest = 0;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const Contact& c     = problem.contacts[k];
		const Impulse  w     = inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]);
		const auto     speed = [](double defect, double inverse) { return inverse > 0 ? defect / inverse : 0; };
		const double   n = speed(defects[k].n, w.n), t = speed(defects[k].t, w.t),
		             r      = speed(defects[k].r, w.r) * c.length;
		const double square = n * n + t * t + r * r;
		sum += square;
		largest = std::max(largest, square);
	}
	return { std::sqrt(sum / std::max<std::size_t>(defects.size(), 1)), std::sqrt(largest) };
}

Residual naturalMapResidual(const Problem& problem)
{
	const auto defects = naturalMapDefects(problem);
	double     sum = 0, scale = 0, largest = 0;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const double square = squareNorm(problem.contacts[k], defects[k]);
		sum += square;
		largest = std::max(largest, square);
		scale += squareNorm(problem.contacts[k], problem.impulses[k]);
	}
	const double count = std::max<std::size_t>(defects.size(), 1);
	return { std::sqrt(sum / count), std::sqrt(largest), std::sqrt(scale / count) };
}

} // namespace nonsmooth::contact
