#include "NscdInteractionLoop.hpp"
#include "../seam/EngineRoles.hpp"
#include "../walls/Arc.hpp"
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "PlanarGridCollider.hpp"
#include "../seam/Prefetch.hpp"
#include "../checks/SceneCheck.hpp"
#include "../walls/Segment.hpp"
#include "../seam/StageClock.hpp"
#include "../walls/WallJoints.hpp"
#include "../checks/UnguardedHeaders.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include "../space/SpaceSeam.hpp"
#include <contact/plane/disk_contact.hpp>
#include <contact/plane/thresholds.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((NscdInteractionLoop));
[[maybe_unused]] static const bool nscdInteractionLoopRole = nscd::giveRole(
        typeid(NscdInteractionLoop), nscd::EngineRole::TakesTurns);

namespace {
	using nscd::fetch, nscd::soon, nscd::later, nscd::ContactState;
	namespace contact = nonsmooth::contact;
	namespace plane   = contact::plane;

	/// A LawTester follows a contact by the axes that functors give it.
	bool hasTester(const Scene& scene)
	{
		return std::any_of(scene.engines.begin(), scene.engines.end(), [](const auto& engine) {
			return !engine->dead && dynamic_cast<const LawTester*>(engine.get());
		});
	}

	/// The one functor of this class, and not of one derived from it; null where there is none.
	template <class Functor, class List> const Functor* exactly(const List& functors)
	{
		for (const auto& f : functors)
			if (typeid(*f) == typeid(Functor)) return static_cast<const Functor*>(f.get());
		return nullptr;
	}

	/// What a bond of two disks has slipped and turned; where it yielded so in the step before, it is at rest with
	/// that.
	void followStrain(
	        ContactState& r, bool swap, const nscd::BodyState& p1, const nscd::BodyState& p2,
	        const plane::BondMarks& marks, plane::BondStrain& rest)
	{
		const auto &         first = swap ? p2 : p1, &second = swap ? p1 : p2;
		const contact::Point normal { swap ? -r.nx : r.nx, swap ? -r.ny : r.ny };
		const auto           strain = plane::bondStrain(
		                  marks, first.motion, second.motion, normal, first.radius + 0.5 * r.gap,
		                  second.radius + 0.5 * r.gap, second.radius);
		// most have yielded nothing, and their rest, which lies elsewhere in memory, is not read
		auto error = strain;
		if (r.strained || r.slid || r.rolled) {
			if (!r.strained) rest = {};
			r.strained = true;
			error      = plane::unyielded(strain, r.slid, r.rolled, rest);
		}
		r.slip = static_cast<float>(error.slip);
		r.turn = static_cast<float>(error.turn);
	}

	/// Makes the bond that a script has asked for, see NscdPhys::isBondWanted.
	void makeBond(
	        ContactState& r, plane::BondMarks& marks, const plane::Motion& first, const nscd::BodyState& second,
	        bool swap)
	{
		const contact::Point normal { swap ? -r.nx : r.nx, swap ? -r.ny : r.ny };
		marks     = plane::markBond(first, second.motion, normal, second.radius);
		r.broken  = NscdPhys::None;
		r.restGap = plane::firstRestGap(r.gap);
		r.path    = {};
		r.yielded = r.slid = r.rolled = r.strained = false;
		NscdPhys& phys                             = *r.phys;
		phys.breaks                                = false;
		phys.brokenMode                            = NscdPhys::None;
		phys.brokenStep                            = -1;
		phys.anchor1                               = Vector3r(marks.first.x, marks.first.y, 0);
		phys.anchor2                               = Vector3r(marks.second.x, marks.second.y, 0);
		phys.axis                                  = Vector3r(marks.normal.x, marks.normal.y, 0);
	}

}

/// A list that was exchanged leaves its functors to the contacts that are there.
void NscdInteractionLoop::keepFunctors()
{
	const auto keep = [this](const auto& functors) {
		for (const auto& one : functors)
			if (std::find(used.begin(), used.end(), one) == used.end()) used.push_back(one);
	};
	keep(geomDispatcher->functors);
	keep(physDispatcher->functors);
	keep(lawDispatcher->functors);
}

