#include "BondEllipse.hpp"
#include <pkg/common/Sphere.hpp>

namespace yade::nscd {

BondPair bondPair(const Body& b1, const Body& b2)
{
	// almost all are, and this class itself is recognised without a search
	const auto isSphere = [](const Shape& s) {
		return typeid(s) == typeid(Sphere) || dynamic_cast<const Sphere*>(&s);
	};
	const bool sphere1 = isSphere(*b1.shape), sphere2 = isSphere(*b2.shape);
	const bool swap = sphere1 == sphere2 ? b1.getId() > b2.getId() : sphere1;
	return swap ? BondPair { &b2, &b1, true } : BondPair { &b1, &b2, false };
}

void markBond(NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap, Real secondRadius)
{
	markPoints(phys, *pair.first->state, *pair.second->state, normal, secondRadius);
	phys.restGap    = nonsmooth::contact::plane::firstRestGap(gap);
	phys.bonded     = true;
	phys.yielded    = false;
	phys.brokenMode = NscdPhys::None;
	phys.yieldPath  = Vector3r::Zero();
}

NscdPhys::Mode bondMode(const Vector3r& yieldPath)
{
	namespace plane = nonsmooth::contact::plane;
	using plane::BreakMode;
	static_assert(
	        int(BreakMode::Tension) == NscdPhys::Tension && int(BreakMode::Shear) == NscdPhys::Shear
	        && int(BreakMode::Torque) == NscdPhys::Torque && int(BreakMode::Mixed) == NscdPhys::Mixed);
	return static_cast<NscdPhys::Mode>(plane::breakMode({ yieldPath[0], yieldPath[1], yieldPath[2] }));
}

} // namespace yade::nscd
