"""State that outlives what it belongs to: bodies that are gone, ids that are used again, steps that are refused or made again, what other threads write, numbers that nobody checks."""
from mutant import mutant

SHOW, RESIDENT, RESIDENT_H, TURN = "pkg/dem/seam/ResidentShow.cpp", "pkg/dem/seam/Resident.cpp", "pkg/dem/seam/Resident.hpp", "pkg/dem/seam/Turn.cpp"
MAT, PHYS, PHYS_H, COLLIDER = "pkg/dem/materials/NscdMat.cpp", "pkg/dem/materials/NscdPhys.cpp", "pkg/dem/materials/NscdPhys.hpp", "pkg/dem/engines/PlanarGridCollider.cpp"
LOOP, ENGINE, WATER, PLATE = "pkg/dem/engines/NscdInteractionLoop.cpp", "pkg/dem/engines/ContactDynamicsEngine.cpp", "pkg/dem/engines/PorePressureEngine.cpp", "pkg/dem/engines/PlateLoadEngine.cpp"
GIVEN, STEPPER, ELLIPSE, CHECK = "pkg/dem/seam/GivenMotion.cpp", "pkg/dem/engines/NonsmoothTimeStepper.cpp", "pkg/dem/engines/BondEllipseEngine.cpp", "pkg/dem/checks/SceneCheck.cpp"
OUTLIVED, EVENTS, NUMBERS, EVERY = "test_outlived_state.py", "test_state_events.py", "test_numbers_without_sense.py", "test_every_number.py"
BACKGROUND, WATCHED = "py/nonsmooth/world/background.py", "test_background.py"

