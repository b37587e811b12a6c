// The solver library for Python, as _nonsmooth_contact: arrays in, arrays out. No YADE here; nonsmooth/contact.py is
// the face of it.
#include "problems.hpp"
#include <chrono>
#include <contact/plane/memory_stream.hpp>
#include <contact/plane/problem_check.hpp>
#include <contact/plane/problem_file.hpp>
#include <contact/plane/residual.hpp>
#include <contact/plane/solver.hpp>
#include <contact/space/residual.hpp>
#include <contact/space/solver.hpp>

using namespace nonsmooth::bindings;
using namespace nonsmooth::contact;

namespace {

py::dict dictOf(const Residual& r)
{
	py::dict d;
	d["relative"]            = r.relative();
	d["rms"]                 = r.rms;
	d["largest"]             = r.largest;
	d["scale"]               = r.scale;
	d["speed_share"]         = r.speed;
	d["speed_share_largest"] = r.largestSpeed;
	return d;
}

py::dict dictOf(const VelocityChanges& c)
{
	py::dict d;
	d["velocity"]         = c.velocity;
	d["largest_velocity"] = c.largestVelocity;
	d["work"]             = c.work;
	d["largest_work"]     = c.largestWork;
	d["drift"]            = c.drift;
	d["quad"]             = c.figure(StoppingTest::Quad);
	d["maxm"]             = c.figure(StoppingTest::Maxm);
	d["qm16"]             = c.figure(StoppingTest::QM16);
	return d;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Ways through the sweep that this processor can go, the fastest first.
std::vector<std::string> kernelNames()
{
	std::vector<std::string> names;
	for (const BlockKernels* kernels : availableKernels())
		names.push_back(kernels->name);
	return names;
}

template <class Problem, class Settings>
py::dict solveProblem(
        Problem p, Settings s, const std::vector<decltype(s.kernels)>& available, const std::string& method,
        double tolerance, int maxIterations, int checkEvery, int threads, const std::string& stopping,
        const std::string& path, const std::string& precision)
{
	for (const auto* kernels : available)
		if (path == kernels->name) s.kernels = kernels;
	s.reference = path == "reference";
	if (!s.kernels && !s.reference && path != "best") {
		std::string names;
		for (const std::string& name : kernelNames())
			names += "'" + name + "', ";
		throw py::value_error("path = '" + path + "': it must be 'best', " + names + "or 'reference'");
	}
	s.tolerance      = tolerance;
	s.maxIterations  = maxIterations;
	s.checkEvery     = checkEvery;
	s.threads        = threads;
	const auto named = [](const char* name, const std::string& value, auto look) {
		try {
			return look(value.c_str());
		} catch (const std::invalid_argument& error) {
			throw py::value_error(std::string(name) + " = " + error.what());
		}
	};
	s.method    = named("method", method, methodOf);
	s.precision = named("precision", precision, precisionOf);
	s.stopping  = named("stopping", stopping, stoppingTestOf);
	SolverStatistics statistics;
	double           seconds = 0;
	{
		py::gil_scoped_release release;
		const double           begin = now();
		statistics                   = solve(p, s);
		seconds                      = now() - begin;
	}
	py::dict d      = dictOf(statistics.residual);
	d["impulse"]    = array(p.impulses);
	d["velocity"]   = array(p.velocities);
	d["iterations"] = statistics.iterations;
	d["in_single"]  = statistics.inSingle;
	d["restarts"]   = statistics.restarts;
	d["patches"]    = statistics.patches;
	d["converged"]  = statistics.converged;
	d["seconds"]    = seconds;
	return d;
}

py::dict solvePlane(
        const py::dict& problem, const std::string& method, double tolerance, int maxIterations, int checkEvery,
        int threads, const std::string& stopping, const std::string& path, const std::string& precision)
{
	return solveProblem(
	        planeOf(problem), SolverSettings {}, availableKernels(), method, tolerance, maxIterations, checkEvery,
	        threads, stopping, path, precision);
}

py::dict solveSpace(
        const py::dict& problem, const std::string& method, double tolerance, int maxIterations, int checkEvery,
        int threads, const std::string& stopping, const std::string& path, const std::string& precision)
{
	return solveProblem(
	        spaceOf(problem), space::SolverSettings {}, space::availableKernels(), method, tolerance, maxIterations,
	        checkEvery, threads, stopping, path, precision);
}

template <class Problem> py::dict residualOf(const Problem& p)
{
	const SpeedResidual speed = naturalMapSpeeds(p);
	py::dict            d     = dictOf(naturalMapResidual(p));
	d["speed_rms"]            = speed.rms;
	d["speed_largest"]        = speed.largest;
	d["defect"]               = array(naturalMapDefects(p));
	d["velocity"]             = array(velocitiesOf(p));
	return d;
}

/// A file's problem, with its dimension beside its arrays.
py::dict load(const std::string& path)
{
	const int dimension = dimensionOf(path);
	py::dict  d         = dimension == 2 ? loadPlane(path) : loadSpace(path);
	d["dimension"]      = dimension;
	return d;
}

/// Wall time [s] of each of `passes` over `bytes` of memory, by one thread.
std::vector<double> streamSeconds(std::size_t bytes, int passes)
{
	if (bytes < sizeof(Motion<double>) || passes < 1) throw py::value_error("bytes and passes must be positive");
	MemoryStream stream(bytes);
	stream.pass();
	std::vector<double> seconds;
	for (int k = 0; k < passes; ++k) {
		const double begin = now();
		stream.pass();
		seconds.push_back(now() - begin);
	}
	return seconds;
}

} // namespace

PYBIND11_MODULE(_nonsmooth_contact, m)
{
	m.doc() = "Solver of yade-nonsmooth's contact problems; use nonsmooth.contact.";
	m.def("load", &load);
	m.def("save", &savePlane);
	m.def("save_space", &saveSpace);
	m.def("solve", &solvePlane);
	m.def("solve_space", &solveSpace);
	m.def("residual", [](const py::dict& problem) { return residualOf(planeOf(problem)); });
	m.def("residual_space", [](const py::dict& problem) { return residualOf(spaceOf(problem)); });
	m.def("velocity_changes", [](const py::dict& problem) { return dictOf(velocityChanges(planeOf(problem))); });
	m.def("velocity_changes_space",
	      [](const py::dict& problem) { return dictOf(space::velocityChanges(spaceOf(problem))); });
	m.def("stream_seconds", &streamSeconds);
	m.attr("bytes_per_contact")       = double(sizeof(Block<float>)) / lanes;
	m.attr("bytes_per_contact_space") = double(sizeof(space::Block<float>)) / lanes;
	m.attr("kernels")                 = kernelNames();
	m.attr("most_threads")            = mostThreads;
	m.attr("most_check_every")        = mostCheckEvery;
	m.attr("compiler")                = NONSMOOTH_COMPILER;
}
