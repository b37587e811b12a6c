#include "tabulated.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& Tabulated::parameters()
{
	static const std::vector<Parameter> all {
		{ "slips", "m", "rising; one alone where friction follows the velocity only", Bound::notNegative,
		  required, endless, true },
		{ "velocities", "m/s", "rising; one alone where friction follows the slip only", Bound::positive,
		  required, endless, true },
		{ "friction_table", "-", "f_ss, by slip and then by velocity", Bound::notNegative, required, endless,
		  true },
		{ "slip_lag", "m", "L, slip in which friction follows the table; 0: at once", Bound::notNegative, 0 },
		{ "initial_friction", "-", "before slip (that of the table)", Bound::notNegative, 0 },
	};
	return all;
}

Tabulated::Tabulated(const Values& values)
        : slips(values.list(parameters(), "slips"))
        , friction(values.list(parameters(), "friction_table"))
        , lag(values.number(parameters(), "slip_lag"))
{
	const auto rising = [&](const std::string& key) {
		const auto& all  = values.list(parameters(), key);
		const auto  back = std::adjacent_find(all.begin(), all.end(), std::greater_equal<double>());
		if (back != all.end())
			values.refuse(key + " must rise, and " + shown(back[1]) + " follows " + shown(*back));
	};
	rising("slips");
	rising("velocities");
	for (const double v : values.list(parameters(), "velocities"))
		logs.push_back(std::log(v));
	if (friction.size() != slips.size() * logs.size())
		values.refuse(
		        "friction_table has " + std::to_string(friction.size()) + " numbers: give "
		        + std::to_string(slips.size()) + " slips times " + std::to_string(logs.size()) + " velocities");
	first = values.has("initial_friction") ? values.number(parameters(), "initial_friction") : friction.front();
}

namespace {
	/// Between which two points x lies, and how far from the first: the edges go on.
	struct Between {
		std::size_t low = 0, high = 0;
		double      share = 0;
	};

	Between between(const std::vector<double>& points, double x)
	{
		if (!(x > points.front())) return {};
		if (x >= points.back()) return { points.size() - 1, points.size() - 1, 0 };
		const std::size_t high = std::upper_bound(points.begin(), points.end(), x) - points.begin();
		return { high - 1, high, (x - points[high - 1]) / (points[high] - points[high - 1]) };
	}
}

double Tabulated::steady(double slip, double slipRate) const
{
	const Between s = between(slips, slip), v = between(logs, slipRate > 0 ? std::log(slipRate) : logs.front());
	const auto    row = [&](std::size_t k) {
                const double* f = friction.data() + k * logs.size();
                return f[v.low] + v.share * (f[v.high] - f[v.low]);
	};
	const double low = row(s.low);
	return low + s.share * (row(s.high) - low);
}

void Tabulated::strength(Cells& cells, Range range) const
{
	for (std::size_t c = range.begin; c < range.end; ++c) {
		double& f = *cells.stateOf(c);
		if (lag == 0) f = steady(cells.slip[c], cells.slipRate[c]);
		cells.strength[c] = f * std::max(cells.normalStress[c], 0.0);
	}
}

void Tabulated::advance(Cells& cells, Range range) const
{
	Law::advance(cells, range);
	for (std::size_t c = range.begin; lag > 0 && c < range.end; ++c) {
		double& f = *cells.stateOf(c);
		f += (steady(cells.slip[c], cells.slipRate[c]) - f) * -std::expm1(-cells.path[c] / lag);
	}
}

} // namespace nonsmooth::contact::slip
