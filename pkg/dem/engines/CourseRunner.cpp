#include "CourseRunner.hpp"
#include "../seam/EngineRoles.hpp"
#include "../seam/Advance.hpp"
#include <core/Scene.hpp>
#include <lib/pyutil/gil.hpp>

namespace yade {

YADE_PLUGIN((CourseRunner));
[[maybe_unused]] static const bool courseRunnerRole = nscd::giveRole(
        typeid(CourseRunner), nscd::EngineRole::Runner, [](const Engine& engine, Real time, Real step) {
	        return static_cast<const CourseRunner&>(engine).isDue(time, step);
        });

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
