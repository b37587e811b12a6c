"""The factor of safety of a slope, by strength reduction: strengths are divided by a factor that grows until the slope
fails, and the factor at which it fails is closed in by bisection.

* :mod:`asked`: what is asked, checked: section, world, strengths that are divided, numbers of the search;
* :mod:`loading`: the slope is loaded until it rests, or fails;
* :mod:`search`: the trials, from that rest on, with their records and checkpoints;
* :mod:`search_run`: what a process of a campaign does;
* :mod:`columns`, :mod:`results`, :mod:`pictures`: of a search: its series, its summary, its figures (need no YADE).

What decides stands in :mod:`yade.nonsmooth.course.strength_reduction`.
"""
