// When others who may look at any time are shown the objects: seldom enough to cost next to nothing.
#pragma once

#include "StageClock.hpp"
#include <algorithm>

namespace yade::nscd {

class LookClock {
public:
	/// Whether it is time: a look costs a fiftieth of the time then, with what is taken again afterwards, and less
	/// where the script said that nobody looks (`wanted` is false).
	bool isDue(bool wanted) const
	{
		const double least = wanted ? 0.05 : 1, share = wanted ? 50 : 200;
		return steadySeconds() - last > std::max(least, share * cost);
	}
	/// A look is over that began at `begin` [s].
	void look(double begin)
	{
		last = steadySeconds();
		cost = last - begin;
	}
	/// What it showed was taken again, from `begin` [s] on.
	void takeAgain(double begin) { cost += steadySeconds() - begin; }

private:
	double last = 0, cost = 0; // [s]
};

} // namespace yade::nscd
