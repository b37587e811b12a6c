#include "AccelerationRecord.hpp"
#include <algorithm>

namespace yade::nscd {

AccelerationRecord::AccelerationRecord(std::vector<double> times, std::vector<double> x, std::vector<double> y)
        : at(std::move(times))
        , given { std::move(x), std::move(y) }
{
	for (int axis = 0; axis < 2; ++axis) {
		const auto& a = given[axis];
		auto &      v = reached[axis], &d = gone[axis];
		if (a.empty()) continue;
		v.assign(a.size(), 0);
		d.assign(a.size(), 0);
		for (size_t k = 1; k < a.size(); ++k) {
			const double h = at[k] - at[k - 1];
			v[k]           = v[k - 1] + h * (a[k - 1] + a[k]) / 2;
			d[k]           = d[k - 1] + h * (v[k - 1] + h * (2 * a[k - 1] + a[k]) / 6);
		}
	}
}

long AccelerationRecord::before(double time) const
{
	return std::upper_bound(at.begin(), at.end(), time) - at.begin() - 1;
}

double AccelerationRecord::slope(int axis, long k) const
{
	const auto& a = given[axis];
	return (a[k + 1] - a[k]) / (at[k + 1] - at[k]);
}

double AccelerationRecord::gained(int axis, long k, double time) const
{
	const double t = time - at[k];
	return t * (given[axis][k] + slope(axis, k) * t / 2);
}

AccelerationRecord::Pair AccelerationRecord::acceleration(double time) const
{
	const long k   = before(time);
	Pair       out = { 0, 0 };
	for (int axis = 0; axis < 2; ++axis) {
		const auto& a = given[axis];
		if (a.empty() || k < 0) continue;
		if (k + 1 < (long)at.size()) out[axis] = a[k] + slope(axis, k) * (time - at[k]);
		else if (time == at.back())
			out[axis] = a.back();
	}
	return out;
}

AccelerationRecord::Pair AccelerationRecord::velocity(double time) const
{
	const long k   = before(time);
	Pair       out = { 0, 0 };
	for (int axis = 0; axis < 2; ++axis)
		if (!given[axis].empty() && k >= 0)
			out[axis] = reached[axis][k] + (k + 1 < (long)at.size() ? gained(axis, k, time) : 0);
	return out;
}

AccelerationRecord::Pair AccelerationRecord::displacement(double time) const
{
	const long k   = before(time);
	Pair       out = { 0, 0 };
	for (int axis = 0; axis < 2; ++axis) {
		if (given[axis].empty() || k < 0) continue;
		const double t = time - at[k];
		out[axis]      = gone[axis][k] + t * reached[axis][k];
		if (k + 1 < (long)at.size()) out[axis] += t * t * (given[axis][k] / 2 + slope(axis, k) * t / 6);
	}
	return out;
}

AccelerationRecord::Pair AccelerationRecord::mean(double begin, double end) const
{
	Pair out = { 0, 0 };
	for (int axis = 0; axis < 2; ++axis) {
		if (given[axis].empty()) continue;
		double total = 0, from = begin;
		for (long k = before(begin); from < end; ++k) {
			const bool   last = k + 1 >= (long)at.size();
			const double to   = last ? end : std::min(end, at[k + 1]);
			if (k >= 0 && !last) total += gained(axis, k, to) - gained(axis, k, from);
			from = to;
		}
		out[axis] = total / (end - begin);
	}
	return out;
}

} // namespace yade::nscd
