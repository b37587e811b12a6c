"""Scenes of spheres in two worlds, their measures, and scripts of springs that go hard: Python, judged by pytest."""
from mutant import mutant

PY = "py/nonsmooth/"
HEAPS, WORLDS = PY + "measure/sphere_heaps.py", PY + "world/sphere_worlds.py"
GRAINS, COURSE, HOPPER, DRUM = (PY + f"studies/spheres/{name}.py" for name in ("grains", "course", "hopper", "drum"))
STRENGTHS, LISTS, BELTS, ROOM = (PY + f"world/hardening/{name}.py" for name in ("strengths", "lists", "belts", "room"))
PRESSED, CELL, TESTED, TEST = (PY + f"studies/spheres/{name}.py" for name in ("pressing", "cell", "triaxial_course", "triaxial"))
STRENGTH, COMPARED = PY + "measure/triaxial.py", PY + "studies/comparison/spheres.py"
TRIAXIAL, TESTS, RESULTS = "plain:test_triaxial_measures.py", "test_triaxial_scene.py", "test_triaxial_course.py"
TABLE = PY + "judges/yade_scripts/table.py"
MEASURES, SCENES, RUNS = "plain:test_sphere_heaps.py", "test_sphere_scenes.py", "test_sphere_course.py"
BOTH, HARDENING = "test_sphere_worlds.py", "test_hardening.py"

