// How contacts and bodies are cut into parts whose sums one thread makes; fixed, so that sums do not depend on the number of
// threads.
#pragma once

#include <cstddef>

namespace yade::nscd {

constexpr std::size_t        sumChunk = 1024; // contacts or bodies
constexpr inline std::size_t chunksOf(std::size_t count) { return (count + sumChunk - 1) / sumChunk; }

} // namespace yade::nscd
