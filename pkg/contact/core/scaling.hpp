// Problems whose impulses or speeds are so small that their squares are 0 in doubles: solved in other units.
//
// The law is homogeneous: with free velocities and biases times a, masses times m, and adhesion times a m, impulses are
// times a m and velocities times a. Powers of two change no digit.
#pragma once

#include <contact/core/classification.hpp>
#include <optional>

namespace nonsmooth::contact {

/// Powers of two by which speeds and masses are multiplied.
struct Scaling {
	int speed = 0, mass = 0;
};

inline Scaling inverse(const Scaling& s) { return { -s.speed, -s.mass }; }

/// Units in which the largest free velocity and mass are near one, if their squares are lost in the present ones; none
/// where nothing moves.
std::optional<Scaling> scalingOfLostSquares(const Classification& classification);

/// What a strength becomes that is out of all proportion to the impulses; times a friction it is still a number.
constexpr double unreachedStrength = 1e290;

} // namespace nonsmooth::contact
