#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
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
		followBond(phys, gap, *pair.first->state, *pair.second->state);
	}
	if (!keeps(phys, gap)) return false;
	if (!phys.bonded && phys.brokenStep != scene->iter)
		if (const auto* wall = dynamic_cast<const SegmentGeom*>(&geom))
			if (!wall->owned) return false;
	phys.updateThresholds(gap, adhesionRange);
	return true;
}

} // namespace yade
