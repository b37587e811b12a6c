// The motion of the ground, from its acceleration at given times.
//
//     a(t)  linear between the times, zero before the first and after the last
//     V(t) = ∫ a dt      D(t) = ∫ V dt
// both exact for this a. After the record the ground keeps the velocity that it ended with: a record that was not
// corrected drifts, and this is not hidden.
// Units: s, m/s², m/s, m.
#pragma once

#include <array>
#include <vector>

namespace yade::nscd {

class AccelerationRecord {
public:
	using Pair = std::array<double, 2>; // along x and along y

	AccelerationRecord() = default;
	/// Times that rise, and as many accelerations along x and y, each of which may be empty for none.
	AccelerationRecord(std::vector<double> times, std::vector<double> x, std::vector<double> y);

	Pair acceleration(double time) const;
	Pair velocity(double time) const;
	Pair displacement(double time) const;
	/// Mean acceleration from one time to a later one: (V(end) − V(begin)) / (end − begin), summed up within this
	/// span alone, so that it is as exact late as early.
	Pair mean(double begin, double end) const;

private:
	/// The number of the last time that is not after `time`; −1 before the first.
	long before(double time) const;
	/// ∫ a dt from times[k] to `time`, which is in the interval that begins there.
	double gained(int axis, long k, double time) const;
	double slope(int axis, long k) const;

	std::vector<double>                at;
	std::array<std::vector<double>, 2> given, reached, gone; // a, V and D at the times
};

} // namespace yade::nscd
