#include <algorithm>
#include <contact/space/fill.hpp>
#include <limits>

namespace nonsmooth::contact::space {
namespace {

	/// Calls with(number of a, the same of b) for all numbers but adhesion.
	template <class A, class B, class With> void forNumbers(const A& a, B& b, With with)
	{
		const auto vector = [&](const auto& x, auto& y) { with(x.x, y.x), with(x.y, y.y), with(x.z, y.z); };
		vector(a.n, b.n), vector(a.f, b.f), vector(a.beforeF, b.beforeF), vector(a.m, b.m);
		vector(a.beforeM, b.beforeM), vector(a.biasT, b.biasT), vector(a.biasW, b.biasW);
		with(a.inverseN, b.inverseN), with(a.biasN, b.biasN), with(a.leverI, b.leverI),
		        with(a.leverJ, b.leverJ);
		with(a.friction, b.friction), with(a.rollingArm, b.rollingArm), with(a.twistingArm, b.twistingArm);
		with(a.inverseT, b.inverseT), with(a.inverseR, b.inverseR);
	}

	/// A contact's numbers into a lane. What turns without being pushed has its part in the biases alone, whatever
	/// its arm.
	void
	fillLane(Block<double>& k, double& inverseLength, std::size_t l, std::int32_t index, const BlockNumbers& from)
	{
		const Contact&         c  = from.contacts[index];
		const InverseMass &    mi = from.masses[c.i], &mj = from.masses[c.j];
		const RelativeVelocity u = relativeVelocity(c, from.freeVelocities[c.i], from.freeVelocities[c.j]);
		const Diagonal         inverse = inverseDelassus(c, mi, mj);
		const Impulse          p       = project(c, from.impulses[index]);
		setVector(k.n, l, c.n);
		setVector(k.biasT, l, acrossNormal(c.n, c.biasT + u.t));
		setVector(k.biasW, l, c.biasW + u.w);
		setVector(k.f, l, p.f);
		setVector(k.beforeF, l, p.f);
		setVector(k.m, l, p.m);
		setVector(k.beforeM, l, p.m);
		k.biasN.v[l]       = c.biasN + u.n;
		k.inverseN.v[l]    = inverse.n;
		k.inverseT.v[l]    = inverse.t;
		k.inverseR.v[l]    = inverse.r;
		k.adhesion.v[l]    = c.adhesion;
		k.friction.v[l]    = c.friction;
		k.rollingArm.v[l]  = c.rollingArm;
		k.twistingArm.v[l] = c.twistingArm;
		k.leverI.v[l]      = c.leverI;
		k.leverJ.v[l]      = c.leverJ;
		inverseLength      = 1 / c.length;
	}

	/// What is on its threshold in floats is so in doubles too, not beside it by a rounding.
	Vector taken(const Vector& x, double thresholdF, double threshold)
	{
		constexpr double beside = 1 - 1e-6;
		const double     square = dot(x, x);
		if (square > 0 && square >= beside * thresholdF * thresholdF) return threshold / std::sqrt(square) * x;
		return projectDisc(x, threshold);
	}

} // namespace

void fillBlocks(
        Block<double>* blocks, Numbers<double>* inverseLength, const std::int32_t* contactOf, std::size_t count,
        const BlockNumbers& from)
{
	// contacts lie in the order of their finding, so no processor guesses which one is next
	constexpr std::size_t ahead = 16, line = 64;
	for (std::size_t k = 0; k < count * lanes; ++k) {
		if (k + ahead < count * lanes && contactOf[k + ahead] != emptyLane) {
			const auto* const next = reinterpret_cast<const char*>(from.contacts + contactOf[k + ahead]);
			for (std::size_t byte = 0; byte < sizeof(Contact); byte += line)
				__builtin_prefetch(next + byte);
			__builtin_prefetch(from.impulses + contactOf[k + ahead]);
		}
		if (contactOf[k] != emptyLane)
			fillLane(
			        blocks[k / lanes], inverseLength[k / lanes].v[k % lanes], k % lanes, contactOf[k],
			        from);
	}
}

void roundBlocks(
        const Block<double>* from, const Numbers<double>* inverseLength, std::size_t count, Block<float>* to,
        Numbers<float>* inverseLengthTo)
{
	constexpr double most  = 1e-8 * std::numeric_limits<float>::max();
	const auto       round = [](const Numbers<double>& x, Numbers<float>& y) {
                for (std::size_t l = 0; l < lanes; ++l)
                        y.v[l] = static_cast<float>(x.v[l]);
	};
	for (std::size_t k = 0; k < count; ++k) {
		static_cast<BlockBodies&>(to[k]) = from[k];
		forNumbers(from[k], to[k], round);
		for (std::size_t l = 0; l < lanes; ++l)
			to[k].adhesion.v[l] = static_cast<float>(std::min(from[k].adhesion.v[l], most));
		round(inverseLength[k], inverseLengthTo[k]);
	}
}

void takeImpulses(const Block<float>* from, std::size_t count, Block<double>* to)
{
	for (std::size_t k = 0; k < count; ++k)
		for (std::size_t l = 0; l < lanes; ++l) {
			Block<double>&      b = to[k];
			const Block<float>& f = from[k];
			const Vector        n = vectorOf(b.n, l), force = vectorOf(f.f, l), moment = vectorOf(f.m, l);
			const double        adhesion = b.adhesion.v[l], adhesionF = f.adhesion.v[l];
			const double        nF = dot(n, force), sF = dot(n, moment);
			// of floats the normal impulse is known to a rounding of the whole
			const double rounding = 4 * std::numeric_limits<float>::epsilon() * adhesionF;
			const double normal   = nF <= rounding - adhesionF ? 0 - adhesion : std::max(nF, -adhesion);
			const double pressed = adhesion + normal, pressedF = std::max(0.0, adhesionF + nF);
			const Vector t = taken(force - nF * n, f.friction.v[l] * pressedF, b.friction.v[l] * pressed);
			const Vector r = taken(
			        moment - sF * n, f.rollingArm.v[l] * pressedF, b.rollingArm.v[l] * pressed);
			const double most  = b.twistingArm.v[l] * pressed,
			             mostF = (1 - 1e-6) * f.twistingArm.v[l] * pressedF;
			const double  s    = sF == 0 ? 0
			            : sF >= mostF    ? most
			            : sF <= -mostF   ? -most
			                             : projectThreshold(sF, most);
			const Impulse p { normal * n + t, s * n + r };
			setVector(b.f, l, p.f);
			setVector(b.beforeF, l, p.f);
			setVector(b.m, l, p.m);
			setVector(b.beforeM, l, p.m);
		}
}

} // namespace nonsmooth::contact::space
