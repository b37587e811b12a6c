"""How fast steps and sweeps are on this machine: ``scripts/benchmark.py`` runs these measurements and writes
``benchmark.json``.

* :mod:`steps`: whole time steps, by stage;
* :mod:`sweeps`: sweeps alone, by the path that the solver takes, and the bound that memory sets;
* :mod:`cold_start`: sweeps that a problem needs from zero impulses;
* :mod:`scale`: steps, memory and packing for slopes of very different size;
* :mod:`scale_figure`: its picture;
* :mod:`suite`, :mod:`report`: all of it, and what it says together;
* :mod:`spheres`: sweeps in space beside those in the plane;
* :mod:`sphere_bed`, :mod:`sphere_steps`: a bed of spheres at rest and on the move, hard and soft, and its steps;
* :mod:`space_suite`, :mod:`space_report`: all that is measured in space, and what it says.

The slopes that are timed, at rest, on the move and on soft contacts, stand in
:mod:`yade.nonsmooth.studies.slope.states`.
"""
