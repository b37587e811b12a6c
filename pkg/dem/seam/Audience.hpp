// Who may look at YADE's objects before one of our own engines has its next turn.
//
// Nobody asks an engine ahead whether it will act: isActivated counts, and opens files. What is known of the engine is
// used instead, and where nothing is known it acts. A wrong "yes" costs time; a wrong "no" would show an old state, so
// where a prediction is not exact it is "yes".
#pragma once

#include <core/Engine.hpp>
#include <core/Scene.hpp>

namespace yade::nscd {

struct Viewer {
	string name; // empty: nobody
	bool   isPython = false; // changes contacts by attributes and by O.interactions, or not at all
};

/// What somebody may look at: anything, or contacts.
enum class LooksAt { Anything, Contacts };

/// Who looks between the end of this engine's turn and the next turn of one of ours.
Viewer whoLooksAfter(const Scene& scene, const Engine& engine, LooksAt what = LooksAt::Anything);

/// Whether only Python, and nobody else's C++, can have had a turn since the last one of ours in this step, or since
/// the step began.
bool onlyPythonBefore(const Scene& scene, const Engine& engine);

/// Whether an engine has acted in this step that may have looked at objects, though none of our turns could know of it:
/// O.engines was changed since the last one.
bool isTooLate(const Scene& scene, const Engine& engine);

/// The engine that acts in the next step before one of ours has its turn, and may look at objects; null where none
/// does.
const Engine* whoLooksFirst(const Scene& scene, LooksAt what = LooksAt::Anything);

/// Whether steps are made while other threads of Python run.
bool othersMayLook(const Scene& scene);

/// Whether the engine's turns are ours: it takes what others have changed, and shows what it did.
bool takesTurns(const Engine& engine);

/// Whether an engine of YADE or of a user may act in a step; `iter`, `time` and the length `step` [s] are that step's.
/// Of an engine that has not acted yet Engine::scene is not known.
bool mayAct(const Engine& engine, long iter, Real time, Real step);

} // namespace yade::nscd
