#include "SpaceContacts.hpp"
#include "../seam/Prefetch.hpp"
#include "../seam/Recall.hpp"
#include "../seam/Resident.hpp"
#include "Vectors.hpp"
#include <neighbours/thread_part.hpp>
#include <pkg/common/InsertionSortCollider.hpp>

namespace yade::nscd {

namespace {
	SpaceContactState stateOf(Interaction& interaction)
	{
		SpaceContactState s;
		s.interaction = &interaction;
		s.geom        = static_cast<ScGeom*>(interaction.geom.get());
		IPhys& phys   = *interaction.phys;
		s.phys        = typeid(phys) == typeid(NscdSpacePhys) ? static_cast<NscdSpacePhys*>(&phys) : nullptr;
		return s;
	}
}

SpaceContacts& SpaceContacts::of(Resident& resident)
{
	if (!resident.inSpace) resident.inSpace = std::make_shared<SpaceContacts>();
	return static_cast<SpaceContacts&>(*resident.inSpace);
}

bool SpaceContacts::isSound(NscdSpacePhys& phys, const ScGeom& geom)
{
	if (!std::isfinite(geom.normal.sum())) return false;
	phys.hearReset();
	const bool makesSense = phys.makesSenseAtOnce() || !phys.senseless().first;
	return makesSense && !phys.unheard() && phys.length > 0;
}

bool SpaceContacts::canBeKept(const State& s)
{
	return s.phys && s.interaction->isActive && !s.phys->bonded && !s.phys->breaks && isSound(*s.phys, *s.geom);
}

void SpaceContacts::read(State& s, const std::vector<BodyState>& bodies)
{
	const int   id1 = s.interaction->getId1(), id2 = s.interaction->getId2();
	const auto& phys  = *s.phys;
	const bool  ball1 = bodies[id1].radius > 0, ball2 = bodies[id2].radius > 0;
	s.swapped        = ball1 && ball2 ? id1 > id2 : ball1;
	s.i              = s.swapped ? id2 : id1;
	s.j              = s.swapped ? id1 : id2;
	s.bonded         = phys.bonded;
	s.normal         = ours(s.geom->normal);
	s.point          = ours(s.geom->contactPoint);
	s.gap            = -s.geom->penetrationDepth;
	s.length         = phys.length;
	s.adhesion       = phys.adhesion;
	s.friction       = phys.currentFriction;
	s.rollingArm     = phys.currentRollingArm;
	s.twistingArm    = phys.currentTwistingArm;
	s.restitution    = phys.restitution;
	s.pressed        = phys.normal;
	s.shearForce     = ours(phys.shearForce);
	s.rollingTorque  = ours(phys.rollingTorque);
	s.twistingTorque = phys.twistingTorque;
	s.correction     = phys.correction;
}

void SpaceContacts::keep(State& s, const std::vector<BodyState>& bodies)
{
	read(s, bodies);
	s.residualAdhesion = s.phys->residualTensileForce;
	s.normalForce      = ours(s.phys->normalForce);
	s.tangential       = s.phys->tangential;
	s.torque           = s.phys->torque;
	s.phys->touched    = false; // from now on a sign of others
	s.kept             = true;
}

void SpaceContacts::writeReactions(const State& s)
{
	auto& phys          = *s.phys;
	phys.normal         = s.pressed;
	phys.normalForce    = theirs(s.normalForce);
	phys.shearForce     = theirs(s.shearForce);
	phys.tangential     = s.tangential;
	phys.rollingTorque  = theirs(s.rollingTorque);
	phys.torque         = s.torque;
	phys.twistingTorque = s.twistingTorque;
	phys.correction     = s.correction;
	phys.touched        = false;
	phys.noteForces();
}

void SpaceContacts::take(Scene& scene, const std::vector<BodyState>& bodies, int threadCount)
{
	const double begin = steadySeconds();
	threads            = threadCount;
	auto&      list    = *scene.interactions;
	const long count   = (long)list.size();
	const int  size    = (int)bodies.size();
	struct alignas(64) Found {
		std::vector<Place> real;
	};
	std::vector<Found> found(threads);
#pragma omp parallel num_threads(threads)
	{
		auto& real = nonsmooth::neighbours::partOfThread(found).real;
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			if (k + (long)later < count) fetch<sizeof(Interaction)>(list[k + later].get());
			const Interaction& I = *list[k];
			if (!I.isReal()) continue;
			const auto [low, high] = std::minmax({ I.getId1(), I.getId2() });
			if (low >= 0 && high < size) real.push_back({ low, high, int(k) });
		}
	}
	const auto each = [&](auto use) {
		for (const auto& part : found)
			for (const Place& place : part.real)
				use(place.low, place);
	};
	std::vector<int> begins;
	orderByIds(bodies.size(), each, threads, begins, order);
	letAllGo();
	const long all = (long)order.size();
	states.resize(all);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < all; ++k) {
		if (k + (long)later < all) fetch<sizeof(Interaction)>(list[order[k + later].slot].get());
		if (k + (long)soon < all) fetch<1>(list[order[k + soon].slot]->phys.get());
		states[k] = stateOf(*list[order[k].slot]); // its place in the list, so far
	}
	for (long k = 0; k < all; ++k)
		order[k].slot = int(k);
	freeSlots.clear();
	strewn   = 0;
	areKnown = false;
	areOwned = true;
	looks.takeAgain(begin);
}

