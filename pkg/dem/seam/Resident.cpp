#include "Resident.hpp"
#include "PlaneMotion.hpp"
#include "Prefetch.hpp"
#include "Audience.hpp"
#include <chrono>
#include <lib/pyutil/gil.hpp>
#include <map>
#include <neighbours/bucket_sort.hpp>
#include <thread>

namespace yade::nscd {

namespace {
	double clockNow()
	{
		return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
	}

	/// Shows what a thread leaves when it ends: YADE starts one for each O.run, and O.pause() may end it behind our last look.
	struct ThreadEnd {
		std::weak_ptr<Resident> last;
		~ThreadEnd()
		{
			if (const auto resident = last.lock()) resident->show();
		}
	};
	thread_local ThreadEnd threadEnd;

	/// Whether a state has what was written into it, or read from it, the last time.
	bool isAs(const State& s, const BodyReading& known)
	{
		const auto& m = known.motion;
		return s.pos[0] == m.position.x && s.pos[1] == m.position.y && s.vel[0] == m.velocity.x
		        && s.vel[1] == m.velocity.y && s.angVel[2] == m.velocity.w && s.ori.z() == m.rotation.z
		        && s.ori.w() == m.rotation.w;
	}

	/// Brings the state of the body of that id up to date, but for one that is gone, or was changed by somebody else since it was as in `asShown`.
	void write(BodyReading& b, const shared_ptr<Body>& body, size_t id, std::vector<BodyReading>& asShown)
	{
		if (!b.moved) return;
		b.moved = false;
		if (!body || !body->state || (id < asShown.size() && !isAs(*body->state, asShown[id]))) return;
		setMotion(*body->state, b.motion);
		if (id < asShown.size()) asShown[id] = b;
	}
}

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
	found            = std::make_shared<Resident>();
	found->container = scene.bodies;
	return found;
}

void Resident::takeBodies(Scene& scene)
{
	const double begin = clockNow();
	readBodies(scene, threads, bodies);
	shaped.clear();
	for (size_t id = 0; id < bodies.size(); ++id)
		if (const BodyReading& b = bodies[id]; b.present && !(b.radius > 0) && !b.clumped)
			shaped.push_back(int(id));
	if (othersMayLook(scene)) asShown = bodies;
	else
		asShown.clear();
	bodiesOwned = true;
	costOfLook += clockNow() - begin;
}

void Resident::takeContacts(Scene& scene)
{
	const double begin = clockNow();
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
	nonsmooth::neighbours::sortIntoBuckets(bodies.size(), each, bucket, order);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < (long)bodies.size(); ++k)
		std::sort(order.begin() + bucket[k], order.begin() + bucket[k + 1], [](const Place& a, const Place& b) {
			return a.high < b.high;
		});
	const long count = (long)order.size();
	readings.resize(count);
	bonds.resize(count);
	surelySolved.resize(count);
	holders.clear();
	freeSlots.clear();
	strewn = 0;
	come.clear();
	gone.clear();
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
	costOfLook += clockNow() - begin;
}

void Resident::readSlot(const Found& found, int slot)
{
	Reading& r = readings[slot];
	read(found, r, bonds[slot]);
	surelySolved[slot] = false;
	if (r.phys && r.phys->touched) r.phys->touched = false;
}

