#include "Law2_SegmentGeom_WallPhys_SlipWeakening.hpp"
#include <contact/plane/thresholds.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Law2_SegmentGeom_WallPhys_SlipWeakening));

namespace {
	using nonsmooth::contact::plane::Thresholds;

	Thresholds strengths(const WallPhys& phys, Real left)
	{
		Thresholds s = nonsmooth::contact::plane::thresholdsOf(
		        { phys.tensileForce, phys.friction, phys.rollingArm },
		        { 0, phys.residualFriction, phys.residualRollingArm }, phys.bonded, true);
		if (phys.wallMaterial) phys.wallMaterial->weaken(s.adhesion, s.friction, phys.length, left);
		return s;
	}
}

bool Law2_SegmentGeom_WallPhys_SlipWeakening::go(shared_ptr<IGeom>& ig, shared_ptr<IPhys>& ip, Interaction* interaction)
{
	auto& geom = static_cast<SegmentGeom&>(*ig);
	auto& phys = static_cast<WallPhys&>(*ip);
	if (!phys.bonded && (geom.penetrationDepth < 0 || !geom.owned)) return false;

	const State& wall  = *Body::byId(interaction->getId1(), scene)->state;
	const State& disk  = *Body::byId(interaction->getId2(), scene)->state;
	Vector3r&    shear = geom.rotate(phys.shearForce);
	shear -= phys.ks * geom.shearIncrement();
	phys.rollingTorque -= phys.kr * (disk.angVel[2] - wall.angVel[2]) * scene->dt;

	Real left = 1;
	if (phys.wallMaterial) {
		const std::lock_guard<std::mutex> guard(slipLock);
		left = phys.wallMaterial->remaining(phys.body);
	}
	const auto normalForce = [&] {
		return phys.kn * (geom.penetrationDepth - (phys.bonded ? phys.restPenetration : 0));
	};
	Thresholds s      = strengths(phys, left);
	Real       normal = normalForce(), held = s.adhesion + normal;
	if (phys.bonded && phys.fragile
	    && (held < 0 || shear.norm() > s.friction * held || std::abs(phys.rollingTorque) > s.rollingArm * held)) {
		phys.bonded = false;
		if (geom.penetrationDepth < 0 || !geom.owned) return false;
		s      = strengths(phys, left);
		normal = normalForce();
		held   = s.adhesion + normal;
	}
	if (held < 0) { // a ductile bond yields in tension and keeps its new length
		phys.restPenetration = geom.penetrationDepth + s.adhesion / phys.kn;
		normal               = -s.adhesion;
		held                 = 0;
	}
	const Real sliding = s.friction * held, trial = shear.norm();
	if (trial > sliding) {
		shear *= sliding / trial;
		const Real slip = (trial - sliding) / phys.ks;
		if (phys.wallMaterial || scene->trackEnergy) {
			const std::lock_guard<std::mutex> guard(slipLock);
			if (phys.wallMaterial) {
				phys.wallMaterial->claim(Body::byId(phys.body, scene));
				phys.wallMaterial->addSlip(phys.body, slip);
			}
			int place = -1; // looked up, since O.energy.clear() may have moved it
			if (scene->trackEnergy) scene->energy->add(slip * sliding, "plastDissip", place);
		}
	}
	const Real rolling          = s.rollingArm * held;
	phys.rollingTorque          = std::max(-rolling, std::min(rolling, phys.rollingTorque));
	phys.tangensOfFrictionAngle = s.friction;
	phys.normalForce            = normal * geom.normal;

	applyForceAtContactPoint(
	        -phys.normalForce - shear, geom.contactPoint, interaction->getId1(), wall.se3.position,
	        interaction->getId2(), disk.se3.position);
	scene->forces.addTorque(interaction->getId1(), Vector3r(0, 0, -phys.rollingTorque));
	scene->forces.addTorque(interaction->getId2(), Vector3r(0, 0, phys.rollingTorque));
	return true;
}

} // namespace yade
