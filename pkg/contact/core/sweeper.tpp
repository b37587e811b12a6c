// The functions of sweeper.hpp, for the dimension that includes them (sweeper.cpp, space/solver.cpp). Law and lanes of
// the dimension are found by its types.
#pragma once

#include <algorithm>
#include <cmath>
#include <contact/core/extrapolation.hpp>
#include <contact/core/sweeper.hpp>

namespace nonsmooth::contact {
namespace sweeping {

	constexpr std::size_t lastCache = 32 << 20; // bytes; of a common processor, and no more than a hint
	// Sweeps for which a choice of strips holds at least, since each one takes momentum away; and at most: where
	// looks at the residual are further apart, none rests.
	constexpr int shortestRest = 10, longestRest = 15;

} // namespace sweeping

template <class Dimension, class Number>
Sweeper<Dimension, Number>::Sweeper(Problem& problem_, const Settings& settings_, WorkspaceIn<Dimension>& workspace)
        : problem(problem_)
        , settings(settings_)
        , kernels(kernelsFor(settings_).template with<Number>())
        , threads(threadsFor(problem_, settings_))
        , laidOut(workspace.laidOut)
        , own(laidOut.template with<Number>())
        , bodies(workspace.template with<Number>().now)
        , bodiesBefore(workspace.template with<Number>().before)
{
	own.blocks.resize(laidOut.blockBegin.back());
	own.inverseLength.resize(laidOut.blockBegin.back());
	own.plays.resize(laidOut.inDouble.plays.size());
	outgrowsCache = own.blocks.size() * sizeof(Block) > sweeping::lastCache;
	sums.resize(laidOut.partCount());
	if (settings.stopping != StoppingTest::NaturalMap) changeSums.resize(laidOut.partCount());
	bodies.resize(problem.bodyCount() + 1);
	bodiesBefore.resize(problem.bodyCount() + 1);
	bodies.back() = Motion {};
	scale         = { roundedShare<Number>(), 0, leastSquaredSpeed<Number>(laidOut.classification.fastest) };
	strips.reset(laidOut.order.partBegin, laidOut.order.evenStrips);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::fillRows()
{
	rows.resize(laidOut.others.size());
	for (std::size_t k = 0; k < rows.size(); ++k) {
		Contact       c  = problem.contacts[laidOut.others[k]];
		const auto    mi = problem.inverseMass[c.i], mj = problem.inverseMass[c.j];
		const Impulse p = project(c, problem.impulses[laidOut.others[k]]);
		addBias(c, relativeVelocity(c, problem.freeVelocity[c.i], problem.freeVelocity[c.j]));
		c.i     = laidOut.placeOf[c.i];
		c.j     = laidOut.placeOf[c.j];
		rows[k] = { c, mi, mj, p, p, inverseDelassus(c, mi, mj) };
	}
}

/// Leaves fixed bodies alone, which several threads may visit.
template <class Dimension, class Number>
void Sweeper<Dimension, Number>::setTwists(const Row& row, const Twist& vi, const Twist& vj, std::vector<Motion>& in)
{
	const auto set = [&in](std::int32_t place, const auto& mass, const Twist& v) {
		if (!mass.isFixed()) setTwist(in[place], v);
	};
	set(row.contact.i, row.mi, vi);
	set(row.contact.j, row.mj, vj);
}

template <class Dimension, class Number>
void Sweeper<Dimension, Number>::push(const Row& row, const Impulse& impulse, std::vector<Motion>& in)
{
	Twist vi = twistOf(in[row.contact.i]), vj = twistOf(in[row.contact.j]);
	applyImpulse(row.contact, impulse, row.mi, row.mj, vi, vj);
	setTwists(row, vi, vj, in);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::plan()
{
#pragma omp single
	schedule.plan(laidOut.order.partBegin, laidOut.order.evenStrips, omp_get_num_threads());
}

/// A strip of the first half is the first to touch its own bodies and those of the next one.
template <class Dimension, class Number>
typename Sweeper<Dimension, Number>::Places Sweeper<Dimension, Number>::newIn(std::size_t s) const
{
	const SweepOrder& order = laidOut.order;
	if (s >= order.evenStrips) return { 0, 0 };
	return { order.bodyBegin[2 * s], order.bodyBegin[std::min(2 * s + 2, order.stripCount())] };
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::setOut(std::size_t place, std::int32_t body)
{
	setUnchanged(bodies[place], problem.inverseMass[body]);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::setOut(std::size_t s)
{
	forNew(s, [this](std::size_t place, std::int32_t b) { setOut(place, b); });
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::applyRows(std::size_t s)
{
	for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
		push(rows[k], rows[k].p, bodies);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::keepBodies(std::size_t s)
{
	const Places places = newIn(s);
	std::copy(bodies.begin() + places.begin, bodies.begin() + places.end, bodiesBefore.begin() + places.begin);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::sweepRows(std::size_t s, double beta)
{
	for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
		Row&          row = rows[k];
		const Impulse y   = extrapolated(row.p, row.before, beta);
		Twist         vi = twistAt(row.contact.i), vj = twistAt(row.contact.j);
		row.before = row.p;
		row.p      = visit(row.contact, y, row.inverse, row.mi, row.mj, vi, vj);
		setTwists(row, vi, vj, bodies);
	}
}

/// Chooses the strips that are visited until the next choice, by what keeps the problem from being solved.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::chooseStrips(double tolerance)
{
	const auto& begin = laidOut.order.partBegin;
	if (settings.checkEvery > sweeping::longestRest || settings.stopping != StoppingTest::NaturalMap) return;
	if (begin.back() > begin[begin.size() - 2]) return; // what is left over moves bodies of any strip
#pragma omp barrier
#pragma omp single
	if (strips.choose(sums, residual.relative() <= tolerance ? &ResidualSums::speed : &ResidualSums::square))
		schedule.plan(strips.work(), laidOut.order.evenStrips, omp_get_num_threads());
	if (!strips.anyComesToRest()) return;
	// one worker's stretch may have most of them, so each takes what comes next; no two even strips share bodies,
	// nor do two odd ones
	const long even = static_cast<long>(laidOut.order.evenStrips), all = static_cast<long>(begin.size()) - 2;
	for (const auto& [first, end] : { std::pair(0L, even), std::pair(even, all) }) {
#pragma omp for schedule(dynamic, 1)
		for (long s = first; s < end; ++s)
			if (strips.comesToRest(s)) loseMomentum(s);
	}
}

/// A strip that comes to rest keeps its impulses P_k, so that P_k − P_{k−1} goes out of what its bodies' velocities are
/// extrapolated by.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::loseMomentum(std::size_t s)
{
	kernels.rest(blocksOf(s), countOf(s), bodiesBefore.data());
	for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
		Row& row = rows[k];
		push(row, difference(row.p, row.before), bodiesBefore);
		row.before = row.p;
	}
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::extrapolate(std::size_t s, double beta)
{
	if (settings.method != Method::Accelerated) return;
	const Places places = newIn(s);
	kernels.extrapolate(
	        bodies.data() + places.begin, bodiesBefore.data() + places.begin, places.end - places.begin, beta);
}

/// One sweep of the active strips for each beta, from what impulses and velocities become when they are extrapolated by
/// it, and the residual after the last
/// one, strip by strip while it is at hand.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::sweep(const std::vector<double>& betas)
{
	const int sweeps = static_cast<int>(betas.size());
	schedule.passes(
	        omp_get_thread_num(), sweeps + 1,
	        [this, &betas, sweeps](std::size_t s, int pass, const StripSchedule::Ahead& ahead) {
		        if (pass == sweeps) {
			        if (strips.changes(s)) measureStrip(s, false);
			        return;
		        }
		        const double beta = betas[pass];
		        if (s < laidOut.order.evenStrips && strips.moves(s)) extrapolate(s, beta);
		        if (!strips.isActive(s)) return;
		        if (ahead.parts > 0 && outgrowsCache)
			        kernels.sweepAndFetch(
			                blocksOf(s), playsOf(s), countOf(s), bodies.data(), beta,
			                blocksOf(ahead.strip) + countOf(ahead.strip) * ahead.part / ahead.parts);
		        else
			        kernels.sweep(blocksOf(s), playsOf(s), countOf(s), bodies.data(), beta);
		        sweepRows(s, beta);
	        });
}

template <class Dimension, class Number>
void Sweeper<Dimension, Number>::measureRows(std::size_t s, bool speeds, ResidualSums& sums) const
{
	for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
		const Contact& c  = rows[k].contact;
		const Impulse& p  = rows[k].p;
		const Twist    vi = twistAt(c.i), vj = twistAt(c.j);
		const Impulse  defect = naturalMapDefect(c, p, relativeVelocity(c, vi, vj), rows[k].inverse);
		sums.addSquares(squareNorm(c, defect), squareNorm(c, p));
		if (speeds)
			sums.addShare(
			        speedShare(c, p, defect, rows[k].mi, rows[k].mj, vi, vj, scale), acts(c, p, defect));
	}
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::measureStrip(std::size_t s, bool speeds)
{
	const auto* blocks    = blocksOf(s);
	const auto* perLength = own.inverseLength.data() + laidOut.blockBegin[s];
	if (speeds)
		sums[s] = kernels.measure(
		        blocks, perLength, playsOf(s), countOf(s), bodies.data(), static_cast<Number>(scale.share),
		        static_cast<Number>(scale.mean), static_cast<Number>(scale.least));
	else
		sums[s] = kernels.measureImpulses(blocks, perLength, playsOf(s), countOf(s), bodies.data());
	measureRows(s, speeds, sums[s]);
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::sumUp()
{
#pragma omp barrier
#pragma omp single
	{
		ResidualSums all;
		for (const ResidualSums& s : sums)
			all.add(s);
		residual = all.residual(problem.contactCount());
		if (residual.relative() <= settings.tolerance) scale.mean = meanSquaredChange();
	}
	if (settings.stopping != StoppingTest::NaturalMap) measureChanges();
}

/// Sums up what is measured of impulses; where they are solved, speeds are measured, too, by the scale of them that
/// follows.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::judge(double tolerance)
{
	sumUp();
	if (settings.stopping != StoppingTest::NaturalMap || !(residual.relative() <= tolerance)) return;
#pragma omp barrier // others may still look at the residual
	schedule.each(omp_get_thread_num(), [this](std::size_t s) { measureStrip(s, true); });
	sumUp();
}

/// Measures impulses and speeds, solved or not: at once by the scale of what is solved, as it is as a rule; where it is
/// not, once more by the last one.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::judgeAll()
{
	const double last = scale.mean;
#pragma omp barrier // others may still move bodies
	const double present  = meanSquaredChange();
	const auto   measured = [this](double mean) {
#pragma omp barrier // or look at the scale, and at the residual
#pragma omp single
		scale.mean = mean;
		schedule.each(omp_get_thread_num(), [this](std::size_t s) { measureStrip(s, true); });
		sumUp();
	};
	measured(present);
	if (!(residual.relative() <= settings.tolerance)) measured(last);
}

/// Of what impulses have changed of the velocities of bodies that can move.
template <class Dimension, class Number> double Sweeper<Dimension, Number>::meanSquaredChange() const
{
	const std::size_t count = laidOut.order.bodyBegin.back(); // those in strips come first
	double            sum   = 0;
	for (std::size_t k = 0; k < count; ++k) {
		sum += squaredSpeed(twistAt(static_cast<std::int32_t>(k)));
	}
	return sum / double(std::max<std::size_t>(count, 1));
}

/// The figures of LMGC90's tests with the present velocities, summed strip by strip.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::measureChanges()
{
	const long count = static_cast<long>(changeSums.size());
#pragma omp for schedule(static)
	for (long s = 0; s < count; ++s) {
		changeSums[s] = {};
		forImpulses(s, [this, s](std::int32_t index, const Impulse& p) {
			const Contact& c = problem.contacts[index];
			changeSums[s].add(changeOf(
			        c, p, problem.inverseMass[c.i], problem.inverseMass[c.j], twist(c.i), twist(c.j)));
		});
	}
#pragma omp single
	{
		ChangeSums all;
		for (const ChangeSums& s : changeSums)
			all.add(s);
		changes = all.changes();
	}
}

template <class Dimension, class Number> bool Sweeper<Dimension, Number>::solved(double tolerance) const
{
	return settings.stopping == StoppingTest::NaturalMap
	        ? residual.missed(tolerance, laidOut.classification.uneven) <= 1
	        : changes.figure(settings.stopping) <= tolerance;
}

/// All strips are visited again.
template <class Dimension, class Number> void Sweeper<Dimension, Number>::wakeStrips()
{
#pragma omp barrier // others may still look at what is active
#pragma omp single
	if (strips.wakeAll()) schedule.plan(laidOut.order.partBegin, laidOut.order.evenStrips, omp_get_num_threads());
}

template <class Dimension, class Number> void Sweeper<Dimension, Number>::iterate(const StoppingCriterion& until)
{
	Method              method = settings.method;
	Extrapolation       extrapolation(method);
	int                 begunAnew = 0;
	const double        all       = std::max<std::size_t>(problem.contactCount(), 1);
	double              made      = 0; // visits
	int                 chosen    = sweeping::shortestRest; // sweeps since the last choice of strips
	RestartRule         rule(residual.rms, settings.checkEvery);
	StagnationRule      stagnation(residual.rms);
	std::vector<double> betas; // of the sweeps until the next look at the residual
	while (!solved(until.tolerance) && std::isfinite(residual.rms + residual.speed)) {
		if (method == Method::Accelerated && chosen >= sweeping::shortestRest) {
			chooseStrips(until.tolerance);
			chosen = 0;
		}
		// what a sweep counts for; threads wait for each other in short ones too
		const double one = std::max(static_cast<double>(strips.contacts()), all / 4);
		betas.resize(std::min<double>(settings.checkEvery, (until.sweeps * all - made) / one));
		if (betas.empty()) break;
		for (double& b : betas)
			b = extrapolation.next();
		sweep(betas);
		made += static_cast<double>(betas.size()) * one;
		chosen += static_cast<int>(betas.size());
		judge(until.tolerance);
		if (method != Method::Accelerated) continue;
		const bool stagnates = stagnation.asks(residual.rms, static_cast<int>(betas.size()));
		if (!rule.asks(residual.rms) && !stagnates) continue;
		if (stagnates) {
			method = Method::GaussSeidel;
			wakeStrips();
		} else
			++begunAnew;
		extrapolation = Extrapolation(method);
	}
	wakeStrips();
#pragma omp single
	{
		iterations += static_cast<int>(std::ceil(made / all));
		restarts += begunAnew;
	}
}

} // namespace nonsmooth::contact
