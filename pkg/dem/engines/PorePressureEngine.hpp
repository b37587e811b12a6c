// Pore pressure as a body force under a water table parallel to a plane.
//
// Taboada and Estrada (2009), section 3.4 and eqs (7), (18):  F_p = -∇p V on every disk whose centre is below the table, V = π r² per
// metre of thickness. Water that flows along a plane of dip β has -∇p = γ_w cos β along its normal: buoyancy γ_w V
// upwards and seepage
// γ_w V sin β down the plane (Figure 4). The paper writes F_p = ∇p V, with ∇p for the size of the fall of pressure.
// Section 5.4: the force ends for good once a disk has moved downslope by more than D_c. Released are those disks that
// it acted on before, as the paper's criterion
// is for particles below the water table; a disk that moves so far while it is dry stays dry, wherever the table rises
// to.
// Deviation: none by default. V is the disk's own volume (its sum is the packing fraction times γ_w h cos β per unit
// length); volumeFactor = 1/(packing fraction) gives each disk its share of the pores as well.
// Deviation: releasedShare takes a share of the force from a disk, as local dilatancy does (section 5.4, paragraph
// 113); who sets it says how much, and when. With a field the pressure is that of any flow: −∇p of the triangle that a
// disk's centre is in, where p > 0 there.
#pragma once

#include "PorePressureField.hpp"
#include <core/GlobalEngine.hpp>

