#include <algorithm>
#include <contact/plane/problem_file.hpp>
#include <contact/core/problem_hdf5.hpp>

namespace nonsmooth::contact {
namespace {

	template <class T> void putThree(const T& v, std::vector<double>& out, double T::*a, double T::*b, double T::*c)
	{
		out.insert(out.end(), { v.*a, v.*b, v.*c });
	}
	const auto twist = [](const Twist& v, std::vector<double>& out) {
		putThree(v, out, &Twist::x, &Twist::y, &Twist::w);
	};
	const auto mass = [](const InverseMass& v, std::vector<double>& out) {
		putThree(v, out, &InverseMass::x, &InverseMass::y, &InverseMass::w);
	};
	const auto impulse = [](const Impulse& v, std::vector<double>& out) {
		putThree(v, out, &Impulse::n, &Impulse::t, &Impulse::r);
	};

	void put(const Writer& put, const RecordedProblem& recorded)
	{
		const Problem& p = recorded.problem;
		put("/bodies/inverse_mass", flat(p.inverseMass, mass), 3);
		put("/bodies/free_velocity", flat(p.freeVelocity, twist), 3);
		put("/bodies/velocity", flat(p.velocities, twist), 3);
		if (!p.positions.empty())
			put("/bodies/position",
			    flat(p.positions,
			         [](const Point& x, std::vector<double>& out) {
				         out.insert(out.end(), { x.x, x.y });
			         }),
			    2);
		std::vector<int> pairs;
		for (const Contact& c : p.contacts)
			pairs.insert(pairs.end(), { c.i, c.j });
		put("/contacts/body", pairs, 2);
		const auto column = [&](const char* name, hsize_t columns, auto values) {
			put(name,
			    flat(p.contacts,
			         [&](const Contact& c, std::vector<double>& out) {
				         const auto v = values(c);
				         out.insert(out.end(), v.begin(), v.end());
			         }),
			    columns);
		};
		using Numbers = std::vector<double>;
		column("/contacts/normal", 2, [](const Contact& c) { return Numbers { c.nx, c.ny }; });
		column("/contacts/lever", 4, [](const Contact& c) {
			return Numbers { c.leverNi, c.leverTi, c.leverNj, c.leverTj };
		});
		column("/contacts/bias", 3, [](const Contact& c) { return Numbers { c.biasN, c.biasT, c.biasR }; });
		column("/contacts/adhesion", 1, [](const Contact& c) { return Numbers { c.adhesion }; });
		column("/contacts/friction", 1, [](const Contact& c) { return Numbers { c.friction }; });
		column("/contacts/rolling_arm", 1, [](const Contact& c) { return Numbers { c.rollingArm }; });
		column("/contacts/length", 1, [](const Contact& c) { return Numbers { c.length }; });
		if (std::any_of(p.contacts.begin(), p.contacts.end(), [](const Contact& c) { return c.play != 0; }))
			column("/contacts/play", 1, [](const Contact& c) { return Numbers { c.play }; });
		put("/contacts/warm_start", flat(recorded.warmStart, impulse), 3);
		put("/contacts/impulse", flat(p.impulses, impulse), 3);
	}

	RecordedProblem get(const Reader& get)
	{
		RecordedProblem recorded;
		recorded.timeStep    = get.timeStep();
		Problem&      p      = recorded.problem;
		const hsize_t bodies = get.rows("/bodies/inverse_mass", 3), contacts = get.rows("/contacts/normal", 2);

		const auto three = [&](const char* name, hsize_t count, auto& items) {
			const auto v = get(name, 3, count);
			items.resize(count);
			for (hsize_t k = 0; k < count; ++k)
				items[k] = { v[3 * k], v[3 * k + 1], v[3 * k + 2] };
		};
		three("/bodies/inverse_mass", bodies, p.inverseMass);
		three("/bodies/free_velocity", bodies, p.freeVelocity);
		three("/bodies/velocity", bodies, p.velocities);
		three("/contacts/warm_start", contacts, recorded.warmStart);
		three("/contacts/impulse", contacts, p.impulses);
		if (get.has("/bodies/position")) {
			const auto x = get("/bodies/position", 2, bodies);
			for (hsize_t k = 0; k < bodies; ++k)
				p.positions.push_back({ x[2 * k], x[2 * k + 1] });
		}
		const auto pairs  = get.pairs(contacts, bodies);
		const auto normal = get("/contacts/normal", 2, contacts), lever = get("/contacts/lever", 4, contacts),
		           bias     = get("/contacts/bias", 3, contacts);
		const auto adhesion = get("/contacts/adhesion", 1, contacts),
		           friction = get("/contacts/friction", 1, contacts);
		const auto arm      = get("/contacts/rolling_arm", 1, contacts),
		           length   = get("/contacts/length", 1, contacts);
		const auto play     = get.has("/contacts/play") ? get("/contacts/play", 1, contacts)
		                                                : std::vector<double>(contacts);
		for (hsize_t k = 0; k < contacts; ++k) {
			Contact c;
			c.i          = pairs[2 * k];
			c.j          = pairs[2 * k + 1];
			c.nx         = normal[2 * k];
			c.ny         = normal[2 * k + 1];
			c.leverNi    = lever[4 * k];
			c.leverTi    = lever[4 * k + 1];
			c.leverNj    = lever[4 * k + 2];
			c.leverTj    = lever[4 * k + 3];
			c.biasN      = bias[3 * k];
			c.biasT      = bias[3 * k + 1];
			c.biasR      = bias[3 * k + 2];
			c.adhesion   = adhesion[k];
			c.friction   = friction[k];
			c.rollingArm = arm[k];
			c.length     = length[k];
			c.play       = play[k];
			p.contacts.push_back(c);
		}
		return recorded;
	}

} // namespace

void write(const std::string& path, const RecordedProblem& recorded)
{
	writeProblem(path, 2, recorded.timeStep, [&recorded](const Writer& to) { put(to, recorded); });
}

RecordedProblem read(const std::string& path)
{
	RecordedProblem recorded;
	readProblem(path, 2, [&recorded](const Reader& from) { recorded = get(from); });
	return recorded;
}

} // namespace nonsmooth::contact
