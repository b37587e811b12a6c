// Eight contacts in space at a time: the data of a sweep. contact/core/lanes.hpp and plane/block_kernels.hpp say how
// blocks, lanes and instruction sets go together; the loops are space/kernels.inc.
//
// Only contacts of balls fit in (space/classification.hpp), so that each row's block of the Delassus operator is one number.
// Impulses and biases are vectors of the world. Bodies carry what impulses have changed of their free
// velocities, and contacts have in their biases what free velocities make of them.
#pragma once

#include <contact/core/kernel_table.hpp>
#include <contact/space/law.hpp>
#include <contact/space/residual.hpp>
#include <vector>

namespace nonsmooth::contact::space {

/// Change of a body's velocities and its inverse mass and inertia, (v_x, v_y, v_z, 1/m) and (ω_x, ω_y, ω_z, 1/I).
template <class Number> struct alignas(lanes * sizeof(Number)) Motion {
	Four<Number> v, w;
};

/// One vector of each contact of a block.
template <class Number> struct Vectors {
	Numbers<Number> x, y, z;
};

/// Numbers that sweeps over normals alone need come first.
template <class Number> struct alignas(64) Block : BlockBodies {
	Vectors<Number> n; // the normal
	Numbers<Number> inverseN, biasN, adhesion;
	Vectors<Number> f, beforeF; // impulses P_k and P_{k−1}
	Numbers<Number> leverI, leverJ; // λ [m]
	Numbers<Number> friction, rollingArm, twistingArm; // as in Contact, and so is adhesion
	Vectors<Number> biasT,
	        biasW; // with biasN relative velocity of the bodies' free velocities, and the contact's bias
	Numbers<Number> inverseT,
	        inverseR; // with inverseN the inverse diagonal of the Delassus operator; of twisting that of rolling
	Vectors<Number> m, beforeM; // moments
};

struct SolverSettings;
struct PositionError;
struct PositionCorrection;

/// What the solver's driver is made of in space.
struct Space {
	using Problem                        = space::Problem;
	using Contact                        = space::Contact;
	using Impulse                        = space::Impulse;
	using Inverse                        = Diagonal;
	using Twist                          = space::Twist;
	using InverseMass                    = space::InverseMass;
	template <class Number> using Block  = space::Block<Number>;
	template <class Number> using Motion = space::Motion<Number>;
	using Settings                       = SolverSettings;
	using PositionError                  = space::PositionError;
	using PositionCorrection             = space::PositionCorrection;
};

using BlockNumbers = BlockNumbersIn<Space>;
using BlockKernels = BlockKernelsIn<Space>;

/// W⁻¹ p of a lane with the play p, of which contact/plane/law.hpp speaks.
inline double playOf(const Block<double>& block, std::size_t lane, double play)
{
	return block.inverseN.v[lane] * play;
}

template <class Number> Vector vectorOf(const Vectors<Number>& a, std::size_t l)
{
	return { a.x.v[l], a.y.v[l], a.z.v[l] };
}
template <class Number> void setVector(Vectors<Number>& a, std::size_t l, const Vector& to)
{
	a.x.v[l] = static_cast<Number>(to.x);
	a.y.v[l] = static_cast<Number>(to.y);
	a.z.v[l] = static_cast<Number>(to.z);
}

template <class Number> Impulse impulseOf(const Block<Number>& k, std::size_t l)
{
	return { vectorOf(k.f, l), vectorOf(k.m, l) };
}

template <class Number> Twist twistOf(const Motion<Number>& m)
{
	return { { m.v[0], m.v[1], m.v[2] }, { m.w[0], m.w[1], m.w[2] } };
}
template <class Number> void setTwist(Motion<Number>& m, const Twist& v)
{
	const auto set = [](Four<Number>& to, const Vector& from) {
		to[0] = static_cast<Number>(from.x);
		to[1] = static_cast<Number>(from.y);
		to[2] = static_cast<Number>(from.z);
	};
	set(m.v, v.v);
	set(m.w, v.w);
}
/// Of a body whose velocity no impulse has changed yet. What is no ball has no use for the inverses.
template <class Number> void setUnchanged(Motion<Number>& m, const InverseMass& inverse)
{
	m.v = Four<Number> { 0, 0, 0, static_cast<Number>(inverse.x) };
	m.w = Four<Number> { 0, 0, 0, static_cast<Number>(inverse.inertia.xx) };
}
inline void narrow(const Motion<double>& from, Motion<float>& to)
{
	for (int k = 0; k < 4; ++k) {
		to.v[k] = static_cast<float>(from.v[k]);
		to.w[k] = static_cast<float>(from.w[k]);
	}
}

/// All that this processor can run, the fastest first and the portable ones last.
const std::vector<const BlockKernels*>& availableKernels();

} // namespace nonsmooth::contact::space
