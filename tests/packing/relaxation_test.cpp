// The relaxation of packings against forces of every pair, on several threads, and over many sweeps.
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <packing/close_pairs.hpp>
#include <packing/relaxation.hpp>
#include <packing/space_order.hpp>
#include <random>

using namespace nonsmooth::packing;
using Column = Relaxation::Column;

namespace {

/// Disks thrown into a square, `widest` times as large as others, and its walls; radii of every third are the same.
struct Crowd {
	Crowd(int count, double widest, int layers = 2)
	{
		std::mt19937                           random(7);
		std::uniform_real_distribution<double> share(0, 1);
		double                                 area = 0;
		for (int k = 0; k < count; ++k) {
			given.r.push_back(k % 3 ? std::pow(widest, share(random)) : std::sqrt(widest));
			given.layer.push_back(k % layers);
			area += M_PI * given.r[k] * given.r[k];
		}
		size = std::sqrt(area / 0.84);
		for (int k = 0; k < count; ++k) {
			given.x.push_back(size * share(random));
			given.y.push_back(size * share(random));
		}
		given.bySize.resize(count);
		std::iota(given.bySize.begin(), given.bySize.end(), 0);
		std::stable_sort(given.bySize.begin(), given.bySize.end(), [this](int a, int b) {
			return std::make_pair(given.layer[a], given.r[a]) < std::make_pair(given.layer[b], given.r[b]);
		});
		borders = { { { { 0, 0, 1, 0, size, true, true },
			        { size, 0, 0, 1, size, true, true },
			        { size, size, -1, 0, size, true, true },
			        { 0, size, 0, -1, size, true, true } },
			      {} } };
	}
	Relaxation          relaxation(int threads = 1) const { return { given, borders, threads }; }
	Given               given;
	std::vector<Border> borders;
	double              size;
};

struct Forces {
	std::vector<double> x, y, squeeze;
	double              worst = 0;
};

/// Of every pair and every wall, by places and radii of now.
Forces forcesOfAll(const Relaxation& r, const Crowd& crowd)
{
	const auto   xs = r.column(Column::x), ys = r.column(Column::y), rs = r.column(Column::r);
	const size_t n = xs.size();
	Forces       f { std::vector<double>(n), std::vector<double>(n), std::vector<double>(n) };
	for (size_t i = 0; i < n; ++i) {
		for (size_t j = 0; j < n; ++j) {
			const double x = xs[i] - xs[j], y = ys[i] - ys[j], d = std::hypot(x, y), in = rs[i] + rs[j] - d;
			if (i == j || in <= 0) continue;
			f.x[i] += in * x / d;
			f.y[i] += in * y / d;
			f.squeeze[i] += in;
			f.worst = std::max(f.worst, 2 * in / (rs[i] + rs[j]));
		}
		for (const Edge& e : crowd.borders[0].edges) {
			const Push p = pushOf(e, xs[i], ys[i], rs[i]);
			f.x[i] += 2 * p.overlap * p.x;
			f.y[i] += 2 * p.overlap * p.y;
			f.squeeze[i] += 2 * p.overlap;
			f.worst = std::max(f.worst, p.overlap / (2 * rs[i]));
		}
	}
	return f;
}

void expectNear(const std::vector<double>& found, const std::vector<double>& wanted, const char* what, int sweep)
{
	for (size_t k = 0; k < found.size(); ++k)
		ASSERT_NEAR(found[k], wanted[k], 1e-9) << what << " of " << k << " in sweep " << sweep;
}

/// A sweep; where there are exchanges, every tenth has one, and the strides change.
int sweep(Relaxation& r, int number, bool exchanges = true)
{
	exchanges = exchanges && number % 10 == 9;
	r.forces(exchanges);
	const int changed = exchanges ? r.exchange(number % 7, 1 + number % 13) : 0;
	r.step();
	return changed;
}

} // namespace

