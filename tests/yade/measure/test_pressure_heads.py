"""Mean pressure heads on slip surfaces. Needs no YADE."""

import numpy as np
import pytest
import synthetic_slope as package
from shapely.geometry import LineString

section, fields, mesh, pressure_heads = (
    package.load(name) for name in ("model.section", "water.fields", "water.mesh", "measure.pressure_heads")
)


@pytest.mark.parametrize("name, turned", [("jiufengershan", False), ("jiufengershan", True), ("reservoir", False)])
def test_the_mean_head_is_that_along_the_line_half_a_disk_above(name, turned):
    """Of a linear pressure it is that of the line's centre; the part within the layers alone counts."""
    made = section.load(name)
    if turned:
        made = package.load("model.section.similar").mirrored(made)
    ((_, line),) = made.slip_surfaces
    x0, y0, x1, y1 = made.bounds
    body = mesh.grid(np.linspace(x0 - 50, x1 + 50, 9), np.linspace(y0 - 50, y1 + 50, 9))
    x, y = body.nodes.T
    later = 8e6 + 2e3 * x - 1e3 * y
    field = fields.MeshField(body, [0.0, 10.0], [0.5 * later, later])
    shifted = LineString(line).parallel_offset(0.5 * made.smallest, "left", join_style=2)
    within = shifted.intersection(made.outline)
    cx, cy = within.centroid.x, within.centroid.y
    found = pressure_heads.SlipHeads(field, made)
    head = (8e6 + 2e3 * cx - 1e3 * cy) / made.water.unit_weight
    # samples are a four-hundredth of the line apart
    assert found.mean(10.0) == pytest.approx(head, rel=5e-3)
    assert found.mean(4.0) == pytest.approx(0.7 * head, rel=5e-3) and found.mean(99.0) == found.mean(10.0)


def test_dry_ground_has_no_head():
    made = section.load("jiufengershan")
    x0, y0, x1, y1 = made.bounds
    body = mesh.grid(np.linspace(x0, x1, 3), np.linspace(y0, y1, 3))
    field = fields.MeshField(body, [0.0], [np.full(len(body.nodes), -1e5)])
    assert pressure_heads.SlipHeads(field, made).mean(0.0) == 0
