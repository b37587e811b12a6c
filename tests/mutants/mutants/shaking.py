"""Earthquakes: motions of the ground, Newmark's block, their figure: Python, judged by pytest without YADE."""
from mutant import mutant

PY = "py/nonsmooth/"
MOTION, READING, SYNTHETIC = (PY + f"model/ground_motion/{name}.py" for name in ("motion", "reading", "synthetic"))
NEWMARK, FIGURE = PY + "measure/newmark.py", PY + "figures/shaking.py"
GROUND, FILES, BLOCK, DRAWN = (f"plain:test_{name}.py" for name in ("ground_motion", "ground_motion_files", "newmark", "figures_shaking"))

MUTANTS = (
    # ---- motions
    mutant("motion-velocity", MOTION, "return v[k] + since * (a[k] + 0.5 * since * slope)", "return v[k] + since * (a[k] + since * slope)", "the velocity within a piece grows too fast",
           f"{GROUND}::test_a_triangle_by_hand"),
    mutant("motion-nodes", MOTION, "dt**2 * (2 * a[:-1] + a[1:]) / 6", "dt**2 * (a[:-1] + 2 * a[1:]) / 6", "both ends of a piece are exchanged in the displacement",
           f"{GROUND}::test_a_triangle_by_hand"),
    mutant("motion-mean", MOTION, "return (self.velocity(end) - self.velocity(begin)) / (end - begin)[..., None]", "return self.acceleration(0.5 * (begin + end))", "a step takes the value in its middle",
           f"{GROUND}::test_means_over_steps_add_up_to_the_integral"),
    mutant("motion-after", MOTION, " + after * v[-1]", "", "the ground stands still after a record that leaves a velocity", f"{GROUND}::test_a_triangle_by_hand"),
    mutant("motion-peak", MOTION, "np.flatnonzero(a[:-1] * a[1:] < 0)", "np.flatnonzero(a[:-1] * a[1:] > 0)", "a peak of the velocity between two times is missed", f"{GROUND}::test_peaks"),
    mutant("motion-duration", MOTION, "self._reaches(a, total, 0.95) - self._reaches(a, total, 0.05)", "self._reaches(a, total, 0.95)", "the duration counts from the begin of the record",
           f"{GROUND}::test_arias_intensity_and_duration_of_a_rectangle_and_of_a_ramp"),
    mutant("motion-line", MOTION, "constant = v[-1] / length - 0.5 * slope * length", "constant = v[-1] / length", "a line that is taken away leaves a velocity",
           f"{GROUND}::test_a_baseline_is_corrected_when_asked_and_only_then"),
    mutant("motion-writable", MOTION, "found.setflags(write=False)", "pass", "somebody else's change of an array changes the motion", f"{GROUND}::test_arrays_are_kept_as_they_were"),
    mutant("synthetic-frequency", SYNTHETIC, "2 * math.pi * frequency / math.sqrt(share)", "2 * math.pi * frequency * math.sqrt(share) ** 3", "the spectrum is largest at another frequency",
           f"{GROUND}::test_a_made_up_earthquake_has_the_frequency_and_the_envelope_that_were_asked_for"),
    mutant("synthetic-envelope", SYNTHETIC, "np.exp(b * (1 - part))", "np.exp(b * (1 - 2 * part))", "the envelope is largest too early",
           f"{GROUND}::test_a_made_up_earthquake_has_the_frequency_and_the_envelope_that_were_asked_for"),
    # ---- files
    mutant("motion-npts", READING, "if len(values) != count:", "if len(values) < count:", "a file with more values than it announces is read", f"{FILES}::test_what_is_damaged_is_told_in_one_line"),
    mutant("motion-gal", READING, '"cm/s2": 0.01, "gal": 0.01', '"cm/s2": 0.01, "gal": 0.1', "a gal is a tenth of m/s²", f"{FILES}::test_units_of_a_header"),
    mutant("motion-stated", READING, "if stated is not None and UNITS[stated] != UNITS[known]:", "if False:", "a unit that contradicts the file is dropped silently",
           f"{FILES}::test_a_unit_is_stated_where_the_file_has_none_and_may_agree_with_the_files"),
    mutant("motion-msec", READING, "if said.lower() not in SECONDS:", "if False:", "a step in milliseconds is read as seconds", f"{FILES}::test_what_is_damaged_is_told_in_one_line"),
    mutant("motion-gap", READING, "(steps > MISSING * usual) | (steps < DOUBLE * usual)", "steps < DOUBLE * usual", "a lost line of a CSV is not noticed",
           f"{FILES}::test_steps_that_differ_are_a_gap_unless_they_are_meant"),
    mutant("motion-columns", READING, 'columns.get("horizontal", zero), columns.get("vertical", zero)', 'columns.get("vertical", zero), columns.get("horizontal", zero)', "the components of a CSV are exchanged",
           f"{FILES}::test_a_csv_has_its_units_in_its_head"),
    mutant("motion-digits", READING, "re.ASCII)\nNO_NUMBERS", "re.UNICODE)\nNO_NUMBERS", "digits of other scripts are read", f"{FILES}::test_a_hundred_damaged_files_give_one_clean_line_each"),
    mutant("text-mark", PY + "system/text_files.py", '"utf-8-sig"', '"utf-8"', "a byte order mark makes a file unreadable", f"{FILES}::test_rows_of_any_length_ends_of_lines_of_any_system_and_other_names"),
    # ---- the block
    mutant("newmark-pressed", NEWMARK, "pressed = y * math.cos(b) + x * math.sin(b)", "pressed = y * math.cos(b) - x * math.sin(b)", "a shake into the plane relieves the block", f"{BLOCK}::test_yield_accelerations"),
    mutant("newmark-vertical", NEWMARK, "y = self.side * acceleration[:, 0], self.gravity + acceleration[:, 1]", "y = self.side * acceleration[:, 0], self.gravity - acceleration[:, 1]",
           "a ground that is pushed up relieves the block", f"{BLOCK}::test_the_vertical_component_presses_the_block_and_relieves_it"),
    mutant("newmark-side", NEWMARK, "x, y = self.side * acceleration[:, 0]", "x, y = acceleration[:, 0]", "a plane to the left is shaken as one to the right", f"{BLOCK}::test_a_mirrored_slope_slides_as_far"),
    mutant("newmark-root", NEWMARK, "return min((one for one in (q / slope", "return max((one for one in (q / slope", "the block stops when it would stop the second time", f"{BLOCK}::test_a_cycle_of_a_sine"),
    mutant("newmark-rest", NEWMARK, "if stop <= length - since:", "if stop < 0:", "a block that has stopped is pulled back by friction", f"{BLOCK}::test_a_cycle_of_a_sine"),
    mutant("newmark-turn", NEWMARK, "self._way * self._speed, value + slope * since", "self._way * self._speed, value - slope * since", "a block that turns round within a piece begins with another pull",
           f"{BLOCK}::test_a_block_turns_round_within_a_piece"),
    mutant("newmark-coast", NEWMARK, "        if self._speed != 0:\n", "        if False:\n", "what still slides at the end of the record stops at once", f"{BLOCK}::test_a_rectangular_pulse"),
    mutant("newmark-ways", NEWMARK, "drive + bears if block.both_ways else np.full(len(drive), math.inf)", "drive + bears", "a block that is held against it slides up",
           f"{BLOCK}::test_a_block_slides_up_where_it_is_pushed_up_and_may"),
    mutant("newmark-yield", NEWMARK, '"horizontal": math.cos(b) + self.friction * math.sin(b)', '"horizontal": math.cos(b)', "a horizontal shake does not relieve the plane", f"{BLOCK}::test_yield_accelerations"),
    # ---- the figure
    mutant("shaking-peak", FIGURE, "np.argmax(np.abs(horizontal))", "np.argmax(horizontal)", "a peak to the left is not marked", f"{DRAWN}::test_the_motion_is_above_and_the_slips_below_it"),
    mutant("shaking-drift", FIGURE, "np.ravel(values[-1])[0]", "np.ravel(values[-1])[-1]", "the drift that is told is the vertical one", f"{DRAWN}::test_what_is_left_at_the_end_of_the_record_is_told"),
    mutant("shaking-end", FIGURE, "last = max([time[-1], *", "last = min([time[-1], *", "slips after the record are cut off", f"{DRAWN}::test_slips_that_go_on_after_the_record_are_shown_to_their_end"),
)
