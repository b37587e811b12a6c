// Moreau-Jean time stepping of all contacts of a scene at once.
//
// One step, in the order of the stages in `action`:
//     other engines' forces and the contacts' geometry are there already (InteractionLoop, ForceResetter, …)
//     gather     v_free = v + h (M⁻¹ F_ext + g), frames, gaps, thresholds, last step's reactions (rescaled with h)
//     solve      v⁺ = v_free + M⁻¹ Hᵀ P with (P, H v⁺) on the graphs of contact/plane/law.hpp, nonlinear Gauss-Seidel
//     scatter    reactions P/h into the interactions and O.forces, energies, slip
//     NewtonIntegrator(damping=0) then does v⁺ = v + h (M⁻¹ F + g) and x⁺ = x + h v⁺ (θ = 1)
// Positions: an open gap may close but not more, which stands in the normal bias. An overlap or a bond's error at the
// end of the step is taken back by the
// share κ, by displacements that leave no velocity behind (contact/plane/solver.hpp):  x ← x + D  before the integrator moves it. Where D would change the angular
// momentum (Σ m D × v), pairs of tangential impulses keep it. No overlap adds up, and the energy that it costs is
// counted (correctionEnergy).
#pragma once

#include "../seam/Advance.hpp"
#include "../seam/BackgroundRun.hpp"
#include "../seam/ContactSeam.hpp"
#include "../space/SpaceSeam.hpp"
#include "../seam/StageClock.hpp"
#include <contact/plane/solver.hpp>
#include <core/GlobalEngine.hpp>
#include <core/Omega.hpp>
#include <functional>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

