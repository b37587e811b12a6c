// The solver for problems in space: method, settings, statistics and the two passes of precision are those of the plane
// (contact/core/settings.hpp), the law is space/law.hpp's.
//
// A body's errors of position are taken back by displacements D and rotations R that leave no velocity behind, as in
// the plane:
//     0 ≤ (D_n + e) ⟂ Q ≥ 0 ,    and for a bond that holds    D_n + e = 0 ,
//     where it sticks    D_t + e_t = 0 ,    and where it neither rolls nor twists    R + e_w = 0 .
// Patches of contacts around mass jumps are not solved at once here: sweeps alone do it, and speeds decide where masses
// are far apart.
#pragma once

#include <contact/core/settings.hpp>
#include <contact/core/workspace.hpp>
#include <contact/space/block.hpp>
#include <contact/space/classification.hpp>

namespace nonsmooth::contact::space {

struct SolverSettings : SweepSettings {
	const BlockKernels* kernels = nullptr; // of availableKernels(); null: the first; the bits are the same
};

using ContactBlocks = ContactBlocksIn<Space>;
using Workspace     = WorkspaceIn<Space>;

/// What one contact asks of the positions at the end of a step, as in the plane.
struct PositionError {
	double error  = 0; // [m]
	bool   held   = false; // a bond, whose length is kept either way
	bool   sticks = false, grips = false; // that may not slip, and may neither roll nor twist
	double impulse = 0; // Q to begin with [kg m]
	Vector slip, turn; // what it has done so all the same, and is to go back [m], [rad]
	double play = 0; // as in the plane [m]
	bool   asksAcross() const { return !isZero(slip) || !isZero(turn); }
};

struct PositionCorrection {
	std::vector<Twist>  displacements; // of bodies [m], [rad]
	std::vector<double> impulses; // Q of contacts along their normals [kg m]
	std::vector<Vector> tangential; // the same across them; empty where no bond asks for any
};

/// Displacements of the bodies that take the errors back, one error a contact. To be called after a solve with the same
/// problem, settings and workspace,
/// on whose blocks it sweeps. `across`: whether any of them may ask for more than its length. Throws
/// std::invalid_argument where a size does not fit.
void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result, bool across = true);

/// Solves in place: reads problem.impulses as warm start, writes problem.impulses and problem.velocities.
/// Throws std::invalid_argument naming the setting, body or contact that cannot be used (space/problem_check.hpp),
/// before anything is changed.
SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace = nullptr);

/// What one more visit would change of a contact (contact/core/stopping.hpp), with all four rows.
VisitChange
changeOf(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist vi, Twist vj);

/// The figures of LMGC90's tests for problem.impulses, from velocities computed anew.
VelocityChanges velocityChanges(const Problem& problem);

} // namespace nonsmooth::contact::space
