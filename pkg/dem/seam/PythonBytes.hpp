// Tables for Python: numbers row after row, as one object of bytes that NumPy reads without going through each.
#pragma once

#include <algorithm>
#include <boost/python.hpp>
#include <vector>

namespace yade::nscd {

/// Room for so many numbers, which are still to be written.
template <class Number> struct Bytes {
	explicit Bytes(size_t count)
	        : object(
	                boost::python::handle<>(PyBytes_FromStringAndSize(nullptr, Py_ssize_t(count * sizeof(Number)))))
	{
	}
	Number* data() { return reinterpret_cast<Number*>(PyBytes_AS_STRING(object.ptr())); }

	boost::python::object object;
};

template <class Number> boost::python::object asBytes(const std::vector<Number>& rows)
{
	Bytes<Number> bytes(rows.size());
	std::copy(rows.begin(), rows.end(), bytes.data());
	return bytes.object;
}

} // namespace yade::nscd
