// Disks freed of their overlaps: sweeps of FIRE (fire.hpp) on the energy of harmonic overlaps.
//
// A pair that overlaps by δ [m] pushes each of the two with the force δ (stiffness 1) along the line of centres, a wall
// with 2 δ along its normal; forces have the unit m, and times none. A body's squeeze is the sum of its overlaps, those
// with walls twice.
//
// The same input gives the same bits on any number of threads, and those that packings have always had: the forces on a
// body are summed in the order of its neighbours' numbers, over pairs in which it is the first, over those in which it
// is the second, and over walls, each from 0; sums over all bodies are NumPy's (numpy_sum.hpp). A pair that does not
// overlap is in no sum, so it is of no influence which pairs are looked at besides.
#pragma once

#include <packing/body.hpp>
#include <packing/fire.hpp>
#include <packing/near_lists.hpp>
#include <packing/numpy_sum.hpp>
#include <packing/travel.hpp>
#include <packing/wall_list.hpp>
#include <vector>

namespace nonsmooth::packing {

/// Disks by number: places and radii [m], layers; `bySize`: numbers by layer, radius and number.
struct Given {
	std::vector<double> x, y, r;
	std::vector<int>    layer, bySize;
};

class Relaxation {
public:
	Relaxation(const Given& given, const std::vector<Border>& borders, int threads);
	/// Computes forces; returns the largest overlap, by the mean diameter of the two, or the diameter at a wall.
	/// `squeezes` as well: `exchange` needs them.
	double forces(bool squeezes);
	/// After `forces`: disks of a layer whose places in the order of sizes are `stride` apart change places where
	/// the larger one is squeezed more, by more than it is larger. In the order every other stretch of `stride`
	/// places, from `first` on, has the smaller ones. Returns how many pairs did.
	int exchange(int first, int stride);
	/// After `forces`: moves all bodies by one step.
	void step();

	/// By number: places and radii [m], the forces on bodies and their squeezes [m].
	enum class Column { x, y, r, forceX, forceY, squeeze };
	std::vector<double> column(Column which) const;
	std::size_t         count() const { return bodies.size(); }

private:
	/// Of one block: by entry of the near lists, vectors from neighbours to bodies, which become forces, and the
	/// distances at which they touch, which become overlaps; and sums by segment.
	struct Scratch {
		std::vector<Vector> vector;
		std::vector<double> reach;
		Vector              force[segmentsOfBlock];
		double              squeeze[segmentsOfBlock];
	};
	std::vector<int>               number;
	std::vector<Body>              bodies;
	std::vector<Vector>            velocity, force; // accelerations once `accelerate` has seen them
	std::vector<double>            squeeze;
	std::vector<TripleSum::Triple> products; // F·v, v·v, a·a, by number
	std::vector<double>            radius; // by number
	// order of sizes: bodies, which change, and their layers and radii, which do not
	std::vector<int>     bySize, layerAt;
	std::vector<double>  radiusAt;
	bool                 equals = false; // some disks of a layer have the same radius
	NearLists            near;
	WallList             walls;
	Travel               sinceWide, sinceNarrow, sinceWalls;
	std::vector<double>  radiusWide; // when the wide list was made
	std::vector<Scratch> scratches;
	TripleSum            sums;
	Fire                 fire;
	int                  threads;
	double               skin, wideMargin, narrowMargin = 0, growth = 0, stride, recentStep,
	                         roundings = 0; // of a place in a step
	bool          accelerated = true, isSummed = false; // forces have become accelerations; are those of now
	void          takeSizes(const Given& given);
	void          setMobility();
	void          updateLists();
	bool          wideHolds();
	void          widen();
	double        forcesOf(int block, Scratch& scratch, bool squeezes);
	void          gather(int block, Scratch& scratch) const;
	static double pairForces(Scratch& scratch, int count);
	void          sumForces(int block, Scratch& scratch, bool squeezes);
	double        wallForces(int block);
	void          accelerate(const BlockRange& range);
	template <bool moves> double turn(const Fire::Change& change);
	void                         move(double step, double scale);
	void                         orderEquals();
};

} // namespace nonsmooth::packing
