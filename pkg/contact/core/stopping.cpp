#include <algorithm>
#include <cmath>
#include <contact/core/stopping.hpp>
#include <cstring>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	constexpr double maxmToQuad
	        = 16.666; // LMGC90's number: in large dense packings Quad is near a sixteenth of Maxm

} // namespace

StoppingTest stoppingTestOf(const char* name)
{
	constexpr struct {
		const char*  name;
		StoppingTest test;
	} tests[] = { { "naturalMap", StoppingTest::NaturalMap },
		      { "Quad", StoppingTest::Quad },
		      { "Maxm", StoppingTest::Maxm },
		      { "QM/16", StoppingTest::QM16 } };
	for (const auto& t : tests)
		if (std::strcmp(t.name, name) == 0) return t.test;
	throw std::invalid_argument("'" + std::string(name) + "': it must be 'naturalMap', 'Quad', 'Maxm' or 'QM/16'");
}

double VelocityChanges::figure(StoppingTest test) const
{
	if (!std::isfinite(velocity + largestVelocity + work + largestWork + drift)) return HUGE_VAL; // not a solution
	const double quad = std::max({ velocity, work, std::abs(drift) }),
	             maxm = std::max(largestVelocity, largestWork);
	if (test == StoppingTest::Quad) return quad;
	if (test == StoppingTest::Maxm) return std::max(maxm, std::abs(drift));
	return std::max(quad, maxm / maxmToQuad);
}

void ChangeSums::add(const VisitChange& contact)
{
	const double all = contact.change * contact.impulse;
	square += contact.change;
	largest = std::max(largest, contact.change);
	work += all;
	largestWork = std::max(largestWork, all);
	drift += contact.drift;
	velocity += contact.velocity;
	energy += contact.energy;
	active += !(contact.impulse == 0); // what is not a number counts, and shows
}

void ChangeSums::add(const ChangeSums& other)
{
	square += other.square;
	largest = std::max(largest, other.largest);
	work += other.work;
	largestWork = std::max(largestWork, other.largestWork);
	drift += other.drift;
	velocity += other.velocity;
	energy += other.energy;
	active += other.active;
}

VelocityChanges ChangeSums::changes() const
{
	if (active == 0 || velocity == 0 || energy == 0) return {};
	const double n = static_cast<double>(active), speed = std::sqrt(velocity / n), meanEnergy = energy / n;
	return { std::sqrt(square / n) / speed, std::sqrt(largest) / speed, std::sqrt(work / n) / meanEnergy,
		 std::sqrt(largestWork) / meanEnergy, drift / energy };
}

} // namespace nonsmooth::contact
