"""Disks freed of their overlaps: plain C++, judged by GoogleTest and by the packings that there were before it."""
from mutant import mutant

RELAXATION, LISTS, SUM, EDGE, FIRE = (f"pkg/packing/{name}" for name in ("relaxation.cpp", "near_lists.cpp", "numpy_sum.cpp", "edge.hpp", "fire.hpp"))
WALLS, PAIRS, KEYS = "pkg/packing/wall_list.cpp", "pkg/packing/close_pairs.cpp", "py/nonsmooth/system/keys.py"
FORCES, SAME, HAND = "gtest:Relaxation.ForcesAreThoseOfEveryPair*", "plain:test_same_bits.py", "plain:test_packing.py"

MUTANTS = (
    # ---- forces
    mutant("packing-lower", RELAXATION, "higher.x + lower.x", "higher.x - lower.x", "neighbours with lower numbers pull", FORCES),
    mutant("packing-wall", EDGE, "std::max(r - at.off, 0.0)", "std::max(r - 2 * at.off, 0.0)", "disks stand half in the walls",
           HAND + "::test_edges_and_corners_push_by_hand"),
    mutant("packing-corner", EDGE, "before || !(at.off > 0)", "before", "a corner pushes disks that have passed it", HAND + "::test_edges_and_corners_push_by_hand"),
    mutant("packing-wall-stiffness", RELAXATION, "force[k].x + 2 * sum.x", "force[k].x + sum.x", "walls are as soft as disks", FORCES),
    mutant("packing-wall-squeeze", RELAXATION, "squeeze[k] += 2 * inside;", "squeeze[k] += inside;", "walls squeeze half as much as they push", FORCES),
    mutant("packing-acts", WALLS, "on.empty() || on[body]", "true", "an interface pushes the disks of both sides",
           HAND + "::test_forces_of_overlapping_disks_by_hand"),
    mutant("packing-worst-wall", RELAXATION, "std::max(worst, worstWall)", "worst", "a packing is done while disks are in its walls", HAND + "::test_the_more_squeezed_larger_one_changes_places"),
    mutant("packing-order", LISTS, "number[a] < number[b]", "number[a] > number[b]", "forces are summed in another order", SAME + "::test_forces_are_those_of_numpy_after_every_sweep"),
    mutant("packing-sum", SUM, "count / 2 / lanes * lanes", "count / 2", "sums are halved in another place than NumPy's", "bindings/test_packing_module.py::test_sums_are_those_of_numpy"),
    # ---- lists
    mutant("packing-wide", RELAXATION, "if (!(2 * used < safe * wideMargin)) return false;", "", "who is near is found once", FORCES),
    mutant("packing-narrow", RELAXATION, "2 * sinceNarrow.atMost() < safe * narrowMargin", "sinceNarrow.atMost() < 1e9", "who overlaps is found once, or after an exchange", FORCES),
    mutant("packing-pairs", PAIRS, "std::sqrt(x * x + y * y) < a.r + b.r + margin", "std::sqrt(x * x + y * y) <= a.r + b.r + margin", "a gap of just the margin counts", "gtest:ClosePairs.*"),
    # ---- steps and exchanges
    mutant("packing-stride", RELAXATION, "change.step * most < safe * stride", "true", "a step has no largest length", SAME + "::test_forces_are_those_of_numpy_after_every_sweep"),
    mutant("packing-mobility", RELAXATION, "size / b.r", "1.0", "large disks are as quick as small ones", SAME + "::test_forces_are_those_of_numpy_after_every_sweep"),
    mutant("packing-mix", FIRE, "mix  = 0.99 * mix;", ";", "velocities are turned as much after a thousand steps downhill as after five", "gtest:Fire.*"),
    mutant("packing-layers", RELAXATION, "layerAt[k] != layerAt[k + stride]", "false", "disks change places with those of other layers", "gtest:Relaxation.ExchangesKeepSizes*"),
    mutant("packing-gain", RELAXATION, "squeeze[large] - squeeze[small] > difference", "squeeze[large] > squeeze[small]", "disks change places for any gain",
           HAND + "::test_the_more_squeezed_larger_one_changes_places"),
    mutant("packing-equals", RELAXATION, "if (equals) orderEquals();", "", "disks of one size are ordered by what has happened to them", SAME + "::test_sweeps_have_the_same_bits_on_any_number_of_threads"),
    # ---- its key
    mutant("packing-key", KEYS, "(*named, *sorted(set().union(*map(_calls, files))))", "named", "another build of what packs takes the packings of the one before",
           "test_keys.py::test_another_build_of_what_packs_makes_its_own"),
)
