// A contact problem as an HDF5 file: what one step had to solve, what it started from and what it found.
//
// Groups and datasets (doubles, or 32-bit integers for `body`), b bodies and c contacts, units as in problem.hpp:
//     /                        attributes `format` (2), `dimension` (2; space/problem_file.hpp has 3) and `time_step` [s]
//     /bodies/inverse_mass     b×3   1/m_x, 1/m_y, 1/I; 0 where blocked      /bodies/free_velocity  b×3
//     /bodies/position         b×2   may be missing                          /bodies/velocity       b×3   solution
//     /contacts/body           c×2   i, j                                    /contacts/normal       c×2   from i to j
//     /contacts/lever          c×4   λn_i, λt_i, λn_j, λt_j                  /contacts/bias         c×3   b_n, b_t, b_r
//     /contacts/adhesion, /contacts/friction, /contacts/rolling_arm, /contacts/length                   c each
//     /contacts/play           c     p [m/s]; missing where no bond closes freely
//     /contacts/warm_start     c×3   impulses the solve began with           /contacts/impulse      c×3   solution
// A file of format 1, which has no attribute `dimension`, is read as well.
#pragma once

#include <contact/core/problem_file.hpp>
#include <contact/plane/problem.hpp>
#include <string>

namespace nonsmooth::contact {

/// A problem with the impulses its solve began with; `problem.impulses` and `problem.velocities` hold the solution.
struct RecordedProblem {
	Problem              problem;
	std::vector<Impulse> warmStart;
	double               timeStep = 0; // h [s]
};

/// Writes beside and renames (whole_file.hpp), so that no half-written file is ever there. Throws std::runtime_error
/// naming the file and what helps.
void write(const std::string& path, const RecordedProblem& recorded);

/// Throws std::runtime_error naming the file and what is missing or wrong in it: shapes, kinds of numbers, bodies that
/// are not there, sizes that the file cannot hold. Values are the solver's to refuse (problem_check.hpp).
RecordedProblem read(const std::string& path);

} // namespace nonsmooth::contact
