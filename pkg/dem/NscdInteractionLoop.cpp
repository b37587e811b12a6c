#include "NscdInteractionLoop.hpp"
#include "Law2_ScGeom_NscdPhys_SignoriniCoulomb.hpp"
#include "PlanarGridCollider.hpp"
#include "PorePressureEngine.hpp"
#include "Prefetch.hpp"
#include "SceneCheck.hpp"
#include "StageClock.hpp"
#include "YadeFeatures.hpp"
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade {

YADE_PLUGIN((NscdInteractionLoop));

namespace {
	using nscd::fetch, nscd::later, nscd::soon;

	/// What Ig2_Sphere_Sphere_ScGeom writes and rigid contacts read, in the same order of operations.
	void updateGeometry(ScGeom& geom, const Vector3r& x1, const Vector3r& x2, Real r1, Real r2)
	{
		Vector3r   normal = x2 - x1;
		const Real norm   = normal.norm();
		normal /= norm;
		const Real overlap    = r1 + r2 - norm;
		geom.contactPoint     = x1 + (r1 - 0.5 * overlap) * normal;
		geom.penetrationDepth = overlap;
		geom.radius1          = r1;
		geom.radius2          = r2;
		geom.normal           = normal;
	}

	/// Makes what soft laws need of a contact of disks zero, so that a contact is the same whether it was made just now, some steps ago, or loaded.
	void forgetShear(const shared_ptr<Interaction>& I, Scene& scene)
	{
		if (typeid(*I->geom) != typeid(ScGeom) || !nscd::physOf(*I->phys)) return;
		auto& geom = static_cast<ScGeom&>(*I->geom);
		// a new contact has no axes, which nothing else can be asked to write; its shear increment is made of the velocities
		geom.precompute(*Body::byId(I->getId1(), &scene)->state, *Body::byId(I->getId2(), &scene)->state, &scene, I, Vector3r(geom.normal), true, Vector3r::Zero());
		geom.shearInc = Vector3r::Zero();
	}

	/// The one functor of this class, and not of one derived from it; null where there is none.
	template <class Functor, class List> const Functor* exactly(const List& functors)
	{
		for (const auto& f : functors)
			if (typeid(*f) == typeid(Functor)) return static_cast<const Functor*>(f.get());
		return nullptr;
	}

	string missing(const Interaction& I, const string& kind, const string& a, const string& b)
	{
		return "NscdInteractionLoop: bodies #" + std::to_string(I.getId1()) + " and #" + std::to_string(I.getId2()) + ": there is no functor " + kind + " for "
		        + a + " and " + b + ": add one to the list";
	}

	/// One interaction as YADE's loop treats it; returns false where it should be erased.
	bool visit(const shared_ptr<Interaction>& I, Scene& scene, InteractionLoop& loop)
	{
		const shared_ptr<Body>&b1_ = Body::byId(I->getId1(), &scene), &b2_ = Body::byId(I->getId2(), &scene);
		if (!b1_ || !b2_) return false;
		auto& cache = I->functorCache;
		if (b1_->isClump() || b2_->isClump() || !cache.geomExists || !b1_->shape || !b2_->shape) return true;
		bool swap = false;
		if (!cache.geom) {
			cache.geom = loop.geomDispatcher->getFunctor2D(b1_->shape, b2_->shape, swap);
			if (!cache.geom) {
				cache.geomExists = false;
				return true;
			}
		}
		for (const auto* b : { b1_.get(), b2_.get() })
			if (!b->material) throw std::runtime_error("NscdInteractionLoop: body #" + std::to_string(b->getId()) + " has no material: give it an NscdMat");
		if (swap) I->swapOrder();
		const shared_ptr<Body>&b1 = swap ? b2_ : b1_, &b2 = swap ? b1_ : b2_;
		const bool wasReal = I->isReal();
		if (!cache.geom->go(b1->shape, b2->shape, *b1->state, *b2->state, Vector3r::Zero(), false, I)) return !wasReal;
		if (!cache.phys) cache.phys = loop.physDispatcher->getFunctor2D(b1->material, b2->material, swap);
		if (!cache.phys) throw std::runtime_error(missing(*I, "Ip2", b1->material->getClassName(), b2->material->getClassName()));
		cache.phys->go(b1->material, b2->material, I);
		if (!wasReal) I->iterMadeReal = scene.iter;
		if (!cache.constLaw) cache.constLaw = loop.lawDispatcher->getFunctor2D(I->geom, I->phys, swap);
		if (!cache.constLaw) throw std::runtime_error(missing(*I, "Law2", I->geom->getClassName(), I->phys->getClassName()));
		return cache.constLaw->go(I->geom, I->phys, I.get());
	}
}

const NscdInteractionLoop* NscdInteractionLoop::before(const Engine& engine)
{
	const Scene& scene = *engine.scene;
	if (scene.subStepping) return nullptr;
	const NscdInteractionLoop* loop = nullptr;
	for (const auto& other : scene.engines) {
		if (other.get() == &engine) break;
		if (other->dead) continue;
		if (const auto* found = dynamic_cast<const NscdInteractionLoop*>(other.get())) loop = found;
		else if (!dynamic_cast<const PorePressureEngine*>(other.get())) // which only adds forces
			loop = nullptr;
	}
	const bool holds = loop && loop->hasRead(scene.iter) && loop->contactReadings().ids.size() == scene.interactions->size()
	        && loop->bodyReadings().size() == scene.bodies->size();
	return holds ? loop : nullptr;
}

const NscdInteractionLoop* NscdInteractionLoop::ofLastStep(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (const auto* loop = engine->dead ? nullptr : dynamic_cast<const NscdInteractionLoop*>(engine.get()))
			if (loop->hasRead(scene.iter - 1)) return loop;
	return nullptr;
}

void NscdInteractionLoop::action()
{
	const nscd::StageTimer timer(nscd::StageClock::of(*scene), nscd::Stage::Interactions);
	auto& list = *scene->interactions;
	readIn     = never; // until all is read; a step's number comes again after O.resetTime()
	if (!nscd::hasSolver(*scene))
		for (const auto& law : lawDispatcher->functors)
			if (dynamic_cast<const Law2_ScGeom_NscdPhys_SignoriniCoulomb*>(law.get())) throw std::runtime_error("NscdInteractionLoop: " + nscd::noSolver(*scene));
	if (scene->isPeriodic || loopOnSortedInteractions || !callbacks.empty() || list.iterColliderLastRun >= 0) {
		InteractionLoop::action();
		return;
	}
	lawDispatcher->scene = physDispatcher->scene = geomDispatcher->scene = scene;
	geomDispatcher->updateScenePtr();
	physDispatcher->updateScenePtr();
	lawDispatcher->updateScenePtr();

	const int threads = nscd::threadsOf(*this);
	const auto* collider = colliderBefore();
	if (!collider) nscd::readBodies(*scene, threads, ownBodies);
	bodies              = collider ? &collider->bodyReadings() : &ownBodies;
	const auto& places  = *bodies;
	// a functor that is used as it is may be replaced by what it does; one that a user derived from it may not
	const auto* spheres = exactly<Ig2_Sphere_Sphere_ScGeom>(geomDispatcher->functors);
	const auto* law     = exactly<Law2_ScGeom_NscdPhys_SignoriniCoulomb>(lawDispatcher->functors);

	const long  count = (long)list.size();
	std::string error; // thrown after the loop, since threads may not
	readings.resize(count);
#pragma omp parallel for schedule(static) num_threads(threads)
	for (long k = 0; k < count; ++k) {
		if (k + (long)later < count) fetch<sizeof(Interaction)>(list[k + later].get());
		if (k + (long)soon < count) {
			const Interaction& ahead = *list[k + soon];
			if (ahead.geom) fetch<nscd::partOfGeometry>(ahead.geom.get());
			if (ahead.phys) fetch<sizeof(NscdPhys)>(ahead.phys.get());
		}
		const shared_ptr<Interaction>& I = list[k];
		const auto &p1 = places[I->getId1()], &p2 = places[I->getId2()];
		if (p1.plain && p2.plain) {
			if (spheres && I->functorCache.geom.get() == spheres && !I->isReal()) {
				const Real reach = spheres->interactionDetectionFactor * (p1.radius + p2.radius);
				if (std::pow(reach, 2) - (p2.pos - p1.pos).squaredNorm() < 0) {
					readings.ids[k].first = -1;
					continue;
				}
			} else if (law && I->functorCache.constLaw.get() == law && I->functorCache.geom.get() == spheres && typeid(*I->phys) == typeid(NscdPhys)) {
				auto& geom = static_cast<ScGeom&>(*I->geom);
				auto& phys = static_cast<NscdPhys&>(*I->phys);
				updateGeometry(geom, p1.pos, p2.pos, p1.radius, p2.radius);
				const Real gap  = -geom.penetrationDepth;
				const bool swap = I->getId1() > I->getId2();
				if (phys.bonded) law->followBond(phys, gap, swap ? p2 : p1, swap ? p1 : p2);
				const bool wanted = !collider || phys.bonded || phys.breaks || collider->wants(I->getId1(), I->getId2(), p1.radius + p2.radius + gap);
				if (wanted && law->keeps(phys, gap)) {
					phys.updateThresholds(gap, law->adhesionRange);
					if (I->isActive) {
						readings.take(k, *I, geom, &phys);
						continue;
					}
				} else
					list.requestErase(I);
				readings.ids[k].first = -1;
				continue;
			}
		}
		try {
			if (!visit(I, *scene, *this)) list.requestErase(I);
			else if (p1.plain && p2.plain && I->isReal())
				forgetShear(I, *scene);
			readings.take(k, *I);
		} catch (const std::exception& e) {
#pragma omp critical
			error = e.what();
		}
	}
	if (!error.empty()) throw std::runtime_error(error);
	unreal.clear();
	for (long k = 0; k < count; ++k)
		if (readings.ids[k].first < 0 && !list[k]->isReal()) unreal.emplace_back(list[k]->getId1(), list[k]->getId2());
	if (!scene->subStepping) readIn = scene->iter; // or a script may change what was read before others use it
}

/// The collider whose readings of this step hold; null where another engine may have changed bodies since, or a script.
const PlanarGridCollider* NscdInteractionLoop::colliderBefore() const
{
	const PlanarGridCollider* collider = nullptr;
	for (const auto& engine : scene->engines) {
		if (engine.get() == this) break;
		if (!engine->dead) collider = dynamic_cast<const PlanarGridCollider*>(engine.get());
	}
	return collider && !scene->subStepping && collider->hasRead(scene->iter) ? collider : nullptr;
}

} // namespace yade
