#include "NscdInteractionLoop.hpp"
#include "Arc.hpp"
#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "PlanarGridCollider.hpp"
#include "seam/Prefetch.hpp"
#include "SceneCheck.hpp"
#include "Segment.hpp"
#include "StageClock.hpp"
#include "WallJoints.hpp"
#include "UnguardedHeaders.hpp"
#include "YadeFeatures.hpp"
#include "seam/Resident.hpp"
#include <contact/plane/disk_contact.hpp>
#include <contact/plane/thresholds.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((NscdInteractionLoop));

namespace {
	using nscd::fetch, nscd::soon, nscd::later, nscd::Reading;
	namespace contact = nonsmooth::contact;
	namespace plane   = contact::plane;

	/// A LawTester follows a contact by the axes that functors give it.
	bool hasTester(const Scene& scene)
	{
		return std::any_of(scene.engines.begin(), scene.engines.end(), [](const auto& engine) {
			return !engine->dead && dynamic_cast<const LawTester*>(engine.get());
		});
	}

	/// Makes what soft laws need of a contact of disks zero, so that a contact is the same whether it was made just now, some steps ago, or loaded.
	void forgetShear(const shared_ptr<Interaction>& I, Scene& scene)
	{
		if (typeid(*I->geom) != typeid(ScGeom) || !nscd::physOf(*I->phys)) return;
		auto& geom = static_cast<ScGeom&>(*I->geom);
		// a new contact has no axes, which nothing else can be asked to write; its shear increment is made of the velocities
		geom.precompute(
		        *Body::byId(I->getId1(), &scene)->state, *Body::byId(I->getId2(), &scene)->state, &scene, I,
		        Vector3r(geom.normal), true, Vector3r::Zero());
		geom.shearInc = Vector3r::Zero();
	}

	/// The one functor of this class, and not of one derived from it; null where there is none.
	template <class Functor, class List> const Functor* exactly(const List& functors)
	{
		for (const auto& f : functors)
			if (typeid(*f) == typeid(Functor)) return static_cast<const Functor*>(f.get());
		return nullptr;
	}

	/// Of two bodies whose contact lacks a functor for what `a` and `b` have; `remedy`: which one, or what else would do.
	[[noreturn]] void lacks(const Body& a, const Body& b, const string& functor, const string& remedy)
	{
		throw std::runtime_error(
		        "NscdInteractionLoop: bodies #" + std::to_string(a.getId()) + " and #"
		        + std::to_string(b.getId()) + " touch, and its list has no functor " + functor + ": " + remedy);
	}

	/// A material of another class is the usual reason: that of YADE's makers of bodies is a FrictMat.
	[[noreturn]] void lacksPhysics(const Body& a, const Body& b)
	{
		const string functor = "Ip2 for " + a.material->getClassName() + " and " + b.material->getClassName();
		for (const Body* body : { &a, &b })
			if (!dynamic_cast<const NscdMat*>(body->material.get()))
				lacks(a, b, functor,
				      "body #" + std::to_string(body->getId()) + " has another material, a "
				              + body->material->getClassName() + ": give it an NscdMat");
		lacks(a, b, functor, "add Ip2_NscdMat_NscdMat_NscdPhys() to the second list");
	}

	[[noreturn]] void lacksLaw(const Interaction& I, const Body& a, const Body& b)
	{
		const string functor = "Law2 for " + I.geom->getClassName() + " and " + I.phys->getClassName();
		if (nscd::physOf(*I.phys))
			lacks(a, b, functor, "add Law2_ScGeom_NscdPhys_SignoriniCoulomb() to the third list");
		lacks(a, b, functor,
		      "rigid contacts have an NscdPhys: give both bodies an NscdMat, and the loop Ip2_NscdMat_NscdMat_NscdPhys() and Law2_ScGeom_NscdPhys_SignoriniCoulomb()");
	}

