// A problem in space in other units (contact/plane/problem_scale.hpp).
#pragma once

#include <contact/core/scaling.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::contact::space {

/// The problem in other units, with the impulses that it begins with; one impulse; one velocity.
Problem scaled(const Problem& problem, const Scaling& scaling);
Impulse scaled(const Impulse& impulse, const Scaling& scaling);
Twist   scaled(const Twist& velocity, int speed);

} // namespace nonsmooth::contact::space
