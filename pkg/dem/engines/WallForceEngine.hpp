// What a wall bears, summed up over steps: its mean and its peak, without a look from Python in each step.
//
//     normal = Σ (X_g sin α_g − Y_g cos α_g)    shear = Σ (X_g cos α_g + Y_g sin α_g)
// over the straight parts g of the wall, with (X_g, Y_g) the sum of the forces on the pieces of one and α_g its
// direction.
#pragma once

#include <boost/python.hpp>
#include <core/GlobalEngine.hpp>

namespace yade {

class WallForceEngine : public GlobalEngine {
public:
	void                 action() override;
	boost::python::tuple take();
	void                 forget() { seconds = normal = shear = peak = 0; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(WallForceEngine,GlobalEngine,
R"""(Sums up the force on the pieces of a wall that does not move, over the steps since :yref:`take<WallForceEngine.take>`.
It changes nothing. Place it behind the integrator; :yref:`yade.nonsmooth.wall_forces` does.)""",
		((vector<int>,ids,,,"Bodies of the pieces, in their order along the wall."))
		((vector<Vector3r>,along,,,"For each piece the unit vector along it, in its direction of travel; pieces that follow one another "
		        "with the same one are summed up first."))
		((int,period,1,,"Only steps after which O.iter is a multiple of it count."))
		((Real,seconds,0,Attr::readonly,"Length of the steps that were counted [s]."))
		((Real,normal,0,Attr::readonly,"Integral of the force over them, positive into the wall, on the right of its direction of travel [N s]."))
		((Real,shear,0,Attr::readonly,"The same along the wall [N s]."))
		((Real,peak,0,Attr::readonly,"Largest normal force of a step that was counted [N]."))
		,
		/* ctor */
		,
		.def("take",&WallForceEngine::take,"Means of the normal and of the shear force and the largest normal force [N], a triple; then restarts "
		        "the sums. Raises RuntimeError if no step was counted.")
		.def("forget",&WallForceEngine::forget,"Restart the sums.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(WallForceEngine);

} // namespace yade
