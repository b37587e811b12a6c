// Problems of the plane and of space as dictionaries of arrays, under the names of nonsmooth.contact.ContactProblem and
// SpaceProblem.
#pragma once

#include "arrays.hpp"
#include <contact/plane/problem.hpp>
#include <contact/space/problem.hpp>

namespace nonsmooth::bindings {

/// Throw KeyError or ValueError naming the array that is missing or does not fit.
contact::Problem        planeOf(const py::dict& arrays);
contact::space::Problem spaceOf(const py::dict& arrays);

/// A file's problem. The lock of Python is kept: HDF5 serves one thread at a time, and h5py too.
py::dict loadPlane(const std::string& path);
py::dict loadSpace(const std::string& path);
void     savePlane(const std::string& path, const py::dict& arrays);
void     saveSpace(const std::string& path, const py::dict& arrays);

} // namespace nonsmooth::bindings
