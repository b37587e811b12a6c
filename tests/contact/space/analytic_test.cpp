// Contacts in space whose answer can be written down: slip to roll, spins that come to rest, thresholds of bonds, a
// stack, momentum.
#include "balls.hpp"
#include <contact/space/law.hpp>
#include <contact/space/residual.hpp>
#include <gtest/gtest.h>

using namespace nonsmooth::contact::space;
using namespace nonsmooth::contact::space::testing;

namespace {

constexpr double g = 9.81, h = 1e-3;

/// One ball on a floor: body 0 the ball, body 1 the floor; the normal points from the floor to the ball.
struct OnFloor {
	double  m = 3, r = 0.25, inertia = 0.4 * m * r * r;
	Vector  n { 0, 0, 1 };
	Problem p;

	OnFloor()
	{
		p.inverseMass = { InverseMass::ofSphere(1 / m, 1 / inertia), {} };
		p.freeVelocity.resize(2);
		Contact c;
		c.i        = 1;
		c.j        = 0;
		c.n        = n;
		c.leverJ   = -r;
		c.length   = 2 * r;
		p.contacts = { c };
		p.impulses.resize(1);
	}
	Contact& contact() { return p.contacts[0]; }

	/// A step under a pull [m/s²] from a state of the ball; returns its new state.
	Twist after(const Twist& v, const Vector& pull, bool reference)
	{
		p.freeVelocity[0] = { v.v + h * pull, v.w };
		SolverSettings s;
		s.tolerance = 1e-13;
		s.reference = reference;
		EXPECT_TRUE(solve(p, s).converged);
		return p.velocities[0];
	}
};

class SpaceOneContact : public ::testing::TestWithParam<bool> { };
INSTANTIATE_TEST_SUITE_P(ByTheLawAndInBlocks, SpaceOneContact, ::testing::Bool());

TEST_P(SpaceOneContact, ABallThatSlidesRollsAtFiveSevenths)
{
	OnFloor scene;
	scene.contact().friction = 0.2;
	const Vector v0 { 3, 4, 0 }; // not along an axis
	Twist        v { v0, {} };
	// while it slides it loses μ g a second, until 2/7 v0 are gone
	const int sliding = int(2. / 7 * 5 / (0.2 * g) / h);
	for (int k = 0; k < sliding; ++k) {
		v = scene.after(v, { 0, 0, -g }, GetParam());
		ASSERT_NEAR(length(v.v), 5 - 0.2 * g * h * (k + 1), 1e-11);
	}
	for (int k = 0; k < 100; ++k)
		v = scene.after(v, { 0, 0, -g }, GetParam());
	EXPECT_LE(length(v.v - 5. / 7 * v0), 1e-12);
	// ω = n × v / r rolls without sliding
	EXPECT_LE(length(v.w - 1 / scene.r * cross(scene.n, v.v)), 1e-12);
}

TEST_P(SpaceOneContact, ASpinAboutTheNormalComesToRestByTwistingAlone)
{
	OnFloor scene;
	scene.contact().friction    = 0.5;
	scene.contact().twistingArm = 0.02 * scene.contact().length;
	// dω/dt = −μ_tw ℓ m g / I
	const double loss = scene.contact().twistingArm * scene.m * g / scene.inertia;
	Twist        v { {}, { 0, 0, 10 } };
	const int    steps = int(10 / (loss * h));
	for (int k = 1; k <= steps; ++k) {
		v = scene.after(v, { 0, 0, -g }, GetParam());
		ASSERT_NEAR(v.w.z, 10 - loss * h * k, 1e-10);
		ASSERT_LE(length(v.v), 1e-13);
	}
	v = scene.after(v, { 0, 0, -g }, GetParam());
	EXPECT_LE(length(v.w), 1e-12); // and does not begin to turn back
	EXPECT_LE(std::abs(dot(scene.n, scene.p.impulses[0].m)), scene.contact().twistingArm * scene.m * g * h);
}

TEST_P(SpaceOneContact, RollingResistanceSlowsARollingBall)
{
	OnFloor scene;
	scene.contact().friction   = 0.8;
	scene.contact().rollingArm = 0.01 * scene.contact().length;
	// rolls without sliding: (I/r² + m) dv/dt = −Γ/r, so that dv/dt = −(5/7) (μ_r ℓ / r) g
	const double loss = 5. / 7 * scene.contact().rollingArm / scene.r * g;
	const Vector way  = unit({ 1, 2, 0 });
	Twist        v { 2 * way, 2 / scene.r * cross(scene.n, way) };
	const int    steps = int(2 / (loss * h));
	for (int k = 1; k <= steps; ++k) {
		v = scene.after(v, { 0, 0, -g }, GetParam());
		ASSERT_LE(length(v.v - (2 - loss * h * k) * way), 1e-10);
	}
	v = scene.after(v, { 0, 0, -g }, GetParam());
	EXPECT_LE(length(v.v) + length(v.w), 1e-11);
}

TEST_P(SpaceOneContact, ASpinAboutTheNormalDoesNotHelpABallDownAnIncline)
{
	// a point contact's twist is no sliding: the ball rolls down with 5/7 g sin α whatever it spins by
	OnFloor scene;
	scene.contact().friction    = 0.6;
	scene.contact().twistingArm = 1e-3;
	const double slope          = 0.3;
	const Vector pull { g * std::sin(slope), 0, -g * std::cos(slope) };
	const double spinLoss = 1e-3 * scene.m * g * std::cos(slope) / scene.inertia;
	Twist        v { {}, { 0, 0, 50 } };
	for (int k = 1; k <= 300; ++k) {
		v = scene.after(v, pull, GetParam());
		ASSERT_NEAR(v.v.x, 5. / 7 * g * std::sin(slope) * h * k, 1e-10);
		ASSERT_NEAR(v.w.z, 50 - spinLoss * h * k, 1e-9);
		ASSERT_LE(std::abs(v.v.y), 1e-12);
	}
}

/// A bond that is pulled by `impulse` and turned by `moment` in one step: what is left of the ball's motion.
Twist pulled(double adhesion, const Impulse& load, bool reference, Impulse* carried = nullptr)
{
	OnFloor  scene;
	Contact& c              = scene.contact();
	c.n                     = unit({ 1, -2, 2 });
	c.adhesion              = adhesion;
	c.friction              = 0.7;
	c.rollingArm            = 0.03;
	c.twistingArm           = 0.02;
	c.leverJ                = 0; // so that a pull across does not turn it
	scene.p.freeVelocity[0] = { 1 / scene.m * load.f, 1 / scene.inertia * load.m };
	SolverSettings s;
	s.tolerance = 1e-14;
	s.reference = reference;
	EXPECT_TRUE(solve(scene.p, s).converged);
	if (carried) *carried = scene.p.impulses[0];
	return scene.p.velocities[0];
}

TEST_P(SpaceOneContact, ABondHoldsToItsThresholdsInAllFourModesAndNoFurther)
{
	const Vector n = unit({ 1, -2, 2 }), t = unit(cross(n, { 0.3, 1, 0.2 }));
	const double a = 5, close = 1e-12;
	const struct {
		const char* name;
		Impulse     direction; // of the load
		double      threshold;
	} modes[] = { { "tension", { n, {} }, a },
		      { "shear", { t, {} }, 0.7 * a },
		      { "rolling", { {}, t }, 0.03 * a },
		      { "twisting", { {}, n }, 0.02 * a },
		      { "twisting the other way", { {}, -1 * n }, 0.02 * a } };
	for (const auto& mode : modes) {
		SCOPED_TRACE(mode.name);
		const auto moves = [&](double load) {
			const Twist v = pulled(a, { load * mode.direction.f, load * mode.direction.m }, GetParam());
			return length(v.v) + length(v.w);
		};
		EXPECT_LE(moves(mode.threshold * (1 - close)), 1e-13);
		// what is beyond moves it, and nothing of what it holds
		const double  beyond = 1e-6;
		Impulse       carried;
		const double  load = mode.threshold * (1 + beyond);
		const Twist   v = pulled(a, { load * mode.direction.f, load * mode.direction.m }, GetParam(), &carried);
		const OnFloor scene;
		EXPECT_LE(length(scene.m * v.v - mode.threshold * beyond * mode.direction.f), close);
		EXPECT_LE(length(scene.inertia * v.w - mode.threshold * beyond * mode.direction.m), close);
		EXPECT_LE(length(carried.f + mode.threshold * mode.direction.f), close);
		EXPECT_LE(length(carried.m + mode.threshold * mode.direction.m), close);
	}
}

TEST_P(SpaceOneContact, ThresholdsAreDiscsNotBoxes)
{
	const Vector n = unit({ 1, -2, 2 }), t = unit(cross(n, { 0.3, 1, 0.2 })), across = cross(n, t);
	for (const double angle : { 0.1, 0.7, 1.3, 2.9 }) {
		const Vector way = std::cos(angle) * t + std::sin(angle) * across;
		Impulse      carried;
		pulled(5, { 20 * way, 10 * way }, GetParam(), &carried);
		EXPECT_LE(length(carried.f + 0.7 * 5 * way), 1e-12);
		EXPECT_LE(length(carried.m + 0.03 * 5 * way), 1e-12);
	}
}

TEST_P(SpaceOneContact, SlidingDoesNotOpenAContact)
{
	OnFloor scene;
	scene.contact().friction = 0.5;
	const Twist v            = scene.after({ { 30, 0, 0 }, {} }, { 0, 0, -g }, GetParam());
	EXPECT_LE(std::abs(v.v.z), 1e-14);
}

TEST_P(SpaceOneContact, ABondWithPlayIsFreeBetweenTouchAndItsLength)
{
	OnFloor  scene;
	Contact& c       = scene.contact();
	c.adhesion       = 4;
	c.play           = 0.1;
	const auto speed = [&](double load) { return scene.after({ { 0, 0, load }, {} }, {}, GetParam()).v.z; };
	EXPECT_NEAR(speed(-1), 0, 1e-13); // touches
	EXPECT_NEAR(speed(0.05), 0.05, 1e-13);
	EXPECT_NEAR(speed(0.5), 0.1, 1e-13); // is at its length
	EXPECT_NEAR(speed(2), 2 - 4 / scene.m, 1e-13); // breaks: 4 N s of 6
}

TEST(SpaceStack, OfFiftyBearsWhatLiesAboveInEveryContact)
{
	std::vector<Ball> balls;
	for (int k = 0; k < 50; ++k)
		balls.push_back({ { 0, 0, 0.5 + k }, 0.5 });
	Balls scene(balls);
	scene.touch(1e-9);
	scene.wall({}, { 0, 0, 1 }, 1e-9);
	forEachPath(scene.problem, {}, [&](SolverSettings s, const std::string& name) {
		Problem p       = scene.problem;
		s.tolerance     = 1e-11;
		s.maxIterations = 100000;
		EXPECT_TRUE(solve(p, s).converged) << name;
		const double weight = scene.mass(balls[0]) * gravity * step;
		for (std::size_t k = 0; k < p.contactCount(); ++k) {
			const Contact& c     = p.contacts[k];
			const int      above = 50 - std::max(c.i == 50 ? 0 : c.i, c.j == 50 ? 0 : c.j);
			EXPECT_NEAR(p.impulses[k].f.z / (weight * above), 1, 1e-7) << name << k;
		}
		for (const Twist& v : p.velocities)
			EXPECT_LE(length(v.v), 1e-8) << name;
	});
}

TEST(SpaceMomentum, LinearAndAngularAreKeptToRounding)
{
	// a cloud without walls, with bonds: whatever impulses there are, they act in pairs at one point
	Balls scene = lattice(6, 6);
	auto& p     = scene.problem;
	p.contacts.erase(
	        std::remove_if(
	                p.contacts.begin(), p.contacts.end(),
	                [&](const Contact& c) { return p.inverseMass[c.i].isFixed(); }),
	        p.contacts.end());
	p.impulses.resize(p.contactCount());
	for (std::size_t b = 0; b + 1 < p.bodyCount(); ++b)
		p.freeVelocity[b] = { { std::sin(double(b)), std::cos(3. * double(b)), 0.3 },
			              { 0, std::sin(5. * double(b)), 1 } };
	for (Contact& c : p.contacts) {
		c.adhesion = 20;
		// the contact point lies on the line of centres, where the levers say
		const Vector d = p.positions[c.j] - p.positions[c.i];
		c.leverI       = 0.5 * length(d);
		c.leverJ       = -0.5 * length(d);
		c.n            = unit(d);
	}
	const auto momenta = [&](const std::vector<Twist>& v) {
		Vector linear, angular;
		for (std::size_t b = 0; b + 1 < p.bodyCount(); ++b) {
			const double m = 1 / p.inverseMass[b].x, inertia = 1 / p.inverseMass[b].inertia.xx;
			linear  = linear + m * v[b].v;
			angular = angular + cross(p.positions[b], m * v[b].v) + inertia * v[b].w;
		}
		return std::pair(linear, angular);
	};
	const auto [linear, angular] = momenta(p.freeVelocity);
	forEachPath(p, {}, [&](SolverSettings s, const std::string& name) {
		Problem q       = p;
		s.maxIterations = 60;
		solve(q, s);
		const auto [l, a] = momenta(q.velocities);
		EXPECT_GT(largestDifference(q.velocities, p.freeVelocity), 0.1) << name;
		EXPECT_LE(length(l - linear) / length(linear), 1e-12) << name;
		EXPECT_LE(length(a - angular) / length(angular), 1e-12) << name;
	});
}

} // namespace
