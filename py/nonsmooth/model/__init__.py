"""A slope as plain, checked data: geometry, rocks, roles of walls, sizes; ``section`` reads and builds it.
``ground_motion`` is what shakes it. Needs no YADE.
"""
