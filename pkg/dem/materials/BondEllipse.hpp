// The elliptic zone of a bond (Figure 2b of Taboada and Estrada 2009), from positions and rotations of two bodies in
// space: walls may stand in any way. The equations, and the same for bodies in the plane, are in
// contact/plane/bond.hpp.
#pragma once

#include "NscdPhys.hpp"
#include <contact/plane/bond.hpp>
#include <core/Body.hpp>

namespace yade::nscd {

/// Bodies of an interaction in the bond's order: the wall first, or the body of lower id.
struct BondPair {
	const Body *first, *second;
	bool        swapped; // against the interaction's own order
};

BondPair bondPair(const Body& b1, const Body& b2);

/// Marks the points of a bond on its bodies; `Marks` has anchor1, anchor2 and axis as NscdPhys has. `normal` points
/// from the first body to the second.
template <class Marks>
void markPoints(Marks& marks, const State& first, const State& second, const Vector3r& normal, Real secondRadius)
{
	const Vector3r point = second.pos - secondRadius * normal;
	marks.anchor1        = first.ori.conjugate() * (point - first.pos);
	marks.anchor2        = second.ori.conjugate() * (point - second.pos);
	marks.axis           = first.ori.conjugate() * normal;
}

/// Marks the bond's points at its creation. `normal` points from the first body to the second, `gap` [m] may be
/// negative.
void markBond(NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap);

/// Of the marked point, in the ellipse's axes; `Place`: a State, or anything else with `pos` and `ori`.
template <class Marks, class Place>
nonsmooth::contact::plane::BondDisplacement
bondDisplacement(const Marks& marks, const Place& first, const Place& second)
{
	const Vector3r d = second.pos + second.ori * marks.anchor2 - first.pos - first.ori * marks.anchor1;
	const Vector3r n = first.ori * marks.axis;
	return { d.dot(n), n[0] * d[1] - n[1] * d[0] };
}

/// What the bodies of a bond have slipped on and turned against each other since it was made; `normal` now, from the
/// first to the second, and the gap [m].
nonsmooth::contact::plane::BondStrain
bondStrain(const NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap);

/// How a bond that has left its ellipse was broken, from the paths along which it yielded.
NscdPhys::Mode bondMode(const Vector3r& yieldPath);

} // namespace yade::nscd
