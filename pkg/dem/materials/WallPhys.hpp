// A soft contact of a disk with a wall that has the strengths of the hard law: the counterpart of NscdPhys for YADE's
// soft models.
#pragma once

#include "NscdMat.hpp"
#include "../seam/PythonMade.hpp"
#include <core/Dispatching.hpp>
#include <pkg/dem/FrictPhys.hpp>

namespace yade {

class WallPhys : public FrictPhys {
public:
	virtual ~WallPhys() { nscd::letGo(wallMaterial); }
	/// A script has set a number: refused at once, since no exception may leave the threads of YADE's loop.
	void postLoad(WallPhys&) const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(WallPhys,FrictPhys,
R"""(Springs of a disk at a wall with the strengths of the wall's :yref:`NscdMat` (Taboada and Estrada 2009, section 3.3), see
:yref:`Law2_SegmentGeom_WallPhys_SlipWeakening`. :yref:`tangensOfFrictionAngle<FrictPhys.tangensOfFrictionAngle>` is the friction of the last step.)""",
		((bool,bonded,false,,"The contact is bonded; peak strengths hold. Breaks for good."))
		((bool,fragile,true,,"The bond breaks where it reaches a threshold; else it yields there, and :yref:`BondEllipseEngine` breaks it."))
		((Real,length,0,Attr::triggerPostLoad,"ℓ [m]: the disk's diameter."))
		((Real,tensileForce,0,Attr::triggerPostLoad,"F_a of the bond, σ_ext ℓ [N]."))
		((Real,friction,0,Attr::triggerPostLoad,"Friction μ_s of the bond [-]."))
		((Real,residualFriction,0,Attr::triggerPostLoad,"Friction without a bond [-]."))
		((Real,rollingArm,0,Attr::triggerPostLoad,"μ_r ℓ of the bond [m]."))
		((Real,residualRollingArm,0,Attr::triggerPostLoad,"μ_r ℓ without a bond [m]."))
		((Real,kr,0,Attr::triggerPostLoad,"Rolling stiffness [N m]."))
		((Real,rollingTorque,0,Attr::triggerPostLoad,"Torque about z on the disk by the rolling spring [N m]."))
		((Real,restPenetration,0,Attr::triggerPostLoad,"Penetration at which the bond bears no force [m]; negative for one made over a gap."))
		((Body::id_t,body,-1,Attr::readonly,"The disk."))
		((shared_ptr<SlipWeakeningMat>,wallMaterial,,Attr::readonly,"The wall's material where it weakens by slip, which it keeps."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(WallPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(WallPhys);

class Ip2_NscdMat_FrictMat_WallPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>& wall, const shared_ptr<Material>& disk,
	        const shared_ptr<Interaction>& interaction) override;
	void goReverse(
	        const shared_ptr<Material>& disk, const shared_ptr<Material>& wall,
	        const shared_ptr<Interaction>& interaction) override
	{
		go(wall, disk, interaction);
	}
	void postLoad(Ip2_NscdMat_FrictMat_WallPhys&) const;
	FUNCTOR2D(NscdMat, FrictMat);
	DEFINE_FUNCTOR_ORDER_2D(NscdMat, FrictMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_NscdMat_FrictMat_WallPhys,IPhysFunctor,
R"""(Make a :yref:`WallPhys` from the :yref:`NscdMat` of a wall, which alone gives the strengths, and the material of a disk with springs.
Stiffnesses come from ``young`` and ``poisson`` of both, as :yref:`Ip2_FrictMat_FrictMat_FrictPhys` has them: k_n = E R for equal ones.)""",
		((Real,rollingRatio,1,Attr::triggerPostLoad,"k_r/(k_s R²), as :yref:`CohFrictMat.alphaKr` is between disks."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ip2_NscdMat_FrictMat_WallPhys);

} // namespace yade
