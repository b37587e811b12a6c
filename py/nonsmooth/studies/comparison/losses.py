"""Bonds of the soft runs of a comparison in words, and what their model does not have of the hard law."""

from __future__ import annotations

import dataclasses

from ...world import soft, worlds

__all__ = ["of_case"]

FULLEST = "cohesion_moment"  # the model that loses least; the report names what others lose beside it


def of_case(experiment, case):
    """Bonds between the disks of a soft Case in words, and what its model loses beside what cohesion_moment does:
    (text, list of texts).

    ``experiment``: module or object with ``disks_of(case)``, but of spheres; see :mod:`outcomes`. Raises SoftError for a material that
    the model cannot have.
    """
    if case.model is None:
        return "no bonds between spheres in either world", []
    materials, diameter = experiment.disks_of(case)
    world = worlds.Soft(
        case.stiffness, diameter, model=case.model, damping=case.damping, step_share=case.step, fragile=case.fragile
    )
    fullest = dataclasses.replace(world, model=FULLEST)
    lost = {}
    for m in materials:  # the same for each; but each has to have an equivalent
        known = soft.describe(fullest.equivalent(m)).lost
        lost |= dict.fromkeys(line for line in soft.describe(world.equivalent(m)).lost if line not in known)
    if case.model == "friction" and not any(
        m.bonded or m.rolling_friction or m.residual_rolling_friction for m in materials
    ):
        lost = {}  # it has neither bonds nor moments, and these disks need none
    return _bonds(materials, world), list(lost)


def _bonds(materials, world):
    if not any(m.bonded for m in materials):
        return "no bonds between disks in either world"
    if world.model == "friction":
        return "no bonds between disks, which the hard ones have"
    if world.ductile:
        return "ductile bonds"
    return "fragile bonds" + (", the only ones of this model" if world.model != FULLEST else "")
