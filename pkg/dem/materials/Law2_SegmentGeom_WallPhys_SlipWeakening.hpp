// Soft contact of a disk with a wall whose strength may fall as disks slip: the walls of Taboada and Estrada (2009),
// sections 3.3 and 5.3, for YADE's soft models.
//
// With δ the penetration, N = k_n (δ − δ₀), T the spring along the wall, M that about z (thresholds as eqs 2, 4 and 6,
// F_a = 0 without a bond):
//     −N ≤ F_a ,   |T| ≤ μ_s (F_a + N) ,   |M| ≤ μ_r ℓ (F_a + N) .
// A fragile bond that reaches a threshold breaks for good, a ductile one yields until it has left its ellipse
// (BondEllipseEngine), both as in Law2_ScGeom6D_CohFrictPhys_CohesionMoment; residual μ_s and μ_r hold from then on.
// Slip is what the friction spring yields by: a contact that sticks does not slip, as in the hard law. It is summed for
// each disk in the wall's SlipWeakeningMat, and F_a and μ_s fall with it as in SlipWeakeningPhys.
// Sign: N > 0 presses; the normal points from the wall to the disk. Deviations from the hard law: springs; no residual
// tensile strength; a disk that passes a joint of two segments begins with relaxed springs on the next one, and a bond
// there stays with its segment.
#pragma once

#include "../walls/Segment.hpp"
#include "WallPhys.hpp"
#include <core/Dispatching.hpp>
#include <mutex>

namespace yade {

class Law2_SegmentGeom_WallPhys_SlipWeakening : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override;
	FUNCTOR2D(SegmentGeom, WallPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_SegmentGeom_WallPhys_SlipWeakening,LawFunctor,
R"""(Springs with tension, friction and rolling limits at a wall of :yref:`Segments<Segment>`, for scenes with YADE's soft contact models. A wall
of :yref:`SlipWeakeningMat` loses strength with slip as it does in Contact Dynamics (Taboada and Estrada 2009, section 5.3).)""");
	// clang-format on
private:
	std::mutex slipLock; // a material's slip is shared by contacts of all threads
};
REGISTER_SERIALIZABLE(Law2_SegmentGeom_WallPhys_SlipWeakening);

} // namespace yade
