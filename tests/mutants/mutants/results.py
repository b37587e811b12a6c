"""What carries results to people: the words of a comparison, plans and their tables, summaries, rows of walls and interfaces. Python, judged by pytest."""
from mutant import mutant

PY = "py/nonsmooth/"
ANSWERS, PLAN, RESULTS, WALLS, SECTION = (
    PY + name for name in ("comparison/answers.py", "campaign/plan.py", "results.py", "wall_series.py", "section.py")
)
SAID, PLANNED, PARTS, ROWS = "plain:test_comparison_answers.py", "plain:test_plan.py", "plain:test_summary_parts.py", "test_wall_series.py"

MUTANTS = (
    # ---- the words of a comparison
    mutant("answers-dearer", ANSWERS, 'verdict = "hard" if found["factor"] > 1 else "soft"', 'verdict = "soft" if found["factor"] > 1 else "hard"', "who takes four times as long costs less",
           SAID + "::test_who_costs_less_is_who_takes_less_wall_time"),
    mutant("answers-factor", ANSWERS, 'found["factor"] if found["factor"] > 1 else 1 / found["factor"]', 'found["factor"]', "soft costs less by a factor of a quarter",
           SAID + "::test_who_costs_less_is_who_takes_less_wall_time"),
    mutant("answers-words", ANSWERS, 'True: "they differ by no more than two packings do",\n    False: "they differ",', 'False: "they differ by no more than two packings do",\n    True: "they differ",',
           "worlds that agree are said to differ", SAID + "::test_whether_a_quantity_agrees_is_said_with_its_numbers"),
    mutant("answers-part", ANSWERS, '"no" if not any(verdicts) else "in part"', '"no"', "worlds that agree in some are said to agree in nothing", SAID + "::test_the_verdict_is_of_all_quantities"),
    mutant("answers-untold", ANSWERS, '"not told" if None in verdicts else', '"not told" if not any(verdicts) else', "worlds that differ are not told apart", SAID + "::test_the_verdict_is_of_all_quantities"),
    mutant("answers-kilo", ANSWERS, '(1e3, "k")', '(1e4, "k")', "5 kN are 5000 N", SAID + "::test_a_force_or_a_pressure_has_the_prefix_that_leaves_one_to_three_digits_before_the_point"),
    mutant("answers-known", ANSWERS, "min(known) < seeds", "max(known) < seeds", "a world in which some runs did not come to it is not told",
           SAID + "::test_runs_in_which_a_quantity_has_no_value_are_told"),
    mutant("answers-scatter", ANSWERS, 'if found["at_scatter"]', 'if not found["at_scatter"]', "an accuracy that both reach is said to be the scatter", SAID + "::test_an_accuracy_that_is_the_scatter_is_told"),
    mutant("answers-rock", ANSWERS, 'if summary["rock_stiffness_extrapolated"] else "."', 'if not summary["rock_stiffness_extrapolated"] else "."', "what was run is said to be extrapolated",
           SAID + "::test_wall_times_at_equal_overlap_and_at_a_rocks_stiffness"),
    # ---- plans
    mutant("plan-key", PLAN, "keys.key_of(self.arguments)", "keys.key_of(self.values)", "runs of another section with the same values are taken for these", PLANNED),
    mutant("plan-number", PLAN, "which in (one.name, k)", "which in (one.name, k + 1)", "a job of a cluster does the run before its own", PLANNED + "::test_one_run_by_its_name_or_number"),
    mutant("plan-texts", PLAN, 'or f"{prefix}{name}" == VERDICT', "or name == VERDICT", "any verdict of a deep result goes into the table", PLANNED + "::test_numbers_of_any_depth_are_columns_and_texts_are_not"),
    mutant("plan-of", PLAN, '"of": number[values]', '"of": len(found)', "runs with another verdict are not counted among their combination's", PLANNED + "::test_means_of_each_combination_and_verdict"),
    # ---- summaries
    mutant("results-highest", RESULTS, 'float(np.max(series["water_m"]))', 'float(series["water_m"][-1])', "the highest water is the last", PARTS + "::test_the_highest_water_is_not_the_last"),
    mutant("results-foot", RESULTS, "section.side * (end.x - ground.foot[0]) > 0", "end.x - ground.foot[0] > 0", "on a slope to the left what stayed is the deposit",
           PARTS + "::test_what_a_bed_gives_and_what_lies_beyond_the_foot"),
    mutant("results-size", RESULTS, "> ENTRAINED * size[end.layer]", "> ENTRAINED * size.min()", "a bed of large disks is entrained by half the way",
           PARTS + "::test_what_a_bed_gives_and_what_lies_beyond_the_foot"),
    mutant("results-mass", RESULTS, "np.isin(end.layer, ground.mass)", "~np.isin(end.layer, beds)", "an obstacle is of the mass", PARTS + "::test_what_a_bed_gives_and_what_lies_beyond_the_foot"),
    mutant("results-walls", RESULTS, "if math.isfinite(value)}", "}", "a wall whose loss nobody told has one that is none", PARTS + "::test_what_slides_on_each_wall_is_that_of_its_last_row"),
    mutant("results-later", RESULTS, "int(path.stem) > step", "int(path.stem) >= step", "a resumed run loses the snapshot of its checkpoint",
           PARTS + "::test_a_resumed_run_forgets_what_it_has_not_reached"),
    mutant("results-begin", RESULTS, '(stage in ("settle", "dry"))', '(stage == "settle")', "a run resumed in its dry rest keeps the t0 of another", PARTS + "::test_a_resumed_run_forgets_what_it_has_not_reached"),
    mutant("results-leans", RESULTS, 'if end is None or not (leans or name != "fb_normal_N_per_m")', "if end is None", "a slope without a backstop has a force on it",
           PARTS + "::test_without_a_backstop_there_is_no_force_on_one"),
    mutant("fronts-share", PY + "measure/fronts.py", "def front(snapshot, side=1.0, share=0.999,", "def front(snapshot, side=1.0, share=0.99,", "figures have another front than the summary",
           "plain:test_figures_slope.py::test_the_front_leaves_out_a_thousandth_of_the_area"),
    mutant("style-times", PY + "figures/style.py", '"t1": "limit equilibrium",\n    "t2": "triggering begins",', '"t2": "limit equilibrium",\n    "t1": "triggering begins",',
           "t1 and t2 have each other's names", "plain:test_figures_slope.py::test_each_characteristic_time_says_what_it_marks"),
    # ---- walls, interfaces, layers
    mutant("wall-pieces", WALLS, "math.fsum(losses[i] for i in ids if i < len(losses))", "losses[ids[0]]", "of a wall the first piece alone counts", ROWS + "::test_a_wall_has_the_sum_of_all_its_pieces"),
    mutant("wall-means", WALLS, "sum(m.meanSlip() * n for m, n in zip(weak, counts)) / touched", "sum(m.meanSlip() for m in weak) / len(weak)", "the mean slip is the mean of walls' means",
           ROWS + "::test_the_slip_of_several_walls_is_the_mean_over_their_disks"),
    mutant("wall-shared", WALLS, "role: forces[names[0] if len(names) == 1 else (role,)] if names", "role: forces[names[0]] if names", "of several walls of a role the first alone counts",
           ROWS + "::test_a_wall_has_the_sum_of_all_its_pieces"),
    mutant("wall-role", WALLS, "if interface.name in self._lowest:", "if True:", "an interface that is no slip surface counts as one", ROWS + "::test_each_interface_of_a_layer_has_its_own_law"),
    mutant("wall-upper", WALLS, "(one == upper) & (other == lower)", "(one == upper) & (other == upper)", "disks below with the higher id do not press",
           ROWS + "::test_each_interface_of_a_layer_has_its_own_law"),
    mutant("wall-lies", WALLS, "(one != k) & (one >= 0)", "(one != k)", "an obstacle is pushed by the wall that it stands on", ROWS + "::test_an_obstacle_is_pushed_by_what_hits_it_alone"),
    mutant("slope-interface", PY + "slope.py", "lower.interfaceLaws[list(lower.interfaceLayers).index(upper.layer)]", "lower.interfaceLaws[0]", "all interfaces of a layer have the law of the first",
           ROWS + "::test_each_interface_of_a_layer_has_its_own_law"),
    mutant("section-largest", SECTION, "return max(self.disks_of(layer).d_max for layer in self.layers)", "return self.disks.d_max", "a layer's own largest disks are forgotten",
           "plain:test_section.py::test_the_smallest_and_the_largest_disk_are_of_all_layers"),
    mutant("pressed-calm", PY + "slope_packing.py", "mean - before < CALM * mean", "mean - before < CALM", "a large slope is pressed for ever, a small one is not",
           "test_slope_packing.py::test_pressing_ends_when_the_mean_depth_grows_no_more_at_any_size"),
    mutant("course-left", PY + "experiment.py", "        if out.any():\n", "        if False:\n", "a disk that leaves the section is not noticed", "test_slope_course.py::test_a_disk_that_leaves_the_section_is_refused"),
    mutant("course-seen", PY + "experiment.py", "        self._inside(disks)\n", "", "no row looks whether disks are still there",
           "test_slope_course.py::test_a_row_that_sees_a_lost_disk_ends_the_run_and_is_not_written"),
    mutant("course-below", PY + "experiment.py", ' & (t["y"] > y0 - margin)', "", "a disk that falls through the ground is not noticed", "test_slope_course.py::test_a_disk_that_leaves_the_section_is_refused"),
    mutant("compare-side", PY + "comparison/slopes.py", "None if front0 is None else s.side * float(", "None if front0 is None else float(", "a slope to the left has come back",
           "plain:test_comparison_numbers.py::test_a_slope_to_the_left_has_the_numbers_of_its_mirror"),
    mutant("compare-side-curve", PY + "comparison/slopes.py", '"front": s.side * (series', '"front": (series', "the way of a slope to the left is drawn downwards",
           "plain:test_comparison_numbers.py::test_a_slope_to_the_left_has_the_numbers_of_its_mirror"),
    # ---- files that are written
    mutant("given-file", PY + "records/given.py", "isinstance(v, (str, os.PathLike)) and bool(os.fspath(v))", "isinstance(v, (str, os.PathLike))", "a file of no name is written",
           "test_wrong_types.py::test_a_value_of_another_kind_is_named"),
    mutant("given-water", PY + "tables.py", 'hasattr(v, "bodyTable") and not hasattr(v, "contactTable")', 'hasattr(v, "bodyTable")', "the table of the contacts' engine is read as the water's",
           "test_wrong_types.py::test_a_value_of_another_kind_is_named"),
    mutant("given-entries", PY + "records/given.py", "len(one) == 2 for one in v", "True for one in v", "a list of three things is written as times and files",
           "test_wrong_types.py::test_a_value_of_another_kind_is_named"),
)
