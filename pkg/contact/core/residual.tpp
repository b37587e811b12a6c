// Residuals of whole problems, for the dimension that includes it (residual.cpp, space/residual.cpp): law and shares of
// the dimension are found by its types.
#pragma once

#include <contact/core/residual.hpp>
#include <cstdint>
#include <vector>

namespace nonsmooth::contact::residuals {

template <class Problem> auto velocitiesIn(const Problem& problem)
{
	auto v = problem.freeVelocity;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const auto& c = problem.contacts[k];
		applyImpulse(
		        c, problem.impulses[k], problem.inverseMass[c.i], problem.inverseMass[c.j], v[c.i], v[c.j]);
	}
	return v;
}

template <class Problem> auto defectsIn(const Problem& problem)
{
	const auto v       = velocitiesIn(problem);
	auto       defects = problem.impulses;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const auto& c = problem.contacts[k];
		defects[k]    = naturalMapDefect(
		           c, problem.impulses[k], relativeVelocity(c, v[c.i], v[c.j]),
		           inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]));
	}
	return defects;
}

/// As the solver has it.
template <class Problem, class Twists> SpeedScale scaleIn(const Problem& problem, const Twists& velocities)
{
	double square = 0, count = 0;
	for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
		if (problem.inverseMass[b].isFixed()) continue;
		square += squaredSpeed(difference(velocities[b], problem.freeVelocity[b]));
		++count;
	}
	return { roundedShare<double>(), count > 0 ? square / count : 0,
		 leastSquaredSpeed<double>(fastest(problem.freeVelocity)) };
}

template <class Problem, class Defects> std::vector<SpeedShare> sharesIn(const Problem& problem, const Defects& defects)
{
	const auto              v     = velocitiesIn(problem);
	const SpeedScale        scale = scaleIn(problem, v);
	std::vector<SpeedShare> shares;
	shares.reserve(defects.size());
	const auto change = [&](std::int32_t b) { return difference(v[b], problem.freeVelocity[b]); };
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const auto& c = problem.contacts[k];
		shares.push_back(speedShare(
		        c, problem.impulses[k], defects[k], problem.inverseMass[c.i], problem.inverseMass[c.j],
		        change(c.i), change(c.j), scale));
	}
	return shares;
}

template <class Problem> Residual residualIn(const Problem& problem)
{
	const auto   defects = defectsIn(problem);
	const auto   shares  = sharesIn(problem, defects);
	ResidualSums sums;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const auto& c = problem.contacts[k];
		const auto& p = problem.impulses[k];
		sums.addSquares(squareNorm(c, defects[k]), squareNorm(c, p));
		sums.addShare(shares[k], acts(c, p, defects[k]));
	}
	return sums.residual(defects.size());
}

/// Of what each contact misses, `square`(contact, defect, inverse) being the square of it as a speed.
template <class Problem, class Square> SpeedResidual speedsIn(const Problem& problem, Square square)
{
	const auto defects = defectsIn(problem);
	double     sum = 0, largest = 0;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const auto&  c   = problem.contacts[k];
		const double one = square(
		        c, defects[k], inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]));
		sum += one;
		largest = std::max(largest, one);
	}
	return { std::sqrt(sum / std::max<std::size_t>(defects.size(), 1)), std::sqrt(largest) };
}

} // namespace nonsmooth::contact::residuals
