#include "BondEllipse.hpp"
#include "../seam/PlaneMotion.hpp"
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

void markBond(NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap)
{
	const auto* second = dynamic_cast<const Sphere*>(pair.second->shape.get());
	markPoints(phys, *pair.first->state, *pair.second->state, normal, second ? second->radius : 0);
	phys.restGap = nonsmooth::contact::plane::firstRestGap(gap);
	phys.bonded  = true;
	phys.yielded = phys.slid = phys.rolled = false;
	phys.restSlip = phys.restTurn = 0;
	phys.brokenMode               = NscdPhys::None;
	phys.brokenStep               = -1;
	phys.breaks                   = false;
	phys.yieldPath                = Vector3r::Zero();
}

nonsmooth::contact::plane::BondStrain
bondStrain(const NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap)
{
	namespace plane     = nonsmooth::contact::plane;
	const auto radiusOf = [](const Body& b) {
		const auto* sphere = dynamic_cast<const Sphere*>(b.shape.get());
		return sphere ? sphere->radius : 0;
	};
	const State &first = *pair.first->state, &second = *pair.second->state;
	const Real   r1 = radiusOf(*pair.first), r2 = radiusOf(*pair.second);
	if (r1 > 0)
		return plane::bondStrain(
		        { { phys.anchor1[0], phys.anchor1[1] },
		          { phys.anchor2[0], phys.anchor2[1] },
		          { phys.axis[0], phys.axis[1] } },
		        motionOf(first), motionOf(second), { normal[0], normal[1] }, r1 + 0.5 * gap, r2 + 0.5 * gap,
		        r2);
	// on a wall the point moves with the disk's centre and its turn
	const Vector3r n = first.ori * phys.axis, a = second.ori * phys.anchor2;
	const Real     sine = (a[0] * n[1] - a[1] * n[0]) / r2, angle = plane::smallAngle(sine);
	return { bondDisplacement(phys, first, second).tangential - r2 * (angle - sine), angle };
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
