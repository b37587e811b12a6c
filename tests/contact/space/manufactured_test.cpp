// Problems in space with a known solution, through every path of the solver: the residual there is rounding, grows by
// what the definition says when something is moved, and
// sweeps stay there and get there.
#include "manufactured.hpp"
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;
using nonsmooth::contact::Method;
using nonsmooth::contact::Residual;
using nonsmooth::contact::StoppingTest;

namespace {

constexpr double rounding = 1e-13;

std::vector<Recipe> recipes()
{
	std::vector<Recipe> all;
	for (const bool simple : { true, false })
		for (const double loops : { 0.0, 2.0 })
			for (const int bodies : { 12, 60, 1500 })
				for (const bool plays : { false, true })
					all.push_back({ unsigned(all.size() + 1), bodies, loops, simple, plays });
	return all;
}

std::string nameOf(const Recipe& r)
{
	return std::to_string(r.bodies) + " bodies, " + std::to_string(r.loops) + " loops a body, seed "
	        + std::to_string(r.seed) + (r.simple ? ", simple" : "") + (r.plays ? ", plays" : "");
}

TEST(SpaceManufactured, ProblemsAreInAllStates)
{
	int         counts[8] = {};
	std::size_t outside = 0, all = 0;
	for (const Recipe& recipe : recipes()) {
		const Manufactured m = manufactured(recipe);
		for (int k = 0; k < 8; ++k)
			counts[k] += m.counts[k];
		ContactBlocks b;
		nonsmooth::contact::layOut<Space>(m.problem, 1, b);
		EXPECT_EQ(b.others.empty(), recipe.simple) << nameOf(recipe);
		outside += b.others.size();
		all += m.links.size();
	}
	for (const int count : counts) // the rarest is the play
		EXPECT_GT(20 * count, int(all) / 2);
	EXPECT_GT(10 * outside, all);
}

TEST(SpaceManufactured, TheResidualOfTheExactSolutionIsRounding)
{
	for (const Recipe& recipe : recipes()) {
		SCOPED_TRACE(nameOf(recipe));
		const Manufactured m = manufactured(recipe);
		Problem            p = m.problem;
		p.impulses           = m.impulses;
		EXPECT_LE(naturalMapResidual(p).relative(), rounding);
		EXPECT_LE(naturalMapSpeeds(p).largest, 100 * rounding);
		EXPECT_LE(velocityChanges(p).figure(StoppingTest::Maxm), 100 * rounding);
		EXPECT_LE(largestDifference(velocitiesOf(p), m.velocities), 10 * rounding);
		SolverSettings s;
		s.tolerance = rounding;
		forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
			Problem    solved     = p;
			const auto statistics = solve(solved, settings);
			EXPECT_TRUE(statistics.converged) << name;
			EXPECT_EQ(statistics.iterations, 0) << name;
			EXPECT_LE(largestDifference(solved.impulses, m.impulses), rounding) << name;
			EXPECT_LE(largestDifference(solved.velocities, m.velocities), 10 * rounding) << name;
		});
	}
}

/// rms, largest and rms impulse from defects, by the definition.
Residual residualOf(const Problem& p, const std::vector<Impulse>& defects, const std::vector<Impulse>& impulses)
{
	Residual     r;
	const double n = double(defects.size());
	for (std::size_t k = 0; k < defects.size(); ++k) {
		const auto square = [&](const Impulse& x) {
			const double l = p.contacts[k].length;
			return inner(of(x.f), of(x.f)) + inner(of(x.m), of(x.m)) / (l * l);
		};
		r.rms += square(defects[k]) / n;
		r.scale += square(impulses[k]) / n;
		r.largest = std::max(r.largest, square(defects[k]));
	}
	r.rms     = std::sqrt(r.rms);
	r.scale   = std::sqrt(r.scale);
	r.largest = std::sqrt(r.largest);
	return r;
}

