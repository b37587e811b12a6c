// The same problem said in another way must have the same solution: other frames, other names, other units, other company.
//
// Where the other way changes nothing but signs, powers of two or the order of two terms of a sum, results are the same to the last bit. Else they are
// the same to rounding after a fixed number of sweeps, or where the order of the sweep changes, to the tolerance of the solver.
#include "every_path.hpp"
#include "manufactured.hpp"
#include "problems.hpp"
#include <gtest/gtest.h>
#include <numeric>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// Contacts in all states, in several strips; outside blocks too unless `simple`. Impulses to start with are half of the solution's.
Problem network(bool simple, int bodies = 900, unsigned seed = 71)
{
	const Manufactured m = manufactured({ seed, bodies, 1.0, simple, false, false, true });
	Problem            p = m.problem;
	for (std::size_t k = 0; k < p.contactCount(); ++k)
		p.impulses[k] = { 0.5 * m.impulses[k].n, 0.5 * m.impulses[k].t, 0.5 * m.impulses[k].r };
	return p;
}

struct Solved {
	Problem          problem;
	SolverStatistics statistics;
};

Solved solved(Problem p, const SolverSettings& s)
{
	const auto statistics = solve(p, s);
	return { std::move(p), statistics };
}

/// Sweeps of which none is saved, over two looks at the residual.
SolverSettings sweeps(Method method, int count = 25)
{
	SolverSettings s;
	s.method        = method;
	s.maxIterations = count;
	s.tolerance     = 1e-300;
	return s;
}

// of numbers near one, after 25 sweeps over some ten contacts a body, that amplify none
constexpr double rounding = 1e-11;

/// Turned about the origin by the angle of that cosine and sine. Masses must be alike in x and y, or the turn a quarter.
Problem turned(Problem p, double c, double s)
{
	const auto turn = [c, s](auto& v) {
		const double x = c * v.x - s * v.y, y = s * v.x + c * v.y;
		v.x = x, v.y = y;
	};
	for (Twist& v : p.freeVelocity)
		turn(v);
	for (Twist& v : p.velocities)
		turn(v);
	for (Point& x : p.positions)
		turn(x);
	for (Contact& k : p.contacts) {
		Point n { k.nx, k.ny };
		turn(n);
		k.nx = n.x, k.ny = n.y;
	}
	if (c == 0)
		for (InverseMass& m : p.inverseMass)
			std::swap(m.x, m.y);
	return p;
}

/// Mirrored about the x axis: what turns, turns the other way.
Problem mirrored(Problem p)
{
	const auto flip = [](auto&... x) { ((x = -x), ...); };
	for (Twist& v : p.freeVelocity)
		flip(v.y, v.w);
	for (Twist& v : p.velocities)
		flip(v.y, v.w);
	for (Point& x : p.positions)
		flip(x.y);
	for (Contact& c : p.contacts)
		flip(c.ny, c.leverNi, c.leverNj, c.biasT, c.biasR);
	for (Impulse& x : p.impulses)
		flip(x.t, x.r);
	return p;
}

TEST(Symmetry, AMirroredProblemHasTheMirroredBits)
{
	for (const bool simple : { true, false })
		for (const Method method : methods) {
			const Problem p = network(simple);
			forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
				const Solved  one = solved(p, s), other = solved(mirrored(p), s);
				const Problem back = mirrored(other.problem);
				EXPECT_EQ(largestDifference(back.impulses, one.problem.impulses), 0)
				        << name; // signs alone
				EXPECT_EQ(largestDifference(back.velocities, one.problem.velocities), 0) << name;
				EXPECT_EQ(other.statistics.residual.rms, one.statistics.residual.rms) << name;
				EXPECT_GT(one.statistics.strips, 1);
			});
		}
}

TEST(Symmetry, AQuarterTurnKeepsTheBits)
{
	for (const bool simple : { true, false })
		for (const Method method : methods) {
			const Problem p = network(simple);
			forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
				const Solved one   = solved(p, s),
				             other = solved(turned(p, 0, 1), s); // strips lie across y now
				EXPECT_EQ(largestDifference(other.problem.impulses, one.problem.impulses), 0)
				        << name; // signs, and two terms of a sum changed about
				EXPECT_EQ(
				        largestDifference(
				                turned(other.problem, 0, -1).velocities, one.problem.velocities),
				        0)
				        << name;
				EXPECT_EQ(other.statistics.residual.rms, one.statistics.residual.rms) << name;
			});
		}
}

