// The strip schedule with threads of the language, for ThreadSanitizer: it does not know OpenMP's barriers and would see races where there are none. Strips
// and what they share are plain numbers, so any visit that is not ordered with those of its neighbours is a race.
#include <contact/core/strip_schedule.hpp>
#include <cstdio>
#include <functional>
#include <thread>
#include <vector>

using nonsmooth::contact::StripSchedule;

namespace {

struct Case {
	std::size_t strips, leftOver;
	int         workers, passes;
};

/// A visit changes its own strip and the next one; what is left over changes strips anywhere.
void visit(std::vector<unsigned long>& values, std::size_t strips, std::size_t part, int pass)
{
	if (part == strips) {
		for (std::size_t k = 0; k < strips; k += 3)
			values[k] = values[k] * 2862933555777941757u + values[strips - 1 - k] + pass;
		return;
	}
	const std::size_t even = (strips + 1) / 2, s = part < even ? 2 * part : 2 * (part - even) + 1;
	values[s]     = values[s] * 6364136223846793005u + values[s + 1] + pass;
	values[s + 1] = values[s + 1] * 1442695040888963407u ^ values[s];
}

/// Values that as many passes leave, one after the other and at once.
std::vector<unsigned long> made(const Case& c, int workers)
{
	std::vector<std::size_t> begin;
	for (std::size_t s = 0; s <= c.strips; ++s)
		begin.push_back(100 * s);
	begin.push_back(begin.back() + c.leftOver);
	StripSchedule schedule;
	schedule.plan(begin, (c.strips + 1) / 2, workers);
	std::vector<unsigned long> values(c.strips + 1, 1);
	const auto                 work = [&](int worker) {
                for (int p = 0; p < c.passes; ++p)
                        schedule.pass(worker, [&](std::size_t part) { visit(values, c.strips, part, p); });
                for (const int count : { c.passes, 2, 2, c.passes, 2 }) // as solves begin and end
                        schedule.passes(worker, count, [&](std::size_t part, int p, const StripSchedule::Ahead&) {
                                visit(values, c.strips, part, p);
                        });
	};
	std::vector<std::thread> others;
	for (int w = 1; w < workers; ++w)
		others.emplace_back(work, w);
	work(0);
	for (std::thread& t : others)
		t.join();
	return values;
}

} // namespace

int main()
{
	int wrong = 0;
	for (const Case& c : { Case { 1, 0, 3, 50 },
	                       { 2, 0, 2, 50 },
	                       { 7, 0, 3, 50 },
	                       { 20, 0, 2, 50 },
	                       { 20, 4, 3, 50 },
	                       { 64, 0, 2, 30 },
	                       { 200, 0, 2, 30 },
	                       { 401, 0, 3, 30 },
	                       { 401, 5, 3, 30 } })
		if (made(c, c.workers) != made(c, 1)) {
			std::printf(
			        "%zu strips, %zu contacts left over, %d workers: not what one worker leaves\n",
			        c.strips, c.leftOver, c.workers);
			++wrong;
		}
	return wrong;
}
