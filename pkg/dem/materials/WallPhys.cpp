#include "WallPhys.hpp"
#include "../checks/Refusal.hpp"
#include <boost/make_shared.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((WallPhys)(Ip2_NscdMat_FrictMat_WallPhys));

void WallPhys::postLoad(WallPhys&) const
{
	for (const auto& [name, value] :
	     { std::pair("length", length), std::pair("tensileForce", tensileForce), std::pair("friction", friction),
	       std::pair("residualFriction", residualFriction), std::pair("rollingArm", rollingArm),
	       std::pair("residualRollingArm", residualRollingArm), std::pair("kr", kr) })
		nscd::require(value >= 0 && nscd::isNumber(value), "WallPhys", name, value, "0 or more, and finite");
	for (const auto& [name, value] :
	     { std::pair("rollingTorque", rollingTorque), std::pair("restPenetration", restPenetration) })
		nscd::require(nscd::isNumber(value), "WallPhys", name, value, "finite");
}

void Ip2_NscdMat_FrictMat_WallPhys::postLoad(Ip2_NscdMat_FrictMat_WallPhys&) const
{
	nscd::require(
	        rollingRatio >= 0 && nscd::isNumber(rollingRatio), getClassName(), "rollingRatio", rollingRatio,
	        "0 or more, and finite");
}

void Ip2_NscdMat_FrictMat_WallPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	const auto& wall   = static_cast<const NscdMat&>(*m1);
	const auto& disk   = static_cast<const FrictMat&>(*m2);
	const Real  radius = static_cast<const GenericSpheresContact&>(*interaction->geom).refR2;
	const auto  paired = [radius](Real a, Real b) { return a + b > 0 ? 2 * radius * a * b / (a + b) : Real(0); };

	const auto phys          = boost::make_shared<WallPhys>();
	phys->length             = 2 * radius;
	phys->kn                 = paired(wall.young, disk.young);
	phys->ks                 = paired(wall.young * wall.poisson, disk.young * disk.poisson);
	phys->kr                 = rollingRatio * phys->ks * radius * radius;
	phys->tensileForce       = wall.tensileStrength * phys->length;
	phys->friction           = std::tan(wall.frictionAngle);
	phys->residualFriction   = std::tan(nscd::residual(wall.residualFrictionAngle, wall.frictionAngle));
	phys->rollingArm         = wall.rollingFriction * phys->length;
	phys->residualRollingArm = nscd::residual(wall.residualRollingFriction, wall.rollingFriction) * phys->length;
	phys->body               = interaction->getId2();
	phys->wallMaterial       = boost::dynamic_pointer_cast<SlipWeakeningMat>(m1);
	if (phys->wallMaterial) phys->wallMaterial->claim(Body::byId(phys->body));
	phys->tangensOfFrictionAngle = phys->residualFriction;
	interaction->phys            = phys;
}

} // namespace yade
