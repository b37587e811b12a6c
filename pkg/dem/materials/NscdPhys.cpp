#include "NscdPhys.hpp"
#include "SlipSurfacePhys.hpp"
#include "../checks/Refusal.hpp"
#include "../checks/SceneCheck.hpp"
#include "../space/NscdSpacePhys.hpp"
#include "../checks/Seldom.hpp"
#include <boost/make_shared.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

YADE_PLUGIN((NscdPhys)(SlipWeakeningPhys)(Ip2_NscdMat_NscdMat_NscdPhys));
CREATE_LOGGER(Ip2_NscdMat_NscdMat_NscdPhys);

const char* NscdPhys::unheard() const
{
	if (kn != 0) return "kn";
	if (ks != 0) return "ks";
	if (overruled) return "tangensOfFrictionAngle";
	if (std::isnan(forcesNoted) || sumOfForces() == forcesNoted) return nullptr; // none of a step yet
	if (normalForce == Vector3r::Zero() && shearForce == Vector3r::Zero()) return nullptr;
	return "normalForce or shearForce";
}

std::pair<const char*, Real> NscdPhys::senseless() const
{
	using Named         = std::pair<const char*, Real>;
	const auto isGood   = [](Real value) { return value >= 0 && nscd::isNumber(value); };
	const auto isSpoilt = [&](Real value) { return !isGood(value) && !isGood(tangensOfFrictionAngle); };
	if (isSpoilt(friction) && isSpoilt(residualFriction))
		return { "tangensOfFrictionAngle", tangensOfFrictionAngle };
	for (const Named& one : { Named("normal", normal), Named("tangential", tangential), Named("torque", torque) })
		if (!nscd::isNumber(one.second)) return one;
	for (const Named& one :
	     { Named("residualTensileForce", residualTensileForce), Named("residualFriction", residualFriction),
	       Named("residualRollingArm", residualRollingArm), Named("tensileForce", tensileForce),
	       Named("friction", friction), Named("rollingArm", rollingArm) })
		if (!isGood(one.second)) return one;
	if (!(restitution >= 0 && restitution <= 1)) return { "restitution", restitution };
	if (!(creationDistance >= 0)) return { "creationDistance", creationDistance };
	// of a contact that came without materials, as a plate's guide, they are 0
	for (const Named& one :
	     { Named("ellipseNormal", ellipseNormal), Named("ellipseTangential", ellipseTangential) })
		if (bonded && !(one.second > 0)) return one;
	return { nullptr, 0 };
}

void NscdPhys::hearFriction()
{
	// NaN too, which is refused in its place, but not once more where it is in force already: a script may have
	// mended the strengths since
	if (isFrictionWritten()) friction = residualFriction = tangensOfFrictionAngle;
}

void NscdPhys::follow(Real newLength)
{
	const Real ratio = newLength / length;
	for (Real* value :
	     { &adhesion, &currentRollingArm, &restGap, &restSlip, &residualTensileForce, &residualRollingArm,
	       &tensileForce, &rollingArm, &ellipseNormal, &ellipseTangential, &creationDistance })
		*value *= ratio;
	length  = newLength;
	touched = true;
}

void NscdPhys::updateThresholds(Real gap, Real adhesionRange)
{
	namespace plane = nonsmooth::contact::plane;
	hearFriction();
	const plane::Thresholds bond { tensileForce, friction, rollingArm },
	        residual { residualTensileForce, residualFriction, residualRollingArm };
	const plane::Thresholds now = plane::thresholdsOf(
	        bond, residual, bonded, plane::touches(gap, adhesionRange, length));
	// most keep theirs, and what is not written need not go back to memory
	const auto set = [](Real& threshold, Real value) {
		if (threshold != value) threshold = value;
	};
	set(adhesion, now.adhesion);
	set(currentFriction, now.friction);
	set(currentRollingArm, now.rollingArm);
	set(tangensOfFrictionAngle, now.friction);
}

