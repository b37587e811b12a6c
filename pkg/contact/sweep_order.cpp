#include <algorithm>
#include <cmath>
#include <contact/sweep_order.hpp>

namespace nonsmooth::contact {

namespace {

	constexpr std::size_t contactsAStrip = 512; // wanted: a strip's rows and bodies stay in a second-level cache

	/// Strip of every contact and of every body (-1: it cannot move); returns how many strips there are.
	std::int32_t cut(const Problem& problem, std::vector<std::int32_t>& of, std::vector<std::int32_t>& ofBody)
	{
		of.assign(problem.contactCount(), 0);
		ofBody.resize(problem.bodyCount());
		for (std::size_t b = 0; b < problem.bodyCount(); ++b)
			ofBody[b] = problem.inverseMass[b].isFixed() ? -1 : 0;
		if (problem.positions.size() != problem.bodyCount() || problem.contactCount() < 2 * contactsAStrip) return 1;
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
		if (!(extent > 0)) return 1;
		const double most = std::min(double(problem.contactCount() / contactsAStrip), std::floor(extent / (longest[axis] * 1.000001 + 1e-300)));
		if (!(most >= 2)) return 1;
		const auto   count = static_cast<std::int32_t>(most);
		const double scale = count / extent;
		const auto   strip = [&](std::int32_t b) { return std::min(count - 1, static_cast<std::int32_t>((at(b) - low[axis]) * scale)); };
		for (std::size_t b = 0; b < problem.bodyCount(); ++b)
			if (ofBody[b] >= 0) ofBody[b] = strip(static_cast<std::int32_t>(b));
		for (std::size_t k = 0; k < problem.contactCount(); ++k) {
			const Contact&     c = problem.contacts[k];
			const std::int32_t i = ofBody[c.i], j = ofBody[c.j];
			of[k]                = i < 0 ? std::max(j, 0) : (j < 0 ? i : std::min(i, j));
		}
		return count;
	}

} // namespace

void colour(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverseMass, std::vector<std::uint8_t>& colours, std::vector<std::uint64_t>& used)
{
	constexpr int last = 63;
	used.assign(inverseMass.size(), 0);
	colours.resize(contacts.size());
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
}

void arrange(const Problem& problem, SweepOrder& result)
{
	auto& [stripOf, stripOfBody, colours, used, next] = result.scratch;
	const std::int32_t count                         = cut(problem, stripOf, stripOfBody);
	colour(problem.contacts, problem.inverseMass, colours, used);
	const std::size_t even = (count + 1) / 2;
	result.evenStrips      = even;

	// counting sort by (place of the strip, colour); stable, so the contacts' own order decides the rest
	const auto place = [even](std::int32_t strip) { return strip % 2 == 0 ? strip / 2 : static_cast<std::int32_t>(even) + strip / 2; };
	constexpr std::size_t colourCount = 64;
	next.assign(colourCount * count + 1, 0);
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		++next[place(stripOf[k]) * colourCount + colours[k] + 1];
	for (std::size_t k = 1; k < next.size(); ++k)
		next[k] += next[k - 1];
	result.stripBegin.clear();
	for (std::int32_t k = 0; k <= count; ++k)
		result.stripBegin.push_back(next[k * colourCount]);
	result.order.resize(problem.contactCount());
	for (std::size_t k = 0; k < problem.contactCount(); ++k)
		result.order[next[place(stripOf[k]) * colourCount + colours[k]]++] = static_cast<std::int32_t>(k);

	result.bodyBegin.assign(count + 1, 0);
	for (const std::int32_t strip : stripOfBody)
		if (strip >= 0) ++result.bodyBegin[strip + 1];
	for (std::int32_t k = 0; k < count; ++k)
		result.bodyBegin[k + 1] += result.bodyBegin[k];
	next.assign(result.bodyBegin.begin(), result.bodyBegin.end());
	result.bodies.resize(problem.bodyCount());
	for (std::size_t b = 0; b < problem.bodyCount(); ++b)
		result.bodies[stripOfBody[b] >= 0 ? next[stripOfBody[b]]++ : next[count]++] = static_cast<std::int32_t>(b);
}

} // namespace nonsmooth::contact
