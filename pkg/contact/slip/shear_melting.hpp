// Shear melting (Taboada and Estrada 2009, section 4.3.5): a zone that has been heated to its melting point bears a
// viscous layer.
//
//     (16)  τ = η γ̇ ,
//     (17)  η(T) = A exp(B/T) , about the melting point  η ≈ η₀ exp(−b (T − T_m)) ,  b = B/T_m² (absolute T_m)
// A layer of the thickness m between walls at T_m, heated by its own shear and cooled through the walls, has the
// exact steady profile
//     τ = F/m ,  F = η₀ V s/(sinh s cosh s) ,  s = asinh(V/W) ,  W = √(8K/(b η₀)) ,  T_max − T_m = (2/b) ln cosh s
// (derived from momentum and heat; a boundary value solver agrees). Heat of sliding melts the walls, and the load σ
// squeezes melt out:
//     dm/dt = τ V/(ρL') − σ m³/(C η R²) ,  η = F/V ,
//     C = 4 for a strip of the half width R, 3/2 for a disk of the radius R
// with ρL' [J/m³] the heat that brings rock from its temperature to melt. It ends at
//     τ = (ρL' σ/C)^(1/4) √(F/R)   (Nielsen et al. 2008), so that τ/σ falls as σ^(−3/4).
// In a step squeezing is implicit, m⁺ + h κ m⁺³ = m + q/(ρL'), κ = σ/(C η R²); q is what sliding makes.
// A thin layer resists more than rock does: the strength is cut at f_p σ, f_p the peak friction. So melt is a brake
// first and lubricates after.
// Once molten the layer does not freeze, the pore pressure is of no more account, and
// temperatures beside it are left as they were: what conduction takes is in L'. These are deviations from nature, not
// from the paper, which sets (16) and (17) alone.
#pragma once

#include <contact/slip/parameters.hpp>

namespace nonsmooth::contact::slip {

struct ShearMelting {
	double temperature; // T_m [°C]
	double viscosity; // η₀ at T_m [Pa s]
	double decay; // b [1/K]
	double conductivity; // K of the melt [W/(m K)]
	double heat; // ρL' [J/m³]
	double length; // R [m]
	double factor; // C [-]
	double peak; // f_p [-]

	static const std::vector<Parameter>& parameters();
	explicit ShearMelting(const Values& values);

	/// F/V [Pa s], which is η₀ at V = 0: the layer bears V (F/V)/m.
	double viscosityAt(double slipRate) const;
	/// τ [Pa] of a layer m [m] under σ [Pa].
	double strength(double slipRate, double thickness, double normalStress) const;
	/// T_max [°C] in the middle of a layer.
	double hottest(double slipRate) const;
	/// m⁺ [m] of a step h [s] that has melted by `melted` [m].
	double squeezed(double thickness, double melted, double slipRate, double normalStress, double h) const;
};

} // namespace nonsmooth::contact::slip
