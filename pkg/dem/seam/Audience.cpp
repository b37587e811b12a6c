#include "Audience.hpp"
#include "Advance.hpp"
#include "../checks/SceneCheck.hpp"
#include "EngineRoles.hpp"
#include <core/Omega.hpp>
#include <pkg/common/ForceResetter.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/PyRunner.hpp>
#include <pkg/common/Recorder.hpp>
#include <set>

namespace yade::nscd {

namespace {
	template <class... Classes> bool isOneOf(const Engine& engine)
	{
		return ((typeid(engine) == typeid(Classes)) || ...);
	}

	/// Reads and writes neither bodies nor interactions. Of these classes themselves, since a derived one may.
	bool isBlind(const Engine& engine)
	{
		return isOneOf<ForceResetter>(engine) || roleOf(engine) == EngineRole::Blind;
	}

	/// Runs Python, or writes files. But for what says itself when it acts its isActivated is PeriodicEngine's, or
	/// Recorder's, which asks that one.
	bool isRunnerOrRecorder(const Engine& engine)
	{
		return isOneOf<PyRunner>(engine) || roleOf(engine) == EngineRole::Runner
		        || dynamic_cast<const Recorder*>(&engine) || engine.getClassName() == "VTKRecorder"
		        || engine.getClassName() == "SnapshotEngine" || engine.getClassName() == "DomainLimiter";
	}

	/// Moves bodies, or makes interactions for pairs that come near each other, and neither reads nor writes what a
	/// contact has. Of these classes themselves.
	bool isBlindToContacts(const Engine& engine)
	{
		static const std::set<string> ofYade { "InsertionSortCollider",
			                               "NewtonIntegrator",
			                               "RotationEngine",
			                               "TranslationEngine",
			                               "HelixEngine",
			                               "InterpolatingHelixEngine",
			                               "HarmonicMotionEngine",
			                               "HarmonicRotationEngine",
			                               "CombinedKinematicEngine",
			                               "ServoPIDController",
			                               "ForceEngine",
			                               "TorqueEngine" };
		return roleOf(engine) == EngineRole::MovesBodies || ofYade.count(engine.getClassName()) > 0;
	}

	/// An engine's place in the list; the end where it has none, outside a step since somebody called it by hand,
	/// and in sub-steps since somebody looks after each.
	auto placeOf(const Scene& scene, const Engine& engine)
	{
		const auto& all = scene.engines;
		if (scene.subStepping || scene.subStep < 0) return all.end();
		return std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.get() == &engine; });
	}

	/// Why nobody of ours comes next after the step, where that is so.
	string whyTheStepIsTheLast(const Scene& scene)
	{
		if (!scene._nextEngines.empty()) return "other engines";
		if (stepsLeft(scene) > 0) return ""; // advance() shows all when it ends, however it ends
		if (!Omega::instance().isRunning() || scene.stopAtIter == scene.iter + 1
		    || (scene.stopAtTime > 0 && scene.time + scene.dt >= scene.stopAtTime))
			return "the end of the run";
		return "";
	}
}

bool othersMayLook(const Scene& scene) { return Omega::instance().isRunning() || stepsLeft(scene) > 0; }

bool takesTurns(const Engine& engine) { return roleOf(engine) == EngineRole::TakesTurns; }

bool mayAct(const Engine& engine, long iter, Real time, Real step)
{
	if (isBlind(engine)) return false;
	if (const ActsIn acts = actsOf(engine)) return acts(engine, time, step);
	const auto* periodic = isRunnerOrRecorder(engine) ? dynamic_cast<const PeriodicEngine*>(&engine) : nullptr;
	if (!periodic) return true;
	const PeriodicEngine& p = *periodic;
	if (p.nDone == 0 && p.firstIterRun > 0) return iter == p.firstIterRun;
	if (p.nDone == 0 || iter < p.iterLast) return true; // it may run at once
	if (p.nDo >= 0 && p.nDone >= p.nDo) return false;
	constexpr Real sure = 0.2; // s; until it is asked
	return (p.virtPeriod > 0 && time - p.virtLast >= p.virtPeriod * (1 - 1e-9))
	        || (p.realPeriod > 0 && PeriodicEngine::getClock() - p.realLast >= p.realPeriod - sure)
	        || (p.iterPeriod > 0 && iter - p.iterLast >= p.iterPeriod);
}

bool onlyPythonBefore(const Scene& scene, const Engine& engine)
{
	const auto& all  = scene.engines;
	auto        here = placeOf(scene, engine);
	if (here == all.end()) return false;
	while (here != all.begin()) {
		const Engine& before = **--here;
		if (takesTurns(before)) return true;
		if (!isBlind(before) && !isRunnerOrRecorder(before)) return false;
	}
	return true;
}

bool isTooLate(const Scene& scene, const Engine& engine)
{
	const auto& all  = scene.engines;
	auto        here = placeOf(scene, engine);
	while (here != all.end() && here != all.begin()) {
		const Engine& before = **--here;
		if (before.dead) continue;
		if (takesTurns(before)) return false;
		// of others it cannot be told afterwards whether they have acted
		if (!isBlind(before) && !dynamic_cast<const PeriodicEngine*>(&before) && !actsOf(before)) return true;
	}
	return false;
}

const Engine* whoLooksFirst(const Scene& scene, LooksAt what)
{
	for (const auto& engine : scene._nextEngines.empty() ? scene.engines : scene._nextEngines) {
		if (engine->dead) continue;
		if (takesTurns(*engine)) return nullptr;
		if (what == LooksAt::Contacts && isBlindToContacts(*engine)) continue;
		if (mayAct(*engine, scene.iter, scene.time, scene.dt)) return engine.get();
	}
	return nullptr;
}

Viewer whoLooksAfter(const Scene& scene, const Engine& engine, LooksAt what)
{
	const auto& all  = scene.engines;
	const auto  here = placeOf(scene, engine);
	if (here == all.end()) return { "whoever called " + named(engine), false };
	Viewer     found;
	const auto passes = [&](const Engine& e, long iter, Real time) {
		if (e.dead) return false;
		if (takesTurns(e)) return true;
		if (what == LooksAt::Contacts && isBlindToContacts(e)) return false;
		if (!mayAct(e, iter, time, scene.dt)) return false;
		found.isPython = isRunnerOrRecorder(e) && (found.name.empty() || found.isPython);
		if (found.name.empty()) found.name = named(e);
		return false;
	};
	for (auto next = here + 1; next != all.end(); ++next)
		if (passes(**next, scene.iter, scene.time)) return found;
	if (const string why = whyTheStepIsTheLast(scene); !why.empty()) {
		found.isPython = scene._nextEngines.empty() && (found.name.empty() || found.isPython);
		if (found.name.empty()) found.name = why;
	}
	for (auto next = all.begin(); next != here + 1; ++next)
		if (passes(**next, scene.iter + 1, scene.time + scene.dt)) return found;
	return found;
}

} // namespace yade::nscd
