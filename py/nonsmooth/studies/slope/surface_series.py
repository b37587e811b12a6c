"""What slip laws have found in the cells along the walls of a slope: a row for each cell and time in
``slip_surface.csv``, and at the end the same as arrays, in ``slip_surface.h5``.
"""

from __future__ import annotations

import numpy as np

from yade import O

from ... import records
from ...slip import cell_places, surface
from .columns import OF_SURFACES, SURFACE_COLUMNS

__all__ = ["SurfaceSeries", "means"]

WEAKENED = 0.5  # of the friction before slip


class SurfaceSeries:
    """Of a built :class:`~nonsmooth.studies.slope.slope.Slope`, its walls with slip laws; ``path``: the file; ``mark``:
    of a checkpoint.
    """

    def __init__(self, built, path, mark=None):
        materials = built.section.materials
        self._walls = {
            wall.name: (built.wall_material(wall.name), materials[wall.material].slip_law.make(), wall.points)
            for wall in built.section.with_slip_law
        }
        self._sliding = [(wall.name, materials[wall.material].friction) for wall in built.section.heated_surfaces]
        self.file = records.SeriesWriter(path, SURFACE_COLUMNS, resume_from=mark, overwrite=True)

    def take(self):
        """Writes the rows of the present step; returns the columns :data:`.columns.OF_SURFACES` of the slip surfaces,
        {name: value}, none where no slip surface has a slip law."""
        cells = {name: surface.cells(material) for name, (material, *_) in self._walls.items()}
        self.file.write(
            *(row for name, (_, law, points) in self._walls.items() for row in _rows(name, cells[name], law, points))
        )
        return means([(cells[name], friction) for name, friction in self._sliding]) if self._sliding else {}

    def write_arrays(self, path):
        """Writes all rows so far as :func:`.records.write_surface_arrays` does. Raises WriteError."""
        records.write_surface_arrays(records.read_surface_arrays(self.file.path), path, SURFACE_COLUMNS)


def means(cells):
    """Columns :data:`.columns.OF_SURFACES` of walls, each as (its cells, friction before slip): {name: value}. Cells count
    by the load that they bear, so that the mean friction is the strength of all by what it would be before slip; by
    their length where none bears any. What has no cells yet has not slipped.
    """
    length, stress, slip, left = (
        np.concatenate(parts)
        for parts in zip(
            *((c["length_m"], c["normal_stress_Pa"], c["slip_m"], c["friction"] / friction) for c, friction in cells)
        )
    )
    if not len(length):
        return dict(zip(OF_SURFACES, (0.0, 1.0, 0.0), strict=True))
    load = length * stress if stress.any() else length
    found = (slip, left, left < WEAKENED)
    return {name: float(np.average(one, weights=load)) for name, one in zip(OF_SURFACES, found, strict=True)}


def _rows(name, found, law, points):
    """A row for each cell of a wall along ``points``."""
    middle = cell_places.middles(points, found["ends_m"])
    columns = {
        "cell": np.arange(len(middle)),
        "x_m": middle[:, 0],
        "y_m": middle[:, 1],
        **{key: found[key] for key in ("length_m", "slip_m", "slip_rate_m_per_s", "normal_stress_Pa", "friction")},
        **_heated(found, law),
    }
    lists = [len(middle) * [None] if values is None else values.tolist() for values in columns.values()]
    now = {"step": O.iter, "time_s": O.time, "wall": name}
    return [now | dict(zip(columns, values)) for values in zip(*lists)]


def _heated(found, law):
    """Columns of a zone that heats; None for what the law has not."""

    def mean(key):
        return law.zone_mean(np.atleast_2d(found[key].reshape(len(found["slip_m"]), -1))) if key in found else None

    hottest = found["temperature"].reshape(len(found["slip_m"]), -1).max(axis=1) if "temperature" in found else None
    return {
        "temperature_degC": mean("temperature"),
        "hottest_degC": hottest,
        "pressure_Pa": mean("pressure"),
        "vapour": found.get("vapour"),
        "reacted": mean("reacted"),
        "melt_m": found.get("melt_thickness"),
    }
