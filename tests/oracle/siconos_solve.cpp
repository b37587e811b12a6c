// Solves a recorded contact problem, of the plane or of space, with Siconos, to hold our solver against.
//
//     siconos_solve IN.h5 OUT.h5 --tolerance T --max-iterations N [--check-every K] [--without-rolling]
//     siconos_solve IN.h5 --measure [--without-rolling]     only Siconos's error of the impulses in the file, and what it is relative to, over |p|
//
// Needs no YADE, and of our own library only the reader and writer of problem files. W and q are built in system.cpp and delassus.cpp. Siconos
// (Acary, Brémond, Huber and others, INRIA) gets
//     rolling resistance      rolling_fc2d_driver, rolling_fc3d_driver, SICONOS_ROLLING_FRICTION_2D_NSGS and _3D_: nonlinear Gauss-Seidel contact by
//                             contact, each contact by projections on its cone until the local solution holds;
//     none at any contact,    fc2d_driver, fc3d_driver, SICONOS_FRICTION_2D_NSGS and _3D_: the same with the exact solution of each contact, in space
//     or --without-rolling    by Newton's method.
// K is the cone |T| ≤ μ N̂, |Γ| ≤ μ_r ℓ N̂ with N̂ = N + h F_a, T and Γ being vectors in space, and De Saxcé's change of the normal velocity,
// U_n + μ |U_t| + μ_r ℓ |w|, makes "change of U in the dual of K, orthogonal to P̂" the same as the three graphs of contact/plane/law.hpp. The fourth
// of contact/space/law.hpp, twisting, Siconos has not: a problem with it is refused.
//
// Siconos stops where its error is below the tolerance: the natural map with ρ = 1, summed over contacts, relative to the larger of |q| and |p|; of
// rolling_fc2d to |q| alone. That asks for a problem whose W is near 1, so every row is scaled by the square root of its diagonal (delassus.hpp): this
// is a mass for the rows of forces and an inertia for those of torques, velocities are divided by their rms, and then the diagonal of W is 1.
// Note that our own residual is relative to the rms impulse instead: in scaled units |p|, which may be ten times |q| or a tenth of it (a
// packing carries more than one step's fall; contacts that are still open have a large b).
//
// Prints one line of JSON: version and solver of Siconos, contacts, iterations, its error, its info flag (0: converged), seconds.
#include "siconos.hpp"
#include <cmath>
#include <contact/core/problem_file.hpp>
#include <contact/plane/problem_file.hpp>
#include <contact/space/problem_file.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

using namespace nonsmooth;

namespace {

struct Arguments {
	std::string   in, out;
	oracle::Asked asked;
	bool          rolling = true;
	bool          measure = false;
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
		if (word == "--tolerance") a.asked.tolerance = number("--tolerance", next);
		else if (word == "--max-iterations")
			a.asked.maxIterations = int(number("--max-iterations", next));
		else if (word == "--check-every")
			a.asked.checkEvery = int(number("--check-every", next));
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

/// What is asked, of a problem of either dimension.
template <class Recorded> void answer(const Arguments& arguments, Recorded recorded)
{
	auto& problem = recorded.problem;
	bool  rolls   = false;
	for (const auto& c : problem.contacts)
		rolls = rolls || c.rollingArm > 0;
	const oracle::System system = oracle::systemOf(problem, arguments.rolling && rolls);
	oracle::Delassus     w      = oracle::delassus(system);
	if (arguments.measure) {
		const auto found = oracle::measure(w, w.scaled(system, oracle::impulsesOf(problem)));
		std::printf(
		        "{\"siconos\": \"%s\", \"error\": %.6e, \"scale_over_p\": %.6e}\n", NONSMOOTH_SICONOS_VERSION,
		        found.error, found.scaleOverImpulses);
		return;
	}
	const oracle::Solved solved = oracle::solve(w, arguments.asked);
	oracle::takeImpulses(problem, system, w.impulses(system, solved.p));
	write(arguments.out, recorded);
	std::printf(
	        "{\"siconos\": \"%s\", \"solver\": \"%s\", \"contacts\": %zu, \"iterations\": %d, \"error\": %.6e, \"info\": %d, \"seconds\": %.6f}\n",
	        NONSMOOTH_SICONOS_VERSION, solved.solver.c_str(), problem.contactCount(), solved.iterations,
	        solved.error, solved.info, solved.seconds);
}

} // namespace

int main(int argc, char** argv)
try {
	const Arguments arguments = parse(argc, argv);
	if (contact::dimensionOf(arguments.in) == 2) answer(arguments, contact::read(arguments.in));
	else
		answer(arguments, contact::space::read(arguments.in));
	return 0;
} catch (const std::exception& error) {
	std::fprintf(stderr, "siconos_solve: %s\n", error.what());
	return 2;
}
