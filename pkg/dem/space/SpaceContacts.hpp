// Contacts of bodies that move in space, in the order of body ids, kept from step to step.
//
// Those of two spheres without a bond are kept in the arrays alone while nobody looks: the loop finds their geometry,
// and ContactDynamicsEngine their reactions, without their interactions, whose geometry and physics lie all over the
// memory. All others, bonds and contacts with facets, boxes and walls, go through their functors in every step, are
// read then, and are written back when they are solved.
//
// Either the arrays are right or the interactions are, as in the plane (seam/Resident.hpp). Engines that move bodies, or
// make interactions for pairs that come near each other, look at no contact, so that YADE's collider and integrator may
// have their turns while the arrays are right.
#pragma once

#include "../seam/BodyState.hpp"
#include "../seam/ContactPlaces.hpp"
#include "../seam/Holder.hpp"
#include "../seam/KeptContacts.hpp"
#include "NscdSpacePhys.hpp"
#include <contact/space/vector.hpp>
#include <core/Scene.hpp>
#include <functional>
#include <memory>

namespace yade::nscd {

class Resident;

/// Forces and torques act on the second body of the interaction, as in NscdSpacePhys.
struct SpaceContactState {
	Interaction*   interaction = nullptr;
	ScGeom*        geom        = nullptr;
	NscdSpacePhys* phys        = nullptr; // null where it has another
	int            i = 0, j = 0; // its bodies: the lower id first, or a wall before a sphere
	bool           swapped = false; // i is the interaction's second body
	bool           kept    = false; // in the arrays alone
	bool           bonded  = false;

	nonsmooth::contact::space::Vector normal, point; // from the interaction's first body to its second; [m]
	Real                              gap = 0, length = 0; // [m]
	Real adhesion = 0, friction = 0, rollingArm = 0, twistingArm = 0; // in force [N, 1, m, m]
	Real residualAdhesion = 0, restitution = 0; // [N, 1]
	Real pressed = 0, tangential = 0, torque = 0, twistingTorque = 0; // sizes [N, N, N m, N m]
	nonsmooth::contact::space::Vector normalForce, shearForce, rollingTorque; // [N, N, N m]
	Real                              correction = 0; // [kg m]
};

class SpaceContacts : public KeptContacts {
public:
	using State = SpaceContactState;
	using Place = ContactPlace;
	/// An interaction that is not real, by its place in the list.
	struct Potential {
		int  place, low, high;
		bool ofSpheres; // whose functor looks as far as the loop knows
	};

	static SpaceContacts& of(Resident& resident);

	void show() override;
	void hold() override;
	void leaveAlone() override;

	/// Takes all real interactions of bodies of `bodies`.
	void take(Scene& scene, const std::vector<BodyState>& bodies, int threads);
	/// Where the list of interactions may have changed: notes those that are not real. Returns false where others
	/// have made or ended contacts, so that all must be shown and taken anew.
	bool follow(Scene& scene);
	/// Takes up contacts of the potential ones at these places among them, and makes those of `ended`, places in
	/// the order of contacts, potential ones; both in order. `keep(state)` keeps a new one in the arrays if it can.
	void
	change(Scene& scene, const std::vector<std::size_t>& begun, const std::vector<std::size_t>& ended,
	       const std::function<void(State&)>& keep);

	/// Where its interaction has another geometry or physics than it had, a contact is one of these from now on.
	void lookAgain(int slot);
	/// Makes an interaction a potential one.
	static void end(const shared_ptr<Interaction>& interaction, InteractionContainer& list);
	/// Whether a contact of two spheres can be kept in the arrays alone: it has no bond, and nothing that the solver
	/// would refuse.
	static bool canBeKept(const State& state);
	/// Whether the solver takes a contact as a script has left it.
	static bool isSound(NscdSpacePhys& phys, const ScGeom& geom);
	/// Reads what the interaction has; the solver needs no more of it.
	static void read(State& state, const std::vector<BodyState>& bodies);
	/// Reads it for the last time before it is shown.
	static void keep(State& state, const std::vector<BodyState>& bodies);
	/// Writes reactions into the physics.
	static void writeReactions(const State& state);

	std::vector<State>     states; // by slot
	std::vector<Place>     order;
	std::vector<Potential> potential;

private:
	/// What of a scene tells that its list of interactions is what it was: how many there are, and how often
	/// colliders have looked for pairs.
	struct Stamp {
		size_t size  = 0;
		long   looks = 0;

		bool operator==(const Stamp& other) const { return size == other.size && looks == other.looks; }
	};
	static Stamp stampOf(const Scene& scene);
	bool         notePotential(InteractionContainer& list);
	void         letAllGo();
	int          freeSlot();

	int                 threads = 1;
	Stamp               seen; // when potential interactions were noted
	bool                areKnown = false; // the potential ones
	std::vector<Holder> holders; // by slot; none where nothing is held
	std::vector<int>    freeSlots;
	size_t              strewn = 0; // contacts that came since slots were last in their order
};

} // namespace yade::nscd
