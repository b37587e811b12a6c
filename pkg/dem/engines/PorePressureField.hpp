// Pore pressure of any flow of water: at the nodes of triangles, at given times.
//
//     p(x, t) = Σ N_i(x) p_i(t)     f = −∇p per volume, constant on each triangle     wet where p > 0
// p is that of water at rest or seeping; above the phreatic surface it is negative (suction), where no force acts, and
// goes on linearly through the triangles that the surface crosses. Before the first time it is the first state's, after
// the last the last one's. Outside of the triangles all is dry.
#pragma once

#include "TriangleField.hpp"
#include <lib/serialization/Serializable.hpp>

namespace yade {

class PorePressureField : public Serializable {
public:
	/// The pressure at a point [Pa], and its gradient [N/m³]; none outside.
	struct Water {
		Real     pressure = -1;
		Vector3r gradient = Vector3r::Zero();
		bool     inside   = false;
	};
	/// A list was set, or all of them were loaded.
	void postLoad(PorePressureField&) { isMade = false; }
	/// Makes ready what `at` asks: nodal pressures of a time [s]. Throws std::invalid_argument, naming it, for what
	/// cannot be.
	void  prepare(Real time);
	Water at(const Vector3r& place) const;

	boost::python::tuple pyAt(const Vector3r& place, Real time);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PorePressureField,Serializable,
R"""(Pore pressure on triangles, linear on each of them and in time between given states: what a computation of seepage, a phreatic line or a file gives :yref:`PorePressureEngine.field`. Water acts where the
pressure is above zero; nodes above the phreatic surface have negative pressures (suction), so that the surface is where the pressure is zero. Outside the triangles all is dry.)""",
		((vector<Vector3r>,nodes,,Attr::triggerPostLoad,"Points [m]; z is not read."))
		((vector<Vector3i>,triangles,,Attr::triggerPostLoad,"Numbers of three nodes each."))
		((vector<Real>,times,,Attr::triggerPostLoad,"Times [s] of the states, rising; none: there is one state."))
		((vector<Real>,pressures,,Attr::triggerPostLoad,"Pressure at the nodes [Pa], one state after the other."))
		,
		/* ctor */,
		.def("at",&PorePressureField::pyAt,(boost::python::arg("place"),boost::python::arg("time")=0),"Pressure [Pa] and its gradient [N/m³] at a place and a time [s]; (None, None) outside.")
	);
	// clang-format on

private:
	void validate() const;

	void make();

	nscd::TriangleField triangulation;
	std::vector<double> present; // pressures of the time that was asked for last
	Real                presentTime = 0;
	bool                isMade      = false; // the triangulation is that of the lists, which have been checked
};
REGISTER_SERIALIZABLE(PorePressureField);

} // namespace yade
