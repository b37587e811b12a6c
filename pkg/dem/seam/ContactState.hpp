// What a step takes from one interaction, side by side in memory: geometry and physics of an interaction lie far apart,
// and to fetch them is most of the work.
//
// States stay from step to step (seam/Resident.hpp). Those of two disks under our own law are kept up to date by
// themselves, and their interactions follow when somebody looks; the others are read anew after their functors have
// been called. Where nobody has looked since it came, such a contact is bare: it has no interaction
// (seam/ResidentMake.cpp).
#pragma once

#include "../materials/NscdPhys.hpp"
#include "../materials/SlipSurfacePhys.hpp"
#include "../walls/Segment.hpp"
#include <contact/plane/bond.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

/// Three cache lines: what every stage of a step looks at, what a contact can bear and bears, and the rest.
struct alignas(64) ContactState {
	/// Who keeps a contact up to date: it has to be looked at; the arrays; functors, through the interaction.
	enum Keeper : unsigned char { Unknown, Arrays, Functors };

	int         first = -1, second = -1; // bodies, in the interaction's own order
	Real        nx = 0, ny = 0, gap = 0; // along that order
	float       nz      = 0;
	float       turn    = 0; // of a bond: what it has turned without having yielded [rad], and below slipped [m]
	Real        restGap = 0, length = 0;
	signed char broken = 0; // NscdPhys::brokenMode if the bond broke in this step
	Keeper      keeper : 2;
	bool        cohesive : 1, bounces : 1; // its physics is an NscdPhys; with restitution
	bool        bonded : 1, yielded : 1, slips : 1;
	bool        closes : 1; // a bond would close freely
	bool        usable : 1; // its numbers make sense, and its normal lies in the plane
	bool        active : 1; // Interaction::isActive
	bool        wasRead : 1; // its geometry and thresholds are those of the interaction
	bool        leftOut : 1; // of the last solve, and bears nothing
	bool        reacts : 1; // its reactions are not yet those of the interaction
	bool        stale : 1; // its thresholds are to be found anew
	bool        bare : 1; // it has no interaction
	bool        curved : 1; // its wall is bent, see SegmentGeom::curvature
	bool        slid : 1, rolled : 1; // the bond yielded so in the last step
	bool        strained : 1; // it ever did, so that its strain at rest is not none
	bool        joins : 1; // its bodies were turned as one in the last step, see plane/rigid_clusters.hpp
	float       slip = 0;

	Real adhesion = 0, friction = 0, rollingArm = 0;
	Real residualAdhesion = 0; // of a touching contact without a bond
	Real normal = 0, tangential = 0, torque = 0, correction = 0; // of the last step

	Interaction*                         interaction = nullptr; // null: bare, or the place is free
	ScGeom*                              geom        = nullptr;
	NscdPhys*                            phys        = nullptr; // null where the interaction has another physics
	Real                                 restitution = 0;
	nonsmooth::contact::plane::YieldPath path; // of a bond that the arrays keep
	int                                  born = 0; // the step in which a bare contact came
	int                                  number
	        = -1; // of a bare contact's strengths, and of what holds another's interaction, in Resident; −1: none

	ContactState()
	        : keeper(Unknown)
	        , cohesive(false)
	        , bounces(false)
	        , bonded(false)
	        , yielded(false)
	        , slips(false)
	        , closes(false)
	        , usable(false)
	        , active(true)
	        , wasRead(true)
	        , leftOut(false)
	        , reacts(false)
	        , stale(false)
	        , bare(false)
	        , curved(false)
	        , slid(false)
	        , rolled(false)
	        , strained(false)
	        , joins(false)
	{
	}

	bool isLost() const { return bare && number < 0; } // ended by a script, and forgotten when contacts are taken
};
static_assert(sizeof(ContactState) == 3 * 64);

/// What a bond of two disks needs besides, as NscdPhys has it.
struct alignas(64) BondState {
	nonsmooth::contact::plane::BondMarks   marks;
	nonsmooth::contact::plane::BondEllipse zone;
};

using nonsmooth::contact::plane::BondStrain;

inline Vector3r vectorOf(const nonsmooth::contact::plane::YieldPath& path)
{
	return Vector3r(path.tension, path.shear, path.torque);
}

/// Component of a unit normal along z up to which it lies in the plane.
constexpr Real flatness = 1e-6;

/// The cohesive physics of an interaction, null if it has another; the usual classes are recognised without a search.
inline NscdPhys* physOf(IPhys& phys)
{
	const auto& type = typeid(phys);
	if (type == typeid(NscdPhys) || type == typeid(SlipWeakeningPhys) || type == typeid(SlipSurfacePhys))
		return static_cast<NscdPhys*>(&phys);
	return dynamic_cast<NscdPhys*>(&phys);
}

