// Problems with a known solution, through every path of the solver: the residual there is rounding, grows by what the definition says when something is
// moved, and sweeps stay there and get there.
#include "every_path.hpp"
#include "manufactured.hpp"
#include <contact/plane/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Trees and networks; all contacts in blocks or half of them outside; a few dozen contacts and enough for several strips and two threads.
std::vector<Recipe> recipes()
{
	std::vector<Recipe> all;
	for (const bool simple : { true, false })
		for (const double loops : { 0.0, 1.0 })
			for (const int bodies : { 12, 60, 1500 })
				all.push_back({ unsigned(all.size() + 1), bodies, loops, simple });
	all.push_back({ 21, 400, 1.0, true, false, true });
	all.push_back({ 22, 1500, 1.0, false, true });
	for (const bool simple : { true, false })
		for (const double loops : { 0.0, 1.0 })
			for (const int bodies : { 60, 1500 })
				all.push_back({ unsigned(all.size() + 31), bodies, loops, simple, false, false, true });
	return all;
}

std::string nameOf(const Recipe& r)
{
	return std::to_string(r.bodies) + " bodies, " + std::to_string(r.loops) + " loops a body, seed "
	        + std::to_string(r.seed) + (r.simple ? ", simple" : "");
}

/// rms, largest and rms impulse from defects, by the definition in residual.hpp.
Residual residualOf(const Problem& p, const std::vector<Impulse>& defects, const std::vector<Impulse>& impulses)
{
	Residual r;
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const auto square = [&](const Impulse& x) {
			return x.n * x.n + x.t * x.t + x.r * x.r / (p.contacts[k].length * p.contacts[k].length);
		};
		r.rms += square(defects[k]);
		r.scale += square(impulses[k]);
		r.largest = std::max(r.largest, std::sqrt(square(defects[k])));
	}
	const double n = double(defects.size());
	return { std::sqrt(r.rms / n), r.largest, std::sqrt(r.scale / n) };
}

// velocities up to 30 m/s (a tree's chain of turning bodies), masses and impulses near one, some ten contacts a body: 1e-16 times a few hundred
constexpr double rounding = 1e-13;

TEST(Manufactured, EveryStateIsAmongThem)
{
	int counts[5] = {}, outside = 0, turning = 0;
	for (const Recipe& recipe : recipes()) {
		const Manufactured m = manufactured(recipe);
		for (int k = 0; k < 5; ++k)
			counts[k] += m.counts[k];
		ContactBlocks b;
		layOut(m.problem, 1, b);
		EXPECT_EQ(b.others.empty(), recipe.simple) << nameOf(recipe);
		outside += int(b.others.size());
		for (const InverseMass& w : m.problem.inverseMass)
			turning += w.w > 0;
	}
	for (const int count :
	     counts) // pressed, pulled, at the limit, open, in their play; the smallest drawing of 4,000 has 7 %
		EXPECT_GT(count, 500);
	EXPECT_GT(outside, 1000);
	EXPECT_GT(turning, 1000);
}

TEST(Manufactured, TheResidualOfTheExactSolutionIsRounding)
{
	for (const Recipe& recipe : recipes()) {
		SCOPED_TRACE(nameOf(recipe));
		const Manufactured m = manufactured(recipe);
		Problem            p = m.problem;
		p.impulses           = m.impulses;
		EXPECT_LE(naturalMapResidual(p).relative(), rounding);
		EXPECT_LE(naturalMapSpeeds(p).largest, 100 * rounding); // the largest of them, not the mean
		EXPECT_LE(velocityChanges(p).figure(StoppingTest::Maxm), 100 * rounding);
		EXPECT_LE(largestDifference(velocitiesOf(p), m.velocities), 10 * rounding);
		SolverSettings s;
		s.tolerance = rounding;
		forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
			Problem    solved     = p;
			const auto statistics = solve(solved, settings);
			EXPECT_TRUE(statistics.converged) << name;
			EXPECT_EQ(statistics.iterations, 0) << name;
			EXPECT_LE(largestDifference(solved.impulses, m.impulses), rounding)
			        << name; // projected on thresholds that they lie on
			EXPECT_LE(largestDifference(solved.velocities, m.velocities), 10 * rounding) << name;
		});
	}
}

/// What a solver does with impulses before it starts: onto the graphs' thresholds, normal first.
std::vector<Impulse> admissible(const Problem& p, std::vector<Impulse> impulses)
{
	for (std::size_t k = 0; k < impulses.size(); ++k) {
		const Contact& c = p.contacts[k];
		Impulse&       x = impulses[k];
		x.n              = std::max(x.n, -c.adhesion);
		const double t = c.friction * (x.n + c.adhesion), r = c.rollingArm * (x.n + c.adhesion);
		x.t = std::clamp(x.t, -t, t);
		x.r = std::clamp(x.r, -r, r);
	}
	return impulses;
}

