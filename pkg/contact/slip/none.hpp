// Nothing weakens: τ = f σ. What other laws are held against.
#pragma once

#include <algorithm>
#include <contact/slip/by_slip.hpp>

namespace nonsmooth::contact::slip {

class None : public BySlip {
public:
	using BySlip::left;
	/// Friction [-]. Throws std::invalid_argument where it is negative.
	explicit None(double friction = 0)
	        : BySlip(friction, friction)
	{
	}
	void left(const double* /*slip*/, double* share, std::size_t count) const override
	{
		std::fill_n(share, count, 1.0);
	}
};

} // namespace nonsmooth::contact::slip
