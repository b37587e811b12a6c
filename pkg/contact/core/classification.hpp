// One look at every body and contact before a solve: whether the solver can use it, and what strips, order and blocks
// rest on. Where a workspace is used again, it also tells what of that has changed since the last look, so that the
// rest can be kept.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nonsmooth::contact {

/// The bodies of a contact; in place of one that can't move its complement, a negative number.
struct MovablePair {
	std::int32_t        i, j;
	static bool         moves(std::int32_t body) { return body >= 0; }
	static std::int32_t bodyOf(std::int32_t body) { return moves(body) ? body : ~body; }
};

struct Span {
	double low = HUGE_VAL, high = -HUGE_VAL;
	double length() const { return high - low; }
};

/// Where bodies are, along as many axes as the dimension has: a look at arrays that stay where they are.
struct Coordinates {
	const double* first = nullptr; // of the first body; each has its numbers side by side
	std::size_t   count = 0; // bodies; none where their places are not known
	int           axes  = 2;

	double operator()(std::size_t body, int axis) const { return first[body * axes + axis]; }
};

struct Classification {
	/// What the short formulas of the blocks ask of a body.
	enum BodyTrait : std::uint8_t { turns = 1, plain = 2, moves = 4 };

	std::vector<std::uint8_t> traits; // of bodies
	std::vector<std::uint8_t> simple; // whether a contact fits into blocks
	std::vector<MovablePair>  pairs; // of the contacts
	Span                      extents[3]; // along the axes, from the lowest to the highest body that can move
	double                    fastest    = 0; // largest component of a free velocity [m/s]
	double                    lightness  = HUGE_VAL; // least inverse mass of what can move in x or y [1/kg]
	double                    longest[3] = { 0, 0, 0 }; // along the axes, of contacts between bodies that can move
	bool                      uneven
	        = false; // whether one body has massJump times the mass of another (mass_jumps.hpp); among many, plates that go along one line do not count
	bool jumps     = false; // whether masses jump somewhere (mass_jumps.hpp)
	bool plays     = false; // whether a contact has play (law.hpp)
	bool pairsKept = false, simpleKept = false; // whether they are those of the last look
};

} // namespace nonsmooth::contact
