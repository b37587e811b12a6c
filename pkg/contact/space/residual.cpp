#include <algorithm>
#include <contact/core/residual.tpp>
#include <contact/space/law.hpp>
#include <contact/space/residual.hpp>

namespace nonsmooth::contact::space {

double fastest(const std::vector<Twist>& velocities)
{
	double most = 0;
	for (const Twist& v : velocities)
		most = std::max({ most, std::abs(v.v.x), std::abs(v.v.y), std::abs(v.v.z) });
	return most;
}

SpeedShare speedShare(
        const Contact& c, const Impulse& p, const Impulse& defect, const InverseMass& mi, const InverseMass& mj,
        const Twist& vi, const Twist& vj, const SpeedScale& scale)
{
	const Diagonal w   = delassus(c, mi, mj);
	const Rows     d   = rowsOf(c, defect);
	const double   arm = c.leverI - c.leverJ, n = w.n * d.n, r = w.r * w.r * dot(d.r, d.r), s = w.s * d.s;
	const double   point = n * n + w.t * w.t * dot(d.t, d.t), missed = point + arm * arm * (r + s * s);
	const auto     change = [](const Twist& v, double lever, const Vector& aside) {
                return dot(v.v, v.v) + (lever * lever + dot(aside, aside)) * dot(v.w, v.w);
	};
	const double rest = w.n * w.n * dot(p.f, p.f)
	        + (c.biasN * c.biasN + dot(c.biasT, c.biasT) + arm * arm * dot(c.biasW, c.biasW));
	const double own = std::max(change(vi, c.leverI, c.asideI), change(vj, c.leverJ, c.asideJ))
	        + scale.share * scale.share * rest + scale.mean;
	const double whole = missed + own + scale.least;
	return { missed / whole, point / whole };
}

std::vector<Twist>      velocitiesOf(const Problem& problem) { return residuals::velocitiesIn(problem); }
std::vector<Impulse>    naturalMapDefects(const Problem& problem) { return residuals::defectsIn(problem); }
Residual                naturalMapResidual(const Problem& problem) { return residuals::residualIn(problem); }
std::vector<SpeedShare> speedShares(const Problem& problem)
{
	return residuals::sharesIn(problem, residuals::defectsIn(problem));
}

SpeedResidual naturalMapSpeeds(const Problem& problem)
{
	return residuals::speedsIn(problem, [](const Contact& c, const Impulse& defect, const Diagonal& inverse) {
		const Rows d       = rowsOf(c, defect);
		const auto squared = [](double square, double inverse) {
			return inverse > 0 ? square / (inverse * inverse) : 0;
		};
		return squared(d.n * d.n, inverse.n) + squared(dot(d.t, d.t), inverse.t)
		        + c.length * c.length * (squared(dot(d.r, d.r), inverse.r) + squared(d.s * d.s, inverse.s));
	});
}

} // namespace nonsmooth::contact::space
