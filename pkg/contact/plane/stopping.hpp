// The figures of LMGC90's tests (core/stopping.hpp) for problems in the plane.
#pragma once

#include <contact/core/stopping.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

/// What one more visit would change of a contact with the impulses `p` and the velocities of its bodies.
VisitChange
changeOf(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist vi, Twist vj);

/// The figures of problem.impulses, from velocities computed anew.
VelocityChanges velocityChanges(const Problem& problem);

} // namespace nonsmooth::contact
