"""Columns of a series: a study declares those that it writes, with unit and meaning, where it writes them. Here stands
how, and what several studies have.
"""

import re
from typing import NamedTuple

from .breaks import BREAK_MODES

__all__ = [
    "BONDS",
    "LOSSES",
    "OWN",
    "STEP",
    "TIME",
    "Column",
    "column",
    "count",
    "declared",
    "own_columns",
    "stem",
    "without",
]


class Column(NamedTuple):
    """A column of a series: its ``name``, which ends in its ``unit`` ("1": a number without, "-": no number), and its
    ``meaning``.

    ``kind``: int for counts, float, str for words; None where nothing is known but the name, and a number is written as
    what it is. ``optional``: a cell may be empty.
    """

    name: str
    unit: str = "1"
    meaning: str = ""
    kind: type = float
    optional: bool = False

    @property
    def integer(self):
        """Whether it counts."""
        return self.kind is int

    @property
    def description(self):
        """Its ``meaning``."""
        return self.meaning


def count(name, meaning, **more):
    """A :class:`Column` of whole numbers."""
    return Column(name, "1", meaning, int, **more)


def declared(*columns):
    """The :class:`Column` of a series in their order: {name: Column}, as a SeriesWriter takes them."""
    return {column.name: column for column in columns}


def without(columns, names):
    """Those of ``columns``, {name: Column}, that have none of these ``names``."""
    return {name: column for name, column in columns.items() if name not in names}


STEP = count("step", "number of the time step, strictly increasing")
TIME = Column("time_s", "s", "simulated time")
_BROKEN = ("in tension", "in shear", "by rolling", "in several modes at once")
#: The columns of :func:`yade.nonsmooth.tables.bonds`.
BONDS = (
    count("bonds_alive", "cohesive bonds that hold"),
    *(count(f"bonds_broken_{mode}", f"bonds broken {how} so far") for mode, how in zip(BREAK_MODES[1:], _BROKEN)),
)

#: The four ways in which contacts dissipate energy.
LOSSES = ("energy_sliding_J", "energy_rolling_J", "energy_impact_J", "energy_bonds_J")

#: Columns of the series that each slip surface has for itself where some lie one above another, see
#: :mod:`.model.stacks`.
OWN = (
    "dp_normal_total_N_per_m",
    "dp_normal_effective_N_per_m",
    "dp_water_N_per_m",
    "dp_shear_N_per_m",
    "dp_normal_peak_N_per_m",
    "slip_mean_dp_m",
    "weakened_disks",
)


def column(name, surface):
    """Name of a column, one of :data:`OWN`, for one slip surface: ``dp_shear_N_per_m:joint``. What a table of numbers
    would stumble over is left out of the surface's name.
    """
    plain = re.sub(r'[\s,"]+', " ", surface).strip()
    return f"{name}:{plain}"


def stem(name):
    """The column that one surface's :func:`column` is named after; any other as it is."""
    return name.partition(":")[0]


def own_columns(surfaces):
    """The columns of slip surfaces of these names, in the order of a series: a tuple."""
    return tuple(column(name, surface) for surface in surfaces for name in OWN)
