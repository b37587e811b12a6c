"""Packings as data: in memory, as text, and as .npz files with a checksum."""

from __future__ import annotations

import contextlib
import hashlib
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..system.text_files import read_lines
from ..system.whole_files import write_arrays, write_atomically

__all__ = ["FORMAT", "Packing", "PackingError", "load", "read_text", "save", "write_text"]

LARGEST_FILE = 2_000_000_000  # bytes of a text file; ten million disks have less
FARTHEST = 1e7  # m, as in a section
FORMAT = 2  # of files; others are refused


class PackingError(UserError, ValueError):
    """A packing that cannot be made, read or written; the message says why and what helps."""


@dataclass(frozen=True, eq=False)
class Packing:
    """Disks: centres `x`, `y` and radii `r` [m], and `layer`, the layer's number from 0; arrays of length n."""

    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    layer: np.ndarray

    def __post_init__(self):
        for name, kind in (("x", np.float64), ("y", np.float64), ("r", np.float64), ("layer", np.int64)):
            array = np.ascontiguousarray(getattr(self, name), dtype=kind)
            object.__setattr__(self, name, array)
        if self.x.ndim != 1 or len({a.shape for a in (self.x, self.y, self.r, self.layer)}) != 1:
            raise PackingError("x, y, r and layer differ in length; give one value of each for each disk")
        for name in ("x", "y", "r"):
            bad = np.flatnonzero(~np.isfinite(getattr(self, name)))
            if len(bad):
                raise PackingError(f"disk {bad[0]}: {name} is {getattr(self, name)[bad[0]]}; give a finite number")
        bad = np.flatnonzero(self.r <= 0)
        if len(bad):
            raise PackingError(f"disk {bad[0]}: the radius is {self.r[bad[0]]:g} m; give one above 0")

    def __len__(self) -> int:
        return len(self.x)

    @property
    def checksum(self) -> str:
        """SHA-256 (hex) of the arrays' bits."""
        digest = hashlib.sha256()
        for array, kind in ((self.x, "<f8"), (self.y, "<f8"), (self.r, "<f8"), (self.layer, "<i8")):
            digest.update(np.ascontiguousarray(array, kind).tobytes())
        return digest.hexdigest()


def save(packing: Packing, path) -> None:
    """Write a packing as .npz with a checksum of its content. Raises WriteError."""
    write_arrays(
        path,
        x=packing.x,
        y=packing.y,
        r=packing.r,
        layer=packing.layer,
        format=np.int64(FORMAT),
        checksum=np.array(packing.checksum),
    )


def load(path) -> Packing:
    """Read what `save` wrote. Raises PackingError where the file is missing, truncated or changed."""
    path = Path(path)
    remedy = "delete the file, and the command makes it again"
    try:
        with np.load(path, allow_pickle=False) as data:
            version, checksum = int(data["format"]), str(data["checksum"])
            packing = Packing(data["x"], data["y"], data["r"], data["layer"])
    except FileNotFoundError:
        raise PackingError(f"{path}: there is no such packing; give the path of a saved one") from None
    except Exception as error:  # NumPy's and zipfile's readers let through whatever a damaged file makes them meet
        if isinstance(error, OSError) and error.errno:
            raise PackingError(f"{path}: cannot be read ({error.strerror}); make it readable, or delete it") from None
        raise PackingError(f"{path}: truncated or no packing ({' '.join(str(error).split())}); {remedy}") from None
    if version != FORMAT:
        raise PackingError(f"{path}: format {version}, this version reads {FORMAT}; {remedy}")
    if checksum != packing.checksum:
        raise PackingError(f"{path}: its content does not match its checksum; {remedy}")
    return packing


def write_text(packing: Packing, path) -> None:
    """Write lines of `x y r layer` that read back to the same bits. Raises PackingError."""
    lines = ["# x [m]  y [m]  r [m]  layer (from 0)", f"# disks: {len(packing)}"]
    lines += [
        f"{x!r} {y!r} {r!r} {k}"
        for x, y, r, k in zip(packing.x.tolist(), packing.y.tolist(), packing.r.tolist(), packing.layer.tolist())
    ]
    write_atomically(path, ("\n".join(lines) + "\n").encode())


def read_text(path) -> Packing:
    """Read lines of `x y r [layer]` [m], layers from 0 (0 where not given); # starts a comment.

    A comment `# disks: N`, as `write_text` makes, guards against lines that are missing or too many. Raises
    PackingError with file, line and remedy.
    """
    path = Path(path)
    lines = read_lines(path, LARGEST_FILE, PackingError, "a text file of x y r [layer]")
    rows, announced, columns = [], None, None
    for number, line in enumerate(lines, 1):
        text, _, comment = line.partition("#")
        if comment.strip().startswith("disks:"):
            with contextlib.suppress(ValueError):
                announced = int(comment.split(":")[1])
        fields = text.split()
        if not fields:
            continue
        where = f"{path}: line {number}"
        if len(fields) not in (3, 4):
            raise PackingError(f"{where}: {len(fields)} values ({text.strip()[:40]!r}); give x y r [layer]")
        if columns and len(fields) != columns:
            raise PackingError(
                f"{where}: {len(fields)} values after lines of {columns}; "
                "the file may be truncated there: give a layer in all lines or in none"
            )
        columns = len(fields)
        try:
            x, y, r = map(float, fields[:3])
            layer = int(fields[3]) if columns == 4 else 0
        except ValueError as error:
            raise PackingError(f"{where}: {str(error)[:80]}; give numbers, the layer a whole one") from None
        for name, value in (("x", x), ("y", y), ("r", r)):
            if not math.isfinite(value):
                raise PackingError(f"{where}: {name} is {value}; give a finite number")
            if abs(value) > FARTHEST:
                raise PackingError(f"{where}: {name} is {value:g}; give m, at most {FARTHEST:g}")
        if r < 1e-9:
            raise PackingError(f"{where}: the radius is {r:g} m; give one above 1e-9 m")
        if not 0 <= layer < 1000:
            raise PackingError(
                f"{where}: the layer is {layer if abs(layer) < 1e9 else fields[3][:40]}; give a number from 0"
            )
        rows.append((x, y, r, layer))
    if not rows:
        raise PackingError(f"{path}: holds no disk; give lines of x y r [layer]")
    if announced is not None and announced > len(rows):
        raise PackingError(
            f"{path}: holds {len(rows)} disks of the {announced} it announces; it is truncated: write it again"
        )
    if announced is not None and announced < len(rows):
        raise PackingError(
            f"{path}: holds {len(rows)} disks, {len(rows) - announced} more than the {announced} it announces; take out the lines that do not belong to it, or correct its comment '# disks: {announced}'"
        )
    x, y, r, layer = map(np.array, zip(*rows))
    return Packing(x, y, r, layer)
