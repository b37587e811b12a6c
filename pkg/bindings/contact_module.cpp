// The solver library for Python, as _nonsmooth_contact: arrays in, arrays out. No YADE here; nonsmooth/contact.py is the face of it.
#include <algorithm>
#include <array>
#include <chrono>
#include <contact/memory_stream.hpp>
#include <contact/problem.hpp>
#include <contact/problem_check.hpp>
#include <contact/problem_file.hpp>
#include <contact/residual.hpp>
#include <contact/solver.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace nonsmooth::contact;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Ints    = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

/// The array of a dictionary's key, checked: `columns` 0 stands for a list.
template <class Array> Array take(const py::dict& from, const char* key, py::ssize_t rows, py::ssize_t columns)
{
	if (!from.contains(key)) throw py::key_error(std::string("contact problem: ") + key + " is missing");
	Array      array = py::cast<Array>(from[key]);
	const bool fits  = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
	if (!fits || (rows >= 0 && array.shape(0) != rows))
		throw py::value_error(
		        std::string("contact problem: ") + key + " must have the shape ("
		        + (rows >= 0 ? std::to_string(rows) : "n") + ", " + (columns ? std::to_string(columns) : "")
		        + ")");
	return array;
}

template <class Item> std::vector<Item> triples(const Doubles& a)
{
	std::vector<Item> items;
	const auto        v = a.unchecked<2>();
	for (py::ssize_t k = 0; k < v.shape(0); ++k)
		items.push_back({ v(k, 0), v(k, 1), v(k, 2) });
	return items;
}

template <class Item> Doubles array(const std::vector<Item>& items)
{
	static_assert(sizeof(Item) == 3 * sizeof(double), "three numbers side by side");
	Doubles result({ py::ssize_t(items.size()), py::ssize_t(3) });
	std::copy_n(reinterpret_cast<const double*>(items.data()), 3 * items.size(), result.mutable_data());
	return result;
}

/// What numbers(item) puts out for each item, a row of `columns`; a list where they are 0.
template <class Number, class Item, class Numbers>
py::array_t<Number> table(const std::vector<Item>& items, py::ssize_t columns, Numbers numbers)
{
	const auto          rows = static_cast<py::ssize_t>(items.size());
	py::array_t<Number> result(
	        columns ? std::vector<py::ssize_t> { rows, columns } : std::vector<py::ssize_t> { rows });
	Number* to = result.mutable_data();
	for (const Item& item : items)
		for (const Number x : numbers(item))
			*to++ = x;
	return result;
}

Problem problemOf(const py::dict& d)
{
	Problem    p;
	const auto mass   = take<Doubles>(d, "inverse_mass", -1, 3);
	const auto normal = take<Doubles>(d, "normal", -1, 2);
	const auto bodies = mass.shape(0), contacts = normal.shape(0);
	p.inverseMass  = triples<InverseMass>(mass);
	p.freeVelocity = triples<Twist>(take<Doubles>(d, "free_velocity", bodies, 3));
	p.impulses     = triples<Impulse>(take<Doubles>(d, "impulse", contacts, 3));
	if (!d["position"].is_none()) {
		const auto x = take<Doubles>(d, "position", bodies, 2).unchecked<2>();
		for (py::ssize_t k = 0; k < bodies; ++k)
			p.positions.push_back({ x(k, 0), x(k, 1) });
	}
	const auto bodyArray     = take<Ints>(d, "body", contacts, 2);
	const auto leverArray    = take<Doubles>(d, "lever", contacts, 4),
	           biasArray     = take<Doubles>(d, "bias", contacts, 3);
	const auto adhesionArray = take<Doubles>(d, "adhesion", contacts, 0),
	           frictionArray = take<Doubles>(d, "friction", contacts, 0);
	const auto armArray      = take<Doubles>(d, "rolling_arm", contacts, 0),
	           lengthArray   = take<Doubles>(d, "length", contacts, 0);
	const auto body          = bodyArray.unchecked<2>();
	const auto n = normal.unchecked<2>(), lever = leverArray.unchecked<2>(), bias = biasArray.unchecked<2>();
	const auto adhesion = adhesionArray.unchecked<1>(), friction = frictionArray.unchecked<1>(),
	           arm = armArray.unchecked<1>(), length = lengthArray.unchecked<1>();
	Doubles playArray(std::vector<py::ssize_t> { 0 });
	if (!d["play"].is_none()) playArray = take<Doubles>(d, "play", contacts, 0);
	const auto play = playArray.unchecked<1>();
	for (py::ssize_t k = 0; k < contacts; ++k) {
		Contact c;
		c.i          = body(k, 0);
		c.j          = body(k, 1);
		c.nx         = n(k, 0);
		c.ny         = n(k, 1);
		c.leverNi    = lever(k, 0);
		c.leverTi    = lever(k, 1);
		c.leverNj    = lever(k, 2);
		c.leverTj    = lever(k, 3);
		c.biasN      = bias(k, 0);
		c.biasT      = bias(k, 1);
		c.biasR      = bias(k, 2);
		c.adhesion   = adhesion(k);
		c.friction   = friction(k);
		c.rollingArm = arm(k);
		c.length     = length(k);
		c.play       = play.shape(0) > 0 ? play(k) : 0;
		if (c.i < 0 || c.j < 0 || c.i >= bodies || c.j >= bodies)
			throw py::value_error(
			        "contact problem: contact " + std::to_string(k) + " names a body that is not there");
		p.contacts.push_back(c);
	}
	return p;
}

