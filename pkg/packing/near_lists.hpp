// Who can overlap whom: of each body, those near it, in the order in which its forces are summed.
//
// Two lists: `wide`, of bodies with a gap below a wide margin, found by a grid and good for many steps; and of it, by
// the places of now, the `narrow` one, good for fewer steps and not much longer than the overlaps themselves. Both have
// all pairs that overlap, as long as no body has moved and grown by more than half of the margin.
#pragma once

#include <neighbours/disk_grid.hpp>
#include <packing/body.hpp>
#include <vector>

namespace nonsmooth::packing {

/// A body's neighbours are in two segments, those with lower numbers and those with higher ones. Segments of a block.
constexpr int segmentsOfBlock = 2 * blockSize;
inline int    segmentOf(int inBlock, bool isHigher) { return 2 * inBlock + isHigher; }
inline int    inBlock(int segment) { return segment / 2; }

class NearLists {
public:
	/// So many entries behind the last one can be read, so that memory can be asked for ahead.
	static constexpr int ahead = 64;
	/// `number` by body: in whose order neighbours stand.
	explicit NearLists(std::vector<int> number);
	/// Finds the pairs with a gap below `margin` [m] anew; the narrow list is void after it.
	void widen(const std::vector<Body>& bodies, double margin, int threads);
	/// Takes those with a gap below `margin` [m] out of the wide list.
	void narrow(const std::vector<Body>& bodies, double margin, int threads);

	/// Entries of a block's bodies in the narrow list, from `begin` to before `end`.
	int begin(int block) const { return wideBegin[block * blockSize]; }
	int end(int block) const { return narrowEnd[block]; }
	/// By entry: the neighbour, and whose it is, see segmentOf. Those of a segment follow each other, by number.
	const int*           neighbour() const { return narrowItem.data(); }
	const unsigned char* segment() const { return narrowSegment.data(); }
	/// Entries of a block, at most.
	int mostInBlock() const { return most; }

private:
	std::vector<int>           number;
	std::vector<int>           wideBegin, wideItem; // those of body k from wideBegin[k] to before wideBegin[k + 1]
	std::vector<int>           narrowEnd, narrowItem; // those of a block from where its wide ones begin
	std::vector<unsigned char> wideSegment, narrowSegment;
	std::vector<int>           next;
	int                        most = 0;
	std::vector<neighbours::Disk> disks;
	neighbours::DiskGrid          grid;
	neighbours::Pairs             pairs;
	void                          bothWays();
	void                          sortBlock(int block);
};

} // namespace nonsmooth::packing
