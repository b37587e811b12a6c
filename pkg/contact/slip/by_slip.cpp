#include "by_slip.hpp"
#include <algorithm>
#include <stdexcept>

namespace nonsmooth::contact::slip {

BySlip::BySlip(double friction_, double weakened_)
        : friction(friction_)
        , weakened(weakened_)
{
	if (!(friction >= 0 && weakened >= 0))
		throw std::invalid_argument("friction must be 0 or more, before and after weakening");
}

double BySlip::left(double slip) const
{
	double share = 1;
	left(&slip, &share, 1);
	return share;
}

void BySlip::strength(Cells& cells, Range range) const
{
	const std::size_t count = range.end - range.begin;
	double* const     share = cells.strength.data() + range.begin; // first the share, then the strength
	left(cells.slip.data() + range.begin, share, count);
	for (std::size_t k = 0; k < count; ++k) {
		const double f = friction > weakened ? weakened + (friction - weakened) * share[k] : friction;
		share[k]       = f * std::max(cells.normalStress[range.begin + k], 0.0);
	}
}

double positiveCriticalSlip(double critical)
{
	if (!(critical > 0))
		throw std::invalid_argument("criticalSlip = " + std::to_string(critical) + " m: it must be positive");
	return critical;
}

} // namespace nonsmooth::contact::slip
