// The elliptic zone of a bond (Figure 2b of Taboada and Estrada 2009), from positions and rotations of two bodies.
#pragma once

#include "NscdPhys.hpp"
#include <core/Body.hpp>

namespace yade::nscd {

/// Bodies of an interaction in the bond's order: the wall first, or the body of lower id.
struct BondPair {
	const Body *first, *second;
	bool        swapped; // against the interaction's own order
};

BondPair bondPair(const Body& b1, const Body& b2);

/// Marks the bond's points at its creation. `normal` points from the first body to the second, `gap` [m] may be negative.
void markBond(NscdPhys& phys, const BondPair& pair, const Vector3r& normal, Real gap, Real secondRadius);

/// (d_n, d_t) of the marked point in the ellipse's axes [m]; `Place`: a State, or anything else with `pos` and `ori`.
template <class Place> std::pair<Real, Real> bondDisplacement(const NscdPhys& phys, const Place& first, const Place& second)
{
	const Vector3r d = second.pos + second.ori * phys.anchor2 - first.pos - first.ori * phys.anchor1;
	const Vector3r n = first.ori * phys.axis;
	return { d.dot(n), n[0] * d[1] - n[1] * d[0] };
}

/// How a bond that has left its ellipse was broken, from the paths along which it yielded.
NscdPhys::Mode bondMode(const NscdPhys& phys);

} // namespace yade::nscd
