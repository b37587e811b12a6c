// Impacts that follow from impacts in a step: who may meet, and what the step's solve, positions and balance have of
// them. The rule and its equations stand in contact/plane/impact_sequence.hpp and doc/theory/stepping.rst.
#include "ContactSeam.hpp"
#include <contact/plane/disk_contact.hpp>

namespace yade::nscd {

namespace contact = nonsmooth::contact;
using contact::Contact;
using contact::Impulse;
using contact::Twist;

/// All contacts of the step, those left out of the solve too, in the order of ids.
void ContactSeam::expectImpacts(std::vector<contact::ImpactPair>& pairs)
{
	const auto key      = [](const Contact& c) { return std::pair(std::min(c.i, c.j), std::max(c.i, c.j)); };
	const auto isPushed = [this](int body) {
		const Twist &free = problem.freeVelocity[body], &now = before[body];
		return free.x != now.x || free.y != now.y || free.w != now.w;
	};
	pairs.reserve(links.size() + leftLinks.size());
	for (size_t in = 0, left = 0; in < links.size() || left < leftLinks.size();) {
		const bool isIn = left == leftLinks.size()
		        || (in < links.size() && key(problem.contacts[in]) < key(leftContacts[left]));
		const Contact&      c    = isIn ? problem.contacts[in] : leftContacts[left];
		Link&               link = isIn ? links[in++] : leftLinks[left++];
		const ContactState& r    = stateOf(link);
		link.impacts             = (int)pairs.size();
		// what forces push together, or let fall onto another, is the solve's, which finds all of it at once
		const bool pushed = isPushed(c.i) || isPushed(c.j);
		pairs.push_back({ &c, r.gap, r.bounces ? r.restitution : 0, radius[c.i] > 0 && radius[c.j] > 0,
		                  r.bonded || r.adhesion > 0 || r.residualAdhesion > 0 || pushed });
	}
}

int ContactSeam::followImpacts(int most)
{
	if (!meets || most == 0) return 0;
	std::vector<contact::ImpactPair> pairs;
	expectImpacts(pairs);
	const int count = sequence.follow({ problem, radius, before, relaxation.step, most }, pairs);
	followed        = count > 0;
	if (!followed) return 0;
	begun = before;
	for (size_t id = 0; id < before.size(); ++id) {
		if (!sequence.flights[id].struck) continue;
		const Twist &v0 = begun[id], &v1 = before[id] = sequence.flights[id].velocity;
		Twist&       v = problem.freeVelocity[id];
		v              = { v.x + (v1.x - v0.x), v.y + (v1.y - v0.y), v.w + (v1.w - v0.w) };
	}
	for (size_t k = 0; k < links.size(); ++k)
		setBiasAfterImpacts(problem.contacts[k], links[k]);
	std::vector<size_t> taken;
	for (size_t k = 0; k < leftLinks.size(); ++k) {
		setBiasAfterImpacts(leftContacts[k], leftLinks[k]);
		if (impactsAt(leftLinks[k])) taken.push_back(k);
	}
	if (!taken.empty()) takeIn(taken);
	return count;
}

/// As gatherContact has it, from the velocities and places that impacts leave. What would close has been left by the
/// sequence.
void ContactSeam::setBiasAfterImpacts(Contact& c, const Link& link) const
{
	constexpr Real touch  = 1e-9; // ℓ, as in the sequence: what meets just at the step's end is the next one's
	const ContactState& r = stateOf(link);
	const bool          plays = c.play > 0; // a bond that closes freely
	if ((r.bonded && !plays) || !(sequence.flights[c.i].struck || sequence.flights[c.j].struck)) return;
	const Real gap = gapOf(c, r), h = relaxation.step;
	if (plays) {
		contact::plane::setPlay(c, r.restGap, gap, h);
		if (r.curved) bend(r, c);
		return;
	}
	const Real approach = contact::relativeVelocity(c, before[c.i], before[c.j]).n;
	// What parts may come back as fast as it went, and no faster: it then takes no energy from what throws it back,
	// and gives none. Places are put right by displacements.
	c.biasN = std::max({ Real(0), (gap - std::min(r.gap, Real(0))) / h, approach });
	if (r.bounces && approach < 0 && gap + h * approach < -touch * c.length) c.biasN = r.restitution * approach;
	if (r.curved) bend(r, c);
}

Real ContactSeam::gapAfterImpacts(const Contact& c, const ContactState& state) const
{
	const auto &i = sequence.flights[c.i], &j = sequence.flights[c.j];
	if (!i.struck && !j.struck) return state.bounces ? gapInPassing(c, state) : state.gap;
	if (radius[c.i] < 0 || radius[c.j] < 0) return state.gap + contact::relativeVelocity(c, i.shift, j.shift).n;
	// exact at the end of the step, though the two have passed each other
	return gapAtEnd(c, i.shift, j.shift) - relaxation.step * contact::relativeVelocity(c, i.velocity, j.velocity).n;
}

Real ContactSeam::gapAtEnd(const Contact& c, const Twist& shiftI, const Twist& shiftJ) const
{
	const auto at = [this](int id, const Twist& shift) {
		const auto&  x = problem.positions[id];
		const Twist& v = before[id];
		return contact::Point { x.x + shift.x + relaxation.step * v.x, x.y + shift.y + relaxation.step * v.y };
	};
	return contact::plane::diskContact(at(c.i, shiftI), at(c.j, shiftJ), radius[c.i], radius[c.j]).gap;
}

/// Impulses of a contact in the whole step: of impacts that were followed, and of the solve.
Impulse ContactSeam::impulseOfStep(size_t k) const
{
	Impulse p = problem.impulses[k];
	if (const auto* impacts = impactsAt(links[k])) {
		p.n += impacts->impulse.n;
		p.t += impacts->impulse.t;
		p.r += impacts->impulse.r;
	}
	return p;
}

/// What impacts add to the balance at one body.
void ContactSeam::sumImpacts(size_t id, const Vector3r& gravity, StepSums& sums) const
{
	const auto&  f = sequence.flights[id];
	const auto&  w = problem.inverseMass[id];
	const Twist& v = f.velocity;
	const auto&  p = f.impulse;
	sums.wallWork -= (w.x > 0 ? 0 : p.x * v.x) + (w.y > 0 ? 0 : p.y * v.y) + (w.w > 0 ? 0 : p.w * v.w);
	if (!f.struck) return;
	const Real m = mass[id];
	sums.correction -= m * gravity.dot(Vector3r(f.shift.x, f.shift.y, 0));
	// gravity works on the mean velocity of the whole step, as where the solve finds the impact
	sums.impact -= 0.5 * relaxation.step * m * gravity.dot(Vector3r(v.x - begun[id].x, v.y - begun[id].y, 0));
}

} // namespace yade::nscd