	/// What a bond of two disks has slipped and turned; where it yielded so in the step before, it is at rest with that.
	void followStrain(
	        Reading& r, bool swap, const nscd::BodyReading& p1, const nscd::BodyReading& p2,
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
	        Reading& r, plane::BondMarks& marks, const plane::Motion& first, const nscd::BodyReading& second,
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

	/// What functors will look at of a contact. Noted before the loop: in it other threads write readings.
	struct Ahead {
		const void *interaction, *geom, *phys;
		int         low, high;
	};

	/// Asks for the contact's objects and its bodies.
	void fetchObjects(const Ahead& a, const Scene& scene)
	{
		fetch<sizeof(Interaction)>(a.interaction);
		fetch<sizeof(SegmentGeom)>(a.geom);
		fetch<sizeof(SlipWeakeningPhys)>(a.phys);
		for (const int id : { a.low, a.high })
			fetch<sizeof(Body)>((*scene.bodies)[id].get());
	}

	/// Asks for what its bodies point to, once these are at hand.
	void fetchBodies(const Ahead& a, const Scene& scene)
	{
		for (const int id : { a.low, a.high }) {
			const auto& body = (*scene.bodies)[id];
			if (!body) continue;
			fetch<sizeof(State)>(body->state.get());
			fetch<sizeof(Segment)>(body->shape.get());
		}
	}

	/// One interaction as YADE's loop treats it; returns false where it should be erased.
	bool visit(const shared_ptr<Interaction>& I, Scene& scene, InteractionLoop& loop)
	{
		const shared_ptr<Body>&b1_ = Body::byId(I->getId1(), &scene), &b2_ = Body::byId(I->getId2(), &scene);
		if (!b1_ || !b2_) return false;
		auto& cache = I->functorCache;
		if (b1_->isClump() || b2_->isClump() || !cache.geomExists || !b1_->shape || !b2_->shape) return true;
		bool swap = false;
		if (!cache.geom) {
			cache.geom = loop.geomDispatcher->getFunctor2D(b1_->shape, b2_->shape, swap);
			if (!cache.geom) {
				cache.geomExists = false;
				return true;
			}
		}
		for (const auto* b : { b1_.get(), b2_.get() })
			if (!b->material)
				throw std::runtime_error(
				        "NscdInteractionLoop: body #" + std::to_string(b->getId())
				        + " has no material: give it an NscdMat");
		if (swap) I->swapOrder();
		const shared_ptr<Body>&b1 = swap ? b2_ : b1_, &b2 = swap ? b1_ : b2_;
		const bool             wasReal = I->isReal();
		if (!cache.geom->go(b1->shape, b2->shape, *b1->state, *b2->state, Vector3r::Zero(), false, I))
			return !wasReal;
		if (!cache.phys) cache.phys = loop.physDispatcher->getFunctor2D(b1->material, b2->material, swap);
		if (!cache.phys) lacksPhysics(*b1, *b2);
		cache.phys->go(b1->material, b2->material, I);
		if (!wasReal) I->iterMadeReal = scene.iter;
		if (!cache.constLaw) cache.constLaw = loop.lawDispatcher->getFunctor2D(I->geom, I->phys, swap);
		if (!cache.constLaw) lacksLaw(*I, *b1, *b2);
		return cache.constLaw->go(I->geom, I->phys, I.get());
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
	if (!resident.order.empty() && (now.spheres != ours.spheres || now.law != ours.law)) resident.show();
	ours = now;
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
	const auto isOurs   = [](const nscd::BodyReading& b) { return b.plain && b.planar; };
	const auto keeperOf = [&](const Reading& r) {
		if (!ours.spheres || !ours.law || !r.phys || !isOurs(bodies[r.first]) || !isOurs(bodies[r.second])
		    || typeid(*r.phys) != typeid(NscdPhys))
			return Reading::Functors;
		const auto& cache = r.interaction->functorCache;
		return cache.constLaw.get() == ours.law && cache.geom.get() == ours.spheres ? Reading::Arrays
		                                                                            : Reading::Functors;
	};
	struct alignas(64) Part {
		// contacts that go through their functors, that are forgotten, and that are to have an interaction: places in the order
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
				fetch<nscd::commonOfReading>(&resident.readings[ahead]);
				fetch<sizeof(nscd::BondReading)>(&resident.bonds[ahead]);
			}
			Reading& r = resident.readings[slot];
			// functors in use and the contact's own are what they were, or it was read anew; its bodies may have changed
			const bool differ = !isOurs(bodies[r.first]) || !isOurs(bodies[r.second]);
			if (!r.bare && (r.keeper == Reading::Unknown || differ)) r.keeper = keeperOf(r);
			if (r.keeper == Reading::Functors) part.others.push_back(int(k));
			else if (const auto next = r.bare && differ ? Next::Unmade : follow(resident, slot, ours);
			         next != Next::Stays)
				(next == Next::Gone ? part.gone : part.unmade).push_back(int(k));
		}
	}
	std::vector<int> others;
	for (const Part& part : parts) {
		for (const int k : part.unmade) {
			const int slot = resident.order[k].slot;
			Reading&  r    = resident.readings[slot];
			resident.make(slot);
			if (!r.bare) r.keeper = keeperOf(r);
			if (r.keeper == Reading::Functors) others.push_back(k);
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

/// Brings a contact of two disks up to date, in the order of operations of Ig2_Sphere_Sphere_ScGeom and of the law's functor.
NscdInteractionLoop::Next NscdInteractionLoop::follow(nscd::Resident& resident, int slot, const Ours& ours) const
{
	Reading&    r    = resident.readings[slot];
	auto&       bond = resident.bonds[slot];
	const auto &p1 = resident.bodies[r.first], &p2 = resident.bodies[r.second];
	const Real  dz = p2.z - p1.z; // disks may be a little out of one plane, see nscd::flatness
	const auto  at = plane::diskContact(p1.motion.position, p2.motion.position, p1.radius, p2.radius, dz);
	r.nx           = at.nx;
	r.ny           = at.ny;
	r.nz           = dz == 0 && at.distance > 0 ? dz : dz / at.distance;
	r.gap          = at.gap;
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

/// Contacts that go through their functors, and interactions that may become contacts.
void NscdInteractionLoop::visitOthers(
        nscd::Resident& resident, const std::vector<int>& others, const Ours& ours, int threads)
{
	auto&      list    = *scene->interactions;
	const auto isThere = [&](int id) {
		return id >= 0 && id < (int)resident.bodies.size() && resident.bodies[id].present;
	};
	const auto& bodies  = resident.bodies;
	const auto  isPlain = [&](int id) { return isThere(id) && bodies[id].plain; };
	// what is out of reach need not be shown to its functor
	const auto isOutOfReach = [&](const Interaction& i) {
		if (!isThere(i.getId1()) || !isThere(i.getId2())) return false;
		const auto &p1 = bodies[i.getId1()], &p2 = bodies[i.getId2()];
		const auto* functor = i.functorCache.geom.get();
		if (p1.plain && p2.plain && functor && functor == ours.spheres)
			return nscd::areBeyond(ours.spheres->interactionDetectionFactor, p1, p2);
		if (!p1.planar || !p2.plain || !functor) return false;
		const auto isBeyond = [&](Real factor, const auto& wall, const auto& place) {
			const Real reach = (2 * factor - 1) * p2.radius; // of its centre from the wall
			return nscd::isBeyond(reach * (1 + 1e-6), wall, place, p2.motion.position);
		};
		const Shape& shape = *(*scene->bodies)[i.getId1()]->shape;
		if (functor == ours.segments)
			return isBeyond(
			        ours.segments->interactionDetectionFactor, static_cast<const Segment&>(shape),
			        p1.motion);
		return functor == ours.arcs
		        && isBeyond(
		                ours.arcs->interactionDetectionFactor, static_cast<const Arc&>(shape),
		                p1.motion.position);
	};
	std::vector<char> isNear(resident.potential.size(), 1);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < (long)isNear.size(); ++k) {
		if (k + (long)soon < (long)isNear.size())
			fetch<sizeof(Interaction)>(resident.potential[k + soon].interaction.get());
		isNear[k] = !isOutOfReach(*resident.potential[k].interaction);
	}
	std::vector<int> near; // places among the potential ones
	for (size_t k = 0; k < isNear.size(); ++k)
		if (isNear[k]) near.push_back(int(k));
	std::vector<int> looked; // bodies that functors will look at
	const auto       look = [&](const auto& pair) {
                for (const int id : { pair.low, pair.high })
                        if (isThere(id)) looked.push_back(id);
	};
	std::vector<Ahead> ahead;
	ahead.reserve(others.size());
	for (size_t k = 0; k < others.size(); ++k) {
		if (k + soon < others.size())
			fetch<sizeof(Reading)>(&resident.readings[resident.order[others[k + soon]].slot]);
		const auto&    place = resident.order[others[k]];
		const Reading& r     = resident.readings[place.slot];
		look(place);
		ahead.push_back({ r.interaction, r.geom, r.phys, place.low, place.high });
	}
	for (const int k : near)
		look(resident.potential[k]);
	resident.showBodies(looked);

	std::string       error; // thrown after the loop, since threads may not
	const long        known = (long)others.size(), all = known + (long)near.size();
	std::vector<char> ends(known, 0);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < all; ++k) {
		if (k + (long)soon < known) {
			fetchObjects(ahead[k + soon], *scene);
			fetchBodies(ahead[k + soon / 2], *scene);
		}
		const int                      slot  = k < known ? resident.order[others[k]].slot : -1;
		const shared_ptr<Interaction>& I     = k < known ? list[resident.readings[slot].interaction->linIx]
		                                                 : resident.potential[near[k - known]].interaction;
		bool                           stays = false;
		try {
			stays = visit(I, *scene, *this);
			if (stays && isPlain(I->getId1()) && isPlain(I->getId2()) && I->isReal())
				forgetShear(I, *scene);
		} catch (const std::exception& e) {
#pragma omp critical
			error = e.what();
		}
		if (k >= known) {
			if (!stays) list.requestErase(I);
		} else if (stays && I->isReal())
			resident.readSlot(nscd::look(*I), slot);
		else
			ends[k] = 1;
	}
	if (!error.empty()) throw std::runtime_error(error);
	size_t left = 0;
	for (size_t k = 0; k < isNear.size(); ++k) {
		auto& p = resident.potential[k];
		if (isNear[k] && p.interaction->isReal()) resident.add(p.interaction);
		else {
			if (left != k) resident.potential[left] = std::move(p);
			++left;
		}
	}
	resident.potential.resize(left);
	for (long k = 0; k < known; ++k)
		if (ends[k]) resident.gone.push_back(others[k]);
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
