#include "SpaceBond.hpp"

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

void markBondInSpace(NscdSpacePhys& phys, const BondPair& pair, const Vector3r& normal, Real gap)
{
	markBond(phys, pair, normal, gap);
	phys.bondTurn     = pair.first->state->ori.conjugate() * pair.second->state->ori;
	phys.twistingPath = 0;
}

space::BondDisplacement bondDisplacementInSpace(const NscdSpacePhys& phys, const State& first, const State& second)
{
	const Vector3r d  = second.pos + second.ori * phys.anchor2 - first.pos - first.ori * phys.anchor1,
	               n  = first.ori * phys.axis;
	const Real normal = d.dot(n);
	// seen from the first body; of the two rotations that lead there the smaller one
	const Quaternionr turned = first.ori.conjugate() * second.ori * phys.bondTurn.conjugate();
	const Vector3r    sine   = turned.w() < 0 ? Vector3r(-turned.vec()) : Vector3r(turned.vec());
	const Real        length = sine.norm(), angle = 2 * std::atan2(length, std::abs(turned.w()));
	return { normal, (d - normal * n).norm(), length > 0 ? angle / length * sine.dot(phys.axis) : 0 };
}

bool followBondInSpace(NscdSpacePhys& phys, const BondPair& pair, Real gap)
{
	const space::BondEllipsoid zone { phys.ellipseNormal, phys.ellipseTangential, phys.ellipseTwisting };
	const auto                 gone = bondDisplacementInSpace(phys, *pair.first->state, *pair.second->state);
	if (zone.normal > 0 && zone.tangential > 0 && zone.twisting > 0 // else it is refused in this step
	    && !space::bondLives(gone, zone, phys.closes))
		return false;
	if (phys.yielded) phys.restGap = nonsmooth::contact::plane::grownRestGap(phys.restGap, gap);
	return true;
}

NscdPhys::Mode bondModeInSpace(const NscdSpacePhys& phys)
{
	using space::BreakMode;
	static_assert(
	        int(BreakMode::Tension) == NscdPhys::Tension && int(BreakMode::Shear) == NscdPhys::Shear
	        && int(BreakMode::Rolling) == NscdPhys::Torque && int(BreakMode::Mixed) == NscdPhys::Mixed
	        && int(BreakMode::Twisting) == NscdPhys::Twisting);
	const Vector3r& path = phys.yieldPath;
	return static_cast<NscdPhys::Mode>(space::breakMode({ path[0], path[1], path[2], phys.twistingPath }));
}

} // namespace yade::nscd
