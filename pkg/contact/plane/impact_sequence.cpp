#include <algorithm>
#include <cmath>
#include <contact/plane/impact_sequence.hpp>
#include <contact/plane/law.hpp>
#include <contact/plane/disk_contact.hpp>
#include <limits>

namespace nonsmooth::contact {
namespace {

	constexpr double      touch = 1e-9, least = 1e-7; // ℓ; see the header
	constexpr std::size_t largest = 64; // contacts that hang together
	constexpr double      never   = std::numeric_limits<double>::infinity();

	template <class Row> void add(Row& x, double factor, const Row& v)
	{
		x.x += factor * v.x;
		x.y += factor * v.y;
		x.w += factor * v.w;
	}

	bool has(const std::vector<int>& list, int value)
	{
		return std::find(list.begin(), list.end(), value) != list.end();
	}

} // namespace

void PairImpacts::add(const PairImpacts& other)
{
	impulse.n += other.impulse.n;
	impulse.t += other.impulse.t;
	impulse.r += other.impulse.r;
	normalLoss += other.normalLoss;
	slidingLoss += other.slidingLoss;
	rollingLoss += other.rollingLoss;
	count += other.count;
}

ImpactSequence::Stand ImpactSequence::standAt(const ImpactPair& pair, double time) const
{
	Contact c  = *pair.contact;
	c.adhesion = c.biasN = c.biasT = c.biasR = c.play = 0;
	const Flight &i = flights[c.i], &j = flights[c.j];
	if (!pair.disks) {
		if (scene->radius[c.j] > 0) c.leverTj = -scene->radius[c.j]; // on its rim, where it touches the wall
		return { c,
			 pair.gap + relativeVelocity(c, i.shift, j.shift).n
			         + time * relativeVelocity(c, i.velocity, j.velocity).n };
	}
	const auto at = [time](const Point& x, const Flight& f) {
		return Point { x.x + f.shift.x + time * f.velocity.x, x.y + f.shift.y + time * f.velocity.y };
	};
	const auto&  x  = scene->problem.positions;
	const double ri = scene->radius[c.i], rj = scene->radius[c.j];
	const auto   now = plane::diskContact(at(x[c.i], i), at(x[c.j], j), ri, rj);
	plane::setDiskFrame(c, c.i, c.j, now.nx, now.ny, ri, rj, now.gap);
	return { c, now.gap };
}

/// When a pair meets, from a time on, if both go on as they do; `never` where they do not within the step.
double ImpactSequence::meetingAfter(const ImpactPair& pair, double time) const
{
	const double h = scene->step, way = least * pair.contact->length;
	const Twist &vi = flights[pair.contact->i].velocity, &vj = flights[pair.contact->j].velocity;
	const auto [c, gap] = standAt(pair, time);
	const double u      = relativeVelocity(c, vi, vj).n;
	if (!(u < 0)) return never;
	if (gap <= touch * c.length) return -u * h > way ? time : never;
	double after = -gap / u, speed = -u;
	if (pair.disks) { // |d + τ v| = r: the smaller root, without a difference of large numbers
		const double x = vj.x - vi.x, y = vj.y - vi.y, r = scene->radius[c.i] + scene->radius[c.j];
		const double along = -u * (r + gap), wide = gap * (gap + 2 * r);
		const double root = along * along - (x * x + y * y) * wide;
		if (root < 0) return never; // they pass
		speed = std::sqrt(root) / r;
		after = wide / (along + std::sqrt(root));
	}
	return time + after <= h && speed * h > way ? time + after : never;
}

/// Whether a pair hangs together: what touches and parts does not.
bool ImpactSequence::touches(const ImpactPair& pair, double time) const
{
	const auto [c, gap] = standAt(pair, time);
	if (gap > touch * c.length) return false;
	return relativeVelocity(c, flights[c.i].velocity, flights[c.j].velocity).n * scene->step <= least * c.length;
}

/// Which pairs a body has.
void ImpactSequence::arrange()
{
	firstOf.assign(flights.size() + 1, 0);
	const auto each = [this](auto function) {
		for (std::size_t k = 0; k < pairs->size(); ++k)
			for (const int body : { (*pairs)[k].contact->i, (*pairs)[k].contact->j })
				if (moves(body)) function(body, static_cast<int>(k));
	};
	each([this](int body, int) { ++firstOf[body + 1]; });
	for (std::size_t b = 1; b < firstOf.size(); ++b)
		firstOf[b] += firstOf[b - 1];
	pairsOf.resize(firstOf.back());
	std::vector<int> next(firstOf.begin(), firstOf.end() - 1);
	each([&](int body, int pair) { pairsOf[next[body]++] = pair; });
}

/// Expects the meetings of pairs with restitution, and those of the same bodies that may come before.
void ImpactSequence::begin()
{
	for (std::size_t k = 0; k < pairs->size(); ++k)
		if ((*pairs)[k].restitution > 0) expect(static_cast<int>(k), 0);
	std::vector<char> seen(pairs->size(), 0);
	const auto        first = meetings;
	for (const Meeting& m : first)
		for (const int body : { (*pairs)[m.pair].contact->i, (*pairs)[m.pair].contact->j })
			for (int k = firstOf[body]; k < firstOf[body + 1]; ++k) {
				const int pair = pairsOf[k];
				if ((*pairs)[pair].restitution == 0 && !seen[pair]) expect(pair, 0);
				seen[pair] = 1;
			}
}

void ImpactSequence::expect(int k, double time)
{
	const Contact& c = *(*pairs)[k].contact;
	if (!moves(c.i) && !moves(c.j)) return;
	const double meets = meetingAfter((*pairs)[k], time);
	if (meets == never) return;
	meetings.push_back({ meets, k, states[c.i].impacts, states[c.j].impacts });
	std::push_heap(meetings.begin(), meetings.end());
}

/// Finds the pairs that hang together with one, and their bodies; false where their impact cannot be followed.
bool ImpactSequence::gather(int pair, double time)
{
	touching.assign(1, pair);
	bodies.clear();
	for (std::size_t n = 0; n < touching.size(); ++n) {
		const ImpactPair& here = (*pairs)[touching[n]];
		if (here.held || touching.size() > largest) return false;
		for (const int body : { here.contact->i, here.contact->j }) {
			if (!moves(body) || has(bodies, body)) continue;
			if (states[body].impacts >= scene->most && !states[body].frozen) {
				++overrun;
				states[body].frozen = true;
			}
			if (states[body].frozen) return false;
			bodies.push_back(body);
			for (int k = firstOf[body]; k < firstOf[body + 1]; ++k) {
				const ImpactPair& other = (*pairs)[pairsOf[k]];
				if (met[pairsOf[k]] || has(touching, pairsOf[k])) continue;
				if (other.held || touches(other, time)) touching.push_back(pairsOf[k]);
			}
		}
	}
	// in the order of pairs, whichever of them met first
	std::sort(touching.begin(), touching.end());
	return true;
}

/// Newton's law at the touching pairs, and what it does to their bodies; false where no impulses are found.
bool ImpactSequence::collide(double time)
{
	frames.resize(touching.size());
	approach.resize(touching.size());
	for (std::size_t k = 0; k < touching.size(); ++k) {
		const ImpactPair& pair = (*pairs)[touching[k]];
		Contact&          c    = frames[k];
		c                      = standAt(pair, time).contact;
		approach[k]            = relativeVelocity(c, flights[c.i].velocity, flights[c.j].velocity);
		c.biasN                = pair.restitution * std::min(approach[k].n, 0.0);
		if (approach[k].n < 0) met[touching[k]] = 1;
	}
	std::vector<Twist> before;
	for (const int body : bodies)
		before.push_back(flights[body].velocity);
	const bool found = sweep();
	for (std::size_t n = 0; n < bodies.size(); ++n) {
		Flight& f = flights[bodies[n]];
		if (!found) {
			f.velocity = before[n];
			continue;
		}
		f.struck = true;
		add(f.shift, -time, f.velocity);
		add(f.shift, time, before[n]);
		++states[bodies[n]].impacts;
		link(bodies.front(), bodies[n]);
	}
	if (!found) return false;
	record();
	for (const int body : bodies)
		for (int k = firstOf[body]; k < firstOf[body + 1]; ++k)
			expect(pairsOf[k], time);
	return true;
}

/// Sweeps over the pairs until their impulses stay as they are; they are few.
bool ImpactSequence::sweep()
{
	constexpr int    most  = 20000;
	constexpr double exact = 1e-14, enough = 1e3; // of the largest speed of approach; times that
	constexpr double rounding = 5e-16; // of speeds
	const auto&      masses   = scene->problem.inverseMass;
	const auto speed = [](double change, double inverse) { return inverse > 0 ? std::abs(change) / inverse : 0; };
	double     good = 0, changed = never; // changes of velocity
	for (std::size_t k = 0; k < touching.size(); ++k) {
		good = std::max(good, -exact * approach[k].n);
		for (const int body : { frames[k].i, frames[k].j }) {
			const Twist& v = flights[body].velocity;
			good           = std::max(
			                  good, rounding * (std::abs(v.x) + std::abs(v.y) + std::abs(v.w) * frames[k].length));
		}
	}
	impulses.assign(touching.size(), {});
	for (int n = 0; n < most && changed > good; ++n) {
		changed = 0;
		for (std::size_t k = 0; k < touching.size(); ++k) {
			const Contact& c  = frames[k];
			const auto &   mi = masses[c.i], &mj = masses[c.j];
			const Diagonal inverse = inverseDelassus(c, mi, mj);
			const Impulse  old     = impulses[k];
			const Impulse  p = impulses[k] = visit(
			         c, old, inverse, mi, mj, flights[c.i].velocity, flights[c.j].velocity);
			changed = std::max({ changed, speed(p.n - old.n, inverse.n), speed(p.t - old.t, inverse.t),
			                     speed(p.r - old.r, inverse.r) * c.length });
		}
	}
	return changed <= enough * good;
}

/// Keeps an impact: impulses, and what energy they take. The work of an impulse is that on the mean velocity.
void ImpactSequence::record()
{
	events.push_back({ hits.size(), hits.size() + touching.size() });
	++states[groupOf(bodies.front())].events;
	for (std::size_t k = 0; k < touching.size(); ++k) {
		const Contact&          c  = frames[k];
		const Impulse&          p  = impulses[k];
		const RelativeVelocity &u0 = approach[k],
		                       u1  = relativeVelocity(c, flights[c.i].velocity, flights[c.j].velocity);
		Hit   hit { touching[k],
                          { p, -0.5 * p.n * (u0.n + u1.n), -0.5 * p.t * (u0.t + u1.t), -0.5 * p.r * (u0.r + u1.r), 1 },
                          {},
                          {} };
		Twist onI, onJ; // of unit masses: the impulses
		applyImpulse(c, p, { 1, 1, 1 }, { 1, 1, 1 }, onI, onJ);
		hit.onI = { onI.x, onI.y, onI.w };
		hit.onJ = { onJ.x, onJ.y, onJ.w };
		hits.push_back(hit);
	}
}

int ImpactSequence::groupOf(int body)
{
	while (states[body].group != body)
		body = states[body].group = states[states[body].group].group;
	return body;
}

void ImpactSequence::link(int i, int j)
{
	for (const int body : { i, j })
		if (states[body].group < 0) states[body].group = body;
	i = groupOf(i);
	j = groupOf(j);
	if (i == j) return;
	states[j].group = i;
	states[i].events += states[j].events;
}

template <class Function> void ImpactSequence::eachBody(const Event& event, Function function) const
{
	for (std::size_t k = event.begin; k < event.end; ++k) {
		const Contact& c = *(*pairs)[hits[k].pair].contact;
		for (const int body : { c.i, c.j })
			if (moves(body)) function(body);
	}
}

/// Whether the step's solve may have this impact, the only one of its bodies: something holds them, or others touch
/// them, and none of them closes another gap in a whole step, neither with the velocities before nor with those after.
bool ImpactSequence::staysAlone(const Event& event) const
{
	const auto free = [this](int body) {
		const InverseMass& w = scene->problem.inverseMass[body];
		return w.x > 0 && w.y > 0;
	};
	const Contact& c = *(*pairs)[hits[event.begin].pair].contact;
	if (event.end - event.begin == 1 && free(c.i) && free(c.j)) return false;
	std::vector<int> own, ofIt; // bodies and pairs
	eachBody(event, [&](int body) { own.push_back(body); });
	for (std::size_t k = event.begin; k < event.end; ++k)
		ofIt.push_back(hits[k].pair);
	bool alone = true;
	for (const int body : own)
		for (int k = firstOf[body]; k < firstOf[body + 1]; ++k)
			if (!has(ofIt, pairsOf[k]) && closes((*pairs)[pairsOf[k]], own)) alone = false;
	return alone;
}

/// Whether a pair would close in a whole step from where it stands, or where impacts within the step have displaced a
/// body that is not among `own`.
bool ImpactSequence::closes(const ImpactPair& pair, const std::vector<int>& own) const
{
	if (pair.held) return false;
	const Contact& c   = *pair.contact;
	const auto     end = [&](const Twist& vi, const Twist& vj) {
                const double u = relativeVelocity(c, vi, vj).n;
                return u < 0 ? pair.gap + scene->step * u : never;
	};
	const auto   shift = [&](int body) { return has(own, body) ? Twist {} : flights[body].shift; };
	const Twist &vi = flights[c.i].velocity, &vj = flights[c.j].velocity;
	const double displaced = relativeVelocity(c, shift(c.i), shift(c.j)).n
	        + scene->step * relativeVelocity(c, vi, vj).n;
	return end(vi, vj) <= 0 || (pair.gap > 0 && pair.gap + displaced <= 0)
	        || (pair.restitution > 0 && end(scene->before[c.i], scene->before[c.j]) <= 0);
}

void ImpactSequence::undo(const Event& event)
{
	for (std::size_t k = event.begin; k < event.end; ++k)
		hits[k].impacts.count = 0;
	eachBody(event, [this](int body) {
		flights[body]          = {};
		flights[body].velocity = scene->before[body];
	});
}

int ImpactSequence::sumUp()
{
	int count = 0;
	for (const Hit& hit : hits) {
		if (hit.impacts.count == 0) continue;
		const Contact& c = *(*pairs)[hit.pair].contact;
		impacts[hit.pair].add(hit.impacts);
		add(flights[c.i].impulse, 1, hit.onI);
		add(flights[c.j].impulse, 1, hit.onJ);
		count += hit.impacts.impulse.n > 0;
	}
	return count;
}

int ImpactSequence::follow(const Scene& scene_, const std::vector<ImpactPair>& pairs_)
{
	scene   = &scene_;
	pairs   = &pairs_;
	overrun = 0;
	flights.assign(scene->before.size(), {});
	for (std::size_t b = 0; b < flights.size(); ++b)
		flights[b].velocity = scene->before[b];
	states.assign(flights.size(), {});
	impacts.assign(pairs->size(), {});
	met.assign(pairs->size(), 0);
	meetings.clear();
	events.clear();
	hits.clear();
	arrange();
	begin();
	while (!meetings.empty()) {
		const Meeting next = meetings.front();
		std::pop_heap(meetings.begin(), meetings.end());
		meetings.pop_back();
		const Contact& c = *(*pairs)[next.pair].contact;
		if (states[c.i].impacts != next.stampI || states[c.j].impacts != next.stampJ) continue;
		if (gather(next.pair, next.time) && collide(next.time)) continue;
		for (const int body : { c.i, c.j })
			if (moves(body)) states[body].frozen = true;
	}
	// all are asked before any is undone: each beside what the others leave
	std::vector<Event> single;
	for (const Event& event : events) {
		int events = 0;
		eachBody(event, [&](int body) { events = states[groupOf(body)].events; });
		if (events == 1 && staysAlone(event)) single.push_back(event);
	}
	for (const Event& event : single)
		undo(event);
	return sumUp();
}

} // namespace nonsmooth::contact
