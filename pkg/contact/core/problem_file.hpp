// Of which dimension the contact problem in a file is (plane/problem_file.hpp, space/problem_file.hpp).
#pragma once

#include <string>

namespace nonsmooth::contact {

/// 2 or 3: of the problem in a file. Throws std::runtime_error naming the file, where it holds none.
int dimensionOf(const std::string& path);

} // namespace nonsmooth::contact
