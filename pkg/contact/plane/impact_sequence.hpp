// Impacts that follow from impacts within one step: pairs that meet are taken one after the other, in the order of
// time, by Newton's law of impact.
//
// Within the step bodies fly straight, with the velocities they have, x(t) = x + t v; forces act in the step's solve,
// which comes after. The next pair to meet has the least t with a gap g(t) = 0 and U_n < 0. At that moment the impulses
// P of this pair, and of all pairs that touch and hang together with it,
//     0 ≤ (U_n + e min(U_n⁻, 0)) ⟂ P_n ≥ 0 ,   |P_t| ≤ μ P_n against U_t ,   |P_r| ≤ μ_r ℓ P_n against w ,   v ← v + M⁻¹ Hᵀ P ,
// with U⁻ just before and U just after, make the velocities of what follows. A body that is hit at t has come the way t
// v⁻ and has (h − t) v left: it comes as far as if it had flown with v all the time from
//     x + s ,   s ← s − t (v − v⁻) ,
// so a step that begins with the velocities v, displaces bodies by s and moves them by h v is exact. Of two disks the
// normal turns as they pass each other, so momentum, angular momentum and for e = 1 without friction energy are kept to
// rounding; other contacts keep their normal.
//
// An impact that stays alone at a body that is held, or among bodies that touch, is left to the step's solve, where
// forces act too: none of its bodies is in another impact, nor would be if it went the whole step from where it stands
// with the velocity that the impact leaves. So is what cannot be followed: an impact on bodies that hang together by
// more than `largest` contacts, by bonds or by adhesion, and what comes after it at these bodies; and what a body has
// beyond its `most` impacts in one step.
//
// Pairs up to 1e-9 ℓ apart that do not part touch; those that have met in the step do not hang together any more, and
// are taken one after the other. Impacts with e < 1 may follow each other ever faster, until bodies move together
// (McNamara and Young 1992): this ends where a pair would come nearer by less than 1e-7 ℓ in a step. Symbols as in
// contact/plane/law.hpp and contact/plane/problem.hpp.
// Sources: event-driven simulation after Alder and Wainwright (1959, J. Chem. Phys. 31, 459); McNamara and Young (1992,
// Phys. Fluids A 4, 496); law of impact: Moreau (1988).
#pragma once

#include <contact/plane/problem.hpp>
#include <vector>

namespace nonsmooth::contact {

/// Two bodies that may meet in the step.
struct ImpactPair {
	const Contact* contact     = nullptr; // bodies, frame, friction, rolling arm and length at the step's beginning
	double         gap         = 0; // then [m]
	double         restitution = 0; // e
	bool           disks       = false; // both are round
	bool           held = false; // by a bond or by adhesion, or forces act on a body of it: left to the solve
};

/// What the impacts of a step have done at one pair: sums, each along the normal and tangent it had.
struct PairImpacts {
	Impulse impulse;
	double  normalLoss = 0, slidingLoss = 0, rollingLoss = 0; // of energy [J]
	int     count = 0;

	void add(const PairImpacts& other);
};

class ImpactSequence {
public:
	/// Bodies and what a step may do with them; `problem` gives masses and positions.
	struct Scene {
		const Problem&             problem;
		const std::vector<double>& radius; // of disks [m]
		const std::vector<Twist>&  before; // velocities at the step's beginning
		double                     step; // h [s]
		int                        most; // impacts of one body
	};

	/// What became of a body.
	struct Flight {
		Twist  velocity; // at the step's end
		Twist  shift; // s [m, m, rad]
		Wrench impulse; // all it got [N s, N s, N m s]
		bool   struck = false; // by impacts that were followed
	};

	/// Finds the impacts of a step; returns how many were followed.
	int follow(const Scene& scene, const std::vector<ImpactPair>& pairs);

	std::vector<Flight>      flights; // one a body
	std::vector<PairImpacts> impacts; // one a pair
	int                      overrun = 0; // bodies that had more impacts than they may have

private:
	struct Meeting {
		double time;
		int    pair, stampI, stampJ;
		bool   operator<(const Meeting& other) const // the last one first, as heaps have it
		{
			return time != other.time ? time > other.time : pair > other.pair;
		}
	};
	/// One pair's part in an impact.
	struct Hit {
		int         pair;
		PairImpacts impacts;
		Wrench      onI, onJ; // impulses on its bodies
	};
	struct Event {
		std::size_t begin, end; // of its pairs, in `hits`
	};
	/// A body on its way.
	struct State {
		int  impacts = 0; // so far: what was expected of it before the last one is void
		int  group   = -1; // of bodies that impacts have linked: another of them, itself for the first
		int  events  = 0; // of the group, at its first body
		bool frozen  = false; // no more of its impacts is followed
	};
	/// A pair at one moment.
	struct Stand {
		Contact contact; // without biases
		double  gap;
	};

	bool                           moves(int body) const { return !scene->problem.inverseMass[body].isFixed(); }
	Stand                          standAt(const ImpactPair& pair, double time) const;
	double                         meetingAfter(const ImpactPair& pair, double time) const;
	bool                           touches(const ImpactPair& pair, double time) const;
	void                           arrange();
	void                           begin();
	void                           expect(int pair, double time);
	bool                           gather(int pair, double time);
	bool                           collide(double time);
	bool                           sweep();
	void                           record();
	int                            groupOf(int body);
	void                           link(int i, int j);
	bool                           staysAlone(const Event& event) const;
	bool                           closes(const ImpactPair& pair, const std::vector<int>& own) const;
	void                           undo(const Event& event);
	int                            sumUp();
	template <class Function> void eachBody(const Event& event, Function function) const;

	const Scene*                   scene = nullptr;
	const std::vector<ImpactPair>* pairs = nullptr;
	std::vector<State>             states; // of bodies
	std::vector<int>               firstOf, pairsOf; // pairs of each body that moves
	std::vector<char>              met; // which pairs have
	std::vector<Meeting>           meetings; // a heap, the next one first
	std::vector<Event>             events;
	std::vector<Hit>               hits;
	// of one impact: the pairs that hang together, their bodies that move; as they stand, their velocities before,
	// what they get
	std::vector<int>              touching, bodies;
	std::vector<Contact>          frames;
	std::vector<RelativeVelocity> approach;
	std::vector<Impulse>          impulses;
};

} // namespace nonsmooth::contact
