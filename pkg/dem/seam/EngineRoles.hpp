// What engines of ours do with bodies and contacts in their turns, told by the engines themselves: who looks at YADE's
// objects (Audience.hpp) rests on it.
#pragma once

#include <core/Engine.hpp>
#include <typeinfo>

namespace yade::nscd {

enum class EngineRole {
	Stranger, // of YADE or of a user: may look at everything, and change it
	TakesTurns, // takes what others have changed, and shows what it did (seam/Resident.hpp)
	Blind, // reads and writes neither bodies nor interactions
	MovesBodies, // looks at bodies, and neither reads nor writes what a contact has
	Runner, // runs Python
};

/// Whether an engine acts in a step that begins at `time` [s] and is `step` [s] long.
using ActsIn = bool (*)(const Engine& engine, Real time, Real step);

/// Notes the role of a class, and not of those derived from it, for which nobody can tell; to be called where its file
/// is loaded. Without `acts` it always does.
bool giveRole(const std::type_info& engineClass, EngineRole role, ActsIn acts = nullptr);

EngineRole roleOf(const Engine& engine);

/// As the class has said when it got its role; null where it has said nothing.
ActsIn actsOf(const Engine& engine);

} // namespace yade::nscd
