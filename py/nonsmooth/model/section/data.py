"""A section as the data of a section file, with nothing left out: what a run keeps of what it was asked for. Needs no
YADE.
"""

from __future__ import annotations

import dataclasses

import yaml

from ...system.whole_files import write_atomically
from . import erosion, shaking as section_shaking, water as section_water, water_release

__all__ = ["FILE", "material", "plain", "write"]

FILE = "section.yaml"  # in the folder of a run


def plain(section) -> dict:
    """The keys and values of a section file that gives this Section; `section.of` takes them too. A similar section
    (`like`) loses where it came from.
    """

    def disks(d):
        return {"diameter": [d.d_min, d.d_max], "distribution": d.distribution, "packing_fraction": d.packing_fraction}

    def points(item):
        return [list(map(float, p)) for p in item.vertices]

    water, stages = section.water, section.stages
    data = {
        "name": section.name,
        "description": section.description,
        "gravity": section.gravity,
        "seed": section.seed,
        "walls": [
            {
                "name": w.name,
                "material": w.material,
                "role": w.role,
                **({"apart": True} if w.apart else {}),
                "vertices": points(w),
            }
            for w in section.walls
        ],
        "layers": [
            {
                "name": layer.name,
                "material": layer.material,
                "role": layer.role,
                **({"disks": disks(layer.disks)} if layer.disks else {}),
                "vertices": points(layer),
            }
            for layer in section.layers
        ],
        "interfaces": [
            {
                "name": i.name,
                "between": list(i.between),
                "material": i.material,
                "flat": i.flat,
                **({"role": i.role} if i.role else {}),
            }
            for i in section.interfaces
        ],
        "materials": {name: material(m) for name, m in section.materials.items()},
        "disks": disks(section.disks) | ({"pressed": True} if section.pressed else {}),
        "stages": {
            "settle": dataclasses.asdict(stages.settle),
            "dry": stages.dry,
            **({} if section.water_field else {"water": {"hold": stages.water_hold}}),
            "end": dataclasses.asdict(stages.end),
        },
        "numerics": {k: v for k, v in dataclasses.asdict(section.numerics).items() if v is not None},
    }
    if section.erosion:
        data["erosion"] = [erosion.plain(window) for window in section.erosion]
    if section.unusual:
        data["unusual"] = list(section.unusual)
    if not section.interfaces:
        del data["interfaces"]
    if section.water_field is not None:
        data["water"] = section_water.plain(water)
    elif water is not None:
        # the rate goes on from the last point, and a file has one of the two
        table = {"rate": water.rate} if water.table == ((0.0, 0.0),) else {"points": [list(p) for p in water.table]}
        data["water"] = {
            "unit_weight": water.unit_weight,
            "plane": water.wall or {"point": list(map(float, water.point)), "dip": float(water.dip)},
            "pressure_gradient": (
                water.pressure_gradient
                if isinstance(water.pressure_gradient, str)
                else [float(g) for g in water.pressure_gradient]
            ),
            "volume": water.volume,
            "table": table,
            "release_distance": water.release_distance,
        }
        data["water"] |= water_release.plain(water.release)
    if section.shaking is not None:
        data["shaking"] = section_shaking.plain(section.shaking)
    return data


def material(m) -> dict:
    """The keys and values of a Material in a section file."""
    found = {k: v for k, v in dataclasses.asdict(m).items() if k != "name" and v is not None}
    if m.slip_law is not None:
        found["slip_law"] = surface_law(m.slip_law)
    return found | {"bond_ellipse": list(m.bond_ellipse)}


def surface_law(law) -> dict:
    """The keys and values of a SurfaceLaw in a section file."""
    found = {"set": law.set} if law.set is not None else {"law": list(law.law)}
    values = {key: list(value) if isinstance(value, tuple) else value for key, value in law.parameters}
    found |= {"parameters": values} if values else {}
    return found | ({"cell_length": law.cell_length} if law.cell_length else {})


def write(section, path):
    """Writes the section file, whole or not at all, and before it the record of an earthquake that it names."""
    data = plain(section)
    if section.shaking is not None:
        data["shaking"] = section_shaking.kept(section.shaking, path.parent)
    write_atomically(
        path, yaml.safe_dump(data, sort_keys=False, allow_unicode=True, default_flow_style=None, width=150).encode()
    )
