// The grid against every pair tried.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <neighbours/disk_grid.hpp>
#include <random>
#include <set>

using namespace nonsmooth::neighbours;

namespace {
using Set = std::set<std::pair<int, int>>;

std::vector<Disk>
scattered(int count, double side, double smallest, double largest, unsigned seed, double largestMargin = 0)
{
	std::mt19937                           random(seed);
	std::uniform_real_distribution<double> place(-side / 2, side / 2), size(std::log(smallest), std::log(largest)),
	        margin(0, 1);
	std::vector<Disk> disks;
	for (int k = 0; k < count; ++k)
		disks.push_back(
		        { place(random), place(random), std::exp(size(random)), largestMargin * margin(random) });
	return disks;
}

Set everyPair(const std::vector<Disk>& disks, double factor)
{
	Set found;
	for (int i = 0; i < (int)disks.size(); ++i)
		for (int j = i + 1; j < (int)disks.size(); ++j) {
			const Disk &a = disks[i], &b = disks[j];
			if (a.r < 0 || b.r < 0) continue;
			const double far = factor * (a.r + b.r) + std::min(a.margin, b.margin);
			if ((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) < far * far) found.emplace(i, j);
		}
	return found;
}

Set asSet(const Pairs& pairs)
{
	Set found;
	for (int i = 0; i + 1 < (int)pairs.begin.size(); ++i)
		for (int k = pairs.begin[i]; k < pairs.begin[i + 1]; ++k) {
			EXPECT_GT(pairs.second[k], i);
			EXPECT_TRUE(k == pairs.begin[i] || pairs.second[k] > pairs.second[k - 1])
			        << "in order, and each pair once";
			found.emplace(i, pairs.second[k]);
		}
	return found;
}

Set found(const std::vector<Disk>& disks, double factor, int threads = 1)
{
	DiskGrid grid;
	Pairs    pairs;
	grid.build(disks, factor);
	grid.pairs(threads, pairs);
	return asSet(pairs);
}
}

TEST(DiskGrid, FindsThePairsOfDisksOfManySizes)
{
	for (const double largest : { 1.0, 4.0, 300.0 }) {
		for (const double margin : { 0.0, 0.7, 20.0 }) {
			const auto   disks    = scattered(900, 60, 0.5, largest, 1, margin);
			const double factor   = margin > 0 ? 1.05 : 1;
			const Set    expected = everyPair(disks, factor);
			ASSERT_GT(expected.size(), 100u);
			EXPECT_EQ(found(disks, factor), expected);
			EXPECT_EQ(found(disks, factor, 3), expected);
		}
	}
}

TEST(DiskGrid, OneGridServesForManyLists)
{
	DiskGrid grid;
	Pairs    pairs;
	for (const int count : { 500, 20, 0, 700 }) {
		const auto disks = scattered(count, 40, 0.3, count == 20 ? 0.4 : 3, unsigned(count), 0.2);
		grid.build(disks, 1.1);
		grid.pairs(2, pairs);
		EXPECT_EQ(asSet(pairs), everyPair(disks, 1.1));
	}
}

TEST(DiskGrid, DisksFarAwayAndDisksThatAreNotThereDoNoHarm)
{
	auto disks = scattered(300, 30, 0.5, 2, 5);
	disks[7].r = -1;
	disks.push_back({ 1e12, -3e14, 1 });
	disks.push_back({ 1e12 + 1.5, -3e14, 1 });
	const Set expected = everyPair(disks, 1.01);
	ASSERT_TRUE(expected.count({ 300, 301 }));
	disks.push_back({ std::numeric_limits<double>::quiet_NaN(), 0, 1 });
	disks.push_back({ 0, std::numeric_limits<double>::infinity(), 1 });
	EXPECT_EQ(found(disks, 1.01), expected);
}

TEST(DiskGrid, FindsDisksNearABox)
{
	const auto   disks  = scattered(800, 80, 0.5, 5, 9);
	const double factor = 1.5, margin = 0.3;
	DiskGrid     grid;
	grid.build(disks, 1.2); // boxes may reach farther than disks
	const double     all = std::numeric_limits<double>::infinity();
	std::vector<int> near;
	for (const Box box :
	     { Box { -3, 2, 9, 4 }, Box { 5, 5, 5, 5 }, Box { -all, -1, all, 1 }, Box { 500, 500, 501, 501 } }) {
		std::vector<int> expected;
		for (int i = 0; i < (int)disks.size(); ++i) {
			const Disk&  d   = disks[i];
			const double out = factor * d.r + margin;
			if (d.x >= box.xMin - out && d.x <= box.xMax + out && d.y >= box.yMin - out
			    && d.y <= box.yMax + out)
				expected.push_back(i);
		}
		grid.near(box, factor, margin, near);
		EXPECT_EQ(near, expected);
	}
}
