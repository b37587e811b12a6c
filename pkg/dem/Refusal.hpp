// How ContactDynamicsEngine refuses a scene, and how numbers stand in the messages of all engines.
#pragma once

#include <charconv>
#include <cmath>
#include <core/Engine.hpp>
#include <stdexcept>

namespace yade::nscd {

[[noreturn]] inline void fail(const string& why) { throw std::runtime_error("ContactDynamicsEngine: " + why); }

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

} // namespace yade::nscd
