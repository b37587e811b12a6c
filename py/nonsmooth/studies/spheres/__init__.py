"""Scenes of spheres in space, each with hard and with soft contacts through the same code.

::

    from yade.nonsmooth.studies.spheres import column, course

    c = column.RoundColumn(aspect=1.0, size=6)
    found = course.run(c, folder="out/one")           # rigid spheres
    print(found["runout_rel"])

* :mod:`grains`: what all scenes have in common, spheres, sizes and worlds;
* :mod:`column`, :mod:`hopper`, :mod:`drum`, :mod:`pile`: the scenes, their walls, rows and results;
* :mod:`triaxial`: the test between plates (:mod:`cell`), its sample (:mod:`pressing`) and course (:mod:`triaxial_course`);
* :mod:`places`: where spheres are, in memory and as files;
* :mod:`preparation`: spheres at rest in their container, made once for both worlds;
* :mod:`scene`: the scene in a world;
* :mod:`course`: its course from the release on;
* :mod:`recorded_course`: rows, places and checkpoints of this course and of a test's;
* :mod:`study`: many runs, kept and resumed;
* :mod:`report`: tables and numbers over seeds, and pictures of many runs.

Lengths are in m, angles of walls and surfaces in degrees, z is up.
"""