void SlipWeakeningPhys::updateThresholds(Real gap, Real adhesionRange)
{
	const bool written = isFrictionWritten();
	NscdPhys::updateThresholds(gap, adhesionRange);
	if (!wallMaterial) return; // made by a script
	const Real wanted = currentFriction;
	Real       left   = wallMaterial->remaining(body);
	if (other >= 0) left = std::min(left, wallMaterial->remaining(other));
	wallMaterial->weaken(adhesion, currentFriction, length, left);
	if (written) overruled = left <= 0 && currentFriction != wanted;
	tangensOfFrictionAngle = currentFriction;
}

void SlipWeakeningPhys::noteSliding(const nscd::Sliding& sliding)
{
	if (!wallMaterial || !sliding.bears) return; // the former: made by a script
	wallMaterial->claim(Body::byId(body));
	if (other < 0) return wallMaterial->addSlip(body, sliding.way);
	wallMaterial->claim(Body::byId(other));
	wallMaterial->addSlip(body, sliding.way, sliding.number);
	wallMaterial->addSlip(other, sliding.way, sliding.number);
}

namespace nscd {
	Real meanDiameter(const Body& b1, const Body& b2)
	{
		const auto* s1 = dynamic_cast<const Sphere*>(b1.shape.get());
		const auto* s2 = dynamic_cast<const Sphere*>(b2.shape.get());
		if (s1 && s2) return s1->radius + s2->radius;
		if (s1 || s2) return 2 * (s1 ? s1 : s2)->radius;
		throw std::invalid_argument(
		        "Ip2_NscdMat_NscdMat_NscdPhys: one of two bodies in contact must be a Sphere");
	}
}

namespace {
	using nonsmooth::contact::plane::Strengths;

	bool makesSense(const Material* m)
	{
		const auto* material = dynamic_cast<const NscdMat*>(m);
		try {
			if (material) material->validate();
			return material;
		} catch (const std::invalid_argument&) {
			return false;
		}
	}
}

/// Behind YADE's own loop, whose threads no exception may leave, a law of springs can only be told of; engines of ours
/// refuse it.
void Ip2_NscdMat_NscdMat_NscdPhys::expectLaw()
{
	if (looked == scene->iter || looked.exchange(scene->iter) == scene->iter) return;
	if (const string why = nscd::halfConverted(*scene); !why.empty() && nscd::seldom(++springs))
		LOG_ERROR("step " << scene->iter << ": " << why);
}

void Ip2_NscdMat_NscdMat_NscdPhys::go(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	expectLaw();
	const Body &b1 = *Body::byId(interaction->getId1(), scene), &b2 = *Body::byId(interaction->getId2(), scene);
	if (!makesSense(m1.get()) || !makesSense(m2.get())) {
		// no exception may leave the threads of YADE's loop: ContactDynamicsEngine meets these numbers in the
		// same step, and says why they are none
		const auto spoilt = boost::make_shared<NscdPhys>();
		spoilt->length    = nscd::meanDiameter(b1, b2);
		for (Real* value : { &spoilt->friction, &spoilt->residualFriction, &spoilt->restitution })
			*value = NaN;
		interaction->phys = spoilt;
		return;
	}
	interaction->phys = make(m1, m2, *interaction);
	setStrengths(static_cast<NscdPhys&>(*interaction->phys), b1, b2);
}

