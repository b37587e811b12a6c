#include <cmath>
#include <contact/core/solve.tpp>
#include <contact/space/problem_scale.hpp>
#include <contact/space/sweeper.hpp>

namespace nonsmooth::contact {
namespace space {
	namespace {

		/// No patches: sweeps alone.
		struct NoPatches {
			explicit NoPatches(Sweeper<Space, double>&) { }
			bool   any() const { return false; }
			bool   settle(double, double) { return false; }
			double speed() const { return 0; }
			int    solved() const { return 0; }
		};

	} // namespace
} // namespace space

template <> struct PatchesIn<space::Space> {
	using Type = space::NoPatches;
};

} // namespace nonsmooth::contact

namespace nonsmooth::contact::space {

SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace)
{
	return solveIn<Space>(problem, settings, workspace);
}

VisitChange
changeOf(const Contact& c, const Impulse& p, const InverseMass& mi, const InverseMass& mj, Twist vi, Twist vj)
{
	const Diagonal inverse    = inverseDelassus(c, mi, mj);
	const Impulse  next       = visit(c, p, inverse, mi, mj, vi, vj);
	const auto     velocityOf = [&](const Impulse& x) { // W x, moments as velocities
                const Rows q   = rowsOf(c, x);
                const auto row = [](double inverse) { return inverse > 0 ? 1 / inverse : 0; };
                return Impulse { row(inverse.n) * q.n * c.n + row(inverse.t) * q.t,
                                 c.length * (row(inverse.s) * q.s * c.n + row(inverse.r) * q.r) };
	};
	const auto    inImpulses = [&](const Impulse& x) { return Impulse { x.f, 1 / c.length * x.m }; };
	const auto    product    = [](const Impulse& a, const Impulse& b) { return dot(a.f, b.f) + dot(a.m, b.m); };
	const Impulse d = velocityOf(difference(p, next)), before = velocityOf(p), after = velocityOf(next),
	              r = inImpulses({ 0.5 * (p.f + next.f), 0.5 * (p.m + next.m) });
	return { product(d, d), product(r, r), product(r, d), 0.5 * (product(before, before) + product(after, after)),
		 0.5 * (product(before, inImpulses(p)) + product(after, inImpulses(next))) };
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

} // namespace nonsmooth::contact::space
