"""Checks of the law and the solver in space: spheres."""
