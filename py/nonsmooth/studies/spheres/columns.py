"""Columns of the series.csv of scenes of spheres: those of all, and those of each kind. Needs no YADE."""

from ...records.columns import Column, count, declared

__all__ = ["COLUMN", "COMMON", "DRUM", "HOPPER", "PILE"]

#: {name: Column} of all scenes.
COMMON = declared(
    count("step", "number of the time step since the release"),
    Column("time_s", "s", "simulated time since the release"),
    count("spheres", "spheres that are there"),
    Column("centroid_z_m", "m", "height of their centre of mass"),
    Column("height_m", "m", "highest point of any of them"),
    Column("speed_rms_m_per_s", "m/s", "root mean square of the speed of those that must rest for the course to end"),
    Column("energy_kinetic_J", "J", "kinetic energy of all of them"),
    Column("overlap_mean_rel", "1", "mean overlap of close pairs, in units of ℓ; 0 for one with a gap"),
    Column("overlap_worst_rel", "1", "largest overlap, in the same units"),
    Column("wall_s", "s", "wall time of the steps since the release"),
)
#: Of a column that collapses.
COLUMN = declared(
    Column("edge_m", "m", "edge of the mass: where its height, a mean around the axis, is half of a mean diameter"),
    Column("edge_connected_m", "m", "mean over 24 sectors of the farthest point of the connected spheres"),
    Column("farthest_m", "m", "farthest point of any sphere from the axis"),
    count("connected_spheres", "spheres that hang together over gaps below 5 % of a mean diameter"),
)
#: Of a hopper.
HOPPER = declared(
    count("discharged_spheres", "spheres whose centres have passed the opening"),
    Column("discharged_kg", "kg", "their mass"),
)
#: Of a drum.
DRUM = declared(
    Column("turned_deg", "deg", "angle by which the drum has turned"),
    Column("tilt_deg", "deg", "angle of the surface, by the centre of mass"),
    Column(
        "tilt_surface_deg", "deg", "the same, by a line through the tops in the middle half of the width; 0: too few"
    ),
)
#: Of a pile.
PILE = declared(
    Column("repose_deg", "deg", "angle of repose: slope of the flank between 20 and 80 % of its height; 0: no flank"),
    count("lost_spheres", "spheres that have fallen over the edge of the plate"),
)
