#include <algorithm>
#include <contact/core/strip_schedule.hpp>

namespace nonsmooth::contact {

namespace {
	// Passes at once: no more than whose strips share a cache with those of other workers (ten sweeps and a look at
	// the residual), and a triangle is kept small beside a stretch.
	constexpr std::size_t deepest = 11, pairsADepth = 8;
}

void StripSchedule::plan(const std::vector<std::size_t>& begin, std::size_t evenStrips, int workers)
{
	strips          = begin.size() < 2 ? 0 : begin.size() - 2;
	pairs           = evenStrips;
	leftOver        = strips > 0 && begin.back() > begin[strips];
	const auto size = [&](std::size_t place) { return place < strips ? begin[place + 1] - begin[place] : 0; };
	const auto odd  = [&](std::size_t pair) { return evenStrips + pair; };
	const std::size_t count = std::min(pairs, static_cast<std::size_t>(std::max(1, workers)));

	// a stretch ends with the pair that comes nearest to its share, but has one at least
	std::vector<std::size_t> ends;
	std::size_t              done = 0;
	const std::size_t        all  = strips > 0 ? begin[strips] : 0;
	for (std::size_t p = 0; p < pairs; ++p) {
		done += size(p) + size(odd(p));
		const std::size_t worker = ends.size();
		if (worker + 1 == count) break;
		const std::size_t next = p + 1 < pairs ? size(p + 1) + size(odd(p + 1)) : 0;
		if ((2 * done + next) * count >= 2 * all * (worker + 1) || pairs - (p + 1) == count - (worker + 1))
			ends.push_back(p + 1);
	}
	if (count > 0) ends.push_back(pairs);

	stretches.assign(ends.size(), {});
	progress          = std::vector<Progress>(ends.size());
	std::size_t first = 0, shortest = pairs;
	for (std::size_t w = 0; w < ends.size(); ++w) {
		Stretch& s             = stretches[w];
		s.first                = first;
		s.end                  = ends[w];
		shortest               = std::min(shortest, ends[w] - first);
		const std::size_t last = ends[w] - 1, middle = first + (last - first + 1) / 2;
		const auto        visit = [&](std::size_t place) { s.visits.push_back(place); };
		s.reaches               = w + 1 < ends.size();
		visit(first);
		for (std::size_t p = first + 1; p < middle; ++p) {
			visit(p);
			visit(odd(p - 1));
		}
		if (last > first) visit(last);
		s.joint = s.visits.size();
		if (odd(last) < strips) visit(odd(last));
		for (std::size_t p = std::max(middle, first + 1); p < last; ++p) {
			visit(p);
			visit(odd(p - 1));
		}
		if (last > first) visit(odd(last - 1));
		first = ends[w];
	}
	depth = leftOver ? 1 : static_cast<int>(std::clamp<std::size_t>(shortest / pairsADepth, 1, deepest));
}

} // namespace nonsmooth::contact
