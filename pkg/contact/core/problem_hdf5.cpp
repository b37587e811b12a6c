#include <algorithm>
#include <cmath>
#include <contact/core/problem_file.hpp>
#include <contact/core/problem_hdf5.hpp>
#include <contact/core/whole_file.hpp>
#include <filesystem>
#include <hdf5_hl.h>
#include <stdexcept>

namespace nonsmooth::contact {
namespace {

	constexpr int format = 2, formatOfPlanes = 1;

	/// The library prints a stack of errors of its own; ours say what the user needs.
	void quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

	/// Bytes that can stand behind one byte of a file: what deflate reaches at best, and some.
	constexpr hsize_t bestCompression = 1100;

	/// The dimension of an open file.
	int dimensionIn(const Reader& get)
	{
		int found = 0, dimension = 2;
		get.attribute("format", H5T_INTEGER, H5T_NATIVE_INT, &found);
		if (found != format && found != formatOfPlanes)
			failFile(
			        get.path,
			        "is not a contact problem of format " + std::to_string(formatOfPlanes) + " or "
			                + std::to_string(format) + ", but of " + std::to_string(found));
		if (found == format) get.attribute("dimension", H5T_INTEGER, H5T_NATIVE_INT, &dimension);
		if (dimension != 2 && dimension != 3)
			failFile(get.path, "has the dimension " + std::to_string(dimension) + ": it must be 2 or 3");
		return dimension;
	}

