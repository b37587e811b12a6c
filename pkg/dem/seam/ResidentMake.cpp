// Interactions of contacts that came while nobody looked: a bare contact has none until it is made, with all that the
// arrays know of it.
//
// What a bare contact has is in its state and, where it is bonded, in its marks; its strengths are those on which its
// bodies' materials agreed when it came, as they would be in its physics. An interaction is made where somebody may
// look, where its bond breaks, and where others than the arrays have to follow it.
#include "PlaneMotion.hpp"
#include "Prefetch.hpp"
#include "Resident.hpp"
#include <boost/make_shared.hpp>
#include <contact/plane/bond.hpp>

namespace yade::nscd {

namespace plane = nonsmooth::contact::plane;

int Resident::numberOf(const plane::Strengths& wanted)
{
	constexpr size_t most
	        = 256; // so that they are looked through quickly; contacts of more materials have interactions
	const auto at = std::find(strengths.begin(), strengths.end(), wanted);
	if (at != strengths.end()) return int(at - strengths.begin());
	if (strengths.size() == most) return -1;
	strengths.push_back(wanted);
	return int(strengths.size()) - 1;
}

/// The interaction of a bare contact, which is in no list yet.
shared_ptr<Interaction> Resident::interactionOf(int slot) const
{
	const ContactState& r           = states[slot];
	const auto          interaction = boost::make_shared<Interaction>(r.first, r.second);
	const auto          geom        = boost::make_shared<ScGeom>();
	const auto          phys        = boost::make_shared<NscdPhys>();
	*geom                           = *recipe.geom;
	Ip2_NscdMat_NscdMat_NscdPhys::setStrengths(*phys, strengths[r.number], r.length);
	if (r.bonded) {
		const auto& [marks, zone] = bonds[slot];
		phys->bonded              = true;
		phys->anchor1             = Vector3r(marks.first.x, marks.first.y, 0);
		phys->anchor2             = Vector3r(marks.second.x, marks.second.y, 0);
		phys->axis                = Vector3r(marks.normal.x, marks.normal.y, 0);
	}
	interaction->geom         = geom;
	interaction->phys         = phys;
	interaction->iterMadeReal = r.born;
	auto& cache               = interaction->functorCache;
	cache.geom                = recipe.geomFunctor;
	cache.phys                = recipe.physFunctor;
	cache.constLaw            = recipe.law;
	return interaction;
}

/// Puts it into YADE's list. The contact is lost where one of its bodies is gone, or somebody has put another
/// interaction in its place.
void Resident::insert(int slot, const shared_ptr<Interaction>& interaction)
{
	ContactState& r = states[slot];
	r.number        = -1; // that of its strengths is needed no longer
	if (!insert(interaction, r.born)) return;
	r.interaction = interaction.get();
	r.geom        = static_cast<ScGeom*>(interaction->geom.get());
	r.phys        = static_cast<NscdPhys*>(interaction->phys.get());
	r.bare        = false;
	if (held) hold(r, interaction);
	--bare;
}

/// The same of any interaction; returns false where it is not taken.
bool Resident::insert(const shared_ptr<Interaction>& interaction, int born)
{
	if (isGone(interaction->getId1()) || isGone(interaction->getId2()) || !interactions.lock()->insert(interaction))
		return false;
	interaction->iterBorn = born;
	++made;
	++interactionsSeen;
	return true;
}

/// Whether the body that was of that id has been taken out since the last turn; there may be another.
bool Resident::isGone(int id) const
{
	const auto  kept   = container.lock();
	const auto& erased = kept->erasedBodies;
	return !kept->exists(id) || std::find(erased.begin(), erased.end(), id) != erased.end();
}

void Resident::make(int slot)
{
	insert(slot, interactionOf(slot));
	showContact(slot);
}

void Resident::make(const Pair& pair)
{
	const auto interaction = boost::make_shared<Interaction>(pair.low, pair.high);
	if (insert(interaction, pair.born)) addPotential(interaction);
}

/// Makes the interactions of all bare contacts and pairs, but where a script has just ended all that there were.
void Resident::makeAll()
{
	const auto list = interactions.lock();
	if (!list || !container.lock() || (bare == 0 && proposed.empty())) return;
	if (bare > 0) {
		std::vector<int> slots = std::exchange(bareSlots, {});
		std::sort(slots.begin(), slots.end());
		slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
		const auto isNone = [&](int slot) {
			ContactState& r = states[slot];
			if (list->dirty && r.bare) r.number = -1;
			return !r.bare || r.isLost();
		};
		slots.erase(std::remove_if(slots.begin(), slots.end(), isNone), slots.end());
		const long                           count = (long)slots.size();
		std::vector<shared_ptr<Interaction>> all(count);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k)
			all[k] = interactionOf(slots[k]);
		for (long k = 0; k < count; ++k)
			insert(slots[k], all[k]);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k)
			showContact(slots[k]);
	}
	for (const Pair& pair : proposed)
		if (!list->dirty) make(pair);
	proposed.clear();
}

