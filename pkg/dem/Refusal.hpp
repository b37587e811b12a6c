// How ContactDynamicsEngine refuses a scene, and how numbers stand in its messages.
#pragma once

#include <charconv>
#include <core/Engine.hpp>
#include <stdexcept>

namespace yade::nscd {

[[noreturn]] inline void fail(const string& why) { throw std::runtime_error("ContactDynamicsEngine: " + why); }

/// In as few digits as tell it.
inline string number(Real value)
{
	char       digits[32];
	const auto end = std::to_chars(digits, digits + sizeof(digits), value);
	return string(digits, end.ptr);
}

} // namespace yade::nscd
