"""A script of soft contacts that runs as it is, with rigid ones: what stands behind ``yade-nonsmooth --hard SCRIPT``.

The script's own calls of O.run() and O.step() are seen: before the first of them, and whenever the script has put other
soft contacts into O.engines since, the scene is hardened. Steps that it asks for, and steps between two calls of its
engines, become the same time. What it sets O.dt to is the soft step. Bodies that it adds get rigid materials in the
next step. Windows of YADE's (yade.qt) are left out, and so are those of plots.
"""

from __future__ import annotations

import os
import random
import re
import sys
import time
import types

import numpy as np

import yade.wrapper
from yade._packSpheres import SpherePack
from yade.wrapper import InteractionLoop, Law2_ScGeom_NscdPhys_SignoriniCoulomb, Omega, PyRunner

from .error import HardenError
from .scene import harden

__all__ = ["Watch", "YadeCheckError", "seed_all", "stand_ins"]


_NONE_OF_IT = ("elastPotential", "nonviscDamp", "plastDissip")
_IDLE = 100  # times that a script may ask for steps after its last one


class Watch:
    """Sees to a script's runs. ``hard``: its contacts become rigid; False: it stays as it is, and is measured alone.
    ``most``: time [s], ``most_steps``: number of steps after which all of its runs end; None: when the script's do.
    ``measure(O)``: what is to be found then, ``found``.
    """

    _now = None

    def __init__(self, hard=True, most=None, most_steps=None, options=None, measure=None):
        self.hard, self.most, self.most_steps, self.options = hard, most, most_steps, options or {}
        self._measure, self.found = measure, None
        self.start = None  # what ``measure`` says before the first step
        self.hardened = None
        self.wall, self.steps, self.overlap = 0.0, 0, 0.0
        self._idle = 0  # times that it asked for steps after its last one
        self._soft_step = None
        self._bodies = 0

    def install(self):
        """Replaces methods of Omega, for the rest of the process."""
        Watch._now = self
        os.environ.setdefault("MPLBACKEND", "Agg")
        _leave_out_windows()
        run, step = Omega.run, Omega.step
        watch = self

        def run_hard(omega, nSteps=-1, wait=False):
            watch.prepare(omega)
            watch.advance(omega, run, watch.steps_for(omega, nSteps))

        def step_hard(omega):
            watch.prepare(omega)
            begin = time.perf_counter()
            step(omega)
            watch.wall += time.perf_counter() - begin
            watch.steps += 1

        Omega.run, Omega.step = run_hard, step_hard
        if self.hard:
            self._watch_dt()
        return self

    def _watch_dt(self):
        real, watch = Omega.dt, self

        def set_dt(omega, value):
            if watch.hardened is None:
                real.__set__(omega, value)
            else:  # the script means its springs
                watch._soft_step = value

        Omega.dt = property(lambda omega: real.__get__(omega), set_dt)
        self._set_dt = real.__set__

    def prepare(self, omega):
        """Hardens the scene where its contacts are soft."""
        if self.start is None and self._measure is not None:
            self.start = self._measure(omega)
        self.take_new(omega)
        if not self.hard or not _is_soft(omega):
            self._soft_step = self._soft_step or omega.dt
            return
        self._soft_step = self._soft_step or omega.dt
        if omega.trackEnergy:  # what springs and damping would have: scripts ask for it by name
            for name in _NONE_OF_IT:
                omega.energy[name] = 0.0
        before, self.hardened = self.hardened, None
        self.hardened = harden(omega, **self.options)
        self._soft_step = self.hardened.soft_step if before is None else self._soft_step
        self._bodies = len(omega.bodies)
        command = f"__import__('sys').modules['{__name__}'].take_new()"
        # behind all others: a script may know its own engines by their places
        omega.engines = omega.engines + [PyRunner(command=command, iterPeriod=1, initRun=True, label="")]
        if before is None:
            print(self.hardened, flush=True)

    def steps_for(self, omega, steps):
        """Steps of now in the time of so many soft ones; negative: no end is asked for."""
        if not self.hard or steps < 0 or self._soft_step is None:
            return steps
        return max(1, round(steps * self._soft_step / omega.dt))

    def advance(self, omega, run, steps):
        """Makes the steps, and looks at them from outside: O.pause() of the script's engines ends them."""
        bounds = [] if self.most is None else [max(0, round((self.most - omega.time) / omega.dt))]
        if self.most_steps is not None:
            bounds.append(max(0, self.most_steps - self.steps))
        count = min([*bounds, *([steps] if steps >= 0 else [])], default=None)
        if count is None and omega.stopAtIter > omega.iter:
            count = self.steps_for(omega, omega.stopAtIter - omega.iter)
        if count is None and omega.stopAtTime > omega.time:
            count = max(1, round((omega.stopAtTime - omega.time) / omega.dt))
        if count is None:
            raise HardenError("the script runs without an end: give --time, the simulated time [s] after which it ends")
        begin, first = time.perf_counter(), omega.iter
        if count > 0:
            run(omega, count, True)
        elif bounds and min(bounds) == 0:
            self._end_idle()
        self.wall += time.perf_counter() - begin
        self.steps += omega.iter - first
        if bounds and count == min(bounds) and self._measure is not None and self.found is None:
            self.found = self._measure(omega)  # a script may load or clear its scene afterwards

    def _end_idle(self):
        """Ends a script that asks for steps again and again after its last one, as one that waits for a stress."""
        self._idle += 1
        if self._idle == _IDLE:  # once: what is told at the end may ask for the rest too
            print(f"the script asks for further steps after {self.steps} of them, its last; it ends here", flush=True)
            raise SystemExit

    def run_on(self, omega):
        """Makes the steps that the script has left to a window's button, up to the bound."""
        omega.run(-1, True)

    def take_new(self, omega):
        """Gives bodies that came since the last look rigid materials."""
        if self.hardened is not None and len(omega.bodies) != self._bodies:
            self._bodies = len(omega.bodies)
            self.hardened.take(omega.bodies)


