// State of a nonsmooth cohesive contact, and the functor that makes it from two materials.
#pragma once

#include "NscdMat.hpp"
#include "../seam/PythonMade.hpp"
#include "../checks/Refusal.hpp"
#include <contact/plane/thresholds.hpp>
#include <core/Dispatching.hpp>
#include <optional>
#include <atomic>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace nscd {
	/// What a contact did in a step that was solved.
	struct Sliding {
		long     number; // of the step; no other has it
		Real     way; // by which it has slipped at its velocity of the end [m], 0 or more
		Real     speed, meanSpeed; // at the end, and the mean of beginning and end [m/s], 0 or more
		Real     pressed; // normal impulse [N s], compression positive
		Real     lost; // by sliding [J]
		bool     bears; // it could bear something along the tangent
		Vector3r place; // contact point [m]
	};
}

class NscdPhys : public FrictPhys {
	Real forcesNoted = NaN; // beside what is compared with it

public:
	/// How a bond ended; None while it lives and where there was none.
	enum Mode { None = 0, Tension, Shear, Torque, Mixed, Twisting };

	virtual ~NscdPhys() = default;
	/// Sets F_a [N], μ_s and μ_r ℓ [m] of the next step for a gap [m]; adhesionRange in units of ℓ.
	virtual void updateThresholds(Real gap, Real adhesionRange);
	/// Notes what it did in a step, where it countsSlip.
	virtual void noteSliding(const nscd::Sliding&) { }
	virtual bool countsSlip() const { return false; }
	/// A script has set an attribute; nscd::Resident takes it up. C++ that changes one where no engine has its turn
	/// sets this too.
	void postLoad(NscdPhys&)
	{
		touched = true;
		if (!bonded) axis = Vector3r::Zero();
	}
	/// Whether a script has set `bonded` where no bond was made: the next loop makes it, as the bodies are then.
	bool isBondWanted() const { return bonded && axis == Vector3r::Zero(); }
	/// An attribute whose number makes no sense in the law, and the number; null where all do.
	virtual std::pair<const char*, Real> senseless() const;
	/// Whether there is none as far as a glance at their sum and the least of them tells, which is enough for
	/// almost all contacts.
	bool makesSenseAtOnce() const
	{
		const Real least = std::min({ residualTensileForce, residualFriction, residualRollingArm, tensileForce,
		                              friction, rollingArm, restitution, creationDistance }),
		           sum   = std::abs(normal) + std::abs(tangential) + std::abs(torque) + residualTensileForce
		        + residualFriction + residualRollingArm + tensileForce + friction + rollingArm
		        + creationDistance;
		return least >= 0 && restitution <= 1 && nscd::isNumber(sum)
		        && (!bonded || (ellipseNormal > 0 && ellipseTangential > 0));
	}
	/// Whether somebody has written into an attribute of FrictPhys since it was last set here: those of YADE's own
	/// classes leave no mark.
	bool isWritten() const { return isFrictionWritten() || isReset() || unheard(); }
	/// The attribute of YADE's own classes that was written to and that a rigid contact cannot hear; null where
	/// there is none.
	const char* unheard() const;
	/// Whether somebody has set the forces of a step to zero.
	bool isReset() const
	{
		return !std::isnan(forcesNoted) && forcesNoted != 0 && normalForce == Vector3r::Zero()
		        && shearForce == Vector3r::Zero();
	}
	/// Takes up that they were: what the next step finds is not written over by it.
	void hearReset()
	{
		if (!isReset()) return;
		normal = tangential = torque = 0;
		noteForces();
	}
	/// Gap [m] of a contact with that geometry.
	Real gapOf(const ScGeom& geom) const
	{
		return std::isnan(geom.penetrationDepth) ? savedGap : -geom.penetrationDepth;
	}
	/// Notes that the forces are those of a step.
	void noteForces() { forcesNoted = sumOfForces(); }
	/// Changes lengths and what is in proportion to them, when the length of the contact becomes another one [m].
	void follow(Real newLength);
	bool touched = false;
	/// A written friction that slip had taken away already.
	bool overruled = false;
	// attributes in the order of their use: see nscd::partOfPhysics
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(NscdPhys,FrictPhys,
R"""(Contact of two :yref:`NscdMats<NscdMat>`: reactions of the last step, thresholds, and the bond. Forces act on the second body;
:yref:`normalForce<NormPhys.normalForce>` and :yref:`shearForce<NormShearPhys.shearForce>` are the averages over the last step.

What a script writes into YADE's own attributes counts from the next step on, or is refused. :yref:`tangensOfFrictionAngle<FrictPhys.tangensOfFrictionAngle>`, into which
``utils.setContactFriction`` writes too, becomes the friction of the contact, bonded or not (:yref:`friction<NscdPhys.friction>` and :yref:`residualFriction<NscdPhys.residualFriction>`);
at a wall that weakens by slip it is what slip weakens from there on. Forces that are set to zero let the next solve begin with none; others are refused, as
the solver finds them, and so are stiffnesses ``kn`` and ``ks``, which rigid contacts do not have.)""",
		((Real,normal,0,Attr::triggerPostLoad,"Normal reaction N [N], compression positive."))
		((Real,tangential,0,Attr::triggerPostLoad,"Tangential reaction T [N], along the contact normal (from the body of lower id) turned by +90°."))
		((Real,torque,0,Attr::triggerPostLoad,"Rolling reaction Γ [N m] on the body of higher id, counter-clockwise positive."))
		((Real,length,0,Attr::readonly,"Mean diameter ℓ [m] of the two bodies; the disk's diameter at a wall."))
		((Real,adhesion,0,(Attr::readonly|Attr::noSave),"F_a [N] in force."))
		((Real,currentFriction,0,Attr::readonly,"μ_s in force."))
		((Real,currentRollingArm,0,(Attr::readonly|Attr::noSave),"μ_r ℓ in force [m]."))
		((Real,restGap,0,(Attr::readonly|Attr::hidden),"Gap [m] that a bond keeps unless it yields in tension; of one that closes freely the largest that it allows."))
		((Real,restitution,0,Attr::triggerPostLoad,"Coefficient of restitution."))
		((Real,correction,0,(Attr::readonly|Attr::hidden),"Pseudo-impulse of the last correction of positions [kg m], from which the next one starts."))
		((long,brokenStep,-1,Attr::readonly,"Step at which the bond broke; -1: none did since the last one was made."))
		((int,brokenMode,None,Attr::readonly,"How the bond broke: 0 not broken, 1 tension, 2 shear, 3 torque (in space rolling), 4 mixed, 5 "
		        "twisting (in space)."))
		((bool,bonded,false,Attr::triggerPostLoad,"A bond holds. Set to True by a script where none does, it is made in the next step, as "
		        ":yref:`ContactDynamicsEngine.bond` makes it, whatever the gap; set to False it ends, and does not "
		        "count as broken."))
		((bool,yielded,false,(Attr::readonly|Attr::hidden),"The bond yielded in tension in the last step."))
		((bool,slid,false,(Attr::readonly|Attr::hidden),"The bond yielded in shear in the last step."))
		((bool,rolled,false,(Attr::readonly|Attr::hidden),"The bond yielded in rolling in the last step."))
		((bool,joins,false,(Attr::readonly|Attr::hidden),"The bond's bodies were turned as one in the last step."))
		((Real,restSlip,0,(Attr::readonly|Attr::hidden),"What a bond has slipped by yielding [m]."))
		((Real,restTurn,0,(Attr::readonly|Attr::hidden),"What its bodies have turned against each other by yielding [rad]."))
		((Real,errorSlip,0,(Attr::readonly|Attr::hidden|Attr::noSave),"What it has slipped without having yielded [m]: an error of position."))
		((Real,errorTurn,0,(Attr::readonly|Attr::hidden|Attr::noSave),"The same of turning [rad]."))
		((bool,bondable,false,Attr::triggerPostLoad,"A bond may be made here on request."))
		((bool,breaks,false,(Attr::readonly|Attr::hidden),"The bond broke in this step, and is not counted yet, also where the scene is saved within the step; "
		        "not brokenStep == O.iter, which O.resetTime() makes true again."))
		((Vector3r,yieldPath,Vector3r::Zero(),(Attr::readonly|Attr::hidden),"Path [m] yielded in tension, shear and rolling, by which a break is classified."))
		((Real,residualTensileForce,0,Attr::triggerPostLoad,"F_a of a touching contact that is not bonded [N]."))
		((Real,residualFriction,0,Attr::triggerPostLoad,"μ_s of a contact that is not bonded."))
		((Real,residualRollingArm,0,Attr::triggerPostLoad,"μ_r ℓ of a contact that is not bonded [m]."))
		((Real,tensileForce,0,Attr::triggerPostLoad,"F_a of a bond [N] (eq. 2)."))
		((Real,friction,0,Attr::triggerPostLoad,"μ_s of a bond."))
		((Real,rollingArm,0,Attr::triggerPostLoad,"μ_r ℓ of a bond [m]."))
		((Real,ellipseNormal,0,Attr::triggerPostLoad,"ε_n ℓ [m]."))
		((Real,ellipseTangential,0,Attr::triggerPostLoad,"ε_t ℓ [m]."))
		((bool,closes,false,Attr::triggerPostLoad,"A bond over a gap closes freely here, see :yref:`NscdMat.bondsClose`."))
		((Vector3r,anchor1,Vector3r::Zero(),(Attr::readonly|Attr::hidden),"Centre of the bond's ellipse, in the frame of the body of lower id (a wall where there is one)."))
		((Vector3r,anchor2,Vector3r::Zero(),(Attr::readonly|Attr::hidden),"The material point that must stay in the ellipse, in the frame of the other body."))
		((Vector3r,axis,Vector3r::Zero(),(Attr::readonly|Attr::hidden),"Normal axis of the ellipse in the frame of the first of the two."))
		((Real,creationDistance,0,Attr::triggerPostLoad,"Δ ℓ [m]."))
		((Real,savedGap,NaN,(Attr::readonly|Attr::hidden),"Gap when the scene was saved [m]: the geometry of a loaded scene has none before its first step."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(NscdPhys, FrictPhys);

protected:
	bool isFrictionWritten() const
	{
		return tangensOfFrictionAngle != currentFriction
		        && !(std::isnan(tangensOfFrictionAngle) && std::isnan(currentFriction));
	}
	/// Takes a friction that somebody has written for that of the contact, with a bond and without.
	void hearFriction();

private:
	/// One number that is another one where any component of a force is.
	Real sumOfForces() const { return normalForce.dot(Vector3r(1, 3, 5)) + shearForce.dot(Vector3r(7, 11, 13)); }
};
REGISTER_SERIALIZABLE(NscdPhys);

class SlipWeakeningPhys : public NscdPhys {
public:
	virtual ~SlipWeakeningPhys() { nscd::letGo(wallMaterial); }
	void updateThresholds(Real gap, Real adhesionRange) override;
	void noteSliding(const nscd::Sliding& sliding) override;
	bool countsSlip() const override { return true; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SlipWeakeningPhys,NscdPhys,
R"""(Contact of a body with a wall of :yref:`SlipWeakeningMat`, or of two bodies across an interface of such a material: its strength is a function of the body's slip
along that wall, or of that one's of the two which has slipped farther.)""",
		((shared_ptr<SlipWeakeningMat>,wallMaterial,,Attr::readonly,"The wall's or the interface's material, which keeps the slip."))
		((Body::id_t,body,-1,Attr::readonly,"The body that slips."))
		((Body::id_t,other,-1,Attr::readonly,"The body on the other side of an interface; −1 at a wall."))
		,
		createIndex();
		,
		.add_property("slip",+[](const SlipWeakeningPhys& p) { return p.wallMaterial ? p.wallMaterial->slipNow(p.body) : 0; },"Slip [m] of the body along the wall.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SlipWeakeningPhys, NscdPhys);
};
REGISTER_SERIALIZABLE(SlipWeakeningPhys);

namespace nscd {
	/// Mean diameter of the spheres of an interaction [m]; the sphere's own where the other body is a wall. Throws
	/// std::invalid_argument where there is none.
	Real meanDiameter(const Body& b1, const Body& b2);
}

class Ip2_NscdMat_NscdMat_NscdPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2,
	        const shared_ptr<Interaction>& interaction) override;
	FUNCTOR2D(NscdMat, NscdMat);
	/// Throws std::runtime_error, naming the body, where one of two has no NscdMat.
	static void checkMaterials(const Body& b1, const Body& b2);
	/// Takes up the materials that the bodies of a contact have now, and makes its physics one of another class
	/// where they ask for that; bond and reactions stay.
	static void renew(Interaction& interaction, const Body& b1, const Body& b2);
	/// The physics in space of a contact that was made when neither of its bodies could leave the plane, where one can
	/// now; null where none can, or a material does not make sense. A bond is made anew as the bodies stand.
	static shared_ptr<NscdPhys> released(const Interaction& interaction, const Body& b1, const Body& b2);
	/// Sets strengths and lengths of a contact from the materials of its bodies; bond and reactions stay.
	static void setStrengths(NscdPhys& phys, const Body& b1, const Body& b2);
	static void setStrengths(NscdPhys& phys, const nonsmooth::contact::plane::Strengths& strengths, Real length);
	/// What two materials agree on.
	static nonsmooth::contact::plane::Strengths strengthsOf(const NscdMat& a, const NscdMat& b);
	/// The same where a contact of two particles needs no more than that; none where its strength follows their
	/// slip, or a material does not make sense.
	static std::optional<nonsmooth::contact::plane::Strengths>
	lastingStrengths(const Material* a, const Material* b);
	// clang-format off
	YADE_CLASS_BASE_DOC(Ip2_NscdMat_NscdMat_NscdPhys,IPhysFunctor,
R"""(Make a :yref:`NscdPhys` from two :yref:`NscdMats<NscdMat>`, or a :yref:`SlipWeakeningPhys` where one is a :yref:`SlipWeakeningMat`.
Between particles the weaker of two values holds; at a wall the wall's strengths hold alone (Taboada and Estrada 2009, section 3.3), and so do those of an
interface (:yref:`NscdMat.interfaceLaws`; section 3.2.1).)""");
	// clang-format on
	DECLARE_LOGGER;

private:
	void expectLaw();
	/// A physics of the class that two materials ask for, without strengths.
	static shared_ptr<NscdPhys>
	make(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const Interaction& interaction);

	std::atomic<long> looked { -1 }; // the last step with a new contact
	std::atomic<long> springs { 0 }; // such steps with a law of springs
};
REGISTER_SERIALIZABLE(Ip2_NscdMat_NscdMat_NscdPhys);

} // namespace yade
