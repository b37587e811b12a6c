// What files of contact problems of both dimensions have in common (problem_file.hpp, space/problem_file.hpp): datasets
// of HDF5 that are checked as they are read, and whole
// files or none. For the two that write and read problems, and for nobody else.
#pragma once

#include <functional>
#include <hdf5.h>
#include <string>
#include <vector>

namespace nonsmooth::contact {

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

[[noreturn]] void failFile(const std::string& path, const std::string& why);

/// Rows of `columns` numbers: a rows × columns dataset, or a plain list for one column.
struct Writer {
	const std::string& path;
	hid_t              file;

	void operator()(const char* name, const std::vector<double>& values, hsize_t columns) const;
	void operator()(const char* name, const std::vector<int>& values, hsize_t columns) const;
};

struct Reader {
	const std::string& path;
	hid_t              file;
	hsize_t            fileSize; // [bytes]

	/// Whether it is there, and not as a link to somewhere else.
	bool has(const char* name) const;
	/// Rows of a dataset of numbers of `kind` (H5T_FLOAT, H5T_INTEGER), whose shape and size are credible.
	hsize_t rows(const char* name, hsize_t columns, H5T_class_t kind = H5T_FLOAT) const;
	void    expect(const char* name, hsize_t columns, hsize_t wanted, H5T_class_t kind = H5T_FLOAT) const;
	std::vector<double> operator()(const char* name, hsize_t columns, hsize_t wanted) const;
	/// The two bodies of each contact, which are there.
	std::vector<int> pairs(hsize_t contacts, hsize_t bodies) const;
	/// Of the file itself: one number of that kind.
	void attribute(const char* name, H5T_class_t kind, hid_t memoryType, void* value) const;
	/// The attribute time_step, which is positive.
	double timeStep() const;
};

/// What put(item) appends for each item.
template <class Item, class Put> std::vector<double> flat(const std::vector<Item>& items, Put put)
{
	std::vector<double> values;
	for (const Item& item : items)
		put(item, values);
	return values;
}

/// Writes a problem of a dimension whose datasets put() makes: beside, and renamed (whole_file.hpp).
void writeProblem(
        const std::string& path, int dimension, double timeStep, const std::function<void(const Writer&)>& put);

/// Calls get() with an open file of a problem of that dimension. A file of format 1 is one of the plane.
void readProblem(const std::string& path, int dimension, const std::function<void(const Reader&)>& get);

} // namespace nonsmooth::contact
