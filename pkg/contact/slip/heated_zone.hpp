// A slip zone that heats, with the parts that heat acts on: pore water (pressurization.hpp), microcontacts
// (flash_heating.hpp), a reaction (decomposition.hpp), melt (shear_melting.hpp). Each part tells its equations; this
// is the zone that they share and the order in which a step takes them.
//
//     (10)  ρc ∂T/∂t = −∂q_h/∂y + τ γ̇ in |y| < h/2 ,   (12)  q_h = −K ∂T/∂y     (Taboada and Estrada 2009)
//     τ = f (σ − ū)⁺ ;   h = 0 stands for slip on a plane, which is the first node
// A step: strength takes diffusion (profile.hpp) and foresees the heat (pressurization.hpp); advance adds the heat
// that was made, lets the reaction act, follows friction, and melts.
// Heat is kept: ρc ∫T dy + ρ_m ΔH ∫s dy + ρL' (melt and what was squeezed out) rises by what sliding makes.
#pragma once

#include <contact/slip/decomposition.hpp>
#include <contact/slip/flash_heating.hpp>
#include <contact/slip/law.hpp>
#include <contact/slip/pressurization.hpp>
#include <contact/slip/profile.hpp>
#include <contact/slip/shear_melting.hpp>
#include <optional>

namespace nonsmooth::contact::slip {

class HeatedZone : public Law {
public:
	struct Parts {
		std::optional<Pressurization> water;
		std::optional<FlashHeating>   flash;
		std::optional<Decomposition>  reaction;
		std::optional<ShearMelting>   melt;
	};
	static const std::vector<Parameter>& parameters();
	/// Throws std::invalid_argument for values that do not fit.
	HeatedZone(const Values& values, Parts parts);

	std::vector<StateColumn> columns() const override;
	void                     prepare(double h) override;
	void                     strength(Cells& cells, Range range) const override;
	void                     advance(Cells& cells, Range range) const override;

	const Nodes& nodes() const { return mesh; }
	const Parts& heated() const { return parts; }
	/// V_w [m/s] of a zone that microcontacts heat in, at a temperature [°C].
	double flashVelocity(double temperature) const;
	/// Heat [J/m²] that a cell holds over that of its beginning.
	double heatIn(const double* state) const;

private:
	struct State; // of one cell, by name

	void        begin(double* state) const override;
	std::size_t betweenWidth() const override { return 2 * mesh.count(); }
	State       of(double* state) const;
	double      friction(const State& state, double slipRate) const;
	double      width() const; // of the zone [m]
	void        react(const State& state) const;
	void        melts(const State& state, double heat, double slipRate, double normalStress) const;

	double              coefficient, thickness, heatCapacity, diffusivity, start;
	Parts               parts;
	Nodes               mesh;
	double              prepared = 0; // step that the factors are of
	Diffusion           ofHeat, ofWater;
	std::vector<double> heatResponse, pressureResponse; // a [K m²/J], b [Pa m²/J]
	double              meanPressure = 0; // b̄
};

} // namespace nonsmooth::contact::slip
