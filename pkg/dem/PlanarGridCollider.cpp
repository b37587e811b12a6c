#include "PlanarGridCollider.hpp"
#include "PythonMade.hpp"
#include "Refusal.hpp"
#include "SameBody.hpp"
#include "SceneCheck.hpp"
#include "StageClock.hpp"
#include "YadeFeatures.hpp"
#include "seam/Resident.hpp"
#include <algorithm>
#include <boost/make_shared.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Bo1_Aabb.hpp>

namespace yade {

YADE_PLUGIN((PlanarGridCollider));

namespace {
	using nonsmooth::neighbours::Disk;
	using nonsmooth::neighbours::isNear;
	using nonsmooth::neighbours::partOfThread;

	/// How far, in radii, a box reaches around a disk that it can touch: Ig2 functors know contacts with a wall up to (factor − 1) times the diameter.
	Real reachAround(Real factor) { return 2 * factor - 1; }
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

/// Ends the contacts of bodies whose shape was replaced: they hold what was made for the old one. Returns whether there are any.
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

/// Erases all that is not real and trusts none of what was noted, so that every pair within reach is looked up in O.interactions.
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

/// D and D' of all regions.
void PlanarGridCollider::boundSpeeds()
{
	regions.differences(threads, velocities, rates);
	if (listed() < factor) regions.largestAround(rates, widestRates);
	else
		widestRates.assign(rates.size(), 0); // all within the reach are wanted, slow or fast
}

/// Whether pairs may be wanted that are not in the list.
bool PlanarGridCollider::moved()
{
	for (const Side& s : sides)
		for (const Real d : { s.box.xMin - s.reference.xMin, s.box.yMin - s.reference.yMin,
		                      s.box.xMax - s.reference.xMax, s.box.yMax - s.reference.yMax })
			if (!(std::abs(d) <= farPath)) return true;
	const long size  = (long)disks.size();
	bool       other = false;
	paths.resize(size);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : other)
	for (long id = 0; id < size; ++id) {
		paths[id] = { disks[id].x - reference[id].x, disks[id].y - reference[id].y };
		// one that had no place when the lists were made, as one that was no number, and has one now has come from farther than any bound
		other = other || disks[id].r != reference[id].r
		        || (isThere(disks[id])
		            && !(std::abs(paths[id].x) <= farPath && std::abs(paths[id].y) <= farPath));
	}
	if (other) return true;
	boundSpeeds();
	regions.differences(threads, paths, spreads);
	for (int s = 0; s < regions.count(); ++s)
		if (!(spreads[s] + foresight * scene->dt * widestRates[s] <= allowances[s])) return true;
	return false;
}

/// Looks pairs up, and keeps what is known of those that were there before.
void PlanarGridCollider::search()
{
	++searches;
	std::swap(pairs, before);
	std::swap(known, knownBefore);
	Real smallest = std::numeric_limits<Real>::max(), largest = 0;
	for (const Disk& d : disks)
		if (d.r > 0) {
			smallest = std::min(smallest, d.r);
			largest  = std::max(largest, d.r);
		}
	const Real farthest = largest > 0 ? 2 * factor * largest : 1;
	const Real margin   = largest > 0 && verletDist < 0 ? -verletDist * smallest : std::max(Real(0), verletDist);
	farPath             = farthest / 4;
	regions.build(disks, farthest + 2 * farPath);
	boundSpeeds();
	allowances.resize(regions.count());
	for (int s = 0; s < regions.count(); ++s)
		allowances[s] = margin + scene->dt * (ahead * rates[s] + foresight * widestRates[s]);
	for (size_t id = 0; id < disks.size(); ++id)
		if (regions.of(int(id)) >= 0) disks[id].margin = allowances[regions.of(int(id))];
	reference = disks;
	grid.build(disks, listed() * (1 + 1e-8)); // more than rounding takes away
	grid.pairs(threads, pairs);
	known.assign(pairs.second.size(), 0);
	const long size = (long)std::min(disks.size(), before.begin.empty() ? 0 : before.begin.size() - 1);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long i = 0; i < size; ++i)
		for (int k = pairs.begin[i], b = before.begin[i]; k < pairs.begin[i + 1] && b < before.begin[i + 1];) {
			if (pairs.second[k] == before.second[b]) known[k++] = knownBefore[b++];
			else if (pairs.second[k] < before.second[b])
				++k;
			else
				++b;
		}
	searchSides();
	candidates = int(pairs.second.size() + sidePairs.size());
}

void PlanarGridCollider::searchSides()
{
	std::vector<SidePair> old;
	old.swap(sidePairs);
	std::vector<int> disksNear;
	for (size_t s = 0; s < sides.size(); ++s) {
		sides[s].reference = sides[s].box;
		grid.near(sides[s].box, reachAround(factor), 2 * farPath, disksNear);
		for (const int disk : disksNear)
			sidePairs.push_back({ int(s), disk, false });
	}
	const auto key = [](const SidePair& p) { return std::make_pair(p.side, p.disk); };
	auto       now = sidePairs.begin();
	for (const SidePair& pair : old) {
		while (now != sidePairs.end() && key(*now) < key(pair))
			++now;
		if (now != sidePairs.end() && key(*now) == key(pair)) now->known = pair.known;
		else if (pair.known)
			eraseIfUnreal(sides[pair.side].id, pair.disk);
	}
	resident->forgetErased(*scene->interactions);
}