shared_ptr<NscdPhys> Ip2_NscdMat_NscdMat_NscdPhys::make(
        const shared_ptr<Material>& m1, const shared_ptr<Material>& m2, const Interaction& interaction)
{
	const auto weak1 = boost::dynamic_pointer_cast<SlipWeakeningMat>(m1),
	           weak2 = boost::dynamic_pointer_cast<SlipWeakeningMat>(m2);
	const auto* law  = static_cast<const NscdMat&>(*m1).interfaceWith(static_cast<const NscdMat&>(*m2));
	const auto* weak = dynamic_cast<const SlipWeakeningMat*>(law);
	const auto  id1 = interaction.getId1(), id2 = interaction.getId2();
	for (const auto& [material, id] : { std::pair(&m1, id1), std::pair(&m2, id2) })
		if (const auto surface = boost::dynamic_pointer_cast<SlipSurfaceMat>(*material)) {
			const auto phys    = boost::make_shared<SlipSurfacePhys>();
			phys->wallMaterial = surface;
			phys->wall         = id;
			if (const auto* geom = dynamic_cast<const ScGeom*>(
			            interaction.geom.get())) // strength has no joints
				phys->cell = surface->cellAt(*Body::byId(id), geom->contactPoint);
			return phys;
		}
	if (!weak && (law || (!weak1 && !weak2))) {
		const bool inSpace = nscd::isFreeInSpace(*Body::byId(id1)) || nscd::isFreeInSpace(*Body::byId(id2));
		return inSpace ? boost::make_shared<NscdSpacePhys>() : boost::make_shared<NscdPhys>();
	}
	const auto phys = boost::make_shared<SlipWeakeningPhys>();
	if (weak) {
		phys->wallMaterial = boost::static_pointer_cast<SlipWeakeningMat>(
		        const_cast<SlipWeakeningMat*>(weak)->shared_from_this());
		phys->body  = std::min(id1, id2);
		phys->other = std::max(id1, id2);
	} else {
		phys->wallMaterial = weak1 ? weak1 : weak2;
		phys->body         = weak1 ? id2 : id1;
	}
	for (const auto id : { phys->body, phys->other })
		if (id >= 0) phys->wallMaterial->claim(Body::byId(id));
	return phys;
}

namespace {
	/// Whether two physics of a contact keep their slip at one place.
	bool isSameKind(const NscdPhys& old, const NscdPhys& made)
	{
		const auto *was        = dynamic_cast<const SlipWeakeningPhys*>(&old),
		           *is         = dynamic_cast<const SlipWeakeningPhys*>(&made);
		const auto *wasSurface = dynamic_cast<const SlipSurfacePhys*>(&old),
		           *isSurface  = dynamic_cast<const SlipSurfacePhys*>(&made);
		if (!was != !is || !wasSurface != !isSurface) return false;
		if (was)
			return was->wallMaterial == is->wallMaterial && was->body == is->body
			        && was->other == is->other;
		return !wasSurface
		        || (wasSurface->wallMaterial == isSurface->wallMaterial && wasSurface->wall == isSurface->wall);
	}
}

void Ip2_NscdMat_NscdMat_NscdPhys::renew(Interaction& interaction, const Body& b1, const Body& b2)
{
	auto&      old  = static_cast<NscdPhys&>(*interaction.phys);
	const auto made = make(b1.material, b2.material, interaction);
	setStrengths(old, b1, b2);
	if (isSameKind(old, *made)) return;
	static_cast<NscdPhys&>(*made) = old;
	interaction.phys              = made;
}

shared_ptr<NscdPhys>
Ip2_NscdMat_NscdMat_NscdPhys::released(const Interaction& interaction, const Body& b1, const Body& b2)
{
	if (!nscd::isFreeInSpace(b1) && !nscd::isFreeInSpace(b2)) return nullptr;
	if (!makesSense(b1.material.get()) || !makesSense(b2.material.get())) return nullptr;
	const auto made = make(b1.material, b2.material, interaction);
	setStrengths(*made, b1, b2);
	made->bonded = static_cast<const NscdPhys&>(*interaction.phys).bonded;
	return made;
}

void Ip2_NscdMat_NscdMat_NscdPhys::checkMaterials(const Body& b1, const Body& b2)
{
	for (const Body* body : { &b1, &b2 }) {
		const string who = "body #" + std::to_string(body->getId());
		if (!body->material) throw std::runtime_error(who + " has no material: give it an NscdMat");
		if (!dynamic_cast<const NscdMat*>(body->material.get()))
			throw std::runtime_error(
			        who + " has a " + body->material->getClassName()
			        + " in a rigid contact: give it an NscdMat");
	}
}

