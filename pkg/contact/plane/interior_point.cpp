#include <algorithm>
#include <cmath>
#include <contact/plane/eliminated_contact.hpp>
#include <contact/plane/interior_point.hpp>
#include <contact/plane/law.hpp>

namespace nonsmooth::contact {
namespace {

	constexpr int    mostIterations = 80;
	constexpr double regularisation = 1e-11; // of W
	constexpr double leastCentring  = 1e-2; // of τ, in one iteration
	constexpr double farAway        = 1e-2; // of what is missed at first: a start that gains less has led nowhere
	constexpr double nothing        = 1e-24; // of the τ of the first scale

	class Method {
	public:
		Method(PatchProblem& patch_, const SpeedScale& asked_)
		        : patch(patch_)
		        , asked(asked_)
		        , start(patch_)
		        , bodies(patch_.masses.size())
		{
		}

		/// From what was there, and if that leads nowhere from nothing.
		bool run(double tolerance)
		{
			const PatchResidual  before = residualOf(patch, asked);
			PatchResidual        best   = before;
			std::vector<Impulse> found;
			for (const bool warm : { true, false }) {
				if (best.work < farAway * before.work || !begin(warm)) break;
				for (int k = 0; k < mostIterations && best.largest > tolerance && step(); ++k) {
					PatchProblem here = start;
					read(here);
					const PatchResidual now = residualOf(here, asked);
					if (now.work < best.work) best = now, found = here.impulses;
					if (tau <= nothing * scale * scale) break;
				}
			}
			if (found.empty()) return false;
			patch.impulses = found;
			patch.changes  = changesOf(patch.impulses);
			return true;
		}

	private:
		std::size_t   unknown(std::int32_t body, int k) const { return 3 * std::size_t(body) + k; }
		bool          isThere(std::int32_t body) const { return std::size_t(body) < bodies; }
		static double part(const InverseMass& m, int k) { return k == 0 ? m.x : (k == 1 ? m.y : m.w); }
		static double part(const Twist& v, int k) { return k == 0 ? v.x : (k == 1 ? v.y : v.w); }

		/// Velocities that belong to other impulses than those at the start.
		std::vector<Twist> changesOf(const std::vector<Impulse>& impulses) const
		{
			std::vector<Twist> v = start.changes;
			v.emplace_back(); // of nobody
			for (std::size_t c = 0; c < impulses.size(); ++c) {
				const Contact& k = start.contacts[c];
				const Impulse &a = impulses[c], &b = start.impulses[c];
				applyImpulse(
				        k, { a.n - b.n, a.t - b.t, a.r - b.r }, massAt(k.i), massAt(k.j), v[k.i],
				        v[k.j]);
			}
			v.pop_back();
			return v;
		}
		InverseMass massAt(std::int32_t body) const
		{
			return isThere(body) ? start.masses[body] : InverseMass {};
		}

		/// The patch with the present impulses, projected.
		void read(PatchProblem& to) const
		{
			for (std::size_t c = 0; c < all.size(); ++c) {
				const auto& p  = all[c].p;
				to.impulses[c] = project(
				        to.contacts[c], { p[0] - to.contacts[c].adhesion, p[1], p[2] });
			}
			to.changes = changesOf(to.impulses);
		}

		bool begin(bool warm)
		{
			double square = 0;
			for (const Twist& v : start.changes)
				square += v.x * v.x + v.y * v.y;
			scale = std::sqrt(square / double(std::max<std::size_t>(bodies, 1)));
			if (!(scale > 0) || !std::isfinite(scale)) return false;
			velocity.resize(3 * bodies);
			for (std::size_t b = 0; b < bodies; ++b)
				for (int k = 0; k < 3; ++k)
					velocity[unknown(int(b), k)] = warm ? part(start.changes[b], k) : 0;
			all.resize(start.contacts.size());
			for (std::size_t c = 0; c < all.size(); ++c)
				begin(start.contacts[c],
				      project(start.contacts[c], warm ? start.impulses[c] : Impulse {}), all[c]);
			return true;
		}

