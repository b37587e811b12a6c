// Patches around mass jumps (mass_jumps.hpp), solved between the sweeps over all contacts: what they read from blocks
// and rows, and write back.
#pragma once

#include <contact/plane/interior_point.hpp>
#include <contact/plane/mass_jumps.hpp>
#include <contact/core/sweeper.hpp>
#include <contact/plane/solver.hpp>

namespace nonsmooth::contact {

class PatchSolver {
public:
	/// For a problem that is laid out in the sweeper.
	explicit PatchSolver(Sweeper<Plane, double>& sweeper);

	bool any() const { return !patches.empty(); }
	/// Solves the patches that miss more of their speed than a tenth of the tolerance, but none that would take
	/// more visits than `most`; returns whether anything has changed. The residual is then to be measured anew. One
	/// thread's work: each patch begins with what the one before left.
	bool settle(double tolerance, double most);
	/// The largest rms ϑ of a patch, as settle() left them.
	double speed() const { return worst; }
	int    solved() const { return count; } // patches that settle() has changed so far

private:
	PatchProblem read(const MassPatch& patch) const;
	void         write(const MassPatch& patch, const PatchProblem& solved);
	void         readContact(std::int32_t index, PatchProblem& to) const;

	Sweeper<Plane, double>& sweeper;
	std::vector<MassPatch>  patches;
	std::vector<std::int32_t>
	        laneOf; // of contacts, counted over all blocks; in place of those outside the complement of their row
	mutable std::vector<std::int32_t> placeIn; // of bodies in the patch at hand
	double                            worst = 0;
	int                               count = 0;
};

} // namespace nonsmooth::contact
