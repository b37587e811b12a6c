#include <contact/plane/law.hpp>
#include <contact/plane/residual.hpp>
#include <contact/plane/stopping.hpp>

namespace nonsmooth::contact {
namespace {

	/// W p, row by row; rolling as a velocity, times ℓ.
	RelativeVelocity velocityOf(const Contact& c, const Impulse& p, const Diagonal& inverse)
	{
		const auto row = [](double impulse, double inverse) { return inverse > 0 ? impulse / inverse : 0; };
		return { row(p.n, inverse.n), row(p.t, inverse.t), row(p.r, inverse.r) * c.length };
	}
	/// Rolling divided by ℓ, so that the three rows are impulses.
	Impulse inImpulses(const Contact& c, const Impulse& p) { return { p.n, p.t, p.r / c.length }; }
	template <class A, class B> double dot(const A& a, const B& b) { return a.n * b.n + a.t * b.t + a.r * b.r; }

} // namespace

VisitChange
changeOf(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist vi, Twist vj)
{
	const Diagonal         inverse = inverseDelassus(c, mi, mj);
	const Impulse          next    = visit(c, p, inverse, mi, mj, vi, vj);
	const RelativeVelocity d       = velocityOf(c, { p.n - next.n, p.t - next.t, p.r - next.r }, inverse);
	const Impulse          r = inImpulses(c, { 0.5 * (p.n + next.n), 0.5 * (p.t + next.t), 0.5 * (p.r + next.r) });
	const RelativeVelocity before = velocityOf(c, p, inverse), after = velocityOf(c, next, inverse);
	return { dot(d, d), dot(r, r), dot(r, d), 0.5 * (dot(before, before) + dot(after, after)),
		 0.5 * (dot(before, inImpulses(c, p)) + dot(after, inImpulses(c, next))) };
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
