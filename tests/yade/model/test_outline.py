"""The union of polygons as one outline: vertices that were given stay, new ones are where edges cross. Needs no YADE."""
import sys
from pathlib import Path

import numpy as np
import pytest
from shapely.geometry import Polygon

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.model import geometry  # noqa: E402

TOLERANCE = 1e-3  # m


def corners(*polygons):
    """Vertices of the outline of one ring."""
    (ring,) = geometry.outline([Polygon(p) for p in polygons], TOLERANCE).geoms
    return list(ring.exterior.coords)[:-1]


def test_edges_that_cross_have_a_vertex_there():
    """Two squares of 2 m, the second one 1 m to the right and 0.7 m up."""
    found = corners([(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 0.7), (3, 0.7), (3, 2.7), (1, 2.7)])
    known = [(0, 0), (2, 0), (2, 0.7), (3, 0.7), (3, 2.7), (1, 2.7), (1, 2), (0, 2)]
    assert len(found) == 8 and np.array(sorted(found)) == pytest.approx(np.array(sorted(known)), abs=TOLERANCE / 64)
    given = {(0, 0), (2, 0), (3, 0.7), (3, 2.7), (1, 2.7), (0, 2)}
    assert given <= set(found)  # to the last bit
    assert found[0] == (0, 0)  # it begins at its leftmost, lowest vertex
