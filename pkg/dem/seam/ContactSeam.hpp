// A step's contact problem made of the bodies and contacts that stay in arrays (seam/Resident.hpp), and its solution
// taken back to them: gather, scatter.
//
// The order of contacts is that of body ids, and each contact runs from the lower id to the higher (from the wall to
// the sphere), whatever order YADE keeps them in: the same scene gives the same bits after loading and on any number of
// threads.
#pragma once

#include "GivenMotion.hpp"
#include "Resident.hpp"
#include "SumChunks.hpp"
#include <contact/plane/impact_sequence.hpp>
#include <contact/plane/rigid_clusters.hpp>
#include <contact/plane/solver.hpp>
#include <algorithm>
#include <core/Scene.hpp>

namespace yade::nscd {

/// How errors of position are dealt with, see contact/plane/law.hpp and contact/plane/solver.hpp.
struct Relaxation {
	Real step; // h [s]
	Real rate; // κ, share of an overlap or bond error that one step takes back
	Real largestSpeed; // of that correction [m/s]
	Real slack; // overlaps and bond errors up to this [ℓ] stay
	Real openGap; // a gap wider than this [ℓ] that will not close in the step is left out
};

/// A gathered contact's place in Resident::states.
struct Link {
	int  slot       = -1;
	int  impacts    = -1; // its place in the sequence of impacts, where the step has one
	Real correction = 0; // pseudo-impulse of the step before [kg m]
};

/// What a step did, summed over contacts in a fixed order.
struct ContactSums {
	Real sliding = 0, rolling = 0, debonding = 0, impact = 0; // energy dissipated in the step [J]
	Real missed  = 0; // of impact: what restitution would have given back [J]
	Real overlap = 0, worstOverlap = 0; // sum and maximum, in units of ℓ
	int  worstIds[2] = { -1, -1 }; // bodies of the first contact that has the maximum
	Real contactRate = 0, bondRate = 0; // [1/s], see NonsmoothTimeStepper
	Real heldWork = 0; // of tension in bonds that do not open [J]: none but for errors of the step's positions
	int  touching = 0, bonds = 0, broken[6] = { 0, 0, 0, 0, 0, 0 }; // the last ones by NscdPhys::Mode

	bool anyBroken() const
	{
		return std::any_of(std::begin(broken), std::end(broken), [](int count) { return count > 0; });
	}
};

/// The same with what cannot be kept in registers, and with what is summed over bodies.
struct StepSums : ContactSums {
	std::vector<std::pair<int, Real>>
	        slidingOnWalls; // of sliding, contact by contact: id of the wall and energy [J]
	// bodies
	Real     kinetic = 0, potential = 0, external = 0, wallWork = 0; // [J]; external and wallWork during the step
	Real     correction  = 0; // energy that bodies got by taking back errors of position [J]
	Real     kineticLeft = 0, potentialLeft = 0; // [J], at the end of the step, as the integrator leaves it
	Real     size = 0; // sum of all parts of these energies, whatever their signs [J]
	Real     mass = 0, speed = 0, largestSpeed = 0;
	Vector3r centre = Vector3r::Zero(), momentum = Vector3r::Zero();
	int      bodies = 0;

	void add(const StepSums& other);
};

/// How far a disk goes in a step.
struct LongestWay {
	Real radii = 0; // the way [its radius]
	int  body  = -1; // the disk, where it is more than one
	Real speed = 0, radius = 0; // its own [m/s, m], there alone
};
/// A step in which a disk goes half its radius, where it goes `radii` in a step of h [s].
inline Real enoughStep(Real h, Real radii) { return 0.5 * h / radii; }

class ContactSeam {
public:
	/// Makes the contact problem of a step; throws std::runtime_error naming the body where the scene cannot be
	/// taken.
	void
	gather(Scene& scene, Resident& resident, const Vector3r& gravity, const Relaxation& relaxation, int threads);
	/// Before the solve: takes the impacts that follow from impacts one after the other, `most` of one body;
	/// returns how many. The solve then has the velocities they leave, and bodies are displaced so that each has
	/// come its way at the step's end (contact/plane/impact_sequence.hpp).
	int followImpacts(int most);
	/// Bodies that had more.
	int overrun() const { return followed ? sequence.overrun : 0; }
	/// After a solve: takes in the contacts left out of it that its velocities would close, in the order of ids;
	/// returns how many. They need another solve. After a few rounds it takes in all.
	size_t recall();
	/// After the last solve, which nothing of it changes: the reactions of contacts whose two bodies both have a
	/// given motion (law.hpp, impulseOfGivenMotion).
	void answerGivenMotion();
	/// Of the last answer: how fast two such bodies are driven into each other, the fastest ones [m/s]; 0 where
	/// none are. And how many pairs are.
	Real drivenTogether = 0;
	int  drivenIds[2] = { -1, -1 }, drivenPairs = 0;
	/// After all solves: finds how far bodies are to be displaced to take back overlaps, bonds' errors of length,
	/// and what bonds of bodies that turn as one have slipped and turned; scatter moves them.
	void
	correct(const nonsmooth::contact::SolverSettings& settings, nonsmooth::contact::Workspace& workspace,
	        int sweeps);
	/// Before bodies are moved: how far disks go in the step. Throws std::runtime_error where one would go through
	/// a body that it does not touch (ContactSeamWay.cpp).
	void followWays(const Scene& scene);
	/// The farthest way of the last step, against walls and given bodies.
	LongestWay longest;
	/// Takes reactions to the contacts, average contact forces to O.forces, and slip to the walls.
	/// `rates`: also how fast contacts and bonds change, for the choice of the next step.
	StepSums scatter(Scene& scene, const Vector3r& gravity, int threads, bool rates);

