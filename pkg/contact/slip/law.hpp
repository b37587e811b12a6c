// A law of a slip surface: the shear strength of its cells, from slip, slip rate and what slip has left there.
//
// The paper lists five ways in which a slip surface loses strength as it heats (Taboada and Estrada 2009, section
// 4.3), and a function of slip alone in section 5.3. Here each is a law of its own over cells. A step of length h goes
//     strength   τ = τ(state, σ, V)             V of the step before: a lag
//     the step   slides by d at the shear stress T ≤ τ ; makes the heat q = T d
//     advance    state⁺ = state(state, q, d, V⁺)
// The lag is there since a strength that falls with V within a step has several answers.
// Signs: compression, slip, slip rate, strength and heat positive. Units: Pa, m, m/s, J/m², K; temperatures in °C.
// σ is what a wall of disks bears: where the water of the ground acts on disks, σ = N'/ℓ, and a law's pore pressure
// is an excess over it.
#pragma once

#include <contact/slip/cells.hpp>

namespace nonsmooth::contact::slip {

class Law {
public:
	virtual ~Law() = default;

	/// The law's own columns, in the order of their offsets.
	virtual std::vector<StateColumn> columns() const { return {}; }

	/// Takes up the length h [s] of the steps to come. Throws std::invalid_argument where it is not positive.
	/// Before the ranges of a step, which threads share.
	virtual void prepare(double h);
	/// Fills Cells::strength from the state, σ and V.
	virtual void strength(Cells& cells, Range range) const = 0;
	/// Takes up a step that was made: Cells::path, heat and slipRate. After strength of the same step.
	virtual void advance(Cells& cells, Range range) const;

	/// μ before slip: τ/σ of a cell that has not slipped. The step in force stays.
	double friction();
	/// Cells under the stress σ [Pa] that have not slipped.
	Cells cells(std::size_t count, double normalStress = 0) const;

protected:
	double step = 0; // h [s]

private:
	/// Writes the state of a cell that has not slipped.
	virtual void        begin(double* /*state*/) const { }
	virtual std::size_t betweenWidth() const { return 0; }
};

} // namespace nonsmooth::contact::slip
