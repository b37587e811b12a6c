// Flash heating of microcontacts (Taboada and Estrada 2009, section 4.3.2).
//
//     (15)  V_w = (π α_th/D_a) [ρc (T_w − T)/τ_c]²
//     f = f₀ for V ≤ V_w ,   f = f_w + (f₀ − f_w) V_w/V above      (Rice 2006; the paper gives V_w alone)
// with T the mean temperature of the zone: as it warms, V_w falls. Values of the paper: T_w − T = 900 K, D_a = 5 µm,
// τ_c = 3 GPa, α_th = 0.5 mm²/s, ρc = 2.7 MPa/K give V_w = 0.2061 m/s (printed: 0.2), and with f₀ = 0.6, f_w = 0.12
// f(1 m/s) = 0.2189. Above T_w contacts are weak at any velocity: V_w = 0, f = f_w.
// With a slip lag L > 0:  df/dδ = −(f − f_ss(V))/L, in a step f⁺ = f + (f_ss − f)(1 − exp(−d/L)).
// V is that of the step before. A scene's step should be at most 0.1/(g cos β |df/dV|), 4.7 ms for these values.
#pragma once

#include <contact/slip/parameters.hpp>

namespace nonsmooth::contact::slip {

struct FlashHeating {
	double weakened; // f_w [-]
	double temperature; // T_w [°C]
	double asperity; // D_a [m]
	double contactStrength; // τ_c [Pa]
	double lag; // L [m]

	static const std::vector<Parameter>& parameters();
	explicit FlashHeating(const Values& values);

	/// V_w [m/s] at a temperature [°C], α_th [m²/s] and ρc [J/(m³ K)], eq. (15).
	double velocity(double temperature, double diffusivity, double heatCapacity) const;
	/// f_ss at V [m/s] for V_w [m/s] and f₀.
	double coefficient(double slipRate, double flashVelocity, double friction) const;
};

} // namespace nonsmooth::contact::slip
