// Strength left after a slip: the functions of slip that a wall can have, by name (Taboada and Estrada 2009, section 5.3:
// the step function; the others are common idealisations of the decay they mention in section 4.3).
// A further function is one more entry in `slipWeakening`.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {

inline bool knowsSlipWeakening(const std::string& function)
{
	return function == "step" || function == "linear" || function == "exponential";
}

/// Fraction of the strength left, 1 to 0, after `slip` [m] with the critical slip `critical` [m].
/// Throws std::invalid_argument for an unknown name or a critical slip that is not positive.
inline double slipWeakening(const std::string& function, double slip, double critical)
{
	if (!(critical > 0))
		throw std::invalid_argument("criticalSlip = " + std::to_string(critical) + " m: it must be positive");
	if (function == "step") return slip < critical ? 1 : 0;
	if (function == "linear") return slip < critical ? 1 - slip / critical : 0;
	if (function == "exponential") return std::exp(-slip / critical);
	throw std::invalid_argument("weakening = '" + function + "': it must be 'step', 'linear' or 'exponential'");
}

} // namespace nonsmooth::contact
