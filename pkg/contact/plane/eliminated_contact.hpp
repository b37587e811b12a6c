// What the interior-point method (interior_point.hpp, where the equations stand) knows of one contact: its slacks, and
// what is left of it in the equations of the bodies.
#pragma once

#include <algorithm>
#include <array>
#include <contact/plane/problem.hpp>

namespace nonsmooth::contact {

constexpr double towardsEdge = 0.9; // share of the way to the first slack that would be 0

/// One of the products that are led to 0.
struct Product {
	double slack = 1, speed = 0, weight = 1; // s, z, and what τ is multiplied by
	double dSlack = 0, dSpeed = 0; // of the last direction
	bool   there = false;

	double stiffness() const { return speed / slack; }
	/// What s z is to become, as a change of z for ds = 0.
	double aim(double product) const { return product / slack - speed; }
	double farthest() const
	{
		double share = 1 / towardsEdge;
		if (dSlack < 0) share = std::min(share, -slack / dSlack);
		if (dSpeed < 0) share = std::min(share, -speed / dSpeed);
		return share;
	}
	double after(double share) const { return (slack + share * dSlack) * (speed + share * dSpeed) / weight; }
	void   go(double share)
	{
		slack += share * dSlack;
		speed += share * dSpeed;
	}
};

/// A contact's rows, slacks, and the elimination of them. With play the normal impulse is P_n = a − b: `normal` leads a
/// to 0 or the bodies to their touch,
/// `drawn` b to 0 or below the bond's length, `spare` F_a − b to 0 or up to it; 0 ≤ U + b_n ⟂ a ≥ 0, p − (U + b_n) =
/// z_drawn − z_spare.
struct Eliminated {
	std::array<std::array<double, 6>, 3> rows; // H
	Diagonal                             w, inverse; // W and 1/W
	std::array<double, 3>                p; // P̂, P_t, P_r
	std::array<double, 2>                arm; // μ_s, μ_r ℓ
	Product                              normal, drawn, spare, plus[2], minus[2];
	std::array<double, 3>                missed; // of the equations of speeds
	double                               missedLength = 0; // the same of the bond's length
	double                               gTouch = 0, gLength = 0; // whose sum is g00
	double                g00 = 0, share[2] = { 0, 0 }, g[2] = { 0, 0 }; // G and what P_t follows P̂ by
	std::array<double, 3> alpha, dp;
	double                touchAlpha = 0, lengthAlpha = 0;

	template <class With> void forProducts(With with)
	{
		with(normal);
		if (drawn.there) with(drawn), with(spare);
		for (int r = 0; r < 2; ++r)
			if (plus[r].there) with(plus[r]), with(minus[r]);
	}
};

} // namespace nonsmooth::contact
