#include "SlipSurfaceMat.hpp"
#include "../seam/PythonBytes.hpp"
#include "../checks/Refusal.hpp"
#include <contact/slip/laws.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

YADE_PLUGIN((SlipSurfaceMat));

namespace py = boost::python;

namespace {
	constexpr Real cellDiameters = 8; // of a cell along its wall

	Real meanDiameter(const Scene& scene)
	{
		Real   sum   = 0;
		size_t count = 0;
		for (const auto& body : *scene.bodies)
			if (const auto* sphere = body ? dynamic_cast<const Sphere*>(body->shape.get()) : nullptr) {
				sum += 2 * sphere->radius;
				++count;
			}
		return count > 0 ? sum / Real(count) : 1;
	}
}

void SlipSurfaceMat::pyHandleCustomCtorArgs(py::tuple&, py::dict& named)
{
	if (!named.has_key("law")) return;
	setLaw(named["law"]);
	py::delitem(named, py::str("law"));
}

void SlipSurfaceMat::setLaw(py::object law)
{
	vector<string>       names, keys;
	vector<vector<Real>> values;
	const auto           all = [](const py::object& list, auto& into) {
                using Item = typename std::decay_t<decltype(into)>::value_type;
                for (py::ssize_t k = 0; k < py::len(list); ++k)
                        into.push_back(py::extract<Item>(list[k]));
	};
	try {
		all(law.attr("names"), names);
		const py::object given = law.attr("values");
		all(py::list(given.attr("keys")()), keys);
		for (const string& key : keys) {
			const py::object value = given[key];
			values.push_back({});
			if (py::extract<Real>(value).check()) values.back().push_back(py::extract<Real>(value));
			else
				all(py::list(value), values.back());
		}
	} catch (const py::error_already_set&) {
		PyErr_Clear();
		throw std::invalid_argument(
		        getClassName() + " '" + label
		        + "': law: it must be a nonsmooth.slip.SlipLaw, such as nonsmooth.slip.parameter_sets.law('vaiont')");
	}
	if (cellCount() > 0)
		throw std::invalid_argument(
		        getClassName() + " '" + label
		        + "': its cells have been cut; give the walls another material for another law");
	const Real before = frictionAngle;
	std::swap(lawNames, names);
	std::swap(lawKeys, keys);
	std::swap(lawValues, values);
	try {
		makeLaw();
		frictionAngle = std::atan(first);
		validate();
	} catch (const std::invalid_argument&) {
		std::swap(lawNames, names);
		std::swap(lawKeys, keys);
		std::swap(lawValues, values);
		frictionAngle = before;
		surfaceLaw.reset();
		if (!lawNames.empty()) makeLaw();
		throw;
	}
}

py::object SlipSurfaceMat::givenLaw() const
{
	py::list names;
	for (const string& name : lawNames)
		names.append(name);
	py::dict values;
	for (size_t k = 0; k < lawKeys.size(); ++k) {
		py::list numbers;
		for (const Real value : lawValues[k])
			numbers.append(value);
		values[lawKeys[k]] = numbers;
	}
	return py::make_tuple(py::tuple(names), values);
}

void SlipSurfaceMat::makeLaw()
{
	namespace contact = nonsmooth::contact::slip;
	contact::Given given;
	for (size_t k = 0; k < std::min(lawKeys.size(), lawValues.size()); ++k)
		given[lawKeys[k]] = std::vector<double>(lawValues[k].begin(), lawValues[k].end());
	std::shared_ptr<contact::Law> made;
	try {
		made = contact::makeLaw({ lawNames.begin(), lawNames.end() }, given);
	} catch (const std::invalid_argument& error) {
		throw std::invalid_argument(getClassName() + " '" + label + "': " + error.what());
	}
	surfaceLaw = made;
	first      = made->friction();
}

