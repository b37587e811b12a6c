"""Windows that take disks out of a slope: where they are, when they take, and what is kept of it."""
from mutant import mutant

PY = "py/nonsmooth/"
WINDOWS, RULES, WORLD = (PY + name for name in ("model/section/erosion.py", "course/triggers/erosion.py", "world/erosion.py"))
ERODING, MONITOR, VERDICT, SNAPSHOTS = (
    PY + name for name in ("studies/slope/eroding.py", "studies/slope/monitoring.py", "studies/slope/verdict.py", "records/snapshots.py")
)
SIMILAR, SERIES, DRAWN = (PY + name for name in ("model/section/similar.py", "records/series.py", "figures/erosion.py"))
PLAIN = "plain:test_erosion_windows.py"
COURSE = "plain:test_erosion_course.py"
STUDY = "test_eroding.py"

MUTANTS = (
    # ---- where a window is
    mutant("erosion-way", WINDOWS, "gone = max(0.0, time - self.begin)", "gone = max(0.0, time)", "a window moves from t0 on and not from its begin",
           PLAIN + "::test_one_that_moves_is_where_its_velocity_has_brought_it_since_its_begin"),
    mutant("erosion-waits", WINDOWS, "gone = max(0.0, time - self.begin)", "gone = time - self.begin", "a window has moved before its begin",
           PLAIN + "::test_one_that_moves_is_where_its_velocity_has_brought_it_since_its_begin"),
    mutant("erosion-moved", WINDOWS, "np.asarray(x, float) - dx, np.asarray(y, float) - dy", "np.asarray(x, float) + dx, np.asarray(y, float) + dy", "a window goes the other way",
           PLAIN + "::test_one_that_moves_is_where_its_velocity_has_brought_it_since_its_begin"),
    mutant("erosion-opening", WINDOWS, "along <= low + share * (high - low)", "along >= low + share * (high - low)", "a window opens from the wrong side",
           PLAIN + "::test_one_that_is_dug_opens_at_an_even_speed_from_its_top_down_or_where_it_is_told"),
    mutant("erosion-down", WINDOWS, "DOWN = (0.0, -1.0)", "DOWN = (0.0, 1.0)", "what is dug is dug from below", PLAIN + "::test_one_that_is_dug_opens_at_an_even_speed_from_its_top_down_or_where_it_is_told"),
    mutant("erosion-layers", WINDOWS, "not self.layers or layer.name in self.layers", "layer.name in self.layers", "a window that names no layer takes none",
           PLAIN + "::test_a_window_that_says_no_more_takes_once_and_all_layers"),
    mutant("erosion-ends", WINDOWS, 'raw.get("end", begin + opening)', 'raw.get("end", begin)', "a window that is dug ends as it begins", PLAIN + "::test_a_dug_window_ends_when_it_is_open"),
    mutant("erosion-jump", WINDOWS, "speed * row > high - low", "speed * row > 2 * (high - low)", "a window may jump over disks", PLAIN + "::test_what_is_wrong_with_a_window_is_told"),
    mutant("erosion-mirror", SIMILAR, 'made["path"] = [[t, 0.0 - x, y] for t, x, y in window["path"]]', "pass", "the path of a mirrored window is not mirrored",
           PLAIN + "::test_a_mirrored_window_takes_the_mirrored_points"),
    mutant("erosion-scaled", PY + "model/section/powers.py", '"erosion.path": (TIME, LENGTH, LENGTH)', '"erosion.path": (LENGTH, LENGTH, LENGTH)', "times of a path are lengths",
           PLAIN + "::test_a_similar_window_takes_the_same_points_at_its_own_times"),
    # ---- when it takes
    mutant("erosion-early", RULES, "now >= window.begin - 0.5 * seen.step", "now >= window.begin - 50 * seen.step", "a window takes before its begin",
           COURSE + "::test_a_window_that_takes_once_does_so_at_the_first_row_at_its_begin_or_after_it"),
    mutant("erosion-late", RULES, "last >= window.end - 0.5 * step", "last > window.end + 0.5 * step", "a window takes once more after its end",
           COURSE + "::test_one_with_an_end_takes_at_every_row_up_to_the_first_at_its_end_or_after_it"),
    mutant("erosion-dry", RULES, 'state.stage != "water" or state.failed_dry is not None', 'state.stage != "water"', "windows eat a slope that failed dry",
           COURSE + "::test_nothing_is_taken_of_a_slope_that_failed_dry"),
    mutant("erosion-holds", RULES, 'window.hold == "motion" and state.moving is not None', "False", "a river eats an avalanche that it should let be",
           COURSE + "::test_one_that_holds_takes_nothing_of_an_avalanche"),
    mutant("erosion-delay", RULES, "state.erosion_delay + (seen.time - before.moving)", "seen.time - before.moving", "a second halt makes the first one forgotten",
           COURSE + "::test_it_stands_still_twice"),
    mutant("erosion-over", PY + "course/slope.py", "    if not _load_is_last(s, seen, section):", "    if False:", "a slope is over before its window opens",
           COURSE + "::test_a_slope_is_not_over_while_a_window_may_yet_take"),
    mutant("erosion-rest", RULES, "state.failed_dry is not None or all(_over(window, state, seen.step) for window in goes_on)", "True", "an avalanche is over while a river goes on",
           COURSE + "::test_an_avalanche_is_over_while_a_window_that_holds_waits_and_not_while_another_takes"),
    mutant("erosion-waits-moving", RULES, 'w.hold == "never" or state.moving is None', "True", "a window that holds keeps an avalanche's run from its end",
           COURSE + "::test_an_avalanche_is_over_while_a_window_that_holds_waits_and_not_while_another_takes"),
    mutant("erosion-still", RULES, "any(w.name in state.erosion_taken and not _over(w, state, seen.step) for w in section.erosion)", "False", "contacts are solved as of a still slope while disks go",
           COURSE + "::test_a_slope_from_which_disks_are_taken_is_not_still"),
    mutant("erosion-slip", PY + "measure/surface_slip.py", "values = values[~np.isnan(values)]", "pass", "a surface has no displacement once a disk on it is gone",
           "plain:test_surface_slip.py::test_a_disk_that_is_gone_counts_no_longer"),
    # ---- what is kept of it
    mutant("erosion-turns", WORLD, " + s.inertia[2] * s.angVel[2] ** 2", "", "the rotation of disks that go has no energy", STUDY + "::test_what_is_left_keeps_its_motion_and_what_it_bears"),
    mutant("erosion-twice", ERODING, "left &= ~inside", "pass", "a disk in two windows is taken twice", STUDY + "::test_windows_may_take_all_but_what_they_may_not"),
    mutant("erosion-all", ERODING, "left if self._of_mass is None else left & self._of_mass[numbers]", "left", "a bed without a mass goes on",
           STUDY + "::test_windows_that_leave_nothing_of_the_mass_are_told"),
    mutant("erosion-outside", MONITOR, "rest = e.broughtEnergy + self.eroding.energy", "rest = e.broughtEnergy", "what windows take counts as a script's work",
           STUDY + "::test_a_whole_layer_on_top_is_taken_out_to_the_last_bit"),
    mutant("erosion-shift", MONITOR, "float(after[0] - before[0]), float(after[1] - before[1])", "0.0, 0.0", "the centre's jump is a way of the mass",
           STUDY + "::test_a_whole_layer_on_top_is_taken_out_to_the_last_bit"),
    mutant("erosion-rows", MONITOR, "np.searchsorted(numbers, arrays[name][disk])", "arrays[name][disk]", "contacts of a snapshot name other disks",
           STUDY + "::test_a_whole_layer_on_top_is_taken_out_to_the_last_bit"),
    mutant("erosion-bonds", PY + "world/soft/measures.py", "if gone.isdisjoint(pair)", "if True", "bonds of disks that are gone have broken", STUDY + "::test_soft_contacts_go_through_the_same_code"),
    mutant("erosion-key", PY + "studies/slope/experiment.py", '({"erosion": [asdict(window) for window in section.erosion]} if section.erosion else {})', "{}",
           "a run goes on with other windows", STUDY + "::test_a_slope_that_goes_on_from_a_checkpoint_has_the_same_files"),
    mutant("erosion-both", SNAPSHOTS, "return one.chosen(rows), other.chosen(others)", "return one.chosen(others), other.chosen(rows)", "ways are between other disks",
           "plain:test_records.py::test_a_snapshot_tells_which_disks_are_left"),
    mutant("erosion-numbers", SNAPSHOTS, '(np.diff(found["number"]) <= 0).any()', "False", "a snapshot has a disk twice", "plain:test_records.py::test_a_snapshot_tells_which_disks_are_left"),
    mutant("erosion-verdict", VERDICT, 'eroded = state.get("failed_dry") is None and _eroded(series, moved)', 'eroded = ""', "a slope without its foot failed dry",
           "plain:test_verdict.py::test_a_slope_that_moves_off_once_disks_were_taken_out_failed_by_erosion"),
    mutant("erosion-slid", VERDICT, "x = centroid.path(series)[0][since]", 'x = series["centroid_x_m"][since]', "a slope from which a side is taken has slid",
           "plain:test_verdict.py::test_a_jump_of_the_centre_is_no_slide"),
    mutant("erosion-video", PY + "figures/video.py", "np.full((len(self.numbers), 2), np.nan)", "np.zeros((len(self.numbers), 2))", "disks that are gone lie at the origin of the video",
           STUDY + "::test_a_gone_disk_is_in_no_frame_of_the_video"),
    mutant("erosion-tonnes", DRAWN, "1e-3 * np.cumsum", "1e-6 * np.cumsum", "kilotonnes are drawn as tonnes", "plain:test_figures_erosion.py::test_mass_by_windows_is_in_tonnes_beside_the_speed"),
    mutant("erosion-colours", DRAWN, 'colours[ledger["disk"]] = scale.to_rgba(ledger["time_s"])', "pass", "nobody sees what was taken", "plain:test_figures_erosion.py::test_disks_that_were_taken_have_the_colour_of_their_time"),
)
