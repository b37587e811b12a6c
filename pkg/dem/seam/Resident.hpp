// Bodies and contacts of a scene, kept in arrays from step to step; YADE's objects are a view of them.
//
// Either the arrays are right or YADE's objects are: one owner at a time. An engine of ours begins its turn by taking
// what it needs where the objects own it (take), and ends it by writing everything back where somebody may look before
// our next turn (show, Audience.hpp). So whoever looks sees the truth, whatever was changed in between is taken up, and
// a run in which nobody looks leaves the objects alone.
//
//     collide                geometry, bonds           gather, solve, scatter      integrate
//     PlanarGridCollider     NscdInteractionLoop       ContactDynamicsEngine       PlanarNewtonIntegrator
//
// Other threads may look and write while a run goes on in the background. The objects are shown some times a second
// then, and what others have written into a state, or set in a contact's physics, since it was last shown is left as it
// is and taken up. A save holds the run's next turn up until the file is written.
//
// Where only Python looks, as at the end of O.step(), the arrays stay known: the next turn looks whether each
// interaction is still there, and reads those that were written to. What Python sets in an NscdPhys leaves a mark
// (touched); C++ that changes one outside an engine's turn sets the mark itself.
//
// Interactions that nobody asks for need not exist: a contact of two disks that comes in a step has none until the
// objects are shown. So a run in which nobody looks makes none, and its contacts are in the arrays alone.
//
// O.forces stays where forces are added up, in every step: it is not kept twice.
#pragma once

#include "BodyState.hpp"
#include "ContactPlaces.hpp"
#include "ContactState.hpp"
#include "Holder.hpp"
#include "KeptContacts.hpp"
#include "LookClock.hpp"
#include <atomic>
#include <boost/weak_ptr.hpp>
#include <contact/plane/problem.hpp>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace yade::nscd {

class Resident {
public:
	using Place = ContactPlace;

	/// An interaction that is not real.
	struct Potential {
		shared_ptr<Interaction> interaction;
		int                     low, high;
		bool                    followed = false; // the collider has found its pair among those that it follows
	};

	/// A pair of disks within reach that is no contact, and the step since which it has been known; its interaction
	/// would not be real.
	struct Pair {
		int low, high, born;
	};

	/// What a state had when it was last written or read, and whose it was: others may have changed it since, or
	/// put another body in its place.
	struct Shown {
		nonsmooth::contact::plane::Motion motion;
		boost::weak_ptr<Body>             body;
	};

	/// What interactions go through that are made for bare contacts, and a geometry to begin with, of which a part
	/// can be set by YADE's functors alone.
	struct Recipe {
		shared_ptr<IGeomFunctor> geomFunctor;
		shared_ptr<IPhysFunctor> physFunctor;
		shared_ptr<LawFunctor>   law;
		shared_ptr<ScGeom>       geom;
	};

	/// A look at YADE's objects.
	struct Look {
		string who        = "whoever asked";
		bool   staysKnown = false; // only Python can have changed them when contacts are taken again
		bool   makes      = true; // interactions of bare contacts
		bool   sorts      = true; // the list of interactions; not where other threads may be walking along it
		bool   inSpace    = true; // contacts of bodies that move in space, too
	};

	/// That of a scene; made where there is none.
	static std::shared_ptr<Resident> of(Scene& scene);

	/// Whether the arrays are right and not the objects.
	bool hasBodies() const { return bodiesOwned; }
	bool hasContacts() const { return contactsOwned; }
	bool hasContactsInSpace() const { return inSpace && inSpace->owned(); }

	void takeBodies(Scene& scene);
	/// Takes all interactions that are real, and notes the others.
	void takeContacts(Scene& scene);
	/// Writes all into YADE's objects, which own it from now on.
	void show(const Look& look);
	void show() { show(Look()); }
	/// Where no turn is going on in this thread: waits for the end of the one that another thread is in, and keeps
	/// others from beginning.
	std::unique_lock<std::recursive_mutex> betweenTurns();
	/// Shows there.
	void showBetweenTurns();
	/// The same where the scene is about to be saved; steps that another thread makes wait until it is, so that
	/// what is written is of one moment.
	void showForSaving();
	/// Brings these bodies' states up to date and no more: the arrays stay right, and take what a script has made
	/// of these states when the next turn begins. What it has written elsewhere stays, and is taken up when all has
	/// been shown.
	void showOnly(const std::vector<int>& ids);
	/// Writes rows (id, x, y, r, angle, vx, vy, ω) of all spheres as they are now to where `room` has a place for
	/// so many numbers.
	void disks(const std::function<double*(size_t)>& room);
	/// Makes sure that what it points to stays, whatever other threads erase.
	void hold();

	/// Moves a body by d [m, m, rad]; velocities stay.
	void displace(size_t id, const nonsmooth::contact::Twist& d);
	/// Brings a body's state up to date.
	void showBody(size_t id);
	/// The same for several, each of which may be named more than once.
	void showBodies(const std::vector<int>& ids);

	/// Of two disks, at the time when their geometry was found [m].
	Vector3r contactPoint(const ContactState& r) const;

