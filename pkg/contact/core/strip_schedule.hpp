// Which thread visits which strips of a sweep, in what order, and when it has to wait for another.
//
// All even strips come before all odd ones (sweep_order.hpp), but a strip meets its two neighbours only. So a worker
// takes a stretch of strips that lie side by side, visits an odd strip as soon as both its neighbours have been
// visited, while their bodies are still in the cache, and waits where its stretch ends alone. The bits are those of one
// thread that visits all even strips and then all odd ones.
//
// A stretch is a run of pairs (2p, 2p+1), with about as many contacts in each. Its last odd strip reaches into the
// first even strip of the next stretch, which gives two rules: that odd strip is visited after the neighbour's first
// even one of the same pass, and an even first strip after the last odd strip that the worker before visited in the
// pass before. A worker visits its first strip at the beginning of a pass and its last one in the middle, so each may
// be half a pass ahead of the other before it waits.
//
// What strips leave over (sweep_order.hpp) is the first worker's, after all strips of a pass and before those of the
// next: everybody waits.
//
// Several passes at once: a strip's next visit has to wait for the strips beside it alone. Where a stretch is long, a
// worker therefore makes a few passes together, each two strips behind the one before (a wavefront), so that what the
// first fetches from memory is in the cache for all of them. Strips near the end of a stretch cannot be visited that
// way without the neighbour's next passes, so every pass stops a pair of strips short of the one before it, at both
// ends. That leaves a triangle across each end, which the worker before it visits last:
//
//     pass 3          o o o o o o - - - - - - o o o o       o: wavefronts of the two workers
//     pass 2      o o o o o o o o - - - - o o o o o o       -: the triangle between them
//     pass 1    o o o o o o o o o o - - o o o o o o o o
//
// Where something is left over, passes come one after the other.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace nonsmooth::contact {

class StripSchedule {
public:
	/// Cuts strips into stretches for at most `workers`. `begin`: as SweepOrder::partBegin, even strips first, then
	/// odd ones, then what is left over; `evenStrips`: how many are even. To be called by one thread.
	void plan(const std::vector<std::size_t>& begin, std::size_t evenStrips, int workers);

	/// One pass over all parts: calls visit(part) for those of a worker. Every worker below workerCount() must make
	/// as many passes as the others; other threads do nothing. It does not wait for the others at its end.
	template <class Visit> void pass(int worker, Visit visit);

	/// One of `parts` equal parts of a strip that the first of several passes visits soon, and that is likely not
	/// in the cache yet: the visits before it may each fetch one. None where `parts` is 0.
	struct Ahead {
		std::size_t strip = 0;
		int         part = 0, parts = 0;
	};

	/// As many passes: calls visit(part, pass, ahead) with passes counted from 0, several at once where stretches
	/// are long enough.
	template <class Visit> void passes(int worker, int count, Visit visit);

	/// Calls visit(part) for the same parts, in any order with those of others.
	template <class Visit> void each(int worker, Visit visit) const;

	int workerCount() const { return static_cast<int>(stretches.size()); }

private:
	/// Places of the strips as SweepOrder has them: even strips first.
	struct Stretch {
		std::size_t              first, end; // pairs
		std::vector<std::size_t> visits;
		std::size_t joint; // how many of them come before the one that reaches into the next stretch
		bool        reaches; // whether there is such a one
	};
	/// Passes in which a worker has visited its first strip, the one that reaches into the next stretch, and all,
	/// of the first worker with what is left over; on a cache line of their own.
	struct alignas(64) Progress {
		std::atomic<long> begun { 0 }, joined { 0 }, ended { 0 };
		long              passes = 0; // of the worker itself
	};

	/// Tells the processor that this thread only waits, where it can be told.
	static void relax()
	{
#if defined(__x86_64__) || defined(__i386__)
		__builtin_ia32_pause();
#elif defined(__aarch64__)
		asm volatile("yield");
#endif
	}

	/// Spins, and lets others run where it takes long: there may be more threads than processors.
	static void await(const std::atomic<long>& count, long wanted)
	{
		for (int turns = 0; count.load(std::memory_order_acquire) < wanted; ++turns)
			if (turns < 4096) relax();
			else
				std::this_thread::yield();
	}

