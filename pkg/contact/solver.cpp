#include <algorithm>
#include <cmath>
#include <contact/active_strips.hpp>
#include <contact/contact_blocks.hpp>
#include <contact/extrapolation.hpp>
#include <contact/law.hpp>
#include <contact/problem_check.hpp>
#include <contact/solver.hpp>
#include <contact/strip_schedule.hpp>
#include <omp.h>
#include <stdexcept>
#include <string>
#include <utility>

namespace nonsmooth::contact {
namespace {

	/// A contact outside the blocks, swept row by row; with its data beside it, so that memory is gone through in the order of the sweep.
	struct Row {
		Contact     contact; // names bodies by their places
		InverseMass mi, mj;
		Impulse     p, before; // P_k, P_{k−1}
		Impulse     inverse; // 1/W_nn, 1/W_tt, 1/W_rr
	};

	constexpr std::size_t lastCache = 32 << 20; // bytes; of a common processor, and no more than a hint
	// Sweeps for which a choice of strips holds at least, since each one takes momentum away; and at most: where looks at the residual are further apart, none rests.
	constexpr int shortestRest = 10, longestRest = 15;

	/// Few contacts are not worth waking threads for.
	int threadsFor(const Problem& problem, const SolverSettings& settings)
	{
		return problem.contactCount() < 1000 ? 1 : settings.threads;
	}

	class Sweeper {
	public:
		/// `laidOut`: the workspace holds the blocks of this very problem.
		Sweeper(Problem& problem, const SolverSettings& settings, Workspace& workspace, bool isLaidOut = false);
		SolverStatistics run();
		void correct(const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result);

	private:
		/// Places of the bodies that a part of the order is the first to touch in a pass.
		struct Places {
			std::size_t begin, end;
		};
		Places                     newIn(std::size_t strip) const;
		template <class With> void forFixed(With with);

		void                       takeVelocity(std::size_t place, std::int32_t body);
		void                       takeVelocities(std::size_t strip);
		void                       applyStrip(std::size_t strip);
		void                       applyRows(std::size_t strip);
		void                       keepBodies(std::size_t strip);
		void                       begin();
		void                       iterate();
		void                       sweep(const std::vector<double>& betas);
		void                       chooseStrips();
		void                       loseMomentum(std::size_t strip);
		void                       extrapolate(std::size_t strip, double beta);
		void                       takeErrors(std::size_t strip, const std::vector<PositionError>& errors);
		void                       sweepRow(std::size_t row, double beta);
		void                       measureStrip(std::size_t strip);
		void                       measureRows(std::size_t strip, ResidualSums& sums) const;
		void                       sumUp();
		void                       measureChanges();
		bool                       solved(double slack) const;
		void                       finish();
		void                       writeStrip(std::size_t strip);
		template <class Take> void forImpulses(std::size_t strip, Take take) const;
		Twist                      twistAt(std::int32_t place) const
		{
			return { bodies[place].v[0], bodies[place].v[1], bodies[place].v[2] };
		}
		Twist       twist(std::int32_t body) const { return twistAt(laidOut.placeOf[body]); }
		static void setTwists(const Row& row, const Twist& vi, const Twist& vj, std::vector<Motion>& in);

		Problem&                  problem;
		const SolverSettings&     settings;
		const BlockKernels&       kernels;
		const int                 threads;
		ContactBlocks&            laidOut;
		bool                      outgrowsCache; // whether blocks have to be fetched from memory in every sweep
		StripSchedule             schedule;
		ActiveStrips              strips;
		std::vector<Row>          rows;
		std::vector<Motion>&      bodies; // by place; the last one is nobody
		std::vector<Motion>&      bodiesBefore;
		std::vector<ResidualSums> sums; // one a part of the order
		Residual                  residual;
		std::vector<ChangeSums>   changeSums; // one a part of the order
		VelocityChanges           changes;
		SolverStatistics          statistics;
	};

