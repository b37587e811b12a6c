"""Sums that must come out exactly at every step or row of a slope: momentum, angular momentum, energy, bonds; with
rigid disks and with springs.
"""
import math
from dataclasses import replace

import numpy as np
import pytest
from slope_scenes import SMALL
from watched_slope import Watch, Work, solved, sorted_contacts
from yade import O
from yade.nonsmooth import experiment, records, section, tables, worlds
from yade.nonsmooth.studies.slope import slope, slope_packing
from yade.nonsmooth.studies.slope.slope import hard

MODES = ("tension", "shear", "torque", "mixed")


def cross(places, vectors):
    """z component of x × v, over the last axis."""
    return places[..., 0] * vectors[..., 1] - places[..., 1] * vectors[..., 0]


# ---- rigid disks ----------------------------------------------------------------------------------


def test_forces_of_walls_water_and_weight_are_the_change_of_momentum(whole):
    w, s = whole.watch, whole.watch.steps
    gained = np.einsum("d,kad->ka", w.mass, s.after[:, 3:5] - s.before[:, 3:5])
    given = s.dt[:, None] * (w.mass.sum() * s.gravity + s.water - s.walls[:, :, :2].sum(axis=1))
    # rounding; the solver's tolerance does not come into it
    assert np.abs(gained - given).max() < 1e-9 * w.mass.sum() * 9.81 * 5e-3
    assert np.abs(s.water).max() > 0.05 * w.mass.sum() * 9.81  # the water was there


def test_rows_of_the_series_and_snapshots_balance_by_themselves(whole):
    """Means of the forces on three straight walls, times the seconds of their rows, against the velocities of two
    snapshots.
    """
    series, shots = whole.series, [records.read_snapshot(p) for p in sorted((whole.folder / "snapshots").glob("*.npz"))]
    mass = 2500 * math.pi * shots[0].r ** 2
    weight, worst, largest = mass.sum() * 9.81, 0.0, 0.0
    for one, other in zip(shots, shots[1:]):
        rows = np.flatnonzero((series["step"] > one.step) & (series["step"] <= other.step))
        assert 1 <= len(rows) <= 5  # one in five, and those of the characteristic times
        seconds = np.diff(series["time_s"][[rows[0] - 1, *rows]])
        given, normal = np.array([0.0, -weight * seconds.sum()]), np.array(whole.section.normal)
        lift = series["dp_water_N_per_m"]
        given += normal * (lift[rows] * seconds).sum()
        for name in ("DP", "FB", "SS"):
            (x0, y0), (x1, y1) = whole.section.wall(name).vertices
            along = np.array([x1 - x0, y1 - y0]) / math.hypot(x1 - x0, y1 - y0)
            column = {
                k: series[f"{name.lower()}_{k}_N_per_m"]
                for k in ("normal_effective" if name == "DP" else "normal", "shear")
            }
            push, drag = ((values[rows] * seconds).sum() for values in column.values())
            given -= push * np.array([along[1], -along[0]]) + drag * along
        gained = np.array([(mass * (getattr(other, v) - getattr(one, v))).sum() for v in ("vx", "vy")])
        # the water's force is that of the row's last step: it may have changed by so much since the row before, and
        # where it changes, a disk at the table may have been wet or dry in between
        changes = np.abs(np.diff(lift[[rows[0] - 1, *rows]]))
        allowed = 1e-9 * weight + ((changes + (changes > 0) * 9810 * mass.max() / 2500) * seconds).sum()
        worst, largest = max(worst, np.abs(gained - given).max() - allowed), max(largest, np.abs(gained).max())
    assert worst <= 0 and largest > 0.01 * weight  # N s in a tenth of a second: the slope sped up by 1 m/s² and more


@pytest.fixture(scope="module")
def steps(tmp_path_factory):
    """The small slope with nothing taken back of errors of position, for some steps while it gets wet: a function that
    makes one and returns what it did.
    """
    chosen = section.load(str(SMALL))
    O.reset()
    world = hard(chosen)
    built = slope.build(
        chosen, slope_packing.of(chosen), replace(world, options={**world.options, "relaxationRate": 0.0})
    )
    solver, first = built.solver, built.first_disk
    experiment.advance()
    solver.bond()
    built.water.times, built.water.heights = [0.0, 0.5], [0.0, 3.0]
    t = tables.bodies(solver)
    mass = np.array([O.bodies[int(i)].state.mass for i in t["id"]])
    inertia = 0.5 * mass * t["r"] ** 2
    pieces = [i for ids in built.walls.values() for i in ids]
    places = np.array([tuple(O.bodies[i].state.pos)[:2] for i in pieces])

    def bodies():
        return np.array([tables.bodies(solver)[name] for name in ("x", "y", "vx", "vy", "omega")])

    dump = tmp_path_factory.mktemp("steps") / "step.h5"

    def done(before, after):
        return work.of(sorted_contacts(solver), before, solved(solver, after, first, dump), 5e-3)

    experiment.advance(59)
    work, before = Work(first, t["r"]), bodies()
    experiment.advance()
    done(before, bodies())  # what opens in it
    found = []
    solver.forgetEnergies()
    for _ in range(60):
        before = bodies()
        experiment.advance()
        after = bodies()
        on_walls = np.array([(*tuple(O.forces.f(i))[:2], O.forces.t(i)[2]) for i in pieces])
        wet, *_ = tables.water(built.water, first, built.count)
        lift = (
            wet[:, None]
            * math.pi
            * (t["r"] ** 2)[:, None]
            / 0.82
            * 9810
            * math.cos(math.radians(chosen.dip))
            * np.array(chosen.normal)
        )
        counters = np.array([getattr(solver, name) for name in Watch.COUNTERS[:7]])
        found.append((before, after, on_walls, lift, counters, done(before, after)))
    O.reset()
    return found, mass, inertia, places


