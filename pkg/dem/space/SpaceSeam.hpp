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
#include "NscdSpacePhys.hpp"
#include <contact/space/problem.hpp>
#include <contact/space/solver.hpp>
#include <optional>

namespace yade::nscd {

class SpaceSeam {
public:
	/// Makes the contact problem of a step; throws std::runtime_error naming the body or interaction that cannot be
	/// taken.
	void gather(Scene& scene, const Vector3r& gravity, const Relaxation& relaxation, int threads);
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
	size_t                                          contacts() const { return links.size(); }
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
	/// A contact's interaction, and how it stands to the order of ids.
	struct Link {
		Interaction*  interaction;
		const ScGeom* geom;
		NscdPhys*     phys;
		int           i, j; // bodies of the contact
		bool          swapped; // i is the interaction's second body
		Real          gap;
	};
	/// A contact that is left out of the solve, with its bodies, normal, levers and length.
	struct Left {
		Link                               link;
		nonsmooth::contact::space::Contact contact;
	};
	/// What one thread has found.
	struct alignas(64) Found {
		std::vector<Link> links;
		std::vector<Left> left;
	};
	/// What a part of the contacts, or of the bodies, adds up to.
	struct Sums : StepSums {
		std::vector<std::pair<int, const Interaction*>> breaks; // (mode, interaction)
	};
	/// What becomes of an interaction in a step.
	enum class Use { None, Solved, Refused };

	void              gatherBodies(Scene& scene, const Vector3r& gravity);
	Use               useOf(const Interaction& interaction) const;
	[[noreturn]] void refuse(const Scene& scene, Interaction& interaction) const;
	void              findContacts(Scene& scene);
	void              setFrame(const Link& link, nonsmooth::contact::space::Contact& result) const;
	std::optional<nonsmooth::contact::space::Contact> staysOut(const Link& link) const;
	static void                                       forgetReactions(const Link& link);
	void                                              takeIn(const std::vector<size_t>& taken);
	void                                              gatherContact(size_t k);
	bool                                              isHeld(size_t contact) const;
	void                                              sumReactions();
	void                                              scatterContact(size_t k, Sums& sums) const;
	void                                              scatterBody(Scene& scene, size_t id);
	void sumBody(size_t id, const Vector3r& gravity, StepSums& sums) const;

	Relaxation                                            relaxation {};
	int                                                   threads = 1;
	std::vector<StepBody>                                 bodies; // by id
	std::vector<Link>                                     links; // by contact of the problem
	std::vector<Found>                                    found; // by thread, in no order
	std::vector<Left>                                     left; // in no order
	int                                                   recalls = 0; // of this step
	std::vector<int>                                      linksBefore; // of each body as the one of lower id
	std::vector<nonsmooth::contact::space::PositionError> errors;
	nonsmooth::contact::space::PositionCorrection         correction;
	std::vector<nonsmooth::contact::space::Twist>         reaction; // of contacts on bodies: impulses [N s, N m s]
};

/// Whether the scene's bodies move in space: one is free out of the x-y plane, and no engine or shape says that the
/// plane is meant.
bool isInSpace(const Scene& scene, const std::vector<BodyState>& bodies);

} // namespace yade::nscd
