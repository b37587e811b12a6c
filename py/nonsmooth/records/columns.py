"""What the columns of series.csv and walls.csv mean."""

import re
from typing import NamedTuple

__all__ = ["COLUMNS", "LOSSES", "OWN", "WALL_COLUMNS", "Column", "column", "own_columns", "stem"]


class Column(NamedTuple):
    """What a column of the series means."""

    unit: str
    description: str
    integer: bool = False


def _count(description):
    return Column("1", description, True)


#: The known columns: name -> (unit, description, integer). A series may hold others; these are documented. Where slip surfaces lie one above another, each has some of them for
#: itself, see :data:`OWN`.
COLUMNS = {
    "step": _count("number of the time step, strictly increasing"),
    "time_s": Column("s", "simulated time"),
    "stage": _count("stage of the run in the step: 0 settling, 1 dry rest, 2 water or avalanche"),
    "water_m": Column("m", "height of the water table above its plane (DP), h_w"),
    "dp_normal_total_N_per_m": Column(
        "N/m",
        "total normal force on the lowest slip surfaces (DP), those with no other below, N_DP = N'_DP + U_DP, mean over the row",
    ),
    "dp_normal_effective_N_per_m": Column(
        "N/m", "effective (contact) normal force on the lowest slip surfaces, N'_DP, mean over the row"
    ),
    "dp_water_N_per_m": Column("N/m", "force of the pore water on what these bear, normal to its plane, U_DP"),
    "dp_shear_N_per_m": Column(
        "N/m",
        "shear force on the lowest slip surfaces, T_DP, mean over the row; positive when the wall resists downslope motion",
    ),
    "fb_normal_N_per_m": Column("N/m", "normal force on the backstops (FB), N'_FB, mean over the row; 0 without one"),
    "fb_shear_N_per_m": Column("N/m", "shear force on the backstops, mean over the row"),
    "ss_normal_N_per_m": Column("N/m", "normal force on the walls that are ground (SS), mean over the row"),
    "ss_shear_N_per_m": Column("N/m", "shear force on the walls that are ground, mean over the row"),
    "dp_normal_peak_N_per_m": Column(
        "N/m", "largest effective normal force on the lowest slip surfaces in a step of the row"
    ),
    "fb_normal_peak_N_per_m": Column("N/m", "largest normal force on the backstops in a step of the row"),
    "ss_normal_peak_N_per_m": Column("N/m", "largest normal force on the walls that are ground in a step of the row"),
    "wet_disks": _count("disks that feel pore pressure"),
    "released_disks": _count("disks that were wet and whose pore pressure has been released for good"),
    "speed_mean_m_per_s": Column("m/s", "mean speed of the disks"),
    "speed_max_m_per_s": Column("m/s", "largest speed of a disk"),
    "front_m": Column("m", "position x of the front, in the direction in which the slope falls"),
    "centroid_x_m": Column("m", "centre of mass, x"),
    "centroid_y_m": Column("m", "centre of mass, y"),
    "bonds_alive": _count("cohesive bonds that hold"),
    "bonds_broken_tension": _count("bonds broken in tension so far"),
    "bonds_broken_shear": _count("bonds broken in shear so far"),
    "bonds_broken_torque": _count("bonds broken by rolling so far"),
    "bonds_broken_mixed": _count("bonds broken in several modes at once so far"),
    "contacts": _count("contacts, bonded ones included"),
    "slip_mean_dp_m": Column(
        "m", "mean cumulated slip of the disks that touch those of the lowest slip surfaces which weaken"
    ),
    "weakened_disks": _count("disks whose slip on one of them has passed the critical slip D_c"),
    "iterations": _count("sweeps of the contact solver in the step"),
    "residual": Column("1", "residual of the contact solver at the end of the step"),
    "residual_N_per_m": Column("N/m", "the same as a force: rms over contacts of what the reactions miss of the law"),
    "tolerance": Column("1", "residual that the step was to reach"),
    "overlap_worst_rel": Column("1", "largest overlap, in units of the mean diameter of the pair"),
    "overlap_mean_rel": Column("1", "mean overlap of the contacts, in the same units"),
    "energy_kinetic_J": Column("J/m", "kinetic energy"),
    "energy_potential_J": Column("J/m", "potential energy of gravity"),
    "energy_water_J": Column("J/m", "work done by the pore water"),
    "energy_walls_J": Column("J/m", "work done by walls whose motion is given"),
    "energy_sliding_J": Column("J/m", "energy dissipated by sliding"),
    "energy_rolling_J": Column("J/m", "energy dissipated by rolling"),
    "energy_impact_J": Column("J/m", "energy dissipated by impacts"),
    "energy_bonds_J": Column("J/m", "energy dissipated by pulling contacts apart against their adhesion"),
    "energy_correction_J": Column("J/m", "energy added by the correction of overlaps"),
    "energy_error_rel": Column(
        "1", "what the energy balance leaves over, relative; 0 while settling, as it begins then"
    ),
}


#: The columns of ``walls.csv``, a row for each wall and time: name -> (unit, description, integer). Empty where a wall has no such number.
WALL_COLUMNS = {
    "step": COLUMNS["step"],
    "time_s": COLUMNS["time_s"],
    "wall": Column("-", "name of the wall, of the interface, or of the layer that is an obstacle"),
    "normal_N_per_m": Column(
        "N/m",
        "normal force on the wall, into it positive, mean over the row; across an interface, pressing positive, or the horizontal push of the mass on an "
        "obstacle of disks, downslope positive, in the last step",
    ),
    "shear_N_per_m": Column(
        "N/m",
        "shear force on the wall, mean over the row, or across an interface in the last step; positive when it resists downslope motion; on an obstacle of disks "
        "the downward force",
    ),
    "normal_peak_N_per_m": Column("N/m", "largest normal force in a step of the row; between disks that of the last"),
    "slip_mean_m": Column(
        "m", "mean cumulated slip of the disks that have touched a wall or an interface that weakens"
    ),
    "weakened_disks": _count("disks whose slip on it has passed the critical slip D_c"),
    "weakened_share": Column("1", "the same as a share of the disks that have touched it"),
    "energy_sliding_J": Column(
        "J/m", "energy dissipated by sliding on the wall since the balance began, after settling"
    ),
}

#: The four ways in which contacts dissipate energy.
LOSSES = ("energy_sliding_J", "energy_rolling_J", "energy_impact_J", "energy_bonds_J")

#: Columns of the series that each slip surface has for itself where some lie one above another, see :mod:`..stacks`.
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
    """Name of a column, one of :data:`OWN`, for one slip surface: ``dp_shear_N_per_m:joint``. What a table of numbers would stumble over is left out of the surface's name."""
    plain = re.sub(r'[\s,"]+', " ", surface).strip()
    return f"{name}:{plain}"


def stem(name):
    """The column that one surface's :func:`column` is named after; any other as it is."""
    return name.partition(":")[0]


def own_columns(surfaces):
    """The columns of slip surfaces of these names, in the order of a series: a tuple."""
    return tuple(column(name, surface) for surface in surfaces for name in OWN)
