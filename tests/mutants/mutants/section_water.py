"""Water of a section that is no table: its keys, its field, what a run does with it. Python, judged by pytest."""
from mutant import mutant

MODEL, WATER, SLOPE = "py/nonsmooth/model/section/", "py/nonsmooth/water/", "py/nonsmooth/studies/slope/"
LINES, STATES, BASE = MODEL + "water.py", MODEL + "seepage.py", MODEL + "field_water.py"
FIELD, SEEPAGE = WATER + "of_section.py", WATER + "section_seepage.py"
MONITOR, COURSE, RULES = SLOPE + "monitoring.py", SLOPE + "experiment.py", "py/nonsmooth/course/slope.py"
WORLD = "py/nonsmooth/world/pore_pressure.py"
KEYS, FLOW, RUN = "plain:test_section_water.py", "plain:test_water_of_sections.py", "test_field_water.py"
HELD = "test_verification.py::test_quick_form_of_a_long_check_holds[{}]"
REFUSED = KEYS + "::test_what_is_refused_is_named_with_its_value_and_a_remedy"

MUTANTS = (
    # ---- keys
    mutant("water-late", LINES, "if last > longest:", "if False:", "water that comes after the run is taken", KEYS + "::test_water_that_comes_after_the_run_is_refused"),
    mutant("water-late-end", MODEL + "parts.py", "return max(self.end.time - self.dry, 0.0)", "return self.end.time", "states may come in the time before t0 too", KEYS + "::test_water_that_comes_after_the_run_is_refused"),
    mutant("water-kinds", LINES, "if len(given) > 1:", "if False:", "two kinds of water are taken for one", REFUSED),
    mutant("water-held", LINES, 'if given[0] != "table" and "hold"', 'if False and "hold"', "what cannot be held is said to be", REFUSED),
    mutant("water-times", BASE, 'if after["time"] <= before["time"]:', 'if after["time"] < before["time"]:', "two states have one time", REFUSED),
    mutant("water-span", LINES, "low <= reach.min() and reach.max() <= high", "low <= reach.min()", "a line may end within the layers", KEYS),
    mutant("water-ground", LINES, "if y > ground + section.largest:", "if False:", "a line may float above the ground", REFUSED),
    mutant("water-level", LINES, "if abs(b[1] - a[1]) <= section.tolerance:", "if False:", "a reservoir is refused", KEYS),
    mutant("water-digest", LINES, 'if one.get("sha256", digests[-1]) != digests[-1]:', "if False:", "another file is taken for the one that was meant", KEYS + "::test_files_that_are_refused"),
    mutant("water-mirror", LINES, "[[0.0 - x, y] for x, y in reversed(line[\"points\"])]", "[[0.0 - x, y] for x, y in line[\"points\"]]", "mirrored lines run from right to left",
           KEYS + "::test_a_mirrored_slope_has_mirrored_lines"),
    mutant("water-mirror-file", LINES, 'not raw["field"].get("mirrored", False)', "True", "a field that is mirrored twice is mirrored", KEYS + "::test_a_mirrored_and_a_larger_field"),
    mutant("states-dip", STATES, 'one["dip"] = 0.0 - one["dip"]', "pass", "bedding of a mirrored slope dips the old way", FLOW + "::test_a_slope_that_is_mirrored_has_mirrored_seepage"),
    mutant("water-first", STATES, "if not one.get(\"drained\", True) and k == 0:", "if False:", "a drawdown begins from nothing", FLOW + "::test_what_is_refused_when_a_section_is_read"),
    # ---- the field
    mutant("water-from-dry", FIELD, "if found.times[0] <= 0:", "if True:", "the first state's pressures come at once", KEYS + "::test_pressures_grow_from_nothing_until_the_first_state"),
    mutant("water-along", FIELD, "(1 + slope**2 if water.flow", "(1 + slope if water.flow", "water along a line has another pressure", KEYS + "::test_the_field_below_lines_is_exact"),
    mutant("water-scale", FIELD, "found.pressures * water.scale", "found.pressures", "a larger field has the small one's pressures", KEYS + "::test_a_mirrored_and_a_larger_field"),
    mutant("water-cover", FIELD, "if largest is not None:", "if False:", "a field need not cover the layers", KEYS + "::test_a_field_must_cover_the_layers"),
    mutant("water-hole", FIELD, "if mesh.locate(part.representative_point().coords)[0] >= 0", "if True", "a hole in a mesh is covered", KEYS + "::test_a_mesh_with_a_hole_does_not_cover_what_lies_in_it"),
    mutant("water-bared", SEEPAGE, "given = applied.fixed | bared | ~wet", "given = applied.fixed | ~wet", "a bared face keeps the reservoir's pressure", FLOW + "::test_a_rapid_drawdown_of_seeping_water_leaves_the_effective_stresses"),
    mutant("water-open", SEEPAGE, "pond = _open_water(water, section)", "pond = None", "no water stands over the ground", FLOW + "::test_open_water_stands_over_the_ground_at_the_level_of_the_time"),
    mutant("water-nearest", SEEPAGE, "k = int(np.argmin(away))", "k = 0", "all open water has the level of the first reservoir", FLOW + "::test_two_reservoirs_stand_where_their_lines_are"),
    mutant("water-tight", SEEPAGE, "taken[mesh.border_on(wall.points)] = True", "pass", "walls let water out", FLOW + "::test_rain_raises_the_water_and_an_artesian_base_lifts"),
    # ---- a run
    mutant("water-begin", RULES, "None if section.water_field is None or state.water_hold is not None else state.t0", "None if section.water_field is None else state.t0",
           "a slope that failed dry gets wet", RUN + "::test_a_slope_that_fails_dry_gets_no_water"),
    mutant("water-coming", RULES, "return triggers.over(s, seen, section) and not seen.coming", "return triggers.over(s, seen, section)", "a slope stands before the last state of its water",
           "plain:test_course.py::test_while_states_of_a_field_of_water_are_to_come_it_neither_stands_nor_is_still"),
    mutant("water-still", RULES, "if height == s.table and not seen.coming else", "if height == s.table else", "a slope is still while its water rises", RUN + "::test_a_slope_stands_only_after_the_last_state"),
    mutant("water-kept", COURSE, "field_files.read(Path(folder) / of_section.FILE)", "of_section.field(section)", "a resumed run wants the file again", RUN + "::test_a_run_does_not_need_the_file_of_its_field_again"),
    # ---- against closed forms
    mutant("water-line-weight", FIELD, "pressures.append((weight[:, None] * (ends - corners[..., 1])).ravel())", "pressures.append((weight[:, None] * np.abs(ends - corners[..., 1])).ravel())",
           "there is pressure above a line", HELD.format("still-water-on-a-face")),
    mutant("water-open-level", SEEPAGE, "water.unit_weight * (level - nodes[:, 1])", "water.unit_weight * level", "open water has no hydrostatic pressure", FLOW + "::test_open_water_stands_over_the_ground_at_the_level_of_the_time"),
    mutant("water-state-times", WORLD, "times=(pressures.times + begin).tolist()", "times=(pressures.times + 0.9 * begin).tolist()", "states of water come early", HELD.format("states-in-time")),
    mutant("water-bulk", SLOPE + "slope.py", 'volumeFactor=1.0 if section.water.volume == "disk" else 1 / section.disks.packing_fraction', "volumeFactor=1.0", "water of the bulk acts on disks alone",
           HELD.format("parallel-seepage")),
    mutant("water-artesian", "py/nonsmooth/water/conditions.py", "PressureHead: lambda: y[nodes] + one.height", "PressureHead: lambda: np.full(len(nodes), float(one.height)) - y[nodes]", "an artesian base has another head than its pressure asks for",
           "plain:test_seepage.py::test_an_artesian_base_has_its_pressure_everywhere_and_the_body_a_linear_one"),
    mutant("water-drawdown", FIELD, "weight = water.unit_weight / (1 + slope**2", "weight = 9810 + 0 * water.unit_weight / (1 + slope**2", "a drawdown along the slope is Morgenstern's", FLOW + "::test_a_drawdown_leaves_the_share_of_safety_of_its_book_keeping"),
    mutant("water-heads", "py/nonsmooth/measure/pressure_heads.py", "up)[piece] + share", "0 * up)[piece] + share", "heads are read below the disks", RUN + "::test_the_run_tells_of_the_pressure_on_the_slip_surface"),
)
