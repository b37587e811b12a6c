// Materials of nonsmooth contact dynamics (NSCD): strengths of a contact, no stiffness.
#pragma once

#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <memory>
#include <pkg/common/ElastMat.hpp>

namespace nonsmooth::contact::slip {
class BySlip;
}

namespace yade {

class NscdMat : public FrictMat {
public:
	virtual ~NscdMat() = default;
	/// Checks all of it; throws std::invalid_argument naming the attribute, its value and what would do.
	virtual void validate() const;
	/// A script has set a number: refused at once, since in scenes with soft contacts no exception may leave the
	/// threads of YADE's loop.
	void postLoad(NscdMat&) { checkNumbers(); }
	/// Whether it can rule a contact only where it is a wall's own.
	virtual bool isForWallsAlone() const { return false; }
	/// Whether the peak's friction angle has changed since it was last asked, and the residual one, which is a
	/// value of its own, has not.
	bool changesPeakAlone();
	/// The law of contacts with a body of another material, where one of the two says so for the other's layer;
	/// null where none does.
	const NscdMat* interfaceWith(const NscdMat& other) const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(NscdMat,FrictMat,
R"""(Material of rigid particles with cohesive bonds, after Taboada and Estrada (2009), section 2.2 and Table 1. A contact of two such
materials resists separation up to :math:`F_a=\sigma\ell`, sliding up to :math:`\mu_s(F_a+N)` and rolling up to
:math:`\mu_r\ell(F_a+N)`, with :math:`\ell` the mean diameter (the disk's diameter at a wall). Stiffnesses (``young``, ``poisson``) are
not used. :yref:`frictionAngle<FrictMat.frictionAngle>` is the peak value, that of a bond; a negative residual value stands for "as the peak". Where none is given
it is 0.5 rad (28.6°, μ = 0.546), as in every FrictMat, and not 0.)""",
		((Real,tensileStrength,0,Attr::triggerPostLoad,"Tensile strength of a bond, σ_ext [Pa]; in two dimensions force per contact and metre of thickness is σ_ext ℓ."))
		((Real,residualTensileStrength,0,Attr::triggerPostLoad,"Tensile strength σ_res [Pa] of a touching contact that is not bonded, between bodies of one "
		        ":yref:`layer<NscdMat.layer>`."))
		((Real,residualFrictionAngle,-1,Attr::triggerPostLoad,"Friction angle [rad] of a contact that is not bonded; negative: as frictionAngle."))
		((Real,rollingFriction,0,Attr::triggerPostLoad,"Rolling friction μ_r [-] of a bond: arm of the resisting torque in units of ℓ (eq. 6)."))
		((Real,residualRollingFriction,-1,Attr::triggerPostLoad,"Rolling friction [-] of a contact that is not bonded; negative: as rollingFriction."))
		((Real,twistingFriction,0,Attr::triggerPostLoad,"Twisting friction μ_tw [-] of a bond in space: arm of the torque about the normal that it resists, "
		        "in units of ℓ."))
		((Real,residualTwistingFriction,-1,Attr::triggerPostLoad,"Twisting friction [-] of a contact in space that is not bonded; negative: as twistingFriction."))
		((Real,bondEllipseNormal,0.02,Attr::triggerPostLoad,"Half-axis ε_n of the ellipse in which a bond lives, along the contact normal [ℓ] (Figure 2b)."))
		((Real,bondEllipseTangential,0.02,Attr::triggerPostLoad,"Half-axis ε_t of the ellipse along the tangent [ℓ]."))
		((Real,bondEllipseTwisting,-1,Attr::triggerPostLoad,"Half-axis ε_τ [rad] of the ellipsoid in space, for the turn of the bodies about the bond's axis; "
		        "negative: 2 ε_t, by which rims half a mean diameter away are off by ε_t ℓ."))
		((Real,bondCreationDistance,0.02,Attr::triggerPostLoad,"Bonds are made where the gap is below this distance Δ [ℓ] (Figure 2a), see :yref:`ContactDynamicsEngine.bond`."))
		((bool,bondsClose,false,,"A bond made over a gap bears tension up to its length, shear and torque, but no compression before "
		        "the bodies touch: they may draw together freely. False: it keeps its length either way, like a "
		        "strut. Between two particles it is enough that one of two materials says so. Present contacts take "
		        "it up by :yref:`ContactDynamicsEngine.updateStrengths`."))
		((Real,restitution,0,Attr::triggerPostLoad,"Newton's coefficient of restitution e [-], between 0 and 1; the larger of the two bodies' holds."))
		((int,layer,0,,"Bonds and residual tensile strength exist only between bodies of the same layer; in a layer with a "
		        "negative number no bonds are made. See bondsToAll for walls."))
		((bool,bondsToAll,false,,"Make bonds with bodies of any layer: for walls, two of which have a tensile strength in Table 1. "
		        "Section 2.2.2 tells of bonds between grains alone."))
		((vector<int>,interfaceLayers,,,"Layers against which bodies of this material have a law of their own: an interface. It is enough "
		        "that one of two materials says so."))
		((vector<shared_ptr<Material>>,interfaceLaws,,,"For each of :yref:`interfaceLayers<NscdMat.interfaceLayers>` the NscdMat whose values rule such "
		        "contacts alone; they are bonded if it has :yref:`bondsToAll<NscdMat.bondsToAll>`. A "
		        ":yref:`SlipWeakeningMat` weakens with the slip of bodies along the interface."))
		((bool,wall,false,,"This material's strengths alone rule a contact with it (section 3.3); otherwise the weaker of the two values holds."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(NscdMat, FrictMat);

protected:
	void require(bool good, const char* name, Real value, const char* what) const;
	void checkNumbers() const;

private:
	Real knownPeak = NaN, knownResidual = NaN; // when it was last asked
};
REGISTER_SERIALIZABLE(NscdMat);

namespace nscd {
	/// A residual value of a material; negative ones stand for the peak.
	inline Real residual(Real value, Real peak) { return value < 0 ? peak : value; }
}

/// Wall whose strength is a function of slip; keeps the slip of every body along it, over all its segments.
class SlipWeakeningMat : public NscdMat {
public:
	virtual ~SlipWeakeningMat() = default;
	void validate() const override;
	/// Lowers the adhesion [N] and the friction of a contact of length ℓ [m] whose share `left` of the strength
	/// remains, see remaining.
	void weaken(Real& adhesion, Real& friction, Real length, Real left) const;
	/// What is left of the strength that slip takes away, for body `id`: 1 is all, 0 is none.
	Real remaining(Body::id_t id) const;
	Real slipOf(Body::id_t id) const { return id >= 0 && id < (Body::id_t)slip.size() ? slip[id] : 0; }
	/// Notes whose slip that of an id is from now on; that of another body which had the id before is forgotten.
	/// For any thread.
	void claim(const shared_ptr<Body>& body);
	void addSlip(Body::id_t id, Real distance);
	/// The same along an interface, where a body may have several contacts: those of one `step`, which no other
	/// step has for its number, count as the longest of them.
	void addSlip(Body::id_t id, Real distance, long step);
	// for Python, of the present scene
	Real                  slipNow(Body::id_t id);
	int                   weakenedCount();
	Real                  meanSlip();
	int                   slippedCount();
	void                  forgetSlip();
	boost::python::object slipTable();
	void                  postLoad(SlipWeakeningMat&) { takeLaw(); }
	void                  preSave(SlipWeakeningMat&) { forgetOthers(); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SlipWeakeningMat,NscdMat,
R"""(Material of a wall, or of an interface (:yref:`NscdMat.interfaceLaws`), that loses strength as bodies slip along it (Taboada and Estrada 2009, section 5.3). Friction and cohesion of a
contact fall to the weakened values as a function of the distance that the body has slipped along this wall, counted over all bodies that
share this material object, so that it survives the joints of a polyline. Rolling friction stays, with the threshold that cohesion
leaves it. Slip belongs to a body and not to its id: one that takes the id of an erased body begins with none. Raises ValueError where a value is set that weakens nothing.)""",
		((Real,criticalSlip,5,Attr::triggerPostLoad,"Slip D_c [m] at which the strength is lost."))
		((string,weakening,"step",Attr::triggerPostLoad,"Function of slip: 'step' (the paper's: all, then none from D_c on), 'linear' (to none at D_c) or "
		        "'exponential' (exp(−slip/D_c))."))
		((Real,weakenedFrictionAngle,0,Attr::triggerPostLoad,"Friction angle [rad] that is left in the end."))
		((Real,weakenedTensileStrength,0,Attr::triggerPostLoad,"Tensile strength [Pa] that is left in the end."))
		((vector<Real>,slip,,(Attr::readonly|Attr::hidden),"Slip of each body along this wall [m], by body id."))
		,
		createIndex(); wall=true; takeLaw();
		,
		.def("slipOf",&SlipWeakeningMat::slipNow,(boost::python::arg("id")),"Distance [m] that the body has slipped along this wall.")
		.def("slipTable",&SlipWeakeningMat::slipTable,"The same of all bodies up to the last that has slipped, by id, eight bytes each; see nonsmooth.tables.slip.")
		.def("forgetSlip",&SlipWeakeningMat::forgetSlip,"Set the slip of all bodies to zero.")
		.def("weakenedCount",&SlipWeakeningMat::weakenedCount,"Number of bodies that slipped further than criticalSlip.")
		.def("slippedCount",&SlipWeakeningMat::slippedCount,"Number of bodies that have touched this wall.")
		.def("meanSlip",&SlipWeakeningMat::meanSlip,"Mean slip [m] of the bodies that have touched this wall.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SlipWeakeningMat, NscdMat);

private:
	void checkWeakening() const;
	void takeLaw();
	/// Throws std::invalid_argument where `weakening` or `criticalSlip` makes no sense.
	std::shared_ptr<const nonsmooth::contact::slip::BySlip> makeLaw() const;
	void                                                    forgetOthers();
	void                                                    noteOwner(Body::id_t id, const shared_ptr<Body>& body);

	std::vector<std::pair<long, Real>>
	        ofStep; // by body: the last step in which it slipped along an interface, and how far
	std::vector<boost::weak_ptr<Body>> owners; // by id: whose slip it is; none after loading
	boost::weak_ptr<BodyContainer>     home; // whose bodies these are
	// of `weakening` and `criticalSlip`, chosen where they are set; none where they do not make sense
	std::shared_ptr<const nonsmooth::contact::slip::BySlip> law;
};
REGISTER_SERIALIZABLE(SlipWeakeningMat);

} // namespace yade
