"""What a section has where it says nothing: the values of the paper's slope, in proportion to the section's size. Needs
no YADE.

With L the root of the layers' area by that of the paper's slope, lengths go as L, times as √(L g₀/g) and speeds as √(L
g/g₀) (Froude), with g₀ = 9.81 m/s². The time step is that in which a disk of the smallest diameter falls as far, in its
diameters, as the paper's smallest does in 0.01 s.
"""

from __future__ import annotations

import math

from .. import geometry
from ..scales import AREA, GRAVITY

__all__ = ["filled", "release_distance"]

WATER_DENSITY = 1000.0  # kg/m³
RELEASE = {"dilation": 0.03, "over": 3.0}  # by dilatancy


def filled(data: dict) -> dict:
    """The plain data of a section that meets the schema, with all that was left out."""
    gravity = data.get("gravity", GRAVITY)
    area = math.fsum(geometry.area(layer["vertices"]) for layer in data["layers"])
    length, pull = math.sqrt(area / AREA), gravity / GRAVITY
    time, speed = math.sqrt(length / pull), math.sqrt(length * pull)
    own = [layer["disks"]["diameter"][0] for layer in data["layers"] if "diameter" in layer.get("disks", {})]
    smallest = min([data["disks"]["diameter"][0], *own])
    stages = data.get("stages", {})
    made = {"gravity": gravity, "seed": 1, **data}
    made["disks"] = {"distribution": "uniform_by_volume", "packing_fraction": 0.84, **data["disks"]}
    made["stages"] = {
        "dry": 3.0 * time,
        **stages,
        "settle": {"ramp": 4.0 * time, "time_max": 30.0 * time, "speed_rest": 5e-3 * speed, **stages.get("settle", {})},
        "end": {"time": 150.0 * time, "rest_fraction": 0.02, "rest_hold": 5.0 * time, **stages.get("end", {})},
    }
    made["numerics"] = {
        "time_step": 1e-2 * math.sqrt(smallest / pull),
        "path": 0.1,
        "tolerance": 1e-6,
        "tolerance_moving": 2e-4,
        "max_iterations": 300,
        "verlet_distance": 0.6,
        **data.get("numerics", {}),
    }
    if "numerics" in data and "path" not in data["numerics"]:
        del made["numerics"]["path"]  # said otherwise: all steps are as long
    if "water" in data:
        made["water"] = {
            "unit_weight": WATER_DENSITY * gravity,
            "volume": "disk",
            "release_distance": "critical_slip",
            **({"pressure_gradient": "parallel_seepage"} if "table" in data["water"] else {}),
            **data["water"],
        }
        if data["water"].get("release", {}).get("by", "slip") != "slip":
            made["water"]["release"] = {**RELEASE, **data["water"]["release"]}
    return made


def release_distance(area: float) -> float:
    """Way downslope [m] that releases a disk from water where no slip surface weakens; ``area`` [m²]: of the layers."""
    return 5.0 * math.sqrt(area / AREA)
