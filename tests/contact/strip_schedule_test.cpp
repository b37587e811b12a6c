// Workers that visit side by side must leave what one pass over all even and then all odd strips leaves.
#include <algorithm>
#include <contact/core/strip_schedule.hpp>
#include <gtest/gtest.h>
#include <omp.h>

using namespace nonsmooth::contact;

namespace {

/// Where strips of these sizes begin, and what is left over.
std::vector<std::size_t> beginsOf(const std::vector<std::size_t>& sizes, std::size_t leftOver = 0)
{
	std::vector<std::size_t> begin(1, 0);
	for (const std::size_t size : sizes)
		begin.push_back(begin.back() + size);
	begin.push_back(begin.back() + leftOver);
	return begin;
}

/// Of a place: the strip's number from one end of the packing to the other.
std::size_t strip(std::size_t place, std::size_t evenStrips)
{
	return place < evenStrips ? 2 * place : 2 * (place - evenStrips) + 1;
}

/// A visit mixes a strip's value with its neighbours', so that what comes out tells in what order neighbours were visited.
class Mixer {
public:
	explicit Mixer(std::size_t strips)
	        : values(strips + 2, 1)
	        , even((strips + 1) / 2)
	{
	}
	void visit(std::size_t place, int pass = 0)
	{
		if (place + 2 == values.size()) { // what is left over meets strips anywhere
			for (std::size_t k = 1; k < values.size(); k += 5)
				values[k] = values[k] * 2862933555777941757u + values[values.size() - 1 - k] + pass;
			return;
		}
		const std::size_t s = strip(place, even) + 1;
		values[s] += pass;
		// changes its own and the next strip's value, as a contact does that reaches into the next strip
		values[s]     = values[s] * 6364136223846793005u + values[s + 1];
		values[s + 1] = values[s + 1] * 1442695040888963407u ^ values[s];
	}
	std::vector<unsigned long> values;
	std::size_t                even;
};

/// Expects that workers leave the values of `plain` where each of them calls make(schedule, worker, mixer).
template <class Make>
void expectSame(const Mixer& plain, std::size_t strips, std::size_t leftOver, int workers, Make make)
{
	Mixer         mixer(strips);
	StripSchedule schedule;
	int           made = 0;
#pragma omp parallel num_threads(workers)
	{
#pragma omp single
		{
			made = omp_get_num_threads();
			schedule.plan(beginsOf(std::vector<std::size_t>(strips, 100), leftOver), mixer.even, made);
		}
		make(schedule, omp_get_thread_num(), mixer);
	}
	EXPECT_EQ(mixer.values, plain.values) << strips << " strips, " << made << " workers";
}

}

TEST(StripSchedule, GivesEveryStripToOneWorkerEvenNeighboursFirst)
{
	for (std::size_t strips : { 1, 2, 3, 4, 5, 7, 8, 21, 80 })
		for (int workers : { 1, 2, 3, 5, 16 }) {
			const std::size_t even = (strips + 1) / 2;
			StripSchedule     schedule;
			schedule.plan(beginsOf(std::vector<std::size_t>(strips, 100)), even, workers);
			EXPECT_EQ(schedule.workerCount(), std::min<int>(workers, even));
			std::vector<int> seen(strips, 0);
			for (int w = 0; w < schedule.workerCount(); ++w)
				schedule.each(w, [&](std::size_t place) { ++seen[place]; });
			EXPECT_EQ(seen, std::vector<int>(strips, 1)) << strips << " strips, " << workers << " workers";
		}
}

TEST(StripSchedule, GivesWhatIsLeftOverToOneWorker)
{
	for (int workers : { 1, 2, 5 }) {
		StripSchedule schedule;
		schedule.plan(beginsOf(std::vector<std::size_t>(21, 100), 3), 11, workers);
		std::vector<int> seen(22, 0);
		for (int w = 0; w < schedule.workerCount(); ++w)
			schedule.each(w, [&](std::size_t part) { ++seen[part]; });
		EXPECT_EQ(seen, std::vector<int>(22, 1)) << workers << " workers";
	}
}

