#include "PlanarGridCollider.hpp"
#include "../seam/EngineRoles.hpp"
#include "../seam/PythonMade.hpp"
#include "../checks/Refusal.hpp"
#include "../seam/SameBody.hpp"
#include "../checks/SceneCheck.hpp"
#include "../seam/StageClock.hpp"
#include "../checks/YadeFeatures.hpp"
#include "../seam/Resident.hpp"
#include <algorithm>
#include <boost/make_shared.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Bo1_Aabb.hpp>

namespace yade {

YADE_PLUGIN((PlanarGridCollider));
[[maybe_unused]] static const bool planarGridColliderRole = nscd::giveRole(
        typeid(PlanarGridCollider), nscd::EngineRole::TakesTurns);

namespace {
	using nonsmooth::neighbours::Disk;
	using nonsmooth::neighbours::isNear;
}

void PlanarGridCollider::action()
{
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Collide);
	threads = nscd::threadsOf(*this);
	ranIn   = never; // until all is done; a step's number comes again after O.resetTime()
	// what is changed here and what was noted before would not fit together where an exception leaves
	struct Whole {
		PlanarGridCollider& collider;
		const int           exceptions = std::uncaught_exceptions();
		~Whole()
		{
			if (std::uncaught_exceptions() > exceptions) collider.reference.clear();
		}
	} whole { *this };
	nscd::Turn turn(*this, threads);
	validate();
	resident           = &turn.resident();
	const auto& bodies = resident->bodies;
	if (!resident->hasContacts() && scene->interactions->size() == 0) resident->takeContacts(*scene);
	scene->interactions->iterColliderLastRun = -1;
	scene->forces.addMaxId(scene->bodies->size());
	bool       anew = changed();
	const long size = (long)bodies.size();
	disks.resize(size);
	velocities.resize(size);
	bool turned = false; // a disk into another shape, or the other way round
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : turned)
	for (long id = 0; id < size; ++id) {
		const auto& b  = bodies[id];
		disks[id]      = b.present && b.plain ? Disk { b.motion.position.x, b.motion.position.y, b.radius }
		                                      : Disk { 0, 0, -1 };
		velocities[id] = { b.motion.velocity.x, b.motion.velocity.y };
		turned         = turned || hasTurned(id);
	}
	if (renewShapes(turned)) anew = true;
	if (anew) listSides();
	boundSides();

	// nobody else adds or removes interactions during a step; a script may have, between two
	const auto left    = [&] { return (long)scene->interactions->size() - resident->made; };
	const bool touched = left() != sizeLeft;
	if (!anew && !touched && resident->potentialOf == scene->iter - 1) eraseUnreal();
	else
		forget();
	if (anew || moved()) search();
	findNear();
	takeDisks();
	takeSides();
	sizeLeft = left();
	if (!scene->subStepping) ranIn = scene->iter; // or a script may change bodies before others use what was found
	turn.end();
	resident = nullptr;
}

void PlanarGridCollider::validate() const
{
	nscd::refuseEarly(*scene, "PlanarGridCollider");
	if (scene->isPeriodic)
		throw std::runtime_error(
		        "PlanarGridCollider: periodic scenes are not supported, with any collider: set O.periodic = False and bound the scene by walls");
	if (!(sureReach >= 0))
		throw std::runtime_error(
		        "PlanarGridCollider: sureReach = " + nscd::number(sureReach)
		        + ": give a gap in units of ℓ that is not negative");
	if (!std::isfinite(verletDist))
		throw std::runtime_error(
		        "PlanarGridCollider: verletDist = " + nscd::number(verletDist)
		        + ": give a length [m], or a negative number of smallest radii");
}

/// Ends the contacts of bodies whose shape was replaced: they hold what was made for the old one. Returns whether there
/// are any.
bool PlanarGridCollider::renewShapes(bool turned)
{
	std::vector<Body::id_t> renewed;
	for (size_t id = 0; turned && id < disks.size(); ++id)
		if (hasTurned(id)) renewed.push_back(Body::id_t(id));
	for (const Side& side : sides) { // nobody tells of bodies that are erased without redirection
		const bool isThere = scene->bodies->exists(side.id); // O.bodies.clear() leaves fewer
		if (!isThere || !nscd::isSame(side.shape, Body::byId(side.id, scene)->shape))
			renewed.push_back(side.id);
	}
	if (!renewed.empty()) resident->show();
	if (!resident->hasBodies()) resident->takeBodies(*scene);
	for (const Body::id_t id : renewed) {
		if (!scene->bodies->exists(id)) continue;
		const auto& b        = Body::byId(id, scene);
		const auto  contacts = b->intrs; // a copy, as erasing changes it
		for (const auto& [other, contact] : contacts)
			scene->interactions->erase(id, other, contact->linIx);
	}
	return !renewed.empty();
}

