// All of the strength below the critical slip D_c, none from there on: the paper's law (Taboada and Estrada 2009,
// section 5.3).
#pragma once

#include <contact/slip/by_slip.hpp>

namespace nonsmooth::contact::slip {

class Step : public BySlip {
public:
	using BySlip::left;
	/// D_c [m], friction before and after [-]. Throws std::invalid_argument where D_c is not positive, or
	/// friction negative.
	explicit Step(double critical_, double friction = 0, double weakened = 0)
	        : BySlip(friction, weakened)
	        , critical(positiveCriticalSlip(critical_))
	{
	}
	void left(const double* slip, double* share, std::size_t count) const override
	{
		for (std::size_t k = 0; k < count; ++k)
			share[k] = slip[k] < critical ? 1 : 0;
	}

private:
	double critical;
};

} // namespace nonsmooth::contact::slip