void SlipSurfaceMat::validate() const
{
	NscdMat::validate();
	if (!surfaceLaw)
		throw std::invalid_argument(
		        getClassName() + " '" + label
		        + "': law is not there: give it a nonsmooth.slip.SlipLaw, law=nonsmooth.slip.parameter_sets.law('vaiont')");
	require(std::abs(std::tan(frictionAngle) - first) <= 1e-9 * (1 + first), "frictionAngle", frictionAngle,
	        "that of its law before slip: leave it out, and give the law another friction");
	require(residualFrictionAngle < 0, "residualFrictionAngle", residualFrictionAngle,
	        "negative, since the law alone says what friction is");
	require(wall, "wall", wall, "True: the law is of the wall alone");
	require(cellLength >= 0 && nscd::isNumber(cellLength), "cellLength", cellLength, "0 or more, and finite [m]");
	require(averagingSlip >= 0 && nscd::isNumber(averagingSlip), "averagingSlip", averagingSlip,
	        "0 or more, and finite [m]");
}

void SlipSurfaceMat::open(const Scene& scene, Real h)
{
	validate();
	if (geometry.count() > 0 && home.lock() != scene.bodies) forgetAll(); // used again in another scene
	home = scene.bodies;
	if (!(cellLength > 0)) cellLength = cellDiameters * meanDiameter(scene);
	const bool isNew = geometry.count() == 0, saved = !slip.empty();
	if (!isNew && cellLength != cutLength)
		nscd::fail(
		        getClassName() + " '" + label + "': cellLength = " + nscd::number(cellLength)
		        + ": its cells have been cut, " + nscd::number(cutLength)
		        + " m long; set it before the first step");
	nscd::WallCells now(scene, *this, cellLength);
	if (!isNew && !now.isOfSameWalls(geometry))
		nscd::fail(
		        "the walls of " + getClassName() + " '" + label
		        + "' are not those that its cells were cut along, since some came or went: give further walls a "
		          "material of their own, and keep those that are there");
	if (!isNew) return;
	cutLength = cellLength;
	if (saved && slip.size() != now.count())
		nscd::fail(
		        getClassName() + " '" + label + "' was saved with " + std::to_string(slip.size())
		        + " cells, and its walls have " + std::to_string(now.count())
		        + " now: give further walls a material of their own");
	geometry  = now;
	averaging = averagingSlip > 0 ? averagingSlip : 0.5 * cellLength;
	cells     = surfaceLaw->cells(now.count());
	for (auto* sums : { &pressedOf, &weightOf, &speedOf, &meanSpeedOf, &lostOf })
		sums->assign(now.count(), 0);
	if (saved) {
		cells.slip.assign(slip.begin(), slip.end());
		cells.slipRate.assign(slipRate.begin(), slipRate.end());
		cells.normalStress.assign(normalStress.begin(), normalStress.end());
		if (lawState.size() == cells.state.size()) cells.state.assign(lawState.begin(), lawState.end());
		h = lawStep > 0 ? lawStep : h; // of the strengths that are in force already
	} else
		begin();
	findStrengths(h);
}

void SlipSurfaceMat::preSave(SlipSurfaceMat&)
{
	if (geometry.count() == 0) return; // as it was loaded
	slip.assign(cells.slip.begin(), cells.slip.end());
	slipRate.assign(cells.slipRate.begin(), cells.slipRate.end());
	normalStress.assign(cells.normalStress.begin(), cells.normalStress.end());
	lawState.assign(cells.state.begin(), cells.state.end());
}

void SlipSurfaceMat::forgetAll()
{
	geometry = {};
	cells    = {};
	for (auto* column : { &slip, &slipRate, &normalStress, &friction, &lawState })
		column->clear();
	heat = 0;
}

void SlipSurfaceMat::findStrengths(Real h)
{
	surfaceLaw->prepare(h);
	surfaceLaw->strength(cells, cells.all());
	lawStep = h;
}

void SlipSurfaceMat::begin()
{
	friction.assign(cells.count(), first);
	heat = 0;
}

void SlipSurfaceMat::forgetSlip()
{
	if (cellCount() == 0) return;
	if (geometry.count() == 0) open(*Omega::instance().getScene(), lawStep); // loaded
	cells = surfaceLaw->cells(geometry.count());
	begin();
	findStrengths(lawStep);
}

