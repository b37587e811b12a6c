"""The files that a run leaves in its folder, by their names, and which of them a new or a resumed run removes. Needs no
YADE.
"""

from __future__ import annotations

import re
from pathlib import Path

from ... import records
from ...model.section import data as section_data, shaking as section_shaking
from ...system.whole_files import remove, remove_parts, whole
from ...water import of_section
from . import frames

__all__ = [
    "BEGIN",
    "BREAKS",
    "END",
    "FIGURES",
    "LEDGER",
    "PARAVIEW",
    "PICTURES",
    "SERIES",
    "SNAPSHOTS",
    "SUMMARY",
    "SURFACE",
    "SURFACE_ARRAYS",
    "WALLS",
    "check_folder",
    "foreign",
    "forget",
    "forget_later",
]

EARLIER = "left from an earlier run"
SERIES, WALLS, SECTION = "series.csv", "walls.csv", section_data.FILE
HEAD = b"step,time_s,"  # begins the series of every run

# what a run leaves besides its series and its checkpoint
INPUTS = (section_shaking.FILE, of_section.FILE)  # that its section.yaml names
LEDGER = "eroded.csv"  # of disks that were taken out
SURFACE = "slip_surface.csv"  # of cells along walls with slip laws
SURFACE_ARRAYS = "slip_surface.h5"  # the same, of a run that has ended
SUMMARY, BREAKS, BEGIN, END = "summary.json", "breaks.csv", "t0.npz", "end.npz"
LEFT = (*INPUTS, SUMMARY, BREAKS, LEDGER, SURFACE, SURFACE_ARRAYS, BEGIN, END)
SNAPSHOTS, PARAVIEW = frames.FOLDER, "vtk"
#: Names of the figures in the order in which they are drawn; of their files with ".png".
PICTURES = tuple(
    "force_chains forces snapshots weakening slip_surface toe deposit erosion shaking water energy solver".split()
)
FIGURES = (*(f"{name}.png" for name in PICTURES), "avalanche.mp4")


def forget(folder):
    """Removes what an earlier run left in ``folder``, so that nothing of it is taken for the next one's; its series and
    checkpoint apart.

    Half-written files that killed runs have left go too. Raises WriteError.
    """
    folder = Path(folder)
    remove(
        [folder / name for name in (*LEFT, *FIGURES)]
        + _written(folder / SNAPSHOTS, r"\d{8,}\.npz")
        + _written(
            folder / PARAVIEW, r"((disks|contacts|slip_surface)-\w+|walls|breaks)\.vtu|(avalanche|slip_surface)\.pvd"
        ),
        EARLIER,
    )
    remove_parts(folder, folder / SNAPSHOTS, folder / PARAVIEW)


def _written(folder, names):
    """Files in a folder that a run has written, by their ``names``, a pattern; others are a user's own."""
    return [path for path in whole(folder, "*") if re.fullmatch(names, path.name)]


def foreign(folder):
    """The name of a file that a new run in ``folder`` would remove or write over and that no run has left there; None
    where there is none.
    """
    folder = Path(folder)
    series = folder / SERIES
    try:
        with series.open("rb") as file:
            head = file.read(len(HEAD))
        if head in (HEAD, b""):  # a run was killed before it wrote more
            return None
    except OSError:
        pass
    if (folder / "key").exists():  # kept_runs has begun one
        return None
    names = (SERIES, WALLS, SECTION, *LEFT, *FIGURES, "checkpoint")
    found = [folder / name for name in names if (folder / name).exists()]
    found += _written(folder / SNAPSHOTS, r"\d{8,}\.npz") + _written(folder / PARAVIEW, r".*\.(vtu|pvd)")
    return found[0].relative_to(folder).as_posix() if found else None


def check_folder(folder):
    """Raises records.RecordsError where a new run in ``folder`` would remove or write over what no run has left there,
    see :func:`foreign`.
    """
    name = foreign(folder)
    if name is not None:
        raise records.RecordsError(
            f"{folder}: holds {name}, which no run has left there, and a new run removes or writes over it; give an empty folder, a new one, or that of an earlier run"
        )


def forget_later(folder, stage, step):
    """Removes snapshots of times that a run resumed in ``stage`` (of course.State) at ``step`` has not reached yet, and
    half-written files.
    """
    folder = Path(folder)
    later = [path for path in whole(folder / SNAPSHOTS, "*.npz") if path.stem.isdecimal() and int(path.stem) > step]
    ends = [folder / END, folder / SURFACE_ARRAYS]
    remove(later + [folder / BEGIN] * (stage in ("settle", "dry")) + ends * (stage != "done"), EARLIER)
    remove_parts(folder, folder / SNAPSHOTS, folder / PARAVIEW, folder / "checkpoint")