class ContactDynamicsEngine : public GlobalEngine {
public:
	void action() override;
	/// Makes bonds at all real interactions of bondable pairs whose gap is below Δ; returns how many.
	int bond();
	/// Ends all bonds without counting them as broken; returns how many.
	int unbond();
	/// Takes the strengths of all contacts from the materials anew.
	void updateStrengths();
	void forgetEnergies();
	/// While the ramp of gravity lasts: gives the integrator what is due in a step that begins at `time` [s]; ends
	/// the ramp when all of it is due.
	void                  growGravity(NewtonIntegrator& newton, Real time);
	void                  forgetBreaks();
	boost::python::dict   energies() const;
	boost::python::dict   stageSeconds() const;
	boost::python::object bodyTable() const;
	boost::python::object contactTable() const;
	boost::python::object breakTable() const;
	/// What a step keeps of one contact of disks, {form: bytes}; doc/theory/stepping.rst has them in a table.
	static boost::python::dict contactForms();
	/// Brings YADE's bodies and interactions up to date.
	void view() const;
	/// A scene is saved as it is: its engines come before its bodies and interactions.
	void        preSave(ContactDynamicsEngine&);
	long        viewsSoFar() const { return nscd::Resident::of(*Omega::instance().getScene())->shown; }
	std::string viewedBy() const { return nscd::Resident::of(*Omega::instance().getScene())->shownTo; }
	/// Writes the last step's contact problem, see contact/plane/problem_file.hpp.
	void dump(const std::string& path) const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ContactDynamicsEngine,GlobalEngine,
R"""(Contact Dynamics (Moreau 1988, Jean 1999) for rigid disks in the x-y plane: finds the reactions of all contacts that
:yref:`Law2_ScGeom_NscdPhys_SignoriniCoulomb` keeps, such that velocities at the end of the step obey the law. Place it after
:yref:`InteractionLoop` and every engine that adds forces, before :yref:`NewtonIntegrator`\ (damping=0). Gravity is the integrator's.
Bodies need blockedDOFs='zXY' and a disk's mass and inertia (:yref:`yade.nonsmooth.scene.disk`); bodies with blocked DOFs are walls, and their
velocity drives the others. If a script or an engine moves a wall by ``state.pos`` or ``state.ori`` time after time, the wall has the velocity that follows from
its places. A wall that is placed once, or from far away, has none.

The solve ends when the natural-map residual (rms over contacts, relative to the rms reaction, from velocities computed anew) is below
:yref:`tolerance<ContactDynamicsEngine.tolerance>` and no body is left without what bears it (:yref:`residualSpeed<ContactDynamicsEngine.residualSpeed>`), unless :yref:`stoppingTest<ContactDynamicsEngine.stoppingTest>` names another test. Energies dissipated go to O.energy if O.trackEnergy: contactSliding, contactRolling, contactDebonding
and contactImpact. The same scene gives the same bits on any number of threads.)""",
		((Real,tolerance,1e-4,,"A step is solved when its residual is below this [-], or when the figures of another stoppingTest are."))
		((string,stoppingTest,"naturalMap",,"What tolerance is compared with: 'naturalMap' (the residual), or one of LMGC90's tests of the change "
		        "of relative velocity that one more visit of a contact would make: 'Quad' (rms over active contacts), "
		        "'Maxm' (largest) or 'QM/16' (rms, and largest below 16.666 tolerances). The residual is measured and "
		        "reported in any case."))
		((string,precision,"mixed",,"Precision of the sweeps: 'mixed' (single precision as far as a tolerance of 1e-5 or more allows, "
		        "then double precision, in which velocities and residual are computed again) or 'double'. With "
		        "another stoppingTest all sweeps are in double precision."))
		((int,maxIterations,2000,,"Most sweeps of a step. After them the step stays unsolved, and a warning says so where it matters. A "
		        "sweep visits each contact once."))
		((string,method,"accelerated",,"'accelerated' (Gauss-Seidel inside Nesterov's extrapolation) or 'gaussSeidel' (plain)."))
		((int,checkEvery,10,,"Sweeps between two computations of the residual. If it is 15 or less, parts of the packing with next "
		        "to no residual are not swept until the next one."))
		((Real,relaxationRate,0.2,,"Share κ of an overlap, or of an error of a bond's length, that one step corrects by displacements "
		        "that leave no velocity behind [-]; 0: errors of position are not corrected."))
		((Real,correctionSpeed,1,,"Largest speed of that correction [m/s]."))
		((Real,correctionSlack,1e-4,,"Overlaps and errors of bonds' lengths up to this [ℓ] are not corrected. A packing in which each step "
		        "corrects even the smallest errors does not come to rest."))
		((int,correctionSweeps,10,,"Sweeps that find these displacements; later steps correct what remains."))
		((Real,openGap,0.05,,"The solve leaves out a contact whose gap is wider than this [ℓ] and would stay so at 1.2 times its "
		        "present speed of approach, unless the solution would close it."))
		((int,maxImpacts,1000,,"Most impacts of one body that are followed one after the other within a step, where impacts with "
		        "restitution cause others. Later ones are left to the solve, with a warning. 0: all impacts are left "
		        "to the solve, which stops a body without restitution if it is hit across a gap that closes in the "
		        "same step."))
		((Vector3r,finalGravity,Vector3r::Zero(),,"Gravity at the end of its ramp [m/s²], see gravityRamp."))
		((Real,gravityBegin,0,,"O.time at which the ramp of gravity begins [s]; until then there is none."))
		((Real,gravityRamp,0,,"Time in which gravity grows in proportion from nothing to finalGravity [s]: at the head of each step "
		        "the integrator's gravity becomes what is due at O.time. When it has grown the ramp is over, and this "
		        "is 0 again; 0: the integrator's gravity is left alone."))
		((int,iterations,0,(Attr::readonly|Attr::noSave),"Sweeps of the last step."))
		((Real,residual,0,(Attr::readonly|Attr::noSave),"Residual of the last step [-]."))
		((Real,residualForce,0,(Attr::readonly|Attr::noSave),"The same as a force: rms over contacts of what the reactions miss of the law's graphs [N]."))
		((Real,residualSpeed,0,(Attr::readonly|Attr::noSave),"What relative velocities of the last step miss of the law's graphs, each as a share of what it "
		        "misses and of the bodies' change of velocity by contacts: rms over contacts that act [-]. It sees a "
		        "light body among heavy ones, which residual does not; a step is solved when it is below 0.1 and "
		        "residualSpeedWorst below 0.3; where one body has 30 times the mass of another, below 100 and 1000 "
		        "tolerances."))
		((Real,residualSpeedWorst,0,(Attr::readonly|Attr::noSave),"The largest of these shares, of a contact's point and without rolling [-]; 1 where a body falls "
		        "through another."))
		((Vector2i,residualSpeedPair,Vector2i(-1,-1),(Attr::readonly|Attr::noSave),"Bodies with the largest share in the last step, the lower id first, where it was not solved; (-1, "
		        "-1) where it was."))
		((int,patches,0,(Attr::readonly|Attr::noSave),"Patches of contacts that were solved at once in the last step, around bodies with 30 times the mass "
		        "of one that they touch; each as often as it was."))
		((Real,contactRate,0,Attr::readonly,"With a :yref:`NonsmoothTimeStepper`: largest speed of two bodies in contact against each other at "
		        "the end of the last step [ℓ/s]; at a wall its normal component."))
		((Real,bondRate,0,Attr::readonly,"With a :yref:`NonsmoothTimeStepper`: largest rate at which a bond crosses its ellipse at the end of "
		        "the last step [1/s]."))
		((int,lastIterations,0,(Attr::readonly|Attr::hidden),"iterations, saved with the scene."))
		((bool,lastUnsolved,false,(Attr::readonly|Attr::hidden),"The last step ended above the tolerance."))
		((int,unconverged,0,Attr::readonly,"Steps so far that ended above the tolerance, whether by much or by little: see unsolved."))
		((int,unsolvedOnEnd,0,(Attr::readonly|Attr::hidden),"The last steps, one after the other, that missed the tolerance by ten times and more."))
		((int,unsolved,0,Attr::readonly,"Times so far that a warning was due: ten steps in a row ended above ten tolerances, with forces that "
		        "matter beside a body's weight; or one did, by more than a body's mean weight."))
		((long,steps,0,Attr::readonly,"Steps so far."))
		((long,totalIterations,0,Attr::readonly,"Sweeps so far."))
		((Real,overlapWorst,0,(Attr::readonly|Attr::noSave),"Largest overlap at the beginning of the last step [ℓ]."))
		((Real,overlapMean,0,(Attr::readonly|Attr::noSave),"Mean overlap [ℓ] of contacts that touch or carry force, bonds over gaps included."))
		((Real,overlapWorstEver,0,Attr::readonly,"Largest overlap of any step so far [ℓ]."))
		((Vector2i,overlapWorstPair,Vector2i(-1,-1),(Attr::readonly|Attr::noSave),"Bodies with the largest overlap at the beginning of the last step, the lower id first; (-1, -1): none overlap."))
		((int,overlappedSteps,0,Attr::readonly,"Steps so far that began with an overlap of 0.05 ℓ or more, of which a warning tells."))
		((Real,wayWorst,0,(Attr::readonly|Attr::noSave),"Longest way of a disk in the last step, against walls and bodies whose motion is given [its radius]. "
		        "Up to 1 no disk passes a wall that it did not touch before."))
		((Real,wayWorstEver,0,Attr::readonly,"Longest way of a disk in any step so far [its radius]."))
		((int,farSteps,0,Attr::readonly,"Steps so far in which a disk moved by more than its radius, of which a warning tells."))
		((int,drivenSteps,0,Attr::readonly,"Steps so far in which two bodies whose DOFs are all blocked were driven into each other, of which a "
		        "warning tells."))
		((int,contacts,0,(Attr::readonly|Attr::noSave),"Contacts that touch or carry force."))
		((int,candidates,0,(Attr::readonly|Attr::noSave),"Contacts in the solve, open ones included."))
		((int,bonds,0,(Attr::readonly|Attr::noSave),"Living bonds: of the last step, or those that there were after a bond() or unbond() since."))
		((int,brokenTension,0,Attr::readonly,"Bonds broken so far by tension."))
		((int,brokenShear,0,Attr::readonly,"Bonds broken so far by shear."))
		((int,brokenTorque,0,Attr::readonly,"Bonds broken so far by torque."))
		((int,brokenTwisting,0,Attr::readonly,"Bonds broken so far by twisting, in space."))
		((int,brokenMixed,0,Attr::readonly,"Bonds broken so far by more than one of these."))
		((vector<Real>,breakLog,,(Attr::readonly|Attr::hidden),"Rows of seven numbers, see breakTable."))
		((Real,kineticEnergy,0,(Attr::readonly|Attr::noSave),"Kinetic energy of moving bodies at the beginning of the last step [J]."))
		((Real,potentialEnergy,0,(Attr::readonly|Attr::noSave),"Potential energy −Σ m g·x of moving bodies, at the same time [J]."))
		((Real,externalWork,0,Attr::readonly,"Work of other engines' forces so far [J]."))
		((Real,wallWork,0,Attr::readonly,"Work of driven bodies so far [J]."))
		((Real,slidingLoss,0,Attr::readonly,"Energy dissipated by sliding so far [J]."))
		((vector<Real>,wallSlidingLoss,,Attr::readonly,"Part of :yref:`slidingLoss<ContactDynamicsEngine.slidingLoss>` by walls, :yref:`Segments<Segment>` "
		        "[J]: a number for each id up to the last wall that something has slid on."))
		((Real,rollingLoss,0,Attr::readonly,"Energy dissipated by rolling so far [J]."))
		((Real,debondingLoss,0,Attr::readonly,"Energy dissipated by contacts in tension so far [J]."))
		((Real,impactLoss,0,Attr::readonly,"Energy dissipated by impact so far [J]."))
		((Real,missedRestitution,0,Attr::readonly,"Part of :yref:`impactLoss<ContactDynamicsEngine.impactLoss>` at contacts with restitution that "
		        "closed in a step as other contacts or forces pushed, and got none: e² of what they lost [J]. A "
		        "warning tells when it passes 1 % of the largest kinetic energy so far."))
		((int,impactsFollowed,0,(Attr::readonly|Attr::noSave),"Impacts of the last step that were followed one after the other, because they led to others."))
		((int,overrunSteps,0,Attr::readonly,"Steps so far in which a body had more than maxImpacts impacts, of which a warning tells."))
		((Real,kineticMost,0,(Attr::readonly|Attr::hidden),"Largest kinetic energy since the balance began [J]."))
		((Real,missedTold,0,(Attr::readonly|Attr::hidden),"missedRestitution of the last warning [J]."))
		((Real,correctionEnergy,0,Attr::readonly,"Energy that bodies have got so far by taking back overlaps and bonds' errors [J]: what it lifts them "
		        "against gravity, what the impulses that keep the angular momentum add to their kinetic energy, and "
		        "what tension does in bonds that do not open, which is nothing but for errors of the step; negative "
		        "where it lets them down or slows them. Forces of other engines are not counted on these "
		        "displacements, here or in externalWork."))
		((Real,broughtEnergy,0,Attr::readonly,"Energy that others have brought between steps so far, less what they took [J]: kinetic and potential "
		        "energy of bodies that were added, erased, freed or blocked, moved, or given another velocity, mass "
		        "or size, and what a change of gravity does to the potential energy."))
		((Real,energyLeft,0,(Attr::readonly|Attr::hidden),"Kinetic and potential energy at the end of the last step [J]."))
		((vector<Real>,givenMotions,,(Attr::readonly|Attr::hidden),"Motion of bodies that others move by their positions, see seam/GivenMotion.hpp; written when the "
		        "scene is saved."))
		((int,sizesChanged,0,(Attr::readonly|Attr::hidden),"Disks so far whose radius was changed and of which there was something to tell."))
		((int,turnedOut,0,(Attr::readonly|Attr::hidden),"Steps so far in which a body turned about x or y."))
		((int,placedAgain,0,(Attr::readonly|Attr::hidden),"Moves of bodies by their positions so far that gave no velocity and were not the body's first."))
		((Real,energyStart,NaN,(Attr::readonly|Attr::hidden),"Kinetic and potential energy when the balance began [J]."))
		((Real,energyError,0,(Attr::readonly|Attr::noSave),"What the balance of all these misses [J]."))
		((Real,meanSpeed,0,(Attr::readonly|Attr::noSave),"Mean speed of moving bodies at the end of the last step [m/s]."))
		((Real,maxSpeed,0,(Attr::readonly|Attr::noSave),"Largest speed at the end of the last step [m/s]."))
		((Vector3r,centroid,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Centre of mass of moving bodies at the beginning of the last step [m]."))
		((Vector3r,momentum,Vector3r::Zero(),(Attr::readonly|Attr::noSave),"Their momentum at the end of the last step [N s]."))
		,
		/* ctor */
		,
		.def("view",&ContactDynamicsEngine::view,"Update O.bodies and O.interactions. This happens by itself when a run has ended, in every foreign "
		        "engine between two of the plugin's, and when the scene is saved; during a run in the background it "
		        "happens several times a second.")
		.add_property("views",&ContactDynamicsEngine::viewsSoFar,"Number of updates of O.bodies and O.interactions so far. Steps between two updates stay in arrays, "
		        "and cost less.")
		.add_property("viewedBy",&ContactDynamicsEngine::viewedBy,"Cause of the last update: an engine, the end of a run, or another.")
		.add_property("stageSeconds",&ContactDynamicsEngine::stageSeconds,"Wall time so far by the stages of a step [s], a dictionary in their order: collide "
		        "(:yref:`PlanarGridCollider`), interactions (:yref:`NscdInteractionLoop`); gather (the contact "
		        "problem of the step, all checks included), solve (its sweeps), correct (finding the displacements "
		        "that take back errors of position) and scatter (reactions and sums) of this engine; integrate "
		        "(:yref:`PlanarNewtonIntegrator`). A stage that an engine of YADE's own does has 0, see "
		        "O.timingEnabled for that; what other engines do is not in it. Not saved.")
		.add_property("stepsLeft",+[](const ContactDynamicsEngine&) { return nscd::stepsLeft(*Omega::instance().getScene()); },"Steps that :yref:`advance<ContactDynamicsEngine.advance>` still has to make, with the present one: 1 "
		        "in its last step, 0 if it is not at work, and a very large number if it has a time and no number of "
		        "steps.")
		.def("advance",&nscd::advance,(boost::python::arg("steps")=boost::python::object(),boost::python::arg("until")=boost::python::object(),boost::python::arg("view")=true),"Make ``steps`` steps as O.step() makes them, or as many as lead to the time ``until`` [s] (to within "
		        "half a step); with both, the smaller number. Returns the number of steps made. It needs no instance, "
		        "and works in scenes of any engines. The steps run in the calling thread, while other threads of "
		        "Python go on. Signals act every 20 ms, so Ctrl-C raises KeyboardInterrupt after a step. If an engine "
		        "refuses the scene, its message is raised as by O.step(). Raises RuntimeError while O.run is at work, "
		        "within a step of the same scene, with O.subStepping, and if an engine has replaced the scene; "
		        "ValueError for negative steps, a time that is not finite, neither of the two, or ids of no body; "
		        "TypeError for what is no number. With ``view`` False, O.bodies and O.interactions are not updated; "
		        "with a list of ids, only the states of these bodies are. This lasts until "
		        ":yref:`view()<ContactDynamicsEngine.view>` is called, the scene is saved, or an exception ends a "
		        "step. It is meant for programs that make many steps and read tables, engines and O.forces, which are "
		        "always up to date. New contacts of disks get an interaction in the next full update, and take less "
		        "memory until then. What a program writes into the states of these bodies counts in the next step; "
		        "what it writes elsewhere counts after the next full update. So call view() before that, and before "
		        "O.step(), O.run() or a change of O.engines. O.pause, O.stopAtIter and O.stopAtTime belong to O.run "
		        "and do not act here.")
		.staticmethod("advance")
		.def("bond",&ContactDynamicsEngine::bond,"Make a bond wherever two bodies of one layer (or a wall that bonds to all and a body) have a gap "
		        "below bondCreationDistance; run a step first, so that interactions exist. Returns the number made.")
		.def("unbond",&ContactDynamicsEngine::unbond,"Remove all bonds. Returns their number.")
		.def("updateStrengths",&ContactDynamicsEngine::updateStrengths,"Give all present contacts the strengths of their bodies' materials again (a contact copies them when "
		        "it is made); bonds and reactions stay.")
		.def("forgetEnergies",&ContactDynamicsEngine::forgetEnergies,"Restart the energy balance.")
		.def("energies",&ContactDynamicsEngine::energies,"All energies of the balance as a dictionary [J].")
		.def("bodyTable",&ContactDynamicsEngine::bodyTable,"Spheres as bytes of doubles in rows (id, x, y, r, angle, vx, vy, omega); see :yref:`yade.nonsmooth.tables`.")
		.def("contactTable",&ContactDynamicsEngine::contactTable,"Contacts of the last step as bytes of doubles in rows (id1, id2, N, T, Γ, nx, ny, gap, bonded, "
		        "broken mode, x, y).")
		.def("breakTable",&ContactDynamicsEngine::breakTable,"All bonds that broke since forgetBreaks, as bytes of doubles in rows (step, time, id1, id2, mode, x, "
		        "y); see :yref:`yade.nonsmooth.tables`.")
		.def("forgetBreaks",&ContactDynamicsEngine::forgetBreaks,"Empty the list of broken bonds (their numbers by mode stay).")
		.def("contactForms",&ContactDynamicsEngine::contactForms,"What a step keeps and makes of one contact of disks: {form: bytes}. It needs no instance.")
		.staticmethod("contactForms")
		.def("dump",&ContactDynamicsEngine::dump,(boost::python::arg("path")),"Write the contact problem of the last step, with what the solve began with and what it found, as an "
		        "HDF5 file; see nonsmooth.contact.")
		; nscd::watchBackgroundRuns() // a statement after the class's: nothing else of ours is called at every start of YADE
	);
	// clang-format on
	DECLARE_LOGGER;

	nscd::StageClock clock;

private:
	void stepInSpace(nscd::Resident& resident, nscd::StageTimer& timer, const Vector3r& gravity, int threads);
	void validate() const;
	nonsmooth::contact::SolverSettings settings() const;
	void                               account(const nscd::StepSums& sums);
	void                               recordBreaks(const nscd::Resident& resident);
	void   report(const nonsmooth::contact::SolverStatistics& statistics, Real meanWeight);
	string tellMissed(const nonsmooth::contact::SolverStatistics& statistics) const;
	string tellWorstPair();
	string tellWorstPairInSpace();
	void   reportOverlap(const std::function<int(Real)>& pairsDeeperThan);
	void   reportWay();
	void   reportDriven();
	void   reportRestitution(Real settling);
	void   reportChanges(nscd::Resident& resident);

	static constexpr Real deepOverlap
	        = 0.05; // ℓ; what a step of an ordinary run begins with is a hundredth of that

	nscd::ContactSeam                    seam;
	nscd::SpaceSeam                      inSpace;
	nonsmooth::contact::Workspace        workspace;
	nonsmooth::contact::space::Workspace workspaceInSpace;
	Real                                 stepSolved = 0; // h of the last step, 0 before it
	bool                                 wasInSpace = false; // the last step
	bool problemIsWhole                             = false; // and not half of it that of a step that was refused
};
REGISTER_SERIALIZABLE(ContactDynamicsEngine);

} // namespace yade
