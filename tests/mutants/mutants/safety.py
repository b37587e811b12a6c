"""The factor of safety: rules of the search, what is divided, trials, records: Python, judged by pytest."""
from mutant import mutant

PY = "py/nonsmooth/"
RULES, MATERIALS, MASS = (PY + f"{name}.py" for name in ("course/strength_reduction", "model/materials", "measure/failing_mass"))
SEARCH, LOADING, ASKED, WORLDS, SOFT = (
    PY + f"{name}.py" for name in ("studies/safety/search", "studies/safety/loading", "studies/safety/asked", "world/worlds", "world/soft/strengths")
)
ROCKS, SLICES = (PY + f"{name}.py" for name in ("model/rocks", "measure/slices"))
PLAIN = "plain:test_strength_reduction.py::"
ENVELOPE, CIRCLES = "test_rocks.py::", "plain:test_slices.py::"
BLOCK = "test_factor_of_safety.py::"

MUTANTS = (
    # ---- rules of the search
    mutant("safety-slow-table", PY + "studies/safety/asked.py", "if stands > longest:", "if False:", "a search waits for a table that does not come", "test_factor_of_safety.py::test_a_table_that_rises_without_end_is_refused_or_left_dry"),
    mutant("safety-halves", RULES, "min(grown, 0.5 * (s.stable + s.failed))", "min(grown, 0.5 * s.failed)", "a bracket is not halved",
           PLAIN + "test_the_bracket_holds_the_factor_and_is_as_narrow_as_asked"),
    mutant("safety-jump", RULES, "factor=min(grown, 0.5", "factor=max(grown, 0.5", "a trial loses more strength at once than a step", PLAIN + "test_no_trial_loses_more_strength_than_a_step"),
    mutant("safety-loading", RULES, "max(s.factor * LOADING_STEP, rules.least)", "max(s.factor - LOADING_STEP, rules.least)", "a slope is loaded at factors that are not halved",
           PLAIN + "test_a_slope_that_never_stands_says_so"),
    mutant("safety-within", RULES, "s.failed - s.stable <= rules.within * s.stable", "s.failed - s.stable <= rules.step * s.stable", "a bracket is as wide as a step",
           PLAIN + "test_the_bracket_holds_the_factor_and_is_as_narrow_as_asked"),
    mutant("safety-most", RULES, "min(grown, rules.most)", "grown", "a slope that stands for ever is asked beyond the largest factor", PLAIN + "test_a_slope_that_never_fails_says_so"),
    mutant("safety-moves", RULES, "seen.speed >= rules.moving_speed", "seen.speed > rules.rest_speed", "a slope that stirs has failed", PLAIN + "test_a_slope_at_rest_is_stable_after_a_while"),
    mutant("safety-quiet", RULES, "seen.broken == state.quiet_broken", "True", "a slope whose bonds break one by one rests", PLAIN + "test_a_slope_at_rest_is_stable_after_a_while"),
    mutant("safety-longest", RULES, "slope.passed(seen, rules.longest, state.began)", "slope.passed(seen, rules.longest)", "the longest time of a trial counts from the beginning of the run",
           PLAIN + "test_a_slope_that_never_rests_has_failed_in_the_end"),
    # ---- what is divided
    mutant("divided-twice", MATERIALS, "adhesion = friction / (factor", "adhesion = 1.0 / (factor", "cohesion is divided twice", PLAIN + "test_a_contact_bears_its_shear_and_its_torque_by_the_factor"),
    mutant("divided-residual", MATERIALS, "residual_friction=material.residual_friction / friction", "residual_friction=material.residual_friction", "friction without a bond stays",
           PLAIN + "test_divided_are_residual_values_and_what_slip_leaves_too"),
    mutant("divided-weakened", MATERIALS, "weak, friction=weak.friction / friction,", "weak, friction=weak.friction,", "what slip leaves is not divided",
           PLAIN + "test_divided_are_residual_values_and_what_slip_leaves_too"),
    mutant("divided-present", WORLDS, "        scene.contact_dynamics().updateStrengths()\n", "", "contacts that exist keep their strengths",
           BLOCK + "test_contacts_that_exist_have_the_divided_strengths_and_those_to_come_too"),
    mutant("divided-soft", SOFT, "set_thresholds(equivalents[a.material.id], p, a.shape.radius + b.shape.radius)", "pass", "soft bonds that exist keep their thresholds",
           BLOCK + "test_contacts_that_exist_have_the_divided_strengths_and_those_to_come_too"),
    mutant("divided-soft-wall", SOFT, "p.rollingArm = wall.rollingFriction * p.length", "p.rollingArm = wall.rollingFriction", "soft contacts with walls have a rolling arm without their length",
           BLOCK + "test_contacts_that_exist_have_the_divided_strengths_and_those_to_come_too"),
    mutant("divided-envelope", ROCKS, "math.tan(math.radians(e.friction_deg)) / factor))", "math.tan(math.radians(e.friction_deg / factor))))",
           "an angle of friction is divided, and not its tangent", ENVELOPE + "test_a_divided_envelope_is_that_of_the_table"),
    mutant("divided-envelope-cohesion", ROCKS, "found = contacts(e.cohesion / factor, angle)", "found = contacts(e.cohesion, angle)", "a divided envelope keeps its cohesion",
           ENVELOPE + "test_a_divided_envelope_is_that_of_the_table"),
    mutant("divided-envelope-residual", ROCKS, "residual_friction=material.residual_friction * friction", "residual_friction=material.residual_friction",
           "a divided envelope keeps its residual friction", ENVELOPE + "test_a_divided_envelope_is_that_of_the_table"),
    mutant("divided-envelope-walls", MATERIALS, "        quantities = REDUCED\n", "        return material\n", "walls are not divided with the envelopes of rocks",
           BLOCK + "test_a_divided_envelope_is_that_of_the_rocks_and_walls_keep_theirs"),
    mutant("divided-reach", ASKED, "most=min(made.most, high)", "most=made.most", "a search goes beyond the table that it divides by",
           BLOCK + "test_factors_stay_within_the_table_that_is_divided_by"),
    mutant("divided-reach-sides", ROCKS, "return tangent / high, tangent / low", "return tangent / low, tangent / high", "the smallest factor of a table is its largest",
           ENVELOPE + "test_an_envelope_is_divided_as_far_as_the_table_goes"),
    mutant("divided-envelope-layers", ASKED, "if name in self._chosen() and rocks.asked(", "if rocks.asked(", "rocks that are not divided must be of the table",
           BLOCK + "test_an_envelope_that_the_table_has_not_is_refused"),
    # ---- the method of slices
    mutant("slices-arm", SLICES, "arm = cosine + sine * tangent / factor", "arm = cosine + sine * tangent", "m_α knows no factor", CIRCLES + "test_published_slopes_have_their_factors"),
    mutant("slices-weight", SLICES, "top - np.maximum(bottom, base)", "top - bottom", "soil below a circle weighs on it", CIRCLES + "test_published_slopes_have_their_factors"),
    mutant("slices-side", SLICES, "sine, driving = -sine, -driving", "driving = -driving", "a slope that falls to the right has no factor", CIRCLES + "test_a_mirrored_slope_has_the_same_factor"),
    mutant("slices-lean", SLICES, "if max(y0, y1) <= y else None", "", "circles lean over the crest", CIRCLES + "test_a_vertical_cut_in_clay_stands_by_taylors_number"),
    mutant("slices-base", SLICES, "here = inside & (bottom <= base) & (base <= top)", "here = inside", "a slice has the strength of its lowest soil, and not of its base",
           CIRCLES + "test_published_slopes_have_their_factors"),
    mutant("divided-all", ASKED, "if name in self._chosen() else m", "", "materials that nobody named are divided too", BLOCK + "test_materials_that_are_not_named_stay"),
    # ---- trials
    mutant("safety-back", SEARCH, "if said[0] == reduction.STABLE:", "if said:", "a trial begins where the one before has failed", BLOCK + "test_a_dry_block_has_its_exact_factor"),
    mutant("safety-steps", SEARCH, '"step": s.steps + O.iter - s.first_step', '"step": O.iter', "steps of the series go back with the scene", BLOCK + "test_a_dry_block_has_its_exact_factor"),
    mutant("safety-loaded", LOADING, "asked.strengths(factor)", "asked.strengths(1.0)",
           "a slope that fails is loaded again as it was", BLOCK + "test_a_block_that_fails_as_it_is_has_a_factor_below_one"),
    mutant("safety-mass", MASS, "FASTEST = 0.99", "FASTEST = 1.0", "a disk that falls alone is all that fails", "plain:test_failing_mass.py"),
    mutant("safety-endless", ASKED, "water.rate > 0 and isinstance(hold, str)", "False", "a table that rises without end is let through",
           BLOCK + "test_a_table_that_rises_without_end_is_refused_or_left_dry"),
)
