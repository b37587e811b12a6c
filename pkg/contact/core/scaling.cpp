#include <algorithm>
#include <cmath>
#include <contact/core/scaling.hpp>

namespace nonsmooth::contact {

std::optional<Scaling> scalingOfLostSquares(const Classification& classification)
{
	constexpr double lost  = 1e-120; // its square is far from a double's 15 digits
	const double     speed = classification.fastest, lightness = classification.lightness;
	if (!(speed > 0) || !std::isfinite(lightness) || !(std::min(speed, speed / lightness) < lost)) return {};
	return Scaling { -std::ilogb(speed), std::ilogb(lightness) };
}

} // namespace nonsmooth::contact
