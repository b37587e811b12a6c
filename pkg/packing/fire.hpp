// The fast inertial relaxation engine (FIRE): Bitzek, Koskinen, Gähler, Moseler and Gumbsch, Structural relaxation made
// simple, Phys. Rev. Lett. 97, 170201 (2006).
//
// Bodies with the velocities v follow forces F, each by its mobility, so that F is an acceleration a; the time has no
// unit here. As long as the power F·v is positive, velocities are turned towards the forces, v ← (1 − α) v + α |v|
// a/|a|, and after five such steps in a row the step grows and α falls; where it is not, all bodies stop and the step
// is halved. Then v ← v + Δt a, and the place moves by Δt v.
#pragma once

#include <algorithm>
#include <cmath>

namespace nonsmooth::packing {

class Fire {
public:
	/// What is done to velocities: v ← keep v + pull a, then v ← v + step a.
	struct Change {
		bool   stops; // v ← 0 in place of the former
		double keep, pull, step;
	};
	/// Of sums over all bodies: the `power` F·v, the velocities' square v·v, and the accelerations' a·a.
	Change next(double power, double speed, double acceleration)
	{
		if (!(power > 0)) {
			step     = std::max(0.5 * step, 0.05);
			mix      = 0.1;
			downhill = 0;
			return { true, 0, 0, step };
		}
		Change change { false, 1 - mix, mix * std::sqrt(speed / acceleration), 0 };
		if (++downhill > 5) {
			step = std::min(1.1 * step, 1.0);
			mix  = 0.99 * mix;
		}
		change.step = step;
		return change;
	}

private:
	double step = 0.2, mix = 0.1; // Δt, α
	int    downhill = 0;
};

} // namespace nonsmooth::packing
