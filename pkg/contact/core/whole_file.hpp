// A file that is whole or not there: written beside, then renamed.
#pragma once

#include <cstddef>
#include <string>

namespace nonsmooth::contact {

/// Writes to a new file in the same folder, whose name nobody can know, and renames it to `path`: a link there is
/// replaced, not followed. Returns why it failed, in the system's words, with nothing left behind; "" where it did not.
std::string writeWhole(const std::string& path, const char* bytes, std::size_t count);

} // namespace nonsmooth::contact