def take_new():
    """Called by an engine at the head of a hardened scene's list, in each step."""
    Watch._now.take_new(Omega())


def _is_soft(omega):
    loops = [e for e in omega.engines if isinstance(e, InteractionLoop) and not e.dead]
    return any(
        not isinstance(law, Law2_ScGeom_NscdPhys_SignoriniCoulomb)
        for loop in loops
        for law in loop.lawDispatcher.functors
    )


def seed_all(seed=1):
    """From now on a script draws the same numbers in each of its runs: by ``random``, by NumPy, and in clouds of spheres
    that it gives no seed.
    """
    random.seed(seed)
    np.random.seed(seed)
    make = SpherePack.makeCloud

    def make_cloud(pack, *arguments, **options):
        if len(arguments) < 12:  # the place of makeCloud's own seed
            options.setdefault("seed", seed)
        return make(pack, *arguments, **options)

    SpherePack.makeCloud = make_cloud


class YadeCheckError(Exception):
    """What YADE's checks raise where their answer is wrong; their harness has it."""


def stand_ins(text):
    """Names that a script uses and that a YADE without windows, or outside of its harness of checks, has not."""
    drawing = {name: _Nothing for name in re.findall(r"\b(?:Gl1_\w+|OpenGLRenderer)\b", text)}
    return {
        **{name: what for name, what in drawing.items() if not hasattr(yade.wrapper, name)},
        "YadeCheckError": YadeCheckError,
    }


class _Nothing:
    """Takes whatever is asked of a window."""

    def __init__(self, *arguments, **options):
        pass

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _Nothing()

    def __call__(self, *arguments, **options):
        return _Nothing()

    def __setitem__(self, key, value):
        pass

    def __getitem__(self, key):
        return _Nothing()


class _NoWindows(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _Nothing()


def _leave_out_windows():
    try:
        import yade.qt  # noqa: F401
    except (ImportError, RuntimeError, SystemExit):
        import yade

        yade.qt = sys.modules["yade.qt"] = _NoWindows("yade.qt")
