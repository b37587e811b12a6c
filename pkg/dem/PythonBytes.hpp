// Tables for Python: numbers row after row, as one object of bytes that NumPy reads without going through each.
#pragma once

#include <boost/python.hpp>
#include <vector>

namespace yade::nscd {

template <class Number> boost::python::object asBytes(const std::vector<Number>& rows)
{
	const auto* first = reinterpret_cast<const char*>(rows.data());
	return boost::python::object(
	        boost::python::handle<>(PyBytes_FromStringAndSize(first, Py_ssize_t(rows.size() * sizeof(Number)))));
}

} // namespace yade::nscd
