"""What to do instead of keys that people try in a section and that it does not have. The page "What a section cannot
say" shows the same table.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["HINTS", "Hint", "instead_of"]


class Hint(NamedTuple):
    """Keys that ask for one thing, and what to do instead of them."""

    about: str  # the thing, as the documentation names it
    keys: str  # separated by blanks; in small letters, with _ between words
    instead: str  # one or two sentences, without the full stop
    inside: str = ""  # the hint holds below this key of the section alone, of two words: stages.settle
    outside: str = ""  # the hint does not hold below this one


HINTS = (
    Hint(
        "earthquakes",
        "earthquake earthquakes seismic seismicity seismic_coefficient kh kv k_h k_v pga accelerogram acceleration horizontal_acceleration ground_motion",
        "an earthquake is the key `shaking`: {file: RECORD.AT2, begin: 1.0}, or {synthetic: {peak: 3.0, duration: 20, frequency: 1.5}}, accelerations in m/s²; "
        "for a constant coefficient kh turn a dry section by atan(kh) and multiply `gravity` by sqrt(1 + kh²)",
    ),
    Hint(
        "factors of safety, yield coefficients",
        "ky k_y kc yield_coefficient yield_acceleration critical_acceleration fs fos factor_of_safety safety_factor",
        "this is a result and not an input: scripts/factor_of_safety.py finds the factor of safety; for a yield coefficient tilt the section, and see which runs stand",
    ),
    Hint(
        "lines of the water table",
        "phreatic phreatic_line phreatic_surface piezometric piezometric_line piezometric_surface piezometer groundwater ground_water groundwater_level gwl water_table water_level head "
        "hydraulic_head total_head",
        "lines are given below `water`: water: {phreatic: {lines: [{time: s, points: [[x, y], ...]}, ...]}}; a table "
        "parallel to a plane as water: {plane: NAME, table: {points: [[t, h], ...]}}, with h the height above the "
        "plane, along its normal",
    ),
    Hint(
        "reservoirs",
        "reservoir reservoir_level lake lake_level pond pool sea sea_level tailwater drawdown",
        "a reservoir is a level in the states of seepage: water: {seepage: {size: m, conductivity: m/s, states: [{time: "
        "s, reservoir: level}, ...]}}, with drained: false for a rapid drawdown; or a phreatic line that is level over the ground",
    ),
    Hint(
        "pore pressure ratios",
        "ru r_u pore_pressure pore_pressures pore_pressure_ratio pore_pressure_coefficient pwp bbar suction",
        "a section takes a water table, lines, or pressures of files (water.field), and no ratio: with the ratio ru give water.volume: bulk and in water.table the height h = ru γ H / (γ_w cos² β), H being the thickness "
        "along the normal of the slip surface, β its dip, and γ the unit weight of the rock",
    ),
    Hint(
        "flow of water",
        "rain rainfall infiltration recharge permeability conductivity hydraulic_conductivity k_sat ksat storage seepage consolidation drainage drain drains",
        "steady flow is computed by `water.seepage`: {size: m, conductivity: m/s, states: [{time: s, rain: m/s, "
        "reservoir: m, boundaries: [...]}, ...]}; no water is stored",
    ),
    Hint(
        "strengths outside of a material",
        "cohesion c friction_angle phi angle_of_friction internal_friction angle_of_internal_friction friction strength tensile_strength",
        "a strength belongs to a material: give it below materials.NAME, and the layer or the wall `material: NAME`",
        outside="materials",
    ),
    Hint(
        "strengths of a rock, in a material",
        "phi c phi_peak phi_residual c_peak c_residual su undrained_strength ucs uniaxial_compressive_strength compressive_strength gsi hoek_brown mohr_coulomb shear_strength",
        "give the peak strength of a rock as `cohesion` [Pa] and `friction_angle` [degrees], or the strengths of its contacts as `friction` and `tensile_strength`, which scripts/calibrate.py finds for other rocks",
        inside="materials",
    ),
    Hint(
        "stiffness and damping",
        "young youngs_modulus young_modulus modulus elastic_modulus e_modulus e poisson poisson_ratio poissons_ratio nu stiffness kn ks normal_stiffness shear_stiffness bulk_modulus shear_modulus "
        "damping viscosity viscous_damping",
        "contacts are rigid and have neither stiffness nor damping: leave it out. scripts/compare_hard_soft.py --scenario slope runs a section with YADE's soft contacts",
    ),
    Hint(
        "dilatancy",
        "dilatancy dilation dilatation dilation_angle dilatancy_angle psi",
        "dilatancy follows from the packing and the friction: scripts/biaxial.py measures it",
    ),
    Hint(
        "weight of a rock",
        "unit_weight gamma specific_weight weight bulk_density dry_density saturated_density",
        "give the material the `density` of its disks [kg/m³]: unit weight / gravity / packing fraction",
    ),
    Hint(
        "porosity",
        "porosity void_ratio relative_density compaction",
        "give `disks.packing_fraction`, the area of disks by area of bulk: 1 - porosity, in two dimensions",
    ),
    Hint(
        "sizes of grains",
        "radius radii rmin rmax rmean d50 d10 grain_size grain_sizes particle_size psd grading gradation block_size",
        "give `disks.diameter: [smallest, largest]` in m and `disks.distribution`; a layer may have a `disks` of its own",
    ),
    Hint(
        "ground and shape of the slope",
        "topography topo surface profile terrain dem elevation bedrock ground geometry boundary boundaries slope_angle slope_height",
        "the ground is a polyline in `walls`, with role: ground or slip, and what may slide is a polygon in `layers`",
    ),
    Hint(
        "joints and weak layers",
        "fault faults joint joints joint_set joint_sets discontinuity discontinuities fracture fractures bedding weak_layer weak_plane slip_surface slip_surfaces failure_surface dfn",
        "a slip surface is a wall with role: slip, or an item of `interfaces` between two layers; a set of many joints is not possible",
    ),
    Hint(
        "loads",
        "load loads surcharge force forces pressure stress foundation building traffic",
        "a section has no loads but weight and water: lay a layer with a `density` of its own on the slope, or let a script push bodies by ForceEngine while the slope runs (Experiment.attach)",
    ),
    Hint(
        "support and barriers",
        "anchor anchors bolt bolts rock_bolt rock_bolts nail nails soil_nail geotextile geogrid reinforcement support retaining_wall gabion barrier barriers dam dams net pile piles",
        "what stands in the way is a wall or a layer with role: obstacle, whose forces are in walls.csv; anchors, nets and nails are not possible",
    ),
    Hint(
        "excavation and erosion",
        "excavation excavations excavate cut cuts undercut undercutting erosion_rate toe_erosion foot_erosion scour "
        "incision",
        "give `erosion`, a list of windows that take disks out of the running slope: {name, vertices, begin}, with "
        "`end` and `velocity` for one that moves, `opening` for one that is dug",
    ),
    Hint(
        "construction",
        "construction fill fills embankment berm",
        "a section gets no disks while it runs: give what is to be built as a layer from the beginning",
    ),
    Hint(
        "the third dimension",
        "thickness width depth out_of_plane z third_dimension length_z",
        "the model is a slice of 1 m: forces, masses and energies are per metre of thickness",
    ),
    Hint(
        "shapes of grains",
        "shape shapes sphericity angularity roundness clump clumps polygons blocks block",
        "all grains are disks: `rolling_friction` of their material stands for their shape, and bonded disks for blocks",
    ),
    Hint(
        "rheology of the flow",
        "rheology voellmy xi turbulence turbulent_friction basal_friction mu_i inertial_number entrainment erosion",
        "the mass moves by the law of its contacts and has no rheology: give the ground's `friction` in its material; a layer with role: bed is what may be eroded",
    ),
    Hint(
        "time, heat, weathering",
        "temperature thermal freeze thaw freeze_thaw ice permafrost weathering creep ageing aging healing fatigue",
        "nothing changes by time alone: a wall or an interface weakens with slip (`slip_weakening`), and the water table moves (`water.table`)",
    ),
    Hint("units", "unit units unit_system", "units are always m, s, kg, N and Pa, and degrees for a dip"),
    Hint(
        "time steps and duration",
        "dt timestep time_stepping duration end_time total_time t_end tmax max_time",
        "the step is `numerics.time_step`, and the latest end of a run `stages.end.time`, counted from where the slope has settled, both in s",
        outside="stages.settle",
    ),
    Hint(
        "duration of settling",
        "duration end_time total_time t_end tmax max_time time_maximum",
        "settling ends when the mean speed is below `speed_rest` [m/s], and after `time_max` [s] at the latest",
        inside="stages.settle",
    ),
    Hint(
        "how a command runs",
        "threads cores cpus out output outputs output_folder folder resume figures plots vtk video checkpoint",
        "this is an option of the command and not of the slope: see scripts/slope.py --help",
    ),
)


def instead_of(key: str, keys) -> str | None:
    """What to do instead of the unknown ``key`` below the key path ``keys`` of a section, a sentence without its full
    stop; None where nothing is known of it.
    """
    word = "_".join(key.lower().replace("-", "_").split())
    places = [".".join(map(str, keys[:n])) for n in (1, 2)]
    for hint in HINTS:
        if (
            word in hint.keys.split()
            and (not hint.inside or hint.inside in places)
            and (not hint.outside or hint.outside not in places)
        ):
            return hint.instead
    return None