	nonsmooth::contact::Problem              problem;
	std::vector<nonsmooth::contact::Impulse> warmStart; // what the solve began with
	std::vector<Link>                        links;
	int turningOut = -1; // of the last step: a body that turns about x or y, which no contact follows
	std::vector<size_t> broken; // places of the contacts whose bonds broke in the step
	GivenMotion         givenMotion; // of bodies that others move by their positions
	const ContactState& stateOf(const Link& link) const { return resident->states[link.slot]; }
	/// Pairs that overlapped by that much and more [ℓ] when the step began.
	int overlapsOf(Real least) const;

private:
	/// What becomes of a contact in a step.
	enum Part : char { None, Solved, Left };

	void                        gatherBodies(Scene& scene, const Vector3r& gravity);
	void                        takeGivenMotion(const Scene& scene);
	void                        divide(const Scene& scene);
	bool                        mustBeSolved(const ContactState& state) const;
	void                        bend(const ContactState& state, nonsmooth::contact::Contact& contact) const;
	Real                        bendOf(const ContactState& state, const nonsmooth::contact::Contact& contact) const;
	void                        setFrame(const ContactState& state, nonsmooth::contact::Contact& result) const;
	nonsmooth::contact::Impulse gatherContact(int slot, nonsmooth::contact::Contact& result, Link& link) const;
	void                        forgetReactions(int slot);
	void                        takeIn(const std::vector<size_t>& taken);
	void                        expectImpacts(std::vector<nonsmooth::contact::ImpactPair>& pairs);
	void                        setBiasAfterImpacts(nonsmooth::contact::Contact& c, const Link& link) const;
	Real gapAfterImpacts(const nonsmooth::contact::Contact& c, const ContactState& state) const;
	/// Gap of two disks that are displaced and fly all the step with the velocities `before`.
	Real gapAtEnd(
	        const nonsmooth::contact::Contact& c, const nonsmooth::contact::Twist& shiftI,
	        const nonsmooth::contact::Twist& shiftJ) const;
	/// The same as a gap at the step's beginning, of two that pass each other (gatherContact); else that gap.
	Real gapInPassing(const nonsmooth::contact::Contact& c, const ContactState& state) const
	{
		const bool passes = !state.bonded && state.gap > 0 && c.biasN > state.gap / relaxation.step;
		return passes ? c.biasN * relaxation.step : state.gap;
	}
	/// Gap that a contact would have at the step's beginning for bodies that fly all the step with the velocities
	/// that impacts leave.
	Real gapOf(const nonsmooth::contact::Contact& c, const ContactState& state) const
	{
		if (followed) return gapAfterImpacts(c, state);
		return state.bounces ? gapInPassing(c, state) : state.gap;
	}
	/// What impacts did at a contact before the solve; null where none did.
	const nonsmooth::contact::PairImpacts* impactsAt(const Link& link) const
	{
		return followed && sequence.impacts[link.impacts].count > 0 ? &sequence.impacts[link.impacts] : nullptr;
	}
	nonsmooth::contact::Impulse impulseOfStep(size_t k) const;
	Sliding                     slidingOf(size_t contact, long number) const;
	void scatterContacts(size_t begin, size_t end, bool rates, StepSums& result, char& slips);
	bool scatterContact(size_t k, const nonsmooth::contact::RelativeVelocity& u, ContactState& state) const;
	void sumReactions();
	void scatterForces(Scene& scene, size_t begin, size_t end);
	void
	refuseCrossings(const Scene& scene, const std::vector<int>& far, const nonsmooth::contact::Point& middle) const;
	void loadClusters();
	void findClusters();
	void turnClusters();
	bool turnsFar(const nonsmooth::contact::Contact& contact) const;
	bool sticks(size_t k, const nonsmooth::contact::RelativeVelocity& u) const;
	nonsmooth::contact::PositionError
	errorOf(size_t k, const nonsmooth::contact::RelativeVelocity& u, bool turns) const;
	nonsmooth::contact::RelativeVelocity givenVelocity(const nonsmooth::contact::Contact& c) const;
	void                                 turnBack();
	void                                 turnBack(size_t k);
	void                                 displace(size_t begin, size_t end);
	/// Whether a body was turned with a cluster in this step.
	bool turnsAsOne(size_t id) const { return !turned.empty() && isTurned[id]; }
	/// How far a body is moved for errors of position, and because it turns with a cluster.
	nonsmooth::contact::Twist correctionOf(size_t id) const
	{
		using nonsmooth::contact::Twist;
		const Twist d = correction.displacements.empty() ? Twist {} : correction.displacements[id];
		if (!turnsAsOne(id)) return d;
		const Twist& way = clusterWay[id];
		return { d.x + way.x, d.y + way.y, d.w + way.w };
	}
	/// How far it is moved in all beside the path of the step: impacts may have taken place within it, too.
	nonsmooth::contact::Twist displacementOf(size_t id) const
	{
		const auto d = correctionOf(id);
		if (!followed) return d;
		const auto& s = sequence.flights[id].shift;
		return { d.x + s.x, d.y + s.y, d.w + s.w };
	}
	nonsmooth::contact::plane::BodyArrays bodyArrays() const
	{
		return { problem.positions.data(), problem.inverseMass.data(), mass.data() };
	}
	void rateContact(
	        size_t k, const nonsmooth::contact::RelativeVelocity& u, const ContactState& state,
	        ContactSums& sums) const;
	Real overlapOf(size_t k, const ContactState& state) const;
	Real sumContact(
	        size_t k, const nonsmooth::contact::RelativeVelocity& u1, const ContactState& state, bool held,
	        ContactSums& sums) const;
	void sumImpacts(size_t id, const Vector3r& gravity, StepSums& sums) const;
	void sumBodies(const Vector3r& gravity, size_t begin, size_t end, StepSums& sums) const;

