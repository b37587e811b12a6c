#include <cmath>
#include <contact/law.hpp>
#include <contact/residual.hpp>
#include <utility>

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

double fastest(const std::vector<Twist>& velocities)
{
	double most = 0;
	for (const Twist& v : velocities)
		most = std::max({ most, std::abs(v.x), std::abs(v.y) });
	return most;
}

namespace {
	/// V² of the point, and of rolling.
	std::pair<double, double>
	missedSpeeds(const Contact& c, const Impulse& defect, const InverseMass& mi, const InverseMass& mj)
	{
		const Impulse w = delassus(c, mi, mj);
		const double  n = w.n * defect.n, t = w.t * defect.t, r = (c.leverTi - c.leverTj) * (w.r * defect.r);
		return { n * n + t * t, r * r };
	}
}

double missedSpeed(const Contact& c, const Impulse& defect, const InverseMass& mi, const InverseMass& mj)
{
	const auto [point, rolling] = missedSpeeds(c, defect, mi, mj);
	return point + rolling;
}

SpeedShare speedShare(
        const Contact& c, const Impulse& p, const Impulse& defect, const InverseMass& mi, const InverseMass& mj,
        const Twist& vi, const Twist& vj, const SpeedScale& scale)
{
	const auto [point, rolling] = missedSpeeds(c, defect, mi, mj);
	const double missed = point + rolling, wn = delassus(c, mi, mj).n;
	const auto   change = [](const Twist& v, double leverN, double leverT) {
                return v.x * v.x + v.y * v.y + (leverN * leverN + leverT * leverT) * (v.w * v.w);
	};
	const double biasR = (c.leverTi - c.leverTj) * c.biasR,
	             rest = wn * wn * (p.n * p.n + p.t * p.t) + (c.biasN * c.biasN + c.biasT * c.biasT + biasR * biasR);
	const double own  = std::max(change(vi, c.leverNi, c.leverTi), change(vj, c.leverNj, c.leverTj))
	        + scale.share * scale.share * rest + scale.mean;
	const double whole = missed + own + scale.least;
	return { missed / whole, point / whole };
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

/// As the solver has it.
SpeedScale scaleOf(const Problem& problem, const std::vector<Twist>& velocities)
{
	double square = 0, count = 0;
	for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
		if (problem.inverseMass[b].isFixed()) continue;
		const double x = velocities[b].x - problem.freeVelocity[b].x,
		             y = velocities[b].y - problem.freeVelocity[b].y;
		square += x * x + y * y;
		++count;
	}
	return { roundedShare<double>(), count > 0 ? square / count : 0,
		 leastSquaredSpeed<double>(fastest(problem.freeVelocity)) };
}

std::vector<SpeedShare> speedShares(const Problem& problem)
{
	const auto              v       = velocitiesOf(problem);
	const auto              defects = naturalMapDefects(problem);
	const SpeedScale        scale   = scaleOf(problem, v);
	std::vector<SpeedShare> shares;
	shares.reserve(defects.size());
	const auto change = [&](std::int32_t b) {
		const Twist& free = problem.freeVelocity[b];
		return Twist { v[b].x - free.x, v[b].y - free.y, v[b].w - free.w };
	};
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const Contact& c = problem.contacts[k];
		shares.push_back(speedShare(
		        c, problem.impulses[k], defects[k], problem.inverseMass[c.i], problem.inverseMass[c.j],
		        change(c.i), change(c.j), scale));
	}
	return shares;
}

void ResidualSums::addImpulses(const Contact& c, const Impulse& p, const Impulse& defect)
{
	const double one = squareNorm(c, defect);
	square += one;
	largest = std::max(largest, one);
	scale += squareNorm(c, p);
}

void ResidualSums::addSpeeds(const Contact& c, const Impulse& p, const Impulse& defect, const SpeedShare& share)
{
	speed += share.all;
	largestSpeed = std::max(largestSpeed, share.point);
	active += p.n + c.adhesion > 0 || defect.n != 0;
}

void ResidualSums::add(const ResidualSums& other)
{
	square += other.square;
	scale += other.scale;
	largest = std::max(largest, other.largest);
	speed += other.speed;
	largestSpeed = std::max(largestSpeed, other.largestSpeed);
	active += other.active;
}

Residual ResidualSums::residual(std::size_t contacts) const
{
	const double n = std::max<std::size_t>(contacts, 1);
	return { std::sqrt(square / n), std::sqrt(largest), std::sqrt(scale / n),
		 std::sqrt(speed / std::max(active, 1.0)), std::sqrt(largestSpeed) };
}

Residual naturalMapResidual(const Problem& problem)
{
	const auto   defects = naturalMapDefects(problem);
	const auto   shares  = speedShares(problem);
	ResidualSums sums;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		sums.addImpulses(problem.contacts[k], problem.impulses[k], defects[k]);
		sums.addSpeeds(problem.contacts[k], problem.impulses[k], defects[k], shares[k]);
	}
	return sums.residual(defects.size());
}

} // namespace nonsmooth::contact
