#include "WallCells.hpp"
#include "Arc.hpp"
#include "../checks/Refusal.hpp"
#include "Segment.hpp"
#include <algorithm>
#include <lib/high-precision/Constants.hpp>
#include <numeric>

namespace yade::nscd {

namespace {
	constexpr Real meets     = 1e-6; // of a wall's length, as joints of walls have it
	constexpr Real mostCells = 1e6;

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
        : of(&material)
{
	for (const auto& body : *scene.bodies) {
		if (!body || body->material.get() != &material || !body->shape) continue;
		const Real own = nscd::lengthOf(*body->shape);
		if (!(own > 0))
			fail("body #" + std::to_string(body->getId()) + ", a " + body->shape->getClassName()
			     + ", has the " + material.getClassName() + " '" + material.label
			     + "', whose cells lie along Segments and Arcs: give it an NscdMat");
		extend(scene, *body, own);
	}
	Real all = 0;
	for (Chain& chain : chains) {
		chain.length = lengthOfAll(chain);
		all += chain.length;
	}
	if (const Real wanted = all / length; !(wanted <= mostCells))
		fail(material.getClassName() + " '" + material.label + "': cellLength = " + number(length) + ": "
		     + about(wanted) + " cells along " + about(all) + " m of wall; give at least "
		     + about(all / mostCells) + " m");
	for (size_t k = 0; k < chains.size(); ++k) {
		chains[k].firstCell = int(ofCell.size());
		chains[k].cells     = std::max(1, int(std::lround(chains[k].length / length)));
		ofCell.resize(ofCell.size() + chains[k].cells, int(k));
	}
}

/// Puts a wall at the end of the last chain, where it meets that, or begins another one.
void WallCells::extend(const Scene& scene, const Body& body, Real own)
{
	const auto meet = [&](const Vector3r& a, const Vector3r& b) { return (a - b).norm() <= meets * own; };
	if (!chains.empty()) {
		Chain&      chain   = chains.back();
		const Body& last    = *(*scene.bodies)[pieces.back().id];
		const Real  end     = pieces.back().length;
		const bool  alone   = pieces.size() < 2 || pieces[pieces.size() - 2].chain != pieces.back().chain;
		const bool  onwards = meet(pointOn(last, end), pointOn(body, 0)),
		           back     = meet(pointOn(last, 0), pointOn(body, own));
		if (alone ? onwards || back : (chain.backwards ? back : onwards)) {
			if (alone) chain.backwards = !onwards;
			pieces.push_back({ body.getId(), int(chains.size()) - 1, chain.length, own });
			chain.length += own;
			return;
		}
	}
	chains.push_back({});
	pieces.push_back({ body.getId(), int(chains.size()) - 1, 0, own });
	chains.back().length = own;
}

/// The same bits from either end.
Real WallCells::lengthOfAll(const Chain& chain) const
{
	std::vector<Real> lengths;
	for (const Piece& piece : pieces)
		if (&chains[piece.chain] == &chain) lengths.push_back(piece.length);
	std::sort(lengths.begin(), lengths.end());
	return std::accumulate(lengths.begin(), lengths.end(), Real(0));
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
	const Real   along = std::clamp(wayOf(wall, point), Real(0), piece->length);
	const Real   way   = piece->begin + (chain.backwards ? piece->length - along : along);
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
	const Body* wall = last && scene.bodies->exists(last->id) ? (*scene.bodies)[last->id].get() : nullptr;
	if (!wall || wall->material.get() != of || !(nscd::lengthOf(*wall->shape) > 0))
		return Vector3r(NaN, NaN, NaN); // it is gone
	const Real along = std::clamp(way - last->begin, Real(0), last->length);
	return pointOn(*wall, chains[chain].backwards ? last->length - along : along);
}

bool WallCells::isOfSameWalls(const WallCells& other) const
{
	return std::equal(
	        pieces.begin(), pieces.end(), other.pieces.begin(), other.pieces.end(),
	        [](const Piece& a, const Piece& b) { return a.id == b.id && a.length == b.length; });
}

} // namespace yade::nscd