/// Finds the pairs of disks within reach that are wanted and that O.interactions has not; and, where that decides it, how fast each disk is against those near it.
void PlanarGridCollider::findNear()
{
	const long size    = (long)disks.size();
	const bool decides = listed() < factor;
	fastest.assign(size, 0);
	near.resize(threads);
	fastestOf.resize(threads);
	for (int part = 0; part < threads; ++part) { // there may be fewer threads than asked for
		near[part].clear();
		if (decides) fastestOf[part].assign(size, 0);
	}
#pragma omp parallel num_threads(threads)
	{
		auto& comes = partOfThread(near);
		auto& speed = partOfThread(fastestOf);
#pragma omp for schedule(static)
		for (long i = 0; i < size; ++i) {
			const Disk a    = disks[i];
			const auto v    = velocities[i];
			Real       most = decides ? speed[i] : 0;
			for (int k = pairs.begin[i]; k < pairs.begin[i + 1]; ++k) {
				const int   j     = pairs.second[k];
				const Disk& b     = disks[j];
				const Real  reach = factor * (a.r + b.r), dx = b.x - a.x, dy = b.y - a.y,
				           apart = dx * dx + dy * dy;
				if (!(apart <= reach * reach * (1 + 1e-9))) {
					known[k] = 0; // the functor decides, with rounding of its own
					if (apart > reach * reach) continue;
				} else if (!known[k])
					comes.emplace_back(int(i), k);
				if (!decides) continue;
				const Real x = velocities[j].x - v.x, y = velocities[j].y - v.y, square = x * x + y * y;
				if (square <= std::min(most, speed[j]) || apart > reach * reach) continue;
				// by itself it must be wanted, so that it does not matter when pairs were looked up
				const Real sure = wantedWithin(int(i), j, 0); // most are within it, which needs no root
				if (apart > sure * sure) {
					const Real wanted = wantedWithin(int(i), j, std::sqrt(square));
					if (apart > wanted * wanted) continue;
				}
				most     = std::max(most, square);
				speed[j] = std::max(speed[j], square);
			}
			if (decides) speed[i] = most;
		}
		if (decides) {
#pragma omp for schedule(static)
			for (long i = 0; i < size; ++i) {
				for (const auto& p : fastestOf)
					fastest[i] = std::max(fastest[i], p[i]);
				fastest[i] = std::sqrt(fastest[i]);
			}
		}
		comes.erase(
		        std::remove_if(
		                comes.begin(), comes.end(),
		                [this](const auto& pair) { return !isWanted(pair.first, pair.second); }),
		        comes.end());
	}
}

/// Whether the pair at that place of its first disk is wanted now.
bool PlanarGridCollider::isWanted(int i, int place) const
{
	const int   j = pairs.second[place];
	const Disk &a = disks[i], &b = disks[j];
	const Real  x = b.x - a.x, y = b.y - a.y;
	return wants(i, j, std::sqrt(x * x + y * y));
}

/// Gives O.interactions the pairs of disks that were found.
void PlanarGridCollider::takeDisks()
{
	for (const auto& part : near) // threads have stretches of the list, one after the other
		for (const auto& [i, k] : part) {
			insert(i, pairs.second[k]);
			known[k] = 1;
		}
}

void PlanarGridCollider::takeSides()
{
	for (SidePair& pair : sidePairs) {
		const Disk& d = disks[pair.disk];
		if (pair.known || !isNear(sides[pair.side].box, d.x, d.y, reachAround(factor) * d.r)) continue;
		insert(std::min(sides[pair.side].id, pair.disk), std::max(sides[pair.side].id, pair.disk));
		pair.known = true;
	}
}

void PlanarGridCollider::insert(Body::id_t a, Body::id_t b)
{
	if (resident->bare > 0 && resident->isContact(std::min(a, b), std::max(a, b))) return;
	if (!nscd::mayCollide(*this, *Body::byId(a, scene), *Body::byId(b, scene)) || scene->interactions->found(a, b))
		return;
	if (mayBeBare(a, b)) {
		resident->proposed.push_back({ std::min(a, b), std::max(a, b), int(scene->iter) });
		return;
	}
	const auto interaction = boost::make_shared<Interaction>(a, b);
	scene->interactions->insert(interaction);
	if (resident->hasContacts()) resident->addPotential(interaction);
}

/// Whether the contact of a pair may do without an interaction, as far as its bodies tell: see NscdInteractionLoop.
bool PlanarGridCollider::mayBeBare(Body::id_t a, Body::id_t b) const
{
	const auto &first = resident->bodies[a], &second = resident->bodies[b];
	return resident->hasContacts() && first.plain && second.plain && first.planar && second.planar
	        && first.z == second.z && scene->iter <= std::numeric_limits<int>::max();
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
