"""The small slope run from its first step to its rest while every step is written down: what its records are to be
recomputed from.

`Watch` holds plain arrays, so tests read it after the scene has gone. SI units, per metre of thickness.
"""
from dataclasses import asdict
from types import SimpleNamespace

import numpy as np
from slope_scenes import SMALL
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import contact, experiment, records, section, tables
from yade.nonsmooth.studies.slope import results, slope, slope_packing

DUMPED = 40  # rows between two contact problems that are kept


def sorted_contacts(solver):
    """The contact table with the lower id first and the normal from it to the other, in the order of ids."""
    rows = np.frombuffer(solver.contactTable()).reshape(-1, 12).copy()
    rows[rows[:, 0] > rows[:, 1], 5:7] *= -1
    rows[:, :2] = np.sort(rows[:, :2], axis=1)
    return rows[np.lexsort((rows[:, 1], rows[:, 0]))]


def solved(solver, bodies, first, path):
    """``bodies`` (x, y, vx, vy, omega; the first one of id ``first``) with the velocities that the step's contact
    problem was solved for; ``path``: of a file to write it to.
    """
    solver.dump(str(path))
    return np.r_[bodies[:2], contact.load(str(path)).velocity[first : first + bodies.shape[1]].T]


class Work:
    """What contacts did in each step, by hand: impulses times the mean of the relative velocities before and after it.

    Tension in a bond which opens neither in a step nor in the one before dissipates nothing: it is an error of the
    step.
    """

    def __init__(self, first, r):
        self.first, self.r = first, r  # id of the first disk, radii of the disks
        self._bears = {}  # by pair: the tension at which its bond opens [N]
        self._open = set()  # pairs that opened in the last step

    def of(self, table, before, after, h):
        """Losses of a step [J] in the order of records.LOSSES, the work of tension in bonds that hold [J], and the
        contacts' relative velocities at its end (3, contacts).

        ``table``: :func:`sorted_contacts` after the step; ``before``, ``after``: x, y, vx, vy, omega of the disks.
        Bodies that turn as one have two velocities at a step's end: solved, and turned; the sums are of the first.
        """
        n, t, torque, nx, ny, gap = table[:, 2:8].T
        i, j = table[:, :2].astype(int).T - self.first
        wall, u = i < 0, []  # they stand still
        for x, y, vx, vy, w in (before, after):

            def fixed(values):
                return np.where(wall, 0, values[i])

            dx, dy = vx[j] - fixed(vx), vy[j] - fixed(vy)
            across = -dx * ny + dy * nx - w[j] * (self.r[j] + 0.5 * gap) - fixed(w) * (fixed(self.r) + 0.5 * gap)
            u.append(np.array([dx * nx + dy * ny, across, w[j] - fixed(w)]))
        normal, sliding, rolling = -0.5 * h * np.array([n, t, torque]) * (u[0] + u[1])
        held = self._hold(table, u[1][0])
        pulled = (n < 0) & ~held
        return (
            (sliding.sum(), rolling.sum(), normal[n >= 0].sum(), normal[pulled].sum()),
            -normal[(n < 0) & held].sum(),
            u[1],
        )

    def _hold(self, table, opening):
        """Which contacts are bonds that open neither in this step nor in the one before."""
        bonded = np.flatnonzero(table[:, 8])
        pairs = [tuple(p) for p in table[bonded, :2].astype(int).tolist()]
        for p in pairs:
            if p not in self._bears:
                self._bears[p] = O.interactions[p].phys.tensileForce
        bears = np.array([self._bears[p] for p in pairs])
        opens = (table[bonded, 2] <= -(1 - 1e-9) * bears) & (opening[bonded] > 0)
        held = np.zeros(len(table), dtype=bool)
        held[bonded] = ~opens & ~np.array([p in self._open for p in pairs], dtype=bool)
        self._open = {p for p, now in zip(pairs, opens) if now}
        return held