/// Takes contacts again that only Python can have changed since they were shown; returns false where all interactions have to be gone through.
bool Resident::takeKnown(Scene& scene)
{
	const double begin = clockNow();
	auto&        list  = *scene.interactions;
	if (list.size() != order.size() + potential.size()) return false;
	const auto isThere = [&](const shared_ptr<Interaction>& i) {
		return i->linIx >= 0 && size_t(i->linIx) < list.size() && list[i->linIx] == i;
	};
	for (const Potential& p : potential)
		if (!isThere(p.interaction) || p.interaction->isReal()) return false;
	const long count = (long)order.size();
	bool       other = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : other)
	for (long k = 0; k < count; ++k) {
		if (k + (long)later < count) fetch<sizeof(Interaction)>(readings[order[k + later].slot].interaction);
		if (k + (long)soon < count && readings[order[k + soon].slot].phys)
			fetch<1>(&readings[order[k + soon].slot].phys->touched);
		const int     slot = order[k].slot;
		const Holder& held = holders[slot];
		Interaction&  i    = *held.interaction;
		Reading&      r    = readings[slot];
		if (!isThere(held.interaction) || i.geom != held.geom || i.phys != held.phys || i.getId1() != r.first)
			other = true;
		else if (r.keeper != Reading::Arrays || r.phys->touched)
			readSlot(look(i), slot);
		else {
			r.active = i.isActive;
			r.reacts = r.leftOut = false;
			surelySolved[slot]   = false;
		}
	}
	if (other) return false;
	contactsOwned = true;
	costOfLook += clockNow() - begin;
	return true;
}

void Resident::hold()
{
	if (held) return;
	held = true;
	holders.resize(readings.size());
	const long count = (long)readings.size();
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k)
		if (Interaction* i = readings[k].interaction)
			holders[k] = { boost::static_pointer_cast<Interaction>(i->shared_from_this()), i->geom,
				       i->phys };
}

void Resident::displace(size_t id, const nonsmooth::contact::Twist& d)
{
	BodyReading& b = bodies[id];
	if (b.planar) {
		nonsmooth::contact::plane::displace(b.motion, d);
		b.moved = true;
		return;
	}
	State& s = *(*container.lock())[id]->state;
	s.pos += Vector3r(d.x, d.y, 0);
	if (d.w != 0) s.ori = (Quaternionr(AngleAxisr(d.w, Vector3r::UnitZ())) * s.ori).normalized();
	readMotion(s, b);
}

void Resident::showBody(size_t id)
{
	if (bodies[id].moved) write(bodies[id], (*container.lock())[id], id, asShown);
}

void Resident::showBodies(const std::vector<int>& ids)
{
	std::vector<int> behind;
	for (const int id : ids)
		if (std::exchange(bodies[id].moved, false)) behind.push_back(id);
	const auto kept  = container.lock();
	const long count = (long)behind.size();
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		bodies[behind[k]].moved = true;
		write(bodies[behind[k]], (*kept)[behind[k]], behind[k], asShown);
	}
}

Vector3r Resident::contactPoint(const Reading& r) const
{
	if (r.wasRead || r.keeper != Reading::Arrays) return r.geom->contactPoint;
	const Vector3r at(places[r.first].x, places[r.first].y, bodies[r.first].z), normal(r.nx, r.ny, r.nz);
	return at + (bodies[r.first].radius - 0.5 * -r.gap) * normal;
}

/// Writes a contact that the arrays keep into its interaction, with the sums and products of the functor.
void Resident::showContact(int slot) const
{
	const Reading& r = readings[slot];
	if (r.keeper != Reading::Arrays || !r.phys || r.phys->touched) return;
	ScGeom&   geom = *r.geom;
	NscdPhys& phys = *r.phys;
	if (!r.wasRead) {
		geom.contactPoint     = contactPoint(r);
		geom.penetrationDepth = -r.gap;
		geom.radius1          = bodies[r.first].radius;
		geom.radius2          = bodies[r.second].radius;
		geom.normal           = Vector3r(r.nx, r.ny, r.nz);
		phys.adhesion         = r.adhesion;
		phys.currentFriction = phys.tangensOfFrictionAngle = r.friction;
		phys.currentRollingArm                             = r.rollingArm;
	}
	if (r.bonded) {
		phys.restGap   = r.restGap;
		phys.yieldPath = vectorOf(r.path);
		phys.yielded   = r.yielded;
	}
	if (r.reacts) writeReactions(r);
}