	template <class Visit> void together(int worker, int first, int count, Visit visit);

	std::size_t           strips = 0, pairs = 0;
	bool                  leftOver = false;
	int                   depth    = 1; // passes to be made at once
	std::vector<Stretch>  stretches;
	std::vector<Progress> progress;
};

template <class Visit> void StripSchedule::pass(int worker, Visit visit)
{
	if (worker >= workerCount()) return;
	const Stretch& own  = stretches[worker];
	Progress&      mine = progress[worker];
	const long     pass = mine.passes++;
	if (leftOver) await(progress.front().ended, pass);
	else if (worker > 0)
		await(progress[worker - 1].joined, pass);
	for (std::size_t k = 0; k < own.visits.size(); ++k) {
		if (own.reaches && k == own.joint) await(progress[worker + 1].begun, pass + 1);
		visit(own.visits[k]);
		if (k == 0) mine.begun.store(pass + 1, std::memory_order_release);
		if (own.reaches && k == own.joint) mine.joined.store(pass + 1, std::memory_order_release);
	}
	if (!leftOver) return;
	if (worker == 0) {
		for (std::size_t other = 1; other < progress.size(); ++other)
			await(progress[other].ended, pass + 1);
		visit(strips);
	}
	mine.ended.store(pass + 1, std::memory_order_release);
}

template <class Visit> void StripSchedule::passes(int worker, int count, Visit visit)
{
	// a few of many do not pay for the unequal shares that their triangles make
	constexpr int shallowest = 4;
	const int     step       = depth >= std::min(count, shallowest) ? depth : 1;
	for (int k = 0; k < count; k += step)
		if (step > 1) together(worker, k, std::min(step, count - k), visit);
		else
			pass(worker, [&](std::size_t strip) { visit(strip, k, Ahead {}); });
}

/// Passes first … first + count − 1 at once.
template <class Visit> void StripSchedule::together(int worker, int first, int count, Visit visit)
{
	if (worker >= workerCount()) return;
	const Stretch& own  = stretches[worker];
	Progress&      mine = progress[worker];
	const long     turn = mine.passes++, begin = own.first, end = own.end;
	const auto     odd = [&](long pair, int k, const Ahead& ahead = {}) {
                if (pairs + pair < strips) visit(pairs + pair, first + k, ahead);
	};
	// where there is no neighbour, nothing is left out
	const auto from = [&](long k) { return worker > 0 ? begin + k : begin; };
	const auto to   = [&](long k) { return own.reaches ? end - k : end; };
	if (worker > 0) await(progress[worker - 1].joined, turn);
	for (long front = begin; front < end + count; ++front) {
		for (int k = 0; k < count; ++k) {
			const long pair = front - k;
			// what the first pass visits when the front has moved on
			const int   parts = front + 1 < end ? count : 0;
			const Ahead even { static_cast<std::size_t>(front + 1), k, parts },
			        uneven { pairs + front, k, parts };
			if (pair >= from(k) && pair < to(k)) visit(pair, first + k, even);
			if (pair > from(k) && (pair < to(k) || (!own.reaches && pair == end))) odd(pair - 1, k, uneven);
		}
		// the neighbour's triangle reaches as far as the last pass's first pair
		if (front == begin + 2 * (count - 1)) mine.begun.store(turn + 1, std::memory_order_release);
	}
	if (!own.reaches) return;
	await(progress[worker + 1].begun, turn + 1);
	for (int k = 0; k < count; ++k) {
		for (long pair = end - k; pair < end + k; ++pair)
			visit(pair, first + k, Ahead {});
		for (long pair = end - k - 1; pair < end + k; ++pair)
			odd(pair, k);
	}
	mine.joined.store(turn + 1, std::memory_order_release);
}

template <class Visit> void StripSchedule::each(int worker, Visit visit) const
{
	if (worker >= workerCount()) return;
	for (const std::size_t strip : stretches[worker].visits)
		visit(strip);
	if (leftOver && worker == 0) visit(strips);
}

} // namespace nonsmooth::contact
