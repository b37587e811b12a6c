#include <contact/problem_file.hpp>
#include <cstdio>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <stdexcept>

namespace nonsmooth::contact {
namespace {

	constexpr int format = 1;

	/// An open file or group that closes itself.
	class Handle {
	public:
		Handle(hid_t id_, herr_t (*close_)(hid_t))
		        : id(id_)
		        , close(close_)
		{
		}
		Handle(const Handle&) = delete;
		Handle& operator=(const Handle&) = delete;
		~Handle()
		{
			if (id >= 0) close(id);
		}
		operator hid_t() const { return id; }

	private:
		hid_t id;
		herr_t (*close)(hid_t);
	};

	/// The library prints a stack of errors of its own; ours say what the user needs.
	void quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

	[[noreturn]] void fail(const std::string& path, const std::string& why) { throw std::runtime_error("contact problem " + path + ": " + why); }

	/// Rows of `columns` numbers: a rows × columns dataset, or a plain list for one column.
	struct Writer {
		const std::string& path;
		hid_t              file;

		void operator()(const char* name, const std::vector<double>& values, hsize_t columns) const
		{
			const hsize_t size[2] = { values.size() / columns, columns };
			if (H5LTmake_dataset_double(file, name, columns > 1 ? 2 : 1, size, values.data()) < 0) fail(path, std::string("cannot write ") + name);
		}
	};

	struct Reader {
		const std::string& path;
		hid_t              file;

		bool has(const char* name) const { return H5LTpath_valid(file, name, 1) > 0; }

		hsize_t rows(const char* name, hsize_t columns) const
		{
			int     rank    = 0;
			hsize_t size[8] = {};
			if (!has(name) || H5LTget_dataset_ndims(file, name, &rank) < 0) fail(path, std::string("has no dataset ") + name);
			if (rank != (columns > 1 ? 2 : 1) || H5LTget_dataset_info(file, name, size, nullptr, nullptr) < 0 || (rank == 2 && size[1] != columns))
				fail(path, std::string(name) + " must have " + std::to_string(columns) + " column(s)");
			return size[0];
		}

		std::vector<double> operator()(const char* name, hsize_t columns, hsize_t wanted) const
		{
			const hsize_t count = rows(name, columns);
			if (count != wanted)
				fail(path, std::string(name) + " has " + std::to_string(count) + " rows where " + std::to_string(wanted) + " are needed");
			std::vector<double> values(count * columns);
			if (!values.empty() && H5LTread_dataset_double(file, name, values.data()) < 0) fail(path, std::string("cannot read ") + name);
			return values;
		}
	};

	template <class Item, class Put> std::vector<double> flat(const std::vector<Item>& items, Put put)
	{
		std::vector<double> values;
		for (const Item& item : items)
			put(item, values);
		return values;
	}

