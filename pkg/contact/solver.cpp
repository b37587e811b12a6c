#include <cmath>
#include <contact/law.hpp>
#include <contact/solver.hpp>
#include <contact/sweep_order.hpp>
#include <omp.h>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	/// What a sweep needs of a contact, side by side in memory and in sweep order.
	struct Row {
		std::int32_t i, j;
		double       nx, ny, leverTi, leverTj;
		double       biasN, adhesion, friction, rollingArm;
		Impulse      inverse;  // 1/W_nn, 1/W_tt, 1/W_rr
		double       couplingTR; // W_tr; the other couplings of the rows are zero for a simple contact
		Impulse      p;        // P_k
		Impulse      previous; // P_{k−1}
		std::int32_t simple;   // disks of equal mass in x and y, no other bias: short formulas do
	};

	/// A body as the sweep reads and writes it: one cache line.
	struct alignas(64) Body {
		Twist       v;
		InverseMass inverse;
		bool        moves = false;
	};

	class Sweeper {
	public:
		Sweeper(Problem& problem, const SolverSettings& settings);
		SolverStatistics run();

	private:
		void gather();
		void resetVelocities();
		void iterate();
		void extrapolateVelocities(double beta);
		void sweep(double beta);
		void sweepStrip(std::size_t strip, double beta);
		void sweepGeneral(Row& row, const Impulse& y);
		static void sweepSimple(Row& row, const Impulse& y, Body& a, Body& b);
		void measure();
		void finish();
		template <class Visit> void forEachStrip(Visit visit);

		Problem&                 problem;
		const SolverSettings&    settings;
		SweepOrder               arranged;
		std::vector<Row>         rows;
		std::vector<Twist>       previousVelocity;
		std::vector<Body>        bodies;
		std::vector<double>      squares, scales, largest; // one a strip
		Residual                 residual;
		SolverStatistics         statistics;
	};

	Sweeper::Sweeper(Problem& problem_, const SolverSettings& settings_)
	        : problem(problem_)
	        , settings(settings_)
	        , arranged(arrange(problem_))
	{
		for (auto* v : { &squares, &scales, &largest })
			v->assign(arranged.stripCount(), 0.0);
		rows.resize(problem.contactCount());
		previousVelocity.resize(problem.bodyCount());
		bodies.resize(problem.bodyCount());
		problem.velocities.resize(problem.bodyCount());
		statistics.strips = static_cast<int>(arranged.stripCount());
	}

	/// Calls visit(strip) for all even strips, then for all odd ones; inside a parallel region.
	template <class Visit> void Sweeper::forEachStrip(Visit visit)
	{
		const long half = static_cast<long>(arranged.evenStrips), count = static_cast<long>(arranged.stripCount());
#pragma omp for schedule(dynamic, 1)
		for (long s = 0; s < half; ++s)
			visit(static_cast<std::size_t>(s));
#pragma omp for schedule(dynamic, 1)
		for (long s = half; s < count; ++s)
			visit(static_cast<std::size_t>(s));
	}

	void Sweeper::gather()
	{
		const long bodyCount = static_cast<long>(problem.bodyCount()), count = static_cast<long>(rows.size());
#pragma omp for schedule(static)
		for (long b = 0; b < bodyCount; ++b)
			bodies[b] = { problem.freeVelocity[b], problem.inverseMass[b], !problem.inverseMass[b].isFixed() };
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			const Contact&     c  = problem.contacts[arranged.order[k]];
			const InverseMass &mi = problem.inverseMass[c.i], &mj = problem.inverseMass[c.j];
			const Impulse      p  = project(c, problem.impulses[arranged.order[k]]);
			// a lever along the normal, a different mass in x and y, or a further bias couple more rows
			const bool simple = mi.x == mi.y && mj.x == mj.y && c.biasT == 0 && c.biasR == 0 && (mi.w == 0 || c.leverNi == 0)
			        && (mj.w == 0 || c.leverNj == 0);
			// turning fixed bodies enter the velocities through levers too
			const bool still = (mi.w != 0 || problem.freeVelocity[c.i].w == 0) && (mj.w != 0 || problem.freeVelocity[c.j].w == 0);
			rows[k] = { c.i, c.j, c.nx, c.ny, c.leverTi, c.leverTj, c.biasN, c.adhesion, c.friction, c.rollingArm, inverseDelassus(c, mi, mj),
				    mj.w * c.leverTj + mi.w * c.leverTi, p, p, simple && still };
		}
	}

	/// velocities = freeVelocity + M⁻¹ Hᵀ P from scratch.
	void Sweeper::resetVelocities()
	{
		const long count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < count; ++b)
			bodies[b].v = problem.freeVelocity[b];
		forEachStrip([this](std::size_t s) {
			for (std::size_t k = arranged.stripBegin[s]; k < arranged.stripBegin[s + 1]; ++k) {
				Body &a = bodies[rows[k].i], &b = bodies[rows[k].j];
				Twist va = a.v, vb = b.v;
				applyImpulse(problem.contacts[arranged.order[k]], rows[k].p, a.inverse, b.inverse, va, vb);
				if (a.moves) a.v = va;
				if (b.moves) b.v = vb;
			}
		});
	}

	void Sweeper::extrapolateVelocities(double beta)
	{
		const long count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < count; ++b) {
			Twist &     v = bodies[b].v, &before = previousVelocity[b];
			const Twist now = v;
			v.x += beta * (now.x - before.x);
			v.y += beta * (now.y - before.y);
			v.w += beta * (now.w - before.w);
			before = now;
		}
	}

	/// One contact whose only coupling between rows is W_tr: all three relative velocities are read at once, the velocities written once.
	inline void Sweeper::sweepSimple(Row& row, const Impulse& y, Body& a, Body& b)
	{
		const double dx = b.v.x - a.v.x, dy = b.v.y - a.v.y, w = b.v.w - a.v.w;
		const double un = row.nx * dx + row.ny * dy;
		const double ut = row.nx * dy - row.ny * dx + row.leverTj * b.v.w - row.leverTi * a.v.w;
		const double n  = projectNormal(y.n - row.inverse.n * (un + row.biasN), row.adhesion);
		const double load = row.adhesion + n; // never negative
		const double t    = projectThreshold(y.t - row.inverse.t * ut, row.friction * load);
		const double dn = n - y.n, dt = t - y.t;
		const double r  = projectThreshold(y.r - row.inverse.r * (w + row.couplingTR * dt), row.rollingArm * load);
		const double dr = r - y.r;
		const double fx = row.nx * dn - row.ny * dt, fy = row.ny * dn + row.nx * dt;
		if (a.moves) {
			a.v.x -= a.inverse.x * fx;
			a.v.y -= a.inverse.y * fy;
			a.v.w -= a.inverse.w * (row.leverTi * dt + dr);
		}
		if (b.moves) {
			b.v.x += b.inverse.x * fx;
			b.v.y += b.inverse.y * fy;
			b.v.w += b.inverse.w * (row.leverTj * dt + dr);
		}
		row.p = { n, t, r };
	}

	/// Any contact, row by row.
	void Sweeper::sweepGeneral(Row& row, const Impulse& y)
	{
		const Contact& c = problem.contacts[arranged.order[&row - rows.data()]];
		Body &         a = bodies[row.i], &b = bodies[row.j];
		Twist          va = a.v, vb = b.v;
		const double   n = projectNormal(y.n - row.inverse.n * (relativeVelocity(c, va, vb).n + c.biasN), c.adhesion);
		applyImpulse(c, { n - y.n, 0, 0 }, a.inverse, b.inverse, va, vb);
		const double t = projectThreshold(y.t - row.inverse.t * (relativeVelocity(c, va, vb).t + c.biasT), slidingThreshold(c, n));
		applyImpulse(c, { 0, t - y.t, 0 }, a.inverse, b.inverse, va, vb);
		const double r = projectThreshold(y.r - row.inverse.r * (relativeVelocity(c, va, vb).r + c.biasR), rollingThreshold(c, n));
		applyImpulse(c, { 0, 0, r - y.r }, a.inverse, b.inverse, va, vb);
		if (a.moves) a.v = va;
		if (b.moves) b.v = vb;
		row.p = { n, t, r };
	}

	void Sweeper::sweepStrip(std::size_t strip, double beta)
	{
		for (std::size_t k = arranged.stripBegin[strip]; k < arranged.stripBegin[strip + 1]; ++k) {
			Row&          row    = rows[k];
			const Impulse before = row.p;
			const Impulse y { before.n + beta * (before.n - row.previous.n), before.t + beta * (before.t - row.previous.t),
					  before.r + beta * (before.r - row.previous.r) };
			row.previous = before;
			if (row.simple) sweepSimple(row, y, bodies[row.i], bodies[row.j]);
			else
				sweepGeneral(row, y);
		}
	}

	void Sweeper::sweep(double beta)
	{
		forEachStrip([this, beta](std::size_t s) { sweepStrip(s, beta); });
	}

	/// Natural-map residual with the present velocities; same formulas as naturalMapResidual, strip by strip.
	void Sweeper::measure()
	{
		const long count = static_cast<long>(arranged.stripCount());
#pragma omp for schedule(static)
		for (long c = 0; c < count; ++c) {
			double square = 0, scale = 0, worst = 0;
			for (std::size_t k = arranged.stripBegin[c]; k < arranged.stripBegin[c + 1]; ++k) {
				const Row&     row = rows[k];
				const Contact& x   = problem.contacts[arranged.order[k]];
				const Impulse  u   = relativeVelocity(x, bodies[x.i].v, bodies[x.j].v);
				const double   n   = row.p.n - projectNormal(row.p.n - row.inverse.n * (u.n + x.biasN), x.adhesion);
				const double   t   = row.p.t - projectThreshold(row.p.t - row.inverse.t * (u.t + x.biasT), slidingThreshold(x, row.p.n));
				const double   r
				        = (row.p.r - projectThreshold(row.p.r - row.inverse.r * (u.r + x.biasR), rollingThreshold(x, row.p.n))) / x.length;
				const double one = n * n + t * t + r * r;
				square += one;
				worst = std::max(worst, one);
				scale += row.p.n * row.p.n + row.p.t * row.p.t + row.p.r * row.p.r / (x.length * x.length);
			}
			squares[c] = square;
			scales[c]  = scale;
			largest[c] = worst;
		}
#pragma omp single
		{
			double square = 0, scale = 0, worst = 0;
			for (long c = 0; c < count; ++c) {
				square += squares[c];
				scale += scales[c];
				worst = std::max(worst, largest[c]);
			}
			const double n = std::max<std::size_t>(rows.size(), 1);
			residual       = { std::sqrt(square / n), std::sqrt(worst), std::sqrt(scale / n) };
		}
	}

	/// Sweeps until the residual holds; every thread runs through it with its own copies of the scalars.
	void Sweeper::iterate()
	{
		const bool accelerated = settings.method == Method::Accelerated;
		double     theta = 1, beta = 0;
		int        restarts = 0, iteration = 0, sinceRestart = 0;
		const long count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < count; ++b)
			previousVelocity[b] = bodies[b].v;
		measure();
		double last = residual.rms;
		while (residual.relative() > settings.tolerance && iteration < settings.maxIterations) {
			if (accelerated) extrapolateVelocities(beta);
			sweep(beta);
			++iteration;
			++sinceRestart;
			bool restart = sinceRestart >= settings.restartPeriod;
			if (iteration % settings.checkEvery == 0 || iteration == settings.maxIterations) {
				measure();
				restart = restart || residual.rms > last;
				last    = residual.rms;
			}
			if (!accelerated) continue;
			if (restart) {
				restarts += sinceRestart > 1;
				theta        = 1;
				beta         = 0;
				sinceRestart = 0;
			} else {
				const double next = 0.5 * (1 + std::sqrt(1 + 4 * theta * theta));
				beta              = (theta - 1) / next;
				theta             = next;
			}
		}
