"""A triaxial test: spheres without gravity between six plates, pressed alike on all sides, then compressed along z while
the sides bear the confining pressure.

Stresses are positive in compression: σ₁ along z, σ₃ on the sides. The unit of time is t_i = d √(ρ/σ₃), with d the mean
diameter and ρ the density of the spheres: a sphere that σ₃ pushes goes over its diameter in it. The rate of strain is
I/t_i, with I the inertial number.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...measure import triaxial as measures
from . import columns
from .grains import PATH_PER_STEP, Spheres, SpheresError

__all__ = ["TriaxialTest"]

FILLED = 0.6  # packing fraction by which the number of spheres follows from the size that is asked for
LOOSE = 0.2  # packing fraction of the cloud before it is pressed
TRIES = 2000  # places that are tried for a sphere of the cloud


@dataclass(frozen=True)
class TriaxialTest(Spheres):
    """A test. ``size``: edge of the sample in mean diameters, about; ``pressure``: σ₃ [Pa]; ``strain``: axial strain to
    which it is compressed; ``inertia``: the inertial number I; ``friction_share``: share of sliding, rolling and twisting
    friction that the spheres have while the sample is made (0: the densest, 1: loose). The plates have no friction. The
    other parameters are those of :class:`.spheres.grains.Spheres`.
    """

    rolling_friction: float = 0.0
    size: float = 10.0
    pressure: float = 1e5
    strain: float = 0.3
    inertia: float = 1e-3
    friction_share: float = 1.0

    __test__ = False  # no test of pytest's

    KIND = "triaxial"
    #: Columns of the series besides those of all scenes.
    COLUMNS = columns.TRIAXIAL
    #: Strains at which places are kept, besides the end.
    FRAMES = (0.0, 0.1, 0.2)

    def _check(self):
        self._number("size", "give the sample's edge in mean diameters, from 4 to 60", least=4, most=60)
        self._number("pressure", "give σ₃ [Pa], above 0", above=0)
        least = measures.SHORTEST
        self._number("strain", f"give the axial strain, from {least:g} to 0.6", least=least, most=0.6)
        self._number("inertia", "give the inertial number, above 0 and up to 0.01: a test is slow", above=0, most=0.01)
        self._number("friction_share", "give a share from 0 to 1", least=0, most=1)

    @property
    def unit(self):
        """t_i [s]."""
        return self.diameter * math.sqrt(self.density / self.pressure)

    @property
    def rate(self):
        """Rate of the axial strain at the beginning [1/s]."""
        return self.inertia / self.unit

    def sizes_told(self):
        """The parameters on which the number of spheres depends, with their values, in words."""
        return f"size {self.size:g}"

    def count(self):
        """Number of spheres."""
        return round(FILLED * (self.size * self.diameter) ** 3 / self.mean_volume())

    def cloud(self, radii):
        """Edge [m] of the cube in which spheres of these ``radii`` (n,) are put before they are pressed."""
        return (4 / 3 * math.pi * float(np.sum(radii**3)) / LOOSE) ** (1 / 3)

    def sites(self, radii):
        """Places (n, 3) [m] for spheres of these ``radii``, at random in a cube from 0 on, the largest first, so that no
        lattice is remembered. Raises SpheresError where they do not fit.
        """
        edge, rng = self.cloud(radii), np.random.default_rng([self.seed, 3])
        at, done = np.zeros((len(radii), 3)), []
        for k in np.argsort(-radii, kind="stable"):
            for one in rng.uniform(radii[k], edge - radii[k], (TRIES, 3)):
                if np.all(((at[done] - one) ** 2).sum(axis=1) > (radii[done] + radii[k]) ** 2):
                    break
            else:
                raise SpheresError(f"seed {self.seed}: the spheres do not fit into their cloud; give another seed")
            at[k] = one
            done.append(k)
        return at

    def stand(self, walls, top):
        """Six plates around a cell with the edges ``top`` (3,) [m], in whose middle the origin is: the low and the high
        one of x, of y and of z.
        """
        edges = np.asarray(top, float)
        thick = 0.5 * float(edges.max())
        for axis in range(3):
            half = np.where(np.arange(3) == axis, thick, 4 * thick)  # they reach beyond each other's faces
            for side in (-1, 1):
                walls.box(np.where(np.arange(3) == axis, side * (0.5 * edges + thick), 0), half, smooth=True)

    def time_step(self, path=PATH_PER_STEP):
        """Step [s] for hard contacts: a sphere of the speed √(σ₃/ρ) goes over ``path`` mean diameters."""
        return path * self.unit

    def overlap(self, stiffness):
        """As :meth:`.grains.Spheres.overlap`: the force σ₃ d² over the spring E d/2."""
        return 2 * self.pressure / stiffness, f"under {self.pressure:g} Pa"

    def lasts(self, duration=None):
        """As :meth:`.grains.Spheres.lasts`: the time of the strain, at the rate of the beginning."""
        return self.strain / self.rate

    def effort(self):
        """As :meth:`.grains.Spheres.effort`."""
        return self.count() * self.strain / self.inertia

    def results(self, series, state):
        """Numbers of a run at its end, a dictionary; ``state``: that of the course, with the ``isotropic`` one."""
        return {
            "edges_m": state["edges"],
            **{f"isotropic_{name}": value for name, value in state["isotropic"].items()},
            **measures.strengths(series),
            "strain": float(series["strain"][-1]),
            "solid_fraction_end": float(series["solid_fraction"][-1]),
            "coordination_end": float(series["coordination"][-1]),
            "inertial_number": float(np.max(series["inertial_number"])),
        }
