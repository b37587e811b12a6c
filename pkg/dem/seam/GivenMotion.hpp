// Velocities of bodies that others move by their positions: walls, whose motion is given since DOFs are blocked.
//
// The integrator moves such a body by its velocity. What somebody else adds between two solves, d along x or y, or an
// angle about z, is a motion where it comes again:
//     u = d / t        with t the time since it was moved so before
// and the contacts meet the body with v + u, from this solve on until it has stood still for as many steps as there
// were between the two. A script may move it every step, or every tenth: the mean velocity is the same. It is no motion
// but a place where the body
//     is moved for the first time, or after more than `longest` steps,
//     goes farther at once than `farthest` of the smallest disk, or in several steps' time than `jump` of it (turns by more than `widest`),
//     is put back against its own velocity, as the belt of a conveyor that stays where it is.
// Such a move gives no velocity; where the body has been moved before it is told.
// Units: m, s, rad; angles counter-clockwise. Every direction by itself, blocked ones alone.
#pragma once

#include "Resident.hpp"
#include <array>

namespace yade::nscd {

class GivenMotion {
public:
	static constexpr long longest  = 100; // steps
	static constexpr Real farthest = 1, jump = 0.1, widest = 0.2; // smallest diameters, smallest diameters, rad

	/// A velocity u that is added to a body's own.
	struct Given {
		int                       id;
		nonsmooth::contact::Twist u;
	};

	/// At the head of a solve: what others have moved since the last one.
	const std::vector<Given>& take(const Scene& scene, const Resident& resident);
	/// At the end of a step of length h [s], before the integrator moves bodies: notes where it will leave them.
	void leave(const Scene& scene, const Resident& resident, Real h);

	/// All of it as numbers, to be saved with the scene.
	std::vector<Real> numbers() const;
	void              setNumbers(const std::vector<Real>& all);

	/// What there is to tell of the last take, empty where nothing is.
	string told;

private:
	/// Of one direction.
	struct Series {
		Real steps    = -1; // since it was moved; −1: never
		Real time     = 0; // the same [s]
		Real interval = 0; // steps for which the velocity holds; 0: none
		Real velocity = 0; // u
	};
	struct Body {
		int                               id = -1;
		nonsmooth::contact::plane::Motion left; // where the integrator leaves it
		std::array<Series, 3>             series; // along x, along y, about z
		boost::weak_ptr<yade::Body>       body; // an id may be another's later
		bool                              known = false; // else it was loaded
	};
	void takeMove(Series& series, Real moved, Real own, bool far, bool jumps, const Body& body, const char* what);
	void expectVelocity(Body& body, const nonsmooth::contact::plane::Motion& now) const;
	void followBody(Body& body, const BodyState& now, Real smallest);

	std::vector<Body>  bodies, before; // in the order of ids; and as they were before the last take
	bool               taken = false; // and not left yet
	Real               step  = 0; // length of the last one [s]
	std::vector<Given> given;
};

} // namespace yade::nscd
