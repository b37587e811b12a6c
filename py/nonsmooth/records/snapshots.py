"""Disks and contacts at one instant, ``.npz``."""

import zipfile
import zlib
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Optional

import numpy as np

from ..system import checks
from ..system.whole_files import write_arrays
from . import given
from .error import RecordsError

__all__ = ["Snapshot", "checked", "given_with", "in_both", "lacking", "read_snapshot", "read_with", "write_snapshot"]


@dataclass
class Snapshot:
    """Disks of any study at one instant. N disks, C contacts. What a study has not is None.

    Scalars: ``time_s`` [s], ``step``, ``water_m`` [m] (height of the water table above its plane).
    Disks, shape (N,): ``x``, ``y``, ``r`` [m], ``angle`` [rad], ``vx``, ``vy`` [m/s], ``layer`` (int, 0 lowest), and
    bool: ``wet`` (water acts on it now),
    ``released`` (was wet, and water acts on it no longer, by its way downslope or by dilatancy), ``ever_wet``. And
    ``weakened``, bool of shape (N, W): the slip along each of the W walls and interfaces that weaken has passed the
    critical slip D_c, in the order of :attr:`.section.Section.weakening`. Where local dilatancy releases the water,
    ``released_share``, from 0 to 1: the share of the pressure that acts no longer. Files of earlier versions tell neither
    ``ever_wet`` nor
    ``weakened``, and their ``released`` has disks that never were wet too.
    Contacts, shape (C,): ``ci``, ``cj`` disk indices (``cj = -1 - k`` for wall number k), ``cn``, ``ct`` normal and
    tangential force [N/m], compression positive, ``cbonded`` (bool), ``cx``, ``cy`` contact point [m]. They may all
    be left out (C = 0), as for the frames of a video.
    ``number``, int (N,), rising: which disk each is, of those that a run has begun with, where some have been taken out
    since; None where all are there. See :func:`in_both`.
    ``walls``, shape (W, 2): of walls along an axis that move, in the order of their numbers: 0 where x, 1 where y is
    constant, and its value [m].
    """

    time_s: float
    step: int
    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    angle: Optional[np.ndarray] = None
    vx: Optional[np.ndarray] = None
    vy: Optional[np.ndarray] = None
    layer: Optional[np.ndarray] = None
    wet: Optional[np.ndarray] = None
    released: Optional[np.ndarray] = None
    ci: Optional[np.ndarray] = None
    cj: Optional[np.ndarray] = None
    cn: Optional[np.ndarray] = None
    ct: Optional[np.ndarray] = None
    cbonded: Optional[np.ndarray] = None
    cx: Optional[np.ndarray] = None
    cy: Optional[np.ndarray] = None
    water_m: Optional[float] = None
    ever_wet: Optional[np.ndarray] = None
    released_share: Optional[np.ndarray] = None
    weakened: Optional[np.ndarray] = None
    walls: Optional[np.ndarray] = None
    number: Optional[np.ndarray] = None

    def chosen(self, rows):
        """The Snapshot of some of its disks, ``rows``: bool (N,), or their numbers in these arrays; without
        contacts.
        """
        kept = {name: value[rows] for name in _DISKS if (value := getattr(self, name)) is not None}
        return replace(
            self, **kept, **{name: value[:0] for name in _CONTACTS if (value := getattr(self, name)) is not None}
        )


_SCALARS = ("time_s", "step", "water_m")
_CONTACTS = ("ci", "cj", "cn", "ct", "cbonded", "cx", "cy")
_NEEDED = ("time_s", "step", "x", "y", "r")
_NAMES = tuple(f.name for f in fields(Snapshot))
_DISKS = tuple(name for name in _NAMES if name not in (*_SCALARS, *_CONTACTS, "walls"))
_SINGLE = ("x", "y", "r", "angle", "vx", "vy")  # in single precision where a file is compact
_KINDS = dict.fromkeys(("layer", "ci", "cj", "number"), np.int64) | dict.fromkeys(
    ("wet", "released", "ever_wet", "weakened", "cbonded"), bool
)