		/// Starts inside: no slack below what the scale of speeds asks for.
		void begin(const Contact& c, const Impulse& p, Eliminated& e) const
		{
			e.rows               = { { { -c.nx, -c.ny, -c.leverNi, c.nx, c.ny, c.leverNj },
				                   { c.ny, -c.nx, -c.leverTi, -c.ny, c.nx, c.leverTj },
				                   { 0, 0, -1, 0, 0, 1 } } };
			e.w                  = delassus(c, massAt(c.i), massAt(c.j));
			e.inverse            = inverseDelassus(c, massAt(c.i), massAt(c.j));
			e.arm                = { c.friction, c.rollingArm };
			const auto   u       = speeds(c, e);
			const double pressed = std::max(p.n + c.adhesion, scale * e.inverse.n);
			e.p                  = { pressed, p.t, p.r };
			e.normal             = { pressed, std::max(std::abs(u[0]), scale), e.inverse.n, 0, 0, true };
			e.drawn = e.spare = {};
			if (c.play > 0 && c.adhesion > 0) beginWithPlay(c, p, u[0], e);
			const double inverse[2] = { e.inverse.t, e.inverse.r }, speed[2] = { scale, scale / c.length };
			for (int r = 0; r < 2; ++r) {
				const double threshold = e.arm[r] * e.p[0],
				             weight    = inverse[r] * speed[r] * speed[r] / (scale * scale);
				e.plus[r] = e.minus[r] = {};
				e.p[1 + r]             = std::clamp(e.p[1 + r], -0.9 * threshold, 0.9 * threshold);
				if (!(threshold > 0) || !(weight > 0)) {
					e.p[1 + r] = 0;
					continue;
				}
				e.plus[r] = {
					threshold - e.p[1 + r], std::max(-u[1 + r], 0.0) + speed[r], weight, 0, 0, true
				};
				e.minus[r] = {
					threshold + e.p[1 + r], std::max(u[1 + r], 0.0) + speed[r], weight, 0, 0, true
				};
			}
		}

		/// a, b and F_a − b inside; P_n + F_a is then what it always is, and positive.
		void beginWithPlay(const Contact& c, const Impulse& p, double u, Eliminated& e) const
		{
			constexpr double inside  = 0.05; // of F_a, from either end of the tension
			const double     pressed = std::max(p.n, scale * e.inverse.n),
			             drawn       = std::clamp(-p.n, inside * c.adhesion, (1 - inside) * c.adhesion);
			e.normal                 = { pressed, std::max(std::abs(u), scale), e.inverse.n, 0, 0, true };
			e.drawn = { drawn, std::max(c.play - u, 0.0) + scale, e.inverse.n, 0, 0, true };
			e.spare = { c.adhesion - drawn, std::max(u - c.play, 0.0) + scale, e.inverse.n, 0, 0, true };
			e.p[0]  = pressed - drawn + c.adhesion;
		}

		/// U + b.
		std::array<double, 3> speeds(const Contact& c, const Eliminated& e) const
		{
			std::array<double, 3> u { c.biasN, c.biasT, c.biasR };
			for (int side = 0; side < 2; ++side) {
				const std::int32_t b = side == 0 ? c.i : c.j;
				if (!isThere(b)) continue;
				for (int r = 0; r < 3; ++r)
					for (int k = 0; k < 3; ++k)
						u[r] += e.rows[r][3 * side + k] * velocity[unknown(b, k)];
			}
			return u;
		}

		/// G, and the equations of speeds.
		void eliminate(const Contact& c, Eliminated& e) const
		{
			const auto u = speeds(c, e);
			e.missed     = { u[0] - e.normal.speed, 0, 0 };
			e.gTouch = e.g00 = 1 / (e.normal.stiffness() + regularisation * e.w.n);
			if (e.drawn.there) {
				e.missedLength = c.play - u[0] - (e.drawn.speed - e.spare.speed);
				e.gLength = 1 / (e.drawn.stiffness() + e.spare.stiffness() + regularisation * e.w.n);
				e.g00     = e.gTouch + e.gLength;
			}
			const double w[2] = { e.w.t, e.w.r };
			for (int r = 0; r < 2; ++r) {
				e.share[r] = e.g[r] = 0;
				if (!e.plus[r].there) continue;
				const double plus = e.plus[r].stiffness(), minus = e.minus[r].stiffness();
				e.missed[1 + r] = u[1 + r] - (e.minus[r].speed - e.plus[r].speed);
				e.g[r]          = 1 / (plus + minus + regularisation * w[r]);
				e.share[r]      = e.arm[r] * (plus - minus) * e.g[r];
			}
		}

