#include <algorithm>
#include <cmath>
#include <contact/core/strip_cut.hpp>
#include <omp.h>

namespace nonsmooth::contact {

namespace {

	constexpr std::size_t contactsAStrip = 512; // wanted: a strip's rows and bodies stay in a second-level cache
	constexpr std::size_t binsAStrip     = 32;
	constexpr std::size_t fewStrips      = 64; // half as many are enough not to leave long contacts over
	constexpr std::size_t rareContacts   = 32; // one in so many may be left over
	constexpr std::size_t sampleCount    = 1024;
	constexpr double      rounding       = 1.000001;

	/// The way along which strips follow one another: an axis, upwards or, with the sign −1, downwards.
	struct Way {
		int    axis;
		double sign = 1;

		double at(const Coordinates& places, std::int32_t b) const { return sign * places(b, axis); }
		Span   operator()(const Span& s) const { return sign > 0 ? s : Span { -s.high, -s.low }; }
	};

	/// Along an axis in the direction in which the numbers of bodies rise, so that a mirrored scene has the
	/// mirrored strips; in the plane upwards along y.
	Way along(const Coordinates& places, const Classification& classification, int axis)
	{
		if (axis > 0 && places.axes == 2) return { axis };
		const auto moves = [](std::uint8_t trait) { return (trait & Classification::moves) != 0; };
		const auto first = std::find_if(classification.traits.begin(), classification.traits.end(), moves);
		const auto last  = std::find_if(classification.traits.rbegin(), classification.traits.rend(), moves);
		if (first == classification.traits.end()) return { axis };
		const double from = places(first - classification.traits.begin(), axis),
		             to   = places(classification.traits.rend() - last - 1, axis);
		return { axis, to < from ? -1.0 : 1.0 };
	}

	/// Where contacts are, but for one in 128 at either end and what lies far beyond.
	Span mostOf(std::vector<double>& samples, const Span& extent)
	{
		if (samples.empty()) return { 0, 0 };
		const auto at = [&samples](std::size_t rank) {
			std::nth_element(samples.begin(), samples.begin() + rank, samples.end());
			return samples[rank];
		};
		const std::size_t out = samples.size() / 128;
		const double      low = at(out), high = at(samples.size() - 1 - out), beyond = 0.5 * (high - low);
		return { std::max(extent.low, low - beyond), std::min(extent.high, high + beyond) };
	}

	/// Lower ends of some contacts. Places of the samples follow the golden section, so that no regular order of
	/// contacts falls in with them.
	void
	sample(const Coordinates& places, const std::vector<MovablePair>& pairs, const Way (&ways)[3],
	       std::vector<double> (&samples)[3])
	{
		for (auto& s : samples)
			s.clear();
		const std::size_t count = std::min(sampleCount, pairs.size());
		for (std::size_t k = 0; k < count; ++k) {
			const auto        part = std::uint64_t(std::uint32_t(k * 2654435769u)); // of 2³²
			const MovablePair pair = pairs[part * pairs.size() >> 32];
			const auto        low  = [&](const Way& way) {
                                const auto at = [&](std::int32_t b) {
                                        return MovablePair::moves(b) ? way.at(places, b) : HUGE_VAL;
                                };
                                return std::min(at(pair.i), at(pair.j));
			};
			if (!MovablePair::moves(pair.i) && !MovablePair::moves(pair.j)) continue;
			for (int axis = 0; axis < places.axes; ++axis)
				samples[axis].push_back(low(ways[axis]));
		}
	}

	/// Of a contact along an axis; 0 where only one of its bodies moves.
	double lengthOf(const Coordinates& places, const MovablePair& pair, int axis)
	{
		if (!MovablePair::moves(pair.i) || !MovablePair::moves(pair.j)) return 0;
		return std::abs(places(pair.i, axis) - places(pair.j, axis));
	}

	/// Length of the longest contact that strips have to be as wide as.
	double
	reachOf(const Coordinates& places, const Classification& classification, int threads, int axis, double extent)
	{
		const auto&  pairs   = classification.pairs;
		const long   count   = static_cast<long>(pairs.size());
		const double longest = classification.longest[axis];
		const double enough  = 0.5 * static_cast<double>(std::min(pairs.size() / contactsAStrip, fewStrips));
		std::vector<double> half; // longest/2, longest/4, … to where strips are enough
		for (double reach = longest; reach * enough > extent && half.size() < 32; half.push_back(reach))
			reach *= 0.5;
		if (half.empty()) return longest;
		std::vector<std::size_t> longer(
		        half.size() + 1, 0); // contacts longer than half[k] and not than the one before
		std::size_t* const inOctave = longer.data();
		const std::size_t  octaves  = half.size();
#pragma omp          parallel for schedule(static) num_threads(threads) reduction(+ : inOctave[:octaves + 1])
                for (long k = 0; k < count; ++k) {
			         const double length = lengthOf(places, pairs[k], axis);
			         std::size_t  o      = 0;
			         while (o < octaves && !(length > half[o]))
                                ++o;
                        ++inOctave[o];
                }
                double      reach = longest;
                std::size_t over  = 0;
                for (std::size_t o = 0; o < octaves && (over += longer[o]) * rareContacts <= pairs.size(); ++o)
                        reach = half[o];
                return reach;
	         }