GRAVITY = np.array([0, -9.81])


def test_moments_about_a_point_are_the_change_of_angular_momentum(steps):
    """About the origin and about a point far away; places are those at the begin of the step, where the contacts were
    looked at.
    """
    found, mass, inertia, walls = steps
    h, turned = 5e-3, 0.0
    for about in (np.zeros(2), np.array([-500.0, 300.0])):
        for before, after, on_walls, lift, _, _ in found:
            x, change = before[:2].T - about, (after - before)[2:4].T
            gained = (mass * cross(x, change)).sum() + (inertia * (after - before)[4]).sum()
            given = h * (
                cross(x, mass[:, None] * GRAVITY + lift).sum()
                - cross(walls - about, on_walls[:, :2]).sum()
                - on_walls[:, 2].sum()
            )
            size = h * 9.81 * (mass * np.abs(x).sum(axis=1)).sum()
            assert abs(gained - given) < 1e-9 * size  # rounding: the moments of the weights cancel
            turned = max(turned, abs(gained) / size)
    assert turned > 1e-6  # something turned


def test_losses_are_the_work_that_does_not_become_motion(steps):
    """In each step, where no error of position is taken back: weight and water work by the mean velocity, and what is
    not kinetic energy then is a loss, or what tension does in bonds that hold, as far as the solve is off."""
    found, mass, inertia, _ = steps
    last, lost = np.zeros(7), 0.0
    for before, after, _, lift, counters, _ in found:
        energy = [0.5 * ((mass * (b[2] ** 2 + b[3] ** 2)).sum() + (inertia * b[4] ** 2).sum()) for b in (before, after)]
        mean = 0.5 * (before + after)[2:4].T
        work = 5e-3 * ((mass[:, None] * GRAVITY + lift) * mean).sum()
        losses, (water, walls, correction) = (counters - last)[:4].sum(), (counters - last)[4:]
        scale = 5e-3 * 9.81 * (mass * np.abs(mean).sum(axis=1)).sum()
        assert losses - correction == pytest.approx(work - energy[1] + energy[0], abs=1e-9 * scale)  # rounding
        assert water == pytest.approx(5e-3 * (lift * mean).sum(), abs=1e-9 * scale) and walls == 0
        last, lost = counters, lost + losses
    assert lost > 0


def test_each_loss_is_the_work_of_its_own_impulses(steps):
    """Normal, tangential and rolling impulses of all contacts times the mean of the relative velocities before and
    after the step.
    """
    last = np.zeros(7)
    for *_, counters, (losses, held, _) in steps[0]:
        wanted = np.array([*(losses[k] for k in (0, 1, 3, 2)), held])
        done = (counters - last)[[0, 1, 2, 3, 6]]
        # rounding, of forces from impulses and of sums; turning disks as one is counted with what tension does
        assert (np.abs(done - wanted) < np.array([1e-8] * 4 + [1e-6]) * np.abs(wanted).sum()).all()
        last = counters
    assert last[6] != 0 and abs(last[6]) < 0.02 * last[:4].sum()  # the solve's tolerance


# ---- bonds ----------------------------------------------------------------------------------------


def bonds_add_up(series, breaks, made, begun):
    """Bonds that hold and broken ones are the bonds made at every row, and the list of breaks has those of each mode;
    ``begun``: steps of a break's number that are counted in a row of that number, 0 or 1."""
    broken = {mode: series[f"bonds_broken_{mode}"] for mode in MODES}
    assert (series["bonds_alive"] + sum(broken.values()) == made).all()
    for mode, counts in broken.items():
        listed = breaks["step"][breaks["mode"] == mode]
        assert [int((listed < step + begun).sum()) for step in series["step"]] == counts.tolist(), mode
    assert len(breaks["step"]) == made - series["bonds_alive"][-1] > 0
    assert len({*zip(breaks["disk1"].tolist(), breaks["disk2"].tolist())}) == len(breaks["step"])  # each breaks once


