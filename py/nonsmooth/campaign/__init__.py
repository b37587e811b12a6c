"""Many runs as one plan: made and checked before any begins, run side by side here or on a cluster, collected into one
table; and single runs of every kind. Needs no YADE: each run has a process of its own.

* :mod:`sweep`: a slope with some of its values varied, and a slope alone;
* :mod:`plan`: a plan in its folder: run, resumed, collected;
* :mod:`cluster`: the same plan for Snakemake and for Slurm;
* :mod:`safety`: factors of safety;
* :mod:`heaps`: columns and piles;
* :mod:`laboratory`: tension tests of a rock;
* :mod:`scripts`: lessons and any script; :mod:`script_run`: what a process does with one (in YADE);
  :mod:`script_output`: its run, opened;
* :mod:`comparisons`: hard against soft.

Like this::

    plan = campaign.sweep(section.load("circle").with_disks(600), {"materials.soil.friction": [0.3, 0.5], "seed": [1, 2]})
    table = plan.run("out/sweep", threads=2)      # a dictionary of columns; pandas.DataFrame(table) where one likes
    run = campaign.run_column(column.Column(disks=300), "out/column")
    run = campaign.run_lesson("incline", "out/incline", world="soft", slope=30)
"""

from .comparisons import ComparisonError, ComparisonRun, open_comparison, run_comparison
from .heaps import HeapRun, open_heap, run_column, run_heaps, run_pile
from .laboratory import run_tension_test, run_tension_tests
from .plan import SEED, Plan, PlanError, Planned, collect, means, read, run_one
from .safety import factors_of_safety, run_factor_of_safety
from .script_output import ScriptRun, open_script
from .scripts import LESSONS, ScriptError, lesson, lessons, run_lesson, run_script, run_scripts
from .sweep import results_of, run_slope, sweep

__all__ = [
    "LESSONS",
    "SEED",
    "ComparisonError",
    "ComparisonRun",
    "HeapRun",
    "Plan",
    "PlanError",
    "Planned",
    "ScriptError",
    "ScriptRun",
    "collect",
    "factors_of_safety",
    "lesson",
    "lessons",
    "means",
    "open_comparison",
    "open_heap",
    "open_script",
    "read",
    "results_of",
    "run_column",
    "run_comparison",
    "run_factor_of_safety",
    "run_heaps",
    "run_lesson",
    "run_one",
    "run_pile",
    "run_script",
    "run_scripts",
    "run_slope",
    "run_tension_test",
    "run_tension_tests",
    "sweep",
]