	         /// Contacts by the bin of their lower end, without those that are longer than `width` bins.
	         void
	         count(const std::vector<MovablePair>& pairs, int threads, std::int32_t bins, std::int32_t width,
	               StripCut& result)
	         {
		         auto&      scratch  = result.scratch;
		         const long contacts = static_cast<long>(pairs.size());
		         scratch.counts.resize(std::max<std::size_t>(scratch.counts.size(), threads));
		         scratch.sums.assign(bins, 0);
         #pragma omp parallel num_threads(threads)
                {
			         auto& counts = scratch.counts[omp_get_thread_num()];
			         counts.assign(bins, 0);
#pragma omp for schedule(static)
                        for (long k = 0; k < contacts; ++k) {
				         const auto [i, j] = pairs[k];
				         const bool a = MovablePair::moves(i), b = MovablePair::moves(j);
				         if (!a && !b) continue;
                                const std::int32_t from = scratch.binOfBody[a ? i : j],
				                            to   = scratch.binOfBody[b ? j : i];
				         if (std::abs(from - to) <= width) ++counts[std::min(from, to)];
                        }
#pragma omp critical
			for (std::int32_t k = 0; k < bins; ++k)
				scratch.sums[k] += counts[k];
		}
	}

	/// Takes bin after bin to a strip until it has its share of contacts and is wide enough.
	void share(std::size_t strips, std::int32_t width, StripCut& result)
	{
		const auto& sums = result.scratch.sums;
		long        all  = 0;
		for (const std::int32_t n : sums)
			all += n;
		const double wanted = static_cast<double>(all) / static_cast<double>(strips);
		auto&        strip  = result.scratch.stripOfBin;
		std::size_t  begin  = 0; // of the strip that is being filled
		double       inside = 0, share = wanted;
		result.count = 1;
		strip.resize(sums.size());
		for (std::size_t k = 0; k < sums.size(); ++k) {
			strip[k] = result.count - 1;
			inside += sums[k];
			if (k + 1 == sums.size() || inside + 0.5 * sums[k + 1] < share
			    || k + 1 - begin < std::size_t(width))
				continue;
			++result.count;
			begin = k + 1;
			share = wanted
			        + std::clamp(
			                share - inside, -0.5 * wanted,
			                0.5 * wanted); // what one has too much the next one has less
			inside = 0;
		}
		if (result.count > 1 && inside < 0.5 * wanted) { // not worth a strip
			--result.count;
			std::fill(strip.begin() + begin, strip.end(), result.count - 1);
		}
	}

	/// Puts bodies into bins and bins into strips. Returns whether strips stayed as they were, as far as that is
	/// known without counting.
	bool divide(const Coordinates& places, const Classification& classification, int threads, StripCut& result)
	{
		auto&       scratch    = result.scratch;
		const auto& pairs      = classification.pairs;
		const auto  binsBefore = scratch.bins, widthBefore = scratch.width;
		scratch.bins = scratch.width = 0;
		if (places.count != classification.traits.size() || pairs.size() < 2 * contactsAStrip) return false;
		Way ways[3] = { { 0 }, { 1 }, { 2 } };
		for (int a = 0; a < places.axes; ++a)
			ways[a] = along(places, classification, a);
		sample(places, pairs, ways, scratch.samples);
		int  axis = 0;
		Span span = mostOf(scratch.samples[0], ways[0](classification.extents[0]));
		for (int a = 1; a < places.axes; ++a)
			if (const Span other = mostOf(scratch.samples[a], ways[a](classification.extents[a]));
			    other.length() > span.length()) {
				axis = a;
				span = other;
			}
		const Way    way    = ways[axis];
		const double extent = span.length();
		if (!(extent > 0) || !std::isfinite(extent)) return false;
		const std::size_t strips = pairs.size() / contactsAStrip;
		const auto        bins   = static_cast<std::int32_t>(strips * binsAStrip);
		const double      scale = bins / extent, reach = reachOf(places, classification, threads, axis, extent);
		scratch.bins  = bins;
		scratch.width = static_cast<std::int32_t>(
		        std::min<double>(bins, std::max(1.0, std::ceil(reach * rounding * scale))));
		const long bodies = static_cast<long>(places.count);
		bool       moved  = scratch.binOfBody.size() != places.count;
		scratch.binOfBody.resize(places.count);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : moved)
		for (long b = 0; b < bodies; ++b) {
			const double at = std::clamp(
			        (way.at(places, static_cast<std::int32_t>(b)) - span.low) * scale, 0.0, bins - 1.0);
			const auto bin       = classification.traits[b] & Classification::moves
			              ? static_cast<std::int32_t>(at)
			              : -1;
			moved                = moved || bin != scratch.binOfBody[b];
			scratch.binOfBody[b] = bin;
		}
		if (classification.pairsKept && !moved && bins == binsBefore && scratch.width == widthBefore)
			return true;
		count(pairs, threads, bins, scratch.width, result);
		share(strips, scratch.width, result);
		return false;
	}

} // namespace

bool cutIntoStrips(const Coordinates& places, const Classification& classification, int threads, StripCut& result)
{
	const auto before = result.count;
	if (divide(places, classification, threads, result)) return true;
	if (result.scratch.bins == 0) result.count = 1;
	const long bodies = static_cast<long>(classification.traits.size());
	bool       moved  = result.count != before || result.stripOfBody.size() != classification.traits.size();
	result.stripOfBody.resize(classification.traits.size());
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : moved)
	for (long b = 0; b < bodies; ++b) {
		const auto strip      = !(classification.traits[b] & Classification::moves)
		             ? -1
		             : (result.count == 1 ? 0 : result.scratch.stripOfBin[result.scratch.binOfBody[b]]);
		moved                 = moved || strip != result.stripOfBody[b];
		result.stripOfBody[b] = strip;
	}
	return !moved;
}

} // namespace nonsmooth::contact
