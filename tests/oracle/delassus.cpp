#include "delassus.hpp"
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace nonsmooth::oracle {

namespace {

	using Block = std::array<double, mostRows * mostRows>; // column by column
	using Row   = std::map<std::size_t, Block>;

	/// Rows of blocks of H M⁻¹ Hᵀ.
	std::vector<Row> product(const System& s)
	{
		std::vector<std::vector<std::pair<std::size_t, const Jacobian*>>> at(s.bodies.size());
		for (std::size_t k = 0; k < s.contacts.size(); ++k) {
			at[s.contacts[k].i].emplace_back(k, &s.contacts[k].ofI);
			at[s.contacts[k].j].emplace_back(k, &s.contacts[k].ofJ);
		}
		std::vector<Row> rows(s.contacts.size());
		for (std::size_t b = 0; b < at.size(); ++b) {
			if (s.bodies[b].fixed) continue; // a wall couples nothing, however many contacts it has
			for (const auto& [k, left] : at[b])
				for (const auto& [l, right] : at[b]) {
					Block& block = rows[k].emplace(l, Block {}).first->second;
					for (int column = 0; column < s.size; ++column)
						for (int row = 0; row < s.size; ++row)
							for (int d = 0; d < s.motions; ++d)
								for (int e = 0; e < s.motions; ++e)
									block[column * s.size + row] += (*left)[row][d]
									        * s.bodies[b].inverseMass[d][e]
									        * (*right)[column][e];
				}
		}
		return rows;
	}

	/// H v + b, row by row.
	RowValues biasedVelocity(const System& s, const System::Contact& c)
	{
		const Motion &vi = s.bodies[c.i].freeVelocity, &vj = s.bodies[c.j].freeVelocity;
		RowValues     u = c.bias;
		for (int row = 0; row < s.size; ++row)
			for (int d = 0; d < s.motions; ++d)
				u[row] += c.ofI[row][d] * vi[d] + c.ofJ[row][d] * vj[d];
		return u;
	}

	/// D² of each row's vector: one over the mean of its rows' diagonal; 0 where no motion reaches any of them.
	RowValues squaredScales(const System& s, const Block& own)
	{
		RowValues sum {}, count {}, found {};
		for (int row = 0; row < s.size; ++row) {
			sum[s.part[row]] += own[row * s.size + row];
			count[s.part[row]] += 1;
		}
		for (int row = 0; row < s.size; ++row)
			found[row] = sum[s.part[row]] > 0 ? count[s.part[row]] / sum[s.part[row]] : 0;
		return found;
	}

} // namespace

Delassus delassus(const System& s)
{
	Delassus w;
	w.dimension            = s.dimension;
	const int         size = w.size = s.size;
	const std::size_t count         = s.contacts.size();
	auto              rows          = product(s);

	// D; a row that no motion reaches gets the diagonal 1 and nothing to do, so that its impulse is 0
	w.scale.resize(count * size);
	w.q.resize(count * size);
	std::vector<char> idle(count * size, 0);
	for (std::size_t k = 0; k < count; ++k) {
		Block&          own    = rows[k][k];
		const RowValues square = squaredScales(s, own), u = biasedVelocity(s, s.contacts[k]);
		for (int row = 0; row < size; ++row) {
			double&      entry = own[row * size + row];
			const double d     = square[row] > 0 ? std::sqrt(square[row]) : 1;
			const bool   still = !(
                                entry * square[row] > 1e-12); // beside the others of its vector, to rounding
			if (still && square[row] > 0 && u[row] != 0)
				throw std::invalid_argument(
				        "contact " + std::to_string(k)
				        + " is driven along a direction in which no impulse moves it: Siconos cannot be asked");
			if (still) entry = 1 / (d * d);
			w.scale[k * size + row] = d;
			w.q[k * size + row]     = still ? 0 : d * u[row];
			idle[k * size + row]    = still;
		}
	}

	w.begin.push_back(0);
	for (std::size_t k = 0; k < count; ++k) {
		for (auto& [l, block] : rows[k]) {
			for (int row = 0; row < size; ++row)
				w.q[k * size + row] -= w.scale[k * size + row] * (idle[k * size + row] ? 0 : block[row])
				        * s.contacts[l].adhesion;
			for (int column = 0; column < size; ++column)
				for (int row = 0; row < size; ++row)
					w.blocks.push_back(
					        block[column * size + row] * w.scale[k * size + row]
					        * w.scale[l * size + column]);
			w.column.push_back(l);
		}
		w.begin.push_back(w.column.size());
		const double normal = w.scale[k * size];
		w.friction.push_back(s.contacts[k].friction * normal / w.scale[k * size + 1]);
		w.rolling.push_back(w.rolls() ? s.contacts[k].rolling * normal / w.scale[k * size + s.dimension] : 0);
	}

	double sum = 0;
	for (const double value : w.q)
		sum += value * value;
	if (sum > 0) w.speed = std::sqrt(sum / double(w.q.size()));
	for (double& value : w.q)
		value /= w.speed;
	return w;
}

std::vector<RowValues> Delassus::impulses(const System& system, const std::vector<double>& p) const
{
	std::vector<RowValues> found(contactCount());
	for (std::size_t k = 0; k < found.size(); ++k) {
		for (int row = 0; row < size; ++row)
			found[k][row] = p[k * size + row] * scale[k * size + row] * speed;
		found[k][0] -= system.contacts[k].adhesion;
	}
	return found;
}

std::vector<double> Delassus::scaled(const System& system, const std::vector<RowValues>& impulses) const
{
	std::vector<double> p(scale.size());
	for (std::size_t k = 0; k < impulses.size(); ++k)
		for (int row = 0; row < size; ++row) {
			const double shift = row == 0 ? system.contacts[k].adhesion : 0;
			p[k * size + row]  = (impulses[k][row] + shift) / (scale[k * size + row] * speed);
		}
	return p;
}

} // namespace nonsmooth::oracle