void expectMeasured(const Manufactured& m, const std::vector<Impulse>& impulses)
{
	Problem p          = m.problem;
	p.impulses         = impulses;
	const auto defects = m.defects(impulses);
	const auto wanted = residualOf(p, defects, impulses), own = naturalMapResidual(p);
	EXPECT_LE(largestDifference(naturalMapDefects(p), defects), 10 * rounding);
	EXPECT_NEAR(own.rms, wanted.rms, rounding);
	EXPECT_NEAR(own.largest, wanted.largest, 10 * rounding);
	EXPECT_NEAR(own.scale, wanted.scale, rounding);
	SolverSettings s;
	s.maxIterations = 0; // asks for the residual alone, of impulses that are admissible
	forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
		Problem    solved = p;
		const auto found  = solve(solved, settings).residual;
		const auto there  = residualOf(p, m.defects(solved.impulses), solved.impulses);
		EXPECT_NEAR(found.rms, there.rms, rounding) << name;
		EXPECT_NEAR(found.largest, there.largest, 10 * rounding) << name;
		EXPECT_NEAR(found.scale, there.scale, rounding) << name;
	});
}

TEST(SpaceManufactured, WhatIsMovedRaisesTheResidualAsTheDefinitionSays)
{
	for (const Recipe& recipe : { Recipe { 31, 60, 1.0, true }, Recipe { 34, 700, 1.0, true, true } })
		for (const double by : { 1e-3, -0.5 }) {
			SCOPED_TRACE(nameOf(recipe) + ", moved by " + std::to_string(by));
			const Manufactured m     = manufactured(recipe);
			const std::size_t  count = m.impulses.size();
			for (std::size_t k = 3; k < count; k += count / (count > 500 ? 2 : 7)) {
				SCOPED_TRACE("contact " + std::to_string(k));
				for (Vector Impulse::*const half : { &Impulse::f, &Impulse::m })
					for (double Vector::*const row : { &Vector::x, &Vector::y, &Vector::z }) {
						auto moved = m.impulses;
						moved[k].*half.*row += by;
						expectMeasured(m, moved);
					}
			}
			for (const std::size_t body : { std::size_t(5), m.velocities.size() / 2 }) {
				Manufactured moved = m;
				moved.problem.freeVelocity[body].v.z -= by;
				moved.problem.freeVelocity[body].w.x += by;
				expectMeasured(moved, m.impulses);
			}
		}
}

TEST(SpaceManufactured, SweepsStayAtTheExactSolution)
{
	for (const Recipe& recipe : recipes())
		for (const Method method : methods) {
			SCOPED_TRACE(nameOf(recipe));
			const Manufactured m = manufactured(recipe);
			SolverSettings     s;
			s.method        = method;
			s.tolerance     = 1e-300; // never met
			s.maxIterations = 12;
			forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
				Problem p  = m.problem;
				p.impulses = m.impulses;
				solve(p, settings);
				EXPECT_LE(naturalMapResidual(p).relative(), 10 * rounding) << name;
				EXPECT_LE(largestDifference(p.velocities, m.velocities), 1000 * rounding) << name;
				EXPECT_LE(largestDifference(p.impulses, m.impulses), 1000 * rounding) << name;
			});
		}
}

TEST(SpaceManufactured, FromZeroTheSolverGetsThere)
{
	// a tree of balls has one solution
	for (const Recipe& recipe :
	     { Recipe { 65, 300, 0, true }, Recipe { 62, 1200, 0, true }, Recipe { 54, 60, 0, false } }) {
		SCOPED_TRACE(nameOf(recipe));
		const Manufactured m = manufactured(recipe);
		SolverSettings     s;
		s.tolerance     = 1e-10;
		s.maxIterations = 20000;
		forEachPath(m.problem, s, [&](const SolverSettings& settings, const std::string& name) {
			Problem p = m.problem;
			EXPECT_TRUE(solve(p, settings).converged) << name;
			EXPECT_LE(largestDifference(p.velocities, m.velocities), 1e-6) << name;
			EXPECT_LE(largestDifference(p.impulses, m.impulses), 1e-6) << name;
		});
	}
}

} // namespace
