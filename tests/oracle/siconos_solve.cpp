// Solves a recorded contact problem with Siconos, to hold our solver against.
//
//     siconos_solve IN.h5 OUT.h5 --tolerance T --max-iterations N [--check-every K] [--without-rolling]
//     siconos_solve IN.h5 --measure [--without-rolling]     only Siconos's error of the impulses in the file, and |q|/|p|
//
// Needs no YADE, and of our own library only the reader and writer of problem files. W and q are built in delassus.cpp. Siconos
// (Acary, Brémond, Huber and others, INRIA) gets
//     rolling resistance      rolling_fc2d_driver, SICONOS_ROLLING_FRICTION_2D_NSGS: nonlinear Gauss-Seidel contact by contact, each
//                             contact by projections on its cone until the local solution holds;
//     none at any contact,    fc2d_driver, SICONOS_FRICTION_2D_NSGS: the same with the exact solution of each contact.
//     or --without-rolling
// K is the cone |T| ≤ μ N̂, |Γ| ≤ μ_r ℓ N̂ with N̂ = N + h F_a, and De Saxcé's change of the normal velocity,
// U_n + μ |U_t| + μ_r ℓ |w|, makes "change of U in the dual of K, orthogonal to P̂" the same as the three graphs of contact/plane/law.hpp.
//
// Siconos stops where its error is below the tolerance: the natural map with ρ = 1, summed over contacts, relative to |q|. That
// asks for a problem whose W is near 1, so every row is scaled by the square root of its diagonal (delassus.hpp): this is a mass for the
// first two rows and an inertia for the third, velocities are divided by their rms, and then the diagonal of W is exactly 1.
// Note that our own residual is relative to the rms impulse instead: in scaled units |p|, which may be ten times |q| or a tenth of it (a
// packing carries more than one step's fall; contacts that are still open have a large b).
//
// Prints one line of JSON: version and solver of Siconos, contacts, iterations, its error, its info flag (0: converged), seconds.
#include "delassus.hpp"
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <contact/plane/problem_file.hpp>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/RollingFrictionContactProblem.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/SparseBlockMatrix.h>
#define restrict __restrict__ // C's, which C++ has not
#include <siconos/numerics/fc2d_compute_error.h>
#include <siconos/numerics/rolling_fc2d_compute_error.h>
#undef restrict

using namespace nonsmooth;

namespace {

struct Arguments {
	std::string in, out;
	double      tolerance     = 1e-6;
	int         maxIterations = 10000;
	int         checkEvery    = 1;
	bool        rolling       = true;
	bool        measure       = false;
};

const char* const usage
        = "usage: siconos_solve IN.h5 OUT.h5 --tolerance T --max-iterations N [--check-every K] [--without-rolling]\n"
          "       siconos_solve IN.h5 --measure [--without-rolling]";

double number(const char* option, const char* text)
{
	char*        end   = nullptr;
	const double value = text ? std::strtod(text, &end) : 0;
	if (!text || *end || !(value > 0) || !std::isfinite(value))
		throw std::invalid_argument(
		        std::string(option) + " wants a positive number, not '" + (text ? text : "") + "'");
	return value;
}

Arguments parse(int argc, char** argv)
{
	Arguments                a;
	std::vector<std::string> files;
	for (int k = 1; k < argc; ++k) {
		const std::string word = argv[k];
		const char*       next = k + 1 < argc ? argv[k + 1] : nullptr;
		if (word == "--without-rolling" || word == "--measure") {
			(word == "--measure" ? a.measure : a.rolling) = word == "--measure";
			continue;
		}
		if (word == "--tolerance") a.tolerance = number("--tolerance", next);
		else if (word == "--max-iterations")
			a.maxIterations = int(number("--max-iterations", next));
		else if (word == "--check-every")
			a.checkEvery = int(number("--check-every", next));
		else {
			if (word.rfind("--", 0) == 0) throw std::invalid_argument(word + " is unknown; " + usage);
			files.push_back(word);
			continue;
		}
		++k;
	}
	if (files.size() != (a.measure ? 1 : 2)) throw std::invalid_argument(usage);
	a.in = files[0];
	if (!a.measure) a.out = files[1];
	return a;
}

/// W as Siconos keeps it: sparse blocks. The numbers stay ours.
class BlockMatrix {
public:
	explicit BlockMatrix(oracle::Delassus& w)
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
		const int rows              = int(count) * w.size;
		matrix = NM_new_SBM(rows, rows, &m); // its few pointers are left to the end of the program
	}
	NumericsMatrix* matrix;

private:
	std::vector<double*>  blocks;
	std::vector<unsigned> ends;
};

struct Solved {
	const char*         solver     = "none";
	int                 info       = 0;
	int                 iterations = 0;
	double              error      = 0;
	double              seconds    = 0;
	std::vector<double> p; // scaled impulses
};

