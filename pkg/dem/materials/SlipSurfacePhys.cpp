#include "SlipSurfacePhys.hpp"

namespace yade {

YADE_PLUGIN((SlipSurfacePhys));

void SlipSurfacePhys::updateThresholds(Real gap, Real adhesionRange)
{
	const bool written = isFrictionWritten();
	NscdPhys::updateThresholds(gap, adhesionRange);
	if (!wallMaterial) return; // made by a script
	const Real wanted = currentFriction;
	currentFriction   = wallMaterial->frictionOf(cell);
	if (written) overruled = currentFriction != wanted;
	tangensOfFrictionAngle = currentFriction;
}

void SlipSurfacePhys::noteSliding(const nscd::Sliding& sliding)
{
	if (!wallMaterial) return; // made by a script
	cell = wallMaterial->cellAt(*Body::byId(wall), sliding.place);
	wallMaterial->note(cell, sliding.pressed, sliding.speed, sliding.meanSpeed, sliding.lost);
}

} // namespace yade
