#include <cmath>
#include <contact/plane/law.hpp>
#include <contact/core/residual.tpp>
#include <contact/plane/residual.hpp>
#include <utility>

namespace nonsmooth::contact {

std::vector<Twist>      velocitiesOf(const Problem& problem) { return residuals::velocitiesIn(problem); }
std::vector<Impulse>    naturalMapDefects(const Problem& problem) { return residuals::defectsIn(problem); }
Residual                naturalMapResidual(const Problem& problem) { return residuals::residualIn(problem); }
std::vector<SpeedShare> speedShares(const Problem& problem)
{
	return residuals::sharesIn(problem, residuals::defectsIn(problem));
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
		const Diagonal w = delassus(c, mi, mj);
		const double   n = w.n * defect.n, t = w.t * defect.t, r = (c.leverTi - c.leverTj) * (w.r * defect.r);
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
	return residuals::speedsIn(problem, [](const Contact& c, const Impulse& defect, const Diagonal& w) {
		const auto   speed = [](double defect, double inverse) { return inverse > 0 ? defect / inverse : 0; };
		const double n = speed(defect.n, w.n), t = speed(defect.t, w.t), r = speed(defect.r, w.r) * c.length;
		return n * n + t * t + r * r;
	});
}

} // namespace nonsmooth::contact
