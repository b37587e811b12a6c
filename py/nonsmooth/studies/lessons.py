"""Lessons: the pairs of scripts in scripts/examples, each run in a process of its own with parameters as yade-batch
gives them, and the numbers that it prints.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import UserError
from ..measure import statistics
from ..running import side_by_side
from ..system import keys
from ..system.whole_files import write_atomically

__all__ = ["CASES", "LessonCase", "LessonError", "collect", "merged", "numbers", "one", "run", "under"]

EXAMPLES = Path(__file__).resolve().parents[3] / "scripts" / "examples"
FILM_SECONDS = 8  # of a lesson's video
NUMBER = r"-?\d[\d.]*(?:e[+-]?\d+)?"
WALL = ("wall_s", "process_wall_s")  # what differs from run to run


class LessonError(UserError):
    """A lesson that is not there, or a run of one that failed."""


@dataclass(frozen=True)
class LessonCase:
    """One run of a ``lesson`` in a ``world``, "hard" or "soft": ``parameters`` that differ from those in its script,
    ``seeds``: of several runs, whose numbers become means; ``film``: whether a video is kept."""

    lesson: str
    world: str = "hard"
    parameters: dict = field(default_factory=dict)
    seeds: tuple = ()
    film: bool = False


def _pair(lesson, **shared):
    """A lesson as it is in both worlds, with their videos."""
    return {world: LessonCase(lesson, world, film=True, **shared) for world in ("hard", "soft")}


#: lesson: {name of the case: LessonCase}; what doc/lessons.rst says of them comes from these.
CASES = {
    "incline": _pair("incline") | {"soft_undamped": LessonCase("incline", "soft", dict(damping=0))},
    "pile": _pair("pile"),
    "column": _pair("column", seeds=(1, 2, 3, 4, 5))
    | {
        "elastic_damped": LessonCase("column", "soft", dict(restitution=1, damping=0.2)),
        "elastic": LessonCase("column", "soft", dict(restitution=1)),
    },
    "wedge": {"soft_rough": LessonCase("wedge", "soft", dict(friction=0.7))} | _pair("wedge"),
    "beam": _pair("beam") | {f"{world}_held": LessonCase("beam", world, dict(load=0.97)) for world in ("hard", "soft")},
    "slope": _pair("slope") | {"soft_loose": LessonCase("slope", "soft", dict(young=1e8, dt=1e-3, damping=0.05))},
    "press": _pair("press"),
    "shear": _pair("shear"),
    "drum": _pair("drum"),
    "tester": _pair("tester"),
    "bounce": _pair("bounce"),
    "deposit": _pair("deposit"),
    "oedometer": _pair("oedometer"),
    "heated": _pair("heated"),
}


def under(chosen):
    """The lessons of these names, as of :data:`CASES`; all where there are none. Raises LessonError."""
    for name in chosen:
        if name not in CASES:
            raise LessonError(f"lesson {name!r}: there is none of this name; give some of {', '.join(CASES)}")
    return {name: CASES[name] for name in chosen or CASES}


def numbers(text):
    """The numbers that a lesson prints, by names that are words with underscores: a dictionary.

    Lines of words and a number, as ``steps 1250`` or ``pile height [m] 1.2``, give ``steps`` and ``pile_height_m``,
    also several of them in a line, behind commas or two blanks; the last one of a name counts. Lines that begin with a
    number, and those in which two or more numbers stand by themselves, rows of a table or of a progress, give ``rows``:
    lists of the numbers in them.
    """
    found, rows = {}, []
    for line in text.splitlines():
        alone = [cell for cell in re.split(r"\s{2,}", line.strip()) if re.fullmatch(NUMBER, cell)]
        if len(alone) > 1 and not re.match(r"\s*-?\d", line):
            rows.append([float(cell) for cell in alone])
            continue
        if re.match(r"\s*-?\d", line):
            rows.append([float(value) for value in re.findall(r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?", line)])
            continue
        for words, value in re.findall(r"([^\W\d][^:]*?)\s+(-?\d[\d.]*(?:e[+-]?\d+)?)(?=\s*(?:,|$|\s\s|\())", line):
            found["_".join(re.findall(r"[a-z0-9]+", words.lower()))] = float(value)
    return found | ({"rows": rows} if rows else {})


def _script(lesson, world):
    return EXAMPLES / f"{world}_{lesson}.py"


def one(folder, lesson, world, parameters, seconds=None):
    """Runs a lesson in a world, as a :class:`LessonCase` has them, in the running scene, with a video ``film.mp4`` in
    the folder where ``seconds`` [s], that of the video, are given; returns its :func:`numbers`.

    What it prints stands in ``output.txt``. Raises LessonError where the script ends otherwise than at its end.
    """
    from yade import O

    from ..figures import film, recording
    from ..figures.moving import FPS

    folder, path = Path(folder), _script(lesson, world)
    table = folder / "one.table"
    table.write_text(
        "{}\n{}\n".format(" ".join(["description", *parameters]), " ".join(["one", *map(repr, parameters.values())]))
    )
    said, names = io.StringIO(), vars(sys.modules["__main__"])  # where engines look for what they call
    filmed = seconds is not None and not film.missing()
    with contextlib.ExitStack() as stack:
        os.environ["YADE_BATCH"] = f"{table}:2"
        stack.callback(os.environ.pop, "YADE_BATCH")  # no table of what this process does afterwards
        made = stack.enter_context(recording(O, most=round(seconds * FPS))) if filmed else None
        stack.enter_context(contextlib.redirect_stdout(said))
        exec(compile(path.read_text(), str(path), "exec"), names)
    write_atomically(folder / "output.txt", said.getvalue().encode())
    if made:
        made.write(folder / "film.mp4")
    found = numbers(said.getvalue())
    if "steps" not in found:
        raise LessonError(f"{path.name} with {parameters}: did not come to its end; see {folder}/output.txt")
    return found


def run(chosen, out, threads=1, resume=False, progress=lambda share, ended: None, films=True, changes=None):
    """Runs lessons, ``{name: {case: LessonCase}}`` as of :func:`under`, as many at a time as ``threads``, each in a
    folder of its own below ``out``/runs; returns {name: {case: numbers}}.

    ``changes``: parameters on top of those of the cases. ``films``: whether videos are made. Raises LessonError with
    the first failure after the others have ended.
    """
    runs, order = [], []
    for name, cases in chosen.items():
        for key, case in cases.items():
            for seed in case.seeds or (None,):
                parameters = {**case.parameters, **({} if seed is None else dict(seed=seed)), **(changes or {})}
                seconds = FILM_SECONDS if films and case.film and seed in (None, 1) else None
                arguments = dict(lesson=case.lesson, world=case.world, parameters=parameters, seconds=seconds)
                mark = f"{name}-{key}" + ("" if seed is None else f"-{seed}")
                made_of = keys.key_of([arguments, _script(case.lesson, case.world).read_text()])
                runs.append(side_by_side.Run(mark, Path(out) / "runs" / mark, one, arguments, made_of))
                order.append((name, key, seed))
    results = side_by_side.run(runs, threads, resume, LessonError, progress=progress)
    found = {}
    for (name, key, seed), result in zip(order, results):
        found.setdefault(name, {}).setdefault(key, []).append({k: v for k, v in result.items() if k not in WALL})
    return {name: {key: collect(several) for key, several in cases.items()} for name, cases in found.items()}


def merged(found, path):
    """The lessons of ``found``, as :func:`run` returns them, with the others that the file ``path`` has, if it is
    there: {name: {case: numbers}} in the order of :data:`CASES`. Raises LessonError for a file that cannot be read."""
    try:
        kept = json.loads(Path(path).read_text(encoding="utf-8"))
        kept = {name: dict(cases) for name, cases in kept.items()} | found
    except FileNotFoundError:
        kept = found
    except (OSError, ValueError, AttributeError, TypeError) as error:
        raise LessonError(
            f"{path}: cannot be read as the numbers of lessons ({error}); remove it, or give another --out"
        ) from None
    return {name: kept[name] for name in CASES if name in kept}


def collect(several):
    """The numbers of one run; of several the mean of each with its interval, as statistics.over_seeds has it."""
    if len(several) == 1:
        return several[0]
    return {name: statistics.over_seeds([one.get(name) for one in several]) for name in several[0] if name != "rows"}
