// Strength as a function of slip alone (Taboada and Estrada 2009, section 5.3):
//     τ = σ (f_w + (f − f_w) left(δ)) ,   f > f_w ,   left(0) = 1 ,
// with f and f_w the friction before and after. Where f ≤ f_w nothing weakens.
// Walls of SlipWeakeningMat ask for the share that is left after the slip of a body, and lower friction and cohesion by
// it.
#pragma once

#include <contact/slip/law.hpp>

namespace nonsmooth::contact::slip {

class BySlip : public Law {
public:
	/// Friction before and after [-]. Throws std::invalid_argument where one is negative.
	BySlip(double friction, double weakened);

	/// Share of the strength that is left after slips [m]: 1 is all, 0 is none.
	virtual void left(const double* slip, double* share, std::size_t count) const = 0;
	/// The same of one slip.
	double left(double slip) const;

	void strength(Cells& cells, Range range) const override;

private:
	double friction, weakened;
};

/// D_c [m] if it is positive. Throws std::invalid_argument else.
double positiveCriticalSlip(double critical);

} // namespace nonsmooth::contact::slip
