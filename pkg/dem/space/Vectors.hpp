// YADE's vectors and those of the solver in space.
#pragma once

#include <contact/space/vector.hpp>
#include <lib/base/Math.hpp>

namespace yade::nscd {

inline nonsmooth::contact::space::Vector ours(const Vector3r& v) { return { v[0], v[1], v[2] }; }
inline Vector3r theirs(const nonsmooth::contact::space::Vector& v) { return Vector3r(v.x, v.y, v.z); }

} // namespace yade::nscd
