#include "PythonMade.hpp"
#include <atomic>
#include <mutex>
#include <vector>

namespace yade::nscd {

namespace {
	std::mutex                                 mutex;
	std::vector<boost::shared_ptr<const void>> kept;
	std::atomic<bool>                          any { false }; // most ask, and nothing is there
}

void keepUntilLocked(boost::shared_ptr<const void> object)
{
	const std::lock_guard<std::mutex> guard(mutex);
	kept.push_back(std::move(object));
	any = true;
}

void endKept()
{
	if (!any || !Py_IsInitialized() || !PyGILState_Check()) return;
	std::vector<boost::shared_ptr<const void>> ended;
	{
		const std::lock_guard<std::mutex> guard(mutex); // free when they end, since that may let others go
		ended.swap(kept);
		any = false;
	}
}

} // namespace yade::nscd