	Sweeper::Sweeper(Problem& problem_, const SolverSettings& settings_, Workspace& workspace, bool isLaidOut)
	        : problem(problem_)
	        , settings(settings_)
	        , kernels(settings_.kernels ? *settings_.kernels : *availableKernels().front())
	        , threads(threadsFor(problem_, settings_))
	        , laidOut(workspace.laidOut)
	        , bodies(workspace.bodies)
	        , bodiesBefore(workspace.bodiesBefore)
	{
		if (!isLaidOut) layOut(problem, threads, laidOut, !settings.reference);
		outgrowsCache = laidOut.blocks.size() * sizeof(Block) > lastCache;
		rows.resize(laidOut.others.size());
		sums.resize(laidOut.partCount());
		if (settings.stopping != StoppingTest::NaturalMap) changeSums.resize(laidOut.partCount());
		bodies.resize(problem.bodyCount() + 1);
		bodiesBefore.resize(problem.bodyCount() + 1);
		for (std::size_t k = 0; k < rows.size(); ++k) {
			Contact           c  = problem.contacts[laidOut.others[k]];
			const InverseMass mi = problem.inverseMass[c.i], mj = problem.inverseMass[c.j];
			const Impulse     p = project(c, problem.impulses[laidOut.others[k]]);
			c.i                 = laidOut.placeOf[c.i];
			c.j                 = laidOut.placeOf[c.j];
			rows[k]             = { c, mi, mj, p, p, inverseDelassus(c, mi, mj) };
		}
		bodies.back() = Motion {};
		problem.velocities.resize(problem.bodyCount());
		strips.reset(laidOut.order.partBegin, laidOut.order.evenStrips);
		statistics.strips = static_cast<int>(laidOut.order.stripCount());
	}

	/// Leaves fixed bodies alone, which several threads may visit.
	void Sweeper::setTwists(const Row& row, const Twist& vi, const Twist& vj, std::vector<Motion>& in)
	{
		const auto set = [&in](std::int32_t place, const InverseMass& mass, const Twist& v) {
			if (mass.isFixed()) return;
			Lanes& motion = in[place].v;
			motion[0]     = v.x;
			motion[1]     = v.y;
			motion[2]     = v.w;
		};
		set(row.contact.i, row.mi, vi);
		set(row.contact.j, row.mj, vj);
	}

	/// A strip of the first half is the first to touch its own bodies and those of the next one.
	Sweeper::Places Sweeper::newIn(std::size_t s) const
	{
		const SweepOrder& order = laidOut.order;
		if (s >= order.evenStrips) return { 0, 0 };
		return { order.bodyBegin[2 * s], order.bodyBegin[std::min(2 * s + 2, order.stripCount())] };
	}

	/// Calls with(place, body) for the bodies that no strip has, and waits until all is done.
	template <class With> void Sweeper::forFixed(With with)
	{
		const long first = static_cast<long>(laidOut.order.bodyBegin.back()),
		           count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long k = first; k < count; ++k)
			with(k, laidOut.order.bodies[k]);
	}

	/// Sets a body out with the velocity that no contact has changed yet.
	void Sweeper::takeVelocity(std::size_t place, std::int32_t b)
	{
		const Twist& v  = problem.freeVelocity[b];
		bodies[place].v = Lanes { v.x, v.y, v.w, problem.inverseMass[b].x };
	}

	/// The same for a part's bodies.
	void Sweeper::takeVelocities(std::size_t s)
	{
		const Places places = newIn(s);
		for (std::size_t k = places.begin; k < places.end; ++k)
			takeVelocity(k, laidOut.order.bodies[k]);
	}

	/// Adds M⁻¹ Hᵀ P.
	void Sweeper::applyStrip(std::size_t s)
	{
		kernels.apply(
		        laidOut.blocks.data() + laidOut.blockBegin[s],
		        laidOut.blockBegin[s + 1] - laidOut.blockBegin[s], bodies.data());
		applyRows(s);
	}

