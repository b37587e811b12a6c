#include <algorithm>
#include <contact/plane/bordered_band.hpp>
#include <contact/plane/mass_jumps.hpp>
#include <cstdlib>

namespace nonsmooth::contact {
namespace {

	constexpr std::size_t  most = 12, mostHubs = 8; // contacts of a body that is no hub, and hubs of a patch
	constexpr std::int32_t none = -1;

	/// Contacts by their bodies.
	struct Network {
		std::vector<std::size_t>  begin; // in `contacts`, of every body; one more than there are
		std::vector<std::int32_t> contacts;
		const Problem&            problem;

		explicit Network(const Problem& problem_)
		        : problem(problem_)
		{
			begin.assign(problem.bodyCount() + 1, 0);
			for (const Contact& c : problem.contacts)
				++begin[c.i + 1], ++begin[c.j + 1];
			for (std::size_t b = 1; b < begin.size(); ++b)
				begin[b] += begin[b - 1];
			auto next = begin;
			contacts.resize(begin.back());
			for (std::size_t k = 0; k < problem.contactCount(); ++k)
				for (const std::int32_t b : { problem.contacts[k].i, problem.contacts[k].j })
					contacts[next[b]++] = static_cast<std::int32_t>(k);
		}
		bool moves(std::int32_t b) const { return !problem.inverseMass[b].isFixed(); }
		/// Calls with(neighbour, contact) for the contacts of a body.
		template <class With> void around(std::int32_t b, With with) const
		{
			for (std::size_t k = begin[b]; k < begin[b + 1]; ++k) {
				const Contact& c = problem.contacts[contacts[k]];
				with(c.i == b ? c.j : c.i, contacts[k]);
			}
		}
	};

	/// The heavy body of each jump, the heaviest first.
	std::vector<std::int32_t> heavyBodies(const Problem& problem)
	{
		std::vector<std::int32_t> found;
		const auto                lightness = [&](std::int32_t b) {
                        return problem.inverseMass[b].x + problem.inverseMass[b].y;
		};
		for (const Contact& c : problem.contacts)
			if (isMassJump(problem.inverseMass[c.i], problem.inverseMass[c.j], jumpOf(problem)))
				found.push_back(lightness(c.i) < lightness(c.j) ? c.i : c.j);
		std::sort(found.begin(), found.end());
		found.erase(std::unique(found.begin(), found.end()), found.end());
		std::stable_sort(found.begin(), found.end(), [&](auto a, auto b) {
			return lightness(a) < lightness(b);
		});
		return found;
	}

	/// Bodies from one on, counted by contacts, as far as `wanted` says; `seen` marks them.
	template <class Wanted>
	std::vector<std::int32_t>
	nearest(const Network& network, std::int32_t first, std::size_t count, std::vector<char>& seen, Wanted wanted)
	{
		std::vector<std::int32_t> found { first };
		seen[first] = true;
		for (std::size_t k = 0; k < found.size(); ++k)
			network.around(found[k], [&](std::int32_t b, std::int32_t) {
				if (found.size() == count || seen[b] || !wanted(b)) return;
				seen[b] = true;
				found.push_back(b);
			});
		return found;
	}

	/// Orders the bodies so that neighbours are near each other (Cuthill and McKee), hubs last, and finds how near.
	void arrange(const Network& network, MassPatch& patch, std::vector<std::int32_t>& placeOf)
	{
		std::vector<char> left(network.problem.bodyCount(), false), seen(left.size(), false);
		const auto        degree = [&](std::int32_t b) { return network.begin[b + 1] - network.begin[b]; };
		std::vector<std::int32_t> hubs, order;
		std::vector<std::int32_t> sorted = patch.bodies;
		std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return degree(a) > degree(b); });
		for (const std::int32_t b : sorted)
			if (hubs.size() < mostHubs && degree(b) > most && sorted.size() > most) hubs.push_back(b);
			else
				left[b] = true;
		for (const std::int32_t b : patch.bodies) {
			if (!left[b] || seen[b]) continue;
			// from an end: what is furthest from any body
			auto       visited = seen;
			const auto part    = nearest(network, b, patch.bodies.size(), visited, [&](auto n) {
                                return bool(left[n]);
                        });
			const auto ordered = nearest(network, part.back(), patch.bodies.size(), seen, [&](auto n) {
				return bool(left[n]);
			});
			order.insert(order.end(), ordered.begin(), ordered.end());
		}
		patch.hubs = hubs.size();
		for (std::size_t k = 0; k < order.size(); ++k)
			placeOf[order[k]] = static_cast<std::int32_t>(k);
		patch.width = 0;
		for (const std::int32_t b : order)
			network.around(b, [&](std::int32_t n, std::int32_t) {
				if (left[n])
					patch.width = std::max<std::size_t>(
					        patch.width, std::abs(placeOf[b] - placeOf[n]));
			});
		for (const std::int32_t b : order)
			placeOf[b] = none;
		order.insert(order.end(), hubs.begin(), hubs.end());
		patch.bodies = std::move(order);
	}

} // namespace

double MassPatch::work() const
{
	constexpr double iterations = 20,
	                 visit      = 100; // of the interior point; multiplications of a visit, and what else it takes
	return iterations / visit * BorderedBand::work(3 * (bodies.size() - hubs), 3 * hubs, 3 * width + 2);
}

std::vector<MassPatch> massPatches(const Problem& problem)
{
	std::vector<MassPatch> patches;
	const auto             heavy = heavyBodies(problem);
	const auto moving = std::count_if(problem.inverseMass.begin(), problem.inverseMass.end(), [](const auto& m) {
		return !m.isFixed();
	});
	if (8 * heavy.size() > std::size_t(moving) && std::size_t(moving) > fewBodies) return patches;
	const Network             network(problem);
	std::vector<char>         taken(problem.bodyCount(), false);
	std::vector<std::int32_t> placeOf(problem.bodyCount(), none);
	for (const std::int32_t first : heavy) {
		if (taken[first]) continue;
		std::vector<char> inside(problem.bodyCount(), false);
		MassPatch         patch;
		patch.bodies = nearest(network, first, mostInPatch, inside, [&](auto b) { return network.moves(b); });
		for (const std::int32_t b : patch.bodies) {
			taken[b] = true;
			network.around(b, [&](std::int32_t n, std::int32_t k) {
				if (!network.moves(n) || (inside[n] && problem.contacts[k].i == b))
					patch.contacts.push_back(k);
			});
		}
		std::sort(patch.contacts.begin(), patch.contacts.end());
		arrange(network, patch, placeOf);
		patches.push_back(std::move(patch));
	}
	return patches;
}

} // namespace nonsmooth::contact
