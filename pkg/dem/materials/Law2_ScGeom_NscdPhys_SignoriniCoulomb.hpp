// The part of the nonsmooth cohesive law that belongs to one contact: does it exist, does its bond live, what are its
// thresholds.
//
// Bond (Taboada and Estrada 2009, section 2.2.2, Figure 2b; equations in contact/plane/bond.hpp): it lives in an
// ellipse fixed to the first of its bodies and is lost for good when it leaves; peak strengths hold until then,
// residual ones from then on (contact/plane/thresholds.hpp).
// Deviation: none. Choices where the paper is silent: a bond that has opened in tension keeps its new length under
// compression (eq. 1 knows no gap); a contact that is not bonded has the residual adhesion while its gap is below
// adhesionRange; the first body is the wall, or that of lower id. The reactions themselves are found by
// ContactDynamicsEngine for all contacts at once.
#pragma once

#include "BondEllipse.hpp"
#include <core/Dispatching.hpp>
#include <core/Scene.hpp>
#include <atomic>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

class Law2_ScGeom_NscdPhys_SignoriniCoulomb : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override;
	FUNCTOR2D(ScGeom, NscdPhys);
	/// Follows a bond with the gap [m] and the normal that it has now, from its first body to its second.
	void followBond(NscdPhys& phys, Real gap, const Vector3r& normal, const nscd::BondPair& pair) const;
	/// Ends a bond that has left its ellipse in this step.
	void breakBond(NscdPhys& phys) const
	{
		phys.bonded     = false;
		phys.axis       = Vector3r::Zero();
		phys.brokenMode = nscd::bondMode(phys.yieldPath);
		phys.brokenStep = scene->iter;
		phys.breaks     = true;
	}
	/// Whether a contact with that gap is kept; one whose bond broke in this step stays for the step, to be
	/// counted.
	bool keeps(const NscdPhys& phys, Real gap) const
	{
		return phys.bonded || phys.breaks || isWithinReach(gap, phys.length);
	}
	bool isWithinReach(Real gap, Real length) const { return gap <= reach * length; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Law2_ScGeom_NscdPhys_SignoriniCoulomb,LawFunctor,
R"""(Nonsmooth cohesive contact of rigid bodies: Signorini's condition with a tensile threshold, Coulomb friction and rolling friction, all
three with a threshold proportional to :math:`F_a+N` (Taboada and Estrada 2009, eqs 1 to 6). This functor follows the bonds and sets the thresholds;
:yref:`ContactDynamicsEngine` finds the reactions.)""",
		((Real,reach,0.05,,"A contact without a bond is forgotten when its gap exceeds this distance [ℓ]; keep it at the "
		        "functors' interactionDetectionFactor − 1, and above the path of a step at the greatest speed."))
		((Real,adhesionRange,1e-3,,"Gap [ℓ] up to which a contact without a bond counts as touching for the residual tensile strength."))
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	void expectSolver();

	std::atomic<long> looked { -1 }; // the step in which a solver was looked for
	std::atomic<long> unsolved { 0 }; // steps without one
};
REGISTER_SERIALIZABLE(Law2_ScGeom_NscdPhys_SignoriniCoulomb);

} // namespace yade
