#include "delassus.hpp"
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace nonsmooth::oracle {

using contact::Contact;
using contact::Impulse;
using contact::InverseMass;
using contact::Problem;
using contact::Twist;

namespace {

	/// What the motion (v_x, v_y, ω) of one body adds to (U_n, U_t, w) of a contact.
	using Rows = std::array<std::array<double, 3>, 3>;

	Rows rowsOfI(const Contact& c)
	{
		return { { { -c.nx, -c.ny, -c.leverNi }, { c.ny, -c.nx, -c.leverTi }, { 0, 0, -1 } } };
	}
	Rows rowsOfJ(const Contact& c)
	{
		return { { { c.nx, c.ny, c.leverNj }, { -c.ny, c.nx, c.leverTj }, { 0, 0, 1 } } };
	}

	std::array<double, 3> diagonal(const InverseMass& m) { return { m.x, m.y, m.w }; }

	/// Contacts at each body, with the rows that the body has in them.
	std::vector<std::vector<std::pair<std::size_t, Rows>>> contactsAtBodies(const Problem& problem)
	{
		std::vector<std::vector<std::pair<std::size_t, Rows>>> at(problem.bodyCount());
		for (std::size_t k = 0; k < problem.contactCount(); ++k) {
			const Contact& c = problem.contacts[k];
			for (const std::int32_t body : { c.i, c.j })
				if (body < 0 || std::size_t(body) >= problem.bodyCount())
					throw std::invalid_argument(
					        "contact " + std::to_string(k) + " names body " + std::to_string(body)
					        + ", which is not there");
			at[c.i].emplace_back(k, rowsOfI(c));
			at[c.j].emplace_back(k, rowsOfJ(c));
		}
		return at;
	}

	using Block = std::array<double, 9>; // column by column
	using Row   = std::map<std::size_t, Block>;

	/// Rows of blocks of H M⁻¹ Hᵀ.
	std::vector<Row> product(const Problem& problem, int size)
	{
		std::vector<Row> rows(problem.contactCount());
		const auto       at = contactsAtBodies(problem);
		for (std::size_t b = 0; b < at.size(); ++b) {
			const auto inverse = diagonal(problem.inverseMass[b]);
			if (problem.inverseMass[b].isFixed())
				continue; // a wall couples nothing, however many contacts it has
			for (const auto& [k, left] : at[b])
				for (const auto& [l, right] : at[b]) {
					Block& block = rows[k].emplace(l, Block {}).first->second;
					for (int column = 0; column < size; ++column)
						for (int row = 0; row < size; ++row)
							for (int d = 0; d < 3; ++d)
								block[column * size + row] += left[row][d] * inverse[d]
								        * right[column][d];
				}
		}
		return rows;
	}

	/// H v + b, row by row.
	std::array<double, 3> biasedVelocity(const Contact& c, const std::vector<Twist>& v)
	{
		const Rows                  i = rowsOfI(c), j = rowsOfJ(c);
		const std::array<double, 3> vi { v[c.i].x, v[c.i].y, v[c.i].w }, vj { v[c.j].x, v[c.j].y, v[c.j].w };
		std::array<double, 3>       u { c.biasN, c.biasT, c.biasR };
		for (int row = 0; row < 3; ++row)
			for (int d = 0; d < 3; ++d)
				u[row] += i[row][d] * vi[d] + j[row][d] * vj[d];
		return u;
	}

} // namespace

Delassus delassus(const Problem& problem, bool withRolling)
{
	Delassus          w;
	const int         size = w.size = withRolling ? 3 : 2;
	const std::size_t count         = problem.contactCount();
	auto              rows          = product(problem, size);

	// D; a row that no motion reaches gets the diagonal 1 and nothing to do, so that its impulse is 0
	w.scale.resize(count * size);
	std::vector<char> idle(count * size, 0);
	for (std::size_t k = 0; k < count; ++k) {
		Block& own = rows[k][k];
		for (int row = 0; row < size; ++row) {
			double& entry           = own[row * size + row];
			idle[k * size + row]    = !(entry > 0);
			w.scale[k * size + row] = entry > 0 ? 1 / std::sqrt(entry) : 1;
			if (!(entry > 0)) entry = 1;
		}
	}

	w.q.resize(count * size);
	w.begin.push_back(0);
	for (std::size_t k = 0; k < count; ++k) {
		const Contact& c = problem.contacts[k];
		const auto     u = biasedVelocity(c, problem.freeVelocity);
		for (int row = 0; row < size; ++row)
			w.q[k * size + row] = idle[k * size + row] ? 0 : w.scale[k * size + row] * u[row];
		for (auto& [l, block] : rows[k]) {
			for (int row = 0; row < size; ++row)
				w.q[k * size + row] -= w.scale[k * size + row] * (idle[k * size + row] ? 0 : block[row])
				        * problem.contacts[l].adhesion;
			for (int column = 0; column < size; ++column)
				for (int row = 0; row < size; ++row)
					w.blocks.push_back(
					        block[column * size + row] * w.scale[k * size + row]
					        * w.scale[l * size + column]);
			w.column.push_back(l);
		}
		w.begin.push_back(w.column.size());
		w.friction.push_back(c.friction * w.scale[k * size] / w.scale[k * size + 1]);
		w.rolling.push_back(withRolling ? c.rollingArm * w.scale[k * size] / w.scale[k * size + 2] : 0);
	}

	double sum = 0;
	for (const double value : w.q)
		sum += value * value;
	if (sum > 0) w.speed = std::sqrt(sum / double(w.q.size()));
	for (double& value : w.q)
		value /= w.speed;
	return w;
}

std::vector<Impulse> Delassus::impulses(const Problem& problem, const std::vector<double>& p) const
{
	std::vector<Impulse> found(contactCount());
	for (std::size_t k = 0; k < found.size(); ++k) {
		const auto row = [&](int r) { return p[k * size + r] * scale[k * size + r] * speed; };
		found[k]       = { row(0) - problem.contacts[k].adhesion, row(1), size == 3 ? row(2) : 0 };
	}
	return found;
}

std::vector<double> Delassus::scaled(const Problem& problem, const std::vector<Impulse>& impulses) const
{
	std::vector<double> p(scale.size());
	for (std::size_t k = 0; k < impulses.size(); ++k) {
		const std::array<double, 3> rows { impulses[k].n + problem.contacts[k].adhesion, impulses[k].t,
			                           impulses[k].r };
		for (int row = 0; row < size; ++row)
			p[k * size + row] = rows[row] / (scale[k * size + row] * speed);
	}
	return p;
}

std::vector<Twist> velocities(const Problem& problem, const std::vector<Impulse>& impulses)
{
	std::vector<Twist> v = problem.freeVelocity;
	for (std::size_t k = 0; k < impulses.size(); ++k) {
		const Contact&              c = problem.contacts[k];
		const std::array<double, 3> p { impulses[k].n, impulses[k].t, impulses[k].r };
		const auto                  push = [&](std::int32_t body, const Rows& rows) {
                        const auto            inverse = diagonal(problem.inverseMass[body]);
                        std::array<double, 3> change {};
                        for (int d = 0; d < 3; ++d)
                                for (int row = 0; row < 3; ++row)
                                        change[d] += inverse[d] * rows[row][d] * p[row];
                        v[body].x += change[0];
                        v[body].y += change[1];
                        v[body].w += change[2];
		};
		push(c.i, rowsOfI(c));
		push(c.j, rowsOfJ(c));
	}
	return v;
}

} // namespace nonsmooth::oracle
