"""Columns of a slope's series.csv and walls.csv. Needs no YADE."""

from ...records.columns import BONDS, STEP, TIME, Column, count, declared

__all__ = [
    "COLUMNS",
    "ERODING",
    "FURTHER",
    "LEDGER_COLUMNS",
    "OF_SHAKING",
    "OF_SURFACES",
    "PERMANENT",
    "RELEASED",
    "SURFACE_COLUMNS",
    "WALL_COLUMNS",
]

#: Of ``series.csv``: {name: Column}. Where slip surfaces lie one above another, each has some of them for itself, see
#: :data:`.records.columns.OWN`.
COLUMNS = declared(
    STEP,
    TIME,
    count("stage", "stage of the run in the step: 0 settling, 1 dry rest, 2 water or avalanche"),
    Column(
        "water_m",
        "m",
        "height of the water table above its plane (DP), h_w; of a field of water the mean pressure head p/γ_w on the slip "
        "surfaces",
    ),
    Column(
        "dp_normal_total_N_per_m",
        "N/m",
        "total normal force on the lowest slip surfaces (DP), those with no other below, N_DP = N'_DP + U_DP, mean over the row",
    ),
    Column(
        "dp_normal_effective_N_per_m",
        "N/m",
        "effective (contact) normal force on the lowest slip surfaces, N'_DP, mean over the row",
    ),
    Column("dp_water_N_per_m", "N/m", "force of the pore water on what these bear, normal to its plane, U_DP"),
    Column(
        "dp_shear_N_per_m",
        "N/m",
        "shear force on the lowest slip surfaces, T_DP, mean over the row; positive when the wall resists downslope motion",
    ),
    Column("fb_normal_N_per_m", "N/m", "normal force on the backstops (FB), N'_FB, mean over the row; 0 without one"),
    Column("fb_shear_N_per_m", "N/m", "shear force on the backstops, mean over the row"),
    Column("ss_normal_N_per_m", "N/m", "normal force on the walls that are ground (SS), mean over the row"),
    Column("ss_shear_N_per_m", "N/m", "shear force on the walls that are ground, mean over the row"),
    Column(
        "dp_normal_peak_N_per_m",
        "N/m",
        "largest effective normal force on the lowest slip surfaces in a step of the row",
    ),
    Column("fb_normal_peak_N_per_m", "N/m", "largest normal force on the backstops in a step of the row"),
    Column("ss_normal_peak_N_per_m", "N/m", "largest normal force on the walls that are ground in a step of the row"),
    count("wet_disks", "disks that feel pore pressure"),
    count("released_disks", "disks that were wet and whose pore pressure has been released for good"),
    Column("speed_mean_m_per_s", "m/s", "mean speed of the disks"),
    Column("speed_max_m_per_s", "m/s", "largest speed of a disk"),
    Column("front_m", "m", "position x of the front, in the direction in which the slope falls"),
    Column("centroid_x_m", "m", "centre of mass, x"),
    Column("centroid_y_m", "m", "centre of mass, y"),
    *BONDS,
    count("contacts", "contacts, bonded ones included"),
    Column(
        "slip_mean_dp_m",
        "m",
        "mean cumulated slip of the disks that touch those of the lowest slip surfaces which weaken",
    ),
    count("weakened_disks", "disks whose slip on one of them has passed the critical slip D_c"),
    count("iterations", "sweeps of the contact solver in the step"),
    Column("residual", "1", "residual of the contact solver at the end of the step"),
    Column("residual_N_per_m", "N/m", "the same as a force: rms over contacts of what the reactions miss of the law"),
    Column("tolerance", "1", "residual that the step was to reach"),
    Column("overlap_worst_rel", "1", "largest overlap, in units of the mean diameter of the pair"),
    Column("overlap_mean_rel", "1", "mean overlap of the contacts, in the same units"),
    Column("energy_kinetic_J", "J/m", "kinetic energy"),
    Column("energy_potential_J", "J/m", "potential energy of gravity"),
    Column(
        "energy_water_J",
        "J/m",
        "work done by the pore water; where the ground shakes, in its frame, also by the inertia of the disks",
    ),
    Column("energy_walls_J", "J/m", "work done by walls whose motion is given"),
    Column("energy_sliding_J", "J/m", "energy dissipated by sliding"),
    Column("energy_rolling_J", "J/m", "energy dissipated by rolling"),
    Column("energy_impact_J", "J/m", "energy dissipated by impacts"),
    Column("energy_bonds_J", "J/m", "energy dissipated by pulling contacts apart against their adhesion"),
    Column("energy_correction_J", "J/m", "energy added by the correction of overlaps"),
    Column(
        "energy_error_rel", "1", "what the energy balance leaves over, relative; 0 while settling, as it begins then"
    ),
)

#: Of a section whose water local dilatancy releases, besides.
RELEASED = Column(
    "water_released_rel",
    "1",
    "share that local dilatancy has released of the pressure on disks that water has acted on, by their area",
)

#: Of a section that shakes, besides: {name: Column}.
OF_SHAKING = declared(
    Column(
        "ground_acceleration_x_m_per_s2",
        "m/s²",
        "acceleration of the ground to the right, mean over the row's last step",
    ),
    Column("ground_acceleration_y_m_per_s2", "m/s²", "the same upwards"),
)
#: And of each slip surface, ``displacement_m:joint``.
PERMANENT = Column(
    "displacement_m",
    "m",
    "displacement along the slip surface since t0: mean way down it of the disks that touched it then",
)

