// Contacts in space that need not be solved for: which are left out, and which are taken in again (seam/Recall.hpp).
#include "SpaceSeam.hpp"
#include "../seam/Recall.hpp"
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

/// A contact that is open and will not close in the step, with its bodies, normal, levers and length; none where it must
/// be solved for.
std::optional<space::Contact> SpaceSeam::staysOut(const SpaceContactState& s) const
{
	const Real widest = relaxation.openGap * s.length;
	if (s.bonded || (!s.kept && s.phys->breaks) || s.gap <= widest) return {};
	space::Contact c;
	setFrame(s, c);
	const auto& v     = problem.freeVelocity;
	const Real  speed = relativeVelocity(c, v[c.i], v[c.j]).n;
	if (!staysOpen(s.gap, speed, relaxation.step, widest)) return {};
	return c;
}

/// What is left out bears nothing.
void SpaceSeam::forgetReactions(SpaceContactState& s)
{
	if (!s.kept) s.phys->touched = false;
	if (s.pressed == 0 && s.correction == 0) return;
	s.pressed = s.tangential = s.torque = s.twistingTorque = s.correction = 0;
	s.normalForce = s.shearForce = s.rollingTorque = {};
	if (!s.kept) SpaceContacts::writeReactions(s);
}

size_t SpaceSeam::recall()
{
	const auto gapAfter = [this](size_t k) {
		const auto& c = left[k].contact;
		const auto& v = problem.velocities;
		return kept->states[left[k].place.slot].gap + relaxation.step * relativeVelocity(c, v[c.i], v[c.j]).n;
	};
	const auto taken = toBeTakenIn(left.size(), recalls, gapAfter, [this](size_t k) {
		return left[k].contact.length;
	});
	if (!taken.empty()) takeIn(taken);
	return taken.size();
}

/// Takes contacts that were left out into the solve, into the order of ids.
void SpaceSeam::takeIn(const std::vector<size_t>& taken)
{
	const auto ids = [](const SpaceContacts::Place& p) { return std::make_pair(p.low, p.high); };
	mergeInto(
	        solved.size(), taken.size(),
	        [&](size_t o, size_t a) { return ids(solved[o]) > ids(left[taken[a]].place); },
	        [&](size_t a, size_t to) {
		        solved[to] = left[taken[a]].place;
		        gatherContact(to);
		        warmStart[to] = problem.impulses[to];
	        },
	        solved, problem.contacts, problem.impulses, warmStart);
	eraseAt(left, taken);
}

} // namespace yade::nscd
