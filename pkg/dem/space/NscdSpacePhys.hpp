// State of a nonsmooth cohesive contact of bodies that move in space: what NscdPhys has of one in the plane, with
// reactions that are vectors, and twisting.
//
// Thresholds, with F_a = σ A, the area A = π/4 ℓ² of a contact between spheres (in the plane F_a = σ ℓ, per metre of
// thickness):
//     |T| ≤ μ_s (F_a + N)  sliding,   |M_r| ≤ μ_r ℓ (F_a + N)  rolling,   |M_n| ≤ μ_tw ℓ (F_a + N)  twisting.
// Forces and torques act on the second body of the interaction; M_r is at right angles to the normal, M_n along it.
#pragma once

#include "../materials/NscdPhys.hpp"
#include <lib/high-precision/Constants.hpp>

namespace yade {

class NscdSpacePhys : public NscdPhys {
public:
	virtual ~NscdSpacePhys() = default;
	void                         updateThresholds(Real gap, Real adhesionRange) override;
	std::pair<const char*, Real> senseless() const override;
	bool                         makesSenseAtOnce() const
	{
		const Real least = std::min(twistingArm, residualTwistingArm), sum = twistingArm + residualTwistingArm;
		return NscdPhys::makesSenseAtOnce() && least >= 0 && nscd::isNumber(sum)
		        && (!bonded || ellipseTwisting > 0);
	}
	/// Makes of strengths in the plane, as Ip2_NscdMat_NscdMat_NscdPhys sets them, those in space: tension on an
	/// area, and twisting.
	void setStrengths(const NscdMat& a, const NscdMat& b);
	/// Area [m²] on which the tensile strength of a contact of that length acts.
	static Real areaOf(Real length) { return 0.25 * Mathr::PI * length * length; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(NscdSpacePhys,NscdPhys,
R"""(Contact of two :yref:`NscdMats<NscdMat>` in space. :yref:`normalForce<NormPhys.normalForce>`, :yref:`shearForce<NormShearPhys.shearForce>`,
rollingTorque and twistingTorque are the reactions on the second body; :yref:`normal<NscdPhys.normal>` is the normal one's size, compression positive,
:yref:`tangential<NscdPhys.tangential>` and :yref:`torque<NscdPhys.torque>` the sizes of the shear force and of the rolling torque. The tensile strength of a bond acts on the area
π/4 ℓ².)""",
		((Vector3r,rollingTorque,Vector3r::Zero(),Attr::readonly,"Rolling reaction [N m] on the second body, at right angles to the normal."))
		((Real,twistingTorque,0,Attr::readonly,"Twisting reaction [N m] on the second body, about the normal from the first body to the second."))
		((Real,twistingArm,0,Attr::triggerPostLoad,"μ_tw ℓ of a bond [m]."))
		((Real,residualTwistingArm,0,Attr::triggerPostLoad,"μ_tw ℓ of a contact that is not bonded [m]."))
		((Real,ellipseTwisting,0,Attr::triggerPostLoad,"ε_τ [rad]."))
		((Quaternionr,bondTurn,Quaternionr::Identity(),(Attr::readonly|Attr::hidden),"How a bond's second body stood to its first when it was made."))
		((Real,twistingPath,0,(Attr::readonly|Attr::hidden),"Path [m] yielded in twisting, at half a mean diameter from the axis."))
		((Real,currentTwistingArm,0,(Attr::readonly|Attr::noSave),"μ_tw ℓ in force [m]."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(NscdSpacePhys, NscdPhys);
};
REGISTER_SERIALIZABLE(NscdSpacePhys);

namespace nscd {
	/// Whether a body can leave the x-y plane, or turn out of it.
	inline bool isFreeInSpace(const Body& body)
	{
		constexpr unsigned out     = State::DOF_Z | State::DOF_RX | State::DOF_RY;
		const unsigned     blocked = body.state->blockedDOFs;
		return blocked != State::DOF_ALL && (blocked & out) != out;
	}
}

} // namespace yade
