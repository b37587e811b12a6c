#include "pressurization.hpp"

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& Pressurization::parameters()
{
	static const std::vector<Parameter> all {
		{ "pressurization_coefficient", "Pa/K",
		  "Λ, rise of pore pressure by temperature in a zone that keeps its water" },
		{ "hydraulic_diffusivity", "m²/s", "α_hy of the zone and its surroundings, k/ηβ" },
		{ "water_pressure", "Pa", "absolute pressure of the pore water without slip", Bound::positive, 101325 },
	};
	return all;
}

Pressurization::Pressurization(const Values& values)
        : coefficient(values.number(parameters(), "pressurization_coefficient"))
        , diffusivity(values.number(parameters(), "hydraulic_diffusivity"))
        , waterPressure(values.number(parameters(), "water_pressure"))
{
}

} // namespace nonsmooth::contact::slip
