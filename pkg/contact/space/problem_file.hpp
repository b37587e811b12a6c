// A contact problem in space as an HDF5 file; contact/plane/problem_file.hpp has the plane's.
//
// Groups and datasets (doubles, or 32-bit integers for `body`), b bodies and c contacts, units as in space/problem.hpp:
//     /                        attributes `format` (2), `dimension` (3) and `time_step` [s]
//     /bodies/inverse_mass     b×3   1/m_x, 1/m_y, 1/m_z; 0 where blocked
//     /bodies/inverse_inertia  b×6   xx, yy, zz, yz, zx, xy of the inverse tensor in the axes of the world
//     /bodies/free_velocity    b×6   v, ω                  /bodies/velocity       b×6   solution
//     /bodies/position         b×3   may be missing
//     /contacts/body           c×2   i, j                  /contacts/normal       c×3   from i to j
//     /contacts/lever          c×2   λ_i, λ_j              /contacts/aside        c×6   a_⊥ of i and j; may be missing
//     /contacts/bias           c×7   b_n, b_t, b_w
//     /contacts/adhesion, friction, rolling_arm, twisting_arm, length                   c each
//     /contacts/play           c     p [m/s]; missing where no bond closes freely
//     /contacts/warm_start     c×6   f, m of the impulses the solve began with
//     /contacts/impulse        c×6   solution
#pragma once

#include <contact/space/problem.hpp>
#include <string>

namespace nonsmooth::contact::space {

/// As in the plane.
struct RecordedProblem {
	Problem              problem;
	std::vector<Impulse> warmStart;
	double               timeStep = 0; // h [s]
};

/// As in the plane: a whole file or none, and std::runtime_error naming the file, what is wrong and what helps.
void            write(const std::string& path, const RecordedProblem& recorded);
RecordedProblem read(const std::string& path);

} // namespace nonsmooth::contact::space
