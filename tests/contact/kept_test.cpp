// What a workspace keeps from one solve to the next changes no bit: along sequences of problems that change a little, each solve is held against one that starts
// with nothing. Where a change is one that a kept order cannot survive, both also have to say so.
#include "problems.hpp"
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

struct Change {
	const char*                   name;
	std::function<void(Problem&)> make;
	bool                          keeps; // whether the layout of the problem before is the one of this
};

constexpr int columns = 60, rows = 40;
constexpr int wall = columns * rows; // the floor

/// One after the other, each on what the one before left.
std::vector<Change> changes()
{
	return {
		{ "the same again", [](Problem&) {}, true },
		{ "thresholds and biases",
		  [](Problem& p) {
		          for (std::size_t k = 0; k < p.contactCount(); ++k) {
			          p.contacts[k].adhesion = 3 * double(k % 4);
			          p.contacts[k].friction = 0.1 * double(k % 5);
			          p.contacts[k].biasN -= 1e-3 * double(k % 3);
		          }
		  },
		  true },
		{ "masses and free velocities",
		  [](Problem& p) {
		          for (int b = 0; b < wall; ++b) {
			          p.inverseMass[b] = { p.inverseMass[b].x * 1.01, p.inverseMass[b].x * 1.01,
				                       p.inverseMass[b].w * 1.02 };
			          p.freeVelocity[b].x += 0.01 * double(b % 7);
		          }
		  },
		  true },
		{ "bodies move within their bins",
		  [](Problem& p) {
		          for (int b = 1; b < wall; b += 3) // none of those that the ends of the packing follow
			          p.positions[b].y += 1e-9;
		  },
		  true },
		{ "a row goes far",
		  [](Problem& p) {
		          for (int b = 0; b < columns; ++b)
			          p.positions[b].x += 0.7;
		  },
		  false },
		{ "a body is held from now on",
		  [](Problem& p) {
		          p.inverseMass[700]  = {};
		          p.freeVelocity[700] = { 0.01, 0, 0 };
		  },
		  false },
		{ "and let go again", [](Problem& p) { p.inverseMass[700] = p.inverseMass[701]; }, false },
		{ "a contact's second body is another one",
		  [](Problem& p) {
		          for (Contact& c : p.contacts)
			          if (c.i == 700) c.j = c.j + 1 == wall ? c.j - 2 : c.j + 1;
		  },
		  false },
		{ "a contact is one with another wall",
		  [](Problem& p) {
		          p.inverseMass.emplace_back();
		          p.freeVelocity.push_back({ 0.5, 0, 0 });
		          p.positions.push_back({ 5, 0 });
		          for (Contact& c : p.contacts)
			          if (c.i == wall && c.j == 7) c.i = wall + 1;
		  },
		  false },
		{ "a contact does not fit into blocks", [](Problem& p) { p.contacts[500].biasT = 0.02; }, false },
		{ "but does again", [](Problem& p) { p.contacts[500].biasT                     = 0; }, false },
		{ "a contact goes",
		  [](Problem& p) {
		          p.contacts.erase(p.contacts.begin() + 300);
		          p.impulses.erase(p.impulses.begin() + 300);
		  },
		  false },
		{ "two exchange their places", [](Problem& p) { std::swap(p.contacts[310], p.contacts[900]); }, false },
		{ "a body without contacts comes",
		  [](Problem& p) {
		          p.inverseMass.push_back({ 1e-4, 1e-4, 1e-4 });
		          p.freeVelocity.emplace_back();
		          p.positions.push_back({ 70, 20 });
		  },
		  false },
		{ "positions are forgotten", [](Problem& p) { p.positions.clear(); }, false },
		{ "few contacts are left",
		  [](Problem& p) {
		          p.contacts.resize(200);
		          p.impulses.resize(200);
		  },
		  false },
		{ "none is left",
		  [](Problem& p) {
		          p.contacts.clear();
		          p.impulses.clear();
		  },
		  false },
	};
}

std::vector<PositionError> errorsOf(const Problem& p)
{
	std::vector<PositionError> errors;
	for (std::size_t k = 0; k < p.contactCount(); ++k)
		errors.push_back({ 1e-3 * std::sin(double(k)), k % 7 == 0, k % 7 == 0, k % 14 == 0,
		                   std::sin(3 * double(k)), k % 70 == 0 ? 1e-4f : 0, k % 98 == 0 ? 1e-4f : 0 });
	return errors;
}

