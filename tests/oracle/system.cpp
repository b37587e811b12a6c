#include "system.hpp"
#include <cmath>
#include <stdexcept>
#include <string>

namespace nonsmooth::oracle {

namespace {

	/// What both dimensions ask of a contact; its bodies, strengths and the bias of its normal.
	template <class Problem> System::Contact contactOf(const Problem& problem, std::size_t k)
	{
		const auto& c = problem.contacts[k];
		for (const std::int32_t body : { c.i, c.j })
			if (body < 0 || std::size_t(body) >= problem.bodyCount())
				throw std::invalid_argument(
				        "contact " + std::to_string(k) + " names body " + std::to_string(body)
				        + ", which is not there");
		if (c.play > 0) // Siconos has no bonds that close freely
			throw std::invalid_argument(
			        "contact " + std::to_string(k) + " has play, which Siconos does not know");
		System::Contact found;
		found.i        = c.i;
		found.j        = c.j;
		found.bias[0]  = c.biasN;
		found.adhesion = c.adhesion;
		found.friction = c.friction;
		found.rolling  = c.rollingArm;
		return found;
	}

	using contact::space::Vector;

	/// Two directions across a normal, on the side of the axis that it is farthest from.
	std::array<Vector, 2> tangents(const Vector& n)
	{
		const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
		const Vector axis  = x <= y && x <= z ? Vector { 1, 0, 0 }
		         : y <= z                     ? Vector { 0, 1, 0 }
		                                      : Vector { 0, 0, 1 };
		const Vector along = cross(n, axis);
		const Vector t     = 1 / std::sqrt(dot(along, along)) * along;
		return { t, cross(n, t) };
	}

	/// The row of a component along `way` of v + ω × arm, or of ω alone; times `sign`.
	Motion pointRow(const Vector& way, const Vector& arm, double sign)
	{
		const Vector turn = cross(arm, way); // way·(ω × arm) = ω·(arm × way)
		return { sign * way.x, sign * way.y, sign * way.z, sign * turn.x, sign * turn.y, sign * turn.z };
	}
	Motion turnRow(const Vector& way, double sign) { return { 0, 0, 0, sign * way.x, sign * way.y, sign * way.z }; }

} // namespace

System systemOf(const contact::Problem& problem, bool withRolling)
{
	System s;
	s.dimension = 2;
	s.motions   = 3;
	s.size      = withRolling ? 3 : 2;
	s.part      = { 0, 1, 2 };
	for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
		const auto&  m = problem.inverseMass[b];
		const auto&  v = problem.freeVelocity[b];
		System::Body body;
		body.fixed             = m.isFixed();
		body.inverseMass[0][0] = m.x;
		body.inverseMass[1][1] = m.y;
		body.inverseMass[2][2] = m.w;
		body.freeVelocity      = { v.x, v.y, v.w };
		s.bodies.push_back(body);
	}
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const auto&     c     = problem.contacts[k];
		System::Contact found = contactOf(problem, k);
		found.bias            = { c.biasN, c.biasT, c.biasR };
		found.ofI             = { { { -c.nx, -c.ny, -c.leverNi }, { c.ny, -c.nx, -c.leverTi }, { 0, 0, -1 } } };
		found.ofJ             = { { { c.nx, c.ny, c.leverNj }, { -c.ny, c.nx, c.leverTj }, { 0, 0, 1 } } };
		s.contacts.push_back(found);
	}
	return s;
}

