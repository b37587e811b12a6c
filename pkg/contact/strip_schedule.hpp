// Which thread visits which strips of a sweep, in what order, and when it has to wait for another.
//
// All even strips come before all odd ones (sweep_order.hpp), but a strip meets its two neighbours only. So a worker takes a stretch of
// strips that lie side by side, visits an odd strip as soon as both its neighbours have been visited, while their bodies are still in the
// cache, and waits where its stretch ends alone. The bits are those of one thread that visits all even strips and then all odd ones.
//
// A stretch is a run of pairs (2p, 2p+1), with about as many contacts in each. Its last odd strip reaches into the first even strip of the next
// stretch, which gives two rules: that odd strip is visited after the neighbour's first even one of the same pass, and an even first strip
// after the last odd strip that the worker before visited in the pass before. A worker visits its first strip at the beginning of a pass and its
// last one in the middle, so each may be half a pass ahead of the other before it waits.
#pragma once

#include <atomic>
#include <cstddef>
#include <emmintrin.h>
#include <thread>
#include <vector>

namespace nonsmooth::contact {

class StripSchedule {
public:
	/// Cuts strips into stretches for at most `workers`. `begin`: of every strip's contacts, even strips first, one more than there are strips;
	/// `evenStrips`: how many of them are even. To be called by one thread.
	void plan(const std::vector<std::size_t>& begin, std::size_t evenStrips, int workers);

	/// One pass over all strips: calls visit(strip) for those of a worker. Every worker below workerCount() must make as many passes as the others;
	/// other threads do nothing. It does not wait for the others at its end.
	template <class Visit> void pass(int worker, Visit visit);

	/// Calls visit(strip) for the same strips, in any order with those of others.
	template <class Visit> void each(int worker, Visit visit) const;

	int workerCount() const { return static_cast<int>(stretches.size()); }

private:
	/// Places of the strips as SweepOrder has them: even strips first.
	struct Stretch {
		std::vector<std::size_t> visits;
		std::size_t              joint;   // how many of them come before the one that reaches into the next stretch
		bool                     reaches; // whether there is such a one
	};
	/// Passes in which a worker has visited its first strip, and the one that reaches into the next stretch; on a cache line of their own.
	struct alignas(64) Progress {
		std::atomic<long> begun { 0 }, joined { 0 };
		long              passes = 0; // of the worker itself
	};

	/// Spins, and lets others run where it takes long: there may be more threads than processors.
	static void await(const std::atomic<long>& count, long wanted)
	{
		for (int turns = 0; count.load(std::memory_order_acquire) < wanted; ++turns)
			if (turns < 4096) _mm_pause();
			else
				std::this_thread::yield();
	}

	std::vector<Stretch>  stretches;
	std::vector<Progress> progress;
};

template <class Visit> void StripSchedule::pass(int worker, Visit visit)
{
	if (worker >= workerCount()) return;
	const Stretch& own  = stretches[worker];
	Progress&      mine = progress[worker];
	const long     pass = mine.passes++;
	if (worker > 0) await(progress[worker - 1].joined, pass);
	for (std::size_t k = 0; k < own.visits.size(); ++k) {
		if (own.reaches && k == own.joint) await(progress[worker + 1].begun, pass + 1);
		visit(own.visits[k]);
		if (k == 0) mine.begun.store(pass + 1, std::memory_order_release);
		if (own.reaches && k == own.joint) mine.joined.store(pass + 1, std::memory_order_release);
	}
}

template <class Visit> void StripSchedule::each(int worker, Visit visit) const
{
	if (worker >= workerCount()) return;
	for (const std::size_t strip : stretches[worker].visits)
		visit(strip);
}

} // namespace nonsmooth::contact
