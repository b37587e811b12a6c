#include "BondEllipse.hpp"
#include <pkg/common/Sphere.hpp>

namespace yade::nscd {

BondPair bondPair(const Body& b1, const Body& b2)
{
	// almost all are, and this class itself is recognised without a search
	const auto isSphere = [](const Shape& s) { return typeid(s) == typeid(Sphere) || dynamic_cast<const Sphere*>(&s); };
	const bool sphere1 = isSphere(*b1.shape), sphere2 = isSphere(*b2.shape);
	const bool swap    = sphere1 == sphere2 ? b1.getId() > b2.getId() : sphere1;
	return swap ? BondPair { &b2, &b1, true } : BondPair { &b1, &b2, false };
}

void markBond(NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap, Real secondRadius)
{
	markPoints(phys, *pair.first->state, *pair.second->state, normal, secondRadius);
	phys.restGap    = std::max(gap, Real(0));
	phys.bonded     = true;
	phys.yielded    = false;
	phys.brokenMode = NscdPhys::None;
	phys.yieldPath  = Vector3r::Zero();
}

NscdPhys::Mode bondMode(const Vector3r& yieldPath)
{
	const Real sum = yieldPath.sum();
	if (!(sum > 0)) return NscdPhys::Mixed;
	int            most;
	const Real     largest = yieldPath.maxCoeff(&most);
	constexpr Real clear   = 0.6; // of the whole path, for one mode to name the break
	return largest > clear * sum ? static_cast<NscdPhys::Mode>(NscdPhys::Tension + most) : NscdPhys::Mixed;
}

} // namespace yade::nscd
