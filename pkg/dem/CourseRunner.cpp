#include "CourseRunner.hpp"
#include "Advance.hpp"
#include <core/Scene.hpp>
#include <lib/pyutil/gil.hpp>

namespace yade {

YADE_PLUGIN((CourseRunner));

void CourseRunner::action()
{
	const auto& engines = scene->engines;
	if (engines.empty() || engines.front().get() != this)
		throw std::runtime_error(
		        "CourseRunner: it is not the first of O.engines, where the step before is over: put it there");
	if (std::isnan(nextTime)) throw std::runtime_error("CourseRunner: nextTime = nan: give a time [s]");
	if (command.empty()) return;
	const nscd::StepHasBegun begun(*scene);
	// a scene that is saved now is one between two steps
	struct Between {
		Scene& scene;
		int    subStep;
		Between(Scene& s)
		        : scene(s)
		        , subStep(s.subStep)
		{
			scene.subStep = -1;
		}
		~Between() { scene.subStep = subStep; }
	} between(*scene);
	pyRunString(command);
}

} // namespace yade
