#include <algorithm>
#include <contact/contact_blocks.hpp>
#include <contact/law.hpp>
#include <contact/sweep_order.hpp>

namespace nonsmooth::contact {
namespace {

	/// What the short formulas of the blocks ask of a body.
	enum BodyTrait : std::uint8_t { turns = 1, plain = 2 };

	std::uint8_t traitsOf(const InverseMass& m, const Twist& freeVelocity)
	{
		// a wall that turns enters the velocities through levers too
		const bool isPlain = m.x == m.y && (m.w != 0 || freeVelocity.w == 0);
		return (m.w != 0 ? turns : 0) | (isPlain ? plain : 0);
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
	void fill(const SweepOrder& order, const std::vector<std::uint8_t>& simple, std::size_t part, ContactBlocks::Part& result)
	{
		constexpr std::size_t mostOpen = 16;
		result.contactOf.clear();
		result.others.clear();
		std::vector<Open>     open;
		open.reserve(mostOpen);
		for (std::size_t k = order.partBegin[part]; k < order.partBegin[part + 1]; ++k) {
			const std::int32_t index = order.order[k];
			if (!simple[index]) {
				result.others.push_back(index);
				continue;
			}
			const auto [i, j] = order.pairs[index];
			const auto fits   = [&, i = i, j = j](const Open& o) {
				for (int b = 0; b < 2 * o.filled; ++b)
					if (o.bodies[b] != MovablePair::none && (o.bodies[b] == i || o.bodies[b] == j)) return false;
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

	/// Asks for a contact, which lies across two or three cache lines, and its impulses.
	void fetch(const Problem& problem, std::int32_t index)
	{
		if (index == ContactBlocks::none) return;
		const char* const contact = reinterpret_cast<const char*>(&problem.contacts[index]);
		__builtin_prefetch(contact);
		__builtin_prefetch(contact + sizeof(Contact) / 2);
		__builtin_prefetch(contact + sizeof(Contact) - 1);
		__builtin_prefetch(&problem.impulses[index]);
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

	/// Whether two blocks may be visited at once, see Block::withNext.
	bool goTogether(const Block& a, const Block& b)
	{
		constexpr unsigned all = (1u << lanes) - 1;
		if ((a.movesI & a.movesJ & b.movesI & b.movesJ) != all) return false;
		using Ids = std::int32_t __attribute__((vector_size(16)));
		const auto idsOf = [](const std::int32_t* id) { return Ids { id[0], id[1], id[2], id[3] }; };
		const Ids  i = idsOf(a.i), j = idsOf(a.j);
		Ids        shared {};
		for (std::size_t l = 0; l < lanes; ++l)
			shared |= (i == b.i[l]) | (j == b.i[l]) | (i == b.j[l]) | (j == b.j[l]);
		return !(shared[0] | shared[1] | shared[2] | shared[3]);
	}

	/// Marks neighbours that may be visited at once, from the first on.
	void markTogether(Block* blocks, std::size_t count)
	{
		for (std::size_t k = 0; k + 1 < count; ++k)
			if ((blocks[k].withNext = goTogether(blocks[k], blocks[k + 1]))) ++k;
	}

} // namespace

void layOut(const Problem& problem, int threads, ContactBlocks& result, bool blocks)
{
	const SweepOrder& order = result.order;
	arrange(problem, threads, result.order);
	const std::size_t partCount = order.partCount();
	const auto        nobody = static_cast<std::int32_t>(problem.bodyCount());
	const long        bodyCount = static_cast<long>(problem.bodyCount()), contactCount = static_cast<long>(problem.contactCount());
	auto&             parts  = result.scratch;
	parts.resize(partCount);
	result.traits.resize(problem.bodyCount());
	result.simple.resize(problem.contactCount());
	result.placeOf.resize(problem.bodyCount());
#pragma omp parallel num_threads(threads)
	{
#pragma omp for schedule(static)
		for (long b = 0; b < bodyCount; ++b) {
			result.traits[b]                = traitsOf(problem.inverseMass[b], problem.freeVelocity[b]);
			result.placeOf[order.bodies[b]] = static_cast<std::int32_t>(b);
		}
#pragma omp for schedule(static)
		for (long k = 0; k < contactCount; ++k) {
			const Contact& c = problem.contacts[k];
			result.simple[k] = blocks && isSimple(c, result.traits[c.i], result.traits[c.j]);
		}
#pragma omp for schedule(dynamic, 1)
		for (long s = 0; s < static_cast<long>(partCount); ++s)
			fill(order, result.simple, s, parts[s]);
	}

	result.blockBegin.assign(1, 0);
	result.otherBegin.assign(1, 0);
	for (const ContactBlocks::Part& part : parts) {
		result.blockBegin.push_back(result.blockBegin.back() + part.contactOf.size() / lanes);
		result.otherBegin.push_back(result.otherBegin.back() + part.others.size());
	}
	result.blocks.resize(result.blockBegin.back());
	result.contactOf.resize(result.blocks.size() * lanes);
	result.inverseLength.resize(result.blocks.size());
	result.others.resize(result.otherBegin.back());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
	for (long s = 0; s < static_cast<long>(partCount); ++s) {
		const ContactBlocks::Part& part = parts[s];
		std::copy(part.others.begin(), part.others.end(), result.others.begin() + result.otherBegin[s]);
		std::copy(part.contactOf.begin(), part.contactOf.end(), result.contactOf.begin() + result.blockBegin[s] * lanes);
		for (std::size_t b = result.blockBegin[s]; b < result.blockBegin[s + 1]; ++b) {
			Block& block = result.blocks[b]; // written where it stays
			block        = Block {};
			result.inverseLength[b] = InverseLength {};
			for (int l = 0; l < int(lanes); ++l) {
				const std::int32_t index = result.contactOf[b * lanes + l];
				// contacts lie in the order of their finding, so no processor guesses which one is next
				constexpr std::size_t ahead = 4 * lanes;
				if (b * lanes + l + ahead < result.blockBegin[s + 1] * lanes) fetch(problem, result.contactOf[b * lanes + l + ahead]);
				block.i[l] = block.j[l] = nobody;
				if (index == ContactBlocks::none) continue;
				fillLane(block, l, problem, index, result.placeOf);
				result.inverseLength[b].v[l] = 1 / problem.contacts[index].length;
			}
		}
		markTogether(result.blocks.data() + result.blockBegin[s], result.blockBegin[s + 1] - result.blockBegin[s]);
	}
}

} // namespace nonsmooth::contact
