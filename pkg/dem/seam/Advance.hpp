// Many steps from the caller's thread: ContactDynamicsEngine.advance.
#pragma once

#include <boost/python.hpp>
#include <core/Scene.hpp>

namespace yade::nscd {

/// See ContactDynamicsEngine.advance; `steps` and `until` may be None, `view` is True, False, or ids of bodies.
long advance(const boost::python::object& steps, const boost::python::object& until, const boost::python::object& view);

/// Steps that an advance() of this scene has yet to make, the present one included: 1 in the last, 0 where none is
/// under way. It looks at `until` with the present length of the step, so ask after NonsmoothTimeStepper. An exception
/// or a signal may end an advance() before.
long stepsLeft(const Scene& scene);

/// Says for as long as it lasts that a step of the scene has begun, though Scene::subStep does not: advance() is
/// refused then.
class StepHasBegun {
public:
	explicit StepHasBegun(const Scene& scene);
	~StepHasBegun();
	StepHasBegun(const StepHasBegun&)            = delete;
	StepHasBegun& operator=(const StepHasBegun&) = delete;

private:
	const Scene* const before;
};

/// Whether all contacts are to have an interaction where other threads look: not within an advance() that leaves them
/// out in the end.
bool interactionsWanted(const Scene& scene);

} // namespace yade::nscd
