// The loop where bodies move in space: contacts of spheres without their interactions while these are kept in the
// arrays, all others by their functors.
#include "../checks/UnguardedHeaders.hpp"
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "../seam/Prefetch.hpp"
#include "../seam/PythonMade.hpp"
#include "../space/SpaceContacts.hpp"
#include "../space/SphereGeometry.hpp"
#include "../space/Vectors.hpp"
#include "NscdInteractionLoop.hpp"
#include <contact/plane/thresholds.hpp>
#include <core/Scene.hpp>
#include <neighbours/thread_part.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>

namespace yade {

namespace {
	using nscd::fetch, nscd::soon, nscd::later;
}

void NscdInteractionLoop::actInSpace(nscd::Resident& resident, int threads)
{
	auto&      contacts = nscd::SpaceContacts::of(resident);
	const auto anew     = [&] {
                contacts.show();
                visitAll(resident, threads);
                contacts.take(*scene, resident.bodies, threads);
                keepAll(contacts, resident, threads);
	};
	if (!contacts.owned() || !contacts.follow(*scene) || !followKept(contacts, resident, threads)) anew();
}

/// Keeps a contact in the arrays from now on, where it is one of spheres that can be.
void NscdInteractionLoop::keep(nscd::SpaceContactState& s, const std::vector<nscd::BodyState>& bodies) const
{
	if (isOfSpheres(*s.interaction, bodies) && nscd::SpaceContacts::canBeKept(s))
		nscd::SpaceContacts::keep(s, bodies);
}

void NscdInteractionLoop::keepAll(nscd::SpaceContacts& contacts, const nscd::Resident& resident, int threads) const
{
	auto&      states = contacts.states;
	const long count  = (long)states.size();
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		if (k + (long)soon < count) {
			fetch<sizeof(ScGeom)>(states[k + soon].geom);
			fetch<sizeof(NscdSpacePhys)>(states[k + soon].phys);
		}
		keep(states[k], resident.bodies);
	}
}

/// All interactions there are, by their functors.
void NscdInteractionLoop::visitAll(const nscd::Resident& resident, int threads)
{
	auto&       list   = *scene->interactions;
	const auto& bodies = resident.bodies;
	const long  count  = (long)list.size();
	struct alignas(64) Part {
		std::vector<long> ended; // places in the list
	};
	std::vector<Part> parts(threads);
	std::string       error; // thrown after the loop, since threads may not
#pragma omp parallel num_threads(threads)
	{
		auto& ended = nonsmooth::neighbours::partOfThread(parts).ended;
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			if (k + (long)later < count) fetch<sizeof(Interaction)>(list[k + later].get());
			if (k + (long)soon < count && list[k + soon]->isReal()) {
				const Interaction& next = *list[k + soon];
				fetch<sizeof(ScGeom)>(next.geom.get());
				fetch<sizeof(NscdSpacePhys)>(next.phys.get());
				// between spheres the resident bodies do
				if (!ours.spheres || next.functorCache.geom.get() != ours.spheres)
					for (const int id : { next.getId1(), next.getId2() })
						fetch<sizeof(Body)>((*scene->bodies)[id].get());
			}
			const shared_ptr<Interaction>& I = list[k];
			if (!I->isReal() && areOutOfReach(*I, bodies)) continue;
			if (!visit(I, bodies, error)) ended.push_back(k);
		}
	}
	if (!error.empty()) throw std::runtime_error(error);
	for (const Part& part : parts)
		for (const long k : part.ended)
			nscd::SpaceContacts::end(list[k], list);
}

/// Brings a contact that is kept up to date, as its functors would; returns false where it has ended.
bool NscdInteractionLoop::follow(nscd::SpaceContactState& s, const std::vector<nscd::BodyState>& bodies) const
{
	const auto at = nscd::geometryOf(bodies[s.swapped ? s.j : s.i], bodies[s.swapped ? s.i : s.j]);
	s.normal      = nscd::ours(at.normal);
	s.point       = nscd::ours(at.point);
	s.gap         = -at.depth;
	if (!ours.law->isWithinReach(s.gap, s.length)) return false;
	s.adhesion = nonsmooth::contact::plane::touches(s.gap, ours.law->adhesionRange, s.length) ? s.residualAdhesion
	                                                                                          : 0;
	return true;
}

/// Contacts that are known, and interactions that may become contacts. Returns false where bodies are no longer what
/// they were, so that all must be visited anew.
bool NscdInteractionLoop::followKept(nscd::SpaceContacts& contacts, const nscd::Resident& resident, int threads)
{
	using Places          = std::vector<std::size_t>;
	auto&       list      = *scene->interactions;
	const auto& bodies    = resident.bodies;
	auto&       states    = contacts.states;
	auto&       potential = contacts.potential;
	const long  count = (long)contacts.order.size(), unreal = (long)potential.size();
	const auto  isPlain = [&](int id) { return id < (int)bodies.size() && bodies[id].present && bodies[id].plain; };
	bool        lost    = false;
	struct alignas(64) Part {
		Places begun, ended, refused; // the last ones by their place in the list
	};
	std::vector<Part> parts(threads);
	std::string       error; // thrown after the loop, since threads may not
#pragma omp parallel num_threads(threads) reduction(|| : lost)
	{
		auto& part = nonsmooth::neighbours::partOfThread(parts);
#pragma omp for schedule(static) nowait
		for (long k = 0; k < count; ++k) {
			const int slot = contacts.order[k].slot;
			auto&     s    = states[slot];
			if (s.kept && (!ours.spheres || !ours.law || !isPlain(s.i) || !isPlain(s.j))) lost = true;
			else if (s.kept) {
				if (!follow(s, bodies)) part.ended.push_back(k);
			} else if (!visit(list[s.interaction->linIx], bodies, error) || !s.interaction->isReal())
				part.ended.push_back(k);
			else {
				contacts.lookAgain(slot); // functors may have given it other objects
				keep(s, bodies);
			}
		}
#pragma omp for schedule(static)
		for (long k = 0; k < unreal; ++k) {
			auto& p = potential[k];
			if (p.ofSpheres && ours.spheres && isPlain(p.low) && isPlain(p.high)
			    && nscd::areBeyond(ours.spheres->interactionDetectionFactor, bodies[p.low], bodies[p.high]))
				continue;
			const shared_ptr<Interaction>& I = list[p.place];
			const bool near = !areOutOfReach(*I, bodies), stays = !near || visit(I, bodies, error);
			p.ofSpheres = ours.spheres && I->functorCache.geom.get() == ours.spheres;
			if (!stays) part.refused.push_back(p.place);
			else if (near && I->isReal())
				part.begun.push_back(k);
		}
	}
	if (!error.empty()) throw std::runtime_error(error);
	if (lost) return false;
	Places begun, ended;
	for (const Part& part : parts) {
		for (const std::size_t place : part.refused)
			nscd::SpaceContacts::end(list[place], list);
		begun.insert(begun.end(), part.begun.begin(), part.begun.end());
		ended.insert(ended.end(), part.ended.begin(), part.ended.end());
	}
	if (!begun.empty() || !ended.empty()) contacts.change(*scene, begun, ended, [&](auto& s) { keep(s, bodies); });
	return true;
}

} // namespace yade