TEST(Symmetry, AnyTurnIsRounding)
{
	Problem p = network(true);
	p.positions.clear(); // strips would lie otherwise
	for (const double angle : { 0.7, 2.5, -1.1 })
		for (const Method method : methods)
			forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
				const Solved one   = solved(p, s),
				             other = solved(turned(p, std::cos(angle), std::sin(angle)), s);
				EXPECT_LE(largestDifference(other.problem.impulses, one.problem.impulses), rounding)
				        << name << ", " << angle;
				EXPECT_LE(
				        largestDifference(
				                turned(other.problem, std::cos(angle), -std::sin(angle)).velocities,
				                one.problem.velocities),
				        rounding)
				        << name;
				EXPECT_NEAR(other.statistics.residual.rms, one.statistics.residual.rms, rounding)
				        << name;
			});
}

TEST(Symmetry, AMovingFrameIsRounding)
{
	const Problem p    = network(false);
	Problem       fast = p;
	for (Twist& v : fast.freeVelocity)
		v.x += 3, v.y -= 2;
	for (const Method method : methods)
		forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
			const Solved one = solved(p, s), other = solved(fast, s);
			EXPECT_LE(largestDifference(other.problem.impulses, one.problem.impulses), rounding) << name;
			Problem back = other.problem;
			for (Twist& v : back.velocities)
				v.x -= 3, v.y += 2;
			EXPECT_LE(largestDifference(back.velocities, one.problem.velocities), rounding) << name;
		});
}

/// Each `stride`-th contact seen from its other body.
Problem exchanged(Problem p, std::size_t stride)
{
	for (std::size_t k = 0; k < p.contactCount(); k += stride) {
		Contact& c = p.contacts[k];
		std::swap(c.i, c.j);
		std::swap(c.leverNi, c.leverNj);
		std::swap(c.leverTi, c.leverTj);
		for (double* x :
		     { &c.nx, &c.ny, &c.leverNi, &c.leverNj, &c.leverTi, &c.leverTj, &c.biasR, &p.impulses[k].r })
			*x = -*x; // n and t turn round, and so U_n and U_t stay; the turning does not
	}
	return p;
}

TEST(Symmetry, WhichBodyIsTheFirstIsRounding)
{
	for (const bool simple : { true, false })
		for (const Method method : methods)
			for (const std::size_t stride : { 1, 2, 3 }) {
				const Problem p = network(simple);
				forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
					const Solved one = solved(p, s), other = solved(exchanged(p, stride), s);
					EXPECT_LE(
					        largestDifference(
					                exchanged(other.problem, stride).impulses,
					                one.problem.impulses),
					        rounding)
					        << name;
					EXPECT_LE(
					        largestDifference(other.problem.velocities, one.problem.velocities),
					        rounding)
					        << name;
				});
			}
}

std::vector<int> shuffled(std::size_t count, unsigned seed)
{
	std::vector<int> order(count);
	std::iota(order.begin(), order.end(), 0);
	std::mt19937 dice(seed);
	for (std::size_t k = count; k > 1; --k)
		std::swap(order[k - 1], order[dice() % k]);
	return order;
}

TEST(Symmetry, NamesOfBodiesChangeNoBit)
{
	for (const bool simple : { true, false }) {
		const Problem p     = network(simple);
		const auto    named = shuffled(p.bodyCount(), 5); // body b becomes named[b]
		Problem       other = p;
		for (std::size_t b = 0; b < p.bodyCount(); ++b) {
			other.inverseMass[named[b]]  = p.inverseMass[b];
			other.freeVelocity[named[b]] = p.freeVelocity[b];
			other.positions[named[b]]    = p.positions[b];
		}
		for (Contact& c : other.contacts)
			c.i = named[c.i], c.j = named[c.j];
		for (const Method method : methods)
			forEachPath(p, sweeps(method), [&](const SolverSettings& s, const std::string& name) {
				const Solved       a = solved(p, s), b = solved(other, s);
				std::vector<Twist> velocities;
				for (const int body : named)
					velocities.push_back(b.problem.velocities[body]);
				EXPECT_TRUE(sameBits(b.problem.impulses, a.problem.impulses)) << name;
				EXPECT_TRUE(sameBits(velocities, a.problem.velocities)) << name;
				EXPECT_EQ(b.statistics.residual.rms, a.statistics.residual.rms) << name;
			});
	}
}

/// A tree without friction and rolling resistance has one solution, whatever the order of the sweep; in two strips.
Manufactured smooth() { return manufactured({ 61, 1200, 0, true, true }); }

SolverSettings exact(Method method)
{
	SolverSettings s;
	s.method        = method;
	s.tolerance     = 1e-11;
	s.maxIterations = 5000;
	return s;
}