void expectSame(const Residual& found, const Residual& wanted, const std::string& name)
{
	EXPECT_NEAR(found.rms, wanted.rms, rounding) << name;
	EXPECT_NEAR(found.largest, wanted.largest, 10 * rounding) << name; // one contact's, not the mean
	EXPECT_NEAR(found.scale, wanted.scale, rounding) << name;
}

/// Expects that every measure of the residual is that of the definition.
void expectMeasured(const Manufactured& m, const std::vector<Impulse>& impulses)
{
	Problem p          = m.problem;
	p.impulses         = impulses;
	const auto defects = m.defects(impulses);
	EXPECT_LE(largestDifference(naturalMapDefects(p), defects), 10 * rounding);
	expectSame(naturalMapResidual(p), residualOf(p, defects, impulses), "independent of a solver");
	const auto     start = admissible(p, impulses);
	const auto     own   = residualOf(p, m.defects(start), start);
	SolverSettings s;
	s.maxIterations = 0; // asks for the residual alone
	forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem    solved     = p;
		const auto statistics = solve(solved, settings);
		EXPECT_LE(largestDifference(solved.impulses, start), 0) << name;
		expectSame(statistics.residual, own, name);
	});
}

TEST(Manufactured, WhatIsMovedRaisesTheResidualAsTheDefinitionSays)
{
	for (const Recipe& recipe :
	     { Recipe { 31, 60, 1.0, true }, Recipe { 32, 60, 1.0, false }, Recipe { 33, 700, 1.0, false },
	       Recipe { 34, 700, 1.0, true, false, false, true }, Recipe { 35, 60, 1.0, false, false, false, true } })
		for (const double by : { 1e-3, -1e-3, 0.5, -0.5 }) {
			SCOPED_TRACE(nameOf(recipe) + ", moved by " + std::to_string(by));
			const Manufactured m     = manufactured(recipe);
			const std::size_t  count = m.impulses.size();
			for (std::size_t k = 3; k < count;
			     k += count / (count > 500 ? 2 : 7)) { // any contact will do: some of all states
				SCOPED_TRACE("contact " + std::to_string(k));
				for (double Impulse::*const row : { &Impulse::n, &Impulse::t, &Impulse::r }) {
					auto moved = m.impulses;
					moved[k].*row += by;
					expectMeasured(m, moved);
				}
			}
			for (const std::size_t body : { std::size_t(5), m.velocities.size() / 2 }) {
				SCOPED_TRACE("body " + std::to_string(body));
				Manufactured moved = m;
				moved.problem.freeVelocity[body].x += by;
				moved.problem.freeVelocity[body].y -= by;
				expectMeasured(moved, m.impulses);
			}
		}
}

// all rows hold, so proj changes nothing near the solution and what is missed is linear: δ in its own row, W_lk δ/W_ll in the others
TEST(Manufactured, OneImpulseTooMuchIsMissedBySoMuchWhereAllHolds)
{
	const Manufactured m     = manufactured({ 41, 200, 1.0, true, false, true });
	const double       delta = 1e-3; // thresholds are 1e-2 or more away
	for (const std::size_t k : { 7, 100, 250 })
		for (double Impulse::*const row : { &Impulse::n, &Impulse::t, &Impulse::r }) {
			Problem p  = m.problem;
			p.impulses = m.impulses;
			p.impulses[k].*row += delta;
			std::vector<Twist> v(p.bodyCount());
			Impulse            push1;
			push1.*row = delta;
			push(m.links[k], push1, p.inverseMass, 1, v);
			double square = 0;
			for (std::size_t l = 0; l < m.links.size(); ++l) {
				const RelativeVelocity u = seen(m.links[l], v);
				const Diagonal         w = m.diagonal(l);
				const double           r = u.r / w.r / p.contacts[l].length;
				square += u.n * u.n / (w.n * w.n) + u.t * u.t / (w.t * w.t) + r * r;
			}
			EXPECT_NEAR(naturalMapDefects(p)[k].*row, delta, rounding);
			EXPECT_NEAR(naturalMapResidual(p).rms, std::sqrt(square / double(m.links.size())), rounding);
			EXPECT_GT(std::sqrt(square), 0.99 * delta / 2); // rolling over ℓ of at most 2
		}
}