def test_bonds_that_hold_and_broken_ones_are_those_made(whole):
    # rigid disks: the number of steps before the one in which it broke
    bonds_add_up(whole.series, records.read_breaks(whole.folder / "breaks.csv"), whole.summary["bonds_initial"], 0)


def test_breaks_are_where_and_when_bonds_were_lost(whole):
    """From row to row exactly the pairs of the list lose their bond, in the steps between, at a place between their
    centres.
    """
    watch, breaks = whole.watch, records.read_breaks(whole.folder / "breaks.csv")
    bonded = [{(int(a), int(b)) for a, b, *_, held in rows[:, :9] if held} for rows in watch.rows]
    for k, (before, after) in enumerate(zip(bonded, bonded[1:])):
        between = (breaks["step"] >= whole.series["step"][k]) & (breaks["step"] < whole.series["step"][k + 1])
        listed = {*zip(breaks["disk1"][between].tolist(), breaks["disk2"][between].tolist())}
        lost = {(max(a - watch.first, -1), b - watch.first) for a, b in before - after}
        assert lost == listed and not after - before
    at = np.searchsorted(watch.steps.iter, breaks["step"] + 1)
    two = breaks["disk2"]
    x, y = watch.steps.before[at, 0, two], watch.steps.before[at, 1, two]
    assert (
        np.hypot(breaks["x_m"] - x, breaks["y_m"] - y) < 1.2 * watch.r[two]
    ).all()  # at the rim of the second disk, but for a gap
    assert np.allclose(breaks["time_s"], (watch.steps.time - watch.steps.dt)[at], atol=1e-9)  # the step's begin


# ---- springs --------------------------------------------------------------------------------------

SOFT = dict(stiffness=2e7, diameter=(0.5, 1.0))


@pytest.fixture(scope="module")
def soft_run(tmp_path_factory):
    """The small slope of springs while it settles, gets wet and fails: its series, its breaks, and what it held."""
    folder, chosen = tmp_path_factory.mktemp("soft"), section.load(str(SMALL))
    O.reset()
    run = experiment.begin(chosen, folder, world=worlds.Soft(**SOFT))
    run.run(end=3.0)
    made = run.state.bonds_initial
    O.reset()
    return records.read_series(folder / "series.csv"), records.read_breaks(folder / "breaks.csv"), made


def test_soft_bonds_that_hold_and_broken_ones_are_those_made(soft_run):
    bonds_add_up(*soft_run, 1)  # springs: of steps made when it was noticed


@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_soft_forces_cancel_and_move_the_disks(damping):
    """Forces on disks and walls add up to the water's, moments too; each disk's change of momentum is its force, damped
    as YADE does it, weight included.
    """
    chosen = section.load(str(SMALL))
    O.reset()
    built = slope.build(chosen, slope_packing.of(chosen), worlds.Soft(**SOFT, damping=damping))
    built.solver.bond()
    built.water.times, built.water.heights = [0.0], [2.0]
    experiment.advance(300)
    ids, r = tables.bodies(built.solver)["id"], tables.bodies(built.solver)["r"]
    mass = np.array([O.bodies[int(i)].state.mass for i in ids])
    pieces = [i for ids_ in built.walls.values() for i in ids_]
    h, n = O.dt, np.array(chosen.normal)
    for _ in range(20):
        before = tables.bodies(built.solver)
        experiment.advance()
        after = tables.bodies(built.solver)
        f, on_walls = (
            np.array([(*tuple(O.forces.f(int(i)))[:2], O.forces.t(int(i))[2]) for i in which])
            for which in (ids, pieces)
        )
        wet, *_ = tables.water(built.water, built.first_disk, built.count)
        lift = wet[:, None] * math.pi * (r**2)[:, None] / 0.82 * 9810 * math.cos(math.radians(chosen.dip)) * n
        size = np.abs(f[:, :2]).sum()
        # actio est reactio, to rounding
        assert np.abs(f[:, :2].sum(0) + on_walls[:, :2].sum(0) - lift.sum(0)).max() < 1e-9 * size
        places, walls = np.c_[before["x"], before["y"]], np.array([tuple(O.bodies[i].state.pos)[:2] for i in pieces])
        moment = (
            cross(places, f[:, :2]).sum()
            + f[:, 2].sum()
            + cross(walls, on_walls[:, :2]).sum()
            + on_walls[:, 2].sum()
            - cross(places, lift).sum()
        )
        assert abs(moment) < 1e-9 * size * 40  # the same, at places of some 40 m
        v0, v1 = (np.c_[t["vx"], t["vy"]] for t in (before, after))
        a = f[:, :2] / mass[:, None] + GRAVITY
        a *= 1 - damping * np.sign(a * (v0 + 0.5 * h * a))
        assert np.abs(v1 - v0 - h * a).max() < 1e-9 * h * 9.81 * 10  # rounding
    assert wet.sum() > 50
    O.reset()
