"""A slope as plain, checked data: geometry, rocks, roles of walls, sizes; ``section`` reads and builds it. Needs no
YADE.
"""