	/// Reads a real interaction, with what a script has written into it.
	void readSlot(const Found& found, int slot);
	/// Notes an interaction that is not real.
	void addPotential(const shared_ptr<Interaction>& interaction);
	/// Takes a real interaction for a new contact; `merge` gives it its place.
	void add(const shared_ptr<Interaction>& interaction);
	/// The same without an interaction; `state` has its strengths' number.
	void add(const ContactState& state);
	/// Takes up the contacts that were added, and leaves out those in `gone`, whose interactions become potential
	/// ones.
	void merge(InteractionContainer& list);
	/// Whether that pair is a contact.
	bool isContact(int low, int high) const;
	/// The place of strengths among those that bare contacts share; −1 where there is no room for more.
	int numberOf(const nonsmooth::contact::plane::Strengths& strengths);
	/// Makes the interaction of a bare contact, with all that the arrays know of it.
	void make(int slot);
	/// The same of a pair that is no contact.
	void make(const Pair& pair);
	/// Goes through the bare contacts and the points at which they are [m]; all interactions that there are are up
	/// to date then.
	void showBare(const std::function<void(const ContactState&, const Vector3r&)>& take);
	/// Bonds the bare contacts that are to be bonded, and returns how many, and how many bare ones are bonded then;
	/// the others' interactions are up to date then, as ContactDynamicsEngine::bond needs them.
	std::pair<int, int> bondBare();
	/// Leaves out of the potential interactions those that are no longer in the list.
	void forgetErased(InteractionContainer& list);

	std::vector<BodyState> bodies; // by id
	std::vector<int>       shaped; // those that are no disks and of no clump
	std::vector<int>       driven; // those with a motion in the plane that is given, since DOFs are blocked
	std::vector<string> sizesTold; // what there is to tell of disks whose radius was changed, see ResidentSizes.cpp
	std::vector<ContactState> states; // by slot
	std::vector<BondState>    bonds; // by slot, of contacts that the arrays keep
	std::vector<BondStrain>   rests; // the same: what a bond has slipped and turned by yielding
	std::vector<char>
	                   surelySolved; // by slot: touches or is bonded, so that it is solved whatever its velocity; so much of a state is asked first
	std::vector<Place> order;
	std::vector<int>   gone; // places in the order of contacts that are to be left out
	std::vector<Pair>  proposed; // by the collider, and not taken for contacts yet; or no longer
	std::vector<nonsmooth::contact::plane::Strengths> strengths; // of bare contacts, by number
	Recipe                                            recipe;
	size_t                                            bare = 0; // contacts without an interaction
	long made = 0; // interactions so far that were made for contacts and pairs which had none
	std::shared_ptr<KeptContacts> inSpace; // contacts of bodies that move in space; null where there never were any
	/// Interactions that are not real; and the step of the last loop, which knew of all.
	std::vector<Potential> potential;
	long                   potentialOf = never;
	/// Where bodies were when the geometry of contacts was found; by id.
	std::vector<nonsmooth::contact::Point> places;
	static constexpr long                  never = std::numeric_limits<long>::min();

	long   taken = 0; // times so far that bodies were read, which others may be then
	long   shown = 0; // times so far
	string shownTo; // who looked the last time

private:
	friend class Turn;
	bool                    takeKnown(Scene& scene);
	void                    takeShown(Scene& scene);
	std::vector<FormerSize> resized(const Scene& scene, const std::vector<FormerSize>& changed);
	void                    followSizes(Scene& scene, const std::vector<FormerSize>& all);
	int                     freeSlot();
	void                    hold(ContactState& state, const shared_ptr<Interaction>& interaction);
	void                    showContact(int slot) const;
	shared_ptr<Interaction> interactionOf(int slot) const;
	void                    insert(int slot, const shared_ptr<Interaction>& interaction);
	bool                    insert(const shared_ptr<Interaction>& interaction, int born);
	bool                    isGone(int id) const;
	void                    makeAll();
	void                    sort();
	void                    repack();
	bool                    isBehind(const Scene& scene) const;

	int                  threads = 1; // those of the last turn
	std::recursive_mutex lock; // an engine's turn, or a look from another thread
	std::atomic<int>     waiting {
                0
	}; // threads that want to look; turns follow each other too closely for them to come in by chance
	bool beingSaved = false; // by a thread that holds Python's lock until it has written all
	boost::weak_ptr<BodyContainer>        container;
	boost::weak_ptr<InteractionContainer> interactions;
	bool                                  bodiesOwned = false, contactsOwned = false, held = false;
	bool                contactsKnown = false; // not owned, but as they were shown unless Python has changed them
	size_t              interactionsSeen = 0; // at the end of the last turn
	std::vector<int>    shownAlone; // bodies that a script may have changed since, see showOnly
	std::vector<Shown>  asShown; // by id: during a run in the background; none else
	std::vector<Holder> holders; // of interactions, by ContactState::number
	std::vector<int>    freeSlots, freeHolders;
	std::vector<int>    bareSlots; // of bare contacts, and of some that are so no longer
	size_t              strewn = 0; // contacts that came since slots were last in their order
	std::vector<Place>  come, merged;
	std::vector<int>    bucket;
	std::vector<Found>  found; // by place in the list of interactions
	std::map<int, FormerSize> sizesLost; // of spheres whose radius has no sense now, by id
	LookClock                 looks;
};

/// An engine's turn. Throws std::runtime_error where bodies cannot be read.
class Turn {
public:
	Turn(Engine& engine, int threads);
	~Turn();
	/// Ends it: shows where somebody may look before the next one. Without it, as where an exception leaves, all is
	/// shown.
	void      end();
	Resident& resident() { return *data; }

private:
	Engine&                                engine;
	std::shared_ptr<Resident>              data;
	std::unique_lock<std::recursive_mutex> locked;
	bool                                   ended = false;
};

} // namespace yade::nscd