void Resident::show(const string& who, bool staysKnown)
{
	const std::lock_guard<std::recursive_mutex> guard(lock);
	const double                                begin = clockNow();
	const auto                                  kept  = container.lock();
	if (kept && contactsOwned) {
		const long count = (long)order.size();
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k) {
			if (k + (long)soon < count) {
				const Reading& ahead = readings[order[k + soon].slot];
				if (ahead.geom) fetch<partOfGeometry>(ahead.geom);
				if (ahead.phys) fetch<partOfPhysics>(ahead.phys);
			}
			showContact(order[k].slot);
		}
		if (staysKnown) hold();
	}
	contactsKnown = staysKnown && (contactsOwned || contactsKnown);
	if (kept && bodiesOwned) {
		const long count = (long)std::min(bodies.size(), kept->size());
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long id = 0; id < count; ++id) {
			if (id + (long)later < count) fetch<sizeof(Body)>((*kept)[id + later].get());
			if (id + (long)soon < count && (*kept)[id + soon])
				fetch<sizeof(State)>((*kept)[id + soon]->state.get());
			write(bodies[id], (*kept)[id], id,
			      asShown); // threads would wait for each other if each body asked for the container
		}
	}
	if (bodiesOwned || contactsOwned) {
		++shown;
		shownTo = who;
	}
	bodiesOwned = contactsOwned = false;
	lastShown                   = clockNow();
	costOfLook                  = lastShown - begin;
}

std::unique_lock<std::recursive_mutex> Resident::betweenTurns()
{
	++waiting;
	std::unique_lock<std::recursive_mutex> guard(lock);
	--waiting;
	return guard;
}

void Resident::showBetweenTurns()
{
	const auto guard = betweenTurns();
	show();
}

void Resident::showForSaving()
{
	const auto guard = betweenTurns();
	show("whoever saves");
	beingSaved = PyGILState_Check();
}

void Resident::showOnly(const std::vector<int>& ids)
{
	const auto guard = betweenTurns();
	if (contactsOwned) hold(); // a script may erase what the arrays point to
	if (!bodiesOwned) return;
	shownAlone.clear();
	for (const int id : ids)
		if (size_t(id) < bodies.size()) shownAlone.push_back(id);
	showBodies(shownAlone);
}

/// Takes the bodies again that were shown alone; all where one of them is another body now.
void Resident::takeShown(Scene& scene)
{
	const auto known = std::exchange(shownAlone, {});
	for (const int id : known) {
		BodyReading&      b   = bodies[id];
		const BodyReading now = readBody((*scene.bodies)[id].get());
		if (now.present != b.present || now.plain != b.plain || now.clumped != b.clumped) {
			show();
			takeBodies(scene);
			return;
		}
		b = now;
		if (size_t(id) < asShown.size()) asShown[id] = now;
	}
}

std::vector<double> Resident::disks()
{
	const auto          guard = betweenTurns();
	const auto          kept  = container.lock();
	std::vector<double> rows;
	const size_t        count = bodiesOwned ? bodies.size() : kept->size();
	rows.reserve(8 * count);
	for (size_t id = 0; id < count; ++id) {
		const BodyReading b = bodiesOwned ? bodies[id] : readBody((*kept)[id].get());
		if (!b.present || !(b.radius > 0)) continue;
		const auto& m = b.motion;
		rows.insert(
		        rows.end(),
		        { double(id), m.position.x, m.position.y, double(b.radius),
		          2 * std::atan2(m.rotation.z, m.rotation.w), m.velocity.x, m.velocity.y, m.velocity.w });
	}
	return rows;
}

int Resident::slotOf(const shared_ptr<Interaction>& interaction)
{
	int slot = int(readings.size());
	if (freeSlots.empty()) {
		readings.emplace_back();
		bonds.emplace_back();
		surelySolved.push_back(false);
		if (held) holders.emplace_back();
	} else {
		slot = freeSlots.back();
		freeSlots.pop_back();
	}
	if (held) holders[slot] = { interaction, interaction->geom, interaction->phys };
	return slot;
}

void Resident::addPotential(const shared_ptr<Interaction>& interaction)
{
	const auto [low, high] = std::minmax({ interaction->getId1(), interaction->getId2() });
	potential.push_back({ interaction, low, high });
}