namespace yade {

namespace nscd {
	class Resident;
}

class PorePressureEngine : public GlobalEngine {
public:
	void action() override;
	void pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named) override;
	/// A file has nothing of bodies whose id another one has now.
	void preSave(PorePressureEngine&);
	Real heightAt(Real time) const;
	/// Throws std::invalid_argument, naming it, for a number that is none.
	void validate() const;
	void forgetReleases()
	{
		moved.clear();
		everWet.clear();
		releasedShare.clear();
		reference.clear();
		owners.clear();
	}
	bool isWet(int id) const { return id < (int)wet.size() && wet[id] != 0; }
	bool wasWet(int id) const { return id < (int)everWet.size() && everWet[id] != 0; }
	Real shareReleased(int id) const { return id >= 0 && id < (int)releasedShare.size() ? releasedShare[id] : 0; }
	/// Water acts on it no longer, whether or not it ever did.
	bool drained(int id) const { return (id < (int)moved.size() && moved[id] != 0) || shareReleased(id) >= 1; }
	bool isReleased(int id) const { return wasWet(id) && drained(id); }
	boost::python::object bodyTable() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PorePressureEngine,GlobalEngine,
R"""(Pore water as a volume force on the spheres below a water table that stays parallel to a plane (Taboada and Estrada 2009, section 3.4,
eqs 7 and 18): :math:`F_p=-\nabla p\,V`, with :math:`V=\pi r^2` per metre of thickness. Of water that flows along the plane it is :math:`\gamma_w\cos\beta\,V` along
the plane's normal, the sum of buoyancy :math:`\gamma_w V` upwards and seepage :math:`\gamma_w V\sin\beta` down the plane. Water no longer acts
on a body that has moved downslope further than :yref:`releaseDistance<PorePressureEngine.releaseDistance>` since the engine first ran: one that was wet is released for good
(section 5.4), one that was dry stays dry. A share of the pressure may have been released before that, by
:yref:`releasedShare<PorePressureEngine.releasedShare>`.
Place it after :yref:`ForceResetter` and before :yref:`ContactDynamicsEngine`.)""",
		((Real,unitWeight,9810,,"Unit weight of water γ_w [N/m³]."))
		((Vector3r,planePoint,Vector3r::Zero(),,"A point of the plane from which the table's height is counted."))
		((Vector3r,planeNormal,Vector3r(0,1,0),,"Normal of the plane, pointing up into the slope."))
		((vector<Real>,times,,,"Times [s] of the table of water heights, rising; between them the height is linear, outside them constant."))
		((vector<Real>,heights,,,"Heights [m] of the water table above the plane at these times; none: dry."))
		((Vector3r,pressureGradient,Vector3r::Zero(),,"Gradient ∇p of the pore pressure [N/m³], which grows downwards; the force is −∇p V. Zero: that of "
		        "water which flows along the plane, −γ_w cos β along planeNormal (eq. 18)."))
		((shared_ptr<PorePressureField>,field,,,"Pore pressure of any flow, instead of the table above a plane: times, heights, unitWeight and "
		        "pressureGradient are not asked then, and planeNormal is upright to the way downslope."))
		((Real,releaseDistance,5,,"Distance D_c [m] downslope after which water no longer acts on a body; infinite: it always does."))
		((vector<Real>,releasedShare,,,"Share of the pore pressure, 0 to 1, that has been released, by id; water acts on a body with the "
		        "rest, and of one with 1 no longer. Bodies beyond its end: 0. A body whose id another one had is met "
		        "with 0."))
		((Real,volumeFactor,1,,"Volume on which the pressure gradient acts, in units of the body's own."))
		((Real,thickness,1,,"Thickness [m] of the two-dimensional model."))
		((int,mask,0,,"Only bodies whose groupMask shares a bit with this; 0: all spheres."))
		((Real,height,0,(Attr::readonly|Attr::noSave),"Present height of the water table [m]; 0 with a field."))
		((int,wetCount,0,(Attr::readonly|Attr::noSave),"Bodies that water acts on."))
		((int,releasedCount,0,(Attr::readonly|Attr::noSave),"Bodies released so far: that were wet and have moved further than releaseDistance, or whose "
		        "releasedShare is 1."))
		((Vector3r,totalForce,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Sum of the forces of the last step [N]."))
		((vector<int>,moved,,(Attr::readonly|Attr::hidden),"1 for bodies that have moved further than releaseDistance, by id: water acts on them no longer."))
		((vector<int>,everWet,,(Attr::readonly|Attr::hidden),"1 for bodies that water has acted on, by id."))
		((vector<int>,wet,,(Attr::readonly|Attr::hidden|Attr::noSave),"1 for bodies that water acts on, by id."))
		((vector<Vector3r>,reference,,(Attr::readonly|Attr::hidden),"Positions from which the way downslope is counted."))
		,
		/* ctor */,
		.def("heightAt",&PorePressureEngine::heightAt,(boost::python::arg("time")),"Height of the water table [m] at a time [s].")
		.def("isWet",&PorePressureEngine::isWet,(boost::python::arg("id")),"Does water act on this body?")
		.def("wasWet",&PorePressureEngine::wasWet,(boost::python::arg("id")),"Has water acted on this body since :yref:`forgetReleases<PorePressureEngine.forgetReleases>`?")
		.def("isReleased",&PorePressureEngine::isReleased,(boost::python::arg("id")),"Was this body wet, and does water act on it no longer, by its way or by its "
		        ":yref:`releasedShare<PorePressureEngine.releasedShare>`?")
		.def("bodyTable",&PorePressureEngine::bodyTable,"Three bytes a body, by id: isWet, isReleased, wasWet; see nonsmooth.tables.water.")
		.add_property("gradient",&PorePressureEngine::minusPressureGradient,&PorePressureEngine::setGradient,"|ydeprecated| −∇p [N/m³], the force per volume: the old name of "
		        ":yref:`pressureGradient<PorePressureEngine.pressureGradient>`, which has the other sign.")
		.def("forgetReleases",&PorePressureEngine::forgetReleases,"Count ways downslope from the present positions again, and forget which bodies were wet and what "
		        "share was released.")
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	// `0 -` leaves no negative zeros
	Vector3r minusPressureGradient() const { return Vector3r::Zero() - pressureGradient; }
	void     setGradient(const Vector3r& perVolume);
	/// What acts on a body at a place, per volume; false where it is dry there.
	bool wets(const Vector3r& place, const Vector3r& normal, Vector3r& perVolume) const;
	void forgetOthers(const nscd::Resident& resident);
	void forgetWayOf(size_t id);

	std::vector<boost::weak_ptr<Body>> owners; // by id: whose way and water are noted; none after loading
	std::weak_ptr<nscd::Resident>      lookedAt; // where bodies were compared with these, and
	long                               looked = 0; // when, by Resident::taken
};
REGISTER_SERIALIZABLE(PorePressureEngine);

} // namespace yade
