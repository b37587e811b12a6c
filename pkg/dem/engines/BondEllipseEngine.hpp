// The elliptic zone in which a bond lives (Taboada and Estrada 2009, Figure 2b), for ductile bonds of YADE's soft
// models.
//
// A bond of Law2_ScGeom6D_CohFrictPhys_CohesionMoment with fragile = false yields at its three thresholds and never
// breaks; so does a bond of WallPhys. In the hard law it yields likewise, and breaks when the marked point leaves the
// zone
//     (d_n / ε_n ℓ)² + (d_t / ε_t ℓ)² < 1 .
// This engine looks at all such bonds every iterPeriod steps and breaks those that have left. Deviations from the hard
// law: a break is up to iterPeriod steps late, and the elastic part of a displacement counts.
#pragma once

#include <core/Interaction.hpp>
#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

class BondEllipseEngine : public PeriodicEngine {
public:
	void action() override;
	void add(int id1, int id2, Real ellipseNormal, Real ellipseTangential, Real friction, Real rollingArm);
	int  count() const { return (int)pairs.size(); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BondEllipseEngine,PeriodicEngine,
R"""(Break ductile bonds of soft contacts (:yref:`CohFrictPhys.fragile` = false, :yref:`WallPhys.fragile` = false) that have left the ellipse in which a
bond of the hard law lives (Taboada and Estrada 2009, section 2.2.2), and give them residual strengths. :yref:`yade.nonsmooth.soft.bond` fills it.)""",
		((vector<Vector2i>,pairs,,(Attr::readonly|Attr::hidden),"Bodies of the bonds; the wall, or the lower id, first."))
		((vector<Vector3r>,anchors1,,(Attr::readonly|Attr::hidden),"Marked points in the frames of the first bodies [m]."))
		((vector<Vector3r>,anchors2,,(Attr::readonly|Attr::hidden),"The same in the frames of the second bodies [m]."))
		((vector<Vector3r>,axes,,(Attr::readonly|Attr::hidden),"Normals at the beginning, in the frames of the first bodies."))
		((vector<Vector2r>,ellipses,,(Attr::readonly|Attr::hidden),"Half-axes ε_n ℓ and ε_t ℓ [m]."))
		((vector<Vector2r>,residuals,,(Attr::readonly|Attr::hidden),"Friction [-] and rolling arm [m] without the bond."))
		((int,broken,0,Attr::readonly,"Bonds broken by this engine so far."))
		,
		iterPeriod=20; initRun=false;
		,
		.def("add",&BondEllipseEngine::add,(boost::python::arg("id1"),boost::python::arg("id2"),boost::python::arg("ellipseNormal"),boost::python::arg("ellipseTangential"),boost::python::arg("friction"),boost::python::arg("rollingArm")),"Follow the bond of two bodies in contact; half-axes in m, residual friction and rolling arm [m].")
		.add_property("count",&BondEllipseEngine::count,"Bonds that are followed.")
	);
	// clang-format on
private:
	void learnContacts();

	std::vector<boost::weak_ptr<Interaction>>
	        contacts; // of the bonds, as far as they are known: none after loading
};
REGISTER_SERIALIZABLE(BondEllipseEngine);

} // namespace yade
