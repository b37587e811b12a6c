#include "WallCells.hpp"
#include "Arc.hpp"
#include "Refusal.hpp"
#include "Segment.hpp"
#include <algorithm>

namespace yade::nscd {

namespace {
	constexpr Real meets = 1e-6; // of a wall's length, as joints of walls have it

	Real lengthOf(const Shape& shape)
	{
		if (const auto* segment = dynamic_cast<const Segment*>(&shape)) return 2 * segment->halfLength;
		if (const auto* arc = dynamic_cast<const Arc*>(&shape)) return 2 * arc->halfAngle * arc->radius;
		return 0;
	}

	/// A point of a wall by its way [m] from the wall's beginning.
	Vector3r pointOn(const Body& wall, Real way)
	{
		const State& state = *wall.state;
		if (const auto* arc = dynamic_cast<const Arc*>(wall.shape.get())) {
			const Real angle = way / arc->radius - arc->halfAngle;
			return state.pos
			        + state.ori * Vector3r(arc->radius * std::cos(angle), arc->radius * std::sin(angle), 0);
		}
		const auto& segment = static_cast<const Segment&>(*wall.shape);
		return state.pos + state.ori * Vector3r(way - segment.halfLength, 0, 0);
	}

	Real wayOf(const Body& wall, const Vector3r& point)
	{
		const Vector3r local = wall.state->ori.conjugate() * (point - wall.state->pos);
		if (const auto* arc = dynamic_cast<const Arc*>(wall.shape.get()))
			return arc->radius * (std::atan2(local[1], local[0]) + arc->halfAngle);
		return local[0] + static_cast<const Segment&>(*wall.shape).halfLength;
	}
}

WallCells::WallCells(const Scene& scene, const Material& material, Real length)
{
	const Body* last = nullptr;
	for (const auto& body : *scene.bodies) {
		if (!body || body->material.get() != &material || !body->shape) continue;
		const Real own = nscd::lengthOf(*body->shape);
		if (!(own > 0))
			fail("body #" + std::to_string(body->getId()) + ", a " + body->shape->getClassName()
			     + ", has the " + material.getClassName() + " '" + material.label
			     + "', whose cells lie along Segments and Arcs: give it an NscdMat");
		const bool joined = last
		        && (pointOn(*last, nscd::lengthOf(*last->shape)) - pointOn(*body, 0)).norm() <= meets * own;
		if (!joined) chains.push_back({});
		pieces.push_back({ body->getId(), int(chains.size()) - 1, chains.back().length, own });
		chains.back().length += own;
		last = body.get();
	}
	for (size_t k = 0; k < chains.size(); ++k) {
		chains[k].firstCell = int(ofCell.size());
		chains[k].cells     = std::max(1, int(std::lround(chains[k].length / length)));
		ofCell.resize(ofCell.size() + chains[k].cells, int(k));
	}
}

const WallCells::Piece* WallCells::pieceOf(Body::id_t id) const
{
	const auto found = std::lower_bound(pieces.begin(), pieces.end(), id, [](const Piece& p, Body::id_t wanted) {
		return p.id < wanted;
	});
	return found != pieces.end() && found->id == id ? &*found : nullptr;
}

int WallCells::at(const Body& wall, const Vector3r& point) const
{
	const Piece* piece = pieceOf(wall.getId());
	if (!piece) return -1;
	const Chain& chain = chains[piece->chain];
	const Real   way   = piece->begin + std::clamp(wayOf(wall, point), Real(0), piece->length);
	return chain.firstCell + std::clamp(int(way / chain.length * chain.cells), 0, chain.cells - 1);
}

Real WallCells::lengthOf(size_t cell) const
{
	const Chain& chain = chains[ofCell[cell]];
	return chain.length / chain.cells;
}

Real WallCells::beginOf(size_t cell) const
{
	Real begin = 0;
	for (int k = 0; k < ofCell[cell]; ++k)
		begin += chains[k].length;
	return begin + (int(cell) - chains[ofCell[cell]].firstCell) * lengthOf(cell);
}

Vector3r WallCells::pointOf(const Scene& scene, size_t cell, Real share) const
{
	const int    chain = ofCell[cell];
	const Real   way   = (int(cell) - chains[chain].firstCell + share) * lengthOf(cell);
	const Piece* last  = nullptr;
	for (const Piece& piece : pieces) {
		if (piece.chain != chain) continue;
		last = &piece;
		if (way <= piece.begin + piece.length) break;
	}
	return pointOn(*(*scene.bodies)[last->id], std::clamp(way - last->begin, Real(0), last->length));
}

bool WallCells::operator==(const WallCells& other) const { return pieces == other.pieces && ofCell == other.ofCell; }

} // namespace yade::nscd
