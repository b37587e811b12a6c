// Bonds of bodies in space: their marks, where they stand now, and what becomes of them in a step. Equations:
// contact/space/bond.hpp.
#pragma once

#include "../materials/BondEllipse.hpp"
#include "NscdSpacePhys.hpp"
#include <contact/space/bond.hpp>

namespace yade::nscd {

/// Marks a bond's points, and how its bodies stand to each other.
void markBondInSpace(NscdSpacePhys& phys, const BondPair& pair, const Vector3r& normal, Real gap);

/// Of the marked point and of the twist, since the bond was made.
nonsmooth::contact::space::BondDisplacement
bondDisplacementInSpace(const NscdSpacePhys& phys, const State& first, const State& second);

/// Follows a bond over the `gap` [m] that it has now; returns whether it lives.
bool followBondInSpace(NscdSpacePhys& phys, const BondPair& pair, Real gap);

/// How a bond that has left its zone was broken.
NscdPhys::Mode bondModeInSpace(const NscdSpacePhys& phys);

} // namespace yade::nscd
