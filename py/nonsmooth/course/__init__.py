"""What happens when, in a run. Needs no YADE, but for steps.

* :mod:`driver`: drives any course: slopes, biaxial tests, heaps, slides;
* :mod:`slope`: what decides the course of a slope's run, from a state and what a row sees; its names stand here too.
"""

from .slope import *  # noqa: F403
