// Colours let threads share a sweep without changing a bit.
#include "problems.hpp"
#include <algorithm>
#include <contact/colouring.hpp>
#include <cstring>
#include <gtest/gtest.h>
#include <set>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Each contact once, and no movable body twice within a parallel colour.
void expectSound(const Colouring& colours, const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverse)
{
	ASSERT_EQ(colours.order.size(), contacts.size());
	ASSERT_EQ(colours.begin.size(), colours.count() + 1);
	ASSERT_EQ(colours.begin.back(), contacts.size());
	auto order = colours.order;
	std::sort(order.begin(), order.end());
	for (std::size_t k = 0; k < order.size(); ++k)
		ASSERT_EQ(order[k], static_cast<std::int32_t>(k));
	for (std::size_t k = 0; k < colours.count(); ++k) {
		if (!colours.parallel[k]) continue;
		std::set<int> seen;
		for (std::size_t at = colours.begin[k]; at < colours.begin[k + 1]; ++at) {
			const Contact& c = contacts[colours.order[at]];
			for (const int body : { c.i, c.j }) {
				if (inverse[body].isFixed()) continue;
				ASSERT_TRUE(seen.insert(body).second) << "body " << body << " twice in colour " << k;
			}
		}
	}
}

Contact between(int i, int j)
{
	Contact c;
	c.i = i;
	c.j = j;
	return c;
}

TEST(Colouring, PackingNeedsFewColours)
{
	const Scene     scene   = lattice(30, 20);
	const Colouring colours = colour(scene.problem.contacts, scene.problem.inverseMass);
	expectSound(colours, scene.problem.contacts, scene.problem.inverseMass);
	EXPECT_GE(colours.count(), 6u); // six neighbours on the lattice
	EXPECT_LE(colours.count(), 11u); // greedy: at most 2·6 − 1
}

TEST(Colouring, FixedBodiesAreFree)
{
	std::vector<InverseMass> inverse(201, { 1, 1, 1 });
	inverse[0] = {};
	std::vector<Contact> contacts;
	for (int k = 1; k <= 200; ++k)
		contacts.push_back(between(0, k));
	const Colouring colours = colour(contacts, inverse);
	expectSound(colours, contacts, inverse);
	EXPECT_EQ(colours.count(), 1u);
	EXPECT_TRUE(colours.parallel[0]);
}

TEST(Colouring, MoreThan64NeighboursLeaveASerialRest)
{
	std::vector<InverseMass> inverse(101, { 1, 1, 1 });
	std::vector<Contact>     contacts;
	for (int k = 1; k <= 100; ++k)
		contacts.push_back(between(0, k));
	const Colouring colours = colour(contacts, inverse);
	expectSound(colours, contacts, inverse);
	ASSERT_EQ(colours.count(), 65u);
	EXPECT_FALSE(colours.parallel[64]);
	EXPECT_EQ(colours.begin[65] - colours.begin[64], 36u);
	EXPECT_EQ(std::count(colours.parallel.begin(), colours.parallel.end(), false), 1);
}

TEST(Colouring, SameInputSameOrder)
{
	const Scene a = lattice(10, 10), b = lattice(10, 10);
	EXPECT_EQ(colour(a.problem.contacts, a.problem.inverseMass).order, colour(b.problem.contacts, b.problem.inverseMass).order);
	EXPECT_EQ(colour({}, {}).count(), 0u);
}

/// A big disk with more than 64 neighbours, to bring in the serial rest, within a lattice.
Problem crowded()
{
	Scene scene = lattice(30, 20);
	Problem& p  = scene.problem;
	const int big = static_cast<int>(p.inverseMass.size());
	p.inverseMass.push_back({ 1e-6, 1e-6, 1e-6 });
	p.freeVelocity.push_back({ 0.01, -0.05, 0.1 });
	for (int k = 0; k < 80; ++k) {
		Contact c    = between(7 * k, big);
		c.nx         = std::cos(k);
		c.ny         = std::sin(k);
		c.leverTi    = 0.5;
		c.leverTj    = -5;
		c.friction   = 0.3;
		c.rollingArm = 0.1;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	}
	return p;
}

TEST(Threads, SameBitsForOneAndMore)
{
	for (const Method method : { Method::GaussSeidel, Method::Accelerated }) {
		for (const bool crowd : { false, true }) {
			SolverSettings s;
			s.method        = method;
			s.tolerance     = 1e-9;
			s.maxIterations = 60;
			std::vector<Problem> solved;
			std::vector<int>     iterations;
			std::vector<double>  residuals;
			for (const int threads : { 1, 2 }) {
				s.threads = threads;
				solved.push_back(crowd ? crowded() : lattice(30, 20).problem);
				const auto statistics = solve(solved.back(), s);
				iterations.push_back(statistics.iterations);
				residuals.push_back(statistics.residual.rms);
			}
			for (std::size_t k = 1; k < solved.size(); ++k) {
				EXPECT_EQ(iterations[k], iterations[0]);
				EXPECT_EQ(residuals[k], residuals[0]);
				EXPECT_EQ(std::memcmp(solved[k].impulses.data(), solved[0].impulses.data(), solved[0].contactCount() * sizeof(Impulse)), 0);
				EXPECT_EQ(std::memcmp(solved[k].velocities.data(), solved[0].velocities.data(), solved[0].bodyCount() * sizeof(Twist)), 0);
			}
		}
	}
}

} // namespace
