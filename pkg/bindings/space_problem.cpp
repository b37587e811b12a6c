#include "problems.hpp"
#include <contact/space/problem_file.hpp>

namespace nonsmooth::bindings {

using namespace nonsmooth::contact::space;

namespace {

	struct Arms {
		Vector i, j;
	};
	struct Bias {
		double n = 0;
		Vector t, w;
	};
	struct Levers {
		double i = 0, j = 0;
	};
	struct AxisMasses {
		double x = 0, y = 0, z = 0;
	};

	std::vector<double> numbers(const py::dict& d, const char* key, std::size_t rows)
	{
		const auto a = take<Doubles>(d, key, static_cast<py::ssize_t>(rows), 0);
		return { a.data(), a.data() + a.size() };
	}

	/// What of(contact) is for each contact.
	template <class Of> py::array_t<double> column(const Problem& p, Of of)
	{
		return table<double>(p.contacts, 0, [&of](const Contact& c) { return std::array { of(c) }; });
	}

} // namespace

Problem spaceOf(const py::dict& d)
{
	Problem    p;
	const auto mass    = items<AxisMasses>(take<Doubles>(d, "inverse_mass", -1, 3));
	const auto normals = items<Vector>(take<Doubles>(d, "normal", -1, 3));
	const auto bodies = mass.size(), contacts = normals.size();
	const auto inertia = take<Symmetric>(d, "inverse_inertia", bodies);
	for (std::size_t b = 0; b < bodies; ++b)
		p.inverseMass.push_back({ mass[b].x, mass[b].y, mass[b].z, inertia[b] });
	p.freeVelocity = take<Twist>(d, "free_velocity", bodies);
	p.impulses     = take<Impulse>(d, "impulse", contacts);
	if (!d["position"].is_none()) p.positions = take<Vector>(d, "position", bodies);
	const auto body     = take<Ints>(d, "body", static_cast<py::ssize_t>(contacts), 2);
	const auto lever    = take<Levers>(d, "lever", contacts);
	const auto bias     = take<Bias>(d, "bias", contacts);
	const auto aside    = d["aside"].is_none() ? std::vector<Arms>(contacts) : take<Arms>(d, "aside", contacts);
	const auto play     = d["play"].is_none() ? std::vector<double>(contacts) : numbers(d, "play", contacts);
	const auto adhesion = numbers(d, "adhesion", contacts), friction = numbers(d, "friction", contacts),
	           rolling = numbers(d, "rolling_arm", contacts), twisting = numbers(d, "twisting_arm", contacts),
	           length = numbers(d, "length", contacts);
	for (std::size_t k = 0; k < contacts; ++k) {
		Contact c;
		c.i           = body.at(k, 0);
		c.j           = body.at(k, 1);
		c.n           = normals[k];
		c.leverI      = lever[k].i;
		c.leverJ      = lever[k].j;
		c.asideI      = aside[k].i;
		c.asideJ      = aside[k].j;
		c.biasN       = bias[k].n;
		c.biasT       = bias[k].t;
		c.biasW       = bias[k].w;
		c.adhesion    = adhesion[k];
		c.friction    = friction[k];
		c.rollingArm  = rolling[k];
		c.twistingArm = twisting[k];
		c.length      = length[k];
		c.play        = play[k];
		for (const std::int32_t b : { c.i, c.j })
			if (b < 0 || std::size_t(b) >= bodies)
				throw py::value_error(
				        "contact problem: contact " + std::to_string(k)
				        + " names a body that is not there");
		p.contacts.push_back(c);
	}
	return p;
}

py::dict loadSpace(const std::string& path)
{
	const RecordedProblem r = read(path);
	const Problem&        p = r.problem;
	py::dict              d;
	d["time_step"]       = r.timeStep;
	d["inverse_mass"]    = table<double>(p.inverseMass, 3, [](const InverseMass& m) {
                return std::array { m.x, m.y, m.z };
        });
	d["inverse_inertia"] = table<double>(p.inverseMass, 6, [](const InverseMass& m) {
		const Symmetric& s = m.inertia;
		return std::array { s.xx, s.yy, s.zz, s.yz, s.zx, s.xy };
	});
	d["free_velocity"]   = array(p.freeVelocity);
	d["velocity"]        = array(p.velocities);
	d["position"]        = py::none();
	if (p.positions.size() == p.bodyCount() && p.bodyCount() > 0) d["position"] = array(p.positions);
	d["body"]   = table<std::int32_t>(p.contacts, 2, [](const Contact& c) { return std::array { c.i, c.j }; });
	d["normal"] = table<double>(p.contacts, 3, [](const Contact& c) { return std::array { c.n.x, c.n.y, c.n.z }; });
	d["lever"]  = table<double>(p.contacts, 2, [](const Contact& c) { return std::array { c.leverI, c.leverJ }; });
	d["bias"]   = table<double>(p.contacts, 7, [](const Contact& c) {
                return std::array { c.biasN, c.biasT.x, c.biasT.y, c.biasT.z, c.biasW.x, c.biasW.y, c.biasW.z };
        });
	d["adhesion"]     = column(p, [](const Contact& c) { return c.adhesion; });
	d["friction"]     = column(p, [](const Contact& c) { return c.friction; });
	d["rolling_arm"]  = column(p, [](const Contact& c) { return c.rollingArm; });
	d["twisting_arm"] = column(p, [](const Contact& c) { return c.twistingArm; });
	d["length"]       = column(p, [](const Contact& c) { return c.length; });
	d["warm_start"]   = array(r.warmStart);
	d["impulse"]      = array(p.impulses);
	d["aside"]        = py::none();
	d["play"]         = py::none();
	const auto any    = [&p](auto has) { return std::any_of(p.contacts.begin(), p.contacts.end(), has); };
	if (any([](const Contact& c) { return !isZero(c.asideI) || !isZero(c.asideJ); }))
		d["aside"] = table<double>(p.contacts, 6, [](const Contact& c) {
			return std::array { c.asideI.x, c.asideI.y, c.asideI.z, c.asideJ.x, c.asideJ.y, c.asideJ.z };
		});
	if (any([](const Contact& c) { return c.play != 0; }))
		d["play"] = column(p, [](const Contact& c) { return c.play; });
	return d;
}

void saveSpace(const std::string& path, const py::dict& d)
{
	RecordedProblem r { spaceOf(d), {}, py::cast<double>(d["time_step"]) };
	r.problem.velocities = take<Twist>(d, "velocity", r.problem.bodyCount());
	r.warmStart          = take<Impulse>(d, "warm_start", r.problem.contactCount());
	write(path, r);
}

} // namespace nonsmooth::bindings
