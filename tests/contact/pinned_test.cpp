// The bits of three problems after fifty sweeps: whoever changes them decides so, and says it in a commit.
#include "problems.hpp"
#include <contact/plane/problem_file.hpp>
#include <filesystem>
#include <gtest/gtest.h>
#include <iomanip>
#include <sstream>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

/// FNV-1a of 64 bits.
std::string hashOf(const std::vector<Impulse>& impulses)
{
	std::uint64_t hash  = 14695981039346656037u;
	const auto*   bytes = reinterpret_cast<const unsigned char*>(impulses.data());
	for (std::size_t k = 0; k < impulses.size() * sizeof(Impulse); ++k)
		hash = (hash ^ bytes[k]) * 1099511628211u;
	std::ostringstream text;
	text << std::hex << std::setw(16) << std::setfill('0') << hash;
	return text.str();
}

Problem recorded(const char* name)
{
	RecordedProblem r = read(
	        (std::filesystem::path(__FILE__).parent_path().parent_path() / "data" / name).string());
	r.problem.impulses = r.warmStart;
	return r.problem;
}

/// 60 × 40 disks on a triangular lattice above a floor, from numbers that every processor and library makes alike: no draws, no libm but √.
Problem plainLattice()
{
	constexpr int       columns = 60, rows = 40, floor = columns * rows;
	Problem             p;
	std::vector<double> radius;
	for (int k = 0; k < floor; ++k) {
		radius.push_back(0.49 + 0.0001 * double(k * 7919 % 113));
		const double r = radius.back(), m = 2500 * pi * r * r;
		p.inverseMass.push_back({ 1 / m, 1 / m, 2 / (m * r * r) });
		p.freeVelocity.push_back({ 0.001 * double(k % 5), -gravity * step, 0 });
		p.positions.push_back({ k % columns + 0.5 * (k / columns % 2), 0.5 + k / columns * 0.866 });
	}
	p.inverseMass.emplace_back();
	p.freeVelocity.emplace_back();
	p.positions.emplace_back();
	const auto add = [&p](int i, int j, double nx, double ny, double gap, double ri, double rj) {
		Contact c;
		c.i = i, c.j = j, c.nx = nx, c.ny = ny, c.leverTi = ri, c.leverTj = -rj;
		c.biasN      = (gap > 0 ? 1 : 0.2) * gap / step;
		c.adhesion   = 10 * (j % 3);
		c.friction   = 0.3;
		c.rollingArm = 0.1 * (ri + rj);
		c.length     = ri + rj;
		p.contacts.push_back(c);
		p.impulses.emplace_back();
	};
	for (int k = 0; k < columns; ++k)
		add(floor, k, 0, 1, p.positions[k].y - radius[k], 0, radius[k]);
	for (int k = 0; k < floor; ++k) {
		const int right = k + 1, above = k + columns, column = k % columns, odd = k / columns % 2;
		for (const int j : { column + 1 < columns ? right : -1, above - 1 + odd, above + odd }) {
			if (j < 0 || j >= floor || (j != right && std::abs(j % columns - column) > 1)) continue;
			const double x = p.positions[j].x - p.positions[k].x, y = p.positions[j].y - p.positions[k].y,
			             d = std::sqrt(x * x + y * y);
			add(k, j, x / d, y / d, d - radius[k] - radius[j], radius[k], radius[j]);
		}
	}
	return p;
}

void expectPinned(
        const char* name, const Problem& problem, const char* blocks, const char* inSingle, const char* reference)
{
	const auto found = [&](SolverSettings s, int threads) {
		Problem p = problem;
		p.impulses.assign(p.contactCount(), {}); // from there neither tolerance is met in so few sweeps
		s.maxIterations = 20;
		s.threads       = threads;
		EXPECT_EQ(solve(p, s).iterations, 20);
		return hashOf(p.impulses);
	};
	const auto expect = [&](const std::string& hash, const char* pinned, const std::string& how) {
		EXPECT_EQ(hash, pinned)
		        << name << ", " << how
		        << ": the bits of the impulses have changed. Results of all runs change with them: if that is what you decided,"
		        << " put " << hash << " here and name the reason in the commit; else something is broken.";
	};
	for (const int threads : { 1, 2 }) {
		const std::string with = ", " + std::to_string(threads) + " thread(s)";
		for (const BlockKernels* kernels : availableKernels()) {
			SolverSettings s;
			s.kernels   = kernels;
			s.tolerance = finestInSingle;
			expect(found(s, threads), inSingle, kernels->name + (", in single precision" + with));
			s.tolerance = 1e-300;
			expect(found(s, threads), blocks, kernels->name + with);
		}
		SolverSettings s;
		s.tolerance = 1e-300;
		s.reference = true;
		expect(found(s, threads), reference, "reference" + with);
	}
}

TEST(Pinned, SlopeBeforeItFails)
{
	expectPinned(
	        "slope_t1.h5", recorded("slope_t1.h5"), "0f6632ae3081f0c1", "3dfca0ced16de869", "b5bda7ee800a6ad0");
}
TEST(Pinned, AvalancheInMotion)
{
	expectPinned(
	        "avalanche_t4.h5", recorded("avalanche_t4.h5"), "2d4cfe259ad16f93", "7ea2da5a8b44c0b7",
	        "b0115932549f5303");
}
TEST(Pinned, Lattice)
{
	expectPinned("a lattice", plainLattice(), "1cf75276da065351", "e8d06e9d267c2ecd", "63213af8b1ee02a3");
}

} // namespace
