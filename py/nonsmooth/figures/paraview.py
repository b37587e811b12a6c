"""Snapshots as files for ParaView: disks, contacts, walls and the cells of slip laws on them, and the lists of a run's
frames. Written by meshio.

In ParaView open ``avalanche.pvd``, choose the representation *Point Gaussian* (or the filter *Glyph*, sphere) with the
scale array ``radius``, and colour by ``layer``, ``speed``, ``wet``, ``released`` or ``weakened``. Of walls with slip laws
open ``slip_surface.pvd`` beside it, in the same times, and colour its lines (filter *Tube*) by ``friction``, ``slip_m``,
``hottest_degC`` or another column of ``slip_surface.csv``.
"""

from __future__ import annotations

import os
from pathlib import Path
from xml.sax.saxutils import quoteattr

import meshio
import numpy as np

from ..records import RecordsError, given, read_breaks, read_snapshot, read_surface_arrays
from ..records.snapshots import given_with
from ..records.surfaces import PLACES, TIMES
from ..slip import cell_places
from ..system import checks
from ..system.whole_files import beside, write_atomically
from ..world.scene_arrays import read as read_scene
from ..world.tables import BREAK_MODES

__all__ = [
    "write_breaks",
    "write_collection",
    "write_contacts",
    "write_disks",
    "write_run",
    "write_scene_walls",
    "write_slip_surface",
    "write_walls",
]


def _write(path, points, cells, point_data=None, cell_data=None):
    """A .vtu file in the plane z = 0, written beside and renamed; empty sets are written as one without cells."""
    path = Path(path)
    flat = np.column_stack([points, np.zeros(len(points))])
    mesh = meshio.Mesh(
        flat, cells, point_data=point_data or {}, cell_data={k: [v] for k, v in (cell_data or {}).items()}
    )
    try:
        with beside(path) as part:
            mesh.write(part, file_format="vtu", binary=True)
    except OSError as error:
        raise RecordsError(f"{path}: cannot be written ({error.strerror}); is the disk full?") from error
    return path


@given.takes(snapshot=given_with())
def write_disks(snapshot, path):
    """One point a disk, with ``radius`` [m] and, where the snapshot has them, ``layer`` (0 lowest), ``velocity`` [m/s],
    ``speed`` [m/s], ``angle`` [rad], ``wet``, ``released``, ``ever_wet``, ``weakened`` (on any wall or interface) and
    ``number``; see :class:`.records.Snapshot`."""
    s = snapshot
    data = {"radius": s.r}
    if s.layer is not None:
        data["layer"] = s.layer.astype(np.int32)
    if s.vx is not None:
        data["velocity"] = np.column_stack([s.vx, s.vy, np.zeros(len(s.x))])
        data["speed"] = np.hypot(s.vx, s.vy)
    if s.angle is not None:
        data["angle"] = s.angle
    if s.number is not None:
        data["number"] = s.number
    for name in ("wet", "released", "ever_wet"):
        if getattr(s, name) is not None:
            data[name] = getattr(s, name).astype(np.int8)
    if s.weakened is not None:
        data["weakened"] = s.weakened.any(axis=1).astype(np.int8)
    return _write(path, np.column_stack([s.x, s.y]), [("vertex", np.arange(len(s.x))[:, None])], point_data=data)


@given.takes(snapshot=given_with("ci"))
def write_contacts(snapshot, path):
    """One line a contact, from centre to centre or from centre to wall, with ``normal`` and ``tangential`` force [N/m],
    compression positive, and ``bonded``."""
    s = snapshot
    a = np.column_stack([s.x[s.ci], s.y[s.ci]])
    other = np.where(s.cj >= 0, s.cj, 0)
    wall = (s.cj < 0)[:, None]
    b = np.where(wall, np.column_stack([s.cx, s.cy]), np.column_stack([s.x[other], s.y[other]]))
    points = np.stack([a, b], axis=1).reshape(-1, 2)
    data = {"normal": s.cn, "tangential": s.ct, "bonded": s.cbonded.astype(np.int8)}
    return _write(path, points, [("line", np.arange(len(points)).reshape(-1, 2))], cell_data=data)


@given.takes(breaks=given.BREAKS)
def write_breaks(breaks, path):
    """One point a broken bond, with ``time`` [s] and ``mode`` (1 tension, 2 shear, 3 torque, 4 mixed); ``breaks`` as
    records.read_breaks gives it.
    """
    mode = np.array([BREAK_MODES.index(word) for word in breaks["mode"]], np.int32)
    points = np.column_stack([breaks["x_m"], breaks["y_m"]])
    return _write(
        path, points, [("vertex", np.arange(len(points))[:, None])], point_data={"time": breaks["time_s"], "mode": mode}
    )


@given.takes(section=checks.has("walls layers", "give a Section, as section.load('circle') returns one"))
def write_walls(section, path):
    """The section's walls as lines, with their number ``wall`` in the order of the section file."""
    points, lines, number = [], [], []
    for k, wall in enumerate(section.walls):
        first = len(points)
        points += [tuple(p) for p in wall.points]
        lines += [(first + n, first + n + 1) for n in range(len(wall.points) - 1)]
        number += [k] * (len(wall.points) - 1)
    return _write(
        path, np.array(points, float), [("line", np.array(lines))], cell_data={"wall": np.array(number, np.int32)}
    )


