// Where masses jump: patches of contacts around heavy bodies among light ones, which are solved at once
// (interior_point.hpp).
//
// Sweeps build up the reaction to a heavy body in steps of the light bodies' impulses, so that their number grows with
// the ratio of masses, accelerated ones with its root. Where a body is massJump times as heavy as one that it touches,
// the contacts around it make a patch: those of the bodies that are nearest to it counted by contacts, up to
// mostInPatch bodies, as far as they couple these to each other and to what cannot move. Every other contact keeps its
// impulse meanwhile. Heavier bodies come first; one that is in a patch already gets none of its own.
//
// A packing of many sizes has jumps everywhere, and sweeps do well there: where more than one body in eight is the
// heavy one of a jump, only problems of up to fewBodies get patches.
#pragma once

#include <contact/core/mass_ratio.hpp>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

constexpr std::size_t mostInPatch = 1200; // bodies

struct MassPatch {
	std::vector<std::int32_t>
	        bodies; // in the order of elimination; `hubs` with contacts all over the patch come last
	std::vector<std::int32_t> contacts;
	std::size_t               hubs  = 0;
	std::size_t               width = 0; // of the band, in bodies
	double                    work() const; // of one solve, in visits to a contact
};

/// Whether one of the bodies is that many times as heavy as the other, both of them free to move.
inline bool isMassJump(const InverseMass& i, const InverseMass& j, double jump)
{
	const double a = i.x + i.y, b = j.x + j.y; // of a body that is held in one direction half
	return a > 0 && b > 0 && (a >= jump * b || b >= jump * a);
}

/// The patches of a problem, in the order in which they are solved; to be asked where it has such contacts.
std::vector<MassPatch> massPatches(const Problem& problem);

} // namespace nonsmooth::contact
