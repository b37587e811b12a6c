#include "relaxation.hpp"
#include "space_order.hpp"
#include <neighbours/thread_part.hpp>
#include <stdexcept>
#include <utility>

// the same statements, compiled twice: the processor decides when the library is loaded (which sanitizers do not go
// with)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define NONSMOOTH_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define NONSMOOTH_WIDE
#endif

namespace nonsmooth::packing {

namespace {
	// margins of lists, in smallest diameters: `skin` is the walls', on which bits rest; the others are for speed
	constexpr double skinShare = 0.3, wideShare = 0.6, narrowShare = 0.005,
	                 stepsOfNarrow = 16, // for so many steps like the recent ones it shall hold
	        tooWide                = 3; // times the margin that would do
	constexpr double forgets       = 0.9; // of the largest step, in each
	constexpr double safe          = 0.999; // of a margin: rounding has the rest
	constexpr int    ahead         = 32; // bodies whose products, which lie anywhere, are asked for in time
	constexpr double nearest       = 1e-12; // m, of two centres
	constexpr double stripShare    = 4; // of the mean radius: a strip of the order in memory
	constexpr double strideShare   = 0.5; // of the smallest radius: the longest step

	template <class T> std::vector<T> arranged(const std::vector<T>& values, const std::vector<int>& number)
	{
		std::vector<T> own;
		own.reserve(number.size());
		for (const int k : number)
			own.push_back(values[k]);
		return own;
	}

	double mean(const std::vector<double>& r) { return numpySum(r.data(), r.size()) / double(r.size()); }
	double smallest(const std::vector<double>& r) { return *std::min_element(r.begin(), r.end()); }
} // namespace

Relaxation::Relaxation(const Given& given, const std::vector<Border>& borders, int threads_)
        : number(spaceOrder(given.x.data(), given.y.data(), int(given.x.size()), stripShare * mean(given.r)))
        , velocity(number.size())
        , force(number.size())
        , squeeze(number.size())
        , products(number.size())
        , radius(given.r)
        , near(number)
        , walls(borders, number)
        , threads(std::max(1, threads_))
        , skin(skinShare * 2 * smallest(given.r))
        , wideMargin(wideShare * 2 * smallest(given.r))
        , stride(strideShare * smallest(given.r))
        , recentStep(stride)
{
	for (const int k : number)
		bodies.push_back({ given.x[k], given.y[k], given.r[k], 0 });
	scratches.resize(threads);
	takeSizes(given);
	setMobility();
}

void Relaxation::takeSizes(const Given& given)
{
	std::vector<int> place(number.size());
	for (std::size_t k = 0; k < number.size(); ++k)
		place[number[k]] = int(k);
	layerAt  = arranged(given.layer, given.bySize);
	radiusAt = arranged(given.r, given.bySize);
	bySize   = arranged(place, given.bySize);
	for (std::size_t k = 1; k < bySize.size(); ++k)
		equals = equals || (layerAt[k] == layerAt[k - 1] && radiusAt[k] == radiusAt[k - 1]);
}

void Relaxation::setMobility()
{
	const double size = mean(radius);
	for (Body& b : bodies)
		b.mobility = size / b.r;
}

// ---- lists

bool Relaxation::wideHolds()
{
	if (2 * (sinceWide.atMost() + growth) < safe * wideMargin) return true;
	if (!std::isfinite(sinceWide.atMost())) return false;
	const double used = sinceWide.furthest(bodies, threads, [this](double square, int k) {
		return std::sqrt(square) + std::max(bodies[k].r - radiusWide[k], 0.0);
	});
	if (!(2 * used < safe * wideMargin)) return false;
	sinceWide.tighten(used);
	growth = 0; // it is in what is used
	return true;
}

void Relaxation::widen()
{
	near.widen(bodies, wideMargin, threads);
	// until the next time a body comes nearer to a wall by half of the margin at most
	walls.findCandidates(bodies, skin + 0.5 * wideMargin, threads);
	sinceWide.begin(bodies, threads);
	sinceNarrow.end();
	growth = 0;
	radiusWide.clear();
	double farthest = wideMargin;
	for (const Body& b : bodies) {
		radiusWide.push_back(b.r);
		farthest = std::max({ farthest, std::abs(b.x), std::abs(b.y) });
	}
	roundings = 4 * std::numeric_limits<double>::epsilon() * farthest;
	for (Scratch& s : scratches) {
		s.vector.resize(near.mostInBlock());
		s.reach.resize(near.mostInBlock());
	}
}

void Relaxation::updateLists()
{
	if (!wideHolds()) widen();
	if (!(2 * sinceWalls.atMost() < safe * skin)) {
		const bool   known  = std::isfinite(sinceWalls.atMost());
		const double square = known ? sinceWalls.furthest(bodies, threads, [](double d, int) { return d; }) : 0;
		if (known && square <= (skin / 2) * (skin / 2)) sinceWalls.tighten(std::sqrt(square));
		else {
			walls.choose(bodies, skin);
			sinceWalls.begin(bodies, threads);
		}
	}
	const double wanted = std::min(
	        std::max(2 * stepsOfNarrow * recentStep, narrowShare / wideShare * wideMargin), wideMargin);
	// as bodies slow down, a list that is still good has too many to be looked at
	if (!(2 * sinceNarrow.atMost() < safe * narrowMargin) || narrowMargin > tooWide * wanted) {
		narrowMargin = wanted;
		near.narrow(bodies, narrowMargin, threads);
		sinceNarrow.begin();
	}
}

// ---- forces

double Relaxation::forces(bool squeezes)
{
	updateLists();
	const int blocks = blocksOf(bodies.size());
	double    worst  = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : worst)
	for (int block = 0; block < blocks; ++block)
		worst = std::max(worst, forcesOf(block, neighbours::partOfThread(scratches), squeezes));
	accelerated = !squeezes;
	isSummed    = true;
	return worst;
}

