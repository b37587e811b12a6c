"""Many runs as one plan: made and checked before any begins, run side by side here or on a cluster, collected into one table. Needs no YADE: each run has a
process of its own.

* :mod:`sweep`: a slope with some of its values varied, and a slope alone;
* :mod:`plan`: a plan in its folder: run, resumed, collected;
* :mod:`cluster`: the same plan for Snakemake and for Slurm;
* :mod:`slope_run`: what a process does (in YADE).

Like this::

    plan = campaign.sweep(section.load("circle").with_disks(600), {"materials.soil.friction": [0.3, 0.5], "seed": [1, 2]})
    table = plan.run("out/sweep", threads=2)      # a dictionary of columns; pandas.DataFrame(table) where one likes
"""

from .plan import SEED, Plan, PlanError, Planned, collect, means, read, run_one
from .sweep import run_slope, sweep

__all__ = ["SEED", "Plan", "PlanError", "Planned", "collect", "means", "read", "run_one", "run_slope", "sweep"]
