"""A slope from its packing to its rest, and what became of it.

* ``slope``, ``slope_packing``: the scene, and disks pressed for it;
* ``experiment``, ``wall_series``: the run and its records;
* ``frames``, ``verdict``, ``results``: frames at times of note, what happened, the summary;
* ``run_figures``: the figures of a run;
* ``states``, ``soft_contacts``, ``measuring``: a slope at rest and on the move, on which steps are timed.
"""
