"""Heaps: a column that collapses and a pile, the same scene with hard and with soft contacts.

::

    from yade.nonsmooth import worlds
    from yade.nonsmooth.heaps import column

    c = column.Column(disks=500, aspect=2.0)
    hard = column.run(c)
    soft = column.run(c, worlds.Soft(stiffness=1e9, diameter=c.diameters()))
    print(hard.runout, soft.runout)

* :mod:`grains`: what both scenes have in common, grains and floor;
* :mod:`column`, :mod:`pile`: the two scenes, their parameters with ``build`` and ``run``;
* :mod:`preparation`: disks at rest in the box, made once for both worlds;
* :mod:`course`: the scene in a world, its release and its course until rest;
* :mod:`study`: many runs, kept and resumed;
* :mod:`profiles`: speed against height behind a tip, over seeds;
* :mod:`report`: fits, tables and pictures of many runs.

All lengths are in m, and forces and energies are those of a slice 1 m thick.
"""

__all__ = ["column", "course", "grains", "pile", "preparation", "profiles", "report", "study"]
