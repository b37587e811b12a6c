"""State of the running YADE scene as NumPy arrays, read in one call instead of a Python loop."""

from __future__ import annotations

import numpy as np

from ..errors import UserError
from ..records.breaks import BREAK_MODES
from ..system import checks

__all__ = ["BREAK_MODES", "bodies", "breaks", "contacts", "loaded_contacts", "released_shares", "slip", "water"]

_BODY = ("id", "x", "y", "r", "angle", "vx", "vy", "omega")
_BREAK = ("step", "time", "id1", "id2", "mode", "x", "y")
_CONTACT = ("id1", "id2", "normal", "tangential", "torque", "nx", "ny", "gap", "bonded", "broken", "x", "y")


_ENGINE = checks.takes(
    UserError, engine=checks.has("bodyTable contactTable", "give the ContactDynamicsEngine, one of O.engines")
)
_WATER = checks.takes(
    UserError,
    engine=(
        lambda v: v is None or hasattr(v, "bodyTable") and not hasattr(v, "contactTable"),
        "give the PorePressureEngine, one of O.engines, or None",
    ),
)
_WEAKENING = checks.takes(UserError, material=checks.has("slipTable", "give a SlipWeakeningMat, one of O.materials"))


def _table(raw: bytes, names) -> dict[str, np.ndarray]:
    rows = np.frombuffer(raw, dtype=np.float64).reshape(-1, len(names))
    return {name: rows[:, k].copy() for k, name in enumerate(names)}


@_ENGINE
def bodies(engine) -> dict[str, np.ndarray]:
    """Spheres of the scene, arrays of shape (n,): ``id`` (int), ``x``, ``y``, ``r`` [m], ``angle`` [rad], ``vx``,
    ``vy`` [m/s], ``omega`` [rad/s]. ``engine``: the ContactDynamicsEngine."""
    table = _table(engine.bodyTable(), _BODY)
    table["id"] = table["id"].astype(int)
    return table


@_ENGINE
def contacts(engine) -> dict[str, np.ndarray]:
    """Real interactions of the scene, arrays of shape (n,), in the order of (lower id, higher id).

    ``id1``, ``id2`` (int); ``normal``, ``tangential`` [N/m], ``torque`` [N] per metre of thickness, compression
    positive; ``nx``, ``ny`` (from body 1 to body 2); ``gap`` [m]; ``bonded`` (bool); ``broken`` (int,
    NscdPhys.brokenMode); ``x``, ``y`` [m].
    """
    table = _table(engine.contactTable(), _CONTACT)
    for name in ("id1", "id2", "broken"):
        table[name] = table[name].astype(int)
    table["bonded"] = table["bonded"] > 0
    order = np.lexsort((np.maximum(table["id1"], table["id2"]), np.minimum(table["id1"], table["id2"])))
    return {name: values[order] for name, values in table.items()}


@_ENGINE
def loaded_contacts(engine, first_disk, wall_numbers) -> dict[str, np.ndarray]:
    """Contacts that carry a normal force or a bond, as `records.write_snapshot` takes them.

    ``first_disk``: id of disk 0; ``wall_numbers``: {id: number} of bodies that are walls. Arrays of shape (n,): ``ci``
    a disk, ``cj`` a disk or -1 - number of a wall (int), ``cn``, ``ct`` normal and tangential force [N/m], ``cbonded``
    (bool), ``cx``, ``cy`` [m]. Raises UserError where a body before disk 0 that touches a disk has no number.
    """
    checks.count("first_disk", first_disk, UserError, "give the id of disk 0, a whole number from 0", least=0)
    c = contacts(engine)
    # walls come first in the list of bodies, so a disk is always the second body of such a pair
    a, b = np.minimum(c["id1"], c["id2"]), np.maximum(c["id1"], c["id2"])
    lost = sorted(set(a[a < first_disk].tolist()) - set(wall_numbers))
    if lost:
        raise UserError(
            f"wall_numbers: lacks body {lost[0]}{f' and {len(lost) - 1} more' if len(lost) > 1 else ''}, which touches a disk; give the number of its wall for each body before disk {first_disk}"
        )
    if (b < first_disk).any():
        raise UserError(
            f"first_disk {first_disk}: bodies before it touch each other, so disks are among them; give the id of the first disk"
        )
    keep = (c["normal"] != 0) | c["bonded"]
    a, b, c = a[keep], b[keep], {name: values[keep] for name, values in c.items()}
    return {
        "ci": b - first_disk,
        "cj": np.array([-1 - wall_numbers[i] if i in wall_numbers else i - first_disk for i in a], int),
        "cn": c["normal"],
        "ct": c["tangential"],
        "cbonded": c["bonded"],
        "cx": c["x"],
        "cy": c["y"],
    }


def bonds(engine) -> dict[str, int]:
    """Columns of a series: the bonds that there are, and how many have broken in each way. ``engine``: the
    ContactDynamicsEngine, or what soft contacts have for it.
    """
    broken = {f"bonds_broken_{mode}": getattr(engine, f"broken{mode.capitalize()}") for mode in BREAK_MODES[1:]}
    return {"bonds_alive": engine.bonds} | broken


@_ENGINE
def breaks(engine) -> dict[str, np.ndarray]:
    """Bonds that broke so far, in the order of time and ids, arrays of shape (n,): ``step``, ``id1``, ``id2`` (int,
    lower id first), ``time`` [s], ``mode`` (int, index into BREAK_MODES), ``x``, ``y`` [m]."""
    table = _table(engine.breakTable(), _BREAK)
    for name in ("step", "id1", "id2", "mode"):
        table[name] = table[name].astype(int)
    return table


@_WATER
def water(engine, first, count) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Whether water acts on the bodies ``first`` to ``first + count - 1``, whether they were wet and have been released
    for good, and whether they were ever wet: three bool arrays of shape (count,).

    ``engine``: the PorePressureEngine; all false for bodies that it has not met yet, and where it is None.
    """
    found = np.zeros((count, 3), bool)
    if engine is not None:
        rows = np.frombuffer(engine.bodyTable(), dtype=bool).reshape(-1, 3)[first : first + count]
        found[: len(rows)] = rows
    return tuple(found.T.copy())


@_WATER
def released_shares(engine, first, count) -> np.ndarray:
    """Share of the pore pressure that no longer acts on each of the bodies ``first`` to ``first + count - 1``, as
    :func:`.pore_pressure.release` has set it: shape (count,), 0 to 1.

    ``engine``: the PorePressureEngine, or None: 0 for all.
    """
    found = np.zeros(count)
    if engine is not None:
        shares = engine.releasedShare[first : first + count]
        found[: len(shares)] = shares
    return found


@_WEAKENING
def slip(material, first, count) -> np.ndarray:
    """Distance [m] that each of the bodies ``first`` to ``first + count - 1`` has slipped along the walls, or the
    interface, of a SlipWeakeningMat: shape (count,).
    """
    found = np.zeros(count)
    slips = np.frombuffer(material.slipTable())[first : first + count]
    found[: len(slips)] = slips
    return found
