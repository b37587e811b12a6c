#include "decomposition.hpp"
#include "water.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::contact::slip {

const std::vector<Parameter>& Decomposition::parameters()
{
	static const std::vector<Parameter> all {
		{ "activation_energy", "J/mol", "Q of the reaction", Bound::positive },
		{ "reaction_rate", "1/s", "A, rate without a barrier", Bound::positive },
		{ "reacting_density", "kg/m³", "ρ_m, mass in a volume that can react", Bound::positive },
		{ "reaction_heat", "J/kg", "ΔH, heat that it takes up" },
		{ "reaction_pressure", "Pa", "Π, pressure of its fluid if it stays", Bound::notNegative, 0 },
		{ "reaction_order", "-", "n, 1 or 0", Bound::notNegative, 1, 1 },
	};
	return all;
}

Decomposition::Decomposition(const Values& values)
        : energy(values.number(parameters(), "activation_energy"))
        , rate(values.number(parameters(), "reaction_rate"))
        , heat(values.number(parameters(), "reacting_density") * values.number(parameters(), "reaction_heat"))
        , pressure(values.number(parameters(), "reaction_pressure"))
        , order(int(values.number(parameters(), "reaction_order")))
{
	const double n = values.number(parameters(), "reaction_order");
	values.require(n == order, "reaction_order", n, "1 or 0");
}

double Decomposition::reacts(double temperature, double reacted, double heatCapacity, double h) const
{
	const double left = 1 - reacted, sink = heat / heatCapacity; // β [K]
	const double begin = temperature + zeroCelsius;
	// what has reacted less what would have: concave and rising, so Newton comes to its root from below
	double amount = 0;
	for (int k = 0; k < 200 && left > 0; ++k) {
		const double kelvin = std::max(begin - sink * amount, 1.0);
		const double by     = h * rate * std::exp(-energy / (gasConstant * kelvin)); // h k(T)
		if (by < 1e-18) break;
		const double open  = order == 1 ? left - amount : 1;
		const double slope = 1 + by * open * sink * energy / (gasConstant * kelvin * kelvin)
		        + (order == 1 ? by : 0);
		const double move = (by * open - amount) / slope;
		amount            = std::min(amount + move, left);
		if (!(move > 1e-15 * amount) || amount == left) break;
	}
	return amount;
}

} // namespace nonsmooth::contact::slip
