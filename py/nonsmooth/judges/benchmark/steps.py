"""Whole time steps from a saved state: wall time of each, in all and by stage."""

from __future__ import annotations

import time
from pathlib import Path

from yade import O
from yade.wrapper import (
    Collider,
    ContactDynamicsEngine,
    ForceResetter,
    InteractionLoop,
    NewtonIntegrator,
    PorePressureEngine,
)

from ...measure.statistics import spread
from ...studies.slope import states
from ...world.stepping import advance

__all__ = ["BLOCK", "STAGES", "WARM_UP", "TimedSteps", "measure", "of_scene", "summarise"]

#: Stages of a step in their order, those of ContactDynamicsEngine.stageSeconds among them; "other" is what no stage
#: has.
STAGES = (
    "reset",
    "collide",
    "interactions",
    "pore_pressure",
    "gather",
    "solve",
    "correct",
    "scatter",
    "integrate",
    "other",
)
# by the class of the engine or one it is derived from: what YADE's own timers count
STAGE_OF = {
    ForceResetter: "reset",
    Collider: "collide",
    InteractionLoop: "interactions",
    PorePressureEngine: "pore_pressure",
    NewtonIntegrator: "integrate",
}
# steps before the first that counts: the loaded scene has no caches yet, and its first step makes the collider's lists
WARM_UP = 5


BLOCK = 10  # steps that are made and timed together, as the rows of a run, which reads a table of the disks after them


class TimedSteps:
    """Times steps, at which nobody looks, of the present scene by ContactDynamicsEngine.stageSeconds, by YADE's own
    timers for stages of which that clock knows nothing, and by a clock around BLOCK of them at a time.

    ``rows``: one dictionary a block: wall time [s] of one of its steps by stage, "step" for all of it and "other" for
    what no stage has.
    """

    def __init__(self):
        O.timingEnabled = True
        self.engines = [(e, name) for e in O.engines for kind, name in STAGE_OF.items() if isinstance(e, kind)]
        self.solver = next((e for e in O.engines if isinstance(e, ContactDynamicsEngine)), None)
        self.rows = []

    def run(self, steps, warm_up=WARM_UP):
        """Makes so many steps, and before them ``warm_up`` that are not kept."""
        advance(warm_up, view=False)
        for made in range(0, steps, BLOCK):
            count = min(BLOCK, steps - made)
            before, begin = self._clocks(), time.perf_counter()
            advance(count, view=False)
            if self.solver:
                self.solver.bodyTable()
            step = (time.perf_counter() - begin) / count
            row = {name: seconds / count for name, seconds in self._since(*before).items()}
            self.rows.append({**row, "other": step - sum(row.values()), "step": step})
        return self

    def _clocks(self):
        """What YADE's timers and the solver's clock have come to [s]: two dictionaries."""
        timers = {name: 1e-9 * engine.execTime for engine, name in self.engines}
        return timers, (dict(self.solver.stageSeconds) if self.solver else {})

    def _since(self, timers, clock):
        """What each stage took since. The clock has 0 for a stage that an engine of YADE's own does, as the search of
        spheres in space."""
        timers_now, clock_now = self._clocks()
        timed = {name: after - timers[name] for name, after in timers_now.items()}
        clocked = {name: after - clock[name] for name, after in clock_now.items()}
        return timed | {name: seconds or timed.get(name, 0.0) for name, seconds in clocked.items()}

    def summary(self):
        """As :func:`summarise` has it."""
        return summarise(self.rows)


def summarise(rows):
    """{"step_ms": spread, "stage_ms": {name: spread}} in the order of STAGES, see statistics.spread, of ``rows`` as
    :class:`TimedSteps` has them, one or more."""
    in_ms = {name: spread([1e3 * row[name] for row in rows]) for name in rows[0]}
    return {"step_ms": in_ms["step"], "stage_ms": {name: in_ms[name] for name in STAGES if name in in_ms}}


def measure(folder, source, disks, state, steps, dump=False):
    """Times steps from a saved state; a function for processes.call.

    ``state``: one of states.NAMES; ``dump``: whether to leave the last step's contact problem in ``folder/step.h5``.
    Raises states.BenchmarkError where the state is missing.
    """
    states.load(source, disks, state)
    timed, told = of_scene(steps)
    if dump:
        timed.solver.dump(str(Path(folder) / "step.h5"))
    return {**timed.summary(), **told}


def of_scene(steps, warm_up=WARM_UP):
    """Times so many steps of the present scene, after ``warm_up`` that are not kept: its :class:`TimedSteps`, and a dictionary
    of how many contacts there are, how long a step is [s], and what a solver has to say of it.
    """
    timed = TimedSteps().run(0, warm_up)
    solver = timed.solver
    if solver is None:
        timed.run(steps, warm_up=0)
        return timed, {"contacts": O.interactions.countReal(), "time_step_s": O.dt, "steps": steps}
    sweeps, unconverged, begun = solver.totalIterations, solver.unconverged, O.time
    timed.run(steps, warm_up=0)
    return timed, {
        "sweeps_mean": (solver.totalIterations - sweeps) / steps,
        "unconverged": solver.unconverged - unconverged,
        "contacts": solver.contacts,
        "candidates": solver.candidates,
        "bonds": solver.bonds,
        "mean_speed_m_per_s": solver.meanSpeed,
        "tolerance": solver.tolerance,
        "time_step_s": (O.time - begun) / steps,
        "steps": steps,
    }
