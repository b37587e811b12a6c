// Squares of the plane with the disks in them: by how much velocities, or paths, of disks that are near each other can
// differ.
//
// Disks of an avalanche slide side by side: none is slow, but few are fast against those around them. What a square and
// the eight around it have in common says for all pairs of disks that are no farther apart than a square is wide how
// fast they can approach.
#pragma once

#include <array>
#include <neighbours/cell.hpp>
#include <neighbours/disk_grid.hpp>

namespace nonsmooth::neighbours {

struct Vector {
	double x, y;
};

class Regions {
public:
	/// Sorts the disks into squares of that width [m], each where it is now.
	void build(const std::vector<Disk>& disks, double width);
	int  count() const { return (int)around.size(); }
	/// The square of a disk; negative where the disk is not there.
	int of(int disk) const { return square[disk]; }
	/// By square, the largest difference of two vectors of disks in it and in the eight around it, or a little
	/// more; `vectors` by disk.
	void differences(int threads, const std::vector<Vector>& vectors, std::vector<double>& found);
	/// By square, the largest of the values of it and of the eight around it.
	void largestAround(const std::vector<double>& values, std::vector<double>& found) const;

private:
	struct Extent {
		double xMin, yMin, xMax, yMax;
	};
	std::vector<Cell> places; // of squares
	std::vector<int>  table; // squares by a hash of their places; negative where there is none
	std::vector<int>  square; // by disk
	std::vector<int>  begin, member; // disks of square s from member[begin[s]] to member[begin[s + 1]]
	std::vector<std::array<int, 9>> around; // squares, itself among them; itself again where there is none
	std::vector<Extent>             extents; // of the vectors in each
};

} // namespace nonsmooth::neighbours
