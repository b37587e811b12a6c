// Contacts of two bodies whose motions are both given: walls, disks that are held, disks that an engine drives. No
// impulse changes how such bodies move against each other, so the solve finds nothing there. What the law says of a
// given motion is the reaction (law.hpp, impulseOfGivenMotion); doc/theory/stepping.rst says why.
#include "ContactSeam.hpp"
#include <algorithm>
#include <contact/plane/law.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;
using contact::Impulse;
using contact::RelativeVelocity;

/// Relative velocity, without what comes from the frame, which is that of the step's beginning: a pair that turns by
/// the angle φ in a step leaves it by ℓ φ² along the normal and by ℓ φ³ along the tangent, where nothing opens and
/// nothing slides.
contact::RelativeVelocity ContactSeam::givenVelocity(const Contact& c) const
{
	constexpr Real   rounding = 1e-12; // of a diameter, or rad, in a step
	const Real       h        = relaxation.step;
	const auto &     vi = before[c.i], &vj = before[c.j];
	RelativeVelocity u  = contact::relativeVelocity(c, vi, vj);
	const Real       ri = radius[c.i], rj = radius[c.j],
	           smallest = ri > 0 && rj > 0 ? std::min(ri, rj) : std::max(ri, rj);
	const Real turn     = h
	        * (std::abs(contact::passingSpeed(c, vi, vj)) / smallest + std::max(std::abs(vi.w), std::abs(vj.w)));
	const auto count = [h](Real speed, Real least) { return std::abs(h * speed) > least ? speed : 0; };
	u.n              = count(u.n, c.length * (turn * turn + rounding));
	u.t              = count(u.t, c.length * (turn * turn * turn + rounding));
	u.r              = count(u.r, rounding);
	return u;
}

void ContactSeam::answerGivenMotion()
{
	drivenTogether = drivenPairs = 0;
	if (!slides) return;
	for (size_t k = 0; k < links.size(); ++k) {
		const Contact& c = problem.contacts[k];
		if (!problem.inverseMass[c.i].isFixed() || !problem.inverseMass[c.j].isFixed()) continue;
		const RelativeVelocity u = givenVelocity(c);
		const ContactState&    r = stateOf(links[k]);
		problem.impulses[k]      = contact::impulseOfGivenMotion(c, u);
		const bool isFree        = c.play > 0 && u.n + c.biasN >= 0; // a bond that closes
		if (!(-u.n > 0) || !(r.bonded || r.gap <= 0) || isFree) continue;
		++drivenPairs;
		if (-u.n > drivenTogether) {
			drivenTogether = -u.n;
			drivenIds[0]   = std::min(c.i, c.j);
			drivenIds[1]   = std::max(c.i, c.j);
		}
	}
}

} // namespace yade::nscd
