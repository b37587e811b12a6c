"""What scripts and other engines do between two steps: written contacts, walls moved by their positions, sizes, what bodies bring; and the refusals of what leaves the plane."""
from mutant import mutant

PHYS, PHYS_H, READING, RESIDENT = "pkg/dem/materials/NscdPhys.cpp", "pkg/dem/materials/NscdPhys.hpp", "pkg/dem/seam/ContactState.hpp", "pkg/dem/seam/Resident.cpp"
GIVEN, SIZES, SCATTER, SEAM = "pkg/dem/seam/GivenMotion.cpp", "pkg/dem/seam/ResidentSizes.cpp", "pkg/dem/seam/ContactSeamScatter.cpp", "pkg/dem/seam/ContactSeam.cpp"
ENGINE, PLANE, CHECK, MAKE = "pkg/dem/engines/ContactDynamicsEngine.cpp", "pkg/dem/checks/PlaneCheck.cpp", "pkg/dem/checks/SceneCheck.cpp", "pkg/dem/seam/ResidentMake.cpp"
WRITTEN, MOTION, SIZE, BROUGHT = "test_written_contacts.py", "test_given_motion.py", "test_sizes.py", "test_brought_energy.py"

MUTANTS = (
    # ---- what random changes passed
    mutant("check-reset", CHECK, "scene.forces.lastReset < scene.iter", "scene.forces.lastReset > scene.iter", "forces that nobody resets act again",
           "test_refusals.py::test_lists_of_engines_that_would_go_wrong"),
    mutant("check-second", "pkg/dem/checks/ContactCheck.cpp", "std::find_if(first + 1, bodies.end(), isDisk)", "std::find_if(first + 2, bodies.end(), isDisk)", "two disks alone need no functor",
           "test_refusals.py::test_two_disks_need_a_functor"),
    mutant("space-from-lower", "pkg/dem/space/SpaceContacts.cpp", "ball1 && ball2 ? id1 > id2 : ball1", "ball1", "contacts of spheres run from the higher id", "test_space.py::test_the_problem_of_a_step_is_written_and_solved_again"),
    mutant("space-breaks", "pkg/dem/space/SpaceSeamScatter.cpp", "broken.insert(broken.end(), part.breaks.begin(), part.breaks.end());", "broken = part.breaks;", "breaks of all but the last part of the contacts are forgotten", "test_space.py::test_sums_over_many_contacts_are_the_same_on_any_number_of_threads"),
    mutant("space-parts", "pkg/dem/space/SpaceSeamScatter.cpp", "scatterContact(k, parts[part])", "scatterContact(k, parts[part % threads])", "sums in space depend on the number of threads", "test_space.py::test_sums_over_many_contacts_are_the_same_on_any_number_of_threads"),
    mutant("space-held", "pkg/dem/space/SpaceSeamScatter.cpp", "rows.n < 0 && held", "held", "a bond that is pressed loses nothing", "test_space.py::test_a_bonded_tower_that_lands_loses_all_it_had_by_the_impact"),
    mutant("field-dry", "pkg/dem/engines/PorePressureEngine.cpp", "!(water.pressure > 0)", "!(water.pressure >= 0)", "ground without pressure is wet", "test_pressure_field.py::test_ground_without_pressure_is_dry"),
    # ---- written contacts
    mutant("written-residual", PHYS, "friction = residualFriction = tangensOfFrictionAngle", "friction = tangensOfFrictionAngle",
           "a written friction is that of bonds alone", WRITTEN + "::test_set_contact_friction_counts_from_the_next_step_on"),
    mutant("written-known", RESIDENT, "r.phys->isWritten()", "false", "contacts of disks do not notice what is written into them",
           WRITTEN + "::test_contacts_of_disks_hear_it_too"),
    mutant("written-overruled", PHYS, "overruled = left <= 0 && currentFriction != wanted", "overruled = false", "a friction that slip has taken away is not refused",
           WRITTEN + "::test_a_wall_that_weakens_goes_on_from_it_and_refuses_what_slip_has_taken"),
    mutant("written-stiffness", PHYS, "if (ks != 0) return \"ks\";", "", "a shear stiffness goes unheard", WRITTEN + "::test_what_a_rigid_contact_cannot_hear"),
    mutant("written-usable", READING, "makeSense(r) && !phys.unheard()", "makeSense(r)", "what no contact can hear is not refused", WRITTEN + "::test_what_a_rigid_contact_cannot_hear"),
    # ---- walls that are moved by their positions
    mutant("given-mean", GIVEN, "moved / series.time", "moved / series.time * series.steps", "a wall moved every tenth step has ten times its speed",
           MOTION + "::test_a_piston_gives_its_speed"),
    mutant("given-end", GIVEN, "s.steps >= s.interval", "false", "a wall that stands has the speed of its last motion",
           MOTION + "::test_a_wall_that_was_moved_and_stands_is_at_rest"),
    mutant("given-once", GIVEN, "!again || series.steps > Real(longest)", "again && series.steps > Real(longest)", "a wall that is placed once has a speed",
           MOTION + "::test_a_wall_that_is_placed_once_gives_no_speed"),
    mutant("given-back", GIVEN, "std::signbit(moved) != std::signbit(own)", "false", "a belt that is put back does not drag", MOTION + "::test_a_belt_that_is_put_back_keeps_its_own_velocity"),
    mutant("given-far", GIVEN, "back || late || far || (jumps && series.steps > 1)", "back || late", "a wall that is put far away has a speed",
           MOTION + "::test_jumps_and_moves_after_long_are_places_and_are_told_of"),
    mutant("given-lift", GIVEN, "m.position.y - was.position.y", "m.position.y", "a lift has a speed by its height",
           MOTION + "::test_a_lift_gives_its_speed_wherever_it_is"),
    mutant("given-kept", GIVEN, "at->id == ids[k]", "false", "a wall that is moved stands for a moment where another one comes or goes",
           MOTION + "::test_a_piston_goes_on_where_other_walls_come_and_go"),
    mutant("given-angle", GIVEN, "to.z * from.w - to.w * from.z", "to.w * from.z - to.z * from.w", "a wheel turns the other way",
           MOTION + "::test_a_disk_is_turned_by_a_wheel_that_is_turned_by_its_orientation"),
    mutant("given-saved", ENGINE, "if (stepSolved != 0) givenMotions = seam.givenMotion.numbers();", "", "a motion is forgotten in a saved scene",
           MOTION + "::test_the_motion_goes_on_after_a_load_with_the_same_bits"),
    # ---- sizes
    mutant("sizes-inertia", SIZES, "s.mass * (radius * radius) / inertia", "s.mass * radius / inertia", "the inertia of a disk that grows is not its own", SIZE + "::test_a_disk_stays_a_disk"),
    mutant("sizes-own-mass", SIZES, "(!left && !grown) || (grown && isSphere)", "grown && isSphere", "a mass that a script has set is overwritten",
           SIZE + "::test_what_a_script_has_chosen_stays"),
    mutant("sizes-thresholds", PHYS, "length  = newLength;", "length = newLength; tensileForce /= ratio;", "a bond's strength stays where its disks grow",
           SIZE + "::test_contacts_follow_with_length_thresholds_and_bonds"),
    mutant("sizes-marks", SIZES, "b.radius / former.radius", "1.0", "a bond's marks stay where they were in a disk that grows", SIZE + "::test_bonds_live_while_disks_grow_slowly"),
    # ---- what others bring
    mutant("brought-left", ENGINE, "energyLeft = s.kineticLeft + s.potentialLeft;", "energyLeft = now;", "what gravity and contacts do in a step was brought by others",
           BROUGHT + "::test_nothing_is_brought_where_nobody_brings_anything"),
    mutant("brought-error", ENGINE, "now - energyStart - broughtEnergy", "now - energyStart", "what bodies bring is an error", BROUGHT + "::test_what_changes_bring"),
    mutant("brought-plate", SCATTER, "gravity[1] * v1.y", "-gravity[1] * v1.y", "a plate that is lifted does the work", BROUGHT + "::test_a_driven_direction_of_a_body_that_is_free_along_another_is_the_walls_work"),
    # ---- out of the plane
    mutant("plane-about-y", PLANE, "std::abs(torque[0]) + std::abs(torque[1])", "std::abs(torque[0])", "a torque about y is let through", "test_plane.py::test_forces_and_torques"),
    mutant("plane-gyration", PLANE, "std::sqrt(inertia / mass)", "inertia / mass", "the rounding of torques has the wrong unit", "test_plane.py::test_rounding_is_none_of_it"),
    mutant("plane-ramp", ENGINE, "gravityRamp > 0 ? finalGravity : Vector3r(Vector3r::Zero())", "Vector3r(Vector3r::Zero())", "gravity may grow out of the plane",
           "test_plane.py::test_gravity_that_grows_out_of_the_plane"),
    mutant("plane-readers", CHECK, "reset && readsForces(*engine)", "false", "engines that read forces may stand where there are none",
           "test_plane.py::test_readers_of_forces_before_the_solver_are_refused"),
    # ---- counts
    mutant("bonds-bare", MAKE, "return { count, all + count };", "return { count, count };", "bonds of contacts without interactions are not counted",
           "test_messages.py::test_bonds_of_contacts_that_have_no_interaction_are_counted_too"),
)