/// A file's problem under the names of nonsmooth.contact.ContactProblem. The lock of Python is kept: HDF5 serves one thread at a time, and h5py too.
py::dict loadFile(const std::string& path)
{
	const RecordedProblem r = read(path);
	const Problem&        p = r.problem;
	py::dict              d;
	d["time_step"]     = r.timeStep;
	d["inverse_mass"]  = array(p.inverseMass);
	d["free_velocity"] = array(p.freeVelocity);
	d["velocity"]      = array(p.velocities);
	d["position"]      = py::none();
	if (p.positions.size() == p.bodyCount() && p.bodyCount() > 0)
		d["position"] = table<double>(p.positions, 2, [](const Point& x) { return std::array { x.x, x.y }; });
	d["body"]        = table<std::int32_t>(p.contacts, 2, [](const Contact& c) { return std::array { c.i, c.j }; });
	d["normal"]      = table<double>(p.contacts, 2, [](const Contact& c) { return std::array { c.nx, c.ny }; });
	d["lever"]       = table<double>(p.contacts, 4, [](const Contact& c) {
                return std::array { c.leverNi, c.leverTi, c.leverNj, c.leverTj };
        });
	d["bias"]        = table<double>(p.contacts, 3, [](const Contact& c) {
                return std::array { c.biasN, c.biasT, c.biasR };
        });
	d["adhesion"]    = table<double>(p.contacts, 0, [](const Contact& c) { return std::array { c.adhesion }; });
	d["friction"]    = table<double>(p.contacts, 0, [](const Contact& c) { return std::array { c.friction }; });
	d["rolling_arm"] = table<double>(p.contacts, 0, [](const Contact& c) { return std::array { c.rollingArm }; });
	d["length"]      = table<double>(p.contacts, 0, [](const Contact& c) { return std::array { c.length }; });
	d["warm_start"]  = array(r.warmStart);
	d["impulse"]     = array(p.impulses);
	d["play"]        = py::none();
	if (std::any_of(p.contacts.begin(), p.contacts.end(), [](const Contact& c) { return c.play != 0; }))
		d["play"] = table<double>(p.contacts, 0, [](const Contact& c) { return std::array { c.play }; });
	return d;
}

void saveFile(const std::string& path, const py::dict& d)
{
	RecordedProblem r { problemOf(d), {}, py::cast<double>(d["time_step"]) };
	r.problem.velocities = triples<Twist>(
	        take<Doubles>(d, "velocity", static_cast<py::ssize_t>(r.problem.bodyCount()), 3));
	r.warmStart = triples<Impulse>(
	        take<Doubles>(d, "warm_start", static_cast<py::ssize_t>(r.problem.contactCount()), 3));
	write(path, r);
}

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

py::dict solveArrays(
        const py::dict& problem, const std::string& method, double tolerance, int maxIterations, int checkEvery,
        int threads, const std::string& stopping, const std::string& path, const std::string& precision)
{
	Problem        p = problemOf(problem);
	SolverSettings s;
	for (const BlockKernels* kernels : availableKernels())
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

py::dict residualOf(const py::dict& problem)
{
	const Problem       p     = problemOf(problem);
	const SpeedResidual speed = naturalMapSpeeds(p);
	py::dict            d     = dictOf(naturalMapResidual(p));
	d["speed_rms"]            = speed.rms;
	d["speed_largest"]        = speed.largest;
	d["defect"]               = array(naturalMapDefects(p));
	d["velocity"]             = array(velocitiesOf(p));
	return d;
}

py::dict changesOf(const py::dict& problem) { return dictOf(velocityChanges(problemOf(problem))); }

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
	m.def("load", &loadFile);
	m.def("save", &saveFile);
	m.def("solve", &solveArrays);
	m.def("residual", &residualOf);
	m.def("velocity_changes", &changesOf);
	m.def("stream_seconds", &streamSeconds);
	m.attr("bytes_per_contact") = double(sizeof(Block<float>)) / lanes;
	m.attr("kernels")           = kernelNames();
	m.attr("most_threads")      = mostThreads;
	m.attr("most_check_every")  = mostCheckEvery;
	m.attr("compiler")          = NONSMOOTH_COMPILER;
}
