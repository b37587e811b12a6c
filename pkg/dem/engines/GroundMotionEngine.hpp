// An earthquake: the ground moves by a given acceleration a(t), as the rock below a slope does.
//
// In the frame of the ground, which walls are at rest in, each free body bears
//     F = −m ā      ā = (V(t+h) − V(t)) / h
// over the step of length h that begins at time t, V the ground's velocity: the record's mean over the step, so that
// the impulses of all steps sum up to the record's integral, however long steps are. Seen from outside, the walls move:
// in each step with V(t+h), the velocity of its end, as contacts are solved with velocities of the step's end. Both are
// the same motion in two frames, and the same step of Moreau and Jean. The disks are rigid: no wave runs through the
// mass, and the ground moves as a whole.
#pragma once

#include "AccelerationRecord.hpp"
#include <core/Body.hpp>
#include <core/GlobalEngine.hpp>

namespace yade {

class GroundMotionEngine : public GlobalEngine {
public:
	void action() override;
	/// A list was set, or all of them were loaded.
	void postLoad(GroundMotionEngine&) { isMade = false; }
	/// Throws std::invalid_argument, naming it, for a number or a list of numbers that is none.
	void     validate() const;
	Vector3r accelerationAt(Real time) { return of(&nscd::AccelerationRecord::acceleration, time); }
	Vector3r velocityAt(Real time) { return of(&nscd::AccelerationRecord::velocity, time); }
	Vector3r displacementAt(Real time) { return of(&nscd::AccelerationRecord::displacement, time); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GroundMotionEngine,GlobalEngine,
R"""(Shakes the ground by a record of its acceleration, linear between the :yref:`times<GroundMotionEngine.times>`. Without :yref:`ids<GroundMotionEngine.ids>` in the moving frame: walls
stay where they are, and each free body bears :math:`-m\bar a`, with :math:`\bar a` the mean acceleration of the step, so that the sum over steps is the record's integral whatever
their length. With them seen from outside: these bodies move with the ground's velocity. Before its first time and after its last one the ground's acceleration is zero; a record that
was not corrected leaves it a velocity, which :yref:`velocity<GroundMotionEngine.velocity>` tells.
Place it after :yref:`ForceResetter` and before :yref:`ContactDynamicsEngine`, in soft scenes before the integrator.)""",
		((vector<Real>,times,,Attr::triggerPostLoad,"Times [s] of the record, rising, counted from :yref:`begin<GroundMotionEngine.begin>`."))
		((vector<Real>,horizontal,,Attr::triggerPostLoad,"Acceleration of the ground along x [m/s²] at these times; none: it does not move so."))
		((vector<Real>,vertical,,Attr::triggerPostLoad,"The same along y, upwards [m/s²]."))
		((Real,begin,0,,"O.time at which the record's time is zero [s]."))
		((Real,scale,1,,"Factor of all accelerations."))
		((vector<Body::id_t>,ids,,,"Bodies that move with the ground, whose motion in the plane is blocked; none: the frame moves."))
		((Vector3r,acceleration,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"The ground's mean acceleration over the last step [m/s²]."))
		((Vector3r,velocity,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Its velocity at the end of that step [m/s]."))
		((Vector3r,displacement,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Its displacement then [m]."))
		((Vector3r,totalForce,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Sum of the forces on free bodies in that step [N]; zero with ids."))
		,
		/* ctor */,
		.def("accelerationAt",&GroundMotionEngine::accelerationAt,(boost::python::arg("time")),"Acceleration of the ground [m/s²] at O.time = time [s].")
		.def("velocityAt",&GroundMotionEngine::velocityAt,(boost::python::arg("time")),"Its velocity then [m/s].")
		.def("displacementAt",&GroundMotionEngine::displacementAt,(boost::python::arg("time")),"Its displacement then [m].")
	);
	// clang-format on

private:
	using Pair = nscd::AccelerationRecord::Pair;
	Vector3r of(Pair (nscd::AccelerationRecord::*what)(double) const, Real time);
	Vector3r scaled(const Pair& pair) const { return scale * Vector3r(pair[0], pair[1], 0); }
	/// That of the lists.
	const nscd::AccelerationRecord& record();

	nscd::AccelerationRecord made;
	bool                     isMade = false; // of the lists as they are, which have been checked
};
REGISTER_SERIALIZABLE(GroundMotionEngine);

} // namespace yade
