// Arrays of Python and vectors of the solver, with what is said of an array that does not fit.
#pragma once

#include <algorithm>
#include <array>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace nonsmooth::bindings {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Ints    = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

/// The array of a dictionary's key, checked: `columns` 0 stands for a list.
template <class Array> Array take(const py::dict& from, const char* key, py::ssize_t rows, py::ssize_t columns)
{
	if (!from.contains(key)) throw py::key_error(std::string("contact problem: ") + key + " is missing");
	Array      array = py::cast<Array>(from[key]);
	const bool fits  = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
	if (!fits || (rows >= 0 && array.shape(0) != rows))
		throw py::value_error(
		        std::string("contact problem: ") + key + " must have the shape ("
		        + (rows >= 0 ? std::to_string(rows) : "n") + ", " + (columns ? std::to_string(columns) : "")
		        + ")");
	return array;
}

/// Items that are nothing but doubles side by side, of rows of as many.
template <class Item> constexpr py::ssize_t columnsOf = sizeof(Item) / sizeof(double);
template <class Item> std::vector<Item>     items(const Doubles& rows)
{
	std::vector<Item> result(static_cast<std::size_t>(rows.shape(0)));
	std::copy_n(rows.data(), rows.size(), reinterpret_cast<double*>(result.data()));
	return result;
}
template <class Item> std::vector<Item> take(const py::dict& from, const char* key, std::size_t rows)
{
	return items<Item>(take<Doubles>(from, key, static_cast<py::ssize_t>(rows), columnsOf<Item>));
}

template <class Item> Doubles array(const std::vector<Item>& items)
{
	Doubles result({ py::ssize_t(items.size()), columnsOf<Item> });
	std::copy_n(
	        reinterpret_cast<const double*>(items.data()), columnsOf<Item> * items.size(), result.mutable_data());
	return result;
}

/// What numbers(item) puts out for each item, a row of `columns`; a list where they are 0.
template <class Number, class Item, class Numbers>
py::array_t<Number> table(const std::vector<Item>& items, py::ssize_t columns, Numbers numbers)
{
	const auto          rows = static_cast<py::ssize_t>(items.size());
	py::array_t<Number> result(
	        columns ? std::vector<py::ssize_t> { rows, columns } : std::vector<py::ssize_t> { rows });
	Number* to = result.mutable_data();
	for (const Item& item : items)
		for (const Number x : numbers(item))
			*to++ = x;
	return result;
}

} // namespace nonsmooth::bindings