#pragma omp single
		{
			statistics.iterations = iteration;
			statistics.restarts   = restarts;
		}
	}

	void Sweeper::finish()
	{
		// velocities anew, so that the residual reported owes nothing to rounding gathered over the sweeps
		resetVelocities();
		measure();
		const long count = static_cast<long>(rows.size());
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k)
			problem.impulses[arranged.order[k]] = rows[k].p;
		const long bodyCount = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < bodyCount; ++b)
			problem.velocities[b] = bodies[b].v;
	}

	SolverStatistics Sweeper::run()
	{
		const int threads = arranged.stripCount() < 4 ? 1 : std::max(1, settings.threads);
#pragma omp parallel num_threads(threads)
		{
			gather();
			resetVelocities();
			iterate();
			finish();
		}
		statistics.residual  = residual;
		statistics.converged = residual.relative() <= settings.tolerance * (1 + 1e-6);
		return statistics;
	}

	void check(const Problem& problem)
	{
		if (problem.freeVelocity.size() != problem.bodyCount())
			throw std::invalid_argument("contact problem: freeVelocity has " + std::to_string(problem.freeVelocity.size()) + " entries for "
			                            + std::to_string(problem.bodyCount()) + " bodies");
		if (problem.impulses.size() != problem.contactCount())
			throw std::invalid_argument("contact problem: impulses has " + std::to_string(problem.impulses.size()) + " entries for "
			                            + std::to_string(problem.contactCount()) + " contacts");
		for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
			const Twist&       v = problem.freeVelocity[b];
			const InverseMass& m = problem.inverseMass[b];
			if (!std::isfinite(v.x + v.y + v.w + m.x + m.y + m.w))
				throw std::invalid_argument("contact problem: body " + std::to_string(b) + " has a velocity or mass that is not finite");
		}
		const auto bodies = static_cast<std::int32_t>(problem.bodyCount());
		for (const Contact& c : problem.contacts)
			if (const Impulse& p = problem.impulses[&c - problem.contacts.data()];
			    c.i < 0 || c.j < 0 || c.i >= bodies || c.j >= bodies
			    || !std::isfinite(
			            c.nx + c.ny + c.leverNi + c.leverTi + c.leverNj + c.leverTj + c.biasN + c.biasT + c.biasR + c.adhesion + c.friction
			            + c.rollingArm + c.length + p.n + p.t + p.r))
				throw std::invalid_argument(
				        "contact problem: contact " + std::to_string(&c - problem.contacts.data()) + " between bodies " + std::to_string(c.i)
				        + " and " + std::to_string(c.j) + " has an index out of range or a number that is not finite");
	}

} // namespace

SolverStatistics solve(Problem& problem, const SolverSettings& settings)
{
	check(problem);
	return Sweeper(problem, settings).run();
}

} // namespace nonsmooth::contact