Solved solve(oracle::Delassus& w, const Arguments& arguments)
{
	Solved solved;
	solved.p.assign(w.q.size(), 0.0);
	if (w.contactCount() == 0) return solved;
	const BlockMatrix   block(w);
	std::vector<double> velocity(w.q.size(), 0.0);
	const bool          rolling = w.size == 3;

	const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options(
	        solver_options_create(rolling ? SICONOS_ROLLING_FRICTION_2D_NSGS : SICONOS_FRICTION_2D_NSGS),
	        solver_options_delete);
	options->iparam[SICONOS_IPARAM_MAX_ITER] = arguments.maxIterations;
	options->dparam[SICONOS_DPARAM_TOL]      = arguments.tolerance;
	// fc2d has no other sensible choice (asked for the whole error at every sweep, it never measures one): the change of a sweep until that
	// is below the tolerance, then the whole error, and a lower tolerance for the change until the error holds
	options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION]
	        = SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL;
	if (rolling) {
		options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION]
		        = SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_FULL;
		options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION_FREQUENCY] = arguments.checkEvery;
		// one contact's own solution to a tenth of what all of them may miss, q being 1 in rms
		SolverOptions& local                  = *options->internalSolvers[0];
		local.dparam[SICONOS_DPARAM_TOL]      = std::max(1e-14, 0.1 * arguments.tolerance);
		local.iparam[SICONOS_IPARAM_MAX_ITER] = 100;
	}

	const int  count = int(w.contactCount());
	const auto began = std::chrono::steady_clock::now();
	if (rolling) {
		RollingFrictionContactProblem problem {
			3, count, block.matrix, w.q.data(), w.friction.data(), w.rolling.data()
		};
		solved.solver = "rolling_fc2d NSGS";
		solved.info   = rolling_fc2d_driver(&problem, solved.p.data(), velocity.data(), options.get());
	} else {
		FrictionContactProblem problem { 2, count, block.matrix, w.q.data(), w.friction.data() };
		solved.solver = "fc2d NSGS";
		solved.info   = fc2d_driver(&problem, solved.p.data(), velocity.data(), options.get());
	}
	solved.seconds    = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
	solved.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
	solved.error      = options->dparam[SICONOS_DPARAM_RESIDU];
	return solved;
}

double norm(const std::vector<double>& v)
{
	double sum = 0;
	for (const double value : v)
		sum += value * value;
	return std::sqrt(sum);
}

/// Siconos's error of given scaled impulses: its natural map relative to |q|.
double errorOf(oracle::Delassus& w, std::vector<double> p)
{
	if (w.contactCount() == 0) return 0;
	const BlockMatrix   block(w);
	std::vector<double> velocity(w.q.size());
	const int           count = int(w.contactCount());
	double              error = 0;
	if (w.size == 3) {
		RollingFrictionContactProblem problem {
			3, count, block.matrix, w.q.data(), w.friction.data(), w.rolling.data()
		};
		rolling_fc2d_compute_error(&problem, p.data(), velocity.data(), HUGE_VAL, nullptr, norm(w.q), &error);
	} else {
		FrictionContactProblem problem { 2, count, block.matrix, w.q.data(), w.friction.data() };
		fc2d_compute_error(&problem, p.data(), velocity.data(), HUGE_VAL, norm(w.q), &error);
	}
	return error;
}

bool anyRolls(const contact::Problem& problem)
{
	for (const contact::Contact& c : problem.contacts)
		if (c.rollingArm > 0) return true;
	return false;
}

} // namespace

int main(int argc, char** argv)
try {
	const Arguments          arguments = parse(argc, argv);
	contact::RecordedProblem recorded  = contact::read(arguments.in);
	contact::Problem&        problem   = recorded.problem;
	for (const contact::Contact& c : problem.contacts) // Siconos has no bonds that close freely
		if (c.play > 0) throw std::invalid_argument("a contact has play, which Siconos does not know");
	oracle::Delassus w = oracle::delassus(problem, arguments.rolling && anyRolls(problem));
	if (arguments.measure) {
		const auto p = w.scaled(problem, problem.impulses);
		std::printf(
		        "{\"siconos\": \"%s\", \"error\": %.6e, \"q_over_p\": %.6e}\n", NONSMOOTH_SICONOS_VERSION,
		        errorOf(w, p), norm(w.q) / norm(p));
		return 0;
	}
	const Solved solved = solve(w, arguments);
	problem.impulses    = w.impulses(problem, solved.p);
	problem.velocities  = oracle::velocities(problem, problem.impulses);
	contact::write(arguments.out, recorded);
	std::printf(
	        "{\"siconos\": \"%s\", \"solver\": \"%s\", \"contacts\": %zu, \"iterations\": %d, \"error\": %.6e, \"info\": %d, \"seconds\": %.6f}\n",
	        NONSMOOTH_SICONOS_VERSION, solved.solver, problem.contactCount(), solved.iterations, solved.error,
	        solved.info, solved.seconds);
	return 0;
} catch (const std::exception& error) {
	std::fprintf(stderr, "siconos_solve: %s\n", error.what());
	return 2;
}