/// Of the bodies of a block; returns their worst overlap. Where squeezes are wanted, radii may change before the step,
/// and accelerations wait for it.
double Relaxation::forcesOf(int block, Scratch& scratch, bool squeezes)
{
	gather(block, scratch);
	const double worst = pairForces(scratch, near.end(block) - near.begin(block));
	sumForces(block, scratch, squeezes);
	const double worstWall = wallForces(block);
	if (!squeezes) accelerate(BlockRange(block, bodies.size()));
	return std::max(worst, worstWall);
}

// Loops over a block's entries know of no bodies: loops of two or three neighbours would end where no processor
// foresees it.

void Relaxation::gather(int block, Scratch& scratch) const
{
	const int                  begin = near.begin(block), count = near.end(block) - begin;
	const int* const           neighbour = near.neighbour() + begin;
	const unsigned char* const segment   = near.segment() + begin;
	const Body* const          own       = bodies.data() + block * blockSize;
	Vector* const              vector    = scratch.vector.data();
	double* const              reach     = scratch.reach.data();
	for (int e = 0; e < count; ++e) {
		__builtin_prefetch(&bodies[neighbour[e + NearLists::ahead]]);
		const Body &a = own[inBlock(segment[e])], &b = bodies[neighbour[e]];
		vector[e] = { a.x - b.x, a.y - b.y };
		reach[e]  = a.r + b.r;
	}
}

/// Where two do not overlap, all is 0. Returns the worst overlap.
NONSMOOTH_WIDE double Relaxation::pairForces(Scratch& scratch, int count)
{
	Vector* const vector = scratch.vector.data();
	double* const reach  = scratch.reach.data();
	double        worst  = 0;
#pragma omp simd reduction(max : worst)
	for (int e = 0; e < count; ++e) {
		const double x = vector[e].x, y = vector[e].y, square = x * x + y * y, distance = std::sqrt(square),
		             inside = reach[e] - distance, overlap = square < reach[e] * reach[e] ? inside : 0,
		             f = overlap / (distance > nearest ? distance : nearest), share = 2 * overlap / reach[e];
		vector[e].x = f * x;
		vector[e].y = f * y;
		reach[e]    = overlap;
		worst       = worst > share ? worst : share;
	}
	return worst;
}

