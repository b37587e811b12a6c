#include <algorithm>
#include <cmath>
#include <contact/problem_file.hpp>
#include <contact/whole_file.hpp>
#include <filesystem>
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
		Handle(const Handle&)            = delete;
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

	[[noreturn]] void fail(const std::string& path, const std::string& why)
	{
		throw std::runtime_error("contact problem " + path + ": " + why);
	}

	/// Rows of `columns` numbers: a rows × columns dataset, or a plain list for one column.
	struct Writer {
		const std::string& path;
		hid_t              file;

		void operator()(const char* name, const std::vector<double>& values, hsize_t columns) const
		{
			const hsize_t size[2] = { values.size() / columns, columns };
			if (H5LTmake_dataset_double(file, name, columns > 1 ? 2 : 1, size, values.data()) < 0)
				fail(path, std::string("cannot write ") + name);
		}
	};

	/// Bytes that can stand behind one byte of a file: what deflate reaches at best, and some.
	constexpr hsize_t bestCompression = 1100;

	struct Reader {
		const std::string& path;
		hid_t              file;
		hsize_t            fileSize; // [bytes]

		/// Whether it is there, and not as a link to somewhere else.
		bool has(const char* name) const
		{
			H5L_info_t link;
			return H5Lget_info(file, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
		}

		/// Rows of a dataset of numbers of `kind` (H5T_FLOAT, H5T_INTEGER), whose shape and size are credible.
		hsize_t rows(const char* name, hsize_t columns, H5T_class_t kind = H5T_FLOAT) const
		{
			const auto bad = [&](const std::string& why) { fail(path, std::string(name) + " " + why); };
			if (!has(name)) fail(path, std::string("has no dataset ") + name);
			const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
			if (set < 0) bad("cannot be opened as a dataset");
			const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
			if (type < 0 || space < 0) bad("cannot be read");
			if (H5Tget_class(type) != kind)
				bad(kind == H5T_FLOAT ? "must hold floating-point numbers" : "must hold whole numbers");
			const int rank    = H5Sget_simple_extent_ndims(space);
			hsize_t   size[2] = { 0, 1 };
			if (rank != (columns > 1 ? 2 : 1) || H5Sget_simple_extent_dims(space, size, nullptr) < 0
			    || size[1] != columns)
				bad("must have " + std::to_string(columns) + " column(s)");
			const hsize_t stored = std::min<hsize_t>(H5Dget_storage_size(set), fileSize),
			              bytes  = H5Tget_size(type) * columns;
			if (bytes == 0 || size[0] > stored * bestCompression / bytes)
				bad("says that it has " + std::to_string(size[0]) + " rows, which are not in the file");
			return size[0];
		}

		void expect(const char* name, hsize_t columns, hsize_t wanted, H5T_class_t kind = H5T_FLOAT) const
		{
			if (const hsize_t count = rows(name, columns, kind); count != wanted)
				fail(path,
				     std::string(name) + " has " + std::to_string(count) + " rows where "
				             + std::to_string(wanted) + " are needed");
		}

		std::vector<double> operator()(const char* name, hsize_t columns, hsize_t wanted) const
		{
			expect(name, columns, wanted);
			std::vector<double> values(wanted * columns);
			if (!values.empty() && H5LTread_dataset_double(file, name, values.data()) < 0)
				fail(path, std::string("cannot read ") + name);
			return values;
		}

		/// Of the file itself: one number of that kind.
		void attribute(const char* name, H5T_class_t kind, hid_t memoryType, void* value) const
		{
			const std::string what = std::string("has no usable attribute ") + name
			        + ": it must be one number";
			if (H5Aexists(file, name) <= 0) fail(path, std::string("has no attribute ") + name);
			const Handle held(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
			if (held < 0) fail(path, what);
			const Handle type(H5Aget_type(held), H5Tclose), space(H5Aget_space(held), H5Sclose);
			if (type < 0 || space < 0 || H5Tget_class(type) != kind
			    || H5Sget_simple_extent_npoints(space) != 1 || H5Aread(held, memoryType, value) < 0)
				fail(path, what);
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
	const auto twist = [](const Twist& v, std::vector<double>& out) {
		putThree(v, out, &Twist::x, &Twist::y, &Twist::w);
	};
	const auto mass = [](const InverseMass& v, std::vector<double>& out) {
		putThree(v, out, &InverseMass::x, &InverseMass::y, &InverseMass::w);
	};
	const auto impulse = [](const Impulse& v, std::vector<double>& out) {
		putThree(v, out, &Impulse::n, &Impulse::t, &Impulse::r);
	};

} // namespace

void write(const std::string& path, const RecordedProblem& recorded)
{
	quiet();
	const Problem& p = recorded.problem;
	// made in memory, so that HDF5 never meets a full disk
	const Handle inMemory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
	H5Pset_fapl_core(inMemory, 1 << 20, 0);
	const Handle file(H5Fcreate(":memory:", H5F_ACC_TRUNC, H5P_DEFAULT, inMemory), H5Fclose);
	if (file < 0) fail(path, "cannot be made in memory");
	const Handle bodies(H5Gcreate2(file, "/bodies", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
	const Handle contacts(H5Gcreate2(file, "/contacts", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
	if (H5LTset_attribute_int(file, "/", "format", &format, 1) < 0
	    || H5LTset_attribute_double(file, "/", "time_step", &recorded.timeStep, 1) < 0)
		fail(path, "cannot write the attributes");
	const Writer put { path, file };
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
	const hsize_t size[2] = { p.contactCount(), 2 };
	if (H5LTmake_dataset_int(file, "/contacts/body", 2, size, pairs.data()) < 0)
		fail(path, "cannot write /contacts/body");
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
	if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) fail(path, "cannot be made in memory");
	const auto bytes = H5Fget_file_image(file, nullptr, 0);
	if (bytes < 0) fail(path, "cannot be made in memory");
	std::vector<char> image(static_cast<std::size_t>(bytes));
	if (H5Fget_file_image(file, image.data(), image.size()) != bytes) fail(path, "cannot be made in memory");
	if (const std::string why = writeWhole(path, image.data(), image.size()); !why.empty())
		fail(path, "cannot be written (" + why + "); choose a folder that can be written and has room");
}

RecordedProblem read(const std::string& path)
{
	quiet();
	std::error_code none;
	const auto      fileSize = std::filesystem::file_size(path, none);
	if (none) fail(path, "cannot be read (" + none.message() + ")");
	const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
	if (file < 0) fail(path, "cannot be read as an HDF5 file");
	RecordedProblem recorded;
	const Reader    get { path, file, fileSize };
	int             found = 0;
	get.attribute("format", H5T_INTEGER, H5T_NATIVE_INT, &found);
	if (found != format)
		fail(path,
		     "is not a contact problem of format " + std::to_string(format) + ", but of "
		             + std::to_string(found));
	get.attribute("time_step", H5T_FLOAT, H5T_NATIVE_DOUBLE, &recorded.timeStep);
	if (!(recorded.timeStep > 0) || !std::isfinite(recorded.timeStep))
		fail(path,
		     "has the time_step " + std::to_string(recorded.timeStep) + ": it must be positive and finite");
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
	get.expect("/contacts/body", 2, contacts, H5T_INTEGER);
	std::vector<int> pairs(2 * contacts);
	if (contacts > 0 && H5LTread_dataset_int(file, "/contacts/body", pairs.data()) < 0)
		fail(path, "cannot read /contacts/body");
	const auto normal = get("/contacts/normal", 2, contacts), lever = get("/contacts/lever", 4, contacts),
	           bias     = get("/contacts/bias", 3, contacts);
	const auto adhesion = get("/contacts/adhesion", 1, contacts), friction = get("/contacts/friction", 1, contacts);
	const auto arm = get("/contacts/rolling_arm", 1, contacts), length = get("/contacts/length", 1, contacts);
	const auto play = get.has("/contacts/play") ? get("/contacts/play", 1, contacts)
	                                            : std::vector<double>(contacts);
	for (hsize_t k = 0; k < contacts; ++k) {
		Contact c;
		for (const int body : { pairs[2 * k], pairs[2 * k + 1] })
			if (body < 0 || hsize_t(body) >= bodies)
				fail(path,
				     "contact " + std::to_string(k) + " names body " + std::to_string(body)
				             + ": there are " + std::to_string(bodies) + ", counted from 0");
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

} // namespace nonsmooth::contact
