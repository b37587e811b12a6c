#include <algorithm>
#include <contact/contact_blocks.hpp>
#include <contact/law.hpp>
#include <contact/sweep_order.hpp>

namespace nonsmooth::contact {
namespace {

	/// What the short formulas of the blocks ask of a body.
	enum BodyTrait : std::uint8_t { moves = 1, turns = 2, plain = 4 };

	std::uint8_t traitsOf(const InverseMass& m, const Twist& freeVelocity)
	{
		// a wall that turns enters the velocities through levers too
		const bool isPlain = m.x == m.y && (m.w != 0 || freeVelocity.w == 0);
		return (m.isFixed() ? 0 : moves) | (m.w != 0 ? turns : 0) | (isPlain ? plain : 0);
	}

	/// Whether the short formulas of the blocks hold: no rows coupled but T and Γ, no bias but the normal one.
	bool isSimple(const Contact& c, std::uint8_t i, std::uint8_t j)
	{
		return (i & j & plain) && c.biasT == 0 && c.biasR == 0 && (!(i & turns) || c.leverNi == 0) && (!(j & turns) || c.leverNj == 0);
	}

	/// A block that is still being filled.
	struct Open {
		std::size_t  block;
		int          filled = 0;
		std::int32_t bodies[2 * lanes];
	};

	/// Fills blocks in the order of the contacts, which is one of colours: whole colours give full blocks, their rests share some.
	void fill(const Problem& problem, const SweepOrder& order, const std::vector<std::uint8_t>& traits, std::size_t strip, bool blocks, ContactBlocks::Strip& result)
	{
		constexpr std::size_t mostOpen = 16;
		result.contactOf.clear();
		result.others.clear();
		std::vector<Open>     open;
		open.reserve(mostOpen);
		for (std::size_t k = order.stripBegin[strip]; k < order.stripBegin[strip + 1]; ++k) {
			const std::int32_t index = order.order[k];
			const Contact&     c     = problem.contacts[index];
			const std::uint8_t ti = traits[c.i], tj = traits[c.j];
			if (!blocks || !isSimple(c, ti, tj)) {
				result.others.push_back(index);
				continue;
			}
			const std::int32_t i = ti & moves ? c.i : ContactBlocks::none, j = tj & moves ? c.j : ContactBlocks::none;
			const auto         fits = [&](const Open& o) {
				for (int b = 0; b < 2 * o.filled; ++b)
					if (o.bodies[b] != ContactBlocks::none && (o.bodies[b] == i || o.bodies[b] == j)) return false;
				return true;
			};
			std::size_t at = 0;
			while (at < open.size() && !fits(open[at]))
				++at;
			if (at == open.size()) {
				if (open.size() == mostOpen) open.erase(open.begin());
				open.push_back({ result.contactOf.size() / lanes, 0, {} });
				result.contactOf.resize(result.contactOf.size() + lanes, ContactBlocks::none);
				at = open.size() - 1;
			}
			Open& o                                     = open[at];
			result.contactOf[o.block * lanes + o.filled] = index;
			o.bodies[2 * o.filled]                      = i;
			o.bodies[2 * o.filled + 1]                  = j;
			if (++o.filled == int(lanes)) open.erase(open.begin() + at);
		}
	}

	void fillLane(Block& block, int l, const Problem& problem, std::int32_t index, const std::vector<std::int32_t>& placeOf)
	{
		const Contact&     c  = problem.contacts[index];
		const InverseMass &mi = problem.inverseMass[c.i], &mj = problem.inverseMass[c.j];
		const Impulse      w = inverseDelassus(c, mi, mj), p = project(c, problem.impulses[index]);
		block.i[l]               = placeOf[c.i];
		block.j[l]               = placeOf[c.j];
		block.nx[l]              = c.nx;
		block.ny[l]              = c.ny;
		block.leverTi[l]         = c.leverTi;
		block.leverTj[l]         = c.leverTj;
		block.inverseInertiaI[l] = mi.w;
		block.inverseInertiaJ[l] = mj.w;
		block.biasN[l]           = c.biasN;
		block.adhesion[l]        = c.adhesion;
		block.friction[l]        = c.friction;
		block.rollingArm[l]      = c.rollingArm;
		block.inverseN[l]        = w.n;
		block.inverseT[l]        = w.t;
		block.inverseR[l]        = w.r;
		block.n[l] = block.beforeN[l] = p.n;
		block.t[l] = block.beforeT[l] = p.t;
		block.r[l] = block.beforeR[l] = p.r;
		block.movesI |= (mi.isFixed() ? 0u : 1u) << l;
		block.movesJ |= (mj.isFixed() ? 0u : 1u) << l;
	}

} // namespace

void layOut(const Problem& problem, int threads, ContactBlocks& result, bool blocks)
{
	const SweepOrder& order = result.order;
	arrange(problem, result.order);
	const std::size_t strips = order.stripCount();
	const auto        nobody = static_cast<std::int32_t>(problem.bodyCount());
	auto&             parts  = result.scratch;
	parts.resize(strips);
	auto& traits = result.traits;
	traits.resize(problem.bodyCount());
	for (std::size_t b = 0; b < problem.bodyCount(); ++b)
		traits[b] = traitsOf(problem.inverseMass[b], problem.freeVelocity[b]);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
	for (long s = 0; s < static_cast<long>(strips); ++s)
		fill(problem, order, traits, s, blocks, parts[s]);

	result.placeOf.resize(problem.bodyCount());
	for (std::size_t k = 0; k < order.bodies.size(); ++k)
		result.placeOf[order.bodies[k]] = static_cast<std::int32_t>(k);
	result.blockBegin.assign(1, 0);
	result.otherBegin.assign(1, 0);
	for (const ContactBlocks::Strip& part : parts) {
		result.blockBegin.push_back(result.blockBegin.back() + part.contactOf.size() / lanes);
		result.otherBegin.push_back(result.otherBegin.back() + part.others.size());
	}
	result.blocks.resize(result.blockBegin.back());
	result.contactOf.resize(result.blocks.size() * lanes);
	result.inverseLength.assign(result.blocks.size(), InverseLength {});
	result.others.resize(result.otherBegin.back());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
	for (long s = 0; s < static_cast<long>(strips); ++s) {
		const ContactBlocks::Strip& part = parts[s];
		std::copy(part.others.begin(), part.others.end(), result.others.begin() + result.otherBegin[s]);
		std::copy(part.contactOf.begin(), part.contactOf.end(), result.contactOf.begin() + result.blockBegin[s] * lanes);
		for (std::size_t b = result.blockBegin[s]; b < result.blockBegin[s + 1]; ++b) {
			Block& block = result.blocks[b]; // written where it stays
			block        = Block {};
			for (int l = 0; l < int(lanes); ++l) {
				const std::int32_t index = result.contactOf[b * lanes + l];
				block.i[l] = block.j[l] = nobody;
				if (index == ContactBlocks::none) continue;
				fillLane(block, l, problem, index, result.placeOf);
				result.inverseLength[b].v[l] = 1 / problem.contacts[index].length;
			}
		}
	}
}

} // namespace nonsmooth::contact