/// Solves and corrects; expects of both what a workspace that holds nothing gives.
void expectSame(Problem& p, const SolverSettings& s, Workspace& kept)
{
	Problem            other = p;
	Workspace          fresh;
	PositionCorrection mine, theirs;
	const auto         errors = errorsOf(p);
	const auto         a = solve(p, s, &kept), b = solve(other, s, &fresh);
	EXPECT_FALSE(fresh.laidOut.kept);
	EXPECT_EQ(a.iterations, b.iterations);
	EXPECT_EQ(a.restarts, b.restarts);
	EXPECT_EQ(a.strips, b.strips);
	EXPECT_EQ(a.residual.rms, b.residual.rms);
	EXPECT_EQ(a.residual.largest, b.residual.largest);
	EXPECT_TRUE(sameBits(p.impulses, other.impulses));
	EXPECT_TRUE(sameBits(p.velocities, other.velocities));
	correctPositions(p, s, kept, errors, 3, mine);
	correctPositions(other, s, fresh, errors, 3, theirs);
	EXPECT_TRUE(sameBits(mine.displacements, theirs.displacements));
	EXPECT_TRUE(sameBits(mine.impulses, theirs.impulses));
}

SolverSettings someSweeps(int threads, const BlockKernels* kernels)
{
	SolverSettings s;
	s.maxIterations = 12;
	s.tolerance     = 1e-300; // never met
	s.threads       = threads;
	s.kernels       = kernels;
	return s;
}

TEST(Kept, ChangesNoBitAlongASequence)
{
	for (const int threads : { 1, 2, 4 })
		for (const BlockKernels* kernels : availableKernels()) {
			const SolverSettings s = someSweeps(threads, kernels);
			Problem              p = lattice(columns, rows).problem;
			Workspace            workspace;
			expectSame(p, s, workspace);
			for (const Change& change : changes()) {
				SCOPED_TRACE(
				        std::string(change.name) + ", " + kernels->name + ", threads "
				        + std::to_string(threads));
				change.make(p);
				expectSame(p, s, workspace);
				EXPECT_EQ(workspace.laidOut.kept, change.keeps);
				expectSame(p, s, workspace); // the next one of the same kind
				EXPECT_TRUE(workspace.laidOut.kept);
			}
		}
}

/// The next solve of a workspace, and whether it kept what the one before had laid out.
void expectNext(Problem& p, const SolverSettings& s, Workspace& workspace, bool keeps)
{
	expectSame(p, s, workspace);
	EXPECT_EQ(workspace.laidOut.kept, keeps);
}

/// A body as far from both ends of its strip as any.
std::size_t inTheMiddleOfAStrip(const StripCut& cut)
{
	const auto& bins   = cut.scratch.binOfBody;
	const auto  strips = std::equal_range(
	         cut.scratch.stripOfBin.begin(), cut.scratch.stripOfBin.end(), cut.count / 2);
	const auto middle = static_cast<std::int32_t>(
	        (strips.first - cut.scratch.stripOfBin.begin() + strips.second - cut.scratch.stripOfBin.begin()) / 2);
	return std::min_element(
	               bins.begin(), bins.end(),
	               [middle](int a, int b) { return std::abs(a - middle) < std::abs(b - middle); })
	        - bins.begin();
}

// rows are half a disk apart, so one that goes by less makes no contact longer; the ends of the packing are those of other rows
TEST(Kept, NoCutWhereBodiesGoToOtherBinsThoughWidthAndPairsStay)
{
	for (const int threads : { 1, 2 }) {
		SCOPED_TRACE(threads);
		const SolverSettings s = someSweeps(threads, nullptr);
		Problem              p = lattice(columns, rows).problem;
		Workspace            workspace;
		expectNext(p, s, workspace, false);
		const StripCut& cut = workspace.laidOut.order.scratch.cut;
		const auto      go  = [&p](double far) {
                        for (int row = 2; row < rows; row += 2)
                                for (int b = row * columns; b < (row + 1) * columns; ++b)
                                        p.positions[b].x += far;
		};
		for (const double far : { 0.3, -0.3 }) {
			const StripCut before = cut;
			go(far);
			expectNext(p, s, workspace, false);
			EXPECT_TRUE(workspace.laidOut.classification.pairsKept);
			EXPECT_EQ(cut.scratch.bins, before.scratch.bins);
			EXPECT_EQ(cut.scratch.width, before.scratch.width);
			EXPECT_NE(cut.scratch.binOfBody, before.scratch.binOfBody);
			EXPECT_NE(cut.stripOfBody, before.stripOfBody);
		}
		// bins alone: the cut is made anew, and finds the same strips
		const StripCut before = cut;
		p.positions[inTheMiddleOfAStrip(cut)].x += 0.2;
		expectNext(p, s, workspace, true);
		EXPECT_NE(cut.scratch.binOfBody, before.scratch.binOfBody);
		EXPECT_EQ(cut.stripOfBody, before.stripOfBody);
	}
}

