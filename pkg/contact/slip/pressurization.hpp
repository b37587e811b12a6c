// Thermal pressurization of pore water (Taboada and Estrada 2009, section 4.3.1): the part of a heated zone that is
// water.
//
// Equations (paper), y across the zone, u the excess of the pore pressure over the one that is there without slip:
//     heat      (10)  ρc ∂T/∂t = −∂q_h/∂y + τ γ̇ ,  γ̇ = V/h in the zone |y| < h/2
//               (12)  q_h = −K ∂T/∂y            (13)  α_th = K/ρc
//     water     (11)  ∂m/∂t = −∂q_f/∂y
//               (12)  q_f = −(ρ_f k/η) ∂u/∂y    (13)  α_hy = k/ηβ
//               with dm = ρ_f β (du − Λ dT):   ∂u/∂t = α_hy ∂²u/∂y² + Λ ∂T/∂t
//     strength  τ = f (σ − ū)⁺ ,   ū the mean of u over the zone .
// Limits, which tests hold it against:
//     no diffusion (adiabatic, undrained)   τ = f σ exp(−δ/D_c) ,  D_c = ρc h/(f Λ) ,  T − T₀ = (σ/Λ)(1 − exp(−δ/D_c))
//     h → 0 at constant V (Rice 2006)       τ = f σ exp(x²) erfc(x) ,  x² = δ/L* ,
//                                           L* = (4/f²)(ρc/Λ)² (√α_hy + √α_th)²/V
// One step: both fields are linear in the heat q of the step,
//     T* = (1 − h A_T)⁻¹ T ,  u* = (1 − h A_u)⁻¹ (u + Λ (T* − T)) ,   T⁺ = T* + a q ,  u⁺ = u* + b q ,
// with the responses a and b to 1 J/m². The threshold of the step foresees them: with x = f b̄ V h, τ_n = f (σ − ū)⁺,
// B = f (σ − ū*),
//     τ_e = (B − x τ_n/2)/(1 + x/2) ,   τ = (τ_n + τ_e)/2 ,   but τ = B⁺/(1 + x) where τ_e < 0 or x > 2 .
// V is that of the step before, and q what sliding makes, so that heat closes whatever was foreseen. Errors of slip
// at a given strength: 1.3 % at 10 ms, 0.7 % at 5 ms. The pressure at a node may exceed σ; the strength alone is cut
// at 0.
// The liquid line (eq. 14, water.hpp): where the zone's water would boil, it no longer expands as a liquid. Then
// Λ = 0 from there on, and the column `vapour` is 1: what steam does is beyond this law.
// Deviations: the paper sets the equations and gives no scheme. k, β, Λ and h are constant.
// Sources: Rice (2006), J. Geophys. Res. 111, B05311, for the limits; both were derived again and hold numerically.
#pragma once

#include <contact/slip/parameters.hpp>

namespace nonsmooth::contact::slip {

struct Pressurization {
	double coefficient; // Λ [Pa/K]
	double diffusivity; // α_hy [m²/s]
	double waterPressure; // absolute, without slip [Pa]

	static const std::vector<Parameter>& parameters();
	explicit Pressurization(const Values& values);
};

/// D_c [m] of a zone from which neither heat nor water leaves: ρc [J/(m³ K)], h [m], f [-], Λ [Pa/K].
inline double undrainedCriticalSlip(double heatCapacity, double thickness, double friction, double coefficient)
{
	return heatCapacity * thickness / (friction * coefficient);
}

} // namespace nonsmooth::contact::slip
