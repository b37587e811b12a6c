#include "shear_melting.hpp"
#include "water.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& ShearMelting::parameters()
{
	static const std::vector<Parameter> all {
		{ "melting_temperature", "°C", "T_m", Bound::positive },
		{ "melt_viscosity", "Pa s", "η₀, of the melt at T_m", Bound::positive },
		{ "activation_temperature", "K", "B of η = A exp(B/T)", Bound::positive },
		{ "melt_conductivity", "W/(m K)", "K of the melt", Bound::positive },
		{ "melting_heat", "J/m³", "ρL', heat from rock to melt in a volume", Bound::positive },
		{ "squeezing_length", "m", "R, half width of a strip or radius of a disk from which melt is squeezed",
		  Bound::positive },
		{ "squeezing_factor", "-", "C, 4 for a strip, 1.5 for a disk", Bound::positive, 4 },
		{ "peak_friction", "-", "f_p, where a thin layer of melt grips", Bound::positive, 1 },
	};
	return all;
}

ShearMelting::ShearMelting(const Values& values)
        : temperature(values.number(parameters(), "melting_temperature"))
        , viscosity(values.number(parameters(), "melt_viscosity"))
        , decay(values.number(parameters(), "activation_temperature")
                / ((temperature + zeroCelsius) * (temperature + zeroCelsius)))
        , conductivity(values.number(parameters(), "melt_conductivity"))
        , heat(values.number(parameters(), "melting_heat"))
        , length(values.number(parameters(), "squeezing_length"))
        , factor(values.number(parameters(), "squeezing_factor"))
        , peak(values.number(parameters(), "peak_friction"))
{
}

double ShearMelting::viscosityAt(double slipRate) const
{
	const double s = std::asinh(slipRate / std::sqrt(8 * conductivity / (decay * viscosity)));
	return s > 1e-6 ? viscosity * s / (std::sinh(s) * std::cosh(s)) : viscosity;
}

double ShearMelting::strength(double slipRate, double thickness, double normalStress) const
{
	const double grip = peak * std::max(normalStress, 0.0);
	return thickness > 0 ? std::min(grip, viscosityAt(slipRate) * slipRate / thickness) : grip;
}

double ShearMelting::hottest(double slipRate) const
{
	const double s = std::asinh(slipRate / std::sqrt(8 * conductivity / (decay * viscosity)));
	return temperature + 2 / decay * std::log(std::cosh(s));
}

double ShearMelting::squeezed(double thickness, double melted, double slipRate, double normalStress, double h) const
{
	const double all  = thickness + melted;
	const double flow = h * std::max(normalStress, 0.0) / (factor * viscosityAt(slipRate) * length * length);
	double       m    = all; // above the root of what is convex, from where Newton falls to it
	for (int k = 0; k < 100; ++k) {
		const double move = (m + flow * m * m * m - all) / (1 + 3 * flow * m * m);
		m -= move;
		if (!(move > 1e-15 * m)) break;
	}
	return m;
}

} // namespace nonsmooth::contact::slip
