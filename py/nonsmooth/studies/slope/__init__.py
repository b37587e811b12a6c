"""A slope from its packing to its rest, and what became of it.

* ``slope``, ``slope_packing``: the scene, and disks pressed for it;
* ``experiment``: the run, which begins, goes on and decides; ``attached``: the same by an engine of the scene;
* ``monitoring``, ``wall_series``: what is seen of it, and its records;
* ``run_files``: the files that a run leaves in its folder;
* ``frames``, ``verdict``, ``results``: frames at times of note, what happened, the summary;
* ``run_figures``: the figures of a run;
* ``states``, ``soft_contacts``, ``measuring``: a slope at rest and on the move, on which steps are timed.
"""
