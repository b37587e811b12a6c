#include "flash_heating.hpp"
#include <cmath>

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& FlashHeating::parameters()
{
	static const std::vector<Parameter> all {
		{ "weakened_friction", "-", "f_w, friction of contacts that are hot" },
		{ "weakening_temperature", "°C", "T_w, at which contacts lose their strength", Bound::finite },
		{ "asperity_slip", "m", "D_a, slip in the life of a contact", Bound::positive },
		{ "contact_strength", "Pa", "τ_c, shear strength of a contact", Bound::positive },
		{ "slip_lag", "m", "L, slip in which friction follows the velocity; 0: at once", Bound::notNegative,
		  0 },
	};
	return all;
}

FlashHeating::FlashHeating(const Values& values)
        : weakened(values.number(parameters(), "weakened_friction"))
        , temperature(values.number(parameters(), "weakening_temperature"))
        , asperity(values.number(parameters(), "asperity_slip"))
        , contactStrength(values.number(parameters(), "contact_strength"))
        , lag(values.number(parameters(), "slip_lag"))
{
}

double FlashHeating::velocity(double at, double diffusivity, double heatCapacity) const
{
	if (at >= temperature) return 0;
	const double share = heatCapacity * (temperature - at) / contactStrength;
	return M_PI * diffusivity / asperity * share * share;
}

double FlashHeating::coefficient(double slipRate, double flashVelocity, double friction) const
{
	return slipRate > flashVelocity ? weakened + (friction - weakened) * flashVelocity / slipRate : friction;
}

} // namespace nonsmooth::contact::slip