MUTANTS = (
    # ---- written to beside a run
    mutant("beside-place", SHOW, "if (number == known) number = known = now;", "if (number == known && now == 0) number = known = now;", "a body that is written to stays where it was shown",
           OUTLIVED + "::test_a_body_that_is_written_to_beside_a_run_goes_on"),
    mutant("beside-yielded", SHOW, "r.bonded && phys.bonded", "r.bonded && phys.bonded && !isWritten", "what a bond has yielded is lost where a script writes into its contact",
           OUTLIVED + "::test_a_contact_that_is_written_to_beside_a_run_keeps_what_its_bond_has_yielded"),
    mutant("beside-errors", SHOW, "phys.errorSlip = r.slip;", "phys.errorSlip = 0;", "a look between loop and solver loses what a bond has slipped",
           OUTLIVED + "::test_a_look_between_loop_and_solver_changes_nothing"),
    # ---- bodies and ids
    mutant("slip-owner", MAT, "if (nscd::isSame(owners[id], body)) return;", "return;", "a body begins with the slip of the one that had its id",
           OUTLIVED + "::test_slip_belongs_to_a_body_and_not_to_its_id"),
    mutant("water-owner", WATER, "id < known && !nscd::isSame(owners[id], bodies[id])", "false", "a body is released because the one that had its id was",
           OUTLIVED + "::test_water_knows_a_body_from_the_one_that_had_its_id"),
    mutant("ellipse-owner", ELLIPSE, "!holds(contact.get()) || !nscd::isSame(contacts[k], contact)", "!holds(contact.get())", "a soft bond of later bodies is broken",
           OUTLIVED + "::test_a_soft_bond_of_later_bodies_is_not_taken_for_the_one_that_was_followed"),
    mutant("given-owner", GIVEN, "at->known && !isSame(at->body, (*scene.bodies)[id])", "false", "another body of the same id has moved",
           "test_given_motion.py::test_another_body_of_the_same_id_has_not_moved"),
    mutant("sure-reach-changed", COLLIDER, "sureReach != sureReachOfLists", "false", "a changed sure reach counts with the next search",
           OUTLIVED + "::test_a_sure_reach_that_is_changed_counts_at_once"),
    # ---- materials and bonds
    mutant("renew-class", PHYS, "if (isSameKind(old, *made)) return;", "return;", "a wall keeps the law of its former material", OUTLIVED + "::test_a_wall_takes_the_law_of_its_new_material"),
    mutant("renew-bond", PHYS, "static_cast<NscdPhys&>(*made) = old;", "setStrengths(*made, b1, b2);", "a bond is lost where its wall weakens now",
           OUTLIVED + "::test_a_bond_survives_that_its_wall_weakens_now"),
    mutant("bond-wanted", LOOP, "bond.marks.normal.x == 0 && bond.marks.normal.y == 0", "false", "a bond that a script sets lives for ever", OUTLIVED + "::test_a_bond_that_a_script_sets_is_a_bond"),
    mutant("bond-forgets", PHYS_H, "if (!bonded) axis = Vector3r::Zero();", "", "a bond that is set again has its old marks", OUTLIVED + "::test_a_bond_that_is_set_again_is_a_new_one"),
    mutant("written-nan", PHYS_H, "std::isnan(tangensOfFrictionAngle) && std::isnan(currentFriction)", "false", "a friction that is mended is written over",
           OUTLIVED + "::test_a_problem_is_not_half_of_a_step_that_was_refused"),
    mutant("reset-heard", RESIDENT, "r.phys->hearReset();", "", "forces that were reset once are never shown again", OUTLIVED + "::test_forces_that_a_script_has_reset_are_found_anew_and_kept"),
    # ---- steps
    mutant("step-again", STEPPER, "chosenIter == scene->iter && chosenTime == scene->time", "false", "a step that is made again is longer", OUTLIVED + "::test_a_step_that_is_made_again_has_the_same_length"),
    mutant("step-new", STEPPER, "(scene->iter > 0 || solver->steps == chosenSteps)", "true", "steps stop growing where time is reset", OUTLIVED + "::test_a_step_that_is_made_again_has_the_same_length"),
    mutant("given-refused", GIVEN, "bodies = before;", ";", "a refused step counts for a wall's motion",
           OUTLIVED + "::test_a_wall_that_is_moved_by_its_place_does_not_count_a_refused_step"),
    mutant("interface-number", "pkg/dem/seam/ContactSeamScatter.cpp", "++allSteps", "scene.iter",
           "slip along an interface is lost where time is reset", OUTLIVED + "::test_slip_along_an_interface_counts_though_steps_have_the_same_number"),
    mutant("joints-number", "pkg/dem/seam/PerScene.hpp", "scene.iter + long(scene.forces.syncCount << 32)", "scene.iter", "joints are those of an earlier step with that number",
           OUTLIVED + "::test_joints_of_walls_are_looked_up_in_each_step_though_it_has_the_same_number"),
    mutant("dump-whole", ENGINE, "problemIsWhole = false;", "problemIsWhole = true;", "half of a refused step's problem is written", OUTLIVED + "::test_a_problem_is_not_half_of_a_step_that_was_refused"),
    mutant("advance-within", "pkg/dem/seam/Advance.cpp", "begun == &scene", "false", "advance() makes steps within a step", OUTLIVED + "::test_an_advance_within_a_step_is_refused"),
    mutant("engines-unseen", "pkg/dem/seam/Turn.cpp", "isTooLate(scene, engine)", "false", "YADE's engines work on bodies as they were", OUTLIVED + "::test_engines_that_are_exchanged_while_nothing_is_shown"),
    mutant("forces-late", "pkg/dem/engines/WallForceEngine.cpp", "scene->forces.sync();", "", "a force that is added late ends the run", OUTLIVED + "::test_the_sums_of_a_wall_after_a_force_was_added_behind_the_integrator"),
    # ---- runs in the background
    mutant("background-late", BACKGROUND, "if message is not None:\n        _heard(message)", "if False:\n        _heard(message)", "an error before the waiting begins is not raised",
           WATCHED + "::test_what_ended_a_run_is_raised_by_who_waits_later_and_once"),
    mutant("background-anew", BACKGROUND, "        _keep(stop=True)\n", "", "an error is forgotten where a scene is loaded", WATCHED + "::test_an_error_that_nobody_has_heard_of_ends_the_process_with_1"),
    mutant("background-status", BACKGROUND, "status or 1", "status", "a process whose run was ended by an error ends as done", WATCHED + "::test_an_error_that_nobody_has_heard_of_ends_the_process_with_1"),
    mutant("background-heard", BACKGROUND, "_unheard.remove(message)", "pass", "a script that has heard of an error ends with it", WATCHED + "::test_the_same_error_heard_later_is_heard"),
    mutant("launcher-dashes", "scripts/yade-nonsmooth", '"-j$threads" -- "${script[@]}"', '"-j$threads" "${script[@]}"', "a script does not get its first --",
           "test_load.py::test_yades_options_and_the_scripts_own"),
    mutant("launcher-number", "scripts/yade-nonsmooth", 'threads=$2; check_threads "$1" "$threads"; shift 2', "threads=$2; shift 2", "the script's name is taken for a number of threads",
           "test_load.py::test_launcher_refuses_bad_calls"),
    # ---- numbers
    mutant("sense-arc", "pkg/dem/checks/ContactCheck.cpp", "arc->halfAngle > 0 && arc->halfAngle <= Mathr::PI * (1 + 1e-12)", "true", "an arc without an opening is no wall", NUMBERS + "::test_a_wall_that_no_disk_could_touch"),
    mutant("sense-reach", "pkg/dem/checks/ContactCheck.cpp", "value >= 0 && std::isfinite(value)", "true", "a law that looks nowhere lets disks through", NUMBERS + "::test_a_law_that_looks_nowhere"),
    mutant("sense-ellipse", PHYS, "bonded && !(one.second > 0)", "false", "a bond without an ellipse lives for ever", OUTLIVED + "::test_a_bond_without_an_ellipse"),
    mutant("sense-water", WATER, "value >= 0 && nscd::isNumber(value)", "true", "water of no weight wets all", NUMBERS + "::test_water_of_no_weight"),
    mutant("sense-normal", WATER, "gravity.dot(normal) > 0", "false", "a table upside down is taken", EVERY + "::test_a_number_is_refused_by_its_name_or_harmless"),
    mutant("sense-rail", PLATE, "std::abs(beside) <= length", "true", "a plate is pulled to a way far from it", EVERY + "::test_a_number_is_refused_by_its_name_or_harmless"),
    mutant("sense-hugest", "pkg/dem/checks/Refusal.hpp", "std::abs(value) <= hugest", "!std::isnan(value)", "numbers whose squares are none are taken", EVERY + "::test_a_number_is_refused_by_its_name_or_harmless"),
    mutant("sense-sure-reach", "pkg/dem/checks/ContactCheck.cpp", "collider->sureReach < std::min(least, reach)", "false", "slow disks over a gap are not found", EVERY + "::test_a_number_is_refused_by_its_name_or_harmless"),
    mutant("sense-set", MAT, "weakenedTensileStrength >= 0 && nscd::isNumber(weakenedTensileStrength)", "true", "a wall is weakened to a strength that is none",
           "test_messages.py::test_strengths_of_a_material_that_no_contact_has"),
)
