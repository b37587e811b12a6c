// How YADE's objects get what the arrays have, all of them or some.
#include "SameBody.hpp"
#include "StageClock.hpp"
#include "PlaneMotion.hpp"
#include "Prefetch.hpp"
#include "Resident.hpp"
#include <algorithm>
#include <core/Omega.hpp>
#include <lib/pyutil/gil.hpp>
#include <numeric>

namespace yade::nscd {

namespace {
	/// Writes a motion into a state, but for those of its numbers that somebody else has set since they were as in
	/// `shown`; these are taken up when bodies are read again. A script sets state.vel as a whole, or state.vel[0]
	/// alone.
	void
	setUntouched(State& s, const nonsmooth::contact::plane::Motion& m, nonsmooth::contact::plane::Motion& shown)
	{
		const auto set = [](Real& number, Real now, Real& known) {
			if (number == known) number = known = now;
		};
		set(s.pos[0], m.position.x, shown.position.x);
		set(s.pos[1], m.position.y, shown.position.y);
		set(s.vel[0], m.velocity.x, shown.velocity.x);
		set(s.vel[1], m.velocity.y, shown.velocity.y);
		set(s.angVel[2], m.velocity.w, shown.velocity.w);
		if (s.ori.z() != shown.rotation.z || s.ori.w() != shown.rotation.w) return;
		s.ori.z() = shown.rotation.z = m.rotation.z;
		s.ori.w() = shown.rotation.w = m.rotation.w;
	}

	/// Brings the state of the body of that id up to date, but for one that is gone, and what was changed by
	/// somebody else since it was as in `asShown`.
	void write(BodyState& b, const shared_ptr<Body>& body, size_t id, std::vector<Resident::Shown>& asShown)
	{
		if (!b.moved) return;
		b.moved = false;
		if (!body || !body->state) return;
		if (id >= asShown.size()) setMotion(*body->state, b.motion);
		else if (isSame(asShown[id].body, body))
			setUntouched(*body->state, b.motion, asShown[id].motion);
	}
}

void Resident::displace(size_t id, const nonsmooth::contact::Twist& d)
{
	BodyState& b = bodies[id];
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
	for (size_t k = 0; k < ids.size(); ++k) {
		if (k + later < ids.size()) fetch<1>(&bodies[ids[k + later]].moved);
		if (std::exchange(bodies[ids[k]].moved, false)) behind.push_back(ids[k]);
	}
	const auto kept  = container.lock();
	const long count = (long)behind.size();
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		if (k + (long)later < count) fetch<sizeof(Body)>((*kept)[behind[k + later]].get());
		if (k + (long)soon < count)
			if (const auto& body = (*kept)[behind[k + soon]]) fetch<sizeof(State)>(body->state.get());
		bodies[behind[k]].moved = true;
		write(bodies[behind[k]], (*kept)[behind[k]], behind[k], asShown);
	}
}

Vector3r Resident::contactPoint(const ContactState& r) const
{
	if (r.wasRead || r.keeper != ContactState::Arrays) return r.geom->contactPoint;
	const Vector3r at(places[r.first].x, places[r.first].y, bodies[r.first].z), normal(r.nx, r.ny, r.nz);
	return at + (bodies[r.first].radius - 0.5 * -r.gap) * normal;
}

/// Writes a contact that the arrays keep into its interaction, with the sums and products of the functor. What somebody
/// has written into its physics since it was read stays, and is read again.
void Resident::showContact(int slot) const
{
	const ContactState& r = states[slot];
	if (r.keeper != ContactState::Arrays || !r.phys) return;
	ScGeom&    geom      = *r.geom;
	NscdPhys&  phys      = *r.phys;
	const bool isWritten = phys.touched || phys.isWritten();
	if (!r.wasRead) {
		geom.contactPoint     = contactPoint(r);
		geom.penetrationDepth = -r.gap;
		geom.radius1          = bodies[r.first].radius;
		geom.radius2          = bodies[r.second].radius;
		geom.normal           = Vector3r(r.nx, r.ny, r.nz);
	}
	if (!r.wasRead && !isWritten) {
		phys.adhesion        = r.adhesion;
		phys.currentFriction = phys.tangensOfFrictionAngle = r.friction;
		phys.currentRollingArm                             = r.rollingArm;
	}
	phys.joins = r.joins; // of a bond that broke since, too
	if (r.bonded && phys.bonded) {
		phys.restGap   = r.restGap;
		phys.yieldPath = vectorOf(r.path);
		phys.yielded   = r.yielded;
		phys.slid      = r.slid;
		phys.rolled    = r.rolled;
		phys.restSlip  = r.strained ? rests[slot].slip : 0;
		phys.restTurn  = r.strained ? rests[slot].turn : 0;
		phys.errorSlip = r.slip; // which the loop has found for the solve of this step
		phys.errorTurn = r.turn;
	}
	if (r.reacts && !isWritten) writeReactions(r);
}

