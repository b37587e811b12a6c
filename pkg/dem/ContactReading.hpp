// What a step's contact problem takes from one interaction, side by side in memory.
//
// Geometry and physics of an interaction lie far apart, and to fetch them is most of the work. NscdInteractionLoop has them at hand and leaves a reading of each,
// so that ContactSeam need not go to them again; behind any other loop ContactSeam makes the readings itself.
#pragma once

#include "NscdPhys.hpp"
#include <pkg/dem/ScGeom.hpp>

namespace yade::nscd {

struct Reading {
	Interaction*  interaction;
	const ScGeom* geom;
	NscdPhys*     phys; // null where the interaction has another physics
	Real          nx, ny, gap; // along the interaction's own order of bodies
	Real          restGap, restitution, adhesion, friction, rollingArm, length;
	Real          normal, tangential, torque, correction; // of the last step
	int           broken; // NscdPhys::brokenMode if the bond broke in this step
	bool          bonded, slips;
	bool          usable; // its numbers make sense, and its normal lies in the plane
};

/// Component of a unit normal along z up to which it lies in the plane.
constexpr Real flatness = 1e-6;

/// Whether thresholds, restitution and length of a contact are what the law knows; false for numbers that are none.
inline bool makeSense(const NscdPhys& phys)
{
	const Real sum = phys.adhesion + phys.currentFriction + phys.currentRollingArm + phys.length;
	return phys.adhesion >= 0 && phys.currentFriction >= 0 && phys.currentRollingArm >= 0 && phys.length > 0 && phys.restitution >= 0 && phys.restitution <= 1
	        && sum <= std::numeric_limits<Real>::max();
}

/// The bodies of a reading; `first` is negative where there is nothing to take.
struct ReadIds {
	int first, second;
};

/// The cohesive physics of an interaction, null if it has another; the usual two classes are recognised without a search.
inline NscdPhys* physOf(IPhys& phys)
{
	const auto& type = typeid(phys);
	if (type == typeid(NscdPhys) || type == typeid(SlipWeakeningPhys)) return static_cast<NscdPhys*>(&phys);
	return dynamic_cast<NscdPhys*>(&phys);
}

/// Reads a real interaction.
inline Reading read(Interaction& interaction, const ScGeom& geom, NscdPhys* phys)
{
	if (!phys) return { &interaction, &geom, nullptr, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, NscdPhys::None, false, false, false };
	return { &interaction,          &geom,           phys,
		 geom.normal[0],        geom.normal[1],  -geom.penetrationDepth,
		 phys->restGap,         phys->restitution, phys->adhesion, phys->currentFriction, phys->currentRollingArm, phys->length,
		 phys->normal,          phys->tangential, phys->torque, phys->correction,
		 phys->breaks ? phys->brokenMode : int(NscdPhys::None),
		 phys->bonded,          phys->countsSlip(), std::abs(geom.normal[2]) <= flatness && makeSense(*phys) };
}

/// Readings of a whole list of interactions, in its order.
struct Readings {
	std::vector<ReadIds> ids;
	std::vector<Reading> contacts;

	void resize(size_t count)
	{
		ids.resize(count);
		contacts.resize(count);
	}
	/// Reads the interaction at place k of the list, or notes that it has no contact.
	void take(size_t k, Interaction& interaction)
	{
		ids[k].first = -1;
		if (!interaction.isReal() || !interaction.isActive) return;
		take(k, interaction, static_cast<const ScGeom&>(*interaction.geom), physOf(*interaction.phys));
	}
	void take(size_t k, Interaction& interaction, const ScGeom& geom, NscdPhys* phys)
	{
		ids[k]      = { interaction.getId1(), interaction.getId2() };
		contacts[k] = read(interaction, geom, phys);
	}
};

} // namespace yade::nscd