TEST(StripSchedule, SharesTheWorkEvenly)
{
	std::vector<std::size_t> sizes(80, 100);
	for (std::size_t k = 0; k < 10; ++k)
		sizes[k] = sizes[40 + k] = 500; // one end of the packing is thicker
	const auto    begin = beginsOf(sizes);
	StripSchedule schedule;
	schedule.plan(begin, 40, 2);
	std::size_t of[2] = { 0, 0 };
	for (int w = 0; w < 2; ++w)
		schedule.each(w, [&](std::size_t place) { of[w] += sizes[place]; });
	EXPECT_EQ(of[0], 8000u);
	EXPECT_EQ(of[1], 8000u);
}

TEST(StripSchedule, AnyNumberOfWorkersLeavesWhatOneLeaves)
{
	constexpr int passes = 60;
	for (const auto& [strips, leftOver] : std::vector<std::pair<std::size_t, std::size_t>> { { 1, 0 },
	                                                                                         { 2, 0 },
	                                                                                         { 3, 0 },
	                                                                                         { 4, 0 },
	                                                                                         { 6, 0 },
	                                                                                         { 7, 0 },
	                                                                                         { 20, 0 },
	                                                                                         { 81, 0 },
	                                                                                         { 3, 1 },
	                                                                                         { 4, 9 },
	                                                                                         { 20, 5 },
	                                                                                         { 81, 5 } }) {
		Mixer plain(strips);
		for (int p = 0; p < passes; ++p)
			for (std::size_t place = 0; place < strips + (leftOver > 0);
			     ++place) // even strips, odd ones, what is left over
				plain.visit(place);
		for (int workers : { 1, 2, 3, 4, 7 })
			expectSame(
			        plain, strips, leftOver, workers,
			        [](StripSchedule& schedule, int worker, Mixer& mixer) {
				        for (int p = 0; p < passes; ++p)
					        schedule.pass(worker, [&](std::size_t place) { mixer.visit(place); });
			        });
	}
}

// one worker has 8 pairs for each of 10 passes at 160 strips, and no room for a wavefront of 4 below 64
TEST(StripSchedule, PassesAtOnceLeaveWhatOneAfterTheOtherLeaves)
{
	for (const auto& [strips, leftOver] : std::vector<std::pair<std::size_t, std::size_t>> {
	             { 5, 0 }, { 63, 0 }, { 64, 0 }, { 65, 0 }, { 161, 0 }, { 400, 0 }, { 401, 0 }, { 401, 7 } })
		for (int passes : { 1, 3, 10, 34 }) {
			SCOPED_TRACE(std::to_string(passes) + " passes");
			Mixer plain(strips);
			for (int p = 0; p < passes; ++p)
				for (std::size_t place = 0; place < strips + (leftOver > 0); ++place)
					plain.visit(place, p);
			for (int workers : { 1, 2, 3, 5 })
				expectSame(
				        plain, strips, leftOver, workers,
				        [passes](StripSchedule& schedule, int worker, Mixer& mixer) {
					        schedule.passes(
					                worker, passes,
					                [&](std::size_t place, int p, const StripSchedule::Ahead&) {
						                mixer.visit(place, p);
					                });
				        });
		}
}

// A solve begins and ends with two passes, and has some more between: those at once wait for those one after the other, and these for those. A stretch has room
// for two at once from 16 pairs on, for four from 32.
TEST(StripSchedule, AnyNumberOfWorkersLeavesWhatOneLeavesInTwoPasses)
{
	const std::vector<int> counts = { 2, 11, 3, 2, 2, 1, 2 };
	for (const auto& [strips, leftOver] : std::vector<std::pair<std::size_t, std::size_t>> { { 1, 0 },
	                                                                                         { 2, 0 },
	                                                                                         { 3, 0 },
	                                                                                         { 5, 0 },
	                                                                                         { 31, 0 },
	                                                                                         { 32, 0 },
	                                                                                         { 33, 0 },
	                                                                                         { 64, 0 },
	                                                                                         { 97, 0 },
	                                                                                         { 161, 0 },
	                                                                                         { 33, 4 },
	                                                                                         { 161, 4 } }) {
		Mixer plain(strips);
		for (const int count : counts)
			for (int p = 0; p < count; ++p)
				for (std::size_t place = 0; place < strips + (leftOver > 0); ++place)
					plain.visit(place, p);
		for (int workers : { 1, 2, 3, 7 })
			expectSame(
			        plain, strips, leftOver, workers,
			        [&counts](StripSchedule& schedule, int worker, Mixer& mixer) {
				        for (const int count : counts)
					        schedule.passes(
					                worker, count,
					                [&](std::size_t place, int p, const StripSchedule::Ahead&) {
						                mixer.visit(place, p);
					                });
			        });
	}
}