TEST(Relaxation, ForcesAreThoseOfEveryPairAlsoManySweepsLater)
{
	for (const double widest : { 1.0, 3.0, 40.0, -3.0 }) { // below 0 without exchanges
		const Crowd crowd(400, std::abs(widest));
		Relaxation  r = crowd.relaxation();
		for (int k = 0; k < 600; ++k) {
			if (k % 20 == 0 || k == 201) {
				const double worst  = r.forces(true);
				const Forces wanted = forcesOfAll(r, crowd);
				EXPECT_NEAR(worst, wanted.worst, 1e-9);
				expectNear(r.column(Column::forceX), wanted.x, "force x", k);
				expectNear(r.column(Column::forceY), wanted.y, "force y", k);
				expectNear(r.column(Column::squeeze), wanted.squeeze, "squeeze", k);
			}
			sweep(r, k, widest > 0);
		}
	}
}

TEST(Relaxation, ItEndsWithoutOverlapsWhereThereIsRoom)
{
	const Crowd crowd(300, 3.0);
	Crowd       roomy = crowd;
	for (double& r : roomy.given.r)
		r *= 0.9;
	Relaxation r = roomy.relaxation();
	int        k = 0;
	while (r.forces(false) > 1e-4 && k < 5000)
		sweep(r, k++);
	EXPECT_LT(k, 5000);
	EXPECT_LT(forcesOfAll(r, roomy).worst, 1e-4);
}

TEST(Relaxation, TheSameBitsOnAnyNumberOfThreads)
{
	const Crowd crowd(3000, 5.0);
	Relaxation  one = crowd.relaxation(), two = crowd.relaxation(2), three = crowd.relaxation(3);
	for (int k = 0; k < 25; ++k)
		for (Relaxation* r : { &one, &two, &three })
			sweep(*r, k);
	for (const Column c : { Column::x, Column::y, Column::r }) {
		EXPECT_EQ(one.column(c), two.column(c));
		EXPECT_EQ(one.column(c), three.column(c));
	}
}

TEST(Relaxation, ExchangesKeepSizesAndLayersAndTheirOrder)
{
	const Crowd crowd(500, 3.0, 3);
	Relaxation  r       = crowd.relaxation();
	int         changed = 0;
	for (int k = 0; k < 200; ++k) {
		changed += sweep(r, k);
		const auto now = r.column(Column::r);
		for (int layer = 0; layer < 3; ++layer) {
			std::vector<double> before, after;
			for (size_t d = 0; d < now.size(); ++d)
				if (crowd.given.layer[d] == layer) {
					before.push_back(crowd.given.r[d]);
					after.push_back(now[d]);
				}
			std::sort(before.begin(), before.end());
			std::sort(after.begin(), after.end());
			ASSERT_EQ(before, after);
		}
	}
	EXPECT_GT(changed, 100);
}

TEST(Relaxation, WhatComesInAnotherOrderIsRefused)
{
	Relaxation r = Crowd(20, 2.0).relaxation();
	EXPECT_THROW(r.step(), std::logic_error);
	EXPECT_THROW(r.exchange(0, 1), std::logic_error);
	r.forces(false);
	EXPECT_THROW(r.exchange(0, 1), std::logic_error);
	r.forces(true);
	EXPECT_THROW(r.exchange(0, 0), std::invalid_argument);
	EXPECT_THROW(r.exchange(-1, 1), std::invalid_argument);
	r.step();
	EXPECT_THROW(r.step(), std::logic_error);
}

TEST(Relaxation, OneDiskAloneStaysWhereItIs)
{
	Given      one { { 3 }, { 4 }, { 1 }, { 0 }, { 0 } };
	Relaxation r(one, {}, 2);
	EXPECT_EQ(r.forces(true), 0);
	EXPECT_EQ(r.exchange(0, 1), 0);
	r.step();
	EXPECT_EQ(r.column(Column::x), one.x);
	EXPECT_EQ(r.column(Column::y), one.y);
}