#: Of ``series.csv`` besides, where the section has windows that take disks out: {name: Column}.
ERODING = declared(
    count("eroded_disks", "disks that have been taken out so far; those of the row's own time show in the next one"),
    Column("eroded_kg_per_m", "kg/m", "mass of these disks, the sum of the ledger, eroded.csv"),
    Column(
        "energy_eroded_J",
        "J/m",
        "kinetic and potential energy, 0 at the origin, that they had when they were taken out, and that left with them",
    ),
    Column("eroded_shift_x_m", "m", "how far the centre of mass has jumped as they were taken out, x"),
    Column("eroded_shift_y_m", "m", "the same, y"),
)

#: Of ``series.csv`` besides, where slip surfaces have slip laws, means over their cells by the load that these bear:
#: {name: Column}.
OF_SURFACES = declared(
    Column("cells_slip_m", "m", "mean slip of the cells along slip surfaces with slip laws, since the slope settled"),
    Column(
        "cells_friction_rel",
        "1",
        "mean friction of these cells, in parts of that before slip: what is left of the strength",
    ),
    Column(
        "cells_weakened_rel", "1", "share of their load that is borne where friction is below half of that before slip"
    ),
)

#: All that the series of some sections have besides: {name: Column}.
FURTHER = OF_SHAKING | {PERMANENT.name: PERMANENT} | ERODING | OF_SURFACES

#: Of ``eroded.csv``, the ledger, a row for each disk that was taken out: {name: Column}.
LEDGER_COLUMNS = declared(
    STEP,
    TIME,
    Column("window", "-", "name of the window that took it", str),
    Column("window_time_s", "s", "time of the window then, since t0, without that in which it stood still"),
    count("disk", "number of the disk, as in snapshots and in breaks.csv"),
    Column("layer", "-", "name of its layer", str),
    Column("mass_kg_per_m", "kg/m", "its mass"),
    Column("x_m", "m", "where its centre was, x"),
    Column("y_m", "m", "the same, y"),
    Column("r_m", "m", "its radius"),
    Column("vx_m_per_s", "m/s", "its velocity, x"),
    Column("vy_m_per_s", "m/s", "the same, y"),
    Column("energy_kinetic_J", "J/m", "its kinetic energy, with that of its rotation"),
    Column("energy_potential_J", "J/m", "its potential energy, 0 at the origin"),
)


#: Of ``slip_surface.csv``, a row for each cell of a wall with a slip law, and time: {name: Column}. Empty where the law
#: has no such number.
SURFACE_COLUMNS = declared(
    STEP,
    TIME,
    Column("wall", "-", "name of the wall", str),
    count("cell", "number of the cell along the wall"),
    Column("x_m", "m", "its middle, x"),
    Column("y_m", "m", "the same, y"),
    Column("length_m", "m", "its length"),
    Column("slip_m", "m", "what has slid on it, since the slope settled"),
    Column("slip_rate_m_per_s", "m/s", "how fast, in the last step"),
    Column("normal_stress_Pa", "Pa", "normal stress that disks bear there, a mean over the last slip"),
    Column("friction", "-", "friction of contacts there in the next step"),
    Column("temperature_degC", "°C", "mean temperature of the zone", optional=True),
    Column("hottest_degC", "°C", "highest temperature across the zone", optional=True),
    Column("pressure_Pa", "Pa", "mean excess pore pressure of the zone", optional=True),
    Column("vapour", "1", "1 from where the water of the zone boils on, 0 before", optional=True),
    Column("reacted", "-", "share that has reacted, of the zone", optional=True),
    Column("melt_m", "m", "thickness of the layer of melt", optional=True),
)


#: Of ``walls.csv``, a row for each wall and time: {name: Column}. Empty where a wall has no such number.
WALL_COLUMNS = declared(
    STEP,
    TIME,
    Column("wall", "-", "name of the wall, of the interface, or of the layer that is an obstacle", str),
    Column(
        "normal_N_per_m",
        "N/m",
        "normal force on the wall, into it positive, mean over the row; across an interface, pressing positive, or the horizontal push of the mass on an "
        "obstacle of disks, downslope positive, in the last step",
    ),
    Column(
        "shear_N_per_m",
        "N/m",
        "shear force on the wall, mean over the row, or across an interface in the last step; positive when it resists downslope motion; on an obstacle of disks "
        "the downward force",
    ),
    Column("normal_peak_N_per_m", "N/m", "largest normal force in a step of the row; between disks that of the last"),
    Column(
        "slip_mean_m",
        "m",
        "mean cumulated slip of the disks that have touched a wall or an interface that weakens",
        optional=True,
    ),
    count("weakened_disks", "disks whose slip on it has passed the critical slip D_c", optional=True),
    Column("weakened_share", "1", "the same as a share of the disks that have touched it", optional=True),
    Column(
        "energy_sliding_J",
        "J/m",
        "energy dissipated by sliding on the wall since the balance began, after settling",
        optional=True,
    ),
    Column(
        "heat_J",
        "J/m",
        "heat that the cells of a wall with a slip law got since the slope settled: what sliding dissipated there",
        optional=True,
    ),
)
