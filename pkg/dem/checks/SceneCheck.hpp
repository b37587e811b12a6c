// Scenes that would run and be wrong in silence: what ContactDynamicsEngine refuses before a step, besides its own
// settings.
//
// All of this is looked at in every step, since a script may change anything between two: the list of engines, the
// shapes of the bodies that are no disks, the numbers of each contact. None of it costs a thousandth of a step.
#pragma once

#include "../seam/BodyState.hpp"
#include "../seam/ContactState.hpp"

namespace yade::nscd {

/// An engine's class and label, for messages.
string named(const Engine& engine);

/// Refuses lists of engines that leave out, double or disturb the solver's work. Throws std::runtime_error that names
/// the engine and what would do.
void checkEngines(const Scene& scene, const Engine& solver);

/// Refuses, for the engine `who`, what must be refused before the solver has its turn: engines of YADE's that could end
/// the process, as DomainLimiter and those that steer by the stiffness of contacts or by a periodic cell; engines that
/// read forces before there are any; scripts that were converted by halves. Throws std::runtime_error.
void refuseEarly(const Scene& scene, const char* who);

/// What to say of a loop that makes rigid contacts and gives them to a law of springs, which finds no force for them,
/// or the other way round; empty where there is none.
string halfConverted(const Scene& scene);

/// Refuses a collider whose sure reach leaves out contacts that are solved or could be bonded; `openGap` [ℓ] is the
/// solver's. Throws std::runtime_error.
void checkSureReach(const Scene& scene, Real openGap);

/// Refuses bodies that could be touched and never are, since the engines have no functor for their shapes; `shaped`:
/// those that are no disks and of no clump. Throws std::runtime_error.
void checkShapes(const Scene& scene, const std::vector<BodyState>& bodies, const std::vector<int>& shaped);

/// Refuses bodies of another material whose contacts with disks no functor could make: YADE's InteractionLoop ends the
/// process there. Goes through all bodies, so it is asked where these have been read anew. Throws std::runtime_error.
void checkMaterials(const Scene& scene, const std::vector<BodyState>& bodies);

/// Refuses a state that is not ContactState::usable, or has another physics: says why. Throws std::runtime_error.
[[noreturn]] void refuseContact(const Scene& scene, const ContactState& state);

/// Whether a scene has a ContactDynamicsEngine that runs; without one contacts bear nothing, and nothing else says so.
bool hasSolver(const Scene& scene);
/// What to say where it has none.
string noSolver(const Scene& scene);

} // namespace yade::nscd
