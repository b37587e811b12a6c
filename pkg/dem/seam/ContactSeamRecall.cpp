// Contacts that were left out of a solve whose velocities would close them: they are taken in, and the step is solved
// again.
#include "ContactSeam.hpp"
#include <algorithm>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;

namespace {
	constexpr Real unseen = 0.005; // ℓ; what a contact left out of the solve may overlap without being recalled

	constexpr int mostRecalls = 4; // solves of a step after which all contacts left out are taken in
}

/// A body that is hit in the step may reach others that nothing approached before.
size_t ContactSeam::recall()
{
	const auto gapAfter = [this](size_t k) {
		const Contact& c = leftContacts[k];
		return gapOf(c, readingOf(leftLinks[k]))
		        + relaxation.step
		        * contact::relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]).n;
	};
	bool needed = false;
	for (size_t k = 0; k < leftLinks.size() && !needed; ++k)
		needed = gapAfter(k) < -unseen * leftContacts[k].length;
	if (!needed) return 0;
	++recalls;
	std::vector<size_t> taken;
	for (size_t k = 0; k < leftLinks.size(); ++k)
		if (recalls > mostRecalls || gapAfter(k) < 0) taken.push_back(k);
	takeIn(taken);
	return taken.size();
}

/// Takes contacts that were left out into the solve, into the order of ids, from the back.
void ContactSeam::takeIn(const std::vector<size_t>& taken)
{
	const auto key = [](const Contact& c) { return std::pair(std::min(c.i, c.j), std::max(c.i, c.j)); };
	size_t     old = links.size(), b = taken.size(), at = old + b;
	links.resize(at);
	problem.contacts.resize(at);
	problem.impulses.resize(at);
	warmStart.resize(at);
	while (b > 0) {
		--at;
		if (old > 0 && key(problem.contacts[old - 1]) > key(leftContacts[taken[b - 1]])) {
			--old;
			links[at]            = links[old];
			problem.contacts[at] = problem.contacts[old];
			problem.impulses[at] = problem.impulses[old];
			warmStart[at]        = warmStart[old];
		} else {
			--b;
			links[at]            = leftLinks[taken[b]];
			problem.contacts[at] = leftContacts[taken[b]];
			problem.impulses[at] = warmStart[at] = {};
		}
	}
	size_t left = 0;
	for (size_t k = 0, next = 0; k < leftLinks.size(); ++k) {
		if (next < taken.size() && taken[next] == k) {
			++next;
			continue;
		}
		leftLinks[left]      = leftLinks[k];
		leftContacts[left++] = leftContacts[k];
	}
	leftLinks.resize(left);
	leftContacts.resize(left);
}

} // namespace yade::nscd
