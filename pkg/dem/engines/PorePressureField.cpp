#include "PorePressureField.hpp"
#include "ListChecks.hpp"
#include <algorithm>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((PorePressureField));

namespace {
	[[noreturn]] void refuseField(const string& why) { throw std::invalid_argument("PorePressureField: " + why); }
}

void PorePressureField::validate() const
{
	if (nodes.empty() || triangles.empty())
		refuseField(
		        "nodes has " + std::to_string(nodes.size()) + " entries and triangles "
		        + std::to_string(triangles.size()) + ": give points, and triangles between them");
	for (size_t k = 0; k < nodes.size(); ++k)
		for (int c = 0; c < 2; ++c)
			if (!nscd::isNumber(nodes[k][c]))
				refuseField(
				        "nodes[" + std::to_string(k) + "][" + std::to_string(c)
				        + "] = " + nscd::number(nodes[k][c]) + ": give a finite number");
	nscd::requireNumbers("PorePressureField", "times", times);
	nscd::requireNumbers("PorePressureField", "pressures", pressures);
	nscd::requireRising("PorePressureField", times, true);
	const size_t states = std::max<size_t>(1, times.size());
	if (pressures.size() != states * nodes.size())
		refuseField(
		        "pressures has " + std::to_string(pressures.size()) + " entries: give one for each of the "
		        + std::to_string(nodes.size()) + " nodes"
		        + (states > 1 ? " at each of the " + std::to_string(states) + " times, "
		                           + std::to_string(states * nodes.size())
		                      : ""));
}

void PorePressureField::make()
{
	validate();
	std::vector<nscd::TriangleField::Node>     points;
	std::vector<nscd::TriangleField::Triangle> between;
	for (const auto& n : nodes)
		points.push_back({ n[0], n[1] });
	for (const auto& t : triangles)
		between.push_back({ t[0], t[1], t[2] });
	try {
		triangulation = { std::move(points), std::move(between) };
	} catch (const std::invalid_argument& error) {
		refuseField(string(error.what()) + ": give three nodes of the list for each, which span an area");
	}
	isMade = true;
}

void PorePressureField::prepare(Real time)
{
	if (isMade && time == presentTime) return;
	if (!isMade) make();
	const size_t n = nodes.size(), states = std::max<size_t>(1, times.size());
	size_t       next = 0;
	while (next < times.size() && times[next] <= time)
		++next;
	const size_t before = next > 0 ? next - 1 : 0, after = std::min(next, states - 1);
	const Real   share = before == after ? 0 : (time - times[before]) / (times[after] - times[before]);
	present.resize(n);
	for (size_t k = 0; k < n; ++k) {
		const Real p = pressures[before * n + k];
		present[k]   = before == after ? p : p + share * (pressures[after * n + k] - p);
	}
	presentTime = time;
}

PorePressureField::Water PorePressureField::at(const Vector3r& place) const
{
	const int triangle = triangulation.find(place[0], place[1]);
	if (triangle < 0) return {};
	const auto value = triangulation.at(triangle, place[0], place[1], present);
	return { value.value, Vector3r(value.x, value.y, 0), true };
}

boost::python::tuple PorePressureField::pyAt(const Vector3r& place, Real time)
{
	prepare(time);
	const Water water = at(place);
	return water.inside ? boost::python::make_tuple(water.pressure, water.gradient)
	                    : boost::python::make_tuple(boost::python::object(), boost::python::object());
}

} // namespace yade
