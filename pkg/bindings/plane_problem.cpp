#include "problems.hpp"
#include <contact/plane/problem_file.hpp>

namespace nonsmooth::bindings {

using namespace nonsmooth::contact;

Problem planeOf(const py::dict& d)
{
	Problem    p;
	const auto mass   = take<Doubles>(d, "inverse_mass", -1, 3);
	const auto normal = take<Doubles>(d, "normal", -1, 2);
	const auto bodies = mass.shape(0), contacts = normal.shape(0);
	p.inverseMass  = items<InverseMass>(mass);
	p.freeVelocity = take<Twist>(d, "free_velocity", p.bodyCount());
	p.impulses     = take<Impulse>(d, "impulse", static_cast<std::size_t>(contacts));
	if (!d["position"].is_none()) p.positions = take<Point>(d, "position", p.bodyCount());
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

py::dict loadPlane(const std::string& path)
{
	const RecordedProblem r = read(path);
	const Problem&        p = r.problem;
	py::dict              d;
	d["time_step"]     = r.timeStep;
	d["inverse_mass"]  = array(p.inverseMass);
	d["free_velocity"] = array(p.freeVelocity);
	d["velocity"]      = array(p.velocities);
	d["position"]      = py::none();
	if (p.positions.size() == p.bodyCount() && p.bodyCount() > 0) d["position"] = array(p.positions);
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

void savePlane(const std::string& path, const py::dict& d)
{
	RecordedProblem r { planeOf(d), {}, py::cast<double>(d["time_step"]) };
	r.problem.velocities = take<Twist>(d, "velocity", r.problem.bodyCount());
	r.warmStart          = take<Impulse>(d, "warm_start", r.problem.contactCount());
	write(path, r);
}

} // namespace nonsmooth::bindings