TEST(Kept, NoCutWhereContactsGoThoughBodiesStayInTheirBins)
{
	const SolverSettings s = someSweeps(2, nullptr);
	Problem              p = lattice(columns, rows).problem;
	Workspace            workspace;
	expectNext(p, s, workspace, false);
	const StripCut& cut    = workspace.laidOut.order.scratch.cut;
	const StripCut  before = cut;
	// most contacts of the first strip, but not so many that fewer strips are wanted
	std::size_t left = 300, kept = 0;
	for (std::size_t k = 0; k < p.contactCount(); ++k) {
		if (left > 0 && p.positions[p.contacts[k].j].x < 4) {
			--left;
			continue;
		}
		p.contacts[kept]   = p.contacts[k];
		p.impulses[kept++] = p.impulses[k];
	}
	p.contacts.resize(kept);
	p.impulses.resize(kept);
	ASSERT_EQ(left, 0u);
	expectNext(p, s, workspace, false);
	EXPECT_EQ(cut.scratch.bins, before.scratch.bins);
	EXPECT_EQ(cut.scratch.width, before.scratch.width);
	EXPECT_EQ(cut.scratch.binOfBody, before.scratch.binOfBody);
	EXPECT_NE(cut.stripOfBody, before.stripOfBody);
}

TEST(Kept, NoStripWherePositionsWereGoneInBetween)
{
	const SolverSettings s = someSweeps(2, nullptr);
	Problem              p = lattice(columns, rows).problem;
	Workspace            workspace;
	expectNext(p, s, workspace, false);
	const std::vector<Point> positions = std::exchange(p.positions, {});
	expectNext(p, s, workspace, false);
	EXPECT_EQ(workspace.laidOut.order.stripCount(), 1u);
	p.positions = positions;
	expectNext(p, s, workspace, false);
	EXPECT_GT(workspace.laidOut.order.stripCount(), 1u);
	expectNext(p, s, workspace, true);
}

// the one with the last id is second wherever two disks touch
TEST(Kept, NoOrderWhereTheSecondBodyOfContactsIsHeldOrLetGo)
{
	std::vector<Disk> disks = lattice(columns, rows).disks;
	std::swap(disks[20 * columns + 31], disks.back());
	Scene scene(disks);
	scene.touchDisks(0.03);
	scene.wall(0, 0, 0, 1, 0.03);
	const int second = wall - 1;
	for (const bool placed : { true, false })
		for (const int threads : { 1, 2 }) {
			SCOPED_TRACE(
			        (placed ? "in strips" : "in one strip") + std::string(", threads ")
			        + std::to_string(threads));
			const SolverSettings s = someSweeps(threads, nullptr);
			Problem              p = scene.problem;
			if (!placed) p.positions.clear();
			const auto of = [&p](std::int32_t Contact::*body) {
				return std::count_if(p.contacts.begin(), p.contacts.end(), [=](const Contact& c) {
					return c.*body == second;
				});
			};
			ASSERT_EQ(of(&Contact::i), 0);
			ASSERT_EQ(of(&Contact::j), 6);
			Workspace         workspace;
			const InverseMass free = p.inverseMass[second];
			p.freeVelocity[second] = { 5, 3, 0 }; // fast enough to meet its neighbours
			expectNext(p, s, workspace, false);
			p.inverseMass[second] = {};
			expectNext(p, s, workspace, false);
			EXPECT_TRUE(sameBits(
			        std::vector<Twist> { p.velocities[second] },
			        { p.freeVelocity[second] })); // it goes as it did, whatever pushes
			expectNext(p, s, workspace, true);
			p.inverseMass[second] = free;
			expectNext(p, s, workspace, false);
			EXPECT_FALSE(sameBits(std::vector<Twist> { p.velocities[second] }, { p.freeVelocity[second] }));
			expectNext(p, s, workspace, true);
		}
}

TEST(Kept, AnotherPathIsNotTakenForTheSame)
{
	Problem   p = lattice(columns, rows).problem;
	Workspace workspace;
	for (const bool reference : { false, true, true, false, false }) {
		SolverSettings s = someSweeps(2, nullptr);
		s.reference      = reference;
		expectSame(p, s, workspace);
	}
	EXPECT_TRUE(workspace.laidOut.kept);
}

// the refused one's pairs stand in the workspace, but the order is still that of the one before
TEST(Kept, NothingAfterARefusal)
{
	const SolverSettings s = someSweeps(1, nullptr);
	Problem              p = lattice(columns, rows).problem;
	Workspace            workspace;
	expectSame(p, s, workspace);
	std::swap(p.contacts[310], p.contacts[900]);
	const double friction = std::exchange(p.contacts[5].friction, -1);
	EXPECT_THROW(solve(p, s, &workspace), std::invalid_argument);
	p.contacts[5].friction = friction;
	expectSame(p, s, workspace);
	EXPECT_FALSE(workspace.laidOut.kept);
}

} // namespace
