#include <contact/core/residual.hpp>

namespace nonsmooth::contact {

void ResidualSums::addSquares(double defect, double impulse)
{
	square += defect;
	largest = std::max(largest, defect);
	scale += impulse;
}

void ResidualSums::addShare(const SpeedShare& share, bool acts)
{
	speed += share.all;
	largestSpeed = std::max(largestSpeed, share.point);
	active += acts;
}

void ResidualSums::add(const ResidualSums& other)
{
	square += other.square;
	scale += other.scale;
	largest = std::max(largest, other.largest);
	speed += other.speed;
	largestSpeed = std::max(largestSpeed, other.largestSpeed);
	active += other.active;
}

Residual ResidualSums::residual(std::size_t contacts) const
{
	const double n = std::max<std::size_t>(contacts, 1);
	return { std::sqrt(square / n), std::sqrt(largest), std::sqrt(scale / n),
		 std::sqrt(speed / std::max(active, 1.0)), std::sqrt(largestSpeed) };
}

} // namespace nonsmooth::contact