TEST(Symmetry, TheOrderOfContactsChangesNoMotion)
{
	const Manufactured m     = smooth();
	const auto         order = shuffled(m.problem.contactCount(), 6);
	Problem            other = m.problem;
	for (std::size_t k = 0; k < order.size(); ++k)
		other.contacts[k] = m.problem.contacts[order[k]];
	for (const Method method : methods)
		forEachPath(m.problem, exact(method), [&](const SolverSettings& s, const std::string& name) {
			const Solved found = solved(other, s);
			EXPECT_TRUE(found.statistics.converged) << name;
			EXPECT_LE(largestDifference(found.problem.velocities, m.velocities), 1e-8)
			        << name; // 1e-11 of impulses near 1, through a thousand contacts
		});
}

TEST(Symmetry, StripsFromTheOtherEndChangeNoMotion)
{
	const Manufactured m = smooth();
	for (const Method method : methods)
		forEachPath(m.problem, exact(method), [&](const SolverSettings& s, const std::string& name) {
			const Solved found = solved(turned(m.problem, -1, 0), s);
			EXPECT_TRUE(found.statistics.converged) << name;
			EXPECT_LE(largestDifference(turned(found.problem, -1, 0).velocities, m.velocities), 1e-8)
			        << name;
		});
}

struct Units {
	double length, mass, time;
};

Problem inUnits(Problem p, const Units& u)
{
	const double speed = u.length / u.time, impulse = u.mass * speed;
	const auto   scale = [](double by, auto&... x) { ((x *= by), ...); };
	for (InverseMass& m : p.inverseMass)
		scale(1 / u.mass, m.x, m.y), scale(1 / (u.mass * u.length * u.length), m.w);
	for (auto* list : { &p.freeVelocity, &p.velocities })
		for (Twist& v : *list)
			scale(speed, v.x, v.y), scale(1 / u.time, v.w);
	for (Point& x : p.positions)
		scale(u.length, x.x, x.y);
	for (Contact& c : p.contacts) {
		scale(u.length, c.leverNi, c.leverTi, c.leverNj, c.leverTj, c.rollingArm, c.length);
		scale(speed, c.biasN, c.biasT, c.play);
		scale(1 / u.time, c.biasR);
		scale(impulse, c.adhesion);
	}
	for (Impulse& x : p.impulses)
		scale(impulse, x.n, x.t), scale(impulse * u.length, x.r);
	return p;
}

TEST(Symmetry, UnitsOfPowersOfTwoKeepTheBitsAndOthersAreRounding)
{
	const Units binary { 8, 1.0 / 32, 4 }, decimal { 1000, 0.45359237, 60 };
	for (const bool simple : { true, false })
		for (const Method method : methods)
			for (const StoppingTest test : { StoppingTest::NaturalMap, StoppingTest::QM16 }) {
				const Problem  p      = network(simple);
				SolverSettings common = sweeps(method);
				common.stopping       = test;
				forEachPath(p, common, [&](const SolverSettings& s, const std::string& name) {
					const Solved one = solved(p, s), other = solved(inUnits(p, binary), s),
					             third   = solved(inUnits(p, decimal), s);
					const Problem wanted = inUnits(one.problem, binary);
					EXPECT_TRUE(sameBits(other.problem.impulses, wanted.impulses)) << name;
					EXPECT_TRUE(sameBits(other.problem.velocities, wanted.velocities)) << name;
					EXPECT_EQ(
					        other.statistics.residual.relative(),
					        one.statistics.residual.relative())
					        << name;
					EXPECT_EQ(
					        other.statistics.changes.figure(StoppingTest::Maxm),
					        one.statistics.changes.figure(StoppingTest::Maxm))
					        << name;
					EXPECT_EQ(other.statistics.restarts, one.statistics.restarts) << name;
					const Problem back = inUnits(
					        third.problem,
					        { 1 / decimal.length, 1 / decimal.mass, 1 / decimal.time });
					EXPECT_LE(largestDifference(back.impulses, one.problem.impulses), rounding)
					        << name;
					EXPECT_LE(largestDifference(back.velocities, one.problem.velocities), rounding)
					        << name;
				});
			}
}

/// Two problems that do not know of each other; the second one's bodies are far away.
Problem sideBySide(const Problem& a, const Problem& b)
{
	Problem    p     = a;
	const auto count = std::int32_t(a.bodyCount());
	const auto join  = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
	join(p.inverseMass, b.inverseMass);
	join(p.freeVelocity, b.freeVelocity);
	join(p.contacts, b.contacts);
	join(p.impulses, b.impulses);
	for (Point x : b.positions)
		p.positions.push_back({ x.x + 3000, x.y });
	for (std::size_t k = a.contactCount(); k < p.contactCount(); ++k)
		p.contacts[k].i += count, p.contacts[k].j += count;
	return p;
}

template <class T> std::vector<T> joined(std::vector<T> a, const std::vector<T>& b)
{
	a.insert(a.end(), b.begin(), b.end());
	return a;
}

