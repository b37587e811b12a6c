#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "../checks/SceneCheck.hpp"
#include "../walls/Segment.hpp"
#include "../checks/Seldom.hpp"
#include "../space/FaceGeom.hpp"
#include "../space/SpaceBond.hpp"
#include <core/Omega.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((Law2_ScGeom_NscdPhys_SignoriniCoulomb));
CREATE_LOGGER(Law2_ScGeom_NscdPhys_SignoriniCoulomb);

/// Behind YADE's own loop, whose threads no exception may leave, a missing solver can only be told of;
/// NscdInteractionLoop refuses it.
void Law2_ScGeom_NscdPhys_SignoriniCoulomb::expectSolver()
{
	if (looked == scene->iter || looked.exchange(scene->iter) == scene->iter || nscd::hasSolver(*scene)) return;
	if (nscd::seldom(++unsolved)) LOG_ERROR("step " << scene->iter << ": " << nscd::noSolver(*scene));
}

void Law2_ScGeom_NscdPhys_SignoriniCoulomb::followBond(
        NscdPhys& phys, Real gap, const Vector3r& normal, const nscd::BondPair& pair) const
{
	namespace plane = nonsmooth::contact::plane;
	const auto gone = nscd::bondDisplacement(phys, *pair.first->state, *pair.second->state);
	if (!plane::bondLives(
	            phys.closes ? plane::ofClosing(gone) : gone, { phys.ellipseNormal, phys.ellipseTangential })
	    && phys.ellipseNormal > 0 && phys.ellipseTangential > 0) { // else it is refused in this step
		breakBond(phys);
		return;
	}
	if (phys.yielded) phys.restGap = plane::grownRestGap(phys.restGap, gap);
	phys.errorSlip = phys.errorTurn = 0;
	if (!phys.slid && !phys.rolled && !phys.joins) return;
	plane::BondStrain rest { phys.restSlip, phys.restTurn };
	const auto error = plane::unyielded(nscd::bondStrain(phys, pair, normal, gap), phys.slid, phys.rolled, rest);
	phys.restSlip    = rest.slip;
	phys.restTurn    = rest.turn;
	phys.errorSlip   = error.slip;
	phys.errorTurn   = error.turn;
}

bool Law2_ScGeom_NscdPhys_SignoriniCoulomb::go(shared_ptr<IGeom>& ig, shared_ptr<IPhys>& ip, Interaction* interaction)
{
	expectSolver();
	const auto& geom = static_cast<const ScGeom&>(*ig);
	if (typeid(*ip) == typeid(NscdPhys)) {
		const auto &b1 = *Body::byId(interaction->getId1(), scene),
		           &b2 = *Body::byId(interaction->getId2(), scene);
		if (const auto made = Ip2_NscdMat_NscdMat_NscdPhys::released(*interaction, b1, b2)) {
			nscd::letGo(ip);
			ip = made;
		}
	}
	auto&      phys = static_cast<NscdPhys&>(*ip);
	const Real gap  = -geom.penetrationDepth;

	if (phys.bonded) {
		const auto pair = nscd::bondPair(
		        *Body::byId(interaction->getId1(), scene), *Body::byId(interaction->getId2(), scene));
		const Vector3r normal  = pair.swapped ? Vector3r(-geom.normal) : geom.normal;
		auto*          inSpace = dynamic_cast<NscdSpacePhys*>(&phys);
		if (phys.isBondWanted())
			inSpace ? nscd::markBondInSpace(*inSpace, pair, normal, gap)
			        : nscd::markBond(phys, pair, normal, gap);
		if (!inSpace) followBond(phys, gap, normal, pair);
		else if (!nscd::followBondInSpace(*inSpace, pair, gap)) {
			breakBond(phys);
			phys.brokenMode = nscd::bondModeInSpace(*inSpace);
		}
	}
	if (!keeps(phys, gap)) return false;
	if (!phys.bonded && !phys.breaks && typeid(geom) != typeid(ScGeom)) {
		const auto* wall = dynamic_cast<const SegmentGeom*>(&geom);
		const auto* face = dynamic_cast<const FaceGeom*>(&geom);
		if ((wall && !wall->owned) || (face && !face->owned)) return false;
	}
	phys.updateThresholds(gap, adhesionRange);
	phys.touched = true;
	return true;
}

} // namespace yade
