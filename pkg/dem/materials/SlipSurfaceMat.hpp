// Walls whose friction a slip law finds in cells along them (contact/slip/law.hpp): surfaces that heat as disks slide.
//
// Of a cell of length a, over its contacts in a step of length h, in the order of ids:
//     σ_now = Σ P_n/(h a) ,   V = Σ |P_n U_t|/Σ |P_n| ,   d = h Σ |P_n (U_t⁻ + U_t⁺)/2|/Σ |P_n| ,   q = −Σ P_t (U_t⁻ + U_t⁺)/(2 a)
// with impulses P of the step and U⁻, U⁺ before and after it. q is what the solver's sliding has lost there, to the
// last bit of a sum. The law gets σ, the mean of σ_now over the last slip of length A (cumulative before that; the
// present value while nothing has slipped), V, d and q, and gives τ; contacts of the cell have
//     μ = τ/σ   in the next step (the law's lag),   |T| ≤ μ (F_a + N) ;   μ of the beginning where nothing has pressed yet.
// Signorini's condition and the rows of rolling and tension stay as they are. σ is an average since contacts are few,
// unequal and travel: a pressure that is subtracted contact by contact, (N − p ℓ)⁺, takes too much where N is small and
// nothing where it is large.
// Signs: compression, slip, heat positive. σ is N'/a where water acts on disks: the law's pressure is an excess over
// it.
// Deviations: a contact takes the cell where it was in the step before; where O.dt changes, the law diffuses by the new
// step from the next one on.
#pragma once

#include "NscdMat.hpp"
#include "../walls/WallCells.hpp"
#include <contact/slip/cells.hpp>

namespace nonsmooth::contact::slip {
class Law;
}

namespace yade {

class Scene;

class SlipSurfaceMat : public NscdMat {
public:
	virtual ~SlipSurfaceMat() = default;
	void validate() const override;
	bool isForWallsAlone() const override { return true; }
	void pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named) override;
	void postLoad(SlipSurfaceMat&)
	{
		if (lawNames.empty()) return;
		if (!surfaceLaw) makeLaw();
		validate();
	}
	void preSave(SlipSurfaceMat&);

	/// Cuts the walls into cells where that was not done, in a step of ContactDynamicsEngine and before its solve;
	/// h [s]. Throws std::runtime_error where walls are not those that the cells were made of.
	void open(const Scene& scene, Real h);
	/// The cell of a point on a wall [m]; −1 before the first step.
	int cellAt(const Body& wall, const Vector3r& point) const { return geometry.at(wall, point); }
	/// μ of contacts in a cell.
	Real frictionOf(int cell) const { return cell >= 0 && cell < (int)friction.size() ? friction[cell] : first; }
	/// What a contact did in a step: impulse P_n [N s], |U_t| and |U_t⁻ + U_t⁺|/2 [m/s], what sliding has lost [J].
	void note(int cell, Real pressed, Real speed, Real meanSpeed, Real lost);
	/// Takes up the step of length h [s], and finds the strengths of the next one.
	void close(Real h);

	// for Python
	void                  setLaw(boost::python::object law);
	boost::python::object givenLaw() const;
	void                  forgetSlip();
	int cellCount() const { return geometry.count() > 0 ? (int)geometry.count() : (int)slip.size(); }
	boost::python::object cellTable(const string& column);
	boost::python::list   columns() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SlipSurfaceMat,NscdMat,
R"""(Material of a wall of :yref:`Segments<Segment>` or :yref:`Arcs<Arc>` whose friction a slip law finds in cells along the wall, from what disks have slipped, how fast,
and how hot it has become there (Taboada and Estrada 2009, section 4.3): ``SlipSurfaceMat(law=nonsmooth.slip.parameter_sets.law('vaiont'), …)``. The friction angle is that of the law before slip.
Cells are cut in the first step of :yref:`ContactDynamicsEngine`; the heat that they get is what sliding loses on the wall. Contacts with a wall that gets this material later take it up by
:yref:`ContactDynamicsEngine.updateStrengths`. See ``yade.nonsmooth.slip.surface``. Raises ValueError for a law that does not fit.)""",
		((vector<string>,lawNames,,(Attr::readonly|Attr::hidden),"Names of the law's parts."))
		((vector<string>,lawKeys,,(Attr::readonly|Attr::hidden),"Keys of its parameters."))
		((vector<vector<Real>>,lawValues,,(Attr::readonly|Attr::hidden),"Their values."))
		((Real,cellLength,0,Attr::triggerPostLoad,"Length [m] of a cell along the wall; 0: eight mean diameters of the scene's disks."))
		((Real,averagingSlip,0,Attr::triggerPostLoad,"Slip A [m] over which a cell's normal stress is a mean; 0: half the length of a cell."))
		((bool,held,false,,"Whether cells get neither slip nor heat, whatever slides, as while a scene is loaded: a surface that "
		        "has not slipped keeps the friction before slip."))
		((vector<Real>,slip,,(Attr::readonly|Attr::hidden),"Slip of each cell [m]; this and the next three are filled as the material is saved."))
		((vector<Real>,slipRate,,(Attr::readonly|Attr::hidden),"Its slip rate V [m/s] in the last step."))
		((vector<Real>,normalStress,,(Attr::readonly|Attr::hidden),"Its normal stress σ [Pa]."))
		((vector<Real>,friction,,(Attr::readonly|Attr::hidden),"Its friction μ in force."))
		((vector<Real>,lawState,,(Attr::readonly|Attr::hidden),"What the law keeps, cell by cell."))
		((Real,lawStep,0,(Attr::readonly|Attr::hidden),"Step [s] that the strengths in force were found for."))
		((Real,heat,0,Attr::readonly,"Heat [J] that sliding has made on this wall since the cells were cut, or slip was forgotten."))
		,
		createIndex(); wall=true;
		,
		.add_property("law",&SlipSurfaceMat::givenLaw,&SlipSurfaceMat::setLaw,"The slip law: set it to a ``nonsmooth.slip.SlipLaw``; reads as (names, {key: values}).")
		.def("forgetSlip",&SlipSurfaceMat::forgetSlip,"Cells as if nothing had slipped on them.")
		.def("cellCount",&SlipSurfaceMat::cellCount,"Number of cells; 0 before the first step.")
		.def("cellTable",&SlipSurfaceMat::cellTable,(boost::python::arg("column")),"A column of all cells, eight bytes a number; see nonsmooth.slip.surface.")
		.def("columns",&SlipSurfaceMat::columns,"Columns of cellTable that the law keeps: (name, unit, numbers a cell).")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SlipSurfaceMat, NscdMat);

private:
	void makeLaw();
	void begin();
	void forgetAll();
	void findStrengths(Real h);

	std::shared_ptr<nonsmooth::contact::slip::Law> surfaceLaw;
	nonsmooth::contact::slip::Cells                cells; // columns that are saved as attributes
	nscd::WallCells                                geometry;
	std::vector<Real>              pressedOf, weightOf, speedOf, meanSpeedOf, lostOf; // sums of the step, by cell
	Real                           first = 0, averaging = 0, cutLength = 0;
	boost::weak_ptr<BodyContainer> home; // whose bodies the walls are
};
REGISTER_SERIALIZABLE(SlipSurfaceMat);

namespace nscd {
	/// The materials of a scene's bodies that have cells, each once, by the first body of each.
	std::vector<SlipSurfaceMat*> slipSurfacesOf(const Scene& scene);
}

} // namespace yade
