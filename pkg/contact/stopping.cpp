#include <algorithm>
#include <cmath>
#include <contact/law.hpp>
#include <contact/residual.hpp>
#include <contact/stopping.hpp>
#include <cstring>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	constexpr double maxmToQuad
	        = 16.666; // LMGC90's number: in large dense packings Quad is near a sixteenth of Maxm

	/// W p, row by row; rolling as a velocity, times ℓ.
	Impulse velocityOf(const Contact& c, const Impulse& p, const Impulse& inverse)
	{
		const auto row = [](double impulse, double inverse) { return inverse > 0 ? impulse / inverse : 0; };
		return { row(p.n, inverse.n), row(p.t, inverse.t), row(p.r, inverse.r) * c.length };
	}
	/// Rolling divided by ℓ, so that the three rows are impulses.
	Impulse inImpulses(const Contact& c, const Impulse& p) { return { p.n, p.t, p.r / c.length }; }
	double  dot(const Impulse& a, const Impulse& b) { return a.n * b.n + a.t * b.t + a.r * b.r; }

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

VisitChange
changeOf(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist vi, Twist vj)
{
	const Impulse inverse = inverseDelassus(c, mi, mj);
	const Impulse next    = visit(c, p, inverse, mi, mj, vi, vj);
	const Impulse d       = velocityOf(c, { p.n - next.n, p.t - next.t, p.r - next.r }, inverse);
	const Impulse r       = inImpulses(c, { 0.5 * (p.n + next.n), 0.5 * (p.t + next.t), 0.5 * (p.r + next.r) });
	const Impulse before = velocityOf(c, p, inverse), after = velocityOf(c, next, inverse);
	return { dot(d, d), dot(r, r), dot(r, d), 0.5 * (dot(before, before) + dot(after, after)),
		 0.5 * (dot(before, inImpulses(c, p)) + dot(after, inImpulses(c, next))) };
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

VelocityChanges velocityChanges(const Problem& problem)
{
	const auto v = velocitiesOf(problem);
	ChangeSums sums;
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const Contact& c = problem.contacts[k];
		sums.add(changeOf(
		        c, problem.impulses[k], problem.inverseMass[c.i], problem.inverseMass[c.j], v[c.i], v[c.j]));
	}
	return sums.changes();
}

} // namespace nonsmooth::contact
