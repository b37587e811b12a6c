// Who may look at YADE's objects before one of our own engines has its next turn.
//
// Nobody asks an engine ahead whether it will act: isActivated counts, and opens files. What is known of the engine is used instead, and where nothing is
// known it acts. A wrong "yes" costs time; a wrong "no" would show an old state, so where a prediction is not exact it is "yes".
#pragma once

#include <core/Engine.hpp>
#include <core/Scene.hpp>

namespace yade::nscd {

/// Who looks between the end of this engine's turn and the next turn of one of ours; empty: nobody.
string whoLooksAfter(const Scene& scene, const Engine& engine);

/// Whether steps are made while other threads of Python run.
bool othersMayLook(const Scene& scene);

/// Whether the engine's turns are ours: it takes what others have changed, and shows what it did.
bool takesTurns(const Engine& engine);

/// Whether an engine of YADE or of a user may act in a step; `iter` and `time` [s] are that step's.
bool mayAct(const Engine& engine, long iter, Real time);

} // namespace yade::nscd
