// Whether a body is the one that was noted: ids are used again, and what was kept of one body must not be taken for
// another's.
#pragma once

#include <core/Body.hpp>

namespace yade::nscd {

/// Whether what was noted is this object, which may be gone meanwhile. It is not held: what Python has made may end
/// under Python's lock alone.
template <class Object> bool isSame(const boost::weak_ptr<Object>& noted, const boost::shared_ptr<Object>& now)
{
	return !noted.owner_before(now) && !now.owner_before(noted);
}

} // namespace yade::nscd
