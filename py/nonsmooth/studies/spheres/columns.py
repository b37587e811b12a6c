"""Columns of the series.csv of scenes of spheres: those of all, and those of each kind. Needs no YADE."""

from ...records.columns import Column, count, declared

__all__ = ["COLUMN", "COMMON", "DRUM", "HOPPER", "PILE", "TRIAXIAL"]

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
#: Of a triaxial test; stresses are means over the row, positive in compression.
TRIAXIAL = declared(
    Column("strain", "1", "axial strain, 1 − H/H₀, positive in compression"),
    Column("volumetric_strain", "1", "volume over that at the begin, less 1, positive in dilation"),
    *(
        Column(f"sigma_{name}_Pa", "Pa", f"stress on the {what}")
        for name, what in (
            ("left", "plate at low x"),
            ("right", "plate at high x, which bears σ₃"),
            ("front", "plate at low y"),
            ("back", "plate at high y, which bears σ₃"),
            ("bottom", "plate at low z"),
            ("top", "plate at high z, which is driven"),
        )
    ),
    Column("contacts_sigma1_Pa", "Pa", "axial stress by the forces of all contacts, at the end of the row"),
    Column("contacts_sigma3_Pa", "Pa", "mean of both lateral stresses by them"),
    Column("solid_fraction", "1", "packing fraction in the middle, 2 to 2.75 mean diameters away from the plates"),
    Column("coordination", "1", "mean number of contacts of spheres there, without rattlers"),
    Column("rattlers", "1", "share of spheres there that bear nothing"),
    Column("inertial_number", "1", "rate of strain in units of 1/t_i at the present height"),
)
