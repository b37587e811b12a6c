"""YADE scripts from any Python, the lessons among them: each runs in a YADE process of its own (:mod:`.script_run`),
and is opened from its folder (:mod:`.script_output`).

    from nonsmooth import campaign

    run = campaign.run_lesson("incline", "out/incline", world="hard", slope=30)
    run.number("steps"), run.table("friction/tan(slope)")["slid [m]"]
    run.figure()                                             # the scene at the end
    campaign.run_script("my_script.py", "out/mine", friction=0.4)

A script takes parameters by ``utils.readParamsFromTable``, as in YADE's batch runs.
"""

from __future__ import annotations

import ast
import difflib
import math
from pathlib import Path

from ..errors import UserError
from ..running import side_by_side
from ..studies import runs
from ..system import checks, keys, output_folder
from .cases import run as run_cases
from .script_output import ScriptRun

__all__ = ["LESSONS", "ScriptError", "lesson", "lessons", "parameters_of", "run_lesson", "run_script", "run_scripts"]

LESSONS = Path(__file__).resolve().parents[3] / "scripts" / "examples"
WORLDS = ("hard", "soft")
COMMAND = "run_script"  # the name under which a folder is held
FUNCTION = "campaign.script_run:run"


class ScriptError(UserError, ValueError):
    """A script or a parameter that cannot be used; the message says which and what would do."""


def lessons() -> tuple:
    """Names of the lessons (scripts/examples): those that have both a hard and a soft script."""
    return tuple(
        sorted(
            path.stem.removeprefix("hard_")
            for path in LESSONS.glob("hard_*.py")
            if path.with_name(path.name.replace("hard_", "soft_", 1)).exists()
        )
    )


def lesson(name, world="hard") -> Path:
    """The script of a lesson, ``hard`` or ``soft``. Raises ScriptError for another lesson or world."""
    known = lessons()
    checks.text("lesson", name, ScriptError, f"give one of {', '.join(known)}")
    if name not in known:
        raise ScriptError(
            f"lesson {name!r}: there is no such lesson; give one of {', '.join(known)}"
            if known
            else f"{LESSONS}: the lessons are not there; run them from a checkout of yade-nonsmooth"
        )
    if world not in WORLDS:
        raise ScriptError(f"world {world!r}: give hard or soft")
    return LESSONS / f"{world}_{name}.py"


def run_lesson(name, out, world="hard", resume=None, **parameters) -> ScriptRun:
    """Runs the ``hard`` or ``soft`` script of a lesson. Raises what :func:`lesson` raises; the rest as for
    :func:`run_script`.
    """
    return run_script(lesson(name, world), out, resume, **parameters)


def run_script(script, out, resume=None, **parameters) -> ScriptRun:
    """Runs one YADE script in the folder ``out``, with its ``parameters``, and opens the run; the rest as for
    :func:`run_scripts`.

    ``resume``: whether to keep a run of the same script and parameters that has ended (None: not). Raises ScriptError
    too where the script itself has a parameter of that name, which :func:`run_scripts` takes.
    """
    checks.path("out", out, ScriptError, runs.FOLDER)
    known = () if resume is None else parameters_of(script) or ()
    if "resume" in known:
        raise ScriptError(
            f"resume {resume!r}: {Path(script).name} has a parameter of this name, and run_script an argument; give the script's by "
            f"run_scripts({{'one': ({Path(script).name!r}, {{'resume': {resume!r}}})}}, out)"
        )
    one = _planned(str(out), out, script, parameters)
    resume = bool(resume)
    with output_folder.claimed(out, COMMAND, resume):
        side_by_side.run([one], 1, resume, ScriptError)
    return ScriptRun(out)


def run_scripts(cases, out, threads=1, resume=False) -> dict:
    """Runs ``cases``, {name: (script, parameters)}, as many at a time as ``threads``, each in a process of its own and
    in the folder ``out/runs/NAME``, which is its working folder; returns {name: ScriptRun}.

    ``script``: path of a YADE script, as :func:`lesson` gives it; ``parameters``: {name: number or text}, what it reads
    by ``utils.readParamsFromTable``; ``resume``: keep runs of the same script and parameters that have ended. Raises
    ScriptError for a script that is not there and for parameters that it does not read, before anything runs, and where
    a script fails, after the others have ended; FolderError where another process works in the folder.
    """
    remedies = (
        "give a dictionary {name: (script, {parameter: value})}, of one or more",
        "give (script, {parameter: value})",
    )
    made = run_cases(cases, out, _planned, COMMAND, threads, resume, ScriptError, remedies)
    return {one.name: ScriptRun(one.folder) for one in made}


def _planned(name, folder, script, parameters):
    script = Path(checks.path("script", script, ScriptError, "give the path of a YADE script")).resolve()
    known = parameters_of(script)
    for key, value in parameters.items():
        if known is not None and key not in known:
            near = difflib.get_close_matches(key, known, 1)
            advice = (
                f"did you mean {near[0]!r}?" if near else f"it reads {', '.join(known)}" if known else "it reads none"
            )
            raise ScriptError(f"{key}: {script.name} reads no such parameter; {advice}")
        if not isinstance(value, (bool, int, float, str)) or isinstance(value, float) and not math.isfinite(value):
            raise ScriptError(f"{key} {value!r}: give a finite number or a text")
    arguments = {"script": str(script), "parameters": parameters}
    return side_by_side.Run(
        name, Path(folder), FUNCTION, arguments, keys.key_of([script.read_text(encoding="utf-8"), parameters])
    )


def parameters_of(script):
    """Names that a script gives to ``utils.readParamsFromTable``, in order, read from its source; None where they
    cannot be read from it. Raises ScriptError for a script that is not there or no Python."""
    checks.path("script", script, ScriptError, "give the path of a YADE script")
    try:
        tree = ast.parse(Path(script).read_bytes())
    except OSError as error:
        raise ScriptError(
            f"{script}: the script cannot be read ({error.strerror}); give the path of a YADE script"
        ) from None
    except (SyntaxError, ValueError) as error:
        raise ScriptError(f"{script}: is no Python ({error}); give the path of a YADE script") from None
    given, found = {}, []
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and _calls(node.value, "dict"):
            given[node.targets[0].id] = [one.arg for one in node.value.keywords]
    for node in ast.walk(tree):
        if _calls(node, "readParamsFromTable"):
            for one in node.keywords:
                if one.arg is not None:
                    found += [one.arg]
                elif isinstance(one.value, ast.Name) and one.value.id in given:
                    found += given[one.value.id]
                else:
                    return None
    return [name for name in found if name not in ("tableFileLine", "noTableOk", "unknownOk")]


def _calls(node, name):
    """Whether a node calls what is called so, as a name or as an attribute."""
    return isinstance(node, ast.Call) and name in (getattr(node.func, "id", None), getattr(node.func, "attr", None))