/// Puts YADE's list into the order of body ids, contacts first, so that it does not depend on when interactions were
/// made; and whoever walks along it meets neighbours in memory.
void Resident::sort()
{
	const auto list     = interactions.lock();
	const long contacts = (long)order.size(), count = contacts + (long)potential.size();
	if (!list || bare > 0 || (long)list->size() != count) return;
	const std::lock_guard<std::mutex> drawing(list->drawloopmutex); // YADE's viewer walks along it meanwhile
	const auto added = std::is_sorted_until(potential.begin(), potential.end(), isBefore<Potential>);
	std::sort(added, potential.end(), isBefore<Potential>);
	std::inplace_merge(potential.begin(), added, potential.end(), isBefore<Potential>);
	const auto wanted = [&](long k) {
		return k < contacts ? states[order[k].slot].interaction : potential[k - contacts].interaction.get();
	};
	long first = count; // that is not in its place
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : first)
	for (long k = 0; k < count; ++k)
		if (k < first && (*list)[k].get() != wanted(k)) first = k;
	std::vector<int> from(count - first);
	bool             all = true; // are there; or others, by a script in another thread
#pragma omp parallel for schedule(static) num_threads(threads) reduction(&& : all)
	for (long k = first; k < count; ++k) {
		if (k + (long)later < count) fetch<1>(&wanted(k + later)->linIx);
		int& place      = wanted(k)->linIx; // the list's own back-reference
		from[k - first] = place;
		all             = all && place >= first && place < count && (*list)[place].get() == wanted(k);
		place           = int(k);
	}
	if (!all) {
		for (long k = first; k < count; ++k)
			(*list)[k]->linIx = int(k);
		return;
	}
	std::vector<shared_ptr<Interaction>> moved(count - first);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = first; k < count; ++k)
		moved[k - first] = std::move((*list)[k]);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = first; k < count; ++k)
		(*list)[k] = std::move(moved[from[k - first] - first]);
}

void Resident::showBare(const std::function<void(const ContactState&, const Vector3r&)>& take)
{
	const auto guard = betweenTurns();
	show({ "a table", true, false });
	for (const Place& place : order)
		if (const ContactState& r = states[place.slot]; r.bare && !r.isLost()) take(r, contactPoint(r));
}

std::pair<int, int> Resident::bondBare()
{
	const auto guard = betweenTurns();
	show({ "bond()", true, false });
	const auto kept  = container.lock();
	int        count = 0, all = 0;
	for (const Place& place : order) {
		ContactState& r = states[place.slot];
		all += r.bare && r.bonded && !r.isLost();
		if (!r.bare || r.isLost() || r.bonded || isGone(r.first) || isGone(r.second)) continue;
		const auto& s = strengths[r.number];
		if (!s.bondable || r.gap > r.length * s.creationDistance) continue;
		// of the states, which a script may have changed since
		const auto first = motionOf(*(*kept)[r.first]->state), second = motionOf(*(*kept)[r.second]->state);
		bonds[place.slot] = { plane::markBond(first, second, { r.nx, r.ny }, bodies[r.second].radius),
			              { r.length * s.ellipseNormal, r.length * s.ellipseTangential } };
		r.bonded          = true;
		r.yielded = r.slid = r.rolled = r.strained = false;
		r.stale                                    = true;
		r.restGap                                  = plane::firstRestGap(r.gap);
		r.path                                     = {};
		++count;
	}
	return { count, all + count };
}

} // namespace yade::nscd
