// Eight contacts at a time: the data and the inner loops of a sweep.
//
// A block holds two halves of four contacts; those of a half share no body that moves, nor do in most blocks those of
// both (BlockBodies::together). Each number of the eight lies side by side, and a body's motion is a vector of four
// numbers, which are doubles or floats (solver.hpp says when). The loops (block_kernels.inc) are written once and
// compiled thrice: lane after lane for any processor, and for AVX2 and AVX-512 all lanes at once where they share no
// body and a register holds them, half after half elsewhere; which runs is decided on the machine. None fuses
// multiplications with additions or reorders a sum, so all give the same bits.
//
// Bodies carry what impulses have changed of their free velocities, and contacts have in their biases what free
// velocities make of them: so digits are kept for what the sweeps are about, however fast everything moves.
//
// Only "simple" contacts fit in: bodies with one mass for x and y, no lever along the normal where a body can turn, no
// bias but the normal one. That is every contact between disks, or between a disk and a wall that does not turn.
#pragma once

#include <contact/core/kernel_table.hpp>
#include <contact/plane/problem.hpp>
#include <vector>

namespace nonsmooth::contact {

/// Change of a body's velocity and its inverse mass, (v_x, v_y, ω, 1/m).
template <class Number> struct alignas(halfLanes * sizeof(Number)) Motion {
	Four<Number> v;
};

/// Numbers that sweeps over normals alone need come first.
template <class Number> struct alignas(64) Block : BlockBodies {
	Numbers<Number> nx, ny;
	Numbers<Number> inverseN, biasN, adhesion;
	Numbers<Number> n, beforeN;
	Numbers<Number> leverTi, leverTj; // λt [m]
	Numbers<Number> inverseInertiaI, inverseInertiaJ;
	Numbers<Number> friction, rollingArm; // as in Contact, and so is adhesion
	Numbers<Number> biasT,
	        biasR; // with biasN relative velocity of the bodies' free velocities, and the contact's bias
	Numbers<Number> inverseT, inverseR; // with inverseN the inverse diagonal of the Delassus operator
	Numbers<Number> t, r; // with n impulses P_k
	Numbers<Number> beforeT, beforeR; // with beforeN P_{k−1}
};

struct SolverSettings;
struct PositionError;
struct PositionCorrection;

/// What the solver's driver is made of in the plane.
struct Plane {
	using Problem                        = contact::Problem;
	using Contact                        = contact::Contact;
	using Impulse                        = contact::Impulse;
	using Inverse                        = contact::Diagonal; // 1/W of each row
	using Twist                          = contact::Twist;
	using InverseMass                    = contact::InverseMass;
	template <class Number> using Block  = contact::Block<Number>;
	template <class Number> using Motion = contact::Motion<Number>;
	using Settings                       = SolverSettings;
	using PositionError                  = contact::PositionError;
	using PositionCorrection             = contact::PositionCorrection;
};

using BlockNumbers                      = BlockNumbersIn<Plane>;
using BlockKernels                      = BlockKernelsIn<Plane>;
template <class Number> using KernelsOf = KernelsIn<Plane, Number>;

/// W⁻¹ p of a lane with the play p, of which law.hpp speaks.
inline double playOf(const Block<double>& block, std::size_t lane, double play)
{
	return block.inverseN.v[lane] * play;
}

inline Impulse impulseOf(const Block<double>& k, std::size_t l) { return { k.n.v[l], k.t.v[l], k.r.v[l] }; }
inline Impulse impulseOf(const Block<float>& k, std::size_t l) { return { k.n.v[l], k.t.v[l], k.r.v[l] }; }

template <class Number> Twist twistOf(const Motion<Number>& m) { return { m.v[0], m.v[1], m.v[2] }; }
template <class Number> void  setTwist(Motion<Number>& m, const Twist& v)
{
	m.v[0] = static_cast<Number>(v.x);
	m.v[1] = static_cast<Number>(v.y);
	m.v[2] = static_cast<Number>(v.w);
}
/// Of a body whose velocity no impulse has changed yet.
template <class Number> void setUnchanged(Motion<Number>& m, const InverseMass& inverse)
{
	m.v = Four<Number> { 0, 0, 0, static_cast<Number>(inverse.x) };
}
inline void narrow(const Motion<double>& from, Motion<float>& to)
{
	for (int k = 0; k < 4; ++k)
		to.v[k] = static_cast<float>(from.v[k]);
}

/// All that this processor can run, the fastest first and the portable ones last.
const std::vector<const BlockKernels*>& availableKernels();

} // namespace nonsmooth::contact