// two or three passes need no room for more; a few of many are not made at once
TEST(StripSchedule, FewPassesAreAtOnceWhereThereIsRoomForThem)
{
	struct Case {
		std::size_t pairs;
		int         passes;
		long longest; // visits from one of a strip to the next: a pair of strips for each pass at once and one more, or all strips
	};
	for (const Case& c : { Case { 15, 2, 30 },
	                       { 16, 2, 6 },
	                       { 23, 3, 46 },
	                       { 24, 3, 8 },
	                       { 31, 4, 62 },
	                       { 32, 4, 10 },
	                       { 31, 10, 62 } }) {
		StripSchedule schedule;
		schedule.plan(beginsOf(std::vector<std::size_t>(2 * c.pairs, 100)), c.pairs, 1);
		std::vector<long> last(2 * c.pairs, -1);
		long              visits = 0, longest = 0;
		schedule.passes(0, c.passes, [&](std::size_t place, int, const StripSchedule::Ahead&) {
			if (last[place] >= 0) longest = std::max(longest, visits - last[place]);
			last[place] = visits++;
		});
		EXPECT_EQ(visits, c.passes * 2 * long(c.pairs));
		EXPECT_EQ(longest, c.longest) << c.pairs << " pairs, " << c.passes << " passes";
	}
}

// the reason for it: between two visits of a strip lie few others, not all
TEST(StripSchedule, PassesAtOnceComeBackToAStripSoon)
{
	constexpr std::size_t strips = 1000;
	StripSchedule         schedule;
	schedule.plan(beginsOf(std::vector<std::size_t>(strips, 100)), strips / 2, 1);
	std::vector<long> last(strips, -1);
	long              visits = 0, longest = 0;
	schedule.passes(0, 10, [&](std::size_t place, int, const StripSchedule::Ahead&) {
		if (last[place] >= 0) longest = std::max(longest, visits - last[place]);
		last[place] = visits++;
	});
	EXPECT_EQ(visits, 10 * long(strips));
	EXPECT_EQ(
	        longest,
	        22); // a pair of strips for each of ten passes, and one more, as the next pass comes a place later
}

// so that the first pass does not wait for memory: a strip is announced in parts, each once, shortly before its first visit
TEST(StripSchedule, PassesAtOnceSayWhatTheFirstOneVisitsNext)
{
	constexpr int strips = 1000, passes = 10, all = (1 << passes) - 1;
	StripSchedule schedule;
	schedule.plan(beginsOf(std::vector<std::size_t>(strips, 100)), strips / 2, 1);
	std::vector<int>  announced(strips, 0); // a bit for each part
	std::vector<long> last(strips, 0);
	int               whole  = 0;
	long              visits = 0, longest = 0;
	schedule.passes(0, passes, [&](std::size_t place, int pass, const StripSchedule::Ahead& ahead) {
		if (pass == 0 && announced[place] == all) {
			++whole;
			longest = std::max(longest, visits - last[place]);
		}
		if (ahead.parts > 0) {
			EXPECT_EQ(ahead.parts, passes);
			EXPECT_EQ(announced[ahead.strip] & 1 << ahead.part, 0)
			        << "strip " << ahead.strip << ", part " << ahead.part;
			announced[ahead.strip] |= 1 << ahead.part;
			last[ahead.strip] = visits;
		}
		++visits;
	});
	EXPECT_EQ(
	        whole,
	        strips - 2 * passes - 1); // not those before which some passes have not begun, and not the very last
	EXPECT_EQ(longest, 2); // visits since its last part
}

TEST(StripSchedule, KeepsNothingOfAnEarlierPlan)
{
	StripSchedule schedule;
	schedule.plan(beginsOf({ 10, 10, 10, 10 }), 2, 2);
	schedule.plan(beginsOf({}), 0, 2);
	EXPECT_EQ(schedule.workerCount(), 0);
	schedule.pass(0, [](std::size_t) { FAIL() << "there is no strip"; });
}
