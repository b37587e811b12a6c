// A packing at rest by LMGC90 (tests/data/README.md), solved from a cold start.
#include "problems.hpp"
#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>
#include <zlib.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

constexpr double width = 409.59035;

std::vector<Disk> readPacking()
{
	const auto path = std::filesystem::path(__FILE__).parent_path().parent_path() / "data"
	        / "lmgc90_5000_disks.txt.gz";
	const gzFile file = gzopen(path.string().c_str(), "rb");
	if (!file) throw std::runtime_error("cannot be read: " + path.string());
	std::string text;
	char        buffer[1 << 16];
	for (int n; (n = gzread(file, buffer, sizeof buffer)) > 0;)
		text.append(buffer, n);
	gzclose(file);
	std::vector<Disk>  disks;
	std::istringstream lines(text);
	for (std::string line; std::getline(lines, line);) {
		if (line.empty() || line[0] == '#') continue;
		Disk               d;
		std::istringstream fields(line);
		fields >> d.x >> d.y >> d.r;
		disks.push_back(d);
	}
	return disks;
}

struct Result {
	SolverStatistics statistics;
	double           carried  = 0; // by the floor and by the friction of the sides, as a share of the weight
	double           floor    = 0;
	double           momentum = 0; // vertical, in the same units
};

Result solveCold(Method method, int sweeps)
{
	Scene scene(readPacking());
	scene.relaxationRate = 0; // taking back what overlaps LMGC90 left would lift the packing and press on the floor
	const double alert   = 0.05;
	scene.touchDisks(alert);
	const int floor = scene.wall(0, 0, 0, 1, alert), left = scene.wall(0, 0, 1, 0, alert),
	          right = scene.wall(width, 0, -1, 0, alert);
	SolverSettings s;
	s.method        = method;
	s.maxIterations = sweeps;
	s.tolerance     = 1e-9; // all sweeps are used
	Result result;
	result.statistics = solve(scene.problem, s);
	for (std::size_t k = 0; k < scene.problem.contactCount(); ++k) {
		const int     wall = scene.problem.contacts[k].i;
		const Impulse p    = scene.problem.impulses[k];
		if (wall == floor) result.floor += p.n;
		if (wall == left) result.carried += p.t;
		if (wall == right) result.carried -= p.t;
	}
	for (std::size_t b = 0; b < scene.disks.size(); ++b)
		result.momentum += scene.mass(scene.disks[b]) * scene.problem.velocities[b].y;
	const double weight = scene.weightImpulse();
	result.carried      = (result.carried + result.floor) / weight;
	result.floor /= weight;
	result.momentum /= weight;
	std::printf(
	        "%4d sweeps: residual %.2e, carried %.4f of the weight\n", result.statistics.iterations,
	        result.statistics.residual.relative(), result.carried);
	EXPECT_EQ(scene.disks.size(), 5000u);
	return result;
}

TEST(Reference, AccelerationSolvesTheColdPacking)
{
	const Result fast = solveCold(Method::Accelerated, 300), plain = solveCold(Method::GaussSeidel, 300);

	EXPECT_EQ(fast.statistics.iterations, 300);
	// sweeps are deterministic; distances are not rounded alike by every libm, which moves the last digits of a residual
	EXPECT_NEAR(
	        fast.statistics.residual.relative(), 7.0e-6, 0.4e-6); // below the engine's default tolerance of 1e-4
	EXPECT_NEAR(plain.statistics.residual.relative(), 1.54e-3, 0.05e-3); // two hundred times as much
	// LMGC90 carries 0.9985 + 0.0019; a cold start leaves some to rattlers and gaps that may still close
	EXPECT_NEAR(fast.carried, 0.9972, 0.0005);
	EXPECT_NEAR(fast.floor, 0.9843, 0.0005); // the sides take the rest by friction
	EXPECT_NEAR(plain.carried, 0.522, 0.001); // nearly half of the weight falls freely: the creep of a loose solve

	// what is not carried falls: Newton's law for the sum, to rounding over 15,000 contacts
	for (const Result& r : { fast, plain })
		EXPECT_NEAR(r.carried - 1, r.momentum, 1e-11);
}

} // namespace
