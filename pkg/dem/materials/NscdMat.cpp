#include "NscdMat.hpp"
#include "../seam/PythonBytes.hpp"
#include "../checks/Refusal.hpp"
#include "../seam/SameBody.hpp"
#include <contact/slip/laws.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>
#include <mutex>

namespace yade {

YADE_PLUGIN((NscdMat)(SlipWeakeningMat));

void NscdMat::require(bool good, const char* name, Real value, const char* what) const
{
	if (!good)
		throw std::invalid_argument(
		        getClassName() + " '" + label + "': " + name + " = " + nscd::number(value) + ", it must be "
		        + what);
}

void NscdMat::checkNumbers() const
{
	using nscd::isNumber;
	const auto notNegative = [](Real value) { return value >= 0 && isNumber(value); };
	require(density > 0 && isNumber(density), "density", density,
	        "positive and finite [kg/m³], also for walls, which have no use for it");
	require(notNegative(tensileStrength), "tensileStrength", tensileStrength, "0 or more, and finite [Pa]");
	require(notNegative(residualTensileStrength), "residualTensileStrength", residualTensileStrength,
	        "0 or more, and finite [Pa]");
	require(frictionAngle >= 0 && frictionAngle < Mathr::PI / 2, "frictionAngle", frictionAngle,
	        "from 0 to below π/2 [rad]");
	require(residualFrictionAngle < Mathr::PI / 2 && isNumber(residualFrictionAngle), "residualFrictionAngle",
	        residualFrictionAngle, "below π/2 [rad] and finite, negative for the peak value");
	require(notNegative(rollingFriction), "rollingFriction", rollingFriction, "0 or more, and finite");
	require(isNumber(residualRollingFriction), "residualRollingFriction", residualRollingFriction,
	        "finite, negative for the peak value");
	require(notNegative(twistingFriction), "twistingFriction", twistingFriction, "0 or more, and finite");
	require(isNumber(residualTwistingFriction), "residualTwistingFriction", residualTwistingFriction,
	        "finite, negative for the peak value");
	require(bondEllipseNormal > 0, "bondEllipseNormal", bondEllipseNormal, "positive (units of ℓ)");
	require(bondEllipseTangential > 0, "bondEllipseTangential", bondEllipseTangential, "positive (units of ℓ)");
	require(bondEllipseTwisting != 0 && !std::isnan(bondEllipseTwisting), "bondEllipseTwisting",
	        bondEllipseTwisting, "positive [rad], or negative for 2 bondEllipseTangential");
	require(bondCreationDistance >= 0, "bondCreationDistance", bondCreationDistance, "0 or more (units of ℓ)");
	require(restitution >= 0 && restitution <= 1, "restitution", restitution, "from 0 to 1");
}

void NscdMat::validate() const
{
	checkNumbers();
	require(interfaceLaws.size() == interfaceLayers.size(), "len(interfaceLaws)", interfaceLaws.size(),
	        "that of interfaceLayers: give a law for each");
	for (const auto& law : interfaceLaws) {
		const auto* material = dynamic_cast<const NscdMat*>(law.get());
		if (!material)
			throw std::invalid_argument(
			        getClassName() + " '" + label
			        + "': interfaceLaws has what is no NscdMat: give NscdMats");
		if (material->isForWallsAlone())
			throw std::invalid_argument(
			        getClassName() + " '" + label + "': interfaceLaws has a " + material->getClassName()
			        + ", whose cells lie along walls: give an NscdMat or a SlipWeakeningMat");
		if (material->interfaceLaws.empty()) material->validate(); // an interface has none of its own
	}
}

bool NscdMat::changesPeakAlone()
{
	const bool alone = !std::isnan(knownPeak) && frictionAngle != knownPeak && residualFrictionAngle >= 0
	        && residualFrictionAngle == knownResidual;
	knownPeak     = frictionAngle;
	knownResidual = residualFrictionAngle;
	return alone;
}

const NscdMat* NscdMat::interfaceWith(const NscdMat& other) const
{
	const auto find = [](const NscdMat& one, int layer) -> const NscdMat* {
		for (size_t k = 0; k < std::min(one.interfaceLayers.size(), one.interfaceLaws.size()); ++k)
			if (one.interfaceLayers[k] == layer)
				return dynamic_cast<const NscdMat*>(one.interfaceLaws[k].get());
		return nullptr;
	};
	if (wall || other.wall) return nullptr;
	const NscdMat* law = find(*this, other.layer);
	return law ? law : find(other, layer);
}

void SlipWeakeningMat::validate() const
{
	NscdMat::validate();
	checkWeakening();
}

void SlipWeakeningMat::checkWeakening() const
{
	require(weakenedFrictionAngle >= 0 && weakenedFrictionAngle < Mathr::PI / 2, "weakenedFrictionAngle",
	        weakenedFrictionAngle, "from 0 to below π/2 [rad]");
	require(weakenedTensileStrength >= 0 && nscd::isNumber(weakenedTensileStrength), "weakenedTensileStrength",
	        weakenedTensileStrength, "0 or more, and finite [Pa]");
	if (!law) makeLaw(); // says why there is none
}

std::shared_ptr<const nonsmooth::contact::slip::BySlip> SlipWeakeningMat::makeLaw() const
{
	try {
		return nonsmooth::contact::slip::makeBySlip(weakening, criticalSlip);
	} catch (const std::invalid_argument& error) {
		throw std::invalid_argument(getClassName() + " '" + label + "': " + error.what());
	}
}

void SlipWeakeningMat::takeLaw()
{
	law.reset();
	law = makeLaw();
	checkWeakening();
}

Real SlipWeakeningMat::remaining(Body::id_t id) const
{
	// called by InteractionLoop's threads, which no exception may leave; refused where it was set, and by
	// ContactDynamicsEngine
	return law ? law->left(slipOf(id)) : 1;
}

void SlipWeakeningMat::weaken(Real& adhesion, Real& friction, Real length, Real left) const
{
	const auto weakened = [left](Real strong, Real weak) {
		return strong > weak ? weak + (strong - weak) * left : strong;
	};
	adhesion = weakened(adhesion, weakenedTensileStrength * length);
	friction = weakened(friction, std::tan(weakenedFrictionAngle));
}

namespace {
	std::mutex claiming; // contacts are made by all threads of a loop; of all materials, as it is seldom
}

void SlipWeakeningMat::noteOwner(Body::id_t id, const shared_ptr<Body>& body)
{
	const auto& bodies = Omega::instance().getScene()->bodies;
	if (home.lock() != bodies) {
		const bool loaded = owners.empty();
		if (!loaded) slip.clear(); // of another scene
		ofStep.clear();
		owners.clear();
		home = bodies;
		if (loaded) { // who is there is who has slipped, but for who was put in since
			for (size_t k = 0; k < std::min(slip.size(), bodies->size()); ++k)
				owners.push_back((*bodies)[k]);
			for (const int k : bodies->insertedBodies)
				if (size_t(k) < owners.size() && (*bodies)[k]
				    && (*bodies)[k]->iterBorn == Omega::instance().getScene()->iter)
					owners[k].reset();
		}
	}
	if (id >= (Body::id_t)owners.size()) owners.resize(id + 1);
	if (nscd::isSame(owners[id], body)) return;
	owners[id] = body;
	if (id < (Body::id_t)slip.size()) slip[id] = 0;
	if (id < (Body::id_t)ofStep.size()) ofStep[id] = { -1, 0 };
}

void SlipWeakeningMat::claim(const shared_ptr<Body>& body)
{
	const std::lock_guard<std::mutex> guard(claiming);
	noteOwner(body->getId(), body);
}

/// Of one that is gone the slip stays, until its id is used again.
void SlipWeakeningMat::forgetOthers()
{
	const auto                        bodies = Omega::instance().getScene()->bodies;
	const std::lock_guard<std::mutex> guard(claiming);
	if (!owners.empty() && home.lock() != bodies) return; // what was in another scene can be read in this one
	for (size_t id = 0; id < slip.size(); ++id)
		if (bodies->exists(id)) noteOwner(id, (*bodies)[id]);
}

void SlipWeakeningMat::forgetSlip()
{
	const std::lock_guard<std::mutex> guard(claiming);
	slip.clear();
	ofStep.clear();
	owners.clear();
}

Real SlipWeakeningMat::slipNow(Body::id_t id)
{
	forgetOthers();
	return slipOf(id);
}

void SlipWeakeningMat::addSlip(Body::id_t id, Real distance)
{
	if (id >= (Body::id_t)slip.size()) slip.resize(id + 1, 0.);
	slip[id] += distance;
}

void SlipWeakeningMat::addSlip(Body::id_t id, Real distance, long step)
{
	if (id >= (Body::id_t)ofStep.size()) ofStep.resize(id + 1, { -1, 0 });
	auto& [last, most] = ofStep[id];
	if (last != step) {
		last = step;
		most = 0;
	}
	if (!(distance > most)) return;
	addSlip(id, distance - most);
	most = distance;
}

boost::python::object SlipWeakeningMat::slipTable()
{
	forgetOthers();
	return nscd::asBytes(std::vector<double>(slip.begin(), slip.end()));
}

int SlipWeakeningMat::weakenedCount()
{
	forgetOthers();
	return (int)std::count_if(slip.begin(), slip.end(), [this](Real s) { return s >= criticalSlip; });
}

Real SlipWeakeningMat::meanSlip()
{
	forgetOthers();
	Real sum = 0;
	for (const Real s : slip)
		sum += s;
	const int count = slippedCount();
	return count > 0 ? sum / count : 0;
}

int SlipWeakeningMat::slippedCount()
{
	forgetOthers();
	return (int)std::count_if(slip.begin(), slip.end(), [](Real s) { return s > 0; });
}

} // namespace yade
