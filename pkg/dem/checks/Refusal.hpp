// How ContactDynamicsEngine refuses a scene, and how numbers stand in the messages of all engines.
#pragma once

#include <charconv>
#include <cmath>
#include <core/Engine.hpp>
#include <stdexcept>

namespace yade::nscd {

[[noreturn]] inline void fail(const string& why) { throw std::runtime_error("ContactDynamicsEngine: " + why); }

/// Up to here squares and products of numbers are numbers; whatever is larger is a slip of the pen.
constexpr Real hugest = 1e100;
inline bool    isNumber(Real value) { return std::abs(value) <= hugest; } // false for what is none

inline string number(Real value);

/// Refuses an attribute where a script sets it. Throws std::invalid_argument, ValueError in Python.
inline void require(bool good, const string& who, const char* name, Real value, const char* what)
{
	if (!good) throw std::invalid_argument(who + ": " + name + " = " + number(value) + ": it must be " + what);
}

/// In as few digits as tell it, as Python writes it: 1000000, 0.001, 1e+20.
inline string number(Real value)
{
	const Real size   = std::abs(value);
	const auto format = size == 0 || (size >= 1e-4 && size < 1e16) ? std::chars_format::fixed
	                                                               : std::chars_format::general;
	char       digits[40];
	const auto end = std::to_chars(digits, digits + sizeof(digits), value, format);
	return string(digits, end.ptr);
}

/// In three digits, for what was computed.
inline string about(Real value)
{
	char       digits[40];
	const auto end = std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::general, 3);
	return string(digits, end.ptr);
}

} // namespace yade::nscd
