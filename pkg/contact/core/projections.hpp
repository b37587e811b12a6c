// The projections that the laws of both dimensions (plane/law.hpp, space/law.hpp) are made of; equations stand there.
#pragma once

#include <algorithm>

namespace nonsmooth::contact {

/// Nearest admissible normal impulse, eqs (1) and (2).
inline double projectNormal(double n, double adhesion) { return std::max(n, -adhesion); }

/// The normal impulse that obeys the graph, of one without regard to it, n = P − (U + b)/W, and 1/W: nearest admissible
/// one, and of a bond with play the proximal point of ψ/W.
inline double obeyNormal(double n, double inverse, double adhesion, double play)
{
	if (!(play > 0)) return projectNormal(n, adhesion);
	return projectNormal(std::max(n, std::min(n + inverse * play, 0.0)), adhesion);
}

/// Nearest admissible tangential impulse or rolling impulse for a threshold, eqs (3) to (6).
inline double projectThreshold(double value, double threshold)
{
	return std::max(-threshold, std::min(value, threshold));
}

} // namespace nonsmooth::contact