class Watch:
    """Steps and rows of an experiment while it runs.

    ``steps``: arrays with a first axis of steps: ``iter``, ``time`` (at the end), ``dt``, ``gravity`` (2), ``before``
    and ``after`` (columns of tables.bodies: x, y, angle, vx, vy, omega; shape (6, disks)), ``walls`` (pieces, 3: force
    and torque on them), ``water`` (2: the force on all disks), ``height``, ``wet``, ``released``, ``ever_wet``,
    ``counters`` (:data:`COUNTERS`), ``losses`` (sliding, rolling, impact, bonds: by hand), ``slip`` (of each disk on
    DP), ``solved`` (vx, vy, omega that the step was solved for: bonded disks that turn as one are turned then).
    ``begun``, ``rows``: the contact table after two steps and at each row, see :func:`sorted_contacts`; ``dumps``:
    every :data:`DUMPED` rows the number of the row and its contact problem.
    """

    COUNTERS = (
        "slidingLoss",
        "rollingLoss",
        "debondingLoss",
        "impactLoss",
        "externalWork",
        "wallWork",
        "correctionEnergy",
        "energyError",
        "kineticEnergy",
        "potentialEnergy",
    )
    BODY = ("x", "y", "angle", "vx", "vy", "omega")

    def __init__(self, built, folder):
        self.folder, self.dumps = folder, []
        self.solver, self.water = built.solver, built.water
        self.pieces = [i for ids in built.walls.values() for i in ids]
        self.wall_of = [name for name, ids in built.walls.items() for _ in ids]
        self.way = np.array([tuple(O.bodies[i].state.ori * Vector3(1, 0, 0)) for i in self.pieces])[:, :2]
        self.first, self.count = built.first_disk, built.count
        self.newton = O.engines[-1]
        t = tables.bodies(self.solver)
        self.r = t["r"]
        states = [O.bodies[int(i)].state for i in t["id"]]
        self.work = Work(self.first, self.r)
        self.mass, self.inertia = np.array([s.mass for s in states]), np.array([s.inertia[2] for s in states])
        self._seen, self.rows = [], []
        self._last = self._bodies()

    def _bodies(self):
        t = tables.bodies(self.solver)
        return np.array([t[name] for name in self.BODY])

    def advance(self, steps=1, until=None, view=True):
        """Steps of the experiment, as stepping.advance makes them, each written down."""
        while steps > 0 if until is None else O.time < until - 0.5 * O.dt:
            self._step()
            steps -= 1

    def _step(self):
        began = O.time
        self._advance()
        after, water = self._bodies(), self.water
        if O.iter == 2:
            self.begun = sorted_contacts(self.solver)
        losses, slip, end = self._of_contacts(self._last, after, O.time - began)
        self._seen.append(
            (
                O.iter,
                O.time,
                O.time - began,
                tuple(self.newton.gravity)[:2],
                self._last,
                after,
                [(*tuple(O.forces.f(i))[:2], O.forces.t(i)[2]) for i in self.pieces],
                tuple(water.totalForce)[:2],
                water.height,
                *tables.water(water, self.first, self.count),
                [getattr(self.solver, name) for name in self.COUNTERS],
                losses,
                slip,
                end,
            )
        )
        self._last = after

    def _of_contacts(self, before, after, h):
        """What contacts dissipated in a step [J], how far each disk slipped on DP [m], and the velocities that the step
        was solved for.
        """
        table, places = sorted_contacts(self.solver), [0, 1, 3, 4, 5]
        end = solved(self.solver, after[places], self.first, self.folder / "step.h5")
        losses, _, u = self.work.of(table, before[places], end, h)
        i, j = table[:, :2].astype(int).T - self.first
        on = np.isin(table[:, 0], [k for k, name in zip(self.pieces, self.wall_of) if name == "DP"])
        dp = (i < 0) & on & (table[:, 2] > 0)
        slip = np.zeros(self.count)
        np.add.at(slip, j[dp], np.abs(h * u[1][dp]))
        return losses, slip, end[2:]

    def row(self, *_):
        """Called after each row."""
        if len(self.rows) % DUMPED == DUMPED - 1:
            path = self.folder / f"row-{len(self.rows)}.h5"
            self.solver.dump(str(path))
            self.dumps.append((len(self.rows), path))
        self.rows.append(sorted_contacts(self.solver))

    def begin(self, patch):
        """Every step of experiments is watched from now on. ``patch``: a pytest.MonkeyPatch."""
        self._advance = experiment.advance
        patch.setattr(experiment, "advance", self.advance)

    def end(self):
        names = (
            "iter",
            "time",
            "dt",
            "gravity",
            "before",
            "after",
            "walls",
            "water",
            "height",
            "wet",
            "released",
            "ever_wet",
            "counters",
            "losses",
            "slip",
            "solved",
        )
        self.steps = SimpleNamespace(**{name: np.array(part) for name, part in zip(names, zip(*self._seen))})
        del self._seen, self.solver, self.water, self.newton

    # ---- what follows from the steps ----------------------------------------------------------
    def counter(self, name):
        """Of the solver after every step."""
        return self.steps.counters[:, self.COUNTERS.index(name)]

    def kinetic(self, at="after"):
        """Kinetic energy [J] of the disks, by hand."""
        _, _, _, vx, vy, w = np.moveaxis(getattr(self.steps, at), 1, 0)
        return 0.5 * ((self.mass * (vx**2 + vy**2)).sum(1) + (self.inertia * w**2).sum(1))

    def potential(self, at="after"):
        """−Σ m g·x [J] with the gravity of each step, by hand."""
        x, y, *_ = np.moveaxis(getattr(self.steps, at), 1, 0)
        return -((self.mass * x).sum(1) * self.steps.gravity[:, 0] + (self.mass * y).sum(1) * self.steps.gravity[:, 1])

    def on_walls(self, name):
        """Normal force into a wall and shear force along it in every step [N/m], two arrays: sums over its pieces by
        hand.
        """
        of = [k for k, wall in enumerate(self.wall_of) if wall == name]
        f, (c, s) = self.steps.walls[:, of], self.way[of].T
        return (f[:, :, 0] * s - f[:, :, 1] * c).sum(1), (f[:, :, 0] * c + f[:, :, 1] * s).sum(1)


def run(folder, watched=True, **changes):
    """The small slope until it rests, in this process: a namespace with ``folder``, ``section``, ``state``, ``series``,
    ``summary``, ``watch``.

    ``changes``: fields of experiment.Experiment.
    """
    import pytest

    folder.mkdir(parents=True)

    chosen = section.load(str(SMALL))
    built = slope.build(chosen, slope_packing.of(chosen))
    with pytest.MonkeyPatch.context() as patch:
        watch = Watch(built, folder.parent) if watched else None
        if watched:
            watch.begin(patch)
        run = experiment.Experiment(built, folder, progress=watch.row if watched else None, **changes)
        run.run()
        if watched:
            watch.end()
    solver = built.solver
    state = asdict(run.state) | {"overlap_worst_ever": solver.overlapWorstEver, "way_worst_ever": solver.wayWorstEver}
    summary = results.summarise(folder, chosen, state, threads=2)
    O.reset()
    return SimpleNamespace(
        folder=folder,
        section=chosen,
        state=state,
        series=records.read_series(folder / "series.csv"),
        summary=summary,
        watch=watch,
    )
