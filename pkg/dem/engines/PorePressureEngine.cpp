#include "PorePressureEngine.hpp"
#include "../seam/EngineRoles.hpp"
#include "Gravity.hpp"
#include "../seam/PythonBytes.hpp"
#include "ListChecks.hpp"
#include "../seam/SameBody.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

YADE_PLUGIN((PorePressureEngine));
CREATE_LOGGER(PorePressureEngine);
[[maybe_unused]] static const bool porePressureEngineRole = nscd::giveRole(
        typeid(PorePressureEngine), nscd::EngineRole::TakesTurns);

void PorePressureEngine::validate() const
{
	for (const auto& [name, value] : { std::pair("unitWeight", unitWeight), std::pair("volumeFactor", volumeFactor),
	                                   std::pair("thickness", thickness) })
		nscd::require(
		        value >= 0 && nscd::isNumber(value), "PorePressureEngine", name, value,
		        "0 or more, and finite");
	nscd::require(
	        releaseDistance >= 0, "PorePressureEngine", "releaseDistance", releaseDistance,
	        "0 or more [m]; infinite, and water acts on a body wherever it goes");
	for (size_t id = 0; id < releasedShare.size(); ++id)
		if (!(releasedShare[id] >= 0 && releasedShare[id] <= 1))
			throw std::invalid_argument(
			        "PorePressureEngine: releasedShare[" + std::to_string(id)
			        + "] = " + nscd::number(releasedShare[id]) + ": give a share from 0 to 1");
	for (const auto& [name, values] :
	     { std::pair("planePoint", &planePoint), std::pair("planeNormal", &planeNormal),
	       std::pair("pressureGradient", &pressureGradient) })
		for (int k = 0; k < 3; ++k)
			if (!nscd::isNumber((*values)[k]))
				throw std::invalid_argument(
				        string("PorePressureEngine: ") + name + "[" + std::to_string(k)
				        + "] = " + nscd::number((*values)[k]) + ": give a finite number");
	for (const auto& [name, values] :
	     { std::pair("planeNormal", &planeNormal), std::pair("pressureGradient", &pressureGradient) })
		if ((*values)[2] != 0)
			throw std::invalid_argument(
			        string("PorePressureEngine: ") + name + "[2] = " + nscd::number((*values)[2])
			        + ": give 0, as bodies stay in the x-y plane");
	if (planeNormal.norm() < 1 / nscd::hugest)
		throw std::invalid_argument(
		        "PorePressureEngine: planeNormal = (0, 0, 0): give the direction from the sliding plane to the water");
}

Real PorePressureEngine::heightAt(Real time) const
{
	if (times.size() != heights.size())
		throw std::invalid_argument(
		        "PorePressureEngine: times has " + std::to_string(times.size()) + " entries and heights "
		        + std::to_string(heights.size()) + ": give as many of both");
	nscd::requireNumbers("PorePressureEngine", "times", times);
	nscd::requireNumbers("PorePressureEngine", "heights", heights);
	if (times.empty()) return 0;
	nscd::requireRising("PorePressureEngine", times, false);
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

/// What was noted of bodies that are gone, or whose id another one has now.
void PorePressureEngine::forgetOthers(const nscd::Resident& resident)
{
	const auto& bodies = *scene->bodies;
	if (lookedAt.lock().get() == &resident && looked == resident.taken && owners.size() == bodies.size()) return;
	lookedAt = nscd::Resident::of(*scene);
	looked   = resident.taken;
	if (owners.empty()) // new, or loaded: those that are there are those that were, but for what was put in since
		for (const int id : bodies.insertedBodies)
			if (bodies.exists(id) && bodies[id]->iterBorn == scene->iter) forgetWayOf(id);
	const size_t known = owners.size();
	owners.resize(bodies.size());
	for (size_t id = 0; id < owners.size(); ++id) {
		if (id < known && !nscd::isSame(owners[id], bodies[id])) forgetWayOf(id);
		owners[id] = bodies[id];
	}
	for (size_t id = 0; id < reference.size(); ++id)
		if (std::isnan(reference[id][0]) && bodies.exists(id)) reference[id] = resident.bodies[id].place();
}

void PorePressureEngine::forgetWayOf(size_t id)
{
	if (id < reference.size()) reference[id].setConstant(NaN); // until the body is met
	if (id < moved.size()) moved[id] = 0;
	if (id < everWet.size()) everWet[id] = 0;
	if (id < releasedShare.size()) releasedShare[id] = 0;
}

void PorePressureEngine::preSave(PorePressureEngine&)
{
	const auto& bodies = *Omega::instance().getScene()->bodies;
	if (const auto resident = lookedAt.lock(); resident != nscd::Resident::of(*Omega::instance().getScene()))
		return;
	for (size_t id = 0; id < std::min(owners.size(), bodies.size()); ++id)
		if (!nscd::isSame(
		            owners[id],
		            bodies[id])) { // of one that is gone, too: who takes its id later could not be told from it
			forgetWayOf(id);
			owners[id] = bodies[id];
		}
}

bool PorePressureEngine::wets(const Vector3r& place, const Vector3r& normal, Vector3r& perVolume) const
{
	if (!field) return !(height <= 0 || (place - planePoint).dot(normal) >= height);
	const auto water = field->at(place);
	if (!(water.pressure > 0)) return false;
	perVolume = -water.gradient;
	return true;
}

void PorePressureEngine::action()
{
	nscd::Turn turn(
	        *this,
	        nscd::threadsOf(*this)); // first: a refusal shows what the engines before have left in the arrays
	validate();
	const Vector3r gravity = nscd::gravityOf(*scene);
	const Vector3r normal  = planeNormal.normalized();
	if (gravity.dot(normal) > 0)
		throw std::invalid_argument(
		        "PorePressureEngine: planeNormal = (" + nscd::number(planeNormal[0]) + ", "
		        + nscd::number(planeNormal[1])
		        + ", 0) points along gravity: give the direction from the sliding plane up into the slope");
	const Real     cosDip    = gravity.norm() > 0 ? -gravity.normalized().dot(normal) : 1;
	const Vector3r down      = gravity - gravity.dot(normal) * normal;
	const Vector3r downhill  = down.norm() > 1e-9 * gravity.norm() ? Vector3r(down.normalized())
	                                                               : Vector3r(Vector3r::Zero());
	Vector3r       perVolume = pressureGradient != Vector3r::Zero() ? minusPressureGradient()
	                                                                : Vector3r(unitWeight * cosDip * normal);
	height                   = field ? 0 : heightAt(scene->time);
	wetCount                 = 0;
	releasedCount            = 0;
	totalForce               = Vector3r::Zero();
	if (field) field->prepare(scene->time);

	const auto&  bodies = turn.resident().bodies;
	const size_t size   = bodies.size();
	moved.resize(size, 0);
	everWet.resize(size, 0);
	wet.assign(size, 0);
	forgetOthers(turn.resident());
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
		if (drained(id) || !wets(place, normal, perVolume)) continue;
		Vector3r force = perVolume * (volumeFactor * Mathr::PI * b.radius * b.radius * thickness);
		force *= 1 - shareReleased(id);
		scene->forces.addForce(id, force);
		wet[id] = everWet[id] = 1;
		++wetCount;
		totalForce += force;
	}
	turn.end();
}

} // namespace yade
