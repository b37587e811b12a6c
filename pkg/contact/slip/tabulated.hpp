// Friction from a table of slip and velocity, with a slip lag: laws that experiments give and no theory does.
//
//     df/dδ = −(f − f_ss(δ, V))/L ,   τ = f σ ;      in a step f⁺ = f + (f_ss − f)(1 − exp(−d/L)) ;   L = 0: f = f_ss
// f_ss is linear in δ and in log V between the table's points, and constant beyond its edges. V is that of the step
// before.
// Silica gel (Taboada and Estrada 2009, section 4.3.4, after Di Toro et al. 2004) is such a table: f_ss = 0.6
// to 0.03 m/s, 0.2 at 0.1, 0 at 1 m/s, with L = 0.3 m; after a jump to 0.1 m/s f(0.3 m) = 0.2 + 0.4/e = 0.3472.
// Deviation: none of the paper's laws has a formula there; a table keeps to the numbers.
#pragma once

#include <contact/slip/law.hpp>
#include <contact/slip/parameters.hpp>

namespace nonsmooth::contact::slip {

class Tabulated : public Law {
public:
	static const std::vector<Parameter>& parameters();
	/// Throws std::invalid_argument for values that do not fit.
	explicit Tabulated(const Values& values);

	std::vector<StateColumn> columns() const override { return { { "friction", "-", 0, 1 } }; }
	void                     strength(Cells& cells, Range range) const override;
	void                     advance(Cells& cells, Range range) const override;

	/// f_ss at a slip [m] and a velocity [m/s].
	double steady(double slip, double slipRate) const;

private:
	void begin(double* state) const override { *state = first; }

	std::vector<double> slips, logs, friction; // log V; friction by slip, then velocity
	double              lag, first;
};

} // namespace nonsmooth::contact::slip