	Relaxation                               relaxation { 1, 0, 0, 0, 0 };
	std::vector<nonsmooth::contact::Contact> leftContacts; // left out of the solve, with
	std::vector<Link>                        leftLinks; // their links
	int                                      threads = 1;
	int                                      recalls = 0; // of this step
	std::vector<SlipSurfaceMat*>             surfaces; // walls with cells
	long                                     materialsOf = -1; // state of bodies whose materials were looked at
	std::vector<nonsmooth::contact::Twist>
	        before; // velocities at the beginning of the step, after the impacts that were followed
	std::vector<nonsmooth::contact::Twist>         begun; // before these; of a step with any
	nonsmooth::contact::ImpactSequence             sequence;
	mutable char                                   meets    = 0; // contacts with restitution close in this step
	mutable char                                   slides   = 0; // and contacts of two given bodies move
	bool                                           followed = false; // impacts were, in this step
	std::vector<nonsmooth::contact::Wrench>        external; // force and torque of other engines [N, N m]
	std::vector<nonsmooth::contact::Wrench>        force; // the same with the contacts', at the end of the step
	std::vector<nonsmooth::contact::Wrench>        reaction; // sum of contact impulses on each body
	std::vector<nonsmooth::contact::PositionError> errors; // of contacts
	nonsmooth::contact::PositionCorrection         correction; // none where there are no displacements
	std::vector<nonsmooth::contact::Wrench>
	        turning; // of bodies: impulses that turn clusters and keep the angular momentum, see turnBack [N s]
	nonsmooth::contact::plane::RigidClusters clusters;
	// of bodies, nothing but of those that are loaded and turned: what the centrifugal force gave [m/s]; after the
	// solve displacements [m] and changes of velocity [m/s]
	std::vector<nonsmooth::contact::Twist> centrifugal, clusterWay, clusterTurn;
	std::vector<int>                       loaded, turned; // bodies of clusters, in the last step
	std::vector<char>                      isTurned; // by body
	std::vector<std::vector<size_t>>
	        joints; // by part: contacts whose bodies were turned as one in the step before; then those that may be now
	std::vector<char>   present;
	Resident*           resident = nullptr; // during a step
	std::vector<Part>   partOf; // by place in the order of contacts
	std::vector<size_t> solvedBefore,
	        leftBefore; // contacts to be solved, and left out, before each chunk of them, and all
	std::vector<Real> radius; // of spheres, negative for other shapes
	std::vector<Real> mass, inertia;
};

} // namespace yade::nscd
