// Nonlinear Gauss-Seidel on the contact problem, plain or inside Nesterov's extrapolation with adaptive restart.
//
// One sweep visits every contact and replaces its impulses by the projection of the law (plane/law.hpp, space/law.hpp),
// row by row, velocities being kept up to date (Jean 1999). Information crosses about one contact a sweep, so a deep
// packing needs thousands of plain sweeps. The accelerated method starts every sweep from
//     y_k = P_k + β_k (P_k − P_{k−1}),   β_k = (θ_k − 1)/θ_{k+1},   θ_{k+1} = (1 + √(1 + 4 θ_k²))/2
// (Nesterov 1983) and sets θ = 1 again when the residual has grown over the last two comparisons (O'Donoghue and Candès
// 2015, their function scheme; over one it would restart too often where contacts change their status). Comparisons are
// checkEvery sweeps apart at first; every restart doubles that, up to 40, because late in a solve the residual rises
// and falls over tens of sweeps, and needless restarts cost most there. A residual of twice the smallest one since the
// last restart restarts at once, and halves the distance. Strips that hold next to nothing of the residual rest until
// the next look at it (active_strips.hpp). Sweeps are counted by visits: one is as many as there are contacts, and one
// of few strips a quarter. Sweeps are made in single precision first: half the bytes, and twice the contacts to an
// instruction. Impulses need no more digits than the tolerance asks for, and velocities are those that impulses have
// changed (block_kernels.hpp). From there the same is done in double precision: velocities and residual anew, and more
// sweeps if the residual asks for any, so that what is returned is held against the law in doubles. Tolerances below
// finestInSingle are left to doubles alone. Contacts lie in blocks of eight (contact_blocks.hpp) and strips
// (sweep_order.hpp), which make the result independent of the number of threads and of the processor; sums are added in
// a fixed order.
#pragma once

#include <contact/core/residual.hpp>
#include <contact/core/stopping.hpp>

namespace nonsmooth::contact {

enum class Method { GaussSeidel, Accelerated };

/// What sweeps compute with: floats as far as the tolerance allows and doubles from there, or doubles alone.
enum class Precision { Mixed, Double };

/// "accelerated" or "gaussSeidel"; throws std::invalid_argument naming what was given and what would do.
Method methodOf(const char* name);
/// "mixed" or "double"; the same.
Precision precisionOf(const char* name);

/// The least tolerance that sweeps in single precision are for. Impulses in floats miss the law by some 1e-7 of their
/// size, which beside this changes a residual by one part in ten thousand.
constexpr double finestInSingle = 1e-5;

/// What is asked of a solve in any dimension.
struct SweepSettings {
	Method       method        = Method::Accelerated;
	double       tolerance     = 1e-4; // on Residual::relative(), or on the figures of another stopping test
	int          maxIterations = 1000;
	int          checkEvery    = 10; // sweeps between two residuals
	int          threads       = 1;
	StoppingTest stopping      = StoppingTest::NaturalMap;
	Precision    precision     = Precision::Mixed;
	bool         reference
	        = false; // contact after contact as law.hpp has it, none in blocks: what blocks are measured against
};

struct SolverStatistics {
	int iterations = 0; // visits over contacts, a sweep of few strips being a quarter at least, rounded up
	int inSingle   = 0; // those of them in single precision
	int restarts   = 0;
	int strips     = 0;
	int patches
	        = 0; // of contacts around mass jumps that were solved at once, each as often as it was (mass_jumps.hpp)
	double patchSpeed = 0; // largest rms ϑ of one of these patches (residual.hpp)
	bool   uneven     = false; // masses are so far apart that speeds decide, see Residual::missed
	bool   converged  = true;
	Residual
	        residual; // of what is returned, from velocities computed anew from the impulses; whatever test stopped the solver
	VelocityChanges changes; // the same, in the figures of LMGC90's tests; only where one of them was asked for
};

} // namespace nonsmooth::contact