void Relaxation::sumForces(int block, Scratch& scratch, bool squeezes)
{
	const int                  begin = near.begin(block), count = near.end(block) - begin;
	const unsigned char* const segment = near.segment() + begin;
	const BlockRange           range(block, bodies.size());
	std::fill_n(scratch.force, segmentsOfBlock, Vector { 0, 0 });
	for (int e = 0; e < count; ++e) {
		scratch.force[segment[e]].x += scratch.vector[e].x;
		scratch.force[segment[e]].y += scratch.vector[e].y;
	}
	// vectors of pairs with lower ones have the sign of this body too, so both sums are added
	for (int k = range.first; k < range.last; ++k) {
		const Vector &lower  = scratch.force[segmentOf(k - range.first, false)],
		             &higher = scratch.force[segmentOf(k - range.first, true)];
		force[k]             = { higher.x + lower.x, higher.y + lower.y };
	}
	if (!squeezes) return;
	std::fill_n(scratch.squeeze, segmentsOfBlock, 0.0);
	for (int e = 0; e < count; ++e)
		scratch.squeeze[segment[e]] += scratch.reach[e];
	for (int k = range.first; k < range.last; ++k)
		squeeze[k] = scratch.squeeze[segmentOf(k - range.first, true)]
		        + scratch.squeeze[segmentOf(k - range.first, false)];
}

/// Adds those of walls; returns the worst overlap with one.
double Relaxation::wallForces(int block)
{
	double      worst = 0;
	const auto *wall = walls.begin(block), *const last = walls.end(block);
	while (wall != last) {
		const int   k = wall->body;
		const Body& b = bodies[k];
		Vector      sum { 0, 0 };
		double      inside = 0;
		for (; wall != last && wall->body == k; ++wall) {
			const Push p = pushOf(walls.edge(wall->edge), b.x, b.y, b.r);
			sum          = { sum.x + p.overlap * p.x, sum.y + p.overlap * p.y };
			inside += p.overlap;
			worst = std::max(worst, p.overlap / (2 * b.r));
		}
		force[k] = { force[k].x + 2 * sum.x, force[k].y + 2 * sum.y };
		squeeze[k] += 2 * inside; // of no meaning where squeezes are not wanted
	}
	return worst;
}

void Relaxation::accelerate(const BlockRange& range)
{
	const int last = int(bodies.size()) - 1;
	for (int k = range.first; k < range.last; ++k) {
		const Vector f = force[k], v = velocity[k], a { f.x * bodies[k].mobility, f.y * bodies[k].mobility };
		force[k] = a;
		__builtin_prefetch(&products[number[std::min(k + ahead, last)]], 1);
		products[number[k]] = { f.x * v.x + f.y * v.y, v.x * v.x + v.y * v.y, a.x * a.x + a.y * a.y };
	}
}

// ---- what moves

int Relaxation::exchange(int first, int stride)
{
	if (accelerated) throw std::logic_error("exchange wants forces with squeezes before it");
	if (first < 0 || stride < 1) throw std::invalid_argument("first must be 0 at least, and stride 1");
	int changed = 0;
	for (int begin = first; begin + stride < int(bySize.size()); begin += 2 * stride)
		for (int k = begin; k < std::min(begin + stride, int(bySize.size()) - stride); ++k) {
			const double difference = radiusAt[k + stride] - radiusAt[k];
			if (layerAt[k] != layerAt[k + stride]) continue;
			int &small = bySize[k], &large = bySize[k + stride];
			if (!(squeeze[large] - squeeze[small] > difference)) continue;
			++changed;
			if (difference == 0) continue; // the same sizes in the same order
			growth                = std::max(growth, radiusAt[k + stride] - radiusWide[small]);
			bodies[small].r       = radiusAt[k + stride];
			bodies[large].r       = radiusAt[k];
			radius[number[small]] = bodies[small].r;
			radius[number[large]] = bodies[large].r;
			std::swap(small, large);
		}
	if (changed) {
		if (equals) orderEquals();
		setMobility();
		sinceWalls.end();
		sinceNarrow.end();
	}
	return changed;
}

