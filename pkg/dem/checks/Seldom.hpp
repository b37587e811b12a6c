// Warnings that may come every step: loud, but not once a step.
#pragma once

namespace yade::nscd {

/// Whether a count is 1, 10, 100, …: the times at which such a warning is given.
inline bool seldom(long count)
{
	long decade = 1;
	while (decade < count)
		decade *= 10;
	return decade == count;
}

} // namespace yade::nscd
