"""Figures of a run, made from its records alone (no YADE, no display).

Every function takes data and the path of a PNG, returns the path, and takes ``pdf=True`` to write a PDF beside it
(disks and bars rasterised, text and lines as vectors). Walls are given as ``[(name, vertices (n, 2))]``, as objects
with ``name`` and ``vertices``, or as an object that has such ``walls``. Data that lack something raise
:class:`~nonsmooth.records.RecordsError`.
"""

from .forces import force_chains, forces_against_time
from .profiles import deposit, deposit_profile, front, snapshots
from .numerics import energy, solver

__all__ = ["force_chains", "forces_against_time", "snapshots", "deposit", "deposit_profile", "front", "energy", "solver"]
