// Asks Siconos to solve a problem in rows, or what it thinks of a solution.
#pragma once

#include "delassus.hpp"
#include <string>
#include <vector>

namespace nonsmooth::oracle {

struct Asked {
	double tolerance     = 1e-6; // on Siconos's error
	int    maxIterations = 10000;
	int    checkEvery    = 1;
};

struct Solved {
	std::string         solver     = "none";
	int                 info       = 0; // 0: converged
	int                 iterations = 0;
	double              error      = 0;
	double              seconds    = 0;
	std::vector<double> p; // scaled impulses
};

/// From a cold start. Not const: Siconos wants the numbers to be its own.
Solved solve(Delassus& w, const Asked& asked);

/// Siconos's error of given scaled impulses, and the size that it is relative to, over |p|.
struct Measured {
	double error = 0, scaleOverImpulses = 0;
};
Measured measure(Delassus& w, std::vector<double> p);

} // namespace nonsmooth::oracle
