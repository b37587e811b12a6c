#include "NonsmoothTimeStepper.hpp"
#include "../seam/EngineRoles.hpp"
#include "CourseRunner.hpp"
#include "ContactDynamicsEngine.hpp"
#include "../checks/Refusal.hpp"
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((NonsmoothTimeStepper));
[[maybe_unused]] static const bool nonsmoothTimeStepperRole = nscd::giveRole(
        typeid(NonsmoothTimeStepper), nscd::EngineRole::Blind);

void NonsmoothTimeStepper::validate() const
{
	const auto fail     = [](const string& why) { throw std::runtime_error("NonsmoothTimeStepper: " + why); };
	const auto positive = [&](const char* name, Real value) {
		if (!(value > 0) || !std::isfinite(value))
			fail(string(name) + " = " + nscd::number(value) + ": it must be positive");
	};
	positive("smallest", smallest);
	positive("path", path);
	positive("bondPath", bondPath);
	if (!(largest >= smallest) || !std::isfinite(largest))
		fail("largest = " + nscd::number(largest)
		     + ": it must not be below smallest = " + nscd::number(smallest));
	if (sweeps < 0) fail("sweeps = " + std::to_string(sweeps) + ": it must be 0 or more");
	if (!(growth >= 1)) fail("growth = " + nscd::number(growth) + ": it must be at least 1");
	// a CourseRunner looks at the step before
	const auto& all   = scene->engines;
	const auto  first = std::find_if(all.begin(), all.end(), [](const auto& e) {
                return !dynamic_cast<const CourseRunner*>(e.get());
        });
	if (first == all.end() || first->get() != this)
		fail("it must stand first in O.engines, since every engine after it works with the step it chooses");
}

void NonsmoothTimeStepper::action()
{
	validate();
	const ContactDynamicsEngine* solver = nullptr;
	for (const auto& engine : scene->engines)
		if (const auto* found = engine->dead ? nullptr
		                                     : dynamic_cast<const ContactDynamicsEngine*>(engine.get()))
			solver = found;
	if (!solver)
		throw std::runtime_error(
		        "NonsmoothTimeStepper: O.engines has no ContactDynamicsEngine: add one, or set O.dt yourself");

	// a step that was refused, or that an exception ended, is made again; only O.resetTime() lets a number come
	// again, and there the solver has been through
	const bool again = chosenIter == scene->iter && chosenTime == scene->time
	        && (scene->iter > 0 || solver->steps == chosenSteps);
	if (!again || scene->dt != chosen) before = scene->dt;
	chosenIter  = scene->iter;
	chosenTime  = scene->time;
	chosenSteps = solver->steps;

	Real       step  = largest;
	const auto bound = [&](Real most, Limit why) {
		if (most < step) {
			step  = most;
			limit = why;
		}
	};
	limit = Largest;
	if (solver->contactRate > 0) bound(path / solver->contactRate, Contacts);
	if (solver->bondRate > 0) bound(bondPath / solver->bondRate, Bonds);
	const bool busy = solver->lastUnsolved || (sweeps > 0 && solver->lastIterations > sweeps);
	bound(busy ? before : growth * before, busy ? Sweeps : Growth);
	if (step < smallest) {
		step  = smallest;
		limit = Smallest;
	}
	scene->dt = chosen = step;
}

} // namespace yade