void NscdInteractionLoop::action()
{
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Interactions);
	auto&                  list    = *scene->interactions;
	const int              threads = nscd::threadsOf(*this);
	nscd::Turn      turn(*this, threads); // first: a refusal shows what the engines before have left in the arrays
	nscd::Resident& resident = turn.resident();
	nscd::refuseEarly(*scene, "NscdInteractionLoop");
	keepFunctors();
	if (!nscd::hasSolver(*scene))
		for (const auto& law : lawDispatcher->functors)
			if (dynamic_cast<const Law2_ScGeom_NscdPhys_SignoriniCoulomb*>(law.get()))
				throw std::runtime_error("NscdInteractionLoop: " + nscd::noSolver(*scene));
	if (scene->isPeriodic || loopOnSortedInteractions || !callbacks.empty() || list.iterColliderLastRun >= 0
	    || hasTester(*scene)) {
		resident.show();
		resident.potentialOf = nscd::Resident::never;
		InteractionLoop::action();
		turn.end();
		return;
	}
	lawDispatcher->scene = physDispatcher->scene = geomDispatcher->scene = scene;
	geomDispatcher->updateScenePtr();
	physDispatcher->updateScenePtr();
	lawDispatcher->updateScenePtr();

	// a functor that is used as it is may be replaced by what it does; one that a user derived from it may not
	const auto& shapes = geomDispatcher->functors;
	const Ours  now { exactly<Ig2_Sphere_Sphere_ScGeom>(shapes), exactly<Ig2_Segment_Sphere_ScGeom>(shapes),
                         exactly<Ig2_Arc_Sphere_ScGeom>(shapes),
                         exactly<Law2_ScGeom_NscdPhys_SignoriniCoulomb>(lawDispatcher->functors), colliderBefore() };
	const bool  exchanged = now.spheres != ours.spheres || now.law != ours.law;
	if (exchanged && (!resident.order.empty() || resident.hasContactsInSpace())) resident.show();
	ours = now;
	if (nscd::isInSpace(*scene, resident)) {
		if (resident.hasContacts()) resident.show();
		resident.potentialOf = nscd::Resident::never;
		actInSpace(resident, threads);
		turn.end();
		return;
	}
	if (resident.inSpace) resident.inSpace->show(); // what moved in space has come to stay in the plane
	// what a script erases beside the arrays is no longer real, and the collider has taken it out of the list
	if (resident.hasContacts() && list.size() != resident.order.size() - resident.bare + resident.potential.size())
		resident.show();
	if (!resident.hasBodies()) resident.takeBodies(*scene);
	if (resident.hasContacts()) resident.hold();
	else
		resident.takeContacts(*scene);
	resident.showBodies(resident.shaped);
	nscd::WallJoints::of(*scene).find(*scene, resident.shaped);

	const auto& bodies = resident.bodies;
	const long  size = (long)bodies.size(), count = (long)resident.order.size();
	resident.places.resize(size);
	const auto isOurs   = [](const nscd::BodyState& b) { return b.plain && b.planar; };
	const auto keeperOf = [&](const ContactState& r) {
		if (!ours.spheres || !ours.law || !r.phys || !isOurs(bodies[r.first]) || !isOurs(bodies[r.second])
		    || typeid(*r.phys) != typeid(NscdPhys))
			return ContactState::Functors;
		const auto& cache = r.interaction->functorCache;
		return cache.constLaw.get() == ours.law && cache.geom.get() == ours.spheres ? ContactState::Arrays
		                                                                            : ContactState::Functors;
	};
	struct alignas(64) Part {
		// contacts that go through their functors, that are forgotten, and that are to have an interaction:
		// places in the order
		std::vector<int> others, gone, unmade;
	};
	std::vector<Part> parts(threads);
#pragma omp parallel num_threads(threads)
	{
		Part& part = nonsmooth::neighbours::partOfThread(parts);
#pragma omp for schedule(static) nowait
		for (long id = 0; id < size; ++id)
			if (bodies[id].present) resident.places[id] = bodies[id].motion.position;
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			const int slot = resident.order[k].slot;
			if (k + (long)later < count) {
				const int ahead = resident.order[k + later].slot;
				fetch<nscd::commonOfState>(&resident.states[ahead]);
				fetch<sizeof(nscd::BondState)>(&resident.bonds[ahead]);
			}
			ContactState& r = resident.states[slot];
			// functors in use and the contact's own are what they were, or it was read anew; its bodies may
			// have changed
			const bool differ = !isOurs(bodies[r.first]) || !isOurs(bodies[r.second]);
			if (!r.bare && (r.keeper == ContactState::Unknown || differ)) r.keeper = keeperOf(r);
			if (r.keeper == ContactState::Functors) part.others.push_back(int(k));
			else if (const auto next = r.bare && differ ? Next::Unmade : follow(resident, slot, ours);
			         next != Next::Stays)
				(next == Next::Gone ? part.gone : part.unmade).push_back(int(k));
		}
	}
	std::vector<int> others;
	for (const Part& part : parts) {
		for (const int k : part.unmade) {
			const int     slot = resident.order[k].slot;
			ContactState& r    = resident.states[slot];
			resident.make(slot);
			if (!r.bare) r.keeper = keeperOf(r);
			if (r.keeper == ContactState::Functors) others.push_back(k);
			else if (r.bare || follow(resident, slot, ours) != Next::Stays)
				resident.gone.push_back(k);
		}
		others.insert(others.end(), part.others.begin(), part.others.end());
		resident.gone.insert(resident.gone.end(), part.gone.begin(), part.gone.end());
	}
	takeProposed(resident, ours, threads);
	if (!others.empty() || !resident.potential.empty()) visitOthers(resident, others, ours, threads);
	resident.merge(list);
	resident.potentialOf = scene->subStepping ? nscd::Resident::never
	                                          : scene->iter; // a script may do anything between sub-steps
	turn.end();
}

