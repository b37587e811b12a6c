"""Laboratory tests of granular rock: biaxial compression, direct tension, sliding on a wall, envelopes, calibration.

Strength of a slope comes from tests of a sample of its rock (Taboada and Estrada 2009, sections 3.2.1, 3.3 and 5.2,
Figures 9 to 11, Table 1).

* :mod:`pressing`: dense packings, pressed once and kept;
* :mod:`walls`: the four walls around a sample;
* :mod:`sample`: a pressed sample in the scene, made of the rock;
* :mod:`membrane`: sides that are flexible;
* :mod:`biaxial_test`, :mod:`biaxial`: one test as data; from compression to the residual state, with checkpoints;
* :mod:`campaign`, :mod:`report`: many tests side by side, and what they say together;
* :mod:`tension_test`, :mod:`tension`, :mod:`tension_campaign`, :mod:`tension_report`: the same of direct tension;
* :mod:`sample_course`, :mod:`sample_runs`: what both kinds share;
* :mod:`effects`: what the strength depends on besides the material;
* :mod:`wall_shear`: sliding of a block on a wall;
* :mod:`table1`: the rock and the walls together, beside the paper's Table 1;
* :mod:`rock_table`: rocks of given strengths;
* :mod:`calibration`: contact parameters for wanted strengths.

What is measured in a test stands in :mod:`yade.nonsmooth.measure`: strength, bands, fluctuations, cycles; materials in
the model.
"""

from ...model import materials

__all__ = ["materials"]