MUTANTS = (
    # ---- measures
    mutant("spheres-edge", HEAPS, "k = int(high[-1])", "k = int(high[0])", "the edge of a heap is where it falls below for the first time",
           MEASURES + "::test_the_edge_of_a_profile_is_where_it_falls_below_for_the_last_time"),
    mutant("spheres-top", HEAPS, "np.maximum(top[covered], c + ", "np.maximum(top[covered], c + 0 * ", "a profile takes the centres of spheres for their tops",
           MEASURES + "::test_the_profile_of_one_sphere_is_its_upper_half"),
    mutant("spheres-tilt", HEAPS, "weight = r**3\n    return", "weight = r**0\n    return", "small spheres weigh as much as large ones", 
           MEASURES + "::test_a_large_sphere_weighs_more_than_a_small_one"),
    mutant("spheres-touch", HEAPS, "touch * 2 * float(np.mean(r))", "touch * float(np.mean(r))", "spheres belong together over gaps in radii",
           MEASURES + "::test_what_rolls_ahead_and_what_is_in_the_air_is_not_of_the_mass"),
    mutant("spheres-rate", HEAPS, "(mass >= low * mass[-1])", "(mass >= 0)", "the rate of a hopper counts its beginning", MEASURES + "::test_the_rate_is_that_of_the_middle"),
    # ---- worlds
    mutant("spheres-rolling", WORLDS, "etaRoll=2 * m.rolling_friction", "etaRoll=m.rolling_friction", "springs resist rolling half as much",
           BOTH + "::test_rolling_resistance_is_the_same_in_both_worlds"),
    mutant("spheres-step", WORLDS, "masses[[2, 5]] *= 0.4", "masses[[2, 5]] *= 0.5", "the step of springs takes spheres for disks",
           BOTH + "::test_the_step_of_two_equal_spheres_is_that_of_their_spring"),
    # ---- scenes
    mutant("spheres-sizes", GRAINS, "np.sqrt(1 - drawn", "(1 - drawn", "sizes are not uniform by volume", SCENES + "::test_sizes_are_uniform_by_volume_and_have_their_mean"),
    mutant("spheres-out", COURSE, 'self.state["out_kg"] += mass', 'self.state["out_kg"] = mass', "the mass that has left a hopper is that of the last step",
           RUNS + "::test_a_hopper_loses_what_it_counts"),
    mutant("spheres-bulk", HOPPER, "part**2 * (3 - 2 * part)", "part", "a sphere that a plane cuts has the volume of a cylinder", SCENES + "::test_the_bulk_density_of_one_sphere_by_its_cap"),
    mutant("spheres-turn", DRUM, "math.sqrt(self.froude * self.gravity / self.radius)", "math.sqrt(self.froude * self.gravity / self.depth() / 2)", "a drum turns more slowly than its Froude number says",
           SCENES + "::test_a_drum_takes_its_mean_over_the_second_half"),
    mutant("spheres-endless", PY + "world/long_courses.py", "if steps <= MOST_STEPS:", "if True:", "a course without end is begun", SCENES + "::test_a_course_without_end_is_refused_with_what_would_do"),
    mutant("spheres-edgeless", PY + "studies/spheres/column.py", "edge / self.radius - 1 if edge else None", "edge / self.radius - 1", "a mass without an edge has run back to the axis",
           SCENES + "::test_a_mass_that_is_nowhere_half_a_diameter_high_has_no_run_out"),
    # ---- triaxial tests
    mutant("triaxial-cap", STRENGTH, "return x * x * (3 - 2 * x)", "return x", "a sphere that a face cuts has the volume of a cylinder", TRIAXIAL + "::test_spheres_that_faces_cut_count_with_what_is_within"),
    mutant("triaxial-again", STRENGTH, "        there &= ~out", "        there &= ~out\n        return there, np.where(there, number, 0)", "rattlers are taken out once",
           TRIAXIAL + "::test_rattlers_are_taken_out_again_and_again"),
    mutant("triaxial-late", STRENGTH, "PLATEAU = 2 / 3", "PLATEAU = 1 / 3", "the critical state begins before", TRIAXIAL + "::test_the_critical_state_is_the_mean_of_the_last_third"),
    mutant("triaxial-peak", STRENGTH, "np.argmax(major / minor)", "np.argmax(minor)", "a peak is where the sides bear most", TRIAXIAL + "::test_strengths_of_a_curve_with_a_peak"),
    mutant("triaxial-unit", TEST, "math.sqrt(self.density / self.pressure)", "math.sqrt(self.pressure / self.density)", "the unit of time is turned round",
           TESTS + "::test_the_unit_of_time_is_that_of_the_inertial_number"),
    mutant("triaxial-area", CELL, "np.prod(edges) / edges", "np.prod(edges) / edges[::-1]", "plates bear the pressure on another's area", RESULTS + "::test_three_spheres_in_a_row_between_plates"),
    mutant("triaxial-push", CELL, "[axis] + self._pushes[axis]", "[axis]", "the stress on a plate lacks what it bears", RESULTS + "::test_three_spheres_in_a_row_between_plates"),
    mutant("triaxial-share", PRESSED, "test.friction_share * getattr(test, name)", "getattr(test, name)", "dense samples are loose", RESULTS + "::test_the_pressed_sample_rests_is_dense_and_made_once"),
    mutant("triaxial-speed", TESTED, "-share * self.scene.rate", "-2 * share * self.scene.rate", "a sample is compressed twice as fast",
           RESULTS + "::test_plates_bear_the_pressure_and_contacts_tell_the_same"),
    # ---- scripts that go hard
    mutant("harden-turning", PY + "world/hardening/comparison.py", "state.ori.conjugate() * state.angVel", "state.angVel", "a body that lies askew turns about the axes of the world",
           HARDENING + "::test_the_kinetic_energy_that_is_told_has_that_of_turning"),
    mutant("harden-damping", STRENGTHS, "math.sqrt((1 - damping) / (1 + damping))", "(1 - damping) / (1 + damping)", "damping leaves less of an impact than it does",
           HARDENING + "::test_a_spring_and_its_rigid_contact_bounce_alike"),
    mutant("harden-visco-rolling", STRENGTHS, "return soft.mR / diameter", "return soft.mR / 2", "rolling resistance that is a length is taken for a number", HARDENING + "::test_a_material_keeps_its_strengths"),
    mutant("harden-pairs", STRENGTHS, "a.layer, b.layer = -2 - one, -2 - other", "a.layer, b.layer = -2, -2", "all materials have the law of one pair",
           HARDENING + "::test_a_pair_without_values_keeps_those_of_its_materials"),
    mutant("harden-meet", LISTS, "if not _meet(engine)", "if False", "spheres that a script leaves through each other collide", HARDENING + "::test_spheres_that_pass_through_each_other_still_do"),
    mutant("harden-belt", BELTS, "body.state.pos = place", "pass", "a belt goes away with what it drags", HARDENING + "::test_a_belt_drags_and_stays"),
    mutant("harden-room", ROOM, "box.state.ori.conjugate() * axis", "axis", "a box that is turned is taken for one that is not", HARDENING + "::test_a_sphere_between_boxes_with_room_is_taken"),
    mutant("scripts-explained", TABLE, 'min(fall, found.get("way [m]", 0) / size)', "fall", "what lies at rest may be anywhere after a long time",
           "test_yade_scripts.py::test_what_of_a_difference_is_explained"),
    # ---- hard against soft
    mutant("spheres-compared-reach", COMPARED, "sphere_worlds.HardSpheres.reach * max(1.0, case.step)", "sphere_worlds.HardSpheres.reach",
           "spheres of a larger step meet what they did not know of", "test_compared_spheres.py::test_numerics_of_a_hard_run_are_multiples_of_the_scenes"),
    mutant("spheres-compared-moving", COMPARED, "energy > 0.01 * energy.max()", "energy > 0", "the overlap of a collapse counts what rests",
           "test_compared_spheres.py::test_a_column_is_measured_from_its_records"),
    mutant("spheres-compared-front", COMPARED, 'series["edge_m"] - series["edge_m"][0]', 'series["edge_m"]', "the way of the edge begins at the radius",
           "test_compared_spheres.py::test_a_column_is_measured_from_its_records"),
    mutant("spheres-compared-ratio", COMPARED, '"stress": major / minor', '"stress": major / minor[0]', "σ₁ is over the σ₃ of the beginning",
           "test_compared_spheres.py::test_a_triaxial_test_in_both_worlds"),
)  # fmt: skip
