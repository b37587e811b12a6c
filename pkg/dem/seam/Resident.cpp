// How the arrays get what YADE's objects have, and how contacts come and go; what is written back: ResidentShow.cpp.
#include "Resident.hpp"
#include "StageClock.hpp"
#include "Audience.hpp"
#include "Prefetch.hpp"
#include <map>
#include <neighbours/thread_part.hpp>

namespace yade::nscd {

std::shared_ptr<Resident> Resident::of(Scene& scene)
{
	static std::mutex                                        mutex;
	static std::map<const Scene*, std::shared_ptr<Resident>> all;
	const std::lock_guard<std::mutex>                        guard(mutex);
	auto&                                                    found = all[&scene];
	if (found && found->container.lock() == scene.bodies) return found; // a new scene may lie where an old one was
	for (auto it = all.begin(); it != all.end();)
		it = it->first != &scene && (!it->second || it->second->container.expired()) ? all.erase(it)
		                                                                             : std::next(it);
	found               = std::make_shared<Resident>();
	found->container    = scene.bodies;
	found->interactions = scene.interactions;
	return found;
}

void Resident::takeBodies(Scene& scene)
{
	const double begin = steadySeconds();
	++taken;
	const auto changed = readBodies(scene, threads, bodies);
	if (inSpace && !changed.empty()) inSpace->show(); // lengths follow sizes in the interactions
	followSizes(scene, changed);
	shaped.clear();
	driven.clear();
	struct alignas(64) Found {
		std::vector<int> shaped, driven;
	};
	std::vector<Found> parts(threads); // each in order, since each has a stretch of the bodies
#pragma omp parallel num_threads(threads)
	{
		Found& part = nonsmooth::neighbours::partOfThread(parts);
#pragma omp for schedule(static)
		for (long id = 0; id < (long)bodies.size(); ++id) {
			const BodyState& b = bodies[id];
			if (!b.present) continue;
			if (!(b.radius > 0) && !b.clumped) part.shaped.push_back(int(id));
			if (b.blocked & inPlane) part.driven.push_back(int(id));
		}
	}
	for (const Found& part : parts) {
		shaped.insert(shaped.end(), part.shaped.begin(), part.shaped.end());
		driven.insert(driven.end(), part.driven.begin(), part.driven.end());
	}
	asShown.resize(othersMayLook(scene) ? bodies.size() : 0);
	for (size_t id = 0; id < asShown.size(); ++id)
		asShown[id] = { bodies[id].motion, (*scene.bodies)[id] };
	bodiesOwned = true;
	looks.takeAgain(begin);
}

void Resident::takeContacts(Scene& scene)
{
	makeAll();
	const double begin = steadySeconds();
	auto&        list  = *scene.interactions;
	const int    size  = int(bodies.size());
	const long   all   = (long)list.size();
	found.resize(all);
	long unreal = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : unreal)
	for (long k = 0; k < all; ++k) {
		if (k + (long)later < all) fetch<sizeof(Interaction)>(list[k + later].get());
		found[k] = look(*list[k]);
		unreal += !found[k].geom;
	}
	const auto each = [&](auto take) {
		for (long k = 0; k < all; ++k) {
			const int low  = std::min(found[k].first, found[k].second),
			          high = std::max(found[k].first, found[k].second);
			if (found[k].geom && low >= 0 && high < size) take(low, Place { low, high, int(k) });
		}
	};
	orderByIds(bodies.size(), each, threads, bucket, order);
	const long count = (long)order.size();
	states.resize(count);
	bonds.resize(count);
	rests.resize(count);
	surelySolved.resize(count);
	for (Holder& one : holders)
		one.letGo();
	holders.clear();
	freeHolders.clear();
	freeSlots.clear();
	strewn = 0;
	come.clear();
	gone.clear();
	proposed.clear();
	strengths.clear();
	bareSlots.clear();
	bare = 0;
	held = false;
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		if (k + (long)soon < count) {
			const Found& ahead = found[order[k + soon].slot];
			fetch<partOfGeometry>(ahead.geom);
			fetch<sizeof(NscdPhys)>(ahead.phys);
		}
		readSlot(found[order[k].slot], int(k));
	}
	for (long k = 0; k < count; ++k)
		order[k].slot = int(k);
	potential.clear();
	for (long k = 0; unreal > 0 && k < all; ++k)
		if (!found[k].geom) addPotential(list[k]);
	contactsOwned = true;
	looks.takeAgain(begin);
}

void Resident::readSlot(const Found& found, int slot)
{
	ContactState& r      = states[slot];
	const int     number = r.number; // of its holder, which stays
	read(found, r, bonds[slot], rests[slot]);
	r.number           = number;
	surelySolved[slot] = false;
	if (!r.phys) return;
	if (r.phys->touched) r.phys->touched = false;
	r.phys->hearReset();
}

/// Takes contacts again that only Python can have changed since they were shown; returns false where all interactions
/// have to be gone through.
bool Resident::takeKnown(Scene& scene)
{
	const double begin = steadySeconds();
	auto&        list  = *scene.interactions;
	if (list.size() != order.size() - bare + potential.size()) return false;
	const auto isThere = [&](const shared_ptr<Interaction>& i) {
		return i->linIx >= 0 && size_t(i->linIx) < list.size() && list[i->linIx] == i;
	};
	for (const Potential& p : potential)
		if (!isThere(p.interaction) || p.interaction->isReal()) return false;
	const long count = (long)order.size();
	bool       other = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : other)
	for (long k = 0; k < count; ++k) {
		if (k + (long)later < count) fetch<sizeof(Interaction)>(states[order[k + later].slot].interaction);
		if (k + (long)soon < count && states[order[k + soon].slot].phys)
			fetch<partWritten>(states[order[k + soon].slot].phys);
		const int     slot = order[k].slot;
		ContactState& r    = states[slot];
		if (r.bare) { // nobody could change it
			other              = other || r.isLost();
			surelySolved[slot] = false;
			continue;
		}
		const Holder& held = holders[r.number];
		Interaction&  i    = *held.interaction;
		if (!isThere(held.interaction) || i.geom != held.geom || i.phys != held.phys || i.getId1() != r.first)
			other = true;
		else if (r.keeper != ContactState::Arrays || r.phys->touched || r.phys->isWritten())
			readSlot(look(i), slot);
		else {
			r.active = i.isActive;
			r.reacts = r.leftOut = false;
			surelySolved[slot]   = false;
		}
	}
	if (other) return false;
	contactsOwned = true;
	looks.takeAgain(begin);
	return true;
}

