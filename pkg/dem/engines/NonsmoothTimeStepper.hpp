// The time step of rigid contacts: as large as accuracy allows, since nothing but accuracy limits it.
//
// Over a step the solver takes contacts as they lie at its beginning. With u the relative velocity of two bodies'
// centres (at a wall: its normal component, as sliding along a straight wall changes nothing), ℓ their mean diameter,
// and d the displacement of a bond's mark in its ellipse,
//     h ≤ path ℓ / |u|                         for every contact: its normal turns by less than `path` in a step, its overlap by path²/2 ;
//     h ≤ bondPath / max(|ḋ_n|/(ε_n ℓ), |ḋ_t|/(ε_t ℓ))   for every bond: it crosses its ellipse in 1/bondPath steps or more.
// Both rates are those of the last step's end. A step grows by the factor `growth` at most, and not at all after one
// that the solver left unsolved or that took more than `sweeps` sweeps; it shrinks at once. A step that is made again,
// since it was refused or an exception ended it, begins with the same choice.
#pragma once

#include <core/GlobalEngine.hpp>

namespace yade {

class NonsmoothTimeStepper : public GlobalEngine {
public:
	enum Limit { Largest = 0, Contacts, Bonds, Growth, Sweeps, Smallest };
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(NonsmoothTimeStepper,GlobalEngine,
R"""(Sets O.dt for :yref:`ContactDynamicsEngine`: the largest step that the speeds of bodies in contact and the lengths of bonds allow, within limits.
Place it first in O.engines, and set O.dt to a small step to begin with. The choice rests on the last step alone and is saved with the scene, so the same scene gives the same steps, on any number of
threads and after loading.)""",
		((Real,smallest,1e-4,,"Smallest step [s]."))
		((Real,largest,1e-2,,"Largest step [s]."))
		((Real,path,0.05,,"Way that two bodies in contact may move against each other in a step [ℓ]."))
		((Real,bondPath,0.5,,"Share of its ellipse that a bond may cross in a step."))
		((Real,growth,1.05,,"Largest ratio of a step to the one before."))
		((int,sweeps,0,,"A step that took more sweeps is not followed by a larger one; 0: sweeps do not matter."))
		((int,limit,Largest,Attr::readonly,"What decided the last step: 0 largest, 1 contacts, 2 bonds, 3 growth, 4 sweeps, 5 smallest."))
		((Real,before,0,(Attr::readonly|Attr::hidden),"Step before the last one that was chosen [s]."))
		((Real,chosen,0,(Attr::readonly|Attr::hidden),"The last one that was chosen [s], and below when: O.iter, O.time and ContactDynamicsEngine.steps."))
		((long,chosenIter,-1,(Attr::readonly|Attr::hidden),""))
		((Real,chosenTime,0,(Attr::readonly|Attr::hidden),""))
		((long,chosenSteps,-1,(Attr::readonly|Attr::hidden),""))
	);
	// clang-format on
private:
	void validate() const;
};
REGISTER_SERIALIZABLE(NonsmoothTimeStepper);

} // namespace yade
