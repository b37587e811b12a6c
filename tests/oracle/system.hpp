// A contact problem of the plane or of space as rows: what each body's motion adds to each relative velocity of a contact.
//
// Built from the contacts' normals and levers alone, on purpose without the functions that our solver uses (relativeVelocity,
// applyImpulse, inverseDelassus): an error in those would then show as a disagreement.
//
//     plane   motions v_x, v_y, ω           rows n, t, and r with rolling
//     space   motions v, ω of the world     rows n, t1, t2, and r1, r2 with rolling; t1, t2 and r1, r2 along the same two tangents
#pragma once

#include <array>
#include <contact/plane/problem.hpp>
#include <contact/space/problem.hpp>
#include <cstdint>
#include <vector>

namespace nonsmooth::oracle {

constexpr int mostMotions = 6, mostRows = 5;

using Motion    = std::array<double, mostMotions>; // of a body; the plane uses the first three
using RowValues = std::array<double, mostRows>; // impulses or velocities of a contact, row by row
using Jacobian  = std::array<Motion, mostRows>;

struct System {
	int dimension = 2; // of the problem, and rows of a contact without rolling
	int motions   = 3; // of a body
	int size      = 2; // rows of a contact
	/// Which vector each row is a component of: 0 normal, 1 sliding, 2 rolling. A vector's rows share one scale, or a disc would become an
	/// ellipse.
	std::array<int, mostRows> part {};

	struct Body {
		std::array<Motion, mostMotions> inverseMass {};
		Motion                          freeVelocity {};
		bool                            fixed = false;
	};
	struct Contact {
		std::int32_t i = 0, j = 0;
		Jacobian     ofI {}, ofJ {};
		RowValues    bias {};
		double       adhesion = 0, friction = 0, rolling = 0; // h F_a [N s], μ_s, μ_r ℓ [m]
	};
	std::vector<Body>    bodies;
	std::vector<Contact> contacts;

	/// v_free + M⁻¹ Hᵀ P of each body.
	std::vector<Motion> velocities(const std::vector<RowValues>& impulses) const;
};

/// Throws std::invalid_argument where a contact names a body that is not there, or has what Siconos does not know: play, twisting.
System systemOf(const contact::Problem& problem, bool withRolling);
System systemOf(const contact::space::Problem& problem, bool withRolling);

/// A problem's own impulses in rows, and the other way round: writes impulses and the velocities that belong to them.
std::vector<RowValues> impulsesOf(const contact::Problem& problem);
std::vector<RowValues> impulsesOf(const contact::space::Problem& problem);
void takeImpulses(contact::Problem& problem, const System& system, const std::vector<RowValues>& impulses);
void takeImpulses(contact::space::Problem& problem, const System& system, const std::vector<RowValues>& impulses);

} // namespace nonsmooth::oracle
