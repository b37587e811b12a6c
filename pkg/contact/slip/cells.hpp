// Cells of a slip surface: pieces of a wall along its arc length, as plain columns. What they are is told in law.hpp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nonsmooth::contact::slip {

/// Cells that follow each other: [begin, end).
struct Range {
	std::size_t begin = 0, end = 0;
};

/// A column that a law keeps in each cell.
struct StateColumn {
	std::string name; // as series and pictures call it
	std::string unit;
	std::size_t offset = 0; // of its first number in the state of a cell
	std::size_t width  = 1; // numbers a cell
	bool        across = false; // a profile, by nodes across the zone
};

/// Columns of the cells of one wall, by arc length. A step reads and writes one cell after the other, in any number
/// of ranges.
struct Cells {
	// given before a step
	std::vector<double>
	        normalStress; // σ [Pa], compression positive: over the pore pressure that is there without slip
	std::vector<double> slipRate; // V [m/s], of the last step, 0 or more
	// what a law finds for the step
	std::vector<double> strength; // τ [Pa], 0 or more
	// given after the step
	std::vector<double> path; // by which the cell has slipped in it [m], 0 or more
	std::vector<double> heat; // that sliding has made in it [J/m²]
	// what lives on
	std::vector<double> slip; // sum of paths [m]
	std::vector<double> state; // of the law: `stateWidth` numbers a cell, see Law::columns
	std::vector<double> between; // from Law::strength to Law::advance, `betweenWidth` numbers a cell
	std::size_t         stateWidth = 0, betweenWidth = 0;

	std::size_t count() const { return slip.size(); }
	Range       all() const { return { 0, count() }; }
	double*     stateOf(std::size_t cell) { return state.data() + cell * stateWidth; }
	double*     betweenOf(std::size_t cell) { return between.data() + cell * betweenWidth; }
};

} // namespace nonsmooth::contact::slip
