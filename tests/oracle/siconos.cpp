#include "siconos.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/RollingFrictionContactProblem.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/SparseBlockMatrix.h>
#define restrict __restrict__ // C's, which C++ has not
#include <siconos/numerics/fc2d_compute_error.h>
#include <siconos/numerics/fc3d_compute_error.h>
#include <siconos/numerics/rolling_fc2d_compute_error.h>
#undef rolling_fc3d_compute_error_H // the guard of both headers in Siconos 4.4
#include <siconos/numerics/rolling_fc3d_compute_error.h>
#undef restrict

namespace nonsmooth::oracle {

namespace {

	/// W as Siconos keeps it: sparse blocks, whose numbers stay ours; or single numbers where there are five rows a contact, since
	/// NM_extract_diag_block5 of Siconos 4.4 ends the process at sparse blocks.
	class Matrix {
	public:
		explicit Matrix(Delassus& w)
		{
			const int rows = int(w.contactCount()) * w.size;
			matrix         = w.size == 5 ? ofNumbers(w, rows) : ofBlocks(w, rows);
		}
		NumericsMatrix* matrix; // its few pointers, and its numbers, are left to the end of the program

	private:
		NumericsMatrix* ofBlocks(Delassus& w, int rows)
		{
			const std::size_t count = w.contactCount(), square = std::size_t(w.size) * w.size;
			for (std::size_t b = 0; b < w.column.size(); ++b)
				blocks.push_back(w.blocks.data() + b * square);
			for (std::size_t k = 0; k < count; ++k)
				ends.push_back(unsigned((k + 1) * w.size));
			SparseBlockStructuredMatrix& m = *SBM_new();
			m.nbblocks                     = unsigned(blocks.size());
			m.block                        = blocks.data();
			m.blocknumber0 = m.blocknumber1 = unsigned(count);
			m.blocksize0 = m.blocksize1 = ends.data();
			m.filled1                   = w.begin.size();
			m.filled2                   = w.column.size();
			m.index1_data               = w.begin.data();
			m.index2_data               = w.column.data();
			return NM_new_SBM(rows, rows, &m);
		}

		static NumericsMatrix* ofNumbers(const Delassus& w, int rows)
		{
			NumericsMatrix* m = NM_create(NM_SPARSE, rows, rows);
			NM_triplet_alloc(m, w.blocks.size());
			const double* number = w.blocks.data();
			for (std::size_t k = 0; k < w.contactCount(); ++k)
				for (std::size_t b = w.begin[k]; b < w.begin[k + 1]; ++b)
					for (int column = 0; column < w.size; ++column)
						for (int row = 0; row < w.size; ++row, ++number)
							if (*number != 0)
								NM_entry(
								        m, int(k) * w.size + row,
								        int(w.column[b]) * w.size + column, *number);
			return m;
		}

		std::vector<double*>  blocks;
		std::vector<unsigned> ends;
	};

	FrictionContactProblem frictionOf(Delassus& w, NumericsMatrix* matrix)
	{
		return { w.dimension, int(w.contactCount()), matrix, w.q.data(), w.friction.data() };
	}
	RollingFrictionContactProblem rollingOf(Delassus& w, NumericsMatrix* matrix)
	{
		return { w.size, int(w.contactCount()), matrix, w.q.data(), w.friction.data(), w.rolling.data() };
	}

	/// A solver of Siconos for a dimension, with rolling or without.
	struct Solver {
		int         id;
		const char* name;
	};
	Solver solverOf(const Delassus& w)
	{
		if (w.dimension == 2)
			return w.rolls() ? Solver { SICONOS_ROLLING_FRICTION_2D_NSGS, "rolling_fc2d NSGS" }
			                 : Solver { SICONOS_FRICTION_2D_NSGS, "fc2d NSGS" };
		return w.rolls() ? Solver { SICONOS_ROLLING_FRICTION_3D_NSGS, "rolling_fc3d NSGS" }
		                 : Solver { SICONOS_FRICTION_3D_NSGS, "fc3d NSGS" };
	}

	double norm(const std::vector<double>& v)
	{
		double sum = 0;
		for (const double value : v)
			sum += value * value;
		return std::sqrt(sum);
	}

	using Options = std::unique_ptr<SolverOptions, void (*)(SolverOptions*)>;

	Options optionsOf(const Delassus& w, const Asked& asked)
	{
		Options options(solver_options_create(solverOf(w).id), solver_options_delete);
		options->iparam[SICONOS_IPARAM_MAX_ITER] = asked.maxIterations;
		options->dparam[SICONOS_DPARAM_TOL]      = asked.tolerance;
		if (!w.rolls() && w.dimension == 2) {
			// fc2d has no other sensible choice (asked for the whole error at every sweep, it never measures one): the change of a sweep
			// until that is below the tolerance, then the whole error, and a lower tolerance for the change until the error holds
			options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION]
			        = SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL;
			return options;
		}
		options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION]
		        = SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_FULL;
		options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION_FREQUENCY] = asked.checkEvery;
		// one contact's own solution to a tenth of what all of them may miss, q being 1 in rms
		SolverOptions& local                  = *options->internalSolvers[0];
		local.dparam[SICONOS_DPARAM_TOL]      = std::max(1e-14, 0.1 * asked.tolerance);
		local.iparam[SICONOS_IPARAM_MAX_ITER] = 100;
		return options;
	}

} // namespace

Solved solve(Delassus& w, const Asked& asked)
{
	Solved solved;
	solved.p.assign(w.q.size(), 0.0);
	if (w.contactCount() == 0) return solved;
	solved.solver = solverOf(w).name;
	const Matrix        block(w);
	std::vector<double> velocity(w.q.size(), 0.0);
	const Options       options = optionsOf(w, asked);
	const auto          began   = std::chrono::steady_clock::now();
	if (w.rolls()) {
		RollingFrictionContactProblem problem = rollingOf(w, block.matrix);
		const auto                    driver  = w.dimension == 2 ? rolling_fc2d_driver : rolling_fc3d_driver;
		solved.info = driver(&problem, solved.p.data(), velocity.data(), options.get());
	} else {
		FrictionContactProblem problem = frictionOf(w, block.matrix);
		const auto             driver  = w.dimension == 2 ? fc2d_driver : fc3d_driver;
		solved.info                    = driver(&problem, solved.p.data(), velocity.data(), options.get());
	}
	solved.seconds    = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
	solved.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
	solved.error      = options->dparam[SICONOS_DPARAM_RESIDU];
	return solved;
}

Measured measure(Delassus& w, std::vector<double> p)
{
	if (w.contactCount() == 0) return {};
	const Matrix        block(w);
	std::vector<double> velocity(w.q.size());
	const double        q = norm(w.q), size = norm(p);
	Measured            found;
	if (w.rolls()) {
		RollingFrictionContactProblem problem = rollingOf(w, block.matrix);
		const auto error = w.dimension == 2 ? rolling_fc2d_compute_error : rolling_fc3d_compute_error;
		error(&problem, p.data(), velocity.data(), HUGE_VAL, nullptr, q, &found.error);
	} else {
		FrictionContactProblem problem = frictionOf(w, block.matrix);
		if (w.dimension == 2)
			fc2d_compute_error(&problem, p.data(), velocity.data(), HUGE_VAL, q, &found.error);
		else
			fc3d_compute_error(&problem, p.data(), velocity.data(), HUGE_VAL, nullptr, q, &found.error);
	}
	found.scaleOverImpulses = (w.rolls() && w.dimension == 2 ? q : std::max(q, size)) / size;
	return found;
}

} // namespace nonsmooth::oracle
