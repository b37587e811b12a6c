#include "BondEllipseEngine.hpp"
#include "../materials/BondEllipse.hpp"
#include "../seam/SameBody.hpp"
#include "../materials/WallPhys.hpp"
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>

namespace yade {

YADE_PLUGIN((BondEllipseEngine));

namespace {
	namespace plane = nonsmooth::contact::plane;

	struct Marks {
		Vector3r anchor1, anchor2, axis;
	};

	bool holds(const Interaction* contact)
	{
		if (!contact || !contact->isReal()) return false;
		if (const auto* phys = dynamic_cast<const CohFrictPhys*>(contact->phys.get()))
			return !phys->cohesionBroken;
		const auto* phys = dynamic_cast<const WallPhys*>(contact->phys.get());
		return phys && phys->bonded;
	}

	void breakBond(IPhys& physics, const Vector2r& residual)
	{
		if (auto* phys = dynamic_cast<CohFrictPhys*>(&physics)) {
			phys->SetBreakingState(true);
			phys->unp = 0; // from now on it presses when the disks touch, not where the bond did
			phys->tangensOfFrictionAngle = residual[0];
			phys->maxRollPl              = residual[1];
		} else
			static_cast<WallPhys&>(physics).bonded = false; // it knows its residual strengths
	}
}

void BondEllipseEngine::add(
        int id1, int id2, Real ellipseNormal, Real ellipseTangential, Real friction, Real rollingArm)
{
	scene          = Omega::instance().getScene().get(); // which an engine gets in a step alone
	const auto &b1 = Body::byId(id1, scene), &b2 = Body::byId(id2, scene);
	const auto  contact = scene->interactions->find(id1, id2);
	if (!b1 || !b2 || !contact || !holds(contact.get()))
		throw std::invalid_argument(
		        "BondEllipseEngine.add: bodies " + std::to_string(id1) + " and " + std::to_string(id2)
		        + " are not bonded");
	if (!(ellipseNormal > 0) || !(ellipseTangential > 0))
		throw std::invalid_argument("BondEllipseEngine.add: half-axes must be positive [m]");
	const auto     pair   = nscd::bondPair(*b1, *b2);
	const Vector3r normal = static_cast<const GenericSpheresContact&>(*contact->geom).normal;
	const auto&    second = static_cast<const Sphere&>(*pair.second->shape);
	const bool     along  = contact->getId1() == pair.first->getId();
	Marks          marks;
	nscd::markPoints(
	        marks, *pair.first->state, *pair.second->state, along ? normal : Vector3r(-normal), second.radius);
	learnContacts();
	contacts.push_back(contact);
	pairs.push_back(Vector2i(pair.first->getId(), pair.second->getId()));
	anchors1.push_back(marks.anchor1);
	anchors2.push_back(marks.anchor2);
	axes.push_back(marks.axis);
	ellipses.push_back(Vector2r(ellipseNormal, ellipseTangential));
	residuals.push_back(Vector2r(friction, rollingArm));
}

/// Those of a scene that was loaded are the contacts that are there.
void BondEllipseEngine::learnContacts()
{
	for (size_t k = contacts.size(); k < pairs.size(); ++k)
		contacts.push_back(scene->interactions->find(pairs[k][0], pairs[k][1]));
}

void BondEllipseEngine::action()
{
	learnContacts();
	size_t kept = 0;
	for (size_t k = 0; k < pairs.size(); ++k) {
		const auto contact = scene->interactions->find(pairs[k][0], pairs[k][1]);
		// a later contact may have the same ids
		if (!holds(contact.get()) || !nscd::isSame(contacts[k], contact)) continue;
		const auto displacement = nscd::bondDisplacement(
		        Marks { anchors1[k], anchors2[k], axes[k] }, *Body::byId(pairs[k][0], scene)->state,
		        *Body::byId(pairs[k][1], scene)->state);
		if (!plane::bondLives(displacement, { ellipses[k][0], ellipses[k][1] })) {
			breakBond(*contact->phys, residuals[k]);
			++broken;
			continue;
		}
		if (kept != k) {
			contacts[kept] = contacts[k], pairs[kept] = pairs[k], anchors1[kept] = anchors1[k],
			anchors2[kept] = anchors2[k];
			axes[kept] = axes[k], ellipses[kept] = ellipses[k], residuals[kept] = residuals[k];
		}
		++kept;
	}
	contacts.resize(kept), pairs.resize(kept), anchors1.resize(kept), anchors2.resize(kept), axes.resize(kept),
	        ellipses.resize(kept), residuals.resize(kept);
}

} // namespace yade
