#include <algorithm>
#include <contact/core/problem_hdf5.hpp>
#include <contact/space/problem_file.hpp>

namespace nonsmooth::contact::space {
namespace {

	void       append(std::vector<double>& out, const Vector& a) { out.insert(out.end(), { a.x, a.y, a.z }); }
	const auto twist   = [](const Twist& v, std::vector<double>& out) { append(out, v.v), append(out, v.w); };
	const auto impulse = [](const Impulse& p, std::vector<double>& out) { append(out, p.f), append(out, p.m); };
	Vector     vectorAt(const std::vector<double>& from, std::size_t at)
	{
		return { from[at], from[at + 1], from[at + 2] };
	}

	void put(const Writer& put, const RecordedProblem& recorded)
	{
		const Problem& p = recorded.problem;
		put("/bodies/inverse_mass",
		    flat(p.inverseMass,
		         [](const InverseMass& m, std::vector<double>& out) {
			         append(out, { m.x, m.y, m.z });
		         }),
		    3);
		put("/bodies/inverse_inertia",
		    flat(p.inverseMass,
		         [](const InverseMass& m, std::vector<double>& out) {
			         const Symmetric& s = m.inertia;
			         append(out, { s.xx, s.yy, s.zz }), append(out, { s.yz, s.zx, s.xy });
		         }),
		    6);
		put("/bodies/free_velocity", flat(p.freeVelocity, twist), 6);
		put("/bodies/velocity", flat(p.velocities, twist), 6);
		if (!p.positions.empty())
			put("/bodies/position",
			    flat(p.positions, [](const Vector& x, std::vector<double>& out) { append(out, x); }), 3);
		std::vector<int> pairs;
		for (const Contact& c : p.contacts)
			pairs.insert(pairs.end(), { c.i, c.j });
		put("/contacts/body", pairs, 2);
		const auto column = [&](const char* name, hsize_t columns, auto append) {
			put(name, flat(p.contacts, append), columns);
		};
		using Out = std::vector<double>;
		column("/contacts/normal", 3, [](const Contact& c, Out& out) { append(out, c.n); });
		column("/contacts/lever", 2, [](const Contact& c, Out& out) {
			out.insert(out.end(), { c.leverI, c.leverJ });
		});
		column("/contacts/bias", 7, [](const Contact& c, Out& out) {
			out.push_back(c.biasN), append(out, c.biasT), append(out, c.biasW);
		});
		const auto any = [&p](auto has) { return std::any_of(p.contacts.begin(), p.contacts.end(), has); };
		if (any([](const Contact& c) { return !isZero(c.asideI) || !isZero(c.asideJ); }))
			column("/contacts/aside", 6,
			       [](const Contact& c, Out& out) { append(out, c.asideI), append(out, c.asideJ); });
		if (any([](const Contact& c) { return c.play != 0; }))
			column("/contacts/play", 1, [](const Contact& c, Out& out) { out.push_back(c.play); });
		column("/contacts/adhesion", 1, [](const Contact& c, Out& out) { out.push_back(c.adhesion); });
		column("/contacts/friction", 1, [](const Contact& c, Out& out) { out.push_back(c.friction); });
		column("/contacts/rolling_arm", 1, [](const Contact& c, Out& out) { out.push_back(c.rollingArm); });
		column("/contacts/twisting_arm", 1, [](const Contact& c, Out& out) { out.push_back(c.twistingArm); });
		column("/contacts/length", 1, [](const Contact& c, Out& out) { out.push_back(c.length); });
		put("/contacts/warm_start", flat(recorded.warmStart, impulse), 6);
		put("/contacts/impulse", flat(p.impulses, impulse), 6);
	}

	void getContacts(const Reader& get, hsize_t bodies, hsize_t contacts, std::vector<Contact>& result)
	{
		const auto pairs  = get.pairs(contacts, bodies);
		const auto number = [&](const char* name, hsize_t columns) { return get(name, columns, contacts); };
		const auto maybe  = [&](const char* name, hsize_t columns) {
                        return get.has(name) ? number(name, columns) : std::vector<double>(contacts * columns);
		};
		const auto normal = number("/contacts/normal", 3), lever = number("/contacts/lever", 2),
		           bias = number("/contacts/bias", 7), aside = maybe("/contacts/aside", 6),
		           adhesion = number("/contacts/adhesion", 1), friction = number("/contacts/friction", 1),
		           rolling = number("/contacts/rolling_arm", 1), twisting = number("/contacts/twisting_arm", 1),
		           length = number("/contacts/length", 1), play = maybe("/contacts/play", 1);
		for (hsize_t k = 0; k < contacts; ++k) {
			Contact c;
			c.i           = pairs[2 * k];
			c.j           = pairs[2 * k + 1];
			c.n           = vectorAt(normal, 3 * k);
			c.leverI      = lever[2 * k];
			c.leverJ      = lever[2 * k + 1];
			c.asideI      = vectorAt(aside, 6 * k);
			c.asideJ      = vectorAt(aside, 6 * k + 3);
			c.biasN       = bias[7 * k];
			c.biasT       = vectorAt(bias, 7 * k + 1);
			c.biasW       = vectorAt(bias, 7 * k + 4);
			c.adhesion    = adhesion[k];
			c.friction    = friction[k];
			c.rollingArm  = rolling[k];
			c.twistingArm = twisting[k];
			c.length      = length[k];
			c.play        = play[k];
			result.push_back(c);
		}
	}

	RecordedProblem get(const Reader& get)
	{
		RecordedProblem recorded;
		recorded.timeStep    = get.timeStep();
		Problem&      p      = recorded.problem;
		const hsize_t bodies = get.rows("/bodies/inverse_mass", 3), contacts = get.rows("/contacts/normal", 3);
		const auto    mass = get("/bodies/inverse_mass", 3, bodies),
		           inertia = get("/bodies/inverse_inertia", 6, bodies);
		for (hsize_t b = 0; b < bodies; ++b) {
			const double *m = &mass[3 * b], *s = &inertia[6 * b];
			p.inverseMass.push_back({ m[0], m[1], m[2], { s[0], s[1], s[2], s[3], s[4], s[5] } });
		}
		const auto pairsOf = [&](const char* name, hsize_t count, auto& items) {
			const auto v = get(name, 6, count);
			items.resize(count);
			for (hsize_t k = 0; k < count; ++k)
				items[k] = { vectorAt(v, 6 * k), vectorAt(v, 6 * k + 3) };
		};
		pairsOf("/bodies/free_velocity", bodies, p.freeVelocity);
		pairsOf("/bodies/velocity", bodies, p.velocities);
		pairsOf("/contacts/warm_start", contacts, recorded.warmStart);
		pairsOf("/contacts/impulse", contacts, p.impulses);
		if (get.has("/bodies/position")) {
			const auto x = get("/bodies/position", 3, bodies);
			for (hsize_t b = 0; b < bodies; ++b)
				p.positions.push_back(vectorAt(x, 3 * b));
		}
		getContacts(get, bodies, contacts, p.contacts);
		return recorded;
	}

} // namespace

void write(const std::string& path, const RecordedProblem& recorded)
{
	writeProblem(path, 3, recorded.timeStep, [&recorded](const Writer& to) { put(to, recorded); });
}

RecordedProblem read(const std::string& path)
{
	RecordedProblem recorded;
	readProblem(path, 3, [&recorded](const Reader& from) { recorded = get(from); });
	return recorded;
}

} // namespace nonsmooth::contact::space
