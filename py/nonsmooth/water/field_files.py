"""Pore pressures in files: HDF5 of the project's own layout, on triangles or on a grid, and whatever meshio reads.

An HDF5 file has ``times`` (t,) [s] and ``pressure`` [Pa]. On triangles it has ``nodes`` (n, 2) [m] and ``triangles``
(m, 3), and pressures (t, n); on a grid ``x`` (a,) and ``y`` (b,) [m], both rising, and pressures (t, b, a). Of meshio
there may be one file, an XDMF series, or one file for each time. Every problem is a FieldError that names the file.
"""

from __future__ import annotations

import contextlib
import io
import os
from pathlib import Path

import numpy as np

from ..system import checks
from ..system.whole_files import WriteError, beside
from .error import WaterError
from .fields import FieldError, MeshField
from .mesh import Mesh, grid

__all__ = ["read", "read_series", "write"]

HDF5 = (".h5", ".hdf5")
NAME = "pressure"


def read(path, name=NAME, time=0.0) -> MeshField:
    """The field in a file: HDF5 by its suffix (.h5, .hdf5), else by meshio, an XDMF file with all its times.

    ``name``: of the pressures [Pa] in the file; ``time``: of the state [s] in a file that has none.
    """
    path = Path(checks.path("path", path, FieldError, "give the name of a file"))
    if not path.is_file():
        raise FieldError(f"{path}: there is no such file; give an HDF5 file, or one that meshio reads")
    if path.suffix.lower() in HDF5:
        return _named(path, _read_hdf5, path, name)
    if path.suffix.lower() in (".xdmf", ".xmf"):
        series = _named(path, _read_xdmf, path, name)
        if series:
            return series
    mesh, values = _named(path, _read_mesh, path, name)
    return _named(path, MeshField, mesh, [time], [values])


def read_series(entries, name=NAME) -> MeshField:
    """The field in several files that meshio reads, one for each time, all with the same mesh.

    ``entries``: list of (time [s], path), times rising; ``name``: of the pressures in them.
    """
    entries = list(entries) if isinstance(entries, (list, tuple)) else entries
    if (
        not isinstance(entries, list)
        or not entries
        or not all(isinstance(one, (list, tuple)) and len(one) == 2 for one in entries)
    ):
        raise FieldError(f"entries {checks.shown(entries)}: give a list of (time [s], path)")
    states = []
    for _, path in entries:
        path = Path(checks.path("path", path, FieldError, "give the name of a file"))
        if not path.is_file():
            raise FieldError(f"{path}: there is no such file; give one that meshio reads")
        states.append(_named(path, _read_mesh, path, name))
        first, mesh = states[0][0], states[-1][0]
        if not (np.array_equal(mesh.nodes, first.nodes) and np.array_equal(mesh.triangles, first.triangles)):
            raise FieldError(f"{path}: its mesh is not that of {entries[0][1]}; give files with the same mesh")
    return _named(entries[0][1], MeshField, states[0][0], [t for t, _ in entries], [values for _, values in states])


def write(field, path):
    """Writes a MeshField as HDF5, whole or not at all; returns the path. Raises WriteError, and FieldError for what is
    no MeshField or another suffix than .h5 and .hdf5.
    """
    import h5py

    if not isinstance(field, MeshField):
        raise FieldError(f"field {checks.shown(field)}: give a MeshField; a PhreaticLine becomes one by .on(mesh)")
    path = Path(checks.path("path", path, FieldError, "give the name of a file"))
    if path.suffix.lower() not in HDF5:
        raise FieldError(f"{path}: give a name that ends in {' or '.join(HDF5)}")
    arrays = {"nodes": field.mesh.nodes, "triangles": field.mesh.triangles, "layer": field.mesh.layer}
    try:
        with beside(path) as part:
            with h5py.File(part, "w") as file:
                for name, values in {**arrays, "times": field.times, NAME: field.pressures}.items():
                    file.create_dataset(name, data=values, track_times=False)  # the same bytes each time
    except OSError as error:
        raise WriteError(
            f"{path}: cannot be written ({error.strerror or error}); give a folder that can be written"
        ) from None
    return path


def _named(path, function, *arguments):
    """What a function returns; its WaterError with the file's name before it."""
    try:
        return function(*arguments)
    except WaterError as error:
        if str(error).startswith(os.fspath(path)):
            raise
        raise FieldError(f"{path}: {error}") from None


