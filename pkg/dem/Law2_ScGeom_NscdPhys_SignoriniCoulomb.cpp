#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "BondEllipse.hpp"
#include "Segment.hpp"
#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Law2_ScGeom_NscdPhys_SignoriniCoulomb));

bool Law2_ScGeom_NscdPhys_SignoriniCoulomb::go(shared_ptr<IGeom>& ig, shared_ptr<IPhys>& ip, Interaction* interaction)
{
	const auto& geom = static_cast<const ScGeom&>(*ig);
	auto&       phys = static_cast<NscdPhys&>(*ip);
	const Real  gap  = -geom.penetrationDepth;

	if (phys.bonded) {
		const auto pair = nscd::bondPair(*Body::byId(interaction->getId1(), scene), *Body::byId(interaction->getId2(), scene));
		const auto [dn, dt] = nscd::bondDisplacement(phys, pair);
		const Real zone     = std::pow(dn / phys.ellipseNormal, 2) + std::pow(dt / phys.ellipseTangential, 2);
		if (zone >= 1) {
			phys.bonded     = false;
			phys.brokenMode = nscd::bondMode(phys);
			phys.brokenStep = scene->iter;
		} else if (phys.yielded)
			phys.restGap = std::max(phys.restGap, gap);
	}
	// a contact whose bond broke in this step stays for the step, to be counted
	if (!phys.bonded && phys.brokenStep != scene->iter) {
		if (gap > reach * phys.length) return false;
		if (const auto* wall = dynamic_cast<const SegmentGeom*>(&geom))
			if (!wall->owned) return false;
	}
	phys.updateThresholds(gap, adhesionRange);
	return true;
}

} // namespace yade
