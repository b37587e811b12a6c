// Calls Python between two steps, at times that Python itself sets: what drives a course of stages in O.run(), in the
// viewer and in yade-batch.
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Scene.hpp>

namespace yade {

class CourseRunner : public GlobalEngine {
public:
	bool isActivated() override { return isDue(scene->time, scene->dt); }
	void action() override;
	/// Whether a time [s] has come, to half a step [s], as for ContactDynamicsEngine.advance.
	bool isDue(Real time, Real step) const { return !(time < nextTime - 0.5 * step); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(CourseRunner,GlobalEngine,
R"""(Runs a Python command at the beginning of the first step whose O.time is :yref:`nextTime<CourseRunner.nextTime>`, to half a step: the step before is over, so the
command finds the scene as between two steps, and may save it. The command sets the next time; what it raises ends the run. Place it first in O.engines;
:yref:`yade.nonsmooth.experiment` does.)""",
		((string,command,"",,"Python command, run in the namespace of __main__."))
		((Real,nextTime,0,,"Time of the next call [s]."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(CourseRunner);

} // namespace yade