	void Sweeper::applyRows(std::size_t s)
	{
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const Row& row = rows[k];
			Twist      vi = twistAt(row.contact.i), vj = twistAt(row.contact.j);
			applyImpulse(row.contact, row.p, row.mi, row.mj, vi, vj);
			setTwists(row, vi, vj, bodies);
		}
	}

	/// For the first extrapolation, which has nothing to go by.
	void Sweeper::keepBodies(std::size_t s)
	{
		const Places places = newIn(s);
		std::copy(
		        bodies.begin() + places.begin, bodies.begin() + places.end,
		        bodiesBefore.begin() + places.begin);
	}

	/// Velocities and impulses of the warm start, and their residual. A strip's numbers are filled in and used while they are at hand.
	void Sweeper::begin()
	{
		forFixed([this](long place, std::int32_t b) { takeVelocity(place, b); });
		schedule.passes(omp_get_thread_num(), 2, [this](std::size_t s, int pass, const StripSchedule::Ahead&) {
			if (pass == 0) {
				fillIn(problem, kernels, s, laidOut);
				takeVelocities(s);
				applyStrip(s);
			} else {
				keepBodies(s);
				measureStrip(s);
			}
		});
		sumUp();
	}

	/// Any contact, one after the other of its three graphs.
	void Sweeper::sweepRow(std::size_t k, double beta)
	{
		Row&          row = rows[k];
		const Impulse y { row.p.n + beta * (row.p.n - row.before.n), row.p.t + beta * (row.p.t - row.before.t),
			          row.p.r + beta * (row.p.r - row.before.r) };
		Twist         vi = twistAt(row.contact.i), vj = twistAt(row.contact.j);
		row.before = row.p;
		row.p      = visit(row.contact, y, row.inverse, row.mi, row.mj, vi, vj);
		setTwists(row, vi, vj, bodies);
	}

	/// Chooses the strips that are visited until the next choice.
	void Sweeper::chooseStrips()
	{
		const auto& begin = laidOut.order.partBegin;
		if (settings.method != Method::Accelerated || settings.checkEvery > longestRest
		    || settings.stopping != StoppingTest::NaturalMap)
			return;
		if (begin.back() > begin[begin.size() - 2]) return; // what is left over moves bodies of any strip
#pragma omp barrier
#pragma omp single
		if (strips.choose(sums)) schedule.plan(strips.work(), laidOut.order.evenStrips, omp_get_num_threads());
		if (!strips.anyComesToRest()) return;
		// one worker's stretch may have most of them, so each takes what comes next; no two even strips share bodies, nor do two odd ones
		const long even = static_cast<long>(laidOut.order.evenStrips),
		           all  = static_cast<long>(begin.size()) - 2;
		for (const auto& [first, end] : { std::pair(0L, even), std::pair(even, all) }) {
#pragma omp for schedule(dynamic, 1)
			for (long s = first; s < end; ++s)
				if (strips.comesToRest(s)) loseMomentum(s);
		}
	}

	/// A strip that comes to rest keeps its impulses P_k, so that P_k − P_{k−1} goes out of what its bodies' velocities are extrapolated by.
	void Sweeper::loseMomentum(std::size_t s)
	{
		kernels.rest(
		        laidOut.blocks.data() + laidOut.blockBegin[s],
		        laidOut.blockBegin[s + 1] - laidOut.blockBegin[s], bodiesBefore.data());
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			Row&       row    = rows[k];
			const auto before = [this](std::int32_t place) {
				const Lanes& v = bodiesBefore[place].v;
				return Twist { v[0], v[1], v[2] };
			};
			Twist         vi = before(row.contact.i), vj = before(row.contact.j);
			const Impulse lost { row.p.n - row.before.n, row.p.t - row.before.t, row.p.r - row.before.r };
			applyImpulse(row.contact, lost, row.mi, row.mj, vi, vj);
			setTwists(row, vi, vj, bodiesBefore);
			row.before = row.p;
		}
	}

	void Sweeper::extrapolate(std::size_t s, double beta)
	{
		if (settings.method != Method::Accelerated) return;
		const Places places = newIn(s);
		kernels.extrapolate(
		        bodies.data() + places.begin, bodiesBefore.data() + places.begin, places.end - places.begin,
		        beta);
	}

	/// One sweep of the active strips for each beta, from what impulses and velocities become when they are extrapolated by it, and the residual after the last
	/// one, strip by strip while it is at hand.
	void Sweeper::sweep(const std::vector<double>& betas)
	{
		const int sweeps = static_cast<int>(betas.size());
		schedule.passes(
		        omp_get_thread_num(), sweeps + 1,
		        [this, &betas, sweeps](std::size_t s, int pass, const StripSchedule::Ahead& ahead) {
			        if (pass == sweeps) {
				        if (strips.changes(s)) measureStrip(s);
				        return;
			        }
			        const double beta = betas[pass];
			        if (s < laidOut.order.evenStrips && strips.moves(s)) extrapolate(s, beta);
			        if (!strips.isActive(s)) return;
			        Block* const      blocks = laidOut.blocks.data() + laidOut.blockBegin[s];
			        const std::size_t count  = laidOut.blockBegin[s + 1] - laidOut.blockBegin[s];
			        if (ahead.parts > 0 && outgrowsCache) {
				        const std::size_t begin = laidOut.blockBegin[ahead.strip],
				                          next  = laidOut.blockBegin[ahead.strip + 1] - begin;
				        kernels.sweepAndFetch(
				                blocks, count, bodies.data(), beta,
				                laidOut.blocks.data() + begin + next * ahead.part / ahead.parts);
			        } else
				        kernels.sweep(blocks, count, bodies.data(), beta);
			        for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
				        sweepRow(k, beta);
		        });
	}

	void Sweeper::measureRows(std::size_t s, ResidualSums& sums) const
	{
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const Contact& c   = rows[k].contact;
			const Impulse& p   = rows[k].p;
			const double   one = squareNorm(
			          c,
			          naturalMapDefect(
			                  c, p, relativeVelocity(c, twistAt(c.i), twistAt(c.j)), rows[k].inverse));
			sums.square += one;
			sums.largest = std::max(sums.largest, one);
			sums.scale += squareNorm(c, p);
		}
	}

	/// Natural-map residual of a strip with the present velocities.
	void Sweeper::measureStrip(std::size_t s)
	{
		const std::size_t begin = laidOut.blockBegin[s];
		sums[s]                 = kernels.measure(
		                        laidOut.blocks.data() + begin, laidOut.inverseLength.data() + begin,
		                        laidOut.blockBegin[s + 1] - begin, bodies.data());
		measureRows(s, sums[s]);
	}

	/// The residual from those of the strips.
	void Sweeper::sumUp()
	{
#pragma omp barrier
#pragma omp single
		{
			ResidualSums all;
			for (const ResidualSums& s : sums) {
				all.square += s.square;
				all.scale += s.scale;
				all.largest = std::max(all.largest, s.largest);
			}
			const double n = std::max<std::size_t>(problem.contactCount(), 1);
			residual = { std::sqrt(all.square / n), std::sqrt(all.largest), std::sqrt(all.scale / n) };
		}
		if (settings.stopping != StoppingTest::NaturalMap) measureChanges();
	}

	/// The figures of LMGC90's tests with the present velocities, summed strip by strip.
	void Sweeper::measureChanges()
	{
		const long count = static_cast<long>(changeSums.size());
#pragma omp for schedule(static)
		for (long s = 0; s < count; ++s) {
			changeSums[s]  = {};
			const auto add = [this, s](std::int32_t index, const Impulse& p) {
				const Contact& c = problem.contacts[index];
				changeSums[s].add(
				        c, p, problem.inverseMass[c.i], problem.inverseMass[c.j], twist(c.i),
				        twist(c.j));
			};
			for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b) {
				const Block& k = laidOut.blocks[b];
				for (std::size_t l = 0; l < lanes; ++l)
					if (const auto index = laidOut.contactOf[b * lanes + l];
					    index != ContactBlocks::none)
						add(index, { k.n.v[l], k.t.v[l], k.r.v[l] });
			}
			for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
				add(laidOut.others[k], rows[k].p);
		}