void Ip2_NscdMat_NscdMat_NscdPhys::setStrengths(NscdPhys& phys, const Body& b1, const Body& b2)
{
	checkMaterials(b1, b2);
	const auto &a = static_cast<const NscdMat&>(*b1.material), &b = static_cast<const NscdMat&>(*b2.material);
	setStrengths(phys, strengthsOf(a, b), nscd::meanDiameter(b1, b2));
	if (auto* inSpace = dynamic_cast<NscdSpacePhys*>(&phys)) inSpace->setStrengths(a, b);
}

namespace {
	Strengths pickStrengths(const NscdMat& a, const NscdMat& b, bool bondable)
	{
		// a wall's own value, or the weaker of two particles'
		const auto pick = [&](Real va, Real vb) { return a.wall ? va : (b.wall ? vb : std::min(va, vb)); };
		Strengths  s;
		s.tension          = pick(a.tensileStrength, b.tensileStrength);
		s.residualTension  = pick(a.residualTensileStrength, b.residualTensileStrength);
		s.friction         = pick(std::tan(a.frictionAngle), std::tan(b.frictionAngle));
		s.residualFriction = pick(
		        std::tan(nscd::residual(a.residualFrictionAngle, a.frictionAngle)),
		        std::tan(nscd::residual(b.residualFrictionAngle, b.frictionAngle)));
		s.rolling         = pick(a.rollingFriction, b.rollingFriction);
		s.residualRolling = pick(
		        nscd::residual(a.residualRollingFriction, a.rollingFriction),
		        nscd::residual(b.residualRollingFriction, b.rollingFriction));
		s.restitution       = std::max(a.restitution, b.restitution);
		s.ellipseNormal     = pick(a.bondEllipseNormal, b.bondEllipseNormal);
		s.ellipseTangential = pick(a.bondEllipseTangential, b.bondEllipseTangential);
		s.creationDistance  = pick(a.bondCreationDistance, b.bondCreationDistance);
		s.bondable          = bondable;
		s.closes            = a.wall ? a.bondsClose : (b.wall ? b.bondsClose : a.bondsClose || b.bondsClose);
		return s;
	}
}

Strengths Ip2_NscdMat_NscdMat_NscdPhys::strengthsOf(const NscdMat& a, const NscdMat& b)
{
	if (const NscdMat* law = a.interfaceWith(b)) return pickStrengths(*law, *law, law->bondsToAll);
	const bool sameLayer = a.layer == b.layer, anyWall = a.wall || b.wall;
	auto       s = pickStrengths(a, b, a.bondsToAll || b.bondsToAll || (!anyWall && sameLayer && a.layer >= 0));
	if (!sameLayer && !anyWall) s.residualTension = 0;
	return s;
}

std::optional<Strengths> Ip2_NscdMat_NscdMat_NscdPhys::lastingStrengths(const Material* a, const Material* b)
{
	for (const Material* m : { a, b })
		if (!m || typeid(*m) != typeid(NscdMat) || !makesSense(m)) return {};
	const auto &one = static_cast<const NscdMat&>(*a), &other = static_cast<const NscdMat&>(*b);
	if (dynamic_cast<const SlipWeakeningMat*>(one.interfaceWith(other))) return {};
	return strengthsOf(one, other);
}

void Ip2_NscdMat_NscdMat_NscdPhys::setStrengths(NscdPhys& phys, const Strengths& s, Real length)
{
	const auto bond = s.ofBond(length), residual = s.residual(length);
	phys.length               = length;
	phys.tensileForce         = bond.adhesion;
	phys.residualTensileForce = residual.adhesion;
	phys.friction             = bond.friction;
	phys.residualFriction     = residual.friction;
	phys.rollingArm           = bond.rollingArm;
	phys.residualRollingArm   = residual.rollingArm;
	phys.restitution          = s.restitution;
	phys.ellipseNormal        = length * s.ellipseNormal;
	phys.ellipseTangential    = length * s.ellipseTangential;
	phys.creationDistance     = length * s.creationDistance;
	phys.bondable             = s.bondable;
	phys.closes               = s.closes;
	phys.currentFriction = phys.tangensOfFrictionAngle = phys.bonded ? bond.friction : residual.friction;
	phys.overruled                                     = false;
}

} // namespace yade
