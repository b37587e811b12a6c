#include "NscdSpacePhys.hpp"
#include "../checks/Refusal.hpp"

namespace yade {

YADE_PLUGIN((NscdSpacePhys));

void NscdSpacePhys::updateThresholds(Real gap, Real adhesionRange)
{
	NscdPhys::updateThresholds(gap, adhesionRange);
	currentTwistingArm = bonded ? twistingArm : residualTwistingArm;
}

std::pair<const char*, Real> NscdSpacePhys::senseless() const
{
	using Named = std::pair<const char*, Real>;
	for (const Named& one :
	     { Named("twistingArm", twistingArm), Named("residualTwistingArm", residualTwistingArm) })
		if (!(one.second >= 0 && nscd::isNumber(one.second))) return one;
	if (bonded && !(ellipseTwisting > 0)) return { "ellipseTwisting", ellipseTwisting };
	return NscdPhys::senseless();
}

void NscdSpacePhys::setStrengths(const NscdMat& a, const NscdMat& b)
{
	for (Real* force : { &tensileForce, &residualTensileForce })
		*force *= areaOf(length) / length;
	// a wall's or an interface's own value, or the weaker of two particles', as for rolling
	const NscdMat* law  = a.interfaceWith(b);
	const auto     pick = [&](const auto& of) {
                if (law) return of(*law);
                return a.wall ? of(a) : (b.wall ? of(b) : std::min(of(a), of(b)));
	};
	ellipseTwisting     = pick([](const NscdMat& m) {
                return m.bondEllipseTwisting < 0 ? 2 * m.bondEllipseTangential : m.bondEllipseTwisting;
        });
	twistingArm         = length * pick([](const NscdMat& m) { return m.twistingFriction; });
	residualTwistingArm = length
	        * pick([](const NscdMat& m) { return nscd::residual(m.residualTwistingFriction, m.twistingFriction); });
}

} // namespace yade