TEST(Manufactured, SweepsStayAtTheExactSolution)
{
	for (const Recipe& recipe : recipes())
		for (const Method method : methods) {
			SCOPED_TRACE(nameOf(recipe));
			const Manufactured m = manufactured(recipe);
			SolverSettings     s;
			s.method    = method;
			s.tolerance = 1e-300; // never met
			s.maxIterations
			        = 12; // over a look at the residual; more would let wedged networks magnify rounding
			forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
				Problem p  = m.problem;
				p.impulses = m.impulses;
				solve(p, settings);
				// 12 sweeps, each of which rounds; impulses wander along what masses leave soft
				EXPECT_LE(naturalMapResidual(p).relative(), 10 * rounding) << name;
				EXPECT_LE(largestDifference(p.velocities, m.velocities), 1000 * rounding)
				        << name; // 30 sweeps made 6e-11 of up to 60 m/s
				EXPECT_LE(largestDifference(p.impulses, m.impulses), 1000 * rounding) << name;
			});
		}
}

struct FromZero {
	Recipe recipe;
	int    sweeps[2][2]; // plain and accelerated, each in blocks and by the reference
	bool   oneMotion; // what is found moves as what was drawn
	bool   oneSolution; // and has its impulses: a tree has no loop that they could run around
};

TEST(Manufactured, FromZeroTheSolverGetsThere)
{
	const FromZero cases[] = {
		{ { 54, 60, 0, false }, { { 104, 104 }, { 91, 91 } }, true, true },
		{ { 65, 300, 0, true }, { { 112, 112 }, { 79, 79 } }, true, true },
		{ { 62, 1200, 0, true }, { { 251, 251 }, { 153, 153 } }, true, true },
		{ { 69, 1200, 0, false }, { { 273, 262 }, { 144, 147 } }, true, true },
		{ { 70, 700, 0, true, true }, { { 127, 127 }, { 71, 71 } }, true, true },
		{ { 71, 25, 1.0, true }, { { 617, 617 }, { 164, 164 } }, true, false },
		{ { 72, 25, 1.0, false }, { { 1046, 835 }, { 150, 154 } }, true, false },
		{ { 60, 25, 1.0, false },
		  { { 214, 175 }, { 99, 88 } },
		  false,
		  false }, // friction allows another solution, and that is the nearer one
	};
	const double tolerance = 1e-10;
	for (const FromZero& one : cases)
		for (const Method method : methods) {
			SCOPED_TRACE(
			        nameOf(one.recipe) + (method == Method::Accelerated ? ", accelerated" : ", plain"));
			const Manufactured m = manufactured(one.recipe);
			SolverSettings     s;
			s.method        = method;
			s.tolerance     = tolerance;
			s.maxIterations = 20000;
			s.checkEvery    = 1;
			forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
				Problem    p          = m.problem;
				const auto statistics = solve(p, settings);
				EXPECT_TRUE(statistics.converged) << name;
				EXPECT_EQ(
				        statistics.iterations,
				        one.sweeps[method == Method::Accelerated][settings.reference])
				        << name;
				EXPECT_LE(
				        residualOf(p, m.defects(p.impulses), p.impulses).relative(),
				        tolerance * (1 + 1e-6))
				        << name;
				EXPECT_LE(
				        one.oneMotion ? largestDifference(p.velocities, m.velocities) : 0,
				        1e4 * tolerance)
				        << name; // W's condition of a thousand, and some
				EXPECT_LE(
				        one.oneSolution ? largestDifference(p.impulses, m.impulses) : 0,
				        1e4 * tolerance)
				        << name;
			});
		}
}

/// Looks at the residual every so many sweeps, and what it takes then.
struct Course {
	int checkEvery, sweeps, restarts;
};

TEST(Manufactured, SweepsAndRestartsAreAsManyAsTheRuleMakes)
{
	const std::pair<Recipe, std::vector<Course>> cases[] = {
		{ { 71, 25, 1.0, true },
		  { { 1, 164, 7 }, { 3, 171, 4 }, { 10, 230, 3 }, { 30, 570, 1 }, { 50, 750, 0 } } },
		{ { 54, 60, 0, false },
		  { { 1, 91, 3 }, { 3, 114, 2 }, { 10, 180, 0 }, { 30, 180, 0 }, { 50, 200, 0 } } },
		{ { 53, 60, 0, true },
		  { { 1, 202, 6 }, { 3, 225, 5 }, { 10, 340, 4 }, { 30, 510, 3 }, { 50, 850, 2 } } },
	};
	for (const auto& [recipe, courses] : cases)
		for (const Course& course : courses) {
			SCOPED_TRACE(nameOf(recipe) + ", a look every " + std::to_string(course.checkEvery));
			Problem        p = manufactured(recipe).problem;
			SolverSettings s;
			s.tolerance           = 1e-10;
			s.maxIterations       = 2000;
			s.checkEvery          = course.checkEvery;
			const auto statistics = solve(p, s);
			EXPECT_TRUE(statistics.converged);
			EXPECT_EQ(statistics.iterations, course.sweeps);
			EXPECT_EQ(statistics.restarts, course.restarts);
		}
}

} // namespace
