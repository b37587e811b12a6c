#include <algorithm>
#include <cmath>
#include <contact/sweep_order.hpp>

namespace nonsmooth::contact {

namespace {

	constexpr std::size_t contactsAStrip = 512; // wanted: a strip's rows and bodies stay in a second-level cache

	/// Strip of every contact and how many strips there are.
	struct Strips {
		std::vector<std::int32_t> of;
		std::int32_t              count = 1;
	};

	Strips strips(const Problem& problem)
	{
		Strips result;
		result.of.assign(problem.contactCount(), 0);
		if (problem.positions.size() != problem.bodyCount() || problem.contactCount() < 2 * contactsAStrip) return result;
		const auto movable = [&](std::int32_t b) { return !problem.inverseMass[b].isFixed(); };

		double low[2] = { HUGE_VAL, HUGE_VAL }, high[2] = { -HUGE_VAL, -HUGE_VAL }, longest[2] = { 0, 0 };
		for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
			if (problem.inverseMass[b].isFixed()) continue;
			const double x[2] = { problem.positions[b].x, problem.positions[b].y };
			for (int a = 0; a < 2; ++a) {
				low[a]  = std::min(low[a], x[a]);
				high[a] = std::max(high[a], x[a]);
			}
		}
		const int  axis = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
		const auto at   = [&](std::int32_t b) { return axis == 0 ? problem.positions[b].x : problem.positions[b].y; };
		for (const Contact& c : problem.contacts)
			if (movable(c.i) && movable(c.j)) longest[axis] = std::max(longest[axis], std::abs(at(c.i) - at(c.j)));
		const double extent = high[axis] - low[axis];
		if (!(extent > 0)) return result;
		const double most = std::min(double(problem.contactCount() / contactsAStrip), std::floor(extent / (longest[axis] * 1.000001 + 1e-300)));
		if (!(most >= 2)) return result;
		result.count       = static_cast<std::int32_t>(most);
		const double scale = result.count / extent;
		const auto   strip = [&](std::int32_t b) { return std::min(result.count - 1, static_cast<std::int32_t>((at(b) - low[axis]) * scale)); };
		for (std::size_t k = 0; k < problem.contactCount(); ++k) {
			const Contact& c = problem.contacts[k];
			result.of[k]     = !movable(c.i) ? (movable(c.j) ? strip(c.j) : 0) : (!movable(c.j) ? strip(c.i) : std::min(strip(c.i), strip(c.j)));
		}
		return result;
	}

} // namespace

std::vector<std::uint8_t> coloursOf(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverseMass)
{
	constexpr int              last = 63;
	std::vector<std::uint64_t> used(inverseMass.size(), 0);
	std::vector<std::uint8_t>  colours(contacts.size());
	for (std::size_t k = 0; k < contacts.size(); ++k) {
		const Contact& c     = contacts[k];
		const bool     moveI = !inverseMass[c.i].isFixed(), moveJ = !inverseMass[c.j].isFixed();
		const auto     taken = (moveI ? used[c.i] : 0) | (moveJ ? used[c.j] : 0);
		const int      best  = ~taken == 0 ? last : __builtin_ctzll(~taken);
		const auto     bit   = std::uint64_t(1) << best;
		if (moveI) used[c.i] |= bit;
		if (moveJ) used[c.j] |= bit;
		colours[k] = static_cast<std::uint8_t>(best);
	}
	return colours;
}

SweepOrder arrange(const Problem& problem)
{
	const Strips s       = strips(problem);
	const auto   colours = coloursOf(problem.contacts, problem.inverseMass);
	SweepOrder   result;
	result.evenStrips = (s.count + 1) / 2;

	// counting sort by (place of the strip, colour); stable, so the contacts' own order decides the rest
	const auto place = [&](std::int32_t strip) { return strip % 2 == 0 ? strip / 2 : static_cast<std::int32_t>(result.evenStrips) + strip / 2; };
	constexpr std::size_t    colourCount = 64;
	std::vector<std::size_t> next(colourCount * s.count + 1, 0);
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		++next[place(s.of[k]) * colourCount + colours[k] + 1];
	for (std::size_t k = 1; k < next.size(); ++k)
		next[k] += next[k - 1];
	for (std::int32_t k = 0; k <= s.count; ++k)
		result.stripBegin.push_back(next[k * colourCount]);
	result.order.resize(problem.contactCount());
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		result.order[next[place(s.of[k]) * colourCount + colours[k]]++] = static_cast<std::int32_t>(k);
	return result;
}

} // namespace nonsmooth::contact
