// Contacts of the plane that were left out of a solve whose velocities would close them (Recall.hpp).
#include "ContactSeam.hpp"
#include "Recall.hpp"

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;

/// A body that is hit in the step may reach others that nothing approached before.
size_t ContactSeam::recall()
{
	const auto gapAfter = [this](size_t k) {
		const Contact& c = leftContacts[k];
		return gapOf(c, stateOf(leftLinks[k]))
		        + relaxation.step
		        * contact::relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]).n;
	};
	const auto taken = toBeTakenIn(leftLinks.size(), recalls, gapAfter, [this](size_t k) {
		return leftContacts[k].length;
	});
	if (!taken.empty()) takeIn(taken);
	return taken.size();
}

/// Takes contacts that were left out into the solve, into the order of ids.
void ContactSeam::takeIn(const std::vector<size_t>& taken)
{
	const auto key = [](const Contact& c) { return std::minmax(c.i, c.j); };
	mergeInto(
	        links.size(), taken.size(),
	        [&](size_t o, size_t a) { return key(problem.contacts[o]) > key(leftContacts[taken[a]]); },
	        [&](size_t a, size_t to) {
		        links[to]            = leftLinks[taken[a]];
		        problem.contacts[to] = leftContacts[taken[a]];
		        problem.impulses[to] = warmStart[to] = {};
	        },
	        links, problem.contacts, problem.impulses, warmStart);
	eraseAt(leftLinks, taken);
	eraseAt(leftContacts, taken);
}

} // namespace yade::nscd
