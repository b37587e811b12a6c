// Disks that grow or shrink: what follows where somebody has changed a radius, a script or YADE's growParticles.
//
// With m mass, I moment of inertia about z, r radius, s ratio of the radii after and before:
//     a disk      I = m r²/2       m ∝ r² ,  I ∝ r⁴
//     a sphere    I = 2 m r²/5     m ∝ r³ ,  I ∝ r⁵       (bodies of utils.sphere, which keep a sphere's mass)
// growParticles multiplies by s³ and s⁵ whatever the body is, and who sets shape.radius alone leaves both as they were:
// these two are mended. Other numbers somebody has chosen, and they stay. A contact's length follows, with what is in
// proportion to it, and a bond's marks stay on the rims.
// Units: m, kg, kg m², per metre of thickness for disks.
#include "../materials/BondEllipse.hpp"
#include "../checks/Refusal.hpp"
#include "Resident.hpp"
#include <lib/high-precision/Constants.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade::nscd {

namespace {
	constexpr Real disk = 0.5, sphere = 0.4; // I/(m r²)

	bool near(Real a, Real b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

	/// Mass of a disk by its material's density [kg], 0 where it has none.
	Real massOf(const Body& body, Real radius)
	{
		return body.material ? body.material->density * Mathr::PI * (radius * radius) : 0;
	}

	/// Brings mass and inertia of a body to its new radius; returns what there is to tell of it, empty where
	/// nothing is.
	string followSize(Body& body, const FormerSize& former, Real radius)
	{
		State&     s     = *body.state;
		const Real ratio = radius / former.radius, square = ratio * ratio;
		const Real inertia = s.inertia[2],
		           shape   = former.inertia / (former.mass * (former.radius * former.radius));
		if (!(former.mass > 0 && former.inertia > 0)) return "";
		if (near(s.mass, massOf(body, radius)) && near(inertia, disk * s.mass * (radius * radius))) return "";
		const bool isDisk = near(shape, disk), isSphere = near(shape, sphere);
		const bool left  = s.mass == former.mass && inertia == former.inertia;
		const bool grown = near(s.mass, former.mass * square * ratio)
		        && near(inertia, former.inertia * square * square * ratio);
		const string what = "the radius of body #" + std::to_string(body.getId()) + " was changed from "
		        + number(former.radius) + " to " + number(radius) + " m";
		if ((!left && !grown) || (grown && isSphere)) {
			const Real fits = s.mass * (radius * radius);
			if (near(inertia, disk * fits) || near(inertia, sphere * fits)) return "";
			return what + ": its mass " + number(s.mass) + " kg and inertia " + number(inertia)
			        + " kg m² stay as they were set, and are not those of a disk (ρ π r², m r²/2)";
		}
		if (!isDisk && !isSphere)
			return what + ": its mass " + number(s.mass) + " kg and inertia " + number(inertia)
			        + " kg m² stay, as they are neither a disk's nor a sphere's: set them to what it has now";
		const Real before = s.mass;
		s.mass            = isSphere                                        ? former.mass * square * ratio
		                   : near(former.mass, massOf(body, former.radius)) ? massOf(body, radius)
		                                                                    : former.mass * square;
		s.inertia *= (isDisk ? disk : sphere) * s.mass * (radius * radius) / inertia;
		return what + (isDisk ? ", and its mass follows its area" : ", and its mass follows a sphere's volume")
		        + ": " + number(s.mass) + " kg, where it was left with " + number(before)
		        + " kg; set state.mass after the next step where it is to have another";
	}
}

/// Of bodies whose radius has changed the spheres that have a size, with the last one that they had before: one without
/// sense, as inf, is refused in this step and mended later, and what followed it would be lost.
std::vector<FormerSize> Resident::resized(const Scene& scene, const std::vector<FormerSize>& changed)
{
	const auto              isSize = [](Real radius) { return radius > 0 && isNumber(radius); };
	std::vector<FormerSize> found;
	for (const FormerSize& former : changed) {
		const auto lost = sizesLost.find(former.id);
		if (!dynamic_cast<const Sphere*>((*scene.bodies)[former.id]->shape.get())) {
			if (lost != sizesLost.end()) sizesLost.erase(lost);
			continue;
		}
		if (!isSize(bodies[former.id].radius)) {
			if (isSize(former.radius)) sizesLost[former.id] = former;
			continue;
		}
		if (isSize(former.radius)) found.push_back(former);
		else if (lost != sizesLost.end() && lost->second.radius != bodies[former.id].radius)
			found.push_back(lost->second);
		if (lost != sizesLost.end()) sizesLost.erase(lost);
	}
	return found;
}

void Resident::followSizes(Scene& scene, const std::vector<FormerSize>& all)
{
	const auto changed = resized(scene, all);
	if (changed.empty()) return;
	if (contactsOwned || bare > 0) show();
	for (const FormerSize& former : changed) {
		BodyState& b    = bodies[former.id];
		Body&      body = *(*scene.bodies)[former.id];
		if (string what = followSize(body, former, b.radius); !what.empty())
			sizesTold.push_back(std::move(what));
		b.mass           = body.state->mass;
		b.inertia        = body.state->inertia[2];
		const Real ratio = b.radius / former.radius;
		for (const auto& [other, interaction] : body.intrs) {
			auto* phys = interaction->isReal() ? physOf(*interaction->phys) : nullptr;
			if (!phys) continue;
			const Body& b1 = *(*scene.bodies)[interaction->getId1()];
			const Body& b2 = *(*scene.bodies)[interaction->getId2()];
			phys->follow(meanDiameter(b1, b2));
			if (phys->bonded) (bondPair(b1, b2).first == &body ? phys->anchor1 : phys->anchor2) *= ratio;
		}
	}
}

} // namespace yade::nscd
