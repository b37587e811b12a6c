// A body's State as motion in the plane, where that is all of its motion: the way between YADE's bodies and
// contact/plane.
#pragma once

#include <contact/plane/motion.hpp>
#include <core/Body.hpp>

namespace yade::nscd {

/// Whether a body is not turned out of the plane and does not leave it; z itself does not matter.
inline bool staysInPlane(const State& s)
{
	constexpr unsigned out = State::DOF_Z | State::DOF_RX | State::DOF_RY;
	return (s.blockedDOFs & out) == out && s.vel[2] == 0 && s.angVel[0] == 0 && s.angVel[1] == 0 && s.ori.x() == 0
	        && s.ori.y() == 0;
}

inline nonsmooth::contact::plane::Motion motionOf(const State& s)
{
	return { { s.pos[0], s.pos[1] }, { s.ori.z(), s.ori.w() }, { s.vel[0], s.vel[1], s.angVel[2] } };
}

/// Of a body that stays in the plane.
inline void setMotion(State& s, const nonsmooth::contact::plane::Motion& m)
{
	s.pos[0]    = m.position.x;
	s.pos[1]    = m.position.y;
	s.ori.z()   = m.rotation.z;
	s.ori.w()   = m.rotation.w;
	s.vel[0]    = m.velocity.x;
	s.vel[1]    = m.velocity.y;
	s.angVel[2] = m.velocity.w;
}

} // namespace yade::nscd
