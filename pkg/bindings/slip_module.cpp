// The laws of slip surfaces for Python, as _nonsmooth_slip: cells are arrays that share the library's memory. No YADE
// here; nonsmooth/slip is the face of it.
#include <cmath>
#include <contact/slip/heated_zone.hpp>
#include <contact/slip/laws.hpp>
#include <contact/slip/water.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace nonsmooth::contact::slip;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A number of each cell as an array that looks into them, or where `across` a row of numbers; `owner` keeps them
/// alive.
py::array view(std::vector<double>& numbers, const StateColumn& column, std::size_t stride, py::handle owner)
{
	std::vector<std::size_t> shape { stride ? numbers.size() / stride : 0 }, strides { stride * sizeof(double) };
	if (column.across) {
		shape.push_back(column.width);
		strides.push_back(sizeof(double));
	}
	return py::array_t<double>(shape, strides, numbers.data() + column.offset, owner);
}

py::list described(const std::vector<Parameter>& parameters)
{
	py::list all;
	for (const Parameter& p : parameters) {
		py::dict d;
		d["key"]      = p.key;
		d["unit"]     = p.unit;
		d["what"]     = p.what;
		d["required"] = std::isnan(p.fallback);
		d["fallback"] = std::isnan(p.fallback) ? py::object(py::none()) : py::object(py::float_(p.fallback));
		d["list"]     = p.list;
		all.append(d);
	}
	return all;
}

py::list describedLaws()
{
	py::list all;
	for (const Entry& entry : entries()) {
		py::dict d;
		d["name"]       = entry.name;
		d["what"]       = entry.what;
		d["heats"]      = entry.heats;
		d["parameters"] = described(entry.parameters);
		all.append(d);
	}
	return all;
}

/// A law, and what it can tell beside the strength of cells.
struct NamedLaw {
	NamedLaw(const std::vector<std::string>& names, const Given& values)
	        : law(makeLaw(names, values))
	        , zone(dynamic_cast<const HeatedZone*>(law.get()))
	{
	}
	const HeatedZone& heated(bool has, const char* what) const
	{
		if (!has) throw py::value_error(std::string("this slip law has no ") + what);
		return *zone;
	}
	const FlashHeating& flash() const
	{
		return *heated(zone && zone->heated().flash, "flash_heating").heated().flash;
	}
	const ShearMelting& melt() const { return *heated(zone && zone->heated().melt, "shear_melting").heated().melt; }

	std::unique_ptr<Law> law;
	const HeatedZone*    zone;
};

/// All cells, with their law's columns by name.
struct NamedCells {
	Cells                    cells;
	std::vector<StateColumn> columns;
};

} // namespace

PYBIND11_MODULE(_nonsmooth_slip, m)
{
	m.doc() = "Laws of slip surfaces; use nonsmooth.slip.";
	m.def("laws", &describedLaws);
	m.def("zone_parameters", [] { return described(zoneParameters()); });
	m.def("vapour_pressure", &vapourPressure);
	m.def("boiling_temperature", &boilingTemperature);
	m.attr("compiler") = NONSMOOTH_COMPILER;

	py::class_<NamedCells> cells(m, "Cells");
	const auto             column = [&cells](const char* name, std::vector<double> Cells::*of) {
                cells.def_property_readonly(name, [of](py::object self) {
                        return view(self.cast<NamedCells&>().cells.*of, {}, 1, self);
                });
	};
	column("normal_stress", &Cells::normalStress);
	column("slip_rate", &Cells::slipRate);
	column("strength", &Cells::strength);
	column("path", &Cells::path);
	column("heat", &Cells::heat);
	column("slip", &Cells::slip);
	cells.def_property_readonly("columns", [](py::object self) {
		NamedCells& own = self.cast<NamedCells&>();
		py::dict    all;
		for (const StateColumn& c : own.columns)
			all[py::str(c.name)] = view(own.cells.state, c, own.cells.stateWidth, self);
		return all;
	});
	cells.def_property_readonly("units", [](const NamedCells& own) {
		py::dict all;
		for (const StateColumn& c : own.columns)
			all[py::str(c.name)] = c.unit;
		return all;
	});
	cells.def("__len__", [](const NamedCells& own) { return own.cells.count(); });

	py::class_<NamedLaw>(m, "Law")
	        .def(py::init<const std::vector<std::string>&, const Given&>())
	        .def("cells",
	             [](const NamedLaw& own, std::size_t count, double normalStress) {
		             return NamedCells { own.law->cells(count, normalStress), own.law->columns() };
	             })
	        .def("prepare", [](NamedLaw& own, double h) { own.law->prepare(h); })
	        .def("friction", [](NamedLaw& own) { return own.law->friction(); })
	        .def("strength", [](const NamedLaw& own, NamedCells& c) { own.law->strength(c.cells, c.cells.all()); })
	        .def("advance", [](const NamedLaw& own, NamedCells& c) { own.law->advance(c.cells, c.cells.all()); })
	        .def("heat_in",
	             [](const NamedLaw& own, NamedCells& c) {
		             const HeatedZone&   zone = own.heated(own.zone, "heated zone");
		             std::vector<double> heat;
		             for (std::size_t k = 0; k < c.cells.count(); ++k)
			             heat.push_back(zone.heatIn(c.cells.stateOf(k)));
		             return py::array_t<double>(heat.size(), heat.data());
	             })
	        .def("zone_mean",
	             [](const NamedLaw& own, const Doubles& profiles) {
		             const Nodes& nodes = own.heated(own.zone, "heated zone").nodes();
		             if (profiles.ndim() != 2 || std::size_t(profiles.shape(1)) != nodes.count())
			             throw py::value_error(
			                     "profiles must have the shape (cells, " + std::to_string(nodes.count())
			                     + ")");
		             py::array_t<double> means(profiles.shape(0));
		             for (py::ssize_t k = 0; k < profiles.shape(0); ++k)
			             means.mutable_at(k) = nodes.mean(profiles.data(k, 0));
		             return means;
	             })
	        .def("places",
	             [](const NamedLaw& own) {
		             const Nodes&        nodes = own.heated(own.zone, "heated zone").nodes();
		             std::vector<double> places;
		             for (std::size_t k = 0; k < nodes.count(); ++k)
			             places.push_back(nodes.place(k));
		             return py::array_t<double>(places.size(), places.data());
	             })
	        .def_property_readonly("heats", [](const NamedLaw& own) { return own.zone != nullptr; })
	        .def("flash_velocity",
	             [](const NamedLaw& own, double temperature) {
		             own.flash();
		             return own.zone->flashVelocity(temperature);
	             })
	        .def("melt_strength",
	             [](const NamedLaw& own, double slipRate, double thickness, double normalStress) {
		             return own.melt().strength(slipRate, thickness, normalStress);
	             })
	        .def("melt_viscosity", [](const NamedLaw& own, double v) { return own.melt().viscosityAt(v); })
	        .def("melt_hottest", [](const NamedLaw& own, double v) { return own.melt().hottest(v); });
}
