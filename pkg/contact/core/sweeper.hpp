// Sweeps over one contact problem that is laid out in blocks, in doubles or in floats: what solving it and correcting
// positions have in common.
//
// Every function but the constructor is run through by all threads of a parallel region, each with its own copies of
// the scalars; those that go by strips are called for the strips of a thread's own stretch (strip_schedule.hpp).
#pragma once

#include <contact/core/active_strips.hpp>
#include <contact/core/settings.hpp>
#include <contact/core/workspace.hpp>
#include <contact/core/strip_schedule.hpp>
#include <omp.h>

namespace nonsmooth::contact {

/// A contact outside the blocks, swept row by row; with its data beside it, so that memory is gone through in the order
/// of the sweep.
template <class Dimension> struct RowIn {
	typename Dimension::Contact
	        contact; // names bodies by their places, and has in its biases what the free velocities make of them
	typename Dimension::InverseMass mi, mj;
	typename Dimension::Impulse     p, before; // P_k, P_{k−1}
	typename Dimension::Inverse     inverse; // 1/W of each row
};

/// What is to be reached, and what that may cost.
struct StoppingCriterion {
	double tolerance;
	int    sweeps;
};

/// Few contacts are not worth waking threads for.
template <class Problem> int threadsFor(const Problem& problem, const SweepSettings& settings)
{
	return problem.contactCount() < 1000 ? 1 : settings.threads;
}

template <class Dimension, class Number> class Sweeper {
public:
	using Problem  = typename Dimension::Problem;
	using Contact  = typename Dimension::Contact;
	using Impulse  = typename Dimension::Impulse;
	using Twist    = typename Dimension::Twist;
	using Settings = typename Dimension::Settings;
	using Block    = typename Dimension::template Block<Number>;
	using Motion   = typename Dimension::template Motion<Number>;
	using Row      = RowIn<Dimension>;

	/// The problem's layout must be in the workspace.
	Sweeper(Problem& problem, const Settings& settings, WorkspaceIn<Dimension>& workspace);

	void plan();
	/// Sweeps until the residual holds.
	void iterate(const StoppingCriterion& until);
	bool solved(double tolerance) const;
	/// The residual from those of the strips.
	void sumUp();
	/// The same of impulses; where they are solved speeds are measured and summed up, too.
	void judge(double tolerance);
	/// Both, solved or not.
	void judgeAll();

	template <class With> void forNew(std::size_t strip, With with) const;
	template <class With> void forFixed(With with);
	template <class Take> void forImpulses(std::size_t strip, Take take) const;
	/// Takes the contacts outside the blocks from the problem.
	void fillRows();
	/// No impulse has changed a body's velocity yet.
	void setOut(std::size_t place, std::int32_t body);
	/// The same for a part's bodies.
	void setOut(std::size_t strip);
	/// Adds M⁻¹ Hᵀ P of the contacts outside the blocks.
	void applyRows(std::size_t strip);
	/// For the first extrapolation, which has nothing to go by.
	void keepBodies(std::size_t strip);
	/// v ← v + β (v − before), before ← v for a part's bodies.
	void extrapolate(std::size_t strip, double beta);
	/// A strip's contacts outside the blocks, one after the other, and each one's three graphs so.
	void sweepRows(std::size_t strip, double beta);
	/// Natural-map residual of a strip with the present velocities, and with `speeds` what it misses of them.
	void measureStrip(std::size_t strip, bool speeds);

	Block*                 blocksOf(std::size_t strip) { return own.blocks.data() + laidOut.blockBegin[strip]; }
	const Numbers<Number>* playsOf(std::size_t strip) const { return own.playsFrom(laidOut.blockBegin[strip]); }
	std::size_t            countOf(std::size_t strip) const
	{
		return laidOut.blockBegin[strip + 1] - laidOut.blockBegin[strip];
	}
	Twist twistAt(std::int32_t place) const { return twistOf(bodies[place]); }
	/// Its velocity; at its place stands what impulses have changed of the free one.
	Twist twist(std::int32_t body) const { return sum(problem.freeVelocity[body], twistAt(laidOut.placeOf[body])); }

	Problem&                            problem;
	const Settings&                     settings;
	const KernelsIn<Dimension, Number>& kernels;
	const int                           threads;
	ContactBlocksIn<Dimension>&         laidOut;
	BlocksIn<Dimension, Number>&        own;
	std::vector<Motion>&                bodies;
	std::vector<Motion>&                bodiesBefore;
	StripSchedule                       schedule;
	std::vector<Row>                    rows;
	std::vector<ResidualSums>           sums; // one a part of the order
	SpeedScale      scale; // of the next look; the mean is that of the last one at which impulses were solved
	Residual        residual;
	VelocityChanges changes;
	int             iterations = 0, restarts = 0; // of iterate()

private:
	/// Places of the bodies that a part of the order is the first to touch in a pass.
	struct Places {
		std::size_t begin, end;
	};
	Places      newIn(std::size_t strip) const;
	void        sweep(const std::vector<double>& betas);
	void        chooseStrips(double tolerance);
	void        wakeStrips();
	void        loseMomentum(std::size_t strip);
	void        measureRows(std::size_t strip, bool speeds, ResidualSums& sums) const;
	void        measureChanges();
	double      meanSquaredChange() const;
	static void setTwists(const Row& row, const Twist& vi, const Twist& vj, std::vector<Motion>& in);
	/// Adds M⁻¹ Hᵀ of an impulse to the velocities of a contact's bodies.
	static void push(const Row& row, const Impulse& impulse, std::vector<Motion>& in);

	bool                    outgrowsCache; // whether blocks have to be fetched from memory in every sweep
	ActiveStrips            strips;
	std::vector<ChangeSums> changeSums; // one a part of the order
};

/// Calls with(place, body) for the bodies that a strip is the first to touch.
template <class Dimension, class Number>
template <class With>
void Sweeper<Dimension, Number>::forNew(std::size_t s, With with) const
{
	const Places places = newIn(s);
	for (std::size_t k = places.begin; k < places.end; ++k)
		with(k, laidOut.order.bodies[k]);
}

/// Calls with(place, body) for the bodies that no strip has, and waits until all is done.
template <class Dimension, class Number> template <class With> void Sweeper<Dimension, Number>::forFixed(With with)
{
	const long first = static_cast<long>(laidOut.order.bodyBegin.back()),
	           count = static_cast<long>(problem.bodyCount());
#pragma omp for schedule(static)
	for (long k = first; k < count; ++k)
		with(k, laidOut.order.bodies[k]);
}

/// Calls take(contact, impulse) for every contact of a part.
template <class Dimension, class Number>
template <class Take>
void Sweeper<Dimension, Number>::forImpulses(std::size_t s, Take take) const
{
	for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b)
		for (std::size_t l = 0; l < lanes; ++l)
			if (const auto index = laidOut.contactOf[b * lanes + l]; index != laidOut.none)
				take(index, impulseOf(own.blocks[b], l));
	for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k)
		take(laidOut.others[k], rows[k].p);
}

} // namespace nonsmooth::contact
