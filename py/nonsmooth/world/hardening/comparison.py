"""A soft script run as it is and with rigid contacts, each in a process, and what both took beside each other."""

from __future__ import annotations

import argparse
import math
import os

from tabulate import tabulate

from yade.wrapper import NewtonIntegrator, ResetRandomPosition, Sphere, SpheresFactory

from ...system import script_process
from .error import HardenError
from .script import Watch, seed_all, stand_ins

__all__ = ["asked", "begin", "both", "end", "stand_ins"]


def asked(argv):
    """The launcher's options, the script, and the arguments that are its own."""
    at = argv.index("--")
    parser = argparse.ArgumentParser(prog="yade-nonsmooth", add_help=False)
    parser.add_argument("--how", choices=("hard", "both", "soft"))
    parser.add_argument("--time", default="")
    parser.add_argument("--steps", type=int)
    parser.add_argument("--keep-step", action="store_true")
    parser.add_argument("--damped", action="store_true")
    parser.add_argument("--seeded", action="store_true")
    how = parser.parse_args(argv[1:at])
    try:
        how.time = float(how.time) if how.time else None
    except ValueError:
        how.time = -1.0
    if how.time is not None and not 0 < how.time < float("inf"):
        parser.error("--time: give a simulated time [s], positive and finite")
    how.both = how.how == "both"
    return how, argv[at + 1], argv[at + 1 :]


def begin(how):
    """Watches the script's runs from here on."""
    if how.seeded:
        seed_all()
    options = dict(step="soft") if how.keep_step else {}
    if how.damped:
        options["restitution"] = "damping"
    return Watch(
        hard=how.how == "hard", most=how.time, most_steps=how.steps, options=options, measure=_measured
    ).install()


def end(how, watch, O):
    """After the script: makes the steps that it has left to a window's button, where a time is asked for, and tells
    what all took.
    """
    if ((how.time is not None and O.time < how.time) or (how.steps is not None and not watch.steps)) and O.engines:
        watch.run_on(O)
    if not watch.steps and how.how == "hard" and watch.hardened is None:
        raise HardenError("the script makes no steps: give --time, the simulated time [s] for which it is to run")
    found = {"wall time [s]": watch.wall, "steps": watch.steps, **(watch.found or _measured(O))}
    if watch.start and "mean x [m]" in watch.start and "mean x [m]" in found:
        names = [f"mean {axis} [m]" for axis in "xyz"]
        found["way [m]"] = math.sqrt(sum((found[name] - watch.start[name]) ** 2 for name in names))
    if not script_process.tell(found):
        print(tabulate(found.items(), floatfmt=".4g"))


def _measured(O):
    """What is compared of two runs."""
    balls = [b for b in O.bodies if b is not None and isinstance(b.shape, Sphere) and b.dynamic]
    return {
        "simulated [s]": O.time,
        "step [s]": O.dt,
        "kinetic energy [J]": sum(_kinetic(b.state) for b in O.bodies if b is not None and b.dynamic),
        "largest overlap [radii]": _largest_overlap(O),
        "contacts": O.interactions.countReal(),
        "spheres": len(balls),
        # engines that draw by chance, each time otherwise
        "factories": sum(isinstance(e, (SpheresFactory, ResetRandomPosition)) for e in O.engines),
        **_places(balls),
        **_heights(O),
    }


def _kinetic(state):
    """Kinetic energy of a body, that of its turning included [J]; inertia is about its own axes."""
    turning = state.ori.conjugate() * state.angVel
    return 0.5 * (state.mass * state.vel.squaredNorm() + sum(i * w * w for i, w in zip(state.inertia, turning)))


def _places(balls):
    """Mean place of the spheres, how far they are spread about it, and their mean diameter."""
    if not balls:
        return {}
    centre = [sum(b.state.pos[k] for b in balls) / len(balls) for k in range(3)]
    spread = math.sqrt(sum((b.state.pos[k] - centre[k]) ** 2 for b in balls for k in range(3)) / len(balls))
    return {
        "mean diameter [m]": 2 * sum(b.shape.radius for b in balls) / len(balls),
        **{f"mean {axis} [m]": value for axis, value in zip("xyz", centre)},
        "spread [m]": spread,
    }


def _heights(O):
    """Where the spheres are against gravity, and how they press on what does not move."""
    newtons = [e for e in O.engines if isinstance(e, NewtonIntegrator) and not e.dead]
    gravity = [e.gravity for e in newtons]
    balls = [b for b in O.bodies if b is not None and isinstance(b.shape, Sphere) and b.dynamic]
    if not gravity or not gravity[0].norm() or not balls:
        return {}
    up = -gravity[0].normalized()
    heights = [up.dot(b.state.pos) for b in balls]
    held = sum(-up.dot(O.forces.f(b.id)) for b in O.bodies if b is not None and not b.dynamic)
    weight = sum(b.state.mass for b in balls) * gravity[0].norm()
    return {
        "mean height [m]": sum(heights) / len(heights),
        "highest [m]": max(heights),
        "weight held [share]": held / weight if weight > 0 else 0,
        "gravity [m/s²]": gravity[0].norm(),
        "damping": newtons[0].damping,
    }


def _largest_overlap(O):
    """In radii of the smaller sphere, of all contacts at the end of the run."""
    deepest = 0.0
    for i in O.interactions:
        if i.isReal and i.geom is not None:
            least = min(r for r in (i.geom.refR1, i.geom.refR2) if r > 0)
            deepest = max(deepest, i.geom.penetrationDepth / least)
    return deepest


def both(how, path, argv):
    """Runs the script soft, then hard, and prints both; returns the exit status."""
    threads = os.environ.get("OMP_NUM_THREADS", "1")
    rows, status = {}, 0
    for kind in ("soft", "hard"):
        done, found = script_process.run(
            path,
            kind,
            threads,
            arguments=argv[1:],
            time=how.time,
            steps=how.steps,
            keep_step=how.keep_step,
            seeded=True,
        )
        status = status or done.returncode
        if found is not None:
            rows[kind] = found
    names = list(dict.fromkeys(name for row in rows.values() for name in row))
    table = [[name, *(rows.get(kind, {}).get(name, "") for kind in ("soft", "hard"))] for name in names]
    print(tabulate(table, headers=["", "soft", "hard"], floatfmt=".4g"))
    return status