	void open(const std::string& path, const std::function<void(const Reader&)>& with)
	{
		quiet();
		std::error_code none;
		const auto      fileSize = std::filesystem::file_size(path, none);
		if (none) failFile(path, "cannot be read (" + none.message() + ")");
		const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
		if (file < 0) failFile(path, "cannot be read as an HDF5 file");
		with(Reader { path, file, fileSize });
	}

} // namespace

void failFile(const std::string& path, const std::string& why)
{
	throw std::runtime_error("contact problem " + path + ": " + why);
}

void Writer::operator()(const char* name, const std::vector<double>& values, hsize_t columns) const
{
	const hsize_t size[2] = { values.size() / columns, columns };
	if (H5LTmake_dataset_double(file, name, columns > 1 ? 2 : 1, size, values.data()) < 0)
		failFile(path, std::string("cannot write ") + name);
}

void Writer::operator()(const char* name, const std::vector<int>& values, hsize_t columns) const
{
	const hsize_t size[2] = { values.size() / columns, columns };
	if (H5LTmake_dataset_int(file, name, columns > 1 ? 2 : 1, size, values.data()) < 0)
		failFile(path, std::string("cannot write ") + name);
}

bool Reader::has(const char* name) const
{
	H5L_info_t link;
	return H5Lget_info(file, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
}

hsize_t Reader::rows(const char* name, hsize_t columns, H5T_class_t kind) const
{
	const auto bad = [&](const std::string& why) { failFile(path, std::string(name) + " " + why); };
	if (!has(name)) failFile(path, std::string("has no dataset ") + name);
	const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
	if (set < 0) bad("cannot be opened as a dataset");
	const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
	if (type < 0 || space < 0) bad("cannot be read");
	if (H5Tget_class(type) != kind)
		bad(kind == H5T_FLOAT ? "must hold floating-point numbers" : "must hold whole numbers");
	const int rank    = H5Sget_simple_extent_ndims(space);
	hsize_t   size[2] = { 0, 1 };
	if (rank != (columns > 1 ? 2 : 1) || H5Sget_simple_extent_dims(space, size, nullptr) < 0 || size[1] != columns)
		bad("must have " + std::to_string(columns) + " column(s)");
	const hsize_t stored = std::min<hsize_t>(H5Dget_storage_size(set), fileSize),
	              bytes  = H5Tget_size(type) * columns;
	if (bytes == 0 || size[0] > stored * bestCompression / bytes)
		bad("says that it has " + std::to_string(size[0]) + " rows, which are not in the file");
	return size[0];
}

void Reader::expect(const char* name, hsize_t columns, hsize_t wanted, H5T_class_t kind) const
{
	if (const hsize_t count = rows(name, columns, kind); count != wanted)
		failFile(
		        path,
		        std::string(name) + " has " + std::to_string(count) + " rows where " + std::to_string(wanted)
		                + " are needed");
}

std::vector<double> Reader::operator()(const char* name, hsize_t columns, hsize_t wanted) const
{
	expect(name, columns, wanted);
	std::vector<double> values(wanted * columns);
	if (!values.empty() && H5LTread_dataset_double(file, name, values.data()) < 0)
		failFile(path, std::string("cannot read ") + name);
	return values;
}

void Reader::attribute(const char* name, H5T_class_t kind, hid_t memoryType, void* value) const
{
	const std::string what = std::string("has no usable attribute ") + name + ": it must be one number";
	if (H5Aexists(file, name) <= 0) failFile(path, std::string("has no attribute ") + name);
	const Handle held(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
	if (held < 0) failFile(path, what);
	const Handle type(H5Aget_type(held), H5Tclose), space(H5Aget_space(held), H5Sclose);
	if (type < 0 || space < 0 || H5Tget_class(type) != kind || H5Sget_simple_extent_npoints(space) != 1
	    || H5Aread(held, memoryType, value) < 0)
		failFile(path, what);
}

std::vector<int> Reader::pairs(hsize_t contacts, hsize_t bodies) const
{
	expect("/contacts/body", 2, contacts, H5T_INTEGER);
	std::vector<int> found(2 * contacts);
	if (contacts > 0 && H5LTread_dataset_int(file, "/contacts/body", found.data()) < 0)
		failFile(path, "cannot read /contacts/body");
	for (std::size_t k = 0; k < found.size(); ++k)
		if (found[k] < 0 || hsize_t(found[k]) >= bodies)
			failFile(
			        path,
			        "contact " + std::to_string(k / 2) + " names body " + std::to_string(found[k])
			                + ": there are " + std::to_string(bodies) + ", counted from 0");
	return found;
}

double Reader::timeStep() const
{
	double step = 0;
	attribute("time_step", H5T_FLOAT, H5T_NATIVE_DOUBLE, &step);
	if (!(step > 0) || !std::isfinite(step))
		failFile(path, "has the time_step " + std::to_string(step) + ": it must be positive and finite");
	return step;
}

void writeProblem(
        const std::string& path, int dimension, double timeStep, const std::function<void(const Writer&)>& put)
{
	quiet();
	// made in memory, so that HDF5 never meets a full disk
	const Handle inMemory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
	H5Pset_fapl_core(inMemory, 1 << 20, 0);
	const Handle file(H5Fcreate(":memory:", H5F_ACC_TRUNC, H5P_DEFAULT, inMemory), H5Fclose);
	if (file < 0) failFile(path, "cannot be made in memory");
	const Handle bodies(H5Gcreate2(file, "/bodies", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
	const Handle contacts(H5Gcreate2(file, "/contacts", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
	if (H5LTset_attribute_int(file, "/", "format", &format, 1) < 0
	    || H5LTset_attribute_int(file, "/", "dimension", &dimension, 1) < 0
	    || H5LTset_attribute_double(file, "/", "time_step", &timeStep, 1) < 0)
		failFile(path, "cannot write the attributes");
	put({ path, file });
	if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) failFile(path, "cannot be made in memory");
	const auto bytes = H5Fget_file_image(file, nullptr, 0);
	if (bytes < 0) failFile(path, "cannot be made in memory");
	std::vector<char> image(static_cast<std::size_t>(bytes));
	if (H5Fget_file_image(file, image.data(), image.size()) != bytes) failFile(path, "cannot be made in memory");
	if (const std::string why = writeWhole(path, image.data(), image.size()); !why.empty())
		failFile(path, "cannot be written (" + why + "); choose a folder that can be written and has room");
}

int dimensionOf(const std::string& path)
{
	int found = 0;
	open(path, [&found](const Reader& get) { found = dimensionIn(get); });
	return found;
}

void readProblem(const std::string& path, int dimension, const std::function<void(const Reader&)>& get)
{
	open(path, [&](const Reader& reader) {
		if (const int found = dimensionIn(reader); found != dimension)
			failFile(
			        path,
			        "is a contact problem in " + std::to_string(found) + " dimensions where one in "
			                + std::to_string(dimension) + " is asked for");
		get(reader);
	});
}

} // namespace nonsmooth::contact
