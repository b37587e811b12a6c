#include "PorePressureEngine.hpp"
#include "Gravity.hpp"
#include "PythonBytes.hpp"
#include "Refusal.hpp"
#include "YadeFeatures.hpp"
#include "seam/Resident.hpp"
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

YADE_PLUGIN((PorePressureEngine));
CREATE_LOGGER(PorePressureEngine);

namespace {
	[[noreturn]] void refuse(const string& name, Real value)
	{
		throw std::invalid_argument(
		        "PorePressureEngine: " + name + " = " + nscd::number(value) + ": give a finite number");
	}
	[[noreturn]] void refuse(const char* name, size_t place, Real value)
	{
		refuse(string(name) + "[" + std::to_string(place) + "]", value);
	}
}

void PorePressureEngine::validate() const
{
	for (const auto& [name, value] : { std::pair("unitWeight", unitWeight), std::pair("volumeFactor", volumeFactor),
	                                   std::pair("thickness", thickness) })
		if (!std::isfinite(value)) refuse(name, value);
	if (std::isnan(releaseDistance)) refuse("releaseDistance", releaseDistance);
	for (const auto& [name, values] :
	     { std::pair("planePoint", &planePoint), std::pair("planeNormal", &planeNormal),
	       std::pair("pressureGradient", &pressureGradient) })
		for (int k = 0; k < 3; ++k)
			if (!std::isfinite((*values)[k])) refuse(name, k, (*values)[k]);
	if (planeNormal == Vector3r::Zero())
		throw std::invalid_argument(
		        "PorePressureEngine: planeNormal = (0, 0, 0): give the direction from the sliding plane to the water");
}

Real PorePressureEngine::heightAt(Real time) const
{
	if (times.size() != heights.size())
		throw std::invalid_argument(
		        "PorePressureEngine: times has " + std::to_string(times.size()) + " entries and heights "
		        + std::to_string(heights.size()) + ": give as many of both");
	const auto check = [](const char* name, const vector<Real>& values) {
		for (size_t k = 0; k < values.size(); ++k)
			if (!std::isfinite(values[k])) refuse(name, k, values[k]);
	};
	check("times", times);
	check("heights", heights);
	if (times.empty()) return 0;
	if (!std::is_sorted(times.begin(), times.end()))
		throw std::invalid_argument("PorePressureEngine: times must rise");
	if (time <= times.front()) return heights.front();
	if (time >= times.back()) return heights.back();
	const size_t k = std::upper_bound(times.begin(), times.end(), time) - times.begin();
	return heights[k - 1] + (heights[k] - heights[k - 1]) * (time - times[k - 1]) / (times[k] - times[k - 1]);
}

boost::python::object PorePressureEngine::bodyTable() const
{
	std::vector<char> rows;
	for (int id = 0; id < (int)std::max(wet.size(), moved.size()); ++id)
		rows.insert(rows.end(), { char(isWet(id)), char(isReleased(id)), char(wasWet(id)) });
	return nscd::asBytes(rows);
}

void PorePressureEngine::setGradient(const Vector3r& perVolume)
{
	LOG_WARN(
	        "PorePressureEngine.gradient is an old name, and a force per volume: set pressureGradient=("
	        << 0 - perVolume[0] << ", " << 0 - perVolume[1] << ", " << 0 - perVolume[2]
	        << ") instead, which is the gradient itself and has the other sign.");
	pressureGradient = Vector3r::Zero() - perVolume;
}

void PorePressureEngine::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named)
{
	if (named.has_key("gradient")) setGradient(boost::python::extract<Vector3r>(named.attr("pop")("gradient")));
}

void PorePressureEngine::action()
{
	validate();
	const Vector3r gravity   = nscd::gravityOf(*scene);
	const Vector3r normal    = planeNormal.normalized();
	const Real     cosDip    = gravity.norm() > 0 ? -gravity.normalized().dot(normal) : 1;
	const Vector3r down      = gravity - gravity.dot(normal) * normal;
	const Vector3r downhill  = down.norm() > 1e-9 * gravity.norm() ? Vector3r(down.normalized())
	                                                               : Vector3r(Vector3r::Zero());
	const Vector3r perVolume = pressureGradient != Vector3r::Zero() ? minusPressureGradient()
	                                                                : Vector3r(unitWeight * cosDip * normal);
	height                   = heightAt(scene->time);
	wetCount                 = 0;
	releasedCount            = 0;
	totalForce               = Vector3r::Zero();

	nscd::Turn   turn(*this, nscd::threadsOf(*this));
	const auto&  bodies = turn.resident().bodies;
	const size_t size   = bodies.size();
	moved.resize(size, 0);
	everWet.resize(size, 0);
	wet.assign(size, 0);
	for (size_t id = reference.size(); id < size; ++id)
		reference.push_back(bodies[id].present ? bodies[id].place() : Vector3r(Vector3r::Zero()));
	for (size_t id = 0; id < size; ++id) {
		const auto& b = bodies[id];
		if (!b.present || b.blocked == State::DOF_ALL || b.radius < 0
		    || (mask != 0 && !(*scene->bodies)[id]->maskOk(mask)))
			continue;
		const Vector3r place = b.place();
		if (!moved[id] && (place - reference[id]).dot(downhill) > releaseDistance) moved[id] = 1;
		releasedCount += isReleased(id);
		if (moved[id] || height <= 0 || (place - planePoint).dot(normal) >= height) continue;
		const Vector3r force = perVolume * (volumeFactor * Mathr::PI * b.radius * b.radius * thickness);
		scene->forces.addForce(id, force);
		wet[id] = everWet[id] = 1;
		++wetCount;
		totalForce += force;
	}
	turn.end();
}

} // namespace yade
