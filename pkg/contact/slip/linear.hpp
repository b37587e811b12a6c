// Strength falls in proportion to slip, to none at the critical slip D_c: left(δ) = max(1 − δ/D_c, 0).
// A common idealisation; the paper names the decay (Taboada and Estrada 2009, section 4.3) and takes a step.
#pragma once

#include <contact/slip/by_slip.hpp>

namespace nonsmooth::contact::slip {

class Linear : public BySlip {
public:
	using BySlip::left;
	/// D_c [m], friction before and after [-]. Throws std::invalid_argument where D_c is not positive, or
	/// friction negative.
	explicit Linear(double critical_, double friction = 0, double weakened = 0)
	        : BySlip(friction, weakened)
	        , critical(positiveCriticalSlip(critical_))
	{
	}
	void left(const double* slip, double* share, std::size_t count) const override
	{
		for (std::size_t k = 0; k < count; ++k)
			share[k] = slip[k] < critical ? 1 - slip[k] / critical : 0;
	}

private:
	double critical;
};

} // namespace nonsmooth::contact::slip
