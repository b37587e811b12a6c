// Strength decays with slip: left(δ) = exp(−δ/D_c). It is what a thick zone without diffusion does
// (pressurization.hpp), and what experiments are fitted by; the paper names the decay (Taboada and Estrada 2009,
// section 4.3) and takes a step.
#pragma once

#include <cmath>
#include <contact/slip/by_slip.hpp>

namespace nonsmooth::contact::slip {

class Exponential : public BySlip {
public:
	using BySlip::left;
	/// D_c [m], friction before and after [-]. Throws std::invalid_argument where D_c is not positive, or
	/// friction negative.
	explicit Exponential(double critical_, double friction = 0, double weakened = 0)
	        : BySlip(friction, weakened)
	        , critical(positiveCriticalSlip(critical_))
	{
	}
	void left(const double* slip, double* share, std::size_t count) const override
	{
		for (std::size_t k = 0; k < count; ++k)
			share[k] = std::exp(-slip[k] / critical);
	}

private:
	double critical;
};

} // namespace nonsmooth::contact::slip
