// Pore pressure as a body force under a water table parallel to a plane.
//
// Taboada and Estrada (2009), section 3.4 and eqs (7), (18):  F_p = ∇p V on every disk whose centre is below the table, with
// ∇p = γ_w cos β normal to the plane and pointing away from it, β the plane's dip, V = π r² per metre of thickness.
// Section 5.4: the force ends for good once a disk has moved downslope by more than D_c.
// Deviation: none by default. V is the disk's own volume (its sum is the packing fraction times γ_w h cos β per unit length);
// volumeFactor = 1/(packing fraction) gives each disk its share of the pores as well.
#pragma once

#include <core/GlobalEngine.hpp>

namespace yade {

class PorePressureEngine : public GlobalEngine {
public:
	void action() override;
	Real heightAt(Real time) const;
	void forgetReleases()
	{
		released.clear();
		reference.clear();
	}
	bool                  isReleased(int id) const { return id < (int)released.size() && released[id] != 0; }
	bool                  isWet(int id) const { return id < (int)wet.size() && wet[id] != 0; }
	boost::python::object bodyTable() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PorePressureEngine,GlobalEngine,
R"""(Pore water as a volume force on the spheres below a water table that stays parallel to a plane (Taboada and Estrada 2009, section 3.4,
eqs 7 and 18): :math:`F_p=\gamma_w\cos\beta\,V` along the plane's normal, with :math:`V=\pi r^2` per metre of thickness. A body that has moved
downslope further than :yref:`releaseDistance<PorePressureEngine.releaseDistance>` since the engine first ran is released for good (section 5.4).
Place it after :yref:`ForceResetter` and before :yref:`ContactDynamicsEngine`.)""",
		((Real,unitWeight,9810,,"Unit weight of water γ_w [N/m³]."))
		((Vector3r,planePoint,Vector3r::Zero(),,"A point of the plane from which the table's height is counted."))
		((Vector3r,planeNormal,Vector3r(0,1,0),,"Normal of the plane, pointing up into the slope."))
		((vector<Real>,times,,,"Times [s] of the table of water heights, rising; between them the height is linear, outside them constant."))
		((vector<Real>,heights,,,"Heights [m] of the water table above the plane at these times; none: dry."))
		((Vector3r,gradient,Vector3r::Zero(),,"Pressure gradient [N/m³] to use as it is; zero: γ_w cos β along planeNormal (eq. 18)."))
		((Real,releaseDistance,5,,"Distance D_c [m] downslope after which a body is released; infinite: never."))
		((Real,volumeFactor,1,,"Volume on which the pressure gradient acts, in units of the body's own."))
		((Real,thickness,1,,"Thickness [m] of the two-dimensional model."))
		((int,mask,0,,"Only bodies whose groupMask shares a bit with this; 0: all spheres."))
		((Real,height,0,(Attr::readonly|Attr::noSave),"Present height of the water table [m]."))
		((int,wetCount,0,(Attr::readonly|Attr::noSave),"Bodies that water acts on."))
		((int,releasedCount,0,(Attr::readonly|Attr::noSave),"Bodies released so far."))
		((Vector3r,totalForce,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Sum of the forces of the last step [N]."))
		((vector<int>,released,,(Attr::readonly|Attr::hidden),"1 for released bodies, by id."))
		((vector<int>,wet,,(Attr::readonly|Attr::hidden|Attr::noSave),"1 for bodies that water acts on, by id."))
		((vector<Vector3r>,reference,,(Attr::readonly|Attr::hidden),"Positions from which the way downslope is counted."))
		,
		/* ctor */,
		.def("heightAt",&PorePressureEngine::heightAt,(boost::python::arg("time")),"Height of the water table [m] at a time [s].")
		.def("isWet",&PorePressureEngine::isWet,(boost::python::arg("id")),"Does water act on this body?")
		.def("isReleased",&PorePressureEngine::isReleased,(boost::python::arg("id")),"Has this body been released for good?")
		.def("bodyTable",&PorePressureEngine::bodyTable,"Two bytes a body, by id: whether water acts on it, and whether it has been released for good; see nonsmooth.tables.water.")
		.def("forgetReleases",&PorePressureEngine::forgetReleases,"Count ways downslope anew from the present positions.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(PorePressureEngine);

} // namespace yade