#pragma omp single
		{
			ChangeSums all;
			for (const ChangeSums& s : changeSums)
				all.add(s);
			changes = all.changes();
		}
	}

	bool Sweeper::solved(double slack) const
	{
		const double figure = settings.stopping == StoppingTest::NaturalMap ? residual.relative()
		                                                                    : changes.figure(settings.stopping);
		return figure <= settings.tolerance * slack;
	}

	/// Sweeps until the residual holds; every thread runs through it with its own copies of the scalars.
	void Sweeper::iterate()
	{
		Extrapolation       extrapolation(settings.method);
		int                 restarts = 0;
		const double        all      = std::max<std::size_t>(problem.contactCount(), 1);
		double              made     = 0; // visits
		int                 chosen   = shortestRest; // sweeps since the last choice of strips
		RestartRule         rule(residual.rms, settings.checkEvery);
		std::vector<double> betas; // of the sweeps until the next look at the residual
		while (!solved(1)) {
			if (chosen >= shortestRest) {
				chooseStrips();
				chosen = 0;
			}
			// what a sweep counts for; threads wait for each other in short ones too
			const double one = std::max(static_cast<double>(strips.contacts()), all / 4);
			betas.resize(
			        std::min<double>(settings.checkEvery, (settings.maxIterations * all - made) / one));
			if (betas.empty()) break;
			for (double& b : betas)
				b = extrapolation.next();
			sweep(betas);
			made += static_cast<double>(betas.size()) * one;
			chosen += static_cast<int>(betas.size());
			sumUp();
			if (!rule.asks(residual.rms) || settings.method != Method::Accelerated) continue;
			++restarts;
			extrapolation = Extrapolation(settings.method);
		}
#pragma omp barrier // others may still look at what is active
#pragma omp single
		{
			statistics.iterations = static_cast<int>(std::ceil(made / all));
			statistics.restarts   = restarts;
			if (strips.wakeAll())
				schedule.plan(laidOut.order.partBegin, laidOut.order.evenStrips, omp_get_num_threads());
		}
	}

	/// Calls take(contact, impulse) for every contact of a part.
	template <class Take> void Sweeper::forImpulses(std::size_t s, Take take) const
	{
		for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b)
			for (std::size_t l = 0; l < lanes; ++l)
				if (const auto index = laidOut.contactOf[b * lanes + l]; index != ContactBlocks::none) {
					const Block& k = laidOut.blocks[b];
					take(index, Impulse { k.n.v[l], k.t.v[l], k.r.v[l] });
				}
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
			take(laidOut.others[k], rows[k].p);
	}

	/// Gives back the impulses of a part, and the velocities of the bodies that it is the first to touch.
	void Sweeper::writeStrip(std::size_t s)
	{
		forImpulses(s, [this](std::int32_t index, const Impulse& p) { problem.impulses[index] = p; });
		const Places places = newIn(s);
		for (std::size_t k = places.begin; k < places.end; ++k)
			problem.velocities[laidOut.order.bodies[k]] = twistAt(k);
	}

	/// Velocities anew, so that the residual reported owes nothing to rounding gathered over the sweeps; where there were none, they are so already.
	void Sweeper::finish()
	{
		forFixed([this](long place, std::int32_t b) { problem.velocities[b] = twistAt(place); });
		if (statistics.iterations == 0) {
			schedule.each(omp_get_thread_num(), [this](std::size_t s) { writeStrip(s); });
			return;
		}
		schedule.passes(omp_get_thread_num(), 2, [this](std::size_t s, int pass, const StripSchedule::Ahead&) {
			if (pass == 0) {
				takeVelocities(s);
				applyStrip(s);
			} else {
				measureStrip(s);
				writeStrip(s);
			}
		});
		sumUp();
	}

	SolverStatistics Sweeper::run()
	{
#pragma omp parallel num_threads(threads)
		{
#pragma omp single
			schedule.plan(laidOut.order.partBegin, laidOut.order.evenStrips, omp_get_num_threads());
			begin();
			iterate();
			finish();
		}
		statistics.residual  = residual;
		statistics.changes   = changes;
		statistics.converged = solved(1 + 1e-6); // velocities computed anew may round the other way
		return statistics;
	}

	/// Makes displacements of velocities: nothing has moved, and contacts ask for their errors along the normal alone.
	void Sweeper::takeErrors(std::size_t s, const std::vector<PositionError>& errors)
	{
		constexpr double without = 1e100; // a bond holds whatever it costs
		for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b) {
			Block& k = laidOut.blocks[b];
			for (std::size_t l = 0; l < lanes; ++l)
				if (const auto index = laidOut.contactOf[b * lanes + l]; index != ContactBlocks::none) {
					k.biasN.v[l]    = errors[index].error;
					k.adhesion.v[l] = errors[index].held ? without : 0;
					k.n.v[l] = k.beforeN.v[l] = projectNormal(
					        errors[index].impulse, k.adhesion.v[l]);
				}
		}
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const PositionError& e = errors[laidOut.others[k]];
			Contact&             c = rows[k].contact;
			c.biasN                = e.error;
			c.adhesion             = e.held ? without : 0;
			c.biasT = c.biasR = c.friction = c.rollingArm = 0;
			rows[k].p = rows[k].before = { projectNormal(e.impulse, c.adhesion), 0, 0 };
		}
		const Places places = newIn(s);
		for (std::size_t k = places.begin; k < places.end; ++k)
			bodies[k].v = Lanes { 0, 0, 0, problem.inverseMass[laidOut.order.bodies[k]].x };
	}

	void Sweeper::correct(const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result)
	{
		result.displacements.resize(problem.bodyCount());
		result.impulses.resize(problem.contactCount());
		Extrapolation       extrapolation(settings.method);
		std::vector<double> betas(sweeps);
		for (double& b : betas)
			b = extrapolation.next();
		const auto visit = [&](std::size_t s, int pass, const StripSchedule::Ahead&) {
			Block* const      blocks = laidOut.blocks.data() + laidOut.blockBegin[s];
			const std::size_t count  = laidOut.blockBegin[s + 1] - laidOut.blockBegin[s];
			if (pass == 0) {
				takeErrors(s, errors);
				kernels.applyNormals(blocks, count, bodies.data());
				applyRows(s);
			} else if (pass <= sweeps) {
				if (pass == 1) keepBodies(s);
				extrapolate(s, betas[pass - 1]);
				kernels.sweepNormals(blocks, count, bodies.data(), betas[pass - 1]);
				for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
					sweepRow(k, betas[pass - 1]);
			} else {
				forImpulses(s, [&](std::int32_t index, const Impulse& p) {
					result.impulses[index] = p.n;
				});
				const Places places = newIn(s);
				for (std::size_t k = places.begin; k < places.end; ++k)
					result.displacements[laidOut.order.bodies[k]] = twistAt(k);
			}
		};
#pragma omp parallel num_threads(threads)
		{
#pragma omp single
			schedule.plan(laidOut.order.partBegin, laidOut.order.evenStrips, omp_get_num_threads());
			forFixed([&](long place, std::int32_t b) {
				bodies[place].v         = Lanes { 0, 0, 0, problem.inverseMass[b].x };
				result.displacements[b] = {};
			});
			schedule.passes(omp_get_thread_num(), sweeps + 2, visit);
		}
	}

} // namespace

void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result)
{
	const ContactBlocks& blocks = workspace.laidOut;
	if (errors.size() != problem.contactCount() || blocks.order.order.size() != problem.contactCount()
	    || blocks.placeOf.size() != problem.bodyCount())
		throw std::invalid_argument(
		        "correctPositions: " + std::to_string(errors.size()) + " errors for "
		        + std::to_string(problem.contactCount()) + " contacts, of which the last solve laid out "
		        + std::to_string(blocks.order.order.size()));
	Sweeper(problem, settings, workspace, true).correct(errors, sweeps, result);
}

SolverStatistics solve(Problem& problem, const SolverSettings& settings, Workspace* workspace)
{
	check(settings);
	Workspace own;
	return Sweeper(problem, settings, workspace ? *workspace : own).run();
}

} // namespace nonsmooth::contact
