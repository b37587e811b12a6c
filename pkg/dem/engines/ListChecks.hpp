// What engines ask of lists that a script sets: numbers, and times that rise.
#pragma once

#include "../checks/Refusal.hpp"

namespace yade::nscd {

/// Throws std::invalid_argument for the first element that is no finite number.
inline void requireNumbers(const string& who, const char* name, const vector<Real>& values)
{
	for (size_t k = 0; k < values.size(); ++k)
		if (!isNumber(values[k]))
			throw std::invalid_argument(
			        who + ": " + name + "[" + std::to_string(k) + "] = " + number(values[k])
			        + ": give a finite number");
}

/// Throws std::invalid_argument for the first of the `times` that comes before the one in front of it or, where they
/// rise `strictly`, not after it.
inline void requireRising(const string& who, const vector<Real>& times, bool strictly)
{
	for (size_t k = 1; k < times.size(); ++k)
		if (times[k] < times[k - 1] || (strictly && times[k] == times[k - 1]))
			throw std::invalid_argument(
			        who + ": times[" + std::to_string(k - 1) + "] = " + number(times[k - 1]) + " and times["
			        + std::to_string(k) + "] = " + number(times[k]) + ": times must rise");
}

} // namespace yade::nscd
