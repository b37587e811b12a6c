// When to stop sweeping: by our own residual (core/residual.hpp), or by the tests that LMGC90's users know by name.
//
// LMGC90's non-linear Gauss-Seidel asks between sweeps what one more visit would make of each contact, all others
// keeping their
// impulses: P' for P. No impulse is changed by asking. With W the contact's own block of the Delassus operator, for
// each contact
//     D = W (P − P')   change of relative velocity,     R = (P + P')/2
//     e = (P·W P + P'·W P')/2 ,     s = (|W P|² + |W P'|²)/2
// and with ⟨ ⟩ the mean over the active contacts, those where R ≠ 0, its five figures are
//     velocity       √⟨D²⟩ / √⟨s⟩            largestVelocity   max |D| / √⟨s⟩
//     work           √⟨D² R²⟩ / ⟨e⟩          largestWork       max |D| |R| / ⟨e⟩
//     drift          ⟨R·D⟩ / ⟨e⟩             a measure of how far bodies go into each other on the mean
// A step is solved when all figures of the test are below the tolerance:
//     Quad    velocity, work, |drift|                         bad contacts are made up for by good ones
//     Maxm    largestVelocity, largestWork, |drift|           the worst contact decides
//     QM/16   those of Quad, and those of Maxm below 16.666 tolerances
// Source: the program itself, module nlgs (solve_nlgs while checking, compute_convergence_norms_nlgs,
// check_convergence_nlgs) as published on GitHub, and the key words' description in its command NLGS CHECK TYPE.
//
// Deviations. LMGC90 has no rolling row here: ours counts with velocities times ℓ and impulses over ℓ. W is taken row
// by row (its diagonal), which for disks leaves out only the coupling of sliding and rolling; P' is what our sweep's
// visit makes, normal row first. The first question is asked before the first sweep, so that a warm start may need
// none, then every checkEvery sweeps; LMGC90 makes a block of sweeps first.
//
// Since P' comes from the same projection, these figures are relatives of the natural map: they differ in weighting
// with W (a velocity instead of an impulse), in counting active contacts only, and in the threshold, which follows P'_n
// instead of P_n.
#pragma once

namespace nonsmooth::contact {

enum class StoppingTest { NaturalMap, Quad, Maxm, QM16 };

/// "naturalMap", "Quad", "Maxm" or "QM/16"; throws std::invalid_argument naming what was given and what would do.
StoppingTest stoppingTestOf(const char* name);

/// The five figures [-]; all 0 where no contact is active.
struct VelocityChanges {
	double velocity = 0, largestVelocity = 0, work = 0, largestWork = 0, drift = 0;
	/// What the test compares with the tolerance: the largest of its figures. Not for NaturalMap, which has its own
	/// residual.
	double figure(StoppingTest test) const;
};

/// What one more visit would change of a contact.
struct VisitChange {
	double change = 0, impulse = 0; // D² and R²
	double drift = 0, velocity = 0, energy = 0; // R·D, (|W P|² + |W P'|²)/2 and e
};

/// Sums over contacts that the figures are made of; parts can be added in any fixed order.
struct ChangeSums {
	double square = 0, largest = 0, work = 0, largestWork = 0, drift = 0, velocity = 0, energy = 0;
	long   active = 0;

	void            add(const VisitChange& contact);
	void            add(const ChangeSums& other);
	VelocityChanges changes() const;
};

} // namespace nonsmooth::contact
