#include <contact/colouring.hpp>

namespace nonsmooth::contact {

Colouring colour(const std::vector<Contact>& contacts, const std::vector<InverseMass>& inverseMass)
{
	constexpr int              most = 64;
	std::vector<std::uint64_t> used(inverseMass.size(), 0);
	std::vector<std::uint8_t>  colourOf(contacts.size());
	std::vector<std::size_t>   size(most + 1, 0);

	for (std::size_t k = 0; k < contacts.size(); ++k) {
		const Contact& c     = contacts[k];
		const bool     moveI = !inverseMass[c.i].isFixed(), moveJ = !inverseMass[c.j].isFixed();
		const auto     taken = (moveI ? used[c.i] : 0) | (moveJ ? used[c.j] : 0);
		int            best  = most;
		if (~taken != 0) {
			best           = __builtin_ctzll(~taken);
			const auto bit = std::uint64_t(1) << best;
			if (moveI) used[c.i] |= bit;
			if (moveJ) used[c.j] |= bit;
		}
		colourOf[k] = static_cast<std::uint8_t>(best);
		++size[best];
	}

	Colouring                result;
	std::vector<std::size_t> next(most + 1, 0);
	std::size_t              total = 0;
	for (int k = 0; k <= most; ++k) {
		next[k] = total;
		if (size[k] == 0) continue;
		result.begin.push_back(total);
		result.parallel.push_back(k < most);
		total += size[k];
	}
	result.begin.push_back(total);
	result.order.resize(contacts.size());
	for (std::size_t k = 0; k < contacts.size(); ++k)
		result.order[next[colourOf[k]]++] = static_cast<std::int32_t>(k);
	return result;
}

} // namespace nonsmooth::contact
