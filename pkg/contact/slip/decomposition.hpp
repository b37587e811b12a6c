// Thermal decomposition of minerals in a heated zone (Taboada and Estrada 2009, section 4.3.3): one reaction that
// takes up heat and sets fluid free.
//
// At each node, with s the reacted share (0 to 1) and T the absolute temperature (the paper gives no equations; Sulem
// and Famin 2009 do):
//     ds/dt = A exp(−Q/(R T)) (1 − s)^n ,  n = 1 or 0 ;    ρc ∂T/∂t = … − ρ_m ΔH ∂s/∂t ;    ∂u/∂t = … + Π ∂s/∂t
// with ρ_m [kg/m³] the mass of what can react in a volume, ΔH its heat, Π [Pa] the pressure that its fluid would make
// undrained.
// A step takes the reaction after heat and diffusion, at each node by itself and implicitly in T and s:
// with β = ρ_m ΔH/ρc
//     Δs = h A exp(−Q/(R (T − β Δs))) (1 − s − Δs)^n ,  Δs ≤ 1 − s .
// Limit, which tests hold it against: without diffusion, at constant τ and V, heat of sliding is taken up whole by
// the reaction at
//     T_c = Q/(R ln(A ρ_m ΔH h/(τ V)))
// for n = 0; for n = 1 while s is small: with 1 − s in the logarithm T goes on rising.
// Calcite, Q = 319 kJ/mol, A = 2.95e15 1/s, ΔH = 3.19 MJ/kg, ρ_m = 2700 kg/m³, h = 1 mm, τ = 1.5 MPa: 753.6 °C
// at 1 m/s, 821.0 °C at 10 m/s.
// Deviations: the zone keeps its thickness, permeability and heat capacity as it reacts.
// Weakening by the reaction's powder is a matter of f.
#pragma once

#include <contact/slip/parameters.hpp>

namespace nonsmooth::contact::slip {

struct Decomposition {
	double energy; // Q [J/mol]
	double rate; // A [1/s]
	double heat; // ρ_m ΔH [J/m³]
	double pressure; // Π [Pa]
	int    order; // n

	static const std::vector<Parameter>& parameters();
	explicit Decomposition(const Values& values);

	/// Δs of a step h [s] at a node of the temperature [°C], reacted by s; ρc [J/(m³ K)].
	double reacts(double temperature, double reacted, double heatCapacity, double h) const;
};

/// R [J/(mol K)].
constexpr double gasConstant = 8.31446261815324;

} // namespace nonsmooth::contact::slip