	template <class T> void putThree(const T& v, std::vector<double>& out, double T::*a, double T::*b, double T::*c)
	{
		out.insert(out.end(), { v.*a, v.*b, v.*c });
	}
	const auto twist   = [](const Twist& v, std::vector<double>& out) { putThree(v, out, &Twist::x, &Twist::y, &Twist::w); };
	const auto mass    = [](const InverseMass& v, std::vector<double>& out) { putThree(v, out, &InverseMass::x, &InverseMass::y, &InverseMass::w); };
	const auto impulse = [](const Impulse& v, std::vector<double>& out) { putThree(v, out, &Impulse::n, &Impulse::t, &Impulse::r); };

} // namespace

void write(const std::string& path, const RecordedProblem& recorded)
{
	quiet();
	const Problem&    p    = recorded.problem;
	const std::string part = path + ".part";
	try {
		const Handle file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
		if (file < 0) fail(path, "cannot be created; choose a folder that can be written");
		const Handle bodies(H5Gcreate2(file, "/bodies", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
		const Handle contacts(H5Gcreate2(file, "/contacts", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
		if (H5LTset_attribute_int(file, "/", "format", &format, 1) < 0 || H5LTset_attribute_double(file, "/", "time_step", &recorded.timeStep, 1) < 0)
			fail(path, "cannot write the attributes");
		const Writer put { path, file };
		put("/bodies/inverse_mass", flat(p.inverseMass, mass), 3);
		put("/bodies/free_velocity", flat(p.freeVelocity, twist), 3);
		put("/bodies/velocity", flat(p.velocities, twist), 3);
		if (!p.positions.empty())
			put("/bodies/position", flat(p.positions, [](const Point& x, std::vector<double>& out) { out.insert(out.end(), { x.x, x.y }); }), 2);
		std::vector<int> pairs;
		for (const Contact& c : p.contacts)
			pairs.insert(pairs.end(), { c.i, c.j });
		const hsize_t size[2] = { p.contactCount(), 2 };
		if (H5LTmake_dataset_int(file, "/contacts/body", 2, size, pairs.data()) < 0) fail(path, "cannot write /contacts/body");
		const auto column = [&](const char* name, hsize_t columns, auto values) {
			put(name, flat(p.contacts, [&](const Contact& c, std::vector<double>& out) { const auto v = values(c); out.insert(out.end(), v.begin(), v.end()); }),
			    columns);
		};
		using Numbers = std::vector<double>;
		column("/contacts/normal", 2, [](const Contact& c) { return Numbers { c.nx, c.ny }; });
		column("/contacts/lever", 4, [](const Contact& c) { return Numbers { c.leverNi, c.leverTi, c.leverNj, c.leverTj }; });
		column("/contacts/bias", 3, [](const Contact& c) { return Numbers { c.biasN, c.biasT, c.biasR }; });
		column("/contacts/adhesion", 1, [](const Contact& c) { return Numbers { c.adhesion }; });
		column("/contacts/friction", 1, [](const Contact& c) { return Numbers { c.friction }; });
		column("/contacts/rolling_arm", 1, [](const Contact& c) { return Numbers { c.rollingArm }; });
		column("/contacts/length", 1, [](const Contact& c) { return Numbers { c.length }; });
		put("/contacts/warm_start", flat(recorded.warmStart, impulse), 3);
		put("/contacts/impulse", flat(p.impulses, impulse), 3);
		if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) fail(path, "cannot be written to the end: is the disk full?");
	} catch (...) {
		std::remove(part.c_str());
		throw;
	}
	if (std::rename(part.c_str(), path.c_str()) != 0) fail(path, "cannot be written");
}

RecordedProblem read(const std::string& path)
{
	quiet();
	const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
	if (file < 0) fail(path, "cannot be opened as an HDF5 file");
	RecordedProblem recorded;
	int             found = 0;
	if (H5LTget_attribute_int(file, "/", "format", &found) < 0 || found != format)
		fail(path, "is not a contact problem of format " + std::to_string(format));
	if (H5LTget_attribute_double(file, "/", "time_step", &recorded.timeStep) < 0) fail(path, "has no attribute time_step");
	const Reader  get { path, file };
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
	if (get.rows("/contacts/body", 2) != contacts) fail(path, "/contacts/body has another number of rows than /contacts/normal");
	std::vector<int> pairs(2 * contacts);
	if (contacts > 0 && H5LTread_dataset_int(file, "/contacts/body", pairs.data()) < 0) fail(path, "cannot read /contacts/body");
	const auto normal = get("/contacts/normal", 2, contacts), lever = get("/contacts/lever", 4, contacts), bias = get("/contacts/bias", 3, contacts);
	const auto adhesion = get("/contacts/adhesion", 1, contacts), friction = get("/contacts/friction", 1, contacts);
	const auto arm = get("/contacts/rolling_arm", 1, contacts), length = get("/contacts/length", 1, contacts);
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
		p.contacts.push_back(c);
	}
	return recorded;
}

} // namespace nonsmooth::contact
