// How pairs of disks that the collider proposes become contacts: into the arrays, with the numbers that their functors
// would give them, or by these functors.
#include "../materials/Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "NscdInteractionLoop.hpp"
#include "../seam/Prefetch.hpp"
#include <contact/plane/disk_contact.hpp>
#include <core/Scene.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

namespace {
	using nscd::fetch, nscd::soon, nscd::ContactState;
	namespace plane = nonsmooth::contact::plane;
}

/// Pairs of disks that the collider has found, without interactions: those that come into contact are taken for bare
/// ones where the arrays may keep them, and get an interaction, which goes through its functors, where they may not.
/// The others stay.
void NscdInteractionLoop::takeProposed(nscd::Resident& resident, const Ours& ours, int threads)
{
	auto& proposed = resident.proposed;
	if (proposed.empty()) return;
	enum class Taken { No, Bare, ByFunctors };
	const bool                    able  = ours.spheres && ours.law && prepare(resident, proposed.front(), ours);
	const long                    count = (long)proposed.size(), looked = able ? count : 0;
	std::vector<Taken>            taken(count, Taken::ByFunctors);
	std::vector<ContactState>     states(looked);
	std::vector<plane::Strengths> strengths(looked);
	const auto&                   bodies = resident.bodies;
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < looked; ++k) {
		const auto& pair = proposed[k];
		if (k + (long)soon < count)
			for (const int id : { proposed[k + soon].low, proposed[k + soon].high })
				fetch<sizeof(Body)>((*scene->bodies)[id].get());
		const auto &p1 = bodies[pair.low], &p2 = bodies[pair.high];
		if (nscd::areBeyond(ours.spheres->interactionDetectionFactor, p1, p2)) {
			taken[k] = Taken::No;
			continue;
		}
		const auto agreed = Ip2_NscdMat_NscdMat_NscdPhys::lastingStrengths(
		        (*scene->bodies)[pair.low]->material.get(), (*scene->bodies)[pair.high]->material.get());
		const auto at = plane::diskContact(p1.motion.position, p2.motion.position, p1.radius, p2.radius);
		if (!agreed || !(at.distance > 0)) continue;
		const Real length = p1.radius + p2.radius;
		if (!ours.law->isWithinReach(at.gap, length)) {
			taken[k] = Taken::No;
			continue;
		}
		ContactState& r = states[k];
		r.first         = pair.low;
		r.second        = pair.high;
		r.nx            = at.nx;
		r.ny            = at.ny;
		r.gap           = at.gap;
		r.length        = length;
		r.keeper        = ContactState::Arrays;
		r.cohesive      = true;
		r.restitution   = agreed->restitution;
		r.bounces       = r.restitution > 0;
		r.wasRead       = false;
		r.born          = pair.born;
		strengths[k]    = *agreed;
		nscd::findThresholds(r, *agreed, ours.law->adhesionRange);
		if (r.usable) taken[k] = Taken::Bare;
	}
	std::vector<nscd::Resident::Pair> left;
	for (long k = 0; k < count; ++k) {
		if (taken[k] == Taken::Bare) {
			states[k].number = resident.numberOf(strengths[k]);
			if (states[k].number >= 0) {
				resident.add(states[k]);
				continue;
			}
		}
		if (taken[k] == Taken::No) left.push_back(proposed[k]);
		else
			resident.make(proposed[k]);
	}
	proposed.swap(left);
}

/// Notes what interactions of bare contacts go through; returns false where that would be others' functors.
bool NscdInteractionLoop::prepare(nscd::Resident& resident, const nscd::Resident::Pair& pair, const Ours& ours)
{
	auto&       recipe = resident.recipe;
	const auto &b1 = (*scene->bodies)[pair.low], &b2 = (*scene->bodies)[pair.high];
	bool        swap = false;
	if (!recipe.geom) {
		recipe.geom               = boost::make_shared<ScGeom>();
		recipe.geom->contactPoint = Vector3r::Zero();
		recipe.geom->refR1 = recipe.geom->refR2 = recipe.geom->penetrationDepth = 0;
		recipe.geom->precompute(State(), State(), scene, nullptr, Vector3r::Zero(), true, Vector3r::Zero());
		recipe.geom->shearInc = Vector3r::Zero();
	}
	shared_ptr<Material> material = boost::make_shared<NscdMat>();
	shared_ptr<IGeom>    geom     = recipe.geom;
	shared_ptr<IPhys>    phys     = boost::make_shared<NscdPhys>();
	nscd::letGo(recipe.geomFunctor);
	nscd::letGo(recipe.physFunctor);
	nscd::letGo(recipe.law);
	recipe.geomFunctor = geomDispatcher->getFunctor2D(b1->shape, b2->shape, swap);
	recipe.physFunctor = physDispatcher->getFunctor2D(material, material, swap);
	recipe.law         = lawDispatcher->getFunctor2D(geom, phys, swap);
	return recipe.geomFunctor.get() == ours.spheres && recipe.law.get() == ours.law && recipe.physFunctor
	        && typeid(*recipe.physFunctor) == typeid(Ip2_NscdMat_NscdMat_NscdPhys);
}

} // namespace yade
