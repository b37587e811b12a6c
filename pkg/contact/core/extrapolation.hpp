// How sweeps are extrapolated, and when the extrapolation begins anew; the method stands in solver.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <contact/core/settings.hpp>

namespace nonsmooth::contact {

/// The β of one sweep after the other; all 0 for plain Gauss-Seidel.
class Extrapolation {
public:
	explicit Extrapolation(Method method)
	        : accelerated(method == Method::Accelerated)
	{
	}

	double next()
	{
		const double now = beta;
		if (accelerated) {
			const double after = 0.5 * (1 + std::sqrt(1 + 4 * theta * theta));
			beta               = (theta - 1) / after;
			theta              = after;
		}
		return now;
	}

private:
	bool   accelerated;
	double theta = 1, beta = 0;
};

/// Whether the extrapolation should begin anew, asked at every look at the residual.
class RestartRule {
public:
	RestartRule(double residual, int sweepsPerLook)
	        : last(residual)
	        , beforeLast(residual)
	        , least(residual)
	        , mostPatience(std::max(1, 40 / sweepsPerLook))
	{
	}

	bool asks(double residual)
	{
		least = std::min(least, residual);
		if (residual > 2 * least) { // it runs away
			patience = std::max(1, patience / 2);
			begin(residual);
			return true;
		}
		if (++looks < patience) return false;
		const bool grown = residual > beforeLast;
		if (grown) {
			patience = std::min(2 * patience, mostPatience);
			begin(residual);
		} else {
			beforeLast = last;
			last       = residual;
			looks      = 0;
		}
		return grown;
	}

private:
	void begin(double residual)
	{
		last = beforeLast = least = residual;
		looks                     = 0;
	}

	double last, beforeLast; // at the last two comparisons
	double least; // since the last restart
	int    looks = 0, patience = 1, mostPatience; // looks since and between comparisons
};

/// Whether the extrapolation gets nowhere and plain sweeps should go on, asked at every look at the residual: with much
/// friction and many gaps of the size of a step it can run in circles.
class StagnationRule {
public:
	explicit StagnationRule(double residual)
	        : least(residual)
	        , leastBefore(residual)
	{
	}

	/// `sweeps`: since the last look.
	bool asks(double residual, int sweeps)
	{
		constexpr int    window = 500; // sweeps; deep packings that are solved to 1e-6 gain a third in as many
		constexpr double gain   = 0.9;
		least                   = std::min(least, residual);
		if ((made += sweeps) < window) return false;
		const bool stagnates = least > gain * leastBefore;
		leastBefore          = least;
		made                 = 0;
		return stagnates;
	}

private:
	double least, leastBefore; // so far, and at the beginning of the window
	int    made = 0; // sweeps in the window
};

} // namespace nonsmooth::contact
