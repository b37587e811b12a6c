"""Measures of a run: arrays in, numbers out. Needs no YADE.

* :mod:`.ground`: walls by their roles, the foot of the slope, where water stands
* :mod:`.fronts`: how far a mass has come
* :mod:`.travel`: how far beside how deep, the travel angle
* :mod:`.layers`: whether layers have mixed, and where they are turned over
* :mod:`.surface`: the surface of a mass and what lies below it
* :mod:`.energy`: what the balance of energy leaves over
* :mod:`.force_stages`: what the forces on walls do from stage to stage
* :mod:`.bands`, :mod:`.toe_bands`: shear bands, of a sample and in the toe of a slope
* :mod:`.creep`: how fast a mass goes on moving
* :mod:`.velocity_profiles`: speed against height in a mass that spreads, and what of it rests
* :mod:`.weakening`: which part of a slip surface has lost its strength
"""
