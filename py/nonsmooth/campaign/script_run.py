"""What a process does with a YADE script: as YADE would run it, with parameters as yade-batch hands them over. In
YADE.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
from pathlib import Path

from ..records import RecordsError
from ..system.whole_files import write_atomically
from ..world import scene_arrays
from .script_output import OUTPUT, SCENE

__all__ = ["run"]

TABLE = "parameters.table"


class _Twice(io.StringIO):
    """Keeps what is printed, and prints it."""

    def write(self, text):
        sys.__stdout__.write(text)
        return super().write(text)


def run(folder, script, parameters):
    """Runs the ``script`` (its path) in the folder, which becomes the working folder; ``parameters``: {name: value}, of
    utils.readParamsFromTable.

    Writes ``output.txt``, what the script has printed, and ``scene.npz``, where disks are left. Returns ``steps`` and
    the simulated ``time_s`` of its last scene.
    """
    from yade import O

    folder, home = Path(folder).resolve(), Path.cwd()
    os.environ.pop("YADE_BATCH", None)  # a table that this process was given is not the script's
    if parameters:
        # a table's words are parted by spaces, and what follows a # is no part of it
        row = ["notebook", *(repr(value).replace(" ", r"\x20").replace("#", r"\x23") for value in parameters.values())]
        (folder / TABLE).write_text(f"{' '.join(['description', *parameters])}\n{' '.join(row)}\n")
        os.environ["YADE_BATCH"] = f"{folder / TABLE}:2"
    sys.argv = [script]
    # among the names that YADE gives its scripts, where engines look for them too; those of this process must be there
    # again afterwards
    names, said = vars(sys.modules["__main__"]), _Twice()
    before = dict(names)
    names["__file__"] = script
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(said):
            exec(compile(Path(script).read_text(encoding="utf-8"), script, "exec"), names)
            if O.running and not (O.stopAtIter or O.stopAtTime):
                O.pause()  # it would go on for ever
            O.wait()
    finally:
        os.chdir(home)
        names.clear()
        names.update(before)
    write_atomically(folder / OUTPUT, said.getvalue().encode())
    with contextlib.suppress(RecordsError):  # a scene without disks has no picture
        scene_arrays.save(scene_arrays.read(O), folder / SCENE)
    return {"steps": O.iter, "time_s": O.time}
