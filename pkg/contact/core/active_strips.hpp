// Which strips the next sweeps visit: those that hold what is left of the residual (Southwell's choice, strip by
// strip).
//
// In a packing that moves, nine tenths of the residual's square lie in a quarter of the strips, and which these are
// changes slowly. So at each look at the residual a strip s is active if its part r_s of the sum of squares has
//     r_s > η ⟨r⟩ ,     ⟨r⟩ the mean over all strips, η = 0.005 ;
// where impulses are solved and speeds are not (residual.hpp), r_s is its part of the sum of ϑ²; the others rest until
// the next look, and hold less than η of the whole together. Impulses of a strip that rests stay; its bodies move where
// a strip beside it is active, and its residual with them, which is looked at then. Where contacts are left over by the
// strips (sweep_order.hpp), none rests.
//
// Places are those of sweep_order.hpp: even strips first, then odd ones. The choice rests on sums of strips alone,
// which no number of threads changes.
#pragma once

#include <contact/core/residual.hpp>
#include <cstddef>
#include <vector>

namespace nonsmooth::contact {

class ActiveStrips {
public:
	/// All are active. `begin`, `evenStrips`: as SweepOrder::partBegin and SweepOrder::evenStrips.
	void reset(const std::vector<std::size_t>& begin, std::size_t evenStrips);
	/// Chooses by one of the sums of the parts, in the order of places; returns whether another choice stood
	/// before.
	bool choose(const std::vector<ResidualSums>& sums, double ResidualSums::*part = &ResidualSums::square);
	/// All are active again, and none has come to rest; returns as choose().
	bool wakeAll();

	bool isActive(std::size_t place) const { return place >= active.size() || active[place]; }
	/// Whether it was active until the last choice, and rests since.
	bool comesToRest(std::size_t place) const { return place < active.size() && resting[place]; }
	bool anyComesToRest() const { return anyRests; }
	/// Whether the bodies of an even strip and of the odd one after it may move: where contacts of either, or of
	/// the odd strip before, are active.
	bool moves(std::size_t even) const;
	/// Whether the residual of a strip may have changed: where it or a strip beside it is active.
	bool changes(std::size_t place) const;
	/// Contacts in active strips.
	std::size_t contacts() const { return count; }
	/// Where parts would begin if they were as large as what is to be done for them; for StripSchedule::plan().
	const std::vector<std::size_t>& work() const { return workBegin; }

private:
	void weigh();

	std::vector<std::size_t> begin, workBegin;
	std::vector<char>        active, resting; // by place
	std::size_t              evenStrips = 0, count = 0;
	bool                     anyRests = false;
};

} // namespace nonsmooth::contact
