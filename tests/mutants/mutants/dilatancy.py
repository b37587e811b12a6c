"""Release of pore pressure by local dilatancy: the area shares, the rule, the run and the engine."""
from mutant import mutant

PACKING, RULE, RUN = "py/nonsmooth/measure/local_packing.py", "py/nonsmooth/course/dilatancy.py", "py/nonsmooth/studies/slope/water_release.py"
ENGINE, SECTION = "pkg/dem/engines/PorePressureEngine.cpp", "py/nonsmooth/model/section/"
SHARES, RULES, RUNS = "plain:test_local_packing.py", "plain:test_dilatancy.py", "test_water_release.py"

MUTANTS = (
    # ---- area shares
    mutant("packing-voronoi", PACKING, "(at**2).sum(1) - r**2", "(at**2).sum(1)", "neighbours are those of points and not of disks", SHARES),
    mutant("packing-halves", PACKING, "(square + radii[:, k] ** 2 - radii[:, o] ** 2) / (2 * square)", "0.5 + 0 * square", "cells of unlike disks end half way between them",
           SHARES + "::test_cells_of_unlike_disks_end_at_their_radical_lines"),
    mutant("packing-void", PACKING, "(centre**2).sum(1) - radii[:, 0] ** 2 <= void**2", "(centre**2).sum(1) >= 0", "the mass ends nowhere",
           SHARES + "::test_a_free_surface_bounds_cells_and_a_crack_opens_them"),
    mutant("packing-whole", PACKING, "radii[:, k] ** 2 * angle / 2", "np.pi * radii[:, k] ** 2 / 6", "a disk at the rim counts with more than its sector",
           SHARES + "::test_cells_of_unlike_disks_end_at_their_radical_lines"),
    mutant("packing-alone", PACKING, "return values + np.bincount(i, values[j], len(x))", "return values + 0 * np.bincount(i, values[j], len(x))", "half of the neighbours are left out",
           SHARES + "::test_a_stretched_packing_is_read_back_by_neighbourhoods_and_not_by_cells"),
    # ---- the rule
    mutant("dilation-alone", RULE, "where=at_failure > 0", "where=share > 0", "a disk whose packing was none is none that stands alone",
           RULES + "::test_a_disk_that_stands_alone_then_or_now_holds_no_pressure"),
    mutant("dilation-comes-back", RULE, "return np.maximum(before, new), np.maximum(largest, now)", "return np.clip(now / whole, 0, 1), now", "pressure comes back where the mass gets denser",
           RULES + "::test_it_never_falls_without_drainage"),
    mutant("dilation-again", RULE, "added = new - np.clip(largest / whole, 0, 1)", "added = new", "the same dilation releases at each look", RULES + "::test_water_flows_back_in_the_drainage_time"),
    # ---- the run
    mutant("release-early", RUN, "if self.time is None and not failed:", "if self.time is None and disks is None:", "the packing is noted before the slope fails",
           RUNS + "::test_stretched_by_hand_it_releases_by_its_rule"),
    mutant("release-since", RUN, "pore_pressure.release(self.slope.water, self.slope.first_disk, shares)\n        self.time = O.time", "pore_pressure.release(self.slope.water, self.slope.first_disk, shares)",
           "water flows back as if nothing had been looked at since failure", RUNS + "::test_stretched_by_hand_it_releases_by_its_rule"),
    mutant("release-resumed", RUN, 'self.time, self.largest = told["time"], np.array(told["largest"])', 'self.largest = np.array(told["largest"])', "a resumed run notes its packing anew",
           RUNS + "::test_a_resumed_run_has_the_bits_of_one"),
    mutant("release-distance", SECTION + "section.py", 'self.water.release.by == "dilatancy"', 'self.water.release.by == "slip"', "slip releases too where dilatancy alone should",
           "test_release.py::test_dilatancy_has_defaults_and_no_distance"),
    mutant("release-idle", SECTION + "water_release.py", 'for key in (key for key in raw if key != "by"):', "for key in ():", "what does nothing is not refused", "test_release.py::test_what_makes_no_sense_is_refused"),
    # ---- the engine
    mutant("release-share", ENGINE, "force *= 1 - shareReleased(id);", "", "a released share takes nothing from the force",
           "test_pore_pressure.py::test_a_released_share_takes_its_part_of_the_force"),
    mutant("release-forgotten", ENGINE, "if (id < releasedShare.size()) releasedShare[id] = 0;", "", "a body has the share of the one that had its id",
           "test_outlived_state.py::test_a_released_share_belongs_to_a_body_and_not_to_its_id"),
    mutant("release-bounds", ENGINE, "releasedShare[id] >= 0 && releasedShare[id] <= 1", "releasedShare[id] >= 0", "more than all may be released",
           "test_pore_pressure.py::test_what_is_no_share_is_refused"),
)
