#include <algorithm>
#include <contact/plane/interior_point.hpp>
#include <contact/plane/law.hpp>

namespace nonsmooth::contact {

PatchResidual residualOf(const PatchProblem& patch, const SpeedScale& scale)
{
	PatchResidual result;
	double        sum = 0, active = 0, most = 0;
	const auto    isThere = [&](std::int32_t b) { return std::size_t(b) < patch.masses.size(); };
	for (std::size_t k = 0; k < patch.contacts.size(); ++k) {
		const Contact&    c  = patch.contacts[k];
		const Impulse&    p  = patch.impulses[k];
		const InverseMass mi = isThere(c.i) ? patch.masses[c.i] : InverseMass {},
		                  mj = isThere(c.j) ? patch.masses[c.j] : InverseMass {};
		const Twist vi       = isThere(c.i) ? patch.changes[c.i] : Twist {},
		            vj       = isThere(c.j) ? patch.changes[c.j] : Twist {};
		const Impulse defect = naturalMapDefect(c, p, relativeVelocity(c, vi, vj), inverseDelassus(c, mi, mj));
		const double  share  = speedShare(c, p, defect, mi, mj, vi, vj, scale).all;
		sum += share;
		most = std::max(most, share);
		active += p.n + c.adhesion > 0 || defect.n != 0;
		result.work += std::max(massOf(mi), massOf(mj)) * missedSpeed(c, defect, mi, mj);
	}
	result.speed   = std::sqrt(sum / std::max(active, 1.0));
	result.largest = std::sqrt(most);
	return result;
}

} // namespace nonsmooth::contact
