// Problems of the plane in other units (core/scaling.hpp).
#pragma once

#include <contact/core/scaling.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

/// The problem in other units, with the impulses that it begins with.
Problem scaled(const Problem& problem, const Scaling& scaling);

/// The impulse in other units.
Impulse scaled(const Impulse& impulse, const Scaling& scaling);
Twist   scaled(const Twist& velocity, int speed);

} // namespace nonsmooth::contact