/// Brings a contact of two disks up to date, in the order of operations of Ig2_Sphere_Sphere_ScGeom and of the law's
/// functor.
NscdInteractionLoop::Next NscdInteractionLoop::follow(nscd::Resident& resident, int slot, const Ours& ours) const
{
	ContactState& r    = resident.states[slot];
	auto&         bond = resident.bonds[slot];
	const auto &  p1 = resident.bodies[r.first], &p2 = resident.bodies[r.second];
	const Real    dz = p2.z - p1.z; // disks may be a little out of one plane, see nscd::flatness
	const auto    at = plane::diskContact(p1.motion.position, p2.motion.position, p1.radius, p2.radius, dz);
	r.nx             = at.nx;
	r.ny             = at.ny;
	r.nz             = dz == 0 && at.distance > 0 ? dz : dz / at.distance;
	r.gap            = at.gap;
	if (r.broken != NscdPhys::None && !r.phys->breaks) r.broken = NscdPhys::None; // that was the step before
	bool       refresh = r.wasRead || r.stale; // a script may have changed its strengths
	const bool swap    = r.first > r.second;
	r.wasRead = r.stale = false;
	if (r.bonded) {
		if (bond.marks.normal.x == 0 && bond.marks.normal.y == 0)
			makeBond(r, bond.marks, (swap ? p2 : p1).motion, swap ? p1 : p2, swap);
		const auto gone = plane::bondDisplacement(bond.marks, (swap ? p2 : p1).motion, (swap ? p1 : p2).motion);
		if (!plane::bondLives(r.closes ? plane::ofClosing(gone) : gone, bond.zone) && bond.zone.normal > 0
		    && bond.zone.tangential > 0) { // else it is refused in this step
			if (r.bare) return Next::Unmade; // the interaction says how it broke, and when
			r.phys->restGap   = r.restGap;
			r.phys->yieldPath = nscd::vectorOf(r.path);
			r.phys->yielded   = r.yielded;
			r.phys->slid      = r.slid;
			r.phys->rolled    = r.rolled;
			ours.law->breakBond(*r.phys);
			r.bonded = false;
			r.broken = r.phys->brokenMode;
			refresh  = true;
		} else {
			if (r.yielded) r.restGap = plane::grownRestGap(r.restGap, r.gap);
			if (r.slid || r.rolled || r.joins)
				followStrain(r, swap, p1, p2, bond.marks, resident.rests[slot]);
			else
				r.slip = r.turn = 0;
		}
	}
	const bool stays = r.bonded || r.broken != NscdPhys::None;
	if (!stays
	    && (!ours.law->isWithinReach(r.gap, r.length)
	        || (ours.collider && !ours.collider->wants(r.first, r.second, p1.radius + p2.radius + r.gap))))
		return Next::Gone;
	if (refresh && r.bare) nscd::findThresholds(r, resident.strengths[r.number], ours.law->adhesionRange);
	else if (refresh) {
		r.phys->updateThresholds(r.gap, ours.law->adhesionRange);
		nscd::readThresholds(r);
	} else if (!r.bonded)
		r.adhesion = plane::touches(r.gap, ours.law->adhesionRange, r.length) ? r.residualAdhesion : 0;
	if (!(std::abs(r.nz) <= nscd::flatness)) r.usable = false;
	resident.surelySolved[slot] = r.active && r.usable && (r.bonded || r.broken != NscdPhys::None || r.gap <= 0);
	return Next::Stays;
}

/// The collider whose reach of this step holds; null where another engine may have changed bodies since, or a script.
const PlanarGridCollider* NscdInteractionLoop::colliderBefore() const
{
	const PlanarGridCollider* collider = nullptr;
	for (const auto& engine : scene->engines) {
		if (engine.get() == this) break;
		if (!engine->dead) collider = dynamic_cast<const PlanarGridCollider*>(engine.get());
	}
	return collider && !scene->subStepping && collider->hasRun(scene->iter) ? collider : nullptr;
}

} // namespace yade
