// The solver for problems in the plane: settings and method stand in core/settings.hpp, the law in plane/law.hpp.
//
// Errors of position are taken back by displacements that leave no velocity behind (split impulses). For bodies'
// displacements D and pseudo-impulses Q with D = M⁻¹ Hᵀ Q, a few sweeps of the same blocks, extrapolated as above, move
// towards
//     0 ≤ (D^n + e) ⟂ Q ≥ 0 ,     and for a bond that holds    D^n + e = 0 ,    where it sticks    D^t + e_t = 0 ,    and where it does not roll    D^r + e_r = 0 ,
// for one that holds and closes freely    0 ≤ D^n + e ≤ p ,    Q ≥ 0 at the lower bound and Q ≤ 0 at the upper one,
// with e the errors at the end of the step, as far as they are to be taken back. Normals alone act, but in strips in
// which a bond asks for more. The sweeps begin
// with the Q of the step before along the normals, and with none along the tangents, whose errors are few and small.
#pragma once

#include <contact/core/settings.hpp>
#include <contact/core/workspace.hpp>
#include <contact/plane/block_kernels.hpp>
#include <contact/plane/residual.hpp>
#include <contact/plane/stopping.hpp>
#include <contact/plane/classification.hpp>

namespace nonsmooth::contact {

struct SolverSettings : SweepSettings {
	const BlockKernels* kernels = nullptr; // of availableKernels(); null: the first; the bits are the same
};

using ContactBlocks = ContactBlocksIn<Plane>;
using Workspace     = WorkspaceIn<Plane>;

/// The loops that a solve with these settings runs.
inline const BlockKernels& kernelsFor(const SolverSettings& settings)
{
	return settings.kernels ? *settings.kernels : *availableKernels().front();
}

/// What one contact asks of the positions at the end of a step [m]: its bodies draw apart by −error where that is
/// negative, and by no more than they must; they may draw together by `error` where it is positive. With `held` they do
/// so in any case, but for `play`.
struct PositionError {
	double error  = 0;
	bool   held   = false; // a bond, whose length is kept either way
	bool   sticks = false, grips = false; // that may not slip, and may not turn
	double impulse
	        = 0; // Q to begin with [kg m], that of the step before: what lies deep in a packing takes several steps
	float  slip = 0, turn = 0; // what it has done so all the same, and is to go back [m, rad]
	double play
	        = 0; // of a bond that closes freely, and of no contact whose own was 0 in the solve: by how much its bodies may be farther apart than −error
	bool asksAcross() const { return slip != 0 || turn != 0; }
};

struct PositionCorrection {
	std::vector<Twist>  displacements; // of bodies [m, m, rad]
	std::vector<double> impulses; // Q of contacts [kg m]
	std::vector<double> tangential; // the same along the tangents; empty where no bond asks for any
};

/// Displacements of the bodies that take the errors back, one error a contact. To be called after a solve with the same
/// problem, settings and workspace, on whose blocks it sweeps. `across`: whether any of them may ask for more than its
/// length. Throws std::invalid_argument where a size does not fit.
void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result, bool across = true);

/// Solves in place: reads problem.impulses as warm start, writes problem.impulses and problem.velocities. Throws
/// std::invalid_argument naming the setting, body or contact that cannot be used (problem_check.hpp), before anything
/// is changed.
SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace = nullptr);

} // namespace nonsmooth::contact
