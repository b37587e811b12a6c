#include "PlaneCheck.hpp"
#include "../engines/PorePressureEngine.hpp"
#include "Refusal.hpp"
#include "SceneCheck.hpp"
#include "../seam/ContactState.hpp"
#include <pkg/common/ForceEngine.hpp>
#include <pkg/common/TorqueEngine.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/UniaxialStrainer.hpp>

namespace yade::nscd {

namespace {
	string text(const Vector3r& v) { return "(" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + ")"; }

	/// Whether a part out of the plane is more than rounding beside one in it.
	bool matters(Real out, Real in) { return !(std::abs(out) <= flatness * in); }

	template <class List> bool has(const List& ids, Body::id_t id)
	{
		return std::find(ids.begin(), ids.end(), id) != ids.end();
	}

	/// Where a force or a torque out of the plane comes from, as far as that can be told.
	string source(Scene& scene, Body::id_t id)
	{
		for (const auto& engine : scene.engines) {
			if (engine->dead) continue;
			if (const auto* push = dynamic_cast<const ForceEngine*>(engine.get());
			    push && has(push->ids, id) && push->force[2] != 0)
				return named(*push) + " (force = " + text(push->force) + ")";
			if (const auto* turn = dynamic_cast<const TorqueEngine*>(engine.get());
			    turn && has(turn->ids, id) && (turn->moment[0] != 0 || turn->moment[1] != 0))
				return named(*turn) + " (moment = " + text(turn->moment) + ")";
			if (const auto* water = dynamic_cast<const PorePressureEngine*>(engine.get());
			    water && (water->pressureGradient[2] != 0 || water->planeNormal[2] != 0))
				return named(*water);
		}
		if (scene.forces.getPermForceUsed()) {
			const Vector3r &force = scene.forces.getPermForce(id), &torque = scene.forces.getPermTorque(id);
			if (force[2] != 0 || torque[0] != 0 || torque[1] != 0) return "O.forces.setPermF or setPermT";
		}
		return "an engine, or O.forces.addF or addT";
	}
}

void checkGravity(const Scene& scene, const Vector3r& gravity, const Vector3r& final)
{
	const auto leaves = [](const Vector3r& g) {
		return g[2] != 0 && matters(g[2], std::abs(g[0]) + std::abs(g[1]));
	};
	const auto remedy = [](const Vector3r& g) {
		const bool along = g[0] == 0 && g[1] == 0;
		return " points out of the x-y plane, in which disks move: give it components x and y alone, as "
		        + text(along ? Vector3r(0, g[2], 0) : Vector3r(g[0], g[1], 0))
		        + (along ? " in a scene whose heights are y (scripts with z up need z and y exchanged)" : "");
	};
	const auto check = [&](const Vector3r& g, const string& name) {
		if (!isNumber(g.cwiseAbs().maxCoeff()) || std::isnan(g.sum()))
			fail(name + " = " + text(g) + " m/s²: give finite components");
		if (leaves(g)) fail(name + " = " + text(g) + " m/s²" + remedy(g));
	};
	check(final, "finalGravity"); // first: the integrator's is a part of it
	for (const auto& engine : scene.engines)
		if (!engine->dead && dynamic_cast<const NewtonIntegrator*>(engine.get()))
			check(gravity, named(*engine) + ".gravity");
}

bool leavesPlane(const Vector3r& force, const Vector3r& torque, Real mass, Real inertia, const Vector3r& gravity)
{
	const Real within = std::abs(force[0]) + std::abs(force[1]) + mass * gravity.norm();
	const Real arm    = mass > 0 && inertia > 0 ? std::sqrt(inertia / mass) : 0; // radius of gyration
	return matters(force[2], within)
	        || matters(std::abs(torque[0]) + std::abs(torque[1]), std::abs(torque[2]) + arm * within);
}

void refuseForce(Scene& scene, Body::id_t id)
{
	const Vector3r &force = scene.forces.getForce(id), &torque = scene.forces.getTorque(id);
	const string    body = "body #" + std::to_string(id);
	if (force[2] != 0)
		fail(body + " has the force " + text(force) + " N, by " + source(scene, id)
		     + ", which points out of the x-y plane, in which the body moves: give forces components x and y alone");
	fail(body + " has the torque " + text(torque) + " N m, by " + source(scene, id)
	     + ", which would turn it out of the x-y plane: give torques a component z alone");
}

string whoFrees(const Scene& scene, Body::id_t id)
{
	for (const auto& engine : scene.engines)
		if (const auto* strainer = dynamic_cast<const UniaxialStrainer*>(engine.get());
		    strainer && !strainer->dead && (has(strainer->posIds, id) || has(strainer->negIds, id)))
			return ". " + named(*strainer)
			        + " has overwritten it: give that blockDisplacements=True and blockRotations=True, and put it after the integrator";
	return "";
}

} // namespace yade::nscd
