#include <cmath>
#include <contact/colouring.hpp>
#include <contact/law.hpp>
#include <contact/solver.hpp>
#include <omp.h>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	constexpr std::size_t chunkSize = 256; // contacts that one thread takes at a time; sums are kept a chunk

	/// A contact in sweep order with all that the sweep touches, side by side in memory.
	struct Row {
		Contact contact;
		Impulse inverse;  // 1/W
		Impulse p;        // P_k
		Impulse previous; // P_{k−1}
	};

	struct Chunk {
		std::size_t begin, end;
	};

	/// Rows in colour order, cut into chunks; the same cut for any number of threads.
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
		double sweepChunk(const Chunk& chunk, double beta);
		void measure();
		void finish();
		template <class Visit> void forEachColour(Visit visit);

		Problem&                 problem;
		const SolverSettings&    settings;
		Colouring                colouring;
		std::vector<Row>         rows;
		std::vector<Chunk>       chunks;
		std::vector<std::size_t> firstChunk; // of each colour
		std::vector<Twist>       previousVelocity;
		std::vector<double>      sums, squares, scales, largest; // one a chunk
		Residual                 residual;
		SolverStatistics         statistics;
	};

	Sweeper::Sweeper(Problem& problem_, const SolverSettings& settings_)
	        : problem(problem_)
	        , settings(settings_)
	        , colouring(colour(problem_.contacts, problem_.inverseMass))
	{
		for (std::size_t k = 0; k < colouring.count(); ++k) {
			firstChunk.push_back(chunks.size());
			const std::size_t end = colouring.begin[k + 1], width = colouring.parallel[k] ? chunkSize : end - colouring.begin[k];
			for (std::size_t at = colouring.begin[k]; at < end; at += width)
				chunks.push_back({ at, std::min(at + width, end) });
		}
		firstChunk.push_back(chunks.size());
		for (auto* v : { &sums, &squares, &scales, &largest })
			v->assign(chunks.size(), 0.0);
		rows.resize(problem.contactCount());
		previousVelocity.resize(problem.bodyCount());
		problem.velocities.resize(problem.bodyCount());
		statistics.colours = static_cast<int>(colouring.count());
	}

	/// Calls visit(chunk index) for every chunk, one colour after the other; inside a parallel region.
	template <class Visit> void Sweeper::forEachColour(Visit visit)
	{
		for (std::size_t k = 0; k < colouring.count(); ++k) {
			const long from = static_cast<long>(firstChunk[k]), to = static_cast<long>(firstChunk[k + 1]);
#pragma omp for schedule(static)
			for (long c = from; c < to; ++c)
				visit(static_cast<std::size_t>(c));
		}
	}

	void Sweeper::gather()
	{
		const long count = static_cast<long>(rows.size());
#pragma omp for schedule(static)
		for (long k = 0; k < count; ++k) {
			const Contact& c = problem.contacts[colouring.order[k]];
			const Impulse  p = project(c, problem.impulses[colouring.order[k]]);
			rows[k]          = { c, inverseDelassus(c, problem.inverseMass[c.i], problem.inverseMass[c.j]), p, p };
		}
	}

	/// velocities = freeVelocity + M⁻¹ Hᵀ P from scratch.
	void Sweeper::resetVelocities()
	{
		const long count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < count; ++b)
			problem.velocities[b] = problem.freeVelocity[b];
		forEachColour([this](std::size_t c) {
			for (std::size_t k = chunks[c].begin; k < chunks[c].end; ++k) {
				const Contact& contact = rows[k].contact;
				applyImpulse(
				        contact, rows[k].p, problem.inverseMass[contact.i], problem.inverseMass[contact.j], problem.velocities[contact.i],
				        problem.velocities[contact.j]);
			}
		});
	}

	void Sweeper::extrapolateVelocities(double beta)
	{
		const long count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < count; ++b) {
			Twist &v = problem.velocities[b], &before = previousVelocity[b];
			const Twist now = v;
			v.x += beta * (now.x - before.x);
			v.y += beta * (now.y - before.y);
			v.w += beta * (now.w - before.w);
			before = now;
		}
	}

	/// Returns Σ (y − P_{k+1})·W (P_{k+1} − P_k) over the chunk.
	double Sweeper::sweepChunk(const Chunk& chunk, double beta)
	{
		double turn = 0;
		for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
			Row&               row = rows[k];
			const Contact&     c   = row.contact;
			const InverseMass &mi = problem.inverseMass[c.i], &mj = problem.inverseMass[c.j];
			Twist              vi = problem.velocities[c.i], vj = problem.velocities[c.j];
			const Impulse      before = row.p;
			const Impulse      y { before.n + beta * (before.n - row.previous.n), before.t + beta * (before.t - row.previous.t),
					       before.r + beta * (before.r - row.previous.r) };

			// normal row first, since the other two thresholds depend on it
			const double un = c.nx * (vj.x - vi.x) + c.ny * (vj.y - vi.y) + c.leverNj * vj.w - c.leverNi * vi.w;
			const double n  = projectNormal(y.n - row.inverse.n * (un + c.biasN), c.adhesion);
			applyImpulse(c, { n - y.n, 0, 0 }, mi, mj, vi, vj);
			const double ut = -c.ny * (vj.x - vi.x) + c.nx * (vj.y - vi.y) + c.leverTj * vj.w - c.leverTi * vi.w;
			const double t  = projectThreshold(y.t - row.inverse.t * (ut + c.biasT), slidingThreshold(c, n));
			applyImpulse(c, { 0, t - y.t, 0 }, mi, mj, vi, vj);
			const double r = projectThreshold(y.r - row.inverse.r * (vj.w - vi.w + c.biasR), rollingThreshold(c, n));
			vi.w -= mi.w * (r - y.r);
			vj.w += mj.w * (r - y.r);

			if (!mi.isFixed()) problem.velocities[c.i] = vi;
			if (!mj.isFixed()) problem.velocities[c.j] = vj;
			row.previous = before;
			row.p        = { n, t, r };
			if (row.inverse.n > 0) turn += (y.n - n) * (n - before.n) / row.inverse.n;
			if (row.inverse.t > 0) turn += (y.t - t) * (t - before.t) / row.inverse.t;
			if (row.inverse.r > 0) turn += (y.r - r) * (r - before.r) / row.inverse.r;
		}
		return turn;
	}

	void Sweeper::sweep(double beta)
	{
		forEachColour([this, beta](std::size_t c) { sums[c] = sweepChunk(chunks[c], beta); });
	}

	/// Natural-map residual with the present velocities; same formulas as naturalMapResidual, chunk by chunk.
	void Sweeper::measure()
	{
		const long count = static_cast<long>(chunks.size());
#pragma omp for schedule(static)
		for (long c = 0; c < count; ++c) {
			double square = 0, scale = 0, worst = 0;
			for (std::size_t k = chunks[c].begin; k < chunks[c].end; ++k) {
				const Row&     row = rows[k];
				const Contact& x   = row.contact;
				const Impulse  u   = relativeVelocity(x, problem.velocities[x.i], problem.velocities[x.j]);
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
		const long bodies = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
		for (long b = 0; b < bodies; ++b)
			previousVelocity[b] = problem.velocities[b];
		measure();
		while (residual.relative() > settings.tolerance && iteration < settings.maxIterations) {
			if (accelerated) extrapolateVelocities(beta);
			sweep(beta);
			++iteration;
			if (accelerated) {
				double turn = 0;
				for (const double s : sums)
					turn += s;
				if (turn > 0 || ++sinceRestart >= settings.restartPeriod) {
					restarts += theta > 1;
					theta        = 1;
					beta         = 0;
					sinceRestart = 0;
				} else {
					const double next = 0.5 * (1 + std::sqrt(1 + 4 * theta * theta));
					beta              = (theta - 1) / next;
					theta             = next;
				}
			}
			if (iteration % settings.checkEvery == 0 || iteration == settings.maxIterations) measure();
#pragma omp barrier
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
			problem.impulses[colouring.order[k]] = rows[k].p;
	}

	SolverStatistics Sweeper::run()
	{
		const int threads = rows.size() < 4 * chunkSize ? 1 : std::max(1, settings.threads);
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
		for (const Twist& v : problem.freeVelocity)
			if (!std::isfinite(v.x + v.y + v.w)) throw std::invalid_argument("contact problem: a free velocity is not finite");
		const auto bodies = static_cast<std::int32_t>(problem.bodyCount());
		for (const Contact& c : problem.contacts)
			if (c.i < 0 || c.j < 0 || c.i >= bodies || c.j >= bodies || !std::isfinite(c.nx + c.ny + c.biasN + c.adhesion + c.friction))
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
