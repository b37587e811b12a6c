// Cells along walls: pieces of equal length of what hangs together, which a slip law keeps its state in.
//
// Segments and arcs of one material are chained where each begins at the end of the one before it, in the order of ids,
// or each ends where that begins; each chain is cut into
//     n = max(1, round(L/length))
// cells of its own length L. So the joints of a polyline matter to no cell, and a wall that is cut finer has the same
// ones. Place along a chain: arc length s [m] from where its first wall begins, along local +x of a segment and
// counter-clockwise on an arc, or the other way.
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>
#include <vector>

namespace yade::nscd {

class WallCells {
public:
	WallCells() = default;
	/// Throws std::runtime_error where a body of the material is neither a Segment nor an Arc, and for more than a
	/// million cells.
	WallCells(const Scene& scene, const Material& material, Real length);

	size_t count() const { return ofCell.size(); }
	/// The cell next to a point on a wall [m]; −1 where it is none of these walls.
	int at(const Body& wall, const Vector3r& point) const;
	/// Length of a cell along the wall [m].
	Real lengthOf(size_t cell) const;
	/// Where a cell begins, from the beginning of the first chain, as if each followed the one before [m].
	Real beginOf(size_t cell) const;
	/// Where a place along a cell's wall lies now, `share` from 0, its beginning, to 1 [m]; NaN where the wall is
	/// gone.
	Vector3r pointOf(const Scene& scene, size_t cell, Real share) const;
	bool     isOfSameWalls(const WallCells& other) const;

private:
	struct Piece { // one wall
		Body::id_t id;
		int        chain;
		Real       begin, length; // along its chain [m]
	};
	struct Chain {
		Real length    = 0; // [m]
		bool backwards = false; // its walls end where the one before begins
		int  firstCell = 0, cells = 1;
	};
	const Piece* pieceOf(Body::id_t id) const;
	void         extend(const Scene& scene, const Body& body, Real own);
	Real         lengthOfAll(const Chain& chain) const;

	const Material* of = nullptr; // to know the walls again, and no more

	std::vector<Piece> pieces; // by id
	std::vector<Chain> chains;
	std::vector<int>   ofCell; // its chain
};

} // namespace yade::nscd
