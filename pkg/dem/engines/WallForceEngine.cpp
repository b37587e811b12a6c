#include "WallForceEngine.hpp"
#include "../seam/EngineRoles.hpp"
#include "Gravity.hpp"
#include "../checks/Refusal.hpp"

namespace yade {

YADE_PLUGIN((WallForceEngine));
[[maybe_unused]] static const bool wallForceEngineRole = nscd::giveRole(
        typeid(WallForceEngine), nscd::EngineRole::Blind);

void WallForceEngine::action()
{
	const auto fail = [](const string& why) { throw std::runtime_error("WallForceEngine: " + why); };
	if (along.size() != ids.size())
		fail(std::to_string(ids.size()) + " ids and " + std::to_string(along.size())
		     + " directions: give one along each piece");
	for (size_t k = 0; k < along.size(); ++k)
		if (!(std::abs(along[k].norm() - 1) <= 1e-6) || along[k][2] != 0)
			fail("along[" + std::to_string(k) + "] = (" + nscd::number(along[k][0]) + ", "
			     + nscd::number(along[k][1]) + ", " + nscd::number(along[k][2])
			     + "): give a unit vector in the x-y plane");
	if (period < 1) fail("period = " + std::to_string(period) + ": it must be at least 1");
	const auto& engines = scene->engines;
	const auto  before  = std::find_if(engines.begin(), engines.end(), [this](const auto& e) {
                return e.get() == this;
        });
	if (std::none_of(engines.begin(), before, [](const auto& e) {
		    return !e->dead && dynamic_cast<const NewtonIntegrator*>(e.get());
	    }))
		fail("it stands before the integrator in O.engines, where forces are not yet whole: put it behind");
	if ((scene->iter + 1) % period != 0) return;

	scene->forces.sync(); // a script may have added one since the integrator had its turn
	Real inwards = 0, onwards = 0;
	for (size_t k = 0; k < ids.size();) {
		const Vector3r& way = along[k];
		Real            x = 0, y = 0;
		for (; k < ids.size() && along[k] == way; ++k) {
			if (!scene->bodies->exists(ids[k]))
				fail("id " + std::to_string(ids[k])
				     + ": there is no such body; take an erased one out of ids and along");
			const Vector3r& force = scene->forces.getForce(ids[k]);
			x += force[0];
			y += force[1];
		}
		inwards += x * way[1] - y * way[0];
		onwards += x * way[0] + y * way[1];
	}
	if (seconds == 0 || inwards > peak) peak = inwards;
	const Real lasted = (scene->time + scene->dt) - scene->time; // as O.time tells it
	seconds += lasted;
	normal += inwards * lasted;
	shear += onwards * lasted;
}

boost::python::tuple WallForceEngine::take()
{
	if (seconds == 0) throw std::runtime_error("WallForceEngine: no step was counted since take() or forget()");
	const auto found = boost::python::make_tuple(normal / seconds, shear / seconds, peak);
	forget();
	return found;
}

} // namespace yade