/// Whether a contact's thresholds, restitution and length are what the law knows, false for numbers that are none; and
/// its normal lies in the plane.
inline bool makeSense(const ContactState& r)
{
	const Real sum = r.adhesion + r.friction + r.rollingArm + r.length;
	return r.adhesion >= 0 && r.friction >= 0 && r.rollingArm >= 0 && r.length > 0 && r.restitution >= 0
	        && r.restitution <= 1 && sum <= std::numeric_limits<Real>::max() && std::abs(r.nz) <= flatness;
}

/// Finds the thresholds of a bare contact.
inline void findThresholds(ContactState& r, const nonsmooth::contact::plane::Strengths& strengths, Real adhesionRange)
{
	namespace plane     = nonsmooth::contact::plane;
	const auto residual = strengths.residual(r.length);
	const auto now      = plane::thresholdsOf(
	             strengths.ofBond(r.length), residual, r.bonded, plane::touches(r.gap, adhesionRange, r.length));
	r.adhesion         = now.adhesion;
	r.friction         = now.friction;
	r.rollingArm       = now.rollingArm;
	r.residualAdhesion = residual.adhesion;
	r.closes           = strengths.closes;
	r.usable           = makeSense(r);
}

/// Takes thresholds and what they rest on from an interaction's physics.
inline void readThresholds(ContactState& r)
{
	const NscdPhys& phys = *r.phys;
	r.adhesion           = phys.adhesion;
	r.friction           = phys.currentFriction;
	r.rollingArm         = phys.currentRollingArm;
	r.residualAdhesion   = phys.residualTensileForce;
	r.closes             = phys.closes;
	r.usable             = makeSense(r) && !phys.unheard() && !phys.senseless().first;
}

/// What an interaction itself says; `geom` is null where it is not real.
struct Found {
	Interaction* interaction;
	ScGeom*      geom;
	IPhys*       phys;
	int          first, second;
	bool         active;
};

inline Found look(Interaction& i)
{
	return { &i,           i.isReal() ? static_cast<ScGeom*>(i.geom.get()) : nullptr,
		 i.phys.get(), i.getId1(),
		 i.getId2(),   i.isActive };
}

/// Reads a real interaction.
inline void read(const Found& found, ContactState& r, BondState& bond, BondStrain& rest)
{
	r             = ContactState {};
	r.interaction = found.interaction;
	r.geom        = found.geom;
	r.phys        = physOf(*found.phys);
	r.first       = found.first;
	r.second      = found.second;
	r.active      = found.active;
	if (!r.phys) return;
	r.cohesive           = true;
	const ScGeom&   geom = *r.geom;
	const NscdPhys& phys = *r.phys;
	r.nx                 = geom.normal[0];
	r.ny                 = geom.normal[1];
	r.nz                 = geom.normal[2];
	r.gap                = -geom.penetrationDepth;
	r.restGap            = phys.restGap;
	r.restitution        = phys.restitution;
	r.bounces            = phys.restitution > 0;
	r.length             = phys.length;
	r.correction         = phys.correction;
	if (!phys.isReset()) { // else the solve begins with none
		r.normal     = phys.normal;
		r.tangential = phys.tangential;
		r.torque     = phys.torque;
	}
	r.broken = phys.breaks ? phys.brokenMode : int(NscdPhys::None);
	r.bonded = phys.bonded;
	r.slips  = phys.countsSlip();
	r.curved = typeid(geom) == typeid(SegmentGeom) && static_cast<const SegmentGeom&>(geom).curvature != 0;
	readThresholds(r);
	r.joins = phys.joins;
	if (!r.bonded) return;
	r.yielded  = phys.yielded;
	r.slid     = phys.slid;
	r.rolled   = phys.rolled;
	r.slip     = static_cast<float>(phys.errorSlip);
	r.turn     = static_cast<float>(phys.errorTurn);
	rest       = { phys.restSlip, phys.restTurn };
	r.strained = rest.slip != 0 || rest.turn != 0;
	r.path     = { phys.yieldPath[0], phys.yieldPath[1], phys.yieldPath[2] };
	bond       = { { { phys.anchor1[0], phys.anchor1[1] },
		         { phys.anchor2[0], phys.anchor2[1] },
		         { phys.axis[0], phys.axis[1] } },
		       { phys.ellipseNormal, phys.ellipseTangential } };
}

/// Notes whether a contact's bodies are turned as one.
inline void setJoins(ContactState& r, bool joins)
{
	r.joins = joins;
	if (r.keeper != ContactState::Arrays) r.phys->joins = joins;
}

/// Writes a contact's reactions into its interaction, whose forces act on its second body.
inline void writeReactions(const ContactState& r)
{
	NscdPhys& phys   = *r.phys;
	phys.normal      = r.normal;
	phys.tangential  = r.tangential;
	phys.torque      = r.torque;
	phys.correction  = r.correction;
	phys.normalForce = r.leftOut ? Vector3r(Vector3r::Zero()) : Vector3r(r.normal * r.nx, r.normal * r.ny, 0);
	phys.shearForce  = r.leftOut ? Vector3r(Vector3r::Zero())
	                             : Vector3r(-r.tangential * r.ny, r.tangential * r.nx, 0);
	phys.noteForces();
}

} // namespace yade::nscd