def checked(arrays, source):
    """Check ``arrays`` and make a Snapshot of them; ``source`` names the file in messages."""

    def wrong(what, remedy):
        return RecordsError(f"{source}: {what}; {remedy}")

    arrays = {name: value for name, value in arrays.items() if value is not None}
    if not any(name in arrays for name in _CONTACTS):
        arrays.update({name: np.zeros(0) for name in _CONTACTS})
    names = {name for name in _NAMES if name in arrays or name in _NEEDED + _CONTACTS}
    missing, unknown = sorted(names - set(arrays)), sorted(set(arrays) - names)
    if missing or unknown:
        raise wrong(
            f"snapshot lacks {missing or 'nothing'} and has unknown {unknown or 'nothing'}",
            "give the arrays of nonsmooth.records.Snapshot",
        )
    found = {}
    for name in names:
        value = np.asarray(arrays[name])
        if value.dtype.kind not in "biuf":
            raise wrong(f"{name} holds {value.dtype} instead of numbers", "give an array of numbers")
        if not np.isfinite(value).all():
            at = int(np.flatnonzero(~np.isfinite(value))[0]) if value.ndim else 0
            raise wrong(f"{name}[{at}] is not a finite number", "go back to an earlier snapshot or checkpoint")
        kind = np.int64 if name == "step" else _KINDS.get(name, np.float64)
        changed = np.flatnonzero(value != value.astype(kind)) if kind is not np.float64 else ()
        if len(changed):  # a conversion would round it in silence
            at = f"[{changed[0]}]" if value.ndim else ""
            no, remedy = (
                ("no whole number", "give whole numbers")
                if kind is np.int64
                else ("neither True nor False", "give these")
            )
            raise wrong(f"{name}{at} is {value.flat[changed[0]]:g}, {no}", remedy)
        if name in _SCALARS:
            if value.ndim:
                raise wrong(f"{name} has shape {value.shape} instead of being one number", "give one number")
            found[name] = int(value) if name == "step" else float(value)
        else:
            found[name] = value.astype(kind, copy=False)
    for group, key in ((_DISKS, "x"), (_CONTACTS, "ci")):
        for name in group:
            if name not in found:
                continue
            rows = found[name].shape[:-1] if name == "weakened" else found[name].shape
            if rows != (len(np.atleast_1d(found[key])),):
                raise wrong(
                    f"{name} has shape {found[name].shape} and {key} {found[key].shape}",
                    "these arrays must be flat (weakened: with a column for each wall) and equally long",
                )
    if "walls" in found and (found["walls"].ndim != 2 or found["walls"].shape[1] != 2):
        raise wrong(f"walls has shape {found['walls'].shape}", "give an axis, 0 or 1, and a place [m] for each wall")
    count = len(found["x"])
    if (found["r"] <= 0).any():
        raise wrong(f"radius of disk {int(np.argmin(found['r']))} is {found['r'].min()}", "radii are positive")
    if ((found["ci"] < 0) | (found["ci"] >= count) | (found["cj"] >= count)).any():
        raise wrong(f"a contact names a disk beyond the {count} there are", "check how indices are made")
    if "number" in found and (count and found["number"][0] < 0 or (np.diff(found["number"]) <= 0).any()):
        raise wrong("number does not rise from 0 or more", "give the number of each disk that is left, in their order")
    alone = np.flatnonzero(found["ci"] == found["cj"])
    if len(alone):
        raise wrong(
            f"contact {alone[0]} is of disk {found['ci'][alone[0]]} with itself",
            "give another disk as cj, or -1 - k for wall number k",
        )
    return Snapshot(**found)


@given.takes()
def write_snapshot(path, compact=False, **arrays):
    """Write a snapshot (keywords: the attributes of :class:`Snapshot`) as ``.npz``; returns its path.

    ``compact``: places, sizes, angles and speeds in single precision, and compressed, as for the frames of a video.
    Equal arrays give equal bytes. Raises :class:`RecordsError` for missing or unknown arrays, unequal lengths, a NaN, a
    layer or step that is no whole number, a bad index or a contact of a disk with itself, and
    :class:`~yade.nonsmooth.system.whole_files.WriteError` for a file that cannot be written.
    """
    path = Path(path)
    snapshot = checked(arrays, path)
    told = {name: value for name, value in vars(snapshot).items() if value is not None}
    if compact:
        told |= {name: told[name].astype(np.float32) for name in _SINGLE if name in told}
    # else not compressed: a fifth of the room is not worth most of the time, as coordinates hardly shrink
    write_arrays(path, compressed=compact, **told)
    return path


def in_both(one, other):
    """Two Snapshots of a run as those of the disks that are in both, without contacts, so that their rows are the same
    disks; themselves where neither has lost any.
    """
    first, second = (getattr(s, "number", None) for s in (one, other))
    if first is None and second is None:
        return one, other
    first, second = (np.arange(len(s.x)) if n is None else n for s, n in ((one, first), (other, second)))
    _, rows, others = np.intersect1d(first, second, assume_unique=True, return_indices=True)
    return one.chosen(rows), other.chosen(others)


def lacking(snapshot, *names):
    """List of those fields ``names`` that a Snapshot, or what is given for one, has not; not every study has all."""
    return [name for name in names if getattr(snapshot, name, None) is None]


def given_with(*names):
    """The rule of :func:`..checks.takes` for a Snapshot that has these fields, besides ``x``, ``y`` and ``r``."""
    told = f" that has {', '.join(names)}" if names else ""
    remedy = f"give a Snapshot{told}, as run.snapshot('end') or records.read_snapshot(path) returns one"
    return lambda v: not lacking(v, "x", "y", "r", *names), remedy


def read_with(path, whose, *names):
    """The Snapshot of a file, which has these fields. Raises RecordsError as :func:`read_snapshot`, and where some are
    not there; ``whose``: who has them, in words, as "a slope".
    """
    found = read_snapshot(path)
    missing = lacking(found, *names)
    if missing:
        raise RecordsError(f"{path}: has no {', '.join(missing)}; give snapshots of {whose}")
    return found


def read_snapshot(path):
    """Read a :class:`Snapshot`. Raises :class:`RecordsError` if it is missing, truncated or inconsistent."""
    path = Path(checks.path("path", path, RecordsError, "give the path of a file of a run"))
    try:
        with np.load(path, allow_pickle=False) as data:
            arrays = {name: data[name] for name in data.files}
    except OSError as error:
        reason = error.strerror or str(error)
        raise RecordsError(f"{path}: cannot be read ({reason}); check the folder given") from error
    except (zipfile.BadZipFile, zlib.error, ValueError, EOFError, KeyError, AttributeError) as error:
        raise RecordsError(
            f"{path}: not a snapshot, or truncated ({error}); delete it and use another, or run again"
        ) from error
    return checked(arrays, path)