/// Bodies of one layer and one radius stand by their numbers.
void Relaxation::orderEquals()
{
	const int count = int(bySize.size());
	for (int begin = 0, end = 1; begin < count; begin = end++) {
		while (end < count && layerAt[end] == layerAt[begin] && radiusAt[end] == radiusAt[begin])
			++end;
		std::sort(bySize.begin() + begin, bySize.begin() + end, [this](int a, int b) {
			return number[a] < number[b];
		});
	}
}

void Relaxation::step()
{
	if (!isSummed) throw std::logic_error("step wants forces before it");
	isSummed = false;
	if (!std::exchange(accelerated, true)) {
		const int blocks = blocksOf(bodies.size());
#pragma omp parallel for num_threads(threads) schedule(static)
		for (int block = 0; block < blocks; ++block)
			accelerate(BlockRange(block, bodies.size()));
	}
	const auto [power, speed, acceleration] = sums.of(products, threads);
	const Fire::Change change               = fire.next(power, speed, acceleration);
	// of no body more than of all together; so most steps need not wait for the fastest one before they move bodies
	const double most = change.keep * std::sqrt(speed) + (change.pull + change.step) * std::sqrt(acceleration);
	double       longest;
	if (change.step * most < safe * stride) longest = change.step * std::sqrt(turn<true>(change));
	else {
		longest = change.step * std::sqrt(turn<false>(change));
		move(change.step, longest > stride ? stride / longest : 1);
	}
	// places are rounded
	const double moved = std::min(longest, stride) * (1 + 1e-9) + roundings;
	for (Travel* travel : { &sinceWide, &sinceNarrow, &sinceWalls })
		travel->add(moved);
	recentStep = std::max(moved, forgets * recentStep);
}

/// Changes velocities, and moves bodies by them; returns the square of the largest.
template <bool moves> double Relaxation::turn(const Fire::Change& change)
{
	const int    count   = int(bodies.size());
	double       fastest = 0;
	const double keep = change.keep, pull = change.pull, step = change.step;
	const bool   stops = change.stops;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : fastest)
	for (int k = 0; k < count; ++k) {
		const Vector a = force[k];
		Vector       v = velocity[k];
		v              = { keep * v.x + pull * a.x, keep * v.y + pull * a.y };
		if (stops) v = { 0, 0 };
		v           = { v.x + step * a.x, v.y + step * a.y };
		velocity[k] = v;
		if (moves) {
			bodies[k].x += step * v.x;
			bodies[k].y += step * v.y;
		}
		const double square = v.x * v.x + v.y * v.y;
		fastest             = fastest > square ? fastest : square;
	}
	return fastest;
}

/// Moves bodies by their velocities times `scale`.
void Relaxation::move(double step, double scale)
{
	const int count = int(bodies.size());
#pragma omp parallel for num_threads(threads) schedule(static)
	for (int k = 0; k < count; ++k) {
		const Vector v { velocity[k].x * scale, velocity[k].y * scale };
		velocity[k] = v;
		bodies[k].x += step * v.x;
		bodies[k].y += step * v.y;
	}
}

// ---- results

std::vector<double> Relaxation::column(Column which) const
{
	std::vector<double> values(bodies.size());
	for (std::size_t k = 0; k < bodies.size(); ++k) {
		const Body& b     = bodies[k];
		values[number[k]] = which == Column::x ? b.x
		        : which == Column::y           ? b.y
		        : which == Column::r           ? b.r
		        : which == Column::forceX      ? force[k].x
		        : which == Column::forceY      ? force[k].y
		                                       : squeeze[k];
	}
	return values;
}

} // namespace nonsmooth::packing
