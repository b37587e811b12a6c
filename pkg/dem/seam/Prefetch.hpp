// Asking for memory before it is needed: YADE's objects lie all over it, each one of a loop's items somewhere else.
#pragma once

#include <cstddef>

namespace yade::nscd {

/// Asks for the cache lines of an object that will be needed soon.
template <std::size_t bytes> void fetch(const void* object)
{
	for (std::size_t at = 0; at < bytes; at += 64)
		__builtin_prefetch(static_cast<const char*>(object) + at, 1);
}

// What every step reads and writes of an interaction comes first in its objects; the marks of bonds, which come last,
// are met by the loop alone.
constexpr std::size_t partOfGeometry = 128, partOfPhysics = 256;

// What of a physics tells whether a script has written into it.
constexpr std::size_t partWritten = 192;

// Of a ContactState: all but what few contacts ask for, those that break, yield, or have an impact.
constexpr std::size_t commonOfState = 128;

constexpr std::size_t soon = 8, later = 32; // items ahead: what an item points to, and the item itself

} // namespace yade::nscd
