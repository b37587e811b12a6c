#include <algorithm>
#include <contact/core/active_strips.hpp>

namespace nonsmooth::contact {

void ActiveStrips::reset(const std::vector<std::size_t>& begin_, std::size_t evenStrips_)
{
	begin                    = begin_;
	evenStrips               = evenStrips_;
	const std::size_t strips = begin.size() < 2 ? 0 : begin.size() - 2;
	active.assign(strips, true);
	resting.assign(strips, false);
	anyRests = false;
	weigh();
}

bool ActiveStrips::choose(const std::vector<ResidualSums>& sums, double ResidualSums::*part)
{
	constexpr double share
	        = 0.005; // η; with a tenth more rests, but late in a solve the residual comes back from where it rested
	double all = 0;
	for (std::size_t s = 0; s < active.size(); ++s)
		all += sums[s].*part;
	const double bound   = share * all / std::max<std::size_t>(active.size(), 1);
	bool         changed = false;
	anyRests             = false;
	for (std::size_t s = 0; s < active.size(); ++s) {
		const bool now = !(sums[s].*part <= bound); // what is no number does not rest
		changed        = changed || now != bool(active[s]);
		resting[s]     = active[s] && !now;
		anyRests       = anyRests || resting[s];
		active[s]      = now;
	}
	if (changed) weigh();
	return changed;
}

bool ActiveStrips::wakeAll()
{
	const bool changed = std::find(active.begin(), active.end(), false) != active.end();
	std::fill(active.begin(), active.end(), true);
	std::fill(resting.begin(), resting.end(), false);
	anyRests = false;
	if (changed) weigh();
	return changed;
}

bool ActiveStrips::moves(std::size_t even) const
{
	const std::size_t before = evenStrips + even - 1, after = evenStrips + even; // odd strips
	return active[even] || (even > 0 && active[before]) || (after < active.size() && active[after]);
}

bool ActiveStrips::changes(std::size_t place) const
{
	if (isActive(place)) return true;
	if (place < evenStrips) return moves(place);
	const std::size_t before = place - evenStrips, after = before + 1; // even strips
	return active[before] || (after < evenStrips && active[after]);
}

/// A strip that rests costs a look at its bodies and at its residual.
void ActiveStrips::weigh()
{
	constexpr std::size_t dozing = 16; // contacts at rest that cost as much as an active one
	count                        = 0;
	workBegin.assign(begin.size(), 0);
	for (std::size_t s = 0; s + 1 < begin.size(); ++s) {
		const std::size_t contacts = begin[s + 1] - begin[s];
		workBegin[s + 1]           = workBegin[s] + (isActive(s) ? contacts : contacts / dozing);
		if (isActive(s)) count += contacts;
	}
}

} // namespace nonsmooth::contact
