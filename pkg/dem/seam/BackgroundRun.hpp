// What ends O.run()'s thread with an exception, so that nobody misses it.
#pragma once

namespace yade::nscd {

/// Has yade.nonsmooth.world.background watch O.run() and what belongs to it, in this process and from now on. Called
/// with Python's lock, once O's class is known.
void watchBackgroundRuns();

} // namespace yade::nscd