void Resident::show(const Look& look)
{
	const std::lock_guard<std::recursive_mutex> guard(lock);
	const double                                begin = steadySeconds();
	const auto                                  kept  = container.lock();
	const bool                                  all   = look.inSpace && hasContactsInSpace();
	if (all) inSpace->show();
	if (look.makes) makeAll();
	if (kept && contactsOwned) {
		const long count = (long)order.size();
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long k = 0; k < count; ++k) {
			if (k + (long)soon < count) {
				const ContactState& ahead = states[order[k + soon].slot];
				if (ahead.geom) fetch<partOfGeometry>(ahead.geom);
				if (ahead.phys) fetch<partOfPhysics>(ahead.phys);
			}
			showContact(order[k].slot);
		}
		if (look.staysKnown) hold();
	}
	if (look.sorts && (contactsOwned || contactsKnown)) sort(); // else what it goes by may be gone
	contactsKnown = look.staysKnown && (contactsOwned || contactsKnown);
	if (kept && bodiesOwned) {
		const long count = (long)std::min(bodies.size(), kept->size());
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long id = 0; id < count; ++id) {
			if (id + (long)later < count && bodies[id + later].moved)
				fetch<sizeof(Body)>((*kept)[id + later].get());
			if (id + (long)soon < count && bodies[id + soon].moved && (*kept)[id + soon])
				fetch<sizeof(State)>((*kept)[id + soon]->state.get());
			write(bodies[id], (*kept)[id], id,
			      asShown); // threads would wait for each other if each body asked for the container
		}
	}
	if (bodiesOwned || contactsOwned || all) {
		++shown;
		shownTo = look.who;
	}
	bodiesOwned = contactsOwned = false;
	shownAlone.clear();
	looks.look(begin);
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
	show({ "whoever saves" });
	if (Scene& scene = *Omega::instance().getScene(); !bodies.empty() && container.lock() == scene.bodies)
		followSizes(
		        scene,
		        readBodies(
		                scene, threads,
		                bodies)); // a radius that was changed since the last step is saved with what follows
	beingSaved = PyGILState_Check();
}

void Resident::showOnly(const std::vector<int>& ids)
{
	const auto guard = betweenTurns();
	if (inSpace) inSpace->leaveAlone();
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
		BodyState&      b   = bodies[id];
		const BodyState now = readBody((*scene.bodies)[id].get());
		if (now.present != b.present || now.plain != b.plain || now.clumped != b.clumped
		    || now.radius != b.radius || now.blocked != b.blocked) {
			show();
			takeBodies(scene);
			return;
		}
		b = now;
		if (size_t(id) < asShown.size()) asShown[id] = { now.motion, (*scene.bodies)[id] };
	}
}

void Resident::disks(const std::function<double*(size_t)>& room)
{
	constexpr size_t       columns = 8, chunk = 4096;
	const auto             guard = betweenTurns();
	std::vector<BodyState> shown; // where the arrays are not right
	if (!bodiesOwned) {
		const auto kept = container.lock();
		shown.resize(kept->size());
#pragma omp parallel for schedule(static) num_threads(threads)
		for (size_t id = 0; id < shown.size(); ++id)
			shown[id] = readBody((*kept)[id].get());
	}
	const auto&  all    = bodiesOwned ? bodies : shown;
	const auto   isDisk = [](const BodyState& b) { return b.present && b.radius > 0; };
	const size_t chunks = (all.size() + chunk - 1) / chunk;
	const auto   end    = [&](size_t part) { return std::min(all.size(), (part + 1) * chunk); };

	std::vector<size_t> before(chunks + 1, 0); // disks ahead of each chunk
#pragma omp parallel for schedule(static) num_threads(threads)
	for (size_t part = 0; part < chunks; ++part)
		before[part + 1] = std::count_if(all.begin() + part * chunk, all.begin() + end(part), isDisk);
	std::partial_sum(before.begin(), before.end(), before.begin());
	double* const rows = room(columns * before.back());
#pragma omp parallel for schedule(static) num_threads(threads)
	for (size_t part = 0; part < chunks; ++part) {
		double* row = rows + columns * before[part];
		for (size_t id = part * chunk; id < end(part); ++id) {
			const BodyState& b = all[id];
			if (!isDisk(b)) continue;
			const auto&  m               = b.motion;
			const double turned          = 2 * std::atan2(m.rotation.z, m.rotation.w);
			const double values[columns] = { double(id), m.position.x, m.position.y, double(b.radius),
				                         turned,     m.velocity.x, m.velocity.y, m.velocity.w };
			row                          = std::copy_n(values, columns, row);
		}
	}
}

} // namespace yade::nscd