void SlipSurfaceMat::note(int cell, Real pressed, Real speed, Real meanSpeed, Real lost)
{
	if (cell < 0 || cell >= (int)pressedOf.size()) return;
	pressedOf[cell] += pressed;
	weightOf[cell] += std::abs(pressed);
	speedOf[cell] += std::abs(pressed) * speed;
	meanSpeedOf[cell] += std::abs(pressed) * meanSpeed;
	lostOf[cell] += lost;
}

void SlipSurfaceMat::close(Real h)
{
	for (size_t c = 0; c < cells.count(); ++c) {
		if (held) weightOf[c] = lostOf[c] = 0; // as if nothing slid; what presses counts
		const Real length = geometry.lengthOf(c), weight = weightOf[c];
		cells.slipRate[c] = weight > 0 ? speedOf[c] / weight : 0;
		cells.path[c]     = weight > 0 ? h * meanSpeedOf[c] / weight : 0;
		cells.heat[c]     = lostOf[c] / length;
		heat += lostOf[c];
		const Real now = std::max(Real(0), pressedOf[c] / (h * length)), way = cells.slip[c] + cells.path[c];
		// of a surface that has not slipped the present stress holds
		const Real share = cells.slip[c] > 0 ? std::min(Real(1), cells.path[c] / std::min(way, averaging)) : 1;
		cells.normalStress[c] += share * (now - cells.normalStress[c]);
		pressedOf[c] = weightOf[c] = speedOf[c] = meanSpeedOf[c] = lostOf[c] = 0;
	}
	surfaceLaw->advance(cells, cells.all());
	findStrengths(h);
	for (size_t c = 0; c < cells.count(); ++c)
		friction[c] = cells.normalStress[c] > 0 ? cells.strength[c] / cells.normalStress[c] : first;
}

py::list SlipSurfaceMat::columns() const
{
	py::list all;
	if (surfaceLaw)
		for (const auto& column : surfaceLaw->columns())
			all.append(py::make_tuple(column.name, column.unit, column.width));
	return all;
}

py::object SlipSurfaceMat::cellTable(const string& name)
{
	if (geometry.count() == 0 && !slip.empty()) open(*Omega::instance().getScene(), lawStep); // loaded
	const size_t        count = geometry.count();
	std::vector<double> rows;
	if (name == "slip") rows = cells.slip;
	else if (name == "slip_rate")
		rows = cells.slipRate;
	else if (name == "normal_stress")
		rows = cells.normalStress;
	else if (name == "friction")
		rows.assign(friction.begin(), friction.end());
	else if (name == "begin" || name == "length")
		for (size_t c = 0; c < count; ++c)
			rows.push_back(name == "begin" ? geometry.beginOf(c) : geometry.lengthOf(c));
	else if (name == "ends") {
		const Scene& scene = *Omega::instance().getScene();
		for (size_t c = 0; c < count; ++c)
			for (const Real share : { 0., 1. }) {
				const Vector3r point = geometry.pointOf(scene, c, share);
				rows.insert(rows.end(), { double(point[0]), double(point[1]) });
			}
	} else {
		bool known = false;
		for (const auto& column :
		     surfaceLaw ? surfaceLaw->columns() : std::vector<nonsmooth::contact::slip::StateColumn>()) {
			if (column.name != name) continue;
			known = true;
			for (size_t c = 0; c < count; ++c) {
				const double* from = cells.stateOf(c) + column.offset;
				rows.insert(rows.end(), from, from + column.width);
			}
		}
		if (!known)
			throw std::invalid_argument(
			        getClassName() + ".cellTable: column = '" + name
			        + "': it must be begin, length, ends, slip, slip_rate, normal_stress, friction, or one of columns()");
	}
	return nscd::asBytes(rows);
}

namespace nscd {
	std::vector<SlipSurfaceMat*> slipSurfacesOf(const Scene& scene)
	{
		std::vector<SlipSurfaceMat*> all;
		for (const auto& body : *scene.bodies) {
			auto* found = body ? dynamic_cast<SlipSurfaceMat*>(body->material.get()) : nullptr;
			if (found && std::find(all.begin(), all.end(), found) == all.end()) all.push_back(found);
		}
		return all;
	}
}

} // namespace yade