def _read_hdf5(path, name):
    data = _datasets(path, name)
    for key, values in data.items():
        kind = np.asarray(values).dtype
        if kind.kind not in "iuf":
            raise FieldError(f"{key} holds {kind}; give real numbers")
    on_grid = "x" in data
    if on_grid:
        mesh, shape = grid(data["x"], data["y"]), (len(data["y"]), len(data["x"]))
        values = np.asarray(data[name])
        if values.shape[1:] != shape:
            raise FieldError(f"{name} of shape {values.shape}: give (times, y, x), here (…, {shape[0]}, {shape[1]})")
        return MeshField(mesh, data["times"], values.reshape(len(values), shape[0] * shape[1]))
    mesh, kept = _meshed(data["nodes"], data["triangles"], data.get("layer"))
    values = np.asarray(data[name])
    if values.ndim != 2 or values.shape[1] != len(data["nodes"]):
        raise FieldError(f"{name} of shape {values.shape}: give (times, nodes), here (…, {len(data['nodes'])})")
    return MeshField(mesh, data["times"], values[:, kept])


def _datasets(path, name):
    """The arrays that a file must have, and its layers where it tells them: {name: array}."""
    import h5py

    try:
        file = h5py.File(path, "r")
    except (OSError, RuntimeError) as error:
        raise FieldError(
            f"{path}: is no HDF5 file that can be read ({' '.join(str(error).split())}); give one, or a file with another "
            "suffix that meshio reads"
        ) from None
    try:
        with file:
            held = {key: item for key, item in file.items() if isinstance(item, h5py.Dataset)}
            needed = ("times", name, *(("x", "y") if "x" in held or "y" in held else ("nodes", "triangles")))
            missing = [key for key in needed if key not in held]
            if missing:
                raise FieldError(
                    f"has no dataset {', '.join(missing)}; it has {', '.join(held) or 'none'}: give a file with "
                    "these, or the name of its pressures"
                )
            return {key: held[key][()] for key in (*needed, *(("layer",) if "layer" in held else ()))}
    except (OSError, RuntimeError, KeyError, ValueError, TypeError) as error:  # whatever h5py meets in damaged bytes
        if isinstance(error, WaterError):
            raise
        raise FieldError(f"a dataset cannot be read ({' '.join(str(error).split())}); give a whole file") from None


def _read_mesh(path, name):
    """The triangles of a file, and its pressures at their nodes."""
    import meshio

    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):  # one message, ours
            found = meshio.read(path)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # meshio ends the process for some files
        said = " ".join(str(error).split())
        raise FieldError(
            f"{path}: meshio cannot read it ({said if len(said) > 1 else type(error).__name__}); give a file of triangles, "
            "as .vtu, .vtk, .msh or .xdmf"
        ) from None
    return _of_meshio(found.points, found.cells, found.point_data, name)


def _read_xdmf(path, name):
    """The field of an XDMF series, None for a file of one state."""
    import meshio

    try:
        reader = meshio.xdmf.TimeSeriesReader(path)
    except Exception:  # no series, or none that meshio reads: the reader of one state says which
        return None
    try:
        with reader:
            points, cells = reader.read_points_cells()
            states = [reader.read_data(k)[:2] for k in range(reader.num_steps)]
    except Exception as error:
        raise FieldError(
            f"{path}: meshio cannot read the series ({' '.join(str(error).split())}); give a whole one, or a file for "
            "each state"
        ) from None
    if not states:
        return None
    read = [_of_meshio(points, cells, data, name) for _, data in states]
    return MeshField(read[0][0], [float(t) for t, _ in states], [values for _, values in read])


def _of_meshio(points, cells, data, name):
    if name not in data:
        raise FieldError(
            f"has no values {name!r} at its points; it has {', '.join(map(repr, data)) or 'none'}: give the name of the "
            "pressures"
        )
    triangles = [block.data for block in cells if block.type == "triangle"]
    # a rectangle as two triangles
    triangles += [
        block.data[:, corners] for block in cells if block.type == "quad" for corners in ((0, 1, 2), (0, 2, 3))
    ]
    if not triangles:
        held = ", ".join(sorted({block.type for block in cells})) or "none"
        raise FieldError(f"has no triangles or quadrilaterals (cells: {held}); give a mesh in the x-y plane")
    points = np.asarray(points, float)
    if points.shape[1] == 3 and np.ptp(points[:, 2]) > 1e-9 * np.ptp(points[:, :2], axis=0).max():
        raise FieldError("its points have different z; give a mesh in the x-y plane")
    values = np.asarray(data[name], float)
    if values.size != len(points):
        raise FieldError(f"{name} of shape {values.shape}: give one number for each of {len(points)} points")
    mesh, kept = _meshed(points[:, :2], np.concatenate(triangles).astype(int))
    return mesh, values.ravel()[kept]


def _meshed(nodes, triangles, layer=None):
    """The mesh, and which of the nodes it has kept."""
    mesh = Mesh.of(nodes, triangles, layer)
    return mesh, np.unique(triangles)
