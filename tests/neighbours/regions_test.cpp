// Bounds of squares against every pair tried.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <neighbours/regions.hpp>
#include <random>

using namespace nonsmooth::neighbours;

namespace {
constexpr double width = 3;

struct Swarm {
	std::vector<Disk>   disks;
	std::vector<Vector> velocities;
};

/// Disks that turn about the origin, so that those far from each other differ by more than neighbours do.
Swarm turning(int count, double side, unsigned seed)
{
	std::mt19937                           random(seed);
	std::uniform_real_distribution<double> place(-side / 2, side / 2), other(-0.5, 0.5);
	Swarm                                  swarm;
	for (int k = 0; k < count; ++k) {
		const double x = place(random), y = place(random);
		swarm.disks.push_back({ x, y, 0.3 });
		swarm.velocities.push_back({ -y + other(random), x + other(random) });
	}
	return swarm;
}

/// A disk in each of 25 squares, row by row.
Regions fiveByFive()
{
	std::vector<Disk> disks;
	for (int y = 0; y < 5; ++y)
		for (int x = 0; x < 5; ++x)
			disks.push_back({ width * (x + 0.5), width * (y + 0.5), 0.3 });
	Regions regions;
	regions.build(disks, width);
	return regions;
}

bool isAroundTheMiddle(int k) { return std::abs(k % 5 - 2) <= 1 && std::abs(k / 5 - 2) <= 1; }

double difference(const Vector& a, const Vector& b) { return std::hypot(a.x - b.x, a.y - b.y); }
}

TEST(Regions, BoundTheDifferencesOfDisksNearEachOtherAndNotThoseOfAll)
{
	const Swarm swarm = turning(600, 60, 1);
	Regions     regions;
	regions.build(swarm.disks, width);
	std::vector<double> found, again;
	regions.differences(1, swarm.velocities, found);
	regions.differences(3, swarm.velocities, again);
	EXPECT_EQ(found, again);
	ASSERT_EQ((int)found.size(), regions.count());
	double largest = 0;
	for (int i = 0; i < 600; ++i)
		for (int j = i + 1; j < 600; ++j) {
			const Disk & a = swarm.disks[i], &b = swarm.disks[j];
			const double d = difference(swarm.velocities[i], swarm.velocities[j]);
			largest        = std::max(largest, d);
			if (std::abs(a.x - b.x) > width || std::abs(a.y - b.y) > width) continue;
			EXPECT_GE(found[regions.of(i)], d);
			EXPECT_GE(found[regions.of(j)], d);
		}
	// nine squares are 9 wide, across which velocities differ by 9 √2 and the scatter's √2
	for (const double d : found)
		EXPECT_LE(d, 10 * std::sqrt(2.0));
	EXPECT_GT(largest, 60);
}

TEST(Regions, TheLargestAroundIsThatOfTheSquareAndTheEightAroundIt)
{
	Regions regions = fiveByFive();
	ASSERT_EQ(regions.count(), 25);
	std::vector<double> values(25, 1.0), found;
	values[regions.of(12)] = 7; // the middle
	regions.largestAround(values, found);
	for (int k = 0; k < 25; ++k)
		EXPECT_EQ(found[regions.of(k)], isAroundTheMiddle(k) ? 7 : 1) << k;
}

TEST(Regions, DifferencesAreThoseOfTheSquareAndTheEightAroundItEachWay)
{
	Regions regions = fiveByFive();
	for (const Vector& v : { Vector { 3, 0 }, { -3, 0 }, { 0, 3 }, { 0, -3 } }) {
		std::vector<Vector> velocities(25, Vector { 1, -2 });
		velocities[12] = { 1 + v.x, -2 + v.y }; // the middle
		std::vector<double> found;
		regions.differences(2, velocities, found);
		for (int k = 0; k < 25; ++k)
			EXPECT_EQ(found[regions.of(k)], isAroundTheMiddle(k) ? 3 : 0) << k;
	}
}

TEST(Regions, DisksThatAreNotThereHaveNoSquare)
{
	const double nan = std::numeric_limits<double>::quiet_NaN();
	Regions      regions;
	regions.build({ { 0, 0, 1 }, { 1, 0, -1 }, { nan, 0, 1 }, { -1e300, 1e300, 1 } }, width);
	EXPECT_EQ(regions.count(), 2);
	EXPECT_LT(regions.of(1), 0);
	EXPECT_LT(regions.of(2), 0);
	std::vector<double> found;
	regions.differences(1, { { 0, 0 }, { 9, 9 }, { 9, 9 }, { 4, 0 } }, found);
	EXPECT_EQ(found, (std::vector<double> { 0, 0 }));
	regions.build({}, width);
	EXPECT_EQ(regions.count(), 0);
}
