"""Columns of the series.csv of a column that collapses, or of a pile. Needs no YADE."""

from ...records.columns import Column, count, declared

__all__ = ["COLUMNS"]

#: {name: Column}; the connected disks are those of :func:`.measure.heap.connected`.
COLUMNS = declared(
    count("step", "number of the time step since the release"),
    Column("time_s", "s", "simulated time since the release"),
    Column("front_m", "m", "right edge of the connected disks, x"),
    Column("front_left_m", "m", "their left edge, x"),
    Column("farthest_m", "m", "right edge of any disk, x"),
    Column("height_m", "m", "highest point of the surface of the connected disks, y"),
    Column("centroid_x_m", "m", "centre of mass of all disks, x"),
    Column("centroid_y_m", "m", "centre of mass of all disks, y"),
    Column("energy_kinetic_J", "J/m", "kinetic energy of all disks"),
    Column("energy_potential_J", "J/m", "potential energy of gravity of all disks, 0 at y = 0"),
    count("connected_disks", "connected disks"),
    Column(
        "overlap_mean_rel", "1", "mean overlap of close pairs, in units of their mean diameter; 0 for one with a gap"
    ),
    Column("overlap_worst_rel", "1", "largest overlap, in the same units"),
    Column("wall_s", "s", "wall time of the steps since the release"),
)