		/// M + Hᵀ G H, scaled so that its diagonal is 1.
		bool factorise()
		{
			matrix.reset(3 * (bodies - start.hubs), 3 * start.hubs, 3 * start.width + 2);
			diagonal.assign(3 * bodies, 0);
			const auto add = [this](bool scaled, std::size_t row, std::size_t column, double value) {
				if (!scaled) {
					if (row == column) diagonal[row] += value;
				} else
					matrix.at(row, column) += diagonal[row] * value * diagonal[column];
			};
			for (const bool scaled : { false, true }) {
				for (std::size_t b = 0; b < bodies; ++b)
					for (int k = 0; k < 3; ++k) {
						const double inverse = part(start.masses[b], k);
						add(scaled, unknown(int(b), k), unknown(int(b), k),
						    inverse > 0 ? 1 / inverse : 1);
					}
				for (std::size_t c = 0; c < all.size(); ++c)
					assemble(
					        start.contacts[c], all[c],
					        [&](std::size_t row, std::size_t column, double value) {
						        add(scaled, row, column, value);
					        });
				if (!scaled)
					for (double& x : diagonal) {
						if (!(x > 0) || !std::isfinite(x)) return false;
						x = 1 / std::sqrt(x);
					}
			}
			return matrix.factorise();
		}

		/// Calls add(row, column, value) for the numbers of Hᵀ G H that stand where bodies can move.
		template <class Add> void assemble(const Contact& c, const Eliminated& e, Add add) const
		{
			std::array<std::array<double, 6>, 3> gh;
			for (int k = 0; k < 6; ++k) {
				gh[0][k] = e.g00 * e.rows[0][k];
				for (int r = 0; r < 2; ++r)
					gh[1 + r][k] = e.share[r] * gh[0][k] + e.g[r] * e.rows[1 + r][k];
			}
			for (int a = 0; a < 6; ++a) {
				const std::int32_t row = a < 3 ? c.i : c.j;
				if (!isThere(row) || !(part(start.masses[row], a % 3) > 0)) continue;
				for (int b = 0; b < 6; ++b) {
					const std::int32_t column = b < 3 ? c.i : c.j;
					if (!isThere(column) || !(part(start.masses[column], b % 3) > 0)) continue;
					double value = 0;
					for (int r = 0; r < 3; ++r)
						value += e.rows[r][a] * gh[r][b];
					if (value != 0) add(unknown(row, a % 3), unknown(column, b % 3), value);
				}
			}
		}

		/// Newton's step towards products of τ; `corrected`: with the products of the last direction's changes.
		void direct(double aim, bool corrected)
		{
			right             = outOfBalance;
			const auto wanted = [&](const Product& x) {
				return aim * x.weight - (corrected ? x.dSlack * x.dSpeed : 0);
			};
			for (std::size_t c = 0; c < all.size(); ++c) {
				Eliminated& e = all[c];
				e.touchAlpha  = e.gTouch * (e.normal.aim(wanted(e.normal)) - e.missed[0]);
				e.lengthAlpha = e.drawn.there ? e.gLength
				                * (e.drawn.aim(wanted(e.drawn)) - e.spare.aim(wanted(e.spare))
				                   - e.missedLength)
				                              : 0;
				e.alpha       = { e.touchAlpha - e.lengthAlpha, 0, 0 };
				for (int r = 0; r < 2; ++r)
					if (e.plus[r].there)
						e.alpha[1 + r] = e.share[r] * e.alpha[0]
						        + e.g[r]
						                * (e.minus[r].aim(wanted(e.minus[r]))
						                   - e.plus[r].aim(wanted(e.plus[r]))
						                   - e.missed[1 + r]);
				push(start.contacts[c], e, e.alpha, right);
			}
			for (std::size_t k = 0; k < right.size(); ++k)
				right[k] *= diagonal[k];
			matrix.solve(right);
			for (std::size_t k = 0; k < right.size(); ++k)
				right[k] *= diagonal[k];
			for (std::size_t c = 0; c < all.size(); ++c)
				change(start.contacts[c], all[c], wanted);
		}

		/// Adds Hᵀ of impulses to what has a velocity.
		void
		push(const Contact& c, const Eliminated& e, const std::array<double, 3>& p,
		     std::vector<double>& to) const
		{
			for (int a = 0; a < 6; ++a) {
				const std::int32_t b = a < 3 ? c.i : c.j;
				if (!isThere(b) || !(part(start.masses[b], a % 3) > 0)) continue;
				to[unknown(b, a % 3)] += e.rows[0][a] * p[0] + e.rows[1][a] * p[1]
				        + e.rows[2][a] * p[2];
			}
		}