void Resident::add(const shared_ptr<Interaction>& interaction)
{
	const int slot = slotOf(interaction), a = interaction->getId1(), b = interaction->getId2();
	readSlot(look(*interaction), slot);
	come.push_back({ std::min(a, b), std::max(a, b), slot });
}

void Resident::merge(InteractionContainer& list)
{
	if (come.empty() && gone.empty()) return;
	const auto before = [](const Place& a, const Place& b) {
		return std::make_pair(a.low, a.high) < std::make_pair(b.low, b.high);
	};
	std::sort(come.begin(), come.end(), before);
	std::sort(gone.begin(), gone.end());
	merged.clear();
	merged.reserve(order.size() + come.size());
	auto next    = come.begin();
	auto leaving = gone.begin();
	for (size_t k = 0; k < order.size(); ++k) {
		const Place& place = order[k];
		if (leaving != gone.end() && size_t(*leaving) == k) {
			++leaving;
			Reading&   r           = readings[place.slot];
			const auto interaction = list[r.interaction->linIx];
			list.requestErase(interaction);
			addPotential(interaction);
			r = Reading {};
			if (held) holders[place.slot] = {};
			freeSlots.push_back(place.slot);
			continue;
		}
		for (; next != come.end() && before(*next, place); ++next)
			merged.push_back(*next);
		merged.push_back(place);
	}
	merged.insert(merged.end(), next, come.end());
	strewn += come.size();
	come.clear();
	gone.clear();
	order.swap(merged);
	if (strewn > order.size() / 20) repack();
}

/// Puts slots into the order of contacts, which those that come and go leave: whoever goes through them in order then meets neighbours in memory.
void Resident::repack()
{
	const long count = (long)order.size();
	const auto pack  = [&](auto& items) {
                std::remove_reference_t<decltype(items)> sorted(count);
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k)
			sorted[k] = std::move(items[order[k].slot]);
		items.swap(sorted);
	};
	pack(readings);
	pack(bonds);
	pack(surelySolved);
	if (held) pack(holders);
	for (long k = 0; k < count; ++k)
		order[k].slot = int(k);
	freeSlots.clear();
	strewn = 0;
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
	return bodies.size() != scene.bodies->size() || !scene.bodies->checkedByCollider || list.dirty
	        || list.size() != interactionsSeen;
}

Turn::Turn(Engine& engine_, int threads)
        : engine(engine_)
        , data(Resident::of(*engine_.scene))
        , locked(data->lock, std::defer_lock)
{
	while (data->waiting > 0)
		std::this_thread::yield();
	locked.lock();
	while (data->beingSaved) {
		locked.unlock(); // whoever saves may look again
		const gilLock saved;
		locked.lock();
		data->beingSaved = false;
	}
	Scene& scene  = *engine.scene;
	data->threads = threads;
	if (data->isBehind(scene)) {
		if (data->bodiesOwned || data->contactsOwned) data->show();
		data->contactsKnown = false;
	}
	if (!data->bodiesOwned) data->takeBodies(scene);
	else if (!data->shownAlone.empty())
		data->takeShown(scene);
	if (data->contactsKnown && onlyPythonBefore(scene, engine)) data->takeKnown(scene);
	data->contactsKnown = false;
}

void Turn::end()
{
	Scene& scene  = *engine.scene;
	Viewer viewer = whoLooksAfter(scene, engine);
	if (viewer.name.empty() && othersMayLook(scene)) {
		// others may look at any time: as often as it costs a fiftieth, with what is taken again afterwards
		threadEnd.last = data;
		if (clockNow() - data->lastShown > std::max(0.05, 50 * data->costOfLook))
			viewer = { "others, now and then", true };
	}
	if (!viewer.name.empty()) data->show(viewer.name, viewer.isPython);
	data->interactionsSeen = scene.interactions->size();
	ended                  = true;
}

Turn::~Turn()
{
	if (!ended) data->show();
}

} // namespace yade::nscd
