// What a step's solution in space means for YADE: reactions and forces written back, and the sums over contacts and
// bodies.
#include "SpaceSeam.hpp"
#include "Vectors.hpp"
#include "../seam/Prefetch.hpp"
#include <contact/space/bond.hpp>
#include <core/Scene.hpp>

namespace yade::nscd {

namespace space = nonsmooth::contact::space;

namespace {
	Real kineticOf(Real mass, Real inertia, const space::Twist& t)
	{
		return 0.5 * (mass * dot(t.v, t.v) + inertia * dot(t.w, t.w));
	}
}

StepSums SpaceSeam::scatter(Scene& scene, const Vector3r& gravity)
{
	const size_t      count = solved.size(), ofContacts = chunksOf(count), ofBodies = chunksOf(bodies.size());
	std::vector<Sums> parts(ofContacts + ofBodies);
#pragma omp parallel num_threads(threads)
	{
		// by one thread, since a sum depends on its order; the others go on, and take more of what follows
#pragma omp single nowait
		sumReactions();
#pragma omp for schedule(dynamic, 1)
		for (long part = 0; part < (long)ofContacts; ++part)
			for (size_t k = part * sumChunk; k < std::min((part + 1) * sumChunk, count); ++k) {
				if (k + soon < count && !stateOf(k + soon).kept)
					fetch<sizeof(NscdSpacePhys)>(stateOf(k + soon).phys);
				scatterContact(k, parts[part]);
			}
#pragma omp for schedule(static)
		for (long part = 0; part < (long)ofBodies; ++part)
			for (size_t id = part * sumChunk; id < std::min((part + 1) * sumChunk, bodies.size()); ++id) {
				if (!bodies[id].present) continue;
				scatterBody(scene, id);
				sumBody(id, gravity, parts[ofContacts + part]);
			}
	}
	StepSums total;
	broken.clear();
	for (const Sums& part : parts) {
		total.add(part);
		broken.insert(broken.end(), part.breaks.begin(), part.breaks.end());
	}
	return total;
}

/// The sum of the contacts' impulses on every body, walls included.
void SpaceSeam::sumReactions()
{
	reaction.assign(bodies.size(), {});
	for (size_t k = 0; k < solved.size(); ++k) {
		const auto&         c    = problem.contacts[k];
		const auto&         p    = problem.impulses[k];
		auto&               ri   = reaction[c.i];
		auto&               rj   = reaction[c.j];
		const space::Vector turn = cross(c.n, p.f);
		ri.v                     = ri.v - p.f;
		ri.w                     = ri.w - (c.leverI * turn + cross(c.asideI, p.f) + p.m);
		rj.v                     = rj.v + p.f;
		rj.w                     = rj.w + (c.leverJ * turn + cross(c.asideJ, p.f) + p.m);
	}
}

/// A body's reactions go to O.forces, and it is moved by its displacement.
void SpaceSeam::scatterBody(Scene& scene, size_t id)
{
	const Real  h = relaxation.step;
	const auto& r = reaction[id];
	if (!isZero(r.v) || !isZero(r.w)) {
		scene.forces.addForceUnsynced(id, theirs(1 / h * r.v)); // into the sums, see gatherBodies
		scene.forces.addTorqueUnsynced(id, theirs(1 / h * r.w));
	}
	if (correction.displacements.empty()) return;
	const auto& d = correction.displacements[id];
	if (isZero(d.v) && isZero(d.w)) return;
	(*scene.bodies)[id]->state->pos += theirs(d.v);
}

void SpaceSeam::scatterContact(size_t k, Sums& sums)
{
	auto&       s = stateOf(k);
	const auto& c = problem.contacts[k];
	const auto& p = problem.impulses[k];
	const Real  h = relaxation.step, sign = s.swapped ? -1 : 1;
	const auto  rows = rowsOf(c, p);
	s.pressed        = rows.n / h;
	s.normalForce    = sign / h * rows.n * c.n;
	s.shearForce     = sign / h * rows.t;
	s.tangential     = std::sqrt(dot(rows.t, rows.t)) / h;
	s.rollingTorque  = sign / h * rows.r;
	s.torque         = std::sqrt(dot(rows.r, rows.r)) / h;
	s.twistingTorque = rows.s / h;
	s.correction     = correction.displacements.empty() ? 0 : correction.impulses[k];
	if (!s.kept) SpaceContacts::writeReactions(s);

	// work of the impulse over the step, exact for constant mass: P·(U⁻ + U⁺)/2
	const auto u0         = relativeVelocity(c, bodies[c.i].before, bodies[c.j].before),
	           u1         = relativeVelocity(c, problem.velocities[c.i], problem.velocities[c.j]);
	const Real normalWork = 0.5 * rows.n * (u0.n + u1.n), shearWork = 0.5 * dot(rows.t, u0.t + u1.t);
	const bool held = s.bonded && !space::yieldsInTension(c, rows, u1.n) && !s.phys->yielded;
	// tension in a bond that does not open loses nothing
	if (rows.n < 0 && held) sums.heldWork += normalWork;
	else
		(rows.n < 0 ? sums.debonding : sums.impact) -= normalWork;
	if (!s.kept) noteYield(s, c, rows, u1, sums);
	sums.sliding -= shearWork;
	sums.rolling -= 0.5 * dot(p.m, u0.w + u1.w);
	if (bodies[c.i].radius < 0 && shearWork != 0) sums.slidingOnWalls.emplace_back(c.i, -shearWork);
	if (s.restitution > 0 && !s.bonded && c.biasN > 0 && rows.n > 0)
		sums.missed -= s.restitution * s.restitution * std::min(Real(0), normalWork);
	const bool placed  = problem.inverseMass[c.i].isFixed() && problem.inverseMass[c.j].isFixed();
	const Real overlap = placed ? 0 : std::max(Real(0), -s.gap) / c.length;
	sums.overlap += overlap;
	if (overlap > sums.worstOverlap) {
		sums.worstOverlap = overlap;
		sums.worstIds[0]  = std::min(c.i, c.j);
		sums.worstIds[1]  = std::max(c.i, c.j);
	}
	sums.touching += rows.n != 0 || s.gap <= 0;
	sums.bonds += s.bonded;
}

/// What a step has made of a bond, and that one has broken.
void SpaceSeam::noteYield(
        const SpaceContactState& s, const space::Contact& c, const space::Rows& rows, const space::RelativeVelocity& u,
        Sums& sums) const
{
	auto& phys = *s.phys;
	if (phys.brokenMode != NscdPhys::None && phys.breaks) {
		++sums.broken[phys.brokenMode];
		sums.breaks.emplace_back(phys.brokenMode, s.interaction);
		phys.breaks = false;
	}
	phys.yielded = phys.slid = phys.rolled = false;
	if (!s.bonded) return;
	const auto y = space::yieldOfStep(c, rows, u, relaxation.step);
	phys.yielded = space::yieldsInTension(c, rows, u.n);
	phys.slid    = y.shear > 0;
	phys.rolled  = y.rolling > 0;
	phys.yieldPath += Vector3r(y.tension, y.shear, y.rolling);
	phys.twistingPath += y.twisting;
}

void SpaceSeam::sumBody(size_t id, const Vector3r& gravity, StepSums& sums) const
{
	const StepBody& b  = bodies[id];
	const auto&     m  = problem.inverseMass[id];
	const auto &    v0 = b.before, &v1 = problem.velocities[id], &r = reaction[id], &f = b.external;
	const Real      h    = relaxation.step;
	const auto      mean = space::Twist { 0.5 * (v0.v + v1.v), 0.5 * (v0.w + v1.w) };
	const auto given = [](Real inverseMass, Real force, Real speed) { return inverseMass > 0 ? 0 : force * speed; };
	const auto free  = [](Real inverseMass, Real force, Real speed) { return inverseMass > 0 ? force * speed : 0; };
	// where the motion is given, the work that the contacts do on it goes outside; elsewhere other engines' forces
	// work
	sums.wallWork -= given(m.x, r.v.x, mean.v.x) + given(m.y, r.v.y, mean.v.y) + given(m.z, r.v.z, mean.v.z)
	        + given(m.inertia.xx, r.w.x, mean.w.x) + given(m.inertia.yy, r.w.y, mean.w.y)
	        + given(m.inertia.zz, r.w.z, mean.w.z);
	if (m.isFixed()) return;
	sums.wallWork -= h * b.mass
	        * (given(m.x, gravity[0], v1.v.x) + given(m.y, gravity[1], v1.v.y) + given(m.z, gravity[2], v1.v.z));
	sums.external += h
	        * (free(m.x, f.v.x, mean.v.x) + free(m.y, f.v.y, mean.v.y) + free(m.z, f.v.z, mean.v.z)
	           + free(m.inertia.xx, f.w.x, mean.w.x) + free(m.inertia.yy, f.w.y, mean.w.y)
	           + free(m.inertia.zz, f.w.z, mean.w.z));
	const Vector3r at        = theirs(problem.positions[id]);
	const Real     potential = -b.mass * gravity.dot(at), moving = kineticOf(b.mass, b.inertia, v0);
	sums.kinetic += moving;
	sums.potential += potential;
	sums.size += moving + std::abs(potential);
	const bool          moved = !correction.displacements.empty();
	const space::Vector d     = moved ? correction.displacements[id].v : space::Vector {};
	sums.kineticLeft += kineticOf(b.mass, b.inertia, v1);
	sums.potentialLeft -= b.mass * gravity.dot(Vector3r(at + theirs(d) + h * theirs(v1.v)));
	sums.correction -= b.mass * gravity.dot(theirs(d));
	sums.mass += b.mass;
	sums.centre += b.mass * at;
	sums.momentum += b.mass * theirs(v1.v);
	const Real speed = std::sqrt(dot(v1.v, v1.v));
	sums.speed += speed;
	sums.largestSpeed = std::max(sums.largestSpeed, speed);
	++sums.bodies;
}

} // namespace yade::nscd