		/// What the change of velocities in `right` makes of a contact.
		template <class Wanted> void change(const Contact& c, Eliminated& e, Wanted wanted) const
		{
			std::array<double, 3> du {};
			for (int a = 0; a < 6; ++a)
				if (const std::int32_t b = a < 3 ? c.i : c.j; isThere(b))
					for (int r = 0; r < 3; ++r)
						du[r] += e.rows[r][a] * right[unknown(b, a % 3)];
			const double pressed = e.g00 * du[0];
			e.dp[0]              = e.alpha[0] - pressed;
			const auto towards   = [&](Product& x, double dSlack) {
                                const double aim = x.aim(wanted(x));
                                x.dSlack         = dSlack;
                                x.dSpeed         = aim - x.stiffness() * dSlack;
			};
			towards(e.normal, e.drawn.there ? e.touchAlpha - e.gTouch * du[0] : e.dp[0]);
			if (e.drawn.there) {
				const double drawn = e.lengthAlpha + e.gLength * du[0];
				towards(e.drawn, drawn);
				towards(e.spare, -drawn);
			}
			for (int r = 0; r < 2; ++r) {
				e.dp[1 + r] = e.alpha[1 + r] - e.share[r] * pressed - e.g[r] * du[1 + r];
				if (!e.plus[r].there) continue;
				towards(e.plus[r], e.arm[r] * e.dp[0] - e.dp[1 + r]);
				towards(e.minus[r], e.arm[r] * e.dp[0] + e.dp[1 + r]);
			}
		}

		double farthest()
		{
			double share = 1 / towardsEdge;
			for (Eliminated& e : all)
				e.forProducts([&](const Product& x) { share = std::min(share, x.farthest()); });
			return share;
		}
		double meanProduct(double share)
		{
			double sum = 0, count = 0;
			for (Eliminated& e : all)
				e.forProducts([&](const Product& x) { sum += x.after(share), ++count; });
			return sum / count;
		}

		bool step()
		{
			outOfBalance.assign(3 * bodies, 0); // Hᵀ ΔP − M Δv
			for (std::size_t b = 0; b < bodies; ++b)
				for (int k = 0; k < 3; ++k)
					if (const double inverse = part(start.masses[b], k); inverse > 0)
						outOfBalance[unknown(int(b), k)] = (part(start.changes[b], k)
						                                    - velocity[unknown(int(b), k)])
						        / inverse;
			for (std::size_t c = 0; c < all.size(); ++c) {
				Eliminated&    e = all[c];
				const Impulse& p = start.impulses[c];
				push(start.contacts[c], e,
				     { e.p[0] - start.contacts[c].adhesion - p.n, e.p[1] - p.t, e.p[2] - p.r },
				     outOfBalance);
				eliminate(start.contacts[c], e);
				e.forProducts([](Product& x) { x.dSlack = x.dSpeed = 0; });
			}
			if (!factorise()) return false;
			tau = meanProduct(0);
			direct(0, false);
			const double ahead    = std::min(1.0, farthest());
			const double promised = meanProduct(ahead) / tau;
			direct(std::clamp(promised * promised * promised, leastCentring, 1.0) * tau, true);
			const double share = std::min(1.0, towardsEdge * farthest());
			if (!std::isfinite(share) || !std::isfinite(right[0])) return false;
			for (std::size_t k = 0; k < velocity.size(); ++k)
				velocity[k] += share * right[k];
			for (Eliminated& e : all) {
				for (int r = 0; r < 3; ++r)
					e.p[r] += share * e.dp[r];
				e.forProducts([share](Product& x) { x.go(share); });
			}
			return true;
		}

		PatchProblem&           patch;
		const SpeedScale        asked;
		const PatchProblem      start;
		const std::size_t       bodies;
		double                  scale = 0, tau = 0; // of speeds [m/s], and of the products [J kg⁻¹]
		std::vector<Eliminated> all;
		std::vector<double>     velocity, outOfBalance, diagonal, right;
		BorderedBand            matrix;
	};

} // namespace

bool solvePatch(PatchProblem& patch, double tolerance, const SpeedScale& scale)
{
	return !patch.contacts.empty() && Method(patch, scale).run(tolerance);
}

} // namespace nonsmooth::contact