@given.takes(
    surfaces=given.surfaces("time_s x_m y_m"),
    section=checks.has("walls layers", "give a Section, as section.load('circle') returns one"),
    time=checks.real("give seconds, a finite number"),
)
def write_slip_surface(surfaces, section, time, path):
    """The cells of slip laws along the walls as lines, at the row nearest to a ``time`` [s]: with the columns of
    ``slip_surface.csv`` by their names, NaN where a wall's law has no such number, and ``wall``, as :func:`write_walls`
    has it, and ``cell``. A cell on a bent wall has several lines.

    ``surfaces``: as run.slip_surface_arrays, of a run of the ``section``. Raises RecordsError for a wall that the
    section has not."""
    walls = {wall.name: (k, wall.points) for k, wall in enumerate(section.walls)}
    names = list(dict.fromkeys(name for one in surfaces.values() for name in one if name not in (*PLACES, *TIMES)))
    points, data = [np.zeros((0, 2))], {name: [] for name in (*names, "wall", "cell")}
    for name, one in surfaces.items():
        if name not in walls:
            raise RecordsError(f"surfaces: the section has no wall {name!r}; give those of a run of this section")
        (number, line), row = walls[name], int(np.argmin(np.abs(one["time_s"] - time)))
        count = len(one["x_m"])
        cells = cell_places.parts(line, count, (one["x_m"][0], one["y_m"][0]))
        points += [np.stack([cell[:-1], cell[1:]], axis=1).reshape(-1, 2) for cell in cells]
        lines = [len(cell) - 1 for cell in cells]
        values = {key: one[key][row] if key in one else np.full(count, np.nan) for key in names}
        values |= {"wall": np.full(count, number, np.int32), "cell": np.arange(count, dtype=np.int32)}
        for key, of_cells in values.items():
            data[key].append(np.repeat(of_cells, lines))
    points = np.concatenate(points)
    kept = {key: np.concatenate(values) for key, values in data.items() if values}
    return _write(path, points, [("line", np.arange(len(points)).reshape(-1, 2))], cell_data=kept)


@given.takes(O=checks.has("bodies interactions", "give YADE's O"))
def write_scene_walls(O, path):
    """The walls of a scene as they stand, for users of VTKRecorder, which knows no Segment and no Arc: one line for
    each edge, see :mod:`.scene_arrays`; a Wall, which has no ends, across all that is there and a tenth beyond. Raises
    RecordsError for a scene without disks."""
    scene = read_scene(O)
    places = np.concatenate(
        [
            *scene.walls,
            np.column_stack([scene.x - scene.r, scene.y - scene.r]),
            np.column_stack([scene.x + scene.r, scene.y + scene.r]),
        ]
    )
    low, high = places.min(axis=0), places.max(axis=0)
    low, high = low - 0.1 * (high - low), high + 0.1 * (high - low)
    across = [
        np.array([(at, low[1]), (at, high[1])] if axis == 0 else [(low[0], at), (high[0], at)])
        for axis, at in scene.axes
    ]
    points = np.concatenate([*scene.walls, *across]) if scene.walls or across else np.zeros((0, 2))
    return _write(path, points, [("line", np.arange(len(points)).reshape(-1, 2))])


@given.takes(entries=given.ENTRIES)
def write_collection(entries, path):
    """The .pvd file that shows files in the course of time; ``entries``: (time [s], path) pairs in one folder or below
    ``path``'s. Raises RecordsError for a time that is no finite number, and for a file that is not there."""
    path = Path(path)
    for k, (time, file) in enumerate(entries):
        checks.number(f"entries[{k}]: time", time, RecordsError, "give seconds, a finite number")
        checks.path(f"entries[{k}]: file", file, RecordsError, "give the path of a file of write_disks")
        if not Path(file).is_file():
            raise RecordsError(
                f"entries[{k}]: file {str(file)!r}: there is no such file; write it first, with write_disks or another of these functions"
            )
    lines = [
        f'    <DataSet timestep="{float(time)!r}" file={quoteattr(os.path.relpath(file, path.parent))}/>'
        for time, file in entries
    ]
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n{}\n  </Collection>\n</VTKFile>\n'
    write_atomically(path, text.format("\n".join(lines)).encode())
    return path


def write_run(folder, section, frames, progress=None):
    """All of a run for ParaView into ``folder``/vtk: ``frames``, a list of (time [s], snapshot file), as
    ``avalanche.pvd``; where walls have slip laws, their cells at the same times as ``slip_surface.pvd``; walls; broken
    bonds; and the contacts of t0 and the end where those were recorded. Returns the path of ``avalanche.pvd``."""
    folder = Path(folder)
    out = folder / "vtk"
    cells = folder / "slip_surface.csv"
    surfaces = read_surface_arrays(cells) if cells.exists() else {}
    entries, of_cells = [], []
    for k, (time, file) in enumerate(frames):
        entries.append((float(time), write_disks(read_snapshot(file), out / f"disks-{Path(file).stem}.vtu")))
        if surfaces:
            path = out / f"slip_surface-{Path(file).stem}.vtu"
            of_cells.append((float(time), write_slip_surface(surfaces, section, float(time), path)))
        if progress:
            progress((k + 1) / len(frames))
    write_walls(section, out / "walls.vtu")
    for name in ("t0", "end"):
        if (folder / f"{name}.npz").exists():
            write_contacts(read_snapshot(folder / f"{name}.npz"), out / f"contacts-{name}.vtu")
    if (folder / "breaks.csv").exists():
        write_breaks(read_breaks(folder / "breaks.csv"), out / "breaks.vtu")
    if surfaces:
        write_collection(of_cells, out / "slip_surface.pvd")
    return write_collection(entries, out / "avalanche.pvd")