System systemOf(const contact::space::Problem& problem, bool withRolling)
{
	System s;
	s.dimension = 3;
	s.motions   = 6;
	s.size      = withRolling ? 5 : 3;
	s.part      = { 0, 1, 1, 2, 2 };
	for (std::size_t b = 0; b < problem.bodyCount(); ++b) {
		const auto&  m = problem.inverseMass[b];
		const auto&  v = problem.freeVelocity[b];
		const auto&  t = m.inertia;
		System::Body body;
		body.fixed             = m.isFixed();
		body.inverseMass[0][0] = m.x;
		body.inverseMass[1][1] = m.y;
		body.inverseMass[2][2] = m.z;
		body.inverseMass[3]    = { 0, 0, 0, t.xx, t.xy, t.zx };
		body.inverseMass[4]    = { 0, 0, 0, t.xy, t.yy, t.yz };
		body.inverseMass[5]    = { 0, 0, 0, t.zx, t.yz, t.zz };
		body.freeVelocity      = { v.v.x, v.v.y, v.v.z, v.w.x, v.w.y, v.w.z };
		s.bodies.push_back(body);
	}
	for (std::size_t k = 0; k < problem.contactCount(); ++k) {
		const auto&     c     = problem.contacts[k];
		System::Contact found = contactOf(problem, k);
		if (c.twistingArm > 0)
			throw std::invalid_argument(
			        "contact " + std::to_string(k) + " resists twisting, which Siconos does not know");
		const auto [t1, t2] = tangents(c.n);
		const Vector armI = c.leverI * c.n + c.asideI, armJ = c.leverJ * c.n + c.asideJ;
		const Vector way[] = { c.n, t1, t2 };
		found.bias = { c.biasN, dot(t1, c.biasT), dot(t2, c.biasT), dot(t1, c.biasW), dot(t2, c.biasW) };
		for (int row = 0; row < mostRows; ++row) {
			found.ofI[row] = row < 3 ? pointRow(way[row], armI, -1) : turnRow(way[row - 2], -1);
			found.ofJ[row] = row < 3 ? pointRow(way[row], armJ, 1) : turnRow(way[row - 2], 1);
		}
		s.contacts.push_back(found);
	}
	return s;
}

std::vector<Motion> System::velocities(const std::vector<RowValues>& impulses) const
{
	std::vector<Motion> v;
	for (const Body& body : bodies)
		v.push_back(body.freeVelocity);
	const auto push = [&](std::int32_t b, const Jacobian& rows, const RowValues& p) {
		for (int d = 0; d < motions; ++d)
			for (int e = 0; e < motions; ++e)
				for (int row = 0; row < size; ++row)
					v[b][d] += bodies[b].inverseMass[d][e] * rows[row][e] * p[row];
	};
	for (std::size_t k = 0; k < impulses.size(); ++k) {
		push(contacts[k].i, contacts[k].ofI, impulses[k]);
		push(contacts[k].j, contacts[k].ofJ, impulses[k]);
	}
	return v;
}

std::vector<RowValues> impulsesOf(const contact::Problem& problem)
{
	std::vector<RowValues> rows;
	for (const auto& p : problem.impulses)
		rows.push_back({ p.n, p.t, p.r });
	return rows;
}

std::vector<RowValues> impulsesOf(const contact::space::Problem& problem)
{
	std::vector<RowValues> rows;
	for (std::size_t k = 0; k < problem.impulses.size(); ++k) {
		const auto& p       = problem.impulses[k];
		const auto& n       = problem.contacts[k].n;
		const auto [t1, t2] = tangents(n);
		rows.push_back({ dot(n, p.f), dot(t1, p.f), dot(t2, p.f), dot(t1, p.m), dot(t2, p.m) });
	}
	return rows;
}

void takeImpulses(contact::Problem& problem, const System& system, const std::vector<RowValues>& impulses)
{
	problem.impulses.clear();
	for (const RowValues& p : impulses)
		problem.impulses.push_back({ p[0], p[1], p[2] });
	problem.velocities.clear();
	for (const Motion& v : system.velocities(impulses))
		problem.velocities.push_back({ v[0], v[1], v[2] });
}

void takeImpulses(contact::space::Problem& problem, const System& system, const std::vector<RowValues>& impulses)
{
	problem.impulses.clear();
	for (std::size_t k = 0; k < impulses.size(); ++k) {
		const RowValues& p  = impulses[k];
		const auto&      n  = problem.contacts[k].n;
		const auto [t1, t2] = tangents(n);
		problem.impulses.push_back({ p[0] * n + p[1] * t1 + p[2] * t2, p[3] * t1 + p[4] * t2 });
	}
	problem.velocities.clear();
	for (const Motion& v : system.velocities(impulses))
		problem.velocities.push_back({ { v[0], v[1], v[2] }, { v[3], v[4], v[5] } });
}

} // namespace nonsmooth::oracle