TEST(Symmetry, ProblemsSideBySideAreSweptAsEachAlone)
{
	// in one strip, contact after contact: colours sort each problem's contacts as they do alone; and no restart, which would look at both
	const Problem a = network(false, 200, 73), b = network(true, 150, 74);
	for (const Method method : methods) {
		SolverSettings s = sweeps(method, 9);
		s.reference      = true;
		const Solved x = solved(a, s), y = solved(b, s), both = solved(sideBySide(a, b), s);
		EXPECT_TRUE(sameBits(both.problem.impulses, joined(x.problem.impulses, y.problem.impulses)));
		EXPECT_TRUE(sameBits(both.problem.velocities, joined(x.problem.velocities, y.problem.velocities)));
		const double n = double(a.contactCount()), m = double(b.contactCount()), rx = x.statistics.residual.rms,
		             ry = y.statistics.residual.rms;
		EXPECT_NEAR(
		        both.statistics.residual.rms / std::sqrt((n * rx * rx + m * ry * ry) / (n + m)), 1,
		        1e-13); // the same squares in another order
	}
}

TEST(Symmetry, ProblemsSideBySideMoveAsEachAlone)
{
	const Manufactured a = smooth(), b = manufactured({ 70, 700, 0, true, true });
	const auto         wanted = joined(a.velocities, b.velocities);
	for (const Method method : methods)
		forEachPath(a.problem, exact(method), [&](const SolverSettings& s, const std::string& name) {
			const Solved found = solved(sideBySide(a.problem, b.problem), s);
			EXPECT_TRUE(found.statistics.converged) << name;
			EXPECT_LE(largestDifference(found.problem.velocities, wanted), 1e-8) << name;
		});
}

/// Errors of all signs, some bonds, and impulses to begin with.
std::vector<PositionError> errorsOf(const Problem& p)
{
	std::mt19937               dice(9);
	std::vector<PositionError> errors;
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		const bool bonded = dice() % 5 == 0, slipped = bonded && dice() % 2 == 0;
		errors.push_back({ 1e-3 * (dice() / 2147483648.0 - 1), bonded, bonded, slipped,
		                   1e-3 * (dice() / 4294967296.0), slipped ? 1.0f / 1024 : 0,
		                   slipped ? -1.0f / 512 : 0 });
	}
	return errors;
}

PositionCorrection corrected(Problem p, const std::vector<PositionError>& errors, const SolverSettings& s)
{
	Workspace          workspace;
	PositionCorrection found;
	solve(p, s, &workspace);
	correctPositions(p, s, workspace, errors, 12, found);
	return found;
}

TEST(Symmetry, DisplacementsToo)
{
	for (const bool simple : { true, false })
		for (const Method method : methods) {
			const Problem p      = network(simple);
			const auto    errors = errorsOf(p);
			forEachPath(p, sweeps(method, 3), [&](const SolverSettings& s, const std::string& name) {
				const auto one = corrected(p, errors, s);
				// mirrored: the same bits
				auto seen = errors;
				for (PositionError& e : seen)
					e.slip = -e.slip, e.turn = -e.turn;
				const auto mirror = corrected(mirrored(p), seen, s);
				Problem    back   = p;
				back.velocities   = mirror.displacements;
				EXPECT_EQ(mirror.impulses, one.impulses) << name;
				EXPECT_EQ(largestDifference(mirrored(back).velocities, one.displacements), 0) << name;
				// in other units, too
				const Units u { 8, 1.0 / 32, 4 };
				auto        scaled = errors;
				for (PositionError& e : scaled)
					e.error *= u.length, e.slip *= u.length, e.impulse *= u.mass * u.length;
				const auto other = corrected(inUnits(p, u), scaled, s);
				for (std::size_t k = 0; k < one.impulses.size(); ++k)
					ASSERT_EQ(other.impulses[k], u.mass * u.length * one.impulses[k])
					        << name << ", contact " << k;
				for (std::size_t b = 0; b < one.displacements.size(); ++b) {
					ASSERT_EQ(other.displacements[b].x, u.length * one.displacements[b].x)
					        << name << ", body " << b;
					ASSERT_EQ(other.displacements[b].w, one.displacements[b].w)
					        << name << ", body " << b;
				}
				// which body is the first: rounding of thousandths
				const Problem swapped = exchanged(p, 2);
				auto          turned  = errors;
				for (std::size_t k = 0; k < turned.size(); ++k)
					if (swapped.contacts[k].i != p.contacts[k].i) turned[k].turn = -turned[k].turn;
				const auto exchange = corrected(swapped, turned, s);
				EXPECT_LE(largestDifference(exchange.displacements, one.displacements), 1e-3 * rounding)
				        << name;
			});
		}
}

} // namespace