SpaceContacts::Stamp SpaceContacts::stampOf(const Scene& scene)
{
	Stamp stamp { scene.interactions->size(), 0 };
	for (const auto& engine : scene.engines) {
		if (engine->dead || !dynamic_cast<const Collider*>(engine.get())) continue;
		const auto* sorts = dynamic_cast<const InsertionSortCollider*>(engine.get());
		// of others it cannot be told whether they have acted
		stamp.looks += sorts ? sorts->numAction : scene.iter;
	}
	return stamp;
}

bool SpaceContacts::follow(Scene& scene)
{
	const Stamp now = stampOf(scene);
	if (areKnown && now == seen) return true;
	seen     = now;
	areKnown = true;
	return notePotential(*scene.interactions);
}

bool SpaceContacts::notePotential(InteractionContainer& list)
{
	const long count = (long)list.size();
	struct alignas(64) Found {
		std::vector<Potential> potential;
	};
	std::vector<Found> found(threads);
	long               real = 0;
#pragma omp parallel num_threads(threads) reduction(+ : real)
	{
		auto& own = nonsmooth::neighbours::partOfThread(found).potential;
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			if (k + (long)later < count) fetch<sizeof(Interaction)>(list[k + later].get());
			const Interaction& I   = *list[k];
			const auto [low, high] = std::minmax({ I.getId1(), I.getId2() });
			if (I.isReal()) ++real;
			else
				own.push_back({ int(k), low, high, false });
		}
	}
	potential.clear();
	for (const auto& part : found)
		potential.insert(potential.end(), part.potential.begin(), part.potential.end());
	return real == (long)order.size();
}

void SpaceContacts::change(
        Scene& scene, const std::vector<std::size_t>& begun, const std::vector<std::size_t>& ended,
        const std::function<void(State&)>& keep)
{
	auto&                  list = *scene.interactions;
	std::vector<Potential> left;
	for (const std::size_t k : ended) {
		const Place& place = order[k];
		State&       s     = states[place.slot];
		// held where another thread may have taken it out of the list
		const auto I = holders.empty() ? list[s.interaction->linIx] : holders[place.slot].interaction;
		left.push_back({ I->linIx, place.low, place.high, s.kept });
		end(I, list);
		if (!holders.empty()) holders[place.slot].letGo();
		s = {};
		freeSlots.push_back(place.slot);
	}
	eraseAt(order, ended);
	std::vector<Place> added;
	for (const std::size_t k : begun) {
		const auto& p    = potential[k];
		const auto& I    = list[p.place];
		const bool  held = !holders.empty();
		const int   slot = freeSlot();
		states[slot]     = stateOf(*I);
		if (held) holders[slot] = Holder::of(*I);
		keep(states[slot]);
		added.push_back({ p.low, p.high, slot });
	}
	eraseAt(potential, begun);
	potential.insert(potential.end(), left.begin(), left.end());
	std::sort(added.begin(), added.end(), isBefore<Place>);
	mergeInto(
	        order.size(), added.size(), [&](size_t o, size_t a) { return isBefore(added[a], order[o]); },
	        [&](size_t a, size_t to) { order[to] = added[a]; }, order);
	strewn += added.size();
	if (!areStrewn(strewn, order)) return;
	packBySlot(order, threads, states, holders);
	freeSlots.clear();
	strewn = 0;
}

int SpaceContacts::freeSlot()
{
	if (freeSlots.empty()) {
		states.emplace_back();
		if (!holders.empty()) holders.emplace_back();
		return int(states.size()) - 1;
	}
	const int slot = freeSlots.back();
	freeSlots.pop_back();
	return slot;
}

void SpaceContacts::end(const shared_ptr<Interaction>& interaction, InteractionContainer& list)
{
	nscd::letGo(interaction->geom);
	nscd::letGo(interaction->phys);
	list.requestErase(interaction);
}

void SpaceContacts::lookAgain(int slot)
{
	Interaction& I = *states[slot].interaction;
	if (I.phys.get() == states[slot].phys && I.geom.get() == states[slot].geom) return;
	states[slot] = stateOf(I);
	if (holders.empty()) return;
	nscd::letGo(holders[slot].geom);
	nscd::letGo(holders[slot].phys);
	holders[slot].geom = I.geom;
	holders[slot].phys = I.phys;
}

void SpaceContacts::show()
{
	if (!areOwned) return;
	const double begin = steadySeconds();
	const long   count = (long)order.size();
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		if (k + (long)soon < count) {
			const State& ahead = states[order[k + soon].slot];
			fetch<partOfGeometry>(ahead.geom);
			fetch<sizeof(NscdSpacePhys)>(ahead.phys);
		}
		const State& s = states[order[k].slot];
		if (!s.kept) continue;
		auto& geom            = *s.geom;
		auto& phys            = *s.phys;
		geom.normal           = theirs(s.normal);
		geom.penetrationDepth = -s.gap;
		geom.contactPoint     = theirs(s.point);
		if (phys.touched || phys.isWritten()) continue;
		phys.adhesion = s.adhesion;
		phys.yielded = phys.slid = phys.rolled = false;
		writeReactions(s);
	}
	areOwned = false;
	letAllGo();
	looks.look(begin);
}

void SpaceContacts::hold()
{
	if (!holders.empty()) return;
	const long count = (long)states.size();
	holders.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k)
		if (Interaction* I = states[k].interaction) holders[k] = Holder::of(*I);
}

void SpaceContacts::leaveAlone()
{
	if (!areOwned) return;
	hold();
	areKnown = false;
}

void SpaceContacts::letAllGo()
{
	for (Holder& one : holders)
		one.letGo();
	holders.clear();
}

} // namespace yade::nscd