TEST(Fire, StepsGrowDownhillAndStopUphill)
{
	Fire fire;
	for (int k = 0; k < 5; ++k) {
		const Fire::Change c = fire.next(1, 4, 1);
		EXPECT_FALSE(c.stops);
		EXPECT_DOUBLE_EQ(c.keep, 0.9);
		EXPECT_DOUBLE_EQ(c.pull, 0.2); // 0.1 √(4/1)
		EXPECT_DOUBLE_EQ(c.step, 0.2);
	}
	EXPECT_DOUBLE_EQ(fire.next(1, 4, 1).step, 0.22);
	EXPECT_DOUBLE_EQ(fire.next(1, 4, 1).keep, 1 - 0.099);
	const Fire::Change stop = fire.next(0, 4, 1);
	EXPECT_TRUE(stop.stops);
	EXPECT_DOUBLE_EQ(stop.step, 0.5 * 1.1 * 0.22);
	for (int k = 0; k < 9; ++k)
		fire.next(-1, 4, 1);
	EXPECT_DOUBLE_EQ(fire.next(-1, 4, 1).step, 0.05);
	for (int k = 0; k < 99; ++k)
		fire.next(1, 4, 1);
	EXPECT_DOUBLE_EQ(fire.next(1, 4, 1).step, 1);
}

TEST(NumpySum, SmallSumsAreThoseOfTheirOrder)
{
	// 2^53 and ones: what is added alone to the large number is lost, what is added to others first is not
	const double        large = 9007199254740992.0;
	std::vector<double> seven { large, 1, 1, 1, 1, 1, 1 }, sixteen(16, 1.0), many(8193, 0.0);
	EXPECT_EQ(numpySum(seven.data(), 7), large);
	sixteen[0] = large;
	EXPECT_EQ(
	        numpySum(sixteen.data(), 16), large + 14); // the one in its own lane is lost, and so is that beside it
	many[0]    = large;
	many[8191] = many[8192] = 1;
	EXPECT_EQ(numpySum(many.data(), 8193), large); // the last one is of another stretch
	many[8192] = 0;
	many[8190] = 1;
	EXPECT_EQ(numpySum(many.data(), 8192), large + 2);
}

TEST(NumpySum, ThreeAtATimeAreEachTheSame)
{
	std::vector<TripleSum::Triple> items(20011);
	std::vector<double>            columns[3];
	std::mt19937                   random(3);
	for (auto& item : items)
		for (int q = 0; q < 3; ++q) {
			item[q] = std::normal_distribution<double>()(random);
			columns[q].push_back(item[q]);
		}
	TripleSum sums;
	for (const int threads : { 1, 3 })
		for (int q = 0; q < 3; ++q)
			EXPECT_EQ(sums.of(items, threads)[q], numpySum(columns[q].data(), items.size()));
	EXPECT_EQ(sums.of({}, 1), TripleSum::Triple {});
}

TEST(SpaceOrder, HasEachOnceAndNearOnesNear)
{
	const Crowd       crowd(4000, 1.0);
	const auto        order = spaceOrder(crowd.given.x.data(), crowd.given.y.data(), 4000, 4.0);
	std::vector<bool> seen(4000);
	for (const int k : order)
		seen[k] = true;
	EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 4000);
	double way = 0;
	for (size_t k = 1; k < order.size(); ++k)
		way += std::hypot(
		        crowd.given.x[order[k]] - crowd.given.x[order[k - 1]],
		        crowd.given.y[order[k]] - crowd.given.y[order[k - 1]]);
	EXPECT_LT(way / 4000, 4.0); // a strip's width, where any order has half of the region
	EXPECT_TRUE(spaceOrder(nullptr, nullptr, 0, 1.0).empty());
}

TEST(ClosePairs, RootsDecideToTheLastBit)
{
	// 3, 4, 5: the gap is 0 and not below it; a margin of the least bit is
	std::vector<nonsmooth::neighbours::Disk> two { { 0, 0, 2 }, { 3, 4, 3 } };
	std::vector<int>                         i, j;
	closePairs(two, 0, 1, i, j);
	EXPECT_TRUE(i.empty());
	closePairs(two, 1e-15, 1, i, j);
	EXPECT_EQ(i, std::vector<int> { 0 });
	EXPECT_EQ(j, std::vector<int> { 1 });
}
