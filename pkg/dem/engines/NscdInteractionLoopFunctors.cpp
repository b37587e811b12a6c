// Contacts that go through their functors, as in YADE's loop: those that the arrays do not keep.
#include "../walls/Arc.hpp"
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "NscdInteractionLoop.hpp"
#include "../seam/PythonMade.hpp"
#include "../space/SphereGeometry.hpp"
#include "../walls/Segment.hpp"
#include "../checks/UnguardedHeaders.hpp"
#include "../seam/Prefetch.hpp"
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace {
	using nscd::fetch, nscd::soon, nscd::later, nscd::ContactState;

	/// Makes what soft laws need of a contact of disks zero, so that a contact is the same whether it was made just
	/// now, some steps ago, or loaded.
	void forgetShear(const shared_ptr<Interaction>& I, Scene& scene)
	{
		if (typeid(*I->geom) != typeid(ScGeom) || !nscd::physOf(*I->phys)) return;
		auto& geom = static_cast<ScGeom&>(*I->geom);
		// a new contact has no axes, which nothing else can be asked to write; its shear increment is made of
		// the velocities
		geom.precompute(
		        *Body::byId(I->getId1(), &scene)->state, *Body::byId(I->getId2(), &scene)->state, &scene, I,
		        Vector3r(geom.normal), true, Vector3r::Zero());
		geom.shearInc = Vector3r::Zero();
	}

	/// Of two spheres; its axes are none since the contact went through its functors (forgetShear).
	void setGeometry(ScGeom& geom, const nscd::BodyState& first, const nscd::BodyState& second)
	{
		const auto at         = nscd::geometryOf(first, second);
		geom.normal           = at.normal;
		geom.penetrationDepth = at.depth;
		geom.contactPoint     = at.point;
		geom.radius1          = first.radius;
		geom.radius2          = second.radius;
		geom.shearInc         = Vector3r::Zero();
	}

	/// Of two bodies whose contact lacks a functor for what `a` and `b` have; `remedy`: which one, or what else
	/// would do.
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
		      "rigid contacts have an NscdPhys: give both bodies an NscdMat, and the loop "
		      "Ip2_NscdMat_NscdMat_NscdPhys() and Law2_ScGeom_NscdPhys_SignoriniCoulomb()");
	}

	/// What functors will look at of a contact. Noted before the loop: in it other threads write states.
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

	/// Whether both bodies of an interaction are there and spheres, not of a derived class.
	bool arePlain(const Interaction& i, const std::vector<nscd::BodyState>& bodies)
	{
		const auto isPlain = [&](int id) {
			return id >= 0 && id < (int)bodies.size() && bodies[id].present && bodies[id].plain;
		};
		return isPlain(i.getId1()) && isPlain(i.getId2());
	}
}

/// Whether a contact is one of two spheres whose functors do what is known, so that they need not be called.
bool NscdInteractionLoop::isOfSpheres(const Interaction& i, const std::vector<nscd::BodyState>& bodies) const
{
	const auto& cache = i.functorCache;
	return ours.spheres && ours.law && i.isReal() && cache.geom.get() == ours.spheres
	        && cache.constLaw.get() == ours.law && arePlain(i, bodies) && typeid(*i.geom) == typeid(ScGeom);
}

/// One interaction as YADE's loop treats it; returns false where it should be erased.
bool NscdInteractionLoop::visit(const shared_ptr<Interaction>& I)
{
	const shared_ptr<Body>&b1_ = Body::byId(I->getId1(), scene), &b2_ = Body::byId(I->getId2(), scene);
	if (!b1_ || !b2_) return false;
	auto& cache = I->functorCache;
	if (b1_->isClump() || b2_->isClump() || !cache.geomExists || !b1_->shape || !b2_->shape) return true;
	bool swap = false;
	if (!cache.geom) {
		cache.geom = geomDispatcher->getFunctor2D(b1_->shape, b2_->shape, swap);
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
	if (!cache.geom->go(b1->shape, b2->shape, *b1->state, *b2->state, Vector3r::Zero(), false, I)) return !wasReal;
	if (!cache.phys) cache.phys = physDispatcher->getFunctor2D(b1->material, b2->material, swap);
	if (!cache.phys) lacksPhysics(*b1, *b2);
	cache.phys->go(b1->material, b2->material, I);
	if (!wasReal) I->iterMadeReal = scene->iter;
	if (!cache.constLaw) cache.constLaw = lawDispatcher->getFunctor2D(I->geom, I->phys, swap);
	if (!cache.constLaw) lacksLaw(*I, *b1, *b2);
	return cache.constLaw->go(I->geom, I->phys, I.get());
}

/// The same for a loop of threads, out of which no exception may come: its message goes to `error`, and the answer is no.
bool NscdInteractionLoop::visit(
        const shared_ptr<Interaction>& I, const std::vector<nscd::BodyState>& bodies, std::string& error)
{
	try {
		if (isOfSpheres(*I, bodies)) {
			setGeometry(static_cast<ScGeom&>(*I->geom), bodies[I->getId1()], bodies[I->getId2()]);
			return I->functorCache.constLaw->go(I->geom, I->phys, I.get());
		}
		const bool stays = visit(I);
		if (stays && I->isReal() && arePlain(*I, bodies)) forgetShear(I, *scene);
		return stays;
	} catch (const std::exception& e) {
#pragma omp critical
		error = e.what();
		return false;
	}
}

/// Two spheres that are farther apart than their functor looks; what is so need not be shown to it.
bool NscdInteractionLoop::areOutOfReach(const Interaction& i, const std::vector<nscd::BodyState>& bodies) const
{
	return ours.spheres && i.functorCache.geom.get() == ours.spheres && arePlain(i, bodies)
	        && nscd::areBeyond(ours.spheres->interactionDetectionFactor, bodies[i.getId1()], bodies[i.getId2()]);
}

/// Contacts that go through their functors, and interactions that may become contacts.
void NscdInteractionLoop::visitOthers(
        nscd::Resident& resident, const std::vector<int>& others, const Ours& ours, int threads)
{
	auto&      list    = *scene->interactions;
	const auto isThere = [&](int id) {
		return id >= 0 && id < (int)resident.bodies.size() && resident.bodies[id].present;
	};
	const auto& bodies = resident.bodies;
	// what is out of reach need not be shown to its functor
	const auto isOutOfReach = [&](const Interaction& i) {
		if (!isThere(i.getId1()) || !isThere(i.getId2())) return false;
		const auto &p1 = bodies[i.getId1()], &p2 = bodies[i.getId2()];
		const auto* functor = i.functorCache.geom.get();
		if (areOutOfReach(i, bodies)) return true;
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
			fetch<sizeof(ContactState)>(&resident.states[resident.order[others[k + soon]].slot]);
		const auto&         place = resident.order[others[k]];
		const ContactState& r     = resident.states[place.slot];
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
		const shared_ptr<Interaction>& I     = k < known ? list[resident.states[slot].interaction->linIx]
		                                                 : resident.potential[near[k - known]].interaction;
		const bool                     stays = visit(I, bodies, error);
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

} // namespace yade
