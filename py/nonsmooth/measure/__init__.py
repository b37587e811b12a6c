"""Measures: arrays in, numbers out. Needs no YADE.

Of a slope:

* :mod:`.ground`: walls by their roles, the foot of the slope, where water stands
* :mod:`.fronts`: how far a mass has come
* :mod:`.centroid`: the way of its centre
* :mod:`.travel`: how far beside how deep, the travel angle
* :mod:`.layers`: whether layers have mixed, and where they are turned over
* :mod:`.surface`: the surface of a mass and what lies below it
* :mod:`.energy`: what the balance of energy leaves over
* :mod:`.force_stages`: what the forces on walls do from stage to stage
* :mod:`.characteristic_times`: t0 to t5
* :mod:`.toe`, :mod:`.toe_bands`: the passive strength of the toe, and its shear bands
* :mod:`.creep`: how fast a mass goes on moving
* :mod:`.weakening`: which part of a slip surface has lost its strength
* :mod:`.newmark`: how far a rigid block slides on a plane that shakes
* :mod:`.vertical_cut`: the height to which a vertical face stands

Of tests and heaps:

* :mod:`.strength`: peak, plateau, dilatancy, and the envelope of the circles
* :mod:`.bands`: shear bands from the rotation of disks
* :mod:`.tensile`: peak and work of a tension test
* :mod:`.fracture`: place and inclination of the break
* :mod:`.weakest_cut`: what the bonds of a sample bear in tension at most
* :mod:`.fluctuations`, :mod:`.cycles`: how the stress fluctuates, and its rises and drops
* :mod:`.heap`: front, surface, angle of repose and overlaps from places alone
* :mod:`.sphere_heaps`: the same of spheres in space, the surface in a drum, the rate out of a hopper
* :mod:`.velocity_profiles`: speed against height in a mass that spreads, and what of it rests
* :mod:`.power_laws`: published laws of runout and height, and fitted exponents
* :mod:`.sphere_laws`: published laws of round columns in space

Of several runs:

* :mod:`.statistics`: confidence over seeds, medians, spreads
"""