void Resident::hold()
{
	if (held) return;
	held      = true;
	int count = 0;
	for (ContactState& r : states)
		if (r.interaction) r.number = count++;
	holders.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (size_t k = 0; k < states.size(); ++k)
		if (Interaction* i = states[k].interaction) holders[states[k].number] = Holder::of(*i);
}

void Resident::hold(ContactState& state, const shared_ptr<Interaction>& interaction)
{
	if (freeHolders.empty()) {
		freeHolders.push_back(int(holders.size()));
		holders.emplace_back();
	}
	state.number = freeHolders.back();
	freeHolders.pop_back();
	holders[state.number] = { interaction, interaction->geom, interaction->phys };
}

int Resident::freeSlot()
{
	if (freeSlots.empty()) {
		states.emplace_back();
		bonds.emplace_back();
		rests.emplace_back();
		surelySolved.push_back(false);
		return int(states.size()) - 1;
	}
	const int slot = freeSlots.back();
	freeSlots.pop_back();
	return slot;
}

void Resident::addPotential(const shared_ptr<Interaction>& interaction)
{
	const auto [low, high] = std::minmax({ interaction->getId1(), interaction->getId2() });
	potential.push_back({ interaction, low, high });
}

void Resident::add(const shared_ptr<Interaction>& interaction)
{
	const int slot = freeSlot(), a = interaction->getId1(), b = interaction->getId2();
	readSlot(look(*interaction), slot);
	if (held) hold(states[slot], interaction);
	come.push_back({ std::min(a, b), std::max(a, b), slot });
}

void Resident::add(const ContactState& state)
{
	const int slot     = freeSlot();
	states[slot]       = state;
	surelySolved[slot] = false;
	states[slot].bare  = true;
	++bare;
	bareSlots.push_back(slot);
	come.push_back({ state.first, state.second, slot });
}

bool Resident::isContact(int low, int high) const
{
	const auto at = std::lower_bound(order.begin(), order.end(), Place { low, high, 0 }, isBefore<Place>);
	return at != order.end() && at->low == low && at->high == high && !states[at->slot].isLost();
}

void Resident::merge(InteractionContainer& list)
{
	if (come.empty() && gone.empty()) return;
	std::sort(come.begin(), come.end(), isBefore<Place>);
	std::sort(gone.begin(), gone.end());
	merged.clear();
	merged.reserve(order.size() + come.size());
	const auto leave = [&](const Place& place) {
		ContactState& r = states[place.slot];
		if (r.bare) {
			proposed.push_back({ place.low, place.high, r.born });
			--bare;
		} else {
			const auto interaction = list[r.interaction->linIx];
			nscd::letGo(interaction->geom);
			nscd::letGo(interaction->phys);
			list.requestErase(interaction);
			addPotential(interaction);
		}
		if (held && !r.bare) {
			holders[r.number].letGo();
			freeHolders.push_back(r.number);
		}
		r = ContactState {};
		freeSlots.push_back(place.slot);
	};
	auto       at = order.begin(), next = come.begin();
	auto       leaving  = gone.begin();
	const auto takeUpTo = [&](auto end) { // of those that stay, which are almost all
		merged.insert(merged.end(), at, end);
		at = end;
	};
	while (next != come.end() || leaving != gone.end()) {
		const auto left   = leaving == gone.end() ? order.end() : order.begin() + *leaving;
		const auto before = next == come.end() ? order.end()
		                                       : std::lower_bound(at, order.end(), *next, isBefore<Place>);
		takeUpTo(std::min(left, before));
		if (leaving != gone.end() && at == left) {
			leave(*at++);
			++leaving;
		} else
			merged.push_back(*next++);
	}
	takeUpTo(order.end());
	strewn += come.size();
	come.clear();
	gone.clear();
	order.swap(merged);
	if (areStrewn(strewn, order)) repack();
}

/// Puts slots into the order of contacts, which those that come and go leave: whoever goes through them in order then
/// meets neighbours in memory.
void Resident::repack()
{
	packBySlot(order, threads, states, bonds, rests, surelySolved);
	freeSlots.clear();
	strewn = 0;
	bareSlots.clear();
	for (size_t k = 0; bare > 0 && k < states.size(); ++k)
		if (states[k].bare) bareSlots.push_back(int(k));
}

void Resident::forgetErased(InteractionContainer& list)
{
	const auto isErased = [&](const Potential& p) { return list.find(p.low, p.high) != p.interaction; };
	potential.erase(std::remove_if(potential.begin(), potential.end(), isErased), potential.end());
}

/// Whether a script in another thread has put in or taken out bodies or interactions since the last turn.
bool Resident::isBehind(const Scene& scene) const
{
	auto& list = *scene.interactions;
	// without redirection nobody tells of bodies that come and go
	return bodies.size() != scene.bodies->size() || !scene.bodies->checkedByCollider
	        || !scene.bodies->enableRedirection || list.dirty || list.size() != interactionsSeen;
}

} // namespace yade::nscd
