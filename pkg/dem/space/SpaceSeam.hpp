// A step's contact problem in space made of YADE's bodies and interactions, and its solution taken back to them:
// gather, scatter.
//
// The order of contacts is that of body ids, and each runs from the lower id to the higher, or from a wall to the
// sphere, whatever order YADE keeps them in: the same scene gives the same bits after loading and on any number of
// threads.
// Bodies: spheres, which move freely or along some axes of the world; and bodies of any shape whose motion is given, or
// which move without turning (a plate under a load). Errors of position (contact/plane/solver.hpp): an overlap at the
// end of the step is taken back by the share κ, by displacements that leave no velocity behind.
#pragma once

#include "../seam/ContactSeam.hpp"
#include "SpaceContacts.hpp"
#include <contact/space/problem.hpp>
#include <contact/space/solver.hpp>
#include <optional>

namespace yade::nscd {

class SpaceSeam {
public:
	/// Makes the contact problem of a step; throws std::runtime_error naming the body or interaction that cannot be
	/// taken. Contacts are taken where their interactions are right and not the arrays.
	void
	gather(Scene& scene, Resident& resident, const Vector3r& gravity, const Relaxation& relaxation, int threads);
	/// After a solve: takes in the contacts left out of it that its velocities would close; returns how many. They
	/// need another solve (seam/Recall.hpp).
	size_t recall();
	/// After all solves: finds how far bodies are to be displaced to take back overlaps; scatter moves them.
	void
	correct(const nonsmooth::contact::space::SolverSettings& settings,
	        nonsmooth::contact::space::Workspace& workspace, int sweeps);
	/// Takes reactions to the interactions and to O.forces, and moves bodies by their displacements.
	StepSums scatter(Scene& scene, const Vector3r& gravity);

	nonsmooth::contact::space::Problem              problem;
	std::vector<nonsmooth::contact::space::Impulse> warmStart; // what the solve began with
	size_t                                          contacts() const { return solved.size(); }
	/// Contacts whose bonds broke in the step: (mode, interaction).
	std::vector<std::pair<int, const Interaction*>> broken;
	/// Pairs that overlapped by that much and more [ℓ] when the step began.
	int overlapsOf(Real least) const;
	/// The bodies of a contact of the problem, the lower id first.
	Vector2i idsOf(size_t contact) const;

private:
	/// What the solve knows of a body besides the problem.
	struct StepBody {
		bool                             present = false;
		Real                             mass = 0, inertia = 0, radius = -1; // radius: of a sphere
		nonsmooth::contact::space::Twist before,
		        external; // velocity at the step's beginning; forces and torques of other engines
	};
	/// A contact that is left out of the solve, with its bodies, normal, levers and length.
	struct Left {
		SpaceContacts::Place               place;
		nonsmooth::contact::space::Contact contact;
	};
	/// What a part of the contacts, or of the bodies, adds up to.
	struct Sums : StepSums {
		std::vector<std::pair<int, const Interaction*>> breaks; // (mode, interaction)
	};
	/// What becomes of a contact in a step.
	enum class Use : char { None, Solved, Refused };

	void                     gatherBodies(Scene& scene, const Vector3r& gravity);
	Use                      useOf(const SpaceContactState& state) const;
	[[noreturn]] void        refuse(const Scene& scene, Interaction& interaction) const;
	void                     findContacts(const Scene& scene, const std::vector<BodyState>& states);
	const SpaceContactState& stateOf(size_t contact) const { return kept->states[solved[contact].slot]; }
	SpaceContactState&       stateOf(size_t contact) { return kept->states[solved[contact].slot]; }
	void setFrame(const SpaceContactState& state, nonsmooth::contact::space::Contact& result) const;
	std::optional<nonsmooth::contact::space::Contact> staysOut(const SpaceContactState& state) const;
	static void                                       forgetReactions(SpaceContactState& state);
	void                                              takeIn(const std::vector<size_t>& taken);
	void                                              gatherContact(size_t k);
	bool                                              isHeld(size_t contact) const;
	void                                              sumReactions();
	void                                              scatterContact(size_t k, Sums& sums);
	void                                              noteYield(
	                                                     const SpaceContactState& state, const nonsmooth::contact::space::Contact& contact,
	                                                     const nonsmooth::contact::space::Rows&             rows,
	                                                     const nonsmooth::contact::space::RelativeVelocity& velocity, Sums& sums) const;
	void scatterBody(Scene& scene, size_t id);
	void sumBody(size_t id, const Vector3r& gravity, StepSums& sums) const;

	Relaxation                                            relaxation {};
	int                                                   threads = 1;
	std::vector<StepBody>                                 bodies; // by id
	SpaceContacts*                                        kept = nullptr; // of the step
	std::vector<Use>                                      uses; // by place in the order of contacts
	std::vector<SpaceContacts::Place>                     solved; // by contact of the problem
	std::vector<Left>                                     left; // in it
	int                                                   recalls = 0; // of this step
	std::vector<nonsmooth::contact::space::PositionError> errors;
	nonsmooth::contact::space::PositionCorrection         correction;
	std::vector<nonsmooth::contact::space::Twist>         reaction; // of contacts on bodies: impulses [N s, N m s]
};

/// Whether the scene's bodies move in space: one is free out of the x-y plane, and no engine or shape says that the
/// plane is meant.
bool isInSpace(const Scene& scene, const Resident& resident);

} // namespace yade::nscd
