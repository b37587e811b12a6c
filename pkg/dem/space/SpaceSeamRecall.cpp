// Contacts in space that need not be solved for: which are left out, and which are taken in again (seam/Recall.hpp).
#include "SpaceSeam.hpp"
#include "../seam/Recall.hpp"
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

/// A contact that is open and will not close in the step, with its bodies, normal, levers and length; none where it must
/// be solved for.
std::optional<space::Contact> SpaceSeam::staysOut(const Link& link) const
{
	const NscdPhys& phys   = *link.phys;
	const Real      widest = relaxation.openGap * phys.length;
	if (phys.bonded || phys.breaks || link.gap <= widest) return {};
	space::Contact c;
	setFrame(link, c);
	const auto& v     = problem.freeVelocity;
	const Real  speed = relativeVelocity(c, v[c.i], v[c.j]).n;
	if (!staysOpen(link.gap, speed, relaxation.step, widest)) return {};
	return c;
}

/// What is left out bears nothing.
void SpaceSeam::forgetReactions(const Link& link)
{
	auto& phys   = static_cast<NscdSpacePhys&>(*link.phys);
	phys.touched = false;
	if (phys.normal == 0 && phys.correction == 0) return;
	phys.normal = phys.tangential = phys.torque = phys.twistingTorque = phys.correction = 0;
	phys.normalForce = phys.shearForce = phys.rollingTorque = Vector3r::Zero();
	phys.noteForces();
}

size_t SpaceSeam::recall()
{
	const auto gapAfter = [this](size_t k) {
		const auto& c = left[k].contact;
		const auto& v = problem.velocities;
		return left[k].link.gap + relaxation.step * relativeVelocity(c, v[c.i], v[c.j]).n;
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
	const auto        key = [](const Link& l) { return std::minmax(l.i, l.j); };
	std::vector<Link> added;
	for (const size_t k : taken)
		added.push_back(left[k].link);
	std::sort(added.begin(), added.end(), [&](const Link& a, const Link& b) { return key(a) < key(b); });
	mergeInto(
	        links.size(), added.size(), [&](size_t o, size_t a) { return key(links[o]) > key(added[a]); },
	        [&](size_t a, size_t to) {
		        links[to] = added[a];
		        gatherContact(to);
		        warmStart[to] = problem.impulses[to];
	        },
	        links, problem.contacts, problem.impulses, warmStart);
	eraseAt(left, taken);
}

} // namespace yade::nscd
