"""Column and pile of :mod:`yade.nonsmooth.heaps` in both worlds."""

from __future__ import annotations

import dataclasses

import numpy as np

from ...measure import heap as measures
from ...running.kept_runs import Progress
from ...system.whole_files import write_arrays
from .cases import Case
from .outcomes import Cost, Outcome, Quantity

__all__ = ["COLUMN", "PILE", "Collapse"]

QUANTITIES = (
    Quantity("runout_rel", "runout (L_f − L_0)/L_0", "1"),
    Quantity("final_height_rel", "height in the end, H_f/L_0", "1"),
    Quantity("front_travel_m", "travel of the front", "m"),
    Quantity("repose_deg", "slope of the flanks", "°"),
    Quantity("rest_s", "time from the release to rest", "s"),
)


class Collapse:
    """A scenario of heaps: ``kind`` is "column" or "pile"."""

    QUANTITIES, KEYS = QUANTITIES, ("runout_rel", "final_height_rel")
    CURVES = {
        "front": "the front's way",
        "centroid": "the centre of mass's way",
        "deposit": "the deposit (1 − common area)",
    }
    SOURCE = ""
    DEFAULT_STIFFNESSES = (1e8, 1e9, 1e10, 1e11)  # Pa; a column of 2000 disks overlaps by some per cent at the softest
    BONDS = False
    ENSEMBLE_STIFFNESS = 1e9  # Pa, for all seeds
    OVERLAP = (
        f"Mean overlap of pairs with a gap below {100 * measures.NEAR:g} % of their mean diameter, walls and glued disks too, in mean diameters (the "
        "disk's at a wall), from places alone; a pair with a gap counts as 0."
    )
    OVERLAP_WHEN = ("at rest in the box", "while moving")
    COST_WHEN = "after the release"

    def __init__(self, kind, title, disks):
        self.NAME, self.TITLE, self.DISKS = kind, title, disks
        self.run = _RUN[kind]

    def disks_of(self, case: Case):
        """Material of the disks, in a list, and their smallest and largest diameter [m]. Raises HeapError for
        parameters that cannot be used.
        """
        heap = _heap(self.NAME, case)
        return [heap.material()], heap.diameters()

    def least_stiffness(self, case: Case):
        """Young's modulus [Pa] with which disks at the bottom overlap by as much as heaps.course.build lets through,
        under the weight of disks as high as the box. They settle by some per cent, so what stands here does there.
        Raises SampleError for a box that is too narrow.
        """
        from ..heaps.course import WEIGHT_OVERLAP

        heap = _heap(self.NAME, case)
        return heap.density * heap.gravity * heap.box()[1] / (0.5 * heap.mean_diameter()) / WEIGHT_OVERLAP

    def prepare(self, case: Case):
        """Makes the disks at rest in their box, unless they are in the cache."""
        from ..heaps import preparation

        preparation.prepared(_heap(self.NAME, case))

    def measure(self, case: Case, folder, found) -> Outcome:
        """What the records of a finished run say; ``found``: what the run returned. Runs are aligned by the release."""
        with np.load(folder / "record.npz", allow_pickle=False) as data:
            series = {name.removeprefix("series_"): data[name] for name in data.files if name.startswith("series_")}
            begin, end = (tuple(data[f"{when}_{k}"] for k in "xyr") for when in ("begin", "end"))
            forces = dict(zip(map(tuple, data["pairs"].tolist()), data["forces"].tolist()))
        t = series["time_s"]
        way = np.hypot(
            series["centroid_x_m"] - series["centroid_x_m"][0], series["centroid_y_m"] - series["centroid_y_m"][0]
        )
        front = series["front_m"] - series["front_m"][0]
        angles = [a for a in found["repose_deg"] if a is not None]
        values = {
            "runout_rel": found["runout_rel"],
            "final_height_rel": found["final_height_rel"],
            "front_travel_m": float(front[-1]),
            "repose_deg": float(np.mean(np.abs(angles))) if angles else None,
            "rest_s": found["time_s"] if found["rested"] else None,
        }
        moving = series["energy_kinetic_J"] > 0.01 * series["energy_kinetic_J"].max()
        simulated = found["steps"] * found["time_step_s"]
        return Outcome(
            case,
            values,
            {"abscissa": t, "front": front, "centroid": way},
            series,
            begin,
            end,
            forces,
            overlap=float(series["overlap_mean_rel"][moving].mean()),
            overlap_rest=float(series["overlap_mean_rel"][0]),
            cost=Cost(found["steps"], found["time_step_s"], found["wall_s"], simulated, found["wall_s"] / simulated),
            notes=[] if found["rested"] else ["stopped before it was at rest"],
        )


def _heap(kind, case):
    from ..heaps import column, pile

    make = {"column": column.Column, "pile": pile.Pile}[kind]
    return make(
        disks=case.disks,
        seed=case.seed,
        **{k: v for k, v in case.options.items() if k in ("aspect", "friction", "rolling_friction", "base")},
    )


def run_column(folder, **plain):
    """Runs a column in the (empty) scene; ``plain``: a Case. Returns the summary of its heaps.course.HeapResult."""
    return _run("column", folder, Case(**plain))


def run_pile(folder, **plain):
    """As :func:`run_column`, a pile."""
    return _run("pile", folder, Case(**plain))


_RUN = {"column": run_column, "pile": run_pile}


def _run(kind, folder, case):
    """Runs a case. Its records are ``record.npz`` and no Snapshots, which have no contact of two bodies that both stay:
    springs between glued disks of a rough floor press by rounding, and count among the forces.
    """
    from ...world import worlds
    from ..heaps import course, study

    heap, note = _heap(kind, case), Progress(folder)
    if case.world == "hard":
        standard = study.world_of(heap)
        world = dataclasses.replace(
            standard, time_step=case.step * standard.time_step, tolerance=case.tolerance * standard.tolerance
        )
    else:
        world = worlds.Soft(
            case.stiffness, heap.diameters(), model=case.model, damping=case.damping, step_share=case.step
        )
    pressed = {}

    def progress(share):
        if not pressed:
            pressed["table"] = _contacts(world)
        note(share)

    result = course.run(
        heap, world, progress=progress, damping_moving=None if case.world == "hard" else case.damping_moving
    )
    begin = result.frames[min(result.frames)]
    pairs = sorted(pressed["table"])
    write_arrays(
        folder / "record.npz",
        **{f"series_{name}": values for name, values in result.series.items()},
        begin_x=begin[0],
        begin_y=begin[1],
        begin_r=result.r,
        end_x=result.x,
        end_y=result.y,
        end_r=result.r,
        pairs=np.array(pairs, int).reshape(-1, 2),
        forces=np.array([pressed["table"][p] for p in pairs]),
    )
    return result.summary()


def _contacts(world):
    """Normal forces [N/m] of the contacts under compression in the scene, {(id, id): force}."""
    from ...world import scene, tables
    from ...world.soft.measures import Measures

    table = tables.contacts(scene.contact_dynamics() if world.name == "hard" else Measures(world))
    return {
        (min(a, b), max(a, b)): n
        for a, b, n in zip(table["id1"].tolist(), table["id2"].tolist(), table["normal"].tolist())
        if n > 0
    }


COLUMN = Collapse("column", "Collapse of a column", 2000)
PILE = Collapse("pile", "Pile whose sides are taken away", 1000)