/// Whether lists of an earlier step are of no use: there are none, or what they depend on is different.
bool PlanarGridCollider::changed()
{
	Real wanted = 1;
	for (const auto& functor : boundDispatcher->functors)
		if (const auto* sphere = dynamic_cast<const Bo1_Sphere_Aabb*>(functor.get()))
			if (sphere->aabbEnlargeFactor > 0) wanted = sphere->aabbEnlargeFactor;
	auto&      all = *scene->bodies;
	const bool is  = wanted != factor || verletDist != verletDistOfLists || sureReach != sureReachOfLists
	        || reference.size() != all.size() || scene->doSort || scene->interactions->dirty
	        || !all.checkedByCollider || !all.enableRedirection;
	factor            = wanted;
	verletDistOfLists = verletDist;
	sureReachOfLists  = sureReach;
	scene->doSort = scene->interactions->dirty = false;
	if (!all.checkedByCollider) {
		if (all.enableRedirection) all.updateRealBodies();
		all.checkedByCollider = true;
		all.insertedBodies.clear();
		all.erasedBodies.clear();
	}
	return is;
}

/// The bodies that are no disks, without their boxes.
void PlanarGridCollider::listSides()
{
	sides.clear();
	sidePairs.clear();
	boundDispatcher->scene = scene;
	boundDispatcher->updateScenePtr();
	for (const auto& b : *scene->bodies) {
		if (!b || !b->shape || !b->isBounded() || resident->bodies[b->getId()].plain) continue;
		nscd::letGo(b->shape->boundFunctor);
		b->shape->boundFunctor = boundDispatcher->getFunctor1D(b->shape);
		if (b->shape->boundFunctor) sides.push_back({ b->getId(), {}, {}, b->shape });
	}
}

void PlanarGridCollider::boundSides()
{
	for (Side& side : sides) {
		const auto& b = Body::byId(side.id, scene);
		resident->showBody(side.id);
		b->shape->boundFunctor->go(b->shape, b->bound, b->state->se3, b.get());
		side.box = { b->bound->min[0], b->bound->min[1], b->bound->max[0], b->bound->max[1] };
	}
}

/// Erases all that is not real and trusts none of what was noted, so that every pair within reach is looked up in
/// O.interactions.
void PlanarGridCollider::forget()
{
	scene->interactions->conditionalyEraseNonReal(*this, scene);
	resident->potential.clear();
	resident->proposed.clear();
	std::fill(known.begin(), known.end(), 0);
	for (SidePair& pair : sidePairs)
		pair.known = false;
}

/// Erases what the loop found not to be real; with a body that is no disk an interaction may stay potential.
void PlanarGridCollider::eraseUnreal()
{
	auto&  potential = resident->potential;
	size_t left      = 0;
	for (auto& p : potential) {
		const auto [a, b] = std::pair(p.low, p.high);
		if (disks[a].r < 0 || disks[b].r < 0) {
			const auto pair = p.followed ? nullptr : sidePairOf(a, b);
			if (p.followed || (pair && pair->known)) {
				p.followed = true;
				if (&potential[left] != &p) potential[left] = std::move(p);
				++left;
			} else
				eraseIfUnreal(a, b);
			continue;
		}
		eraseIfUnreal(a, b);
		unnote(a, b);
	}
	potential.resize(left);
	for (const auto& pair : resident->proposed)
		unnote(pair.low, pair.high);
	resident->proposed.clear();
}

/// A pair of disks is no longer in O.interactions, nor a contact.
void PlanarGridCollider::unnote(Body::id_t a, Body::id_t b)
{
	const auto begin = pairs.second.begin() + pairs.begin[a], end = pairs.second.begin() + pairs.begin[a + 1],
	           at = std::lower_bound(begin, end, b);
	if (at != end && *at == b) known[at - pairs.second.begin()] = 0;
}

/// The noted pair of two bodies one of which is no disk; null where there is none.
PlanarGridCollider::SidePair* PlanarGridCollider::sidePairOf(Body::id_t a, Body::id_t b)
{
	if (disks[a].r >= 0) std::swap(a, b);
	const auto side = std::lower_bound(sides.begin(), sides.end(), a, [](const Side& s, Body::id_t id) {
		return s.id < id;
	});
	if (side == sides.end() || side->id != a) return nullptr;
	const std::pair<int, int> wanted { int(side - sides.begin()), b };
	const auto                at = std::lower_bound(
	                       sidePairs.begin(), sidePairs.end(), wanted,
	                       [](const SidePair& p, const auto& w) { return std::make_pair(p.side, p.disk) < w; });
	return at != sidePairs.end() && at->side == wanted.first && at->disk == b ? &*at : nullptr;
}

void PlanarGridCollider::eraseIfUnreal(Body::id_t a, Body::id_t b)
{
	const auto& found = scene->interactions->find(a, b);
	if (found && !found->isReal()) scene->interactions->erase(a, b, found->linIx);
}

vector<Body::id_t> PlanarGridCollider::probeBoundingVolume(const Bound& bound)
{
	const Box          box { bound.min[0], bound.min[1], bound.max[0], bound.max[1] };
	vector<Body::id_t> found;
	for (size_t id = 0; id < disks.size(); ++id)
		if (disks[id].r >= 0 && isNear(box, disks[id].x, disks[id].y, factor * disks[id].r))
			found.push_back(Body::id_t(id));
	for (const Side& s : sides)
		if (s.box.xMin <= box.xMax && s.box.xMax >= box.xMin && s.box.yMin <= box.yMax
		    && s.box.yMax >= box.yMin)
			found.push_back(s.id);
	return found;
}

} // namespace yade
