"""Which snapshots a run keeps: those of its characteristic times are there to the row, whatever comes, and little else.
Made-up courses, by the rules of course.py. Needs no YADE.
"""

from dataclasses import asdict

import numpy as np
import pytest

import synthetic_slope as synthetic

characteristic_times, course, frames, scales, section = (
    synthetic.load(name)
    for name in ("measure.characteristic_times", "course", "studies.slope.frames", "model.scales", "model.section")
)
SHIPPED = section.load("jiufengershan")
SCALE = scales.of(SHIPPED)
STEP = 0.01  # s


def story(seed, backstop=True, dry=False):
    """A made-up run: its rows (mappings) and the states after them. It settles in 2 s, rests and gets wet; it stirs,
    mostly stops again, gets going at last and rests. ``dry``: it fails by its weight, or while it has not stood yet."""
    chance = np.random.default_rng(seed)
    speeds = [*chance.uniform(0.006, 0.5, 18), *[0.004] * 5, *chance.uniform(0.0, 0.03 if dry else 0.019, 40)]
    if dry:
        speeds = [*chance.uniform(0.1, 3.0 if seed % 2 else 1.0, 15), *chance.uniform(0.05, 0.3, 30)]
    for _ in range(chance.integers(0, 3)):  # it stirs and stops
        speeds += [*np.geomspace(0.01, chance.uniform(0.1, 1.9), 12), *np.geomspace(0.5, 0.005, 10), *[0.003] * 4]
    speeds += [*np.geomspace(0.004, 3.0, 25), *(3 + 7 * chance.random(40)), *np.geomspace(9, 0.01, 40), *[0.01] * 20]
    speeds = np.array(speeds) * chance.uniform(0.8, 1.25, len(speeds))
    count = len(speeds)
    push = np.cumsum(chance.uniform(-0.4, 1.0, count)) + 100
    push *= 1 + 0.02 * chance.standard_normal(count)
    moving = np.maximum.accumulate(speeds > 2.5)
    push = np.where(moving, push * chance.uniform(0.5, 2.0, count), push)
    shear = np.where(moving, chance.uniform(-0.1, 0.4, count), chance.uniform(0.8, 1.2, count))
    weakened = np.maximum.accumulate(
        np.where((speeds > 1) & (chance.random(count) < 0.2), chance.integers(0, 30, count), 0)
    )
    rows, states, state = [], [], course.State()
    for k in range(count):
        time, water = 0.1 * (k + 1), 0.0 if state.t0 is None else 0.1 * k
        seen = course.Seen(time, STEP, float(speeds[k]), water)
        state = course.noted(state, seen, SCALE)
        rows.append(
            {
                "step": 10 * (k + 1),
                "time_s": time,
                "stage": course.STAGES.index(state.stage),
                "fb_normal_N_per_m": float(push[k]) if backstop else 0.0,
                "dp_shear_N_per_m": float(shear[k]),
                "weakened_disks": int(weakened[k]),
                "speed_mean_m_per_s": float(speeds[k]),
                "energy_kinetic_J": float(speeds[k] ** 2 * chance.uniform(0.7, 1.3)),
            }
        )
        regular = course.keeps_frame(state, k + 1)
        state = course.after(state, seen, QUICK, SCALE)
        states.append((regular, asdict(state)))
        if state.stage == "done":
            break
    return rows, states


def quick(made):
    """The same with short stages."""
    from dataclasses import replace

    stages = replace(
        made.stages,
        settle=replace(made.stages.settle, ramp=1.0, time_max=2.0),
        dry=1.0,
        end=replace(made.stages.end, time=60.0, rest_hold=1.0),
    )
    return replace(made, stages=stages)


QUICK = quick(SHIPPED)
STORIES = [(seed, *kind) for seed in range(8) for kind in ((True, False), (False, False), (True, True))]


def columns(rows):
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def times_at(rows, state):
    """t1 to t5 by the rows so far."""
    found = characteristic_times.of_run(characteristic_times.chosen_rows(columns(rows), state), QUICK, state)
    return {name: time for name, time in found.items() if name != "t0" and time is not None}


def wanted_at(rows, state):
    return {rows[k]["time_s"] for k in characteristic_times.kept_rows(columns(rows), QUICK, state)}


def test_the_made_up_courses_are_of_all_kinds():
    """They stop and go, fail dry before and after t0, with and without each of the times."""
    kinds = set()
    for one in STORIES:
        rows, states = story(*one)
        final, moved = states[-1][1], [state["moving"] for _, state in states]
        found = times_at(rows, final)
        kinds |= {"failed dry"} if final["failed_dry"] is not None else {"by water"}
        kinds |= (
            {"failed late"}
            if final["failed_dry"] is not None and final["t0"] is not None and final["failed_dry"] > final["t0"]
            else set()
        )
        kinds |= {"stopped"} if any(a is not None and b is None for a, b in zip(moved, moved[1:])) else set()
        kinds |= {"whole"} if len(found) == 5 else {"no t3"} if "t3" not in found else set()
    assert kinds == {"failed dry", "failed late", "by water", "stopped", "whole", "no t3"}


@pytest.mark.parametrize("seed, backstop, dry", STORIES[::2])
def test_what_becomes_a_characteristic_time_has_always_been_kept(seed, backstop, dry):
    """At each row the times by the rows so far are among those kept since, and what was given up once does not come
    back.
    """
    rows, states = story(seed, backstop, dry)
    kept, most = None, 0
    for k, (_, state) in enumerate(states):
        wanted = wanted_at(rows[: k + 1], state)
        now = rows[k]["time_s"]
        assert set(times_at(rows[: k + 1], state).values()) <= wanted <= (kept or set()) | {now}, now
        kept, most = wanted, max(most, len(wanted))
    assert most <= 25  # of up to 250: rows within 2 % of the largest force


class Run:
    """A run whose snapshots are files with their step in them."""

    def __init__(self, folder, told):
        self.folder, self.rows, self.states, self.at, self.mark = folder, *told, 0, None
        self.frames = frames.Frames(folder, QUICK)
        self.written = 0

    def go(self, until, checkpoints=()):
        """Up to the row before number ``until``, with checkpoints after some."""
        while self.at < until:
            regular, state = self.states[self.at]
            row = self.rows[self.at]
            if self.frames.takes(row, regular, state):
                self.frames.path(row["step"]).parent.mkdir(exist_ok=True)
                self.frames.path(row["step"]).write_text(str(row["step"]))
                self.written += 1
            self.frames.tidy()
            self.at += 1
            if self.at in checkpoints:
                self.mark = self.at
                self.frames.saved()

    def resume(self):
        """From the last checkpoint, as a process that does not know what came after."""
        self.at = self.mark
        for path in self.folder.glob("snapshots/*.npz"):  # see run_files.forget_later
            if int(path.stem) > self.rows[self.at - 1]["step"]:
                path.unlink()
        self.frames = frames.Frames(self.folder, QUICK, columns(self.rows[: self.at]), self.states[self.at - 1][1])

    def steps(self):
        return sorted(int(path.stem) for path in self.folder.glob("snapshots/*.npz"))


@pytest.mark.parametrize("seed, backstop, dry", STORIES[:4])
def test_snapshots_are_of_equal_distances_and_of_what_is_wanted(tmp_path, seed, backstop, dry):
    rows, states = story(seed, backstop, dry)
    run = Run(tmp_path, (rows, states))
    for k in sorted({*range(1, len(rows), 5), len(rows)}):
        run.go(k)
        regular = {row["step"] for row, (is_regular, _) in zip(rows[:k], states) if is_regular}
        extra = {row["step"] for row in rows[:k] if row["time_s"] in wanted_at(rows[:k], states[k - 1][1])}
        assert run.steps() == sorted(regular | extra)
    series = columns(rows)
    shots = frames.of_run(tmp_path, series)
    even = frames.regular(shots, series, QUICK, states[-1][1]["failed_dry"])
    assert sorted(int(path.stem) for _, path in even) == sorted(regular)
    found = times_at(rows, states[-1][1])
    for time in found.values():  # to the row
        assert int(frames.nearest(shots, time).stem) == next(row["step"] for row in rows if row["time_s"] == time)


@pytest.mark.parametrize("seed, backstop, dry", STORIES[:4])
def test_a_killed_run_that_is_resumed_has_the_same_files(tmp_path, seed, backstop, dry):
    """Killed some rows after a checkpoint, again and again; wherever the second run ends with a checkpoint, its files
    are those of one that was never killed.
    """
    told = story(seed, backstop, dry)
    count = len(told[0])
    for first in range(20 + seed, count - 8, 31):
        for rows in (1, 8):
            unbroken, killed = (Run(tmp_path / f"{name}-{first}-{rows}", told) for name in ("whole", "killed"))
            for one in (unbroken, killed):
                one.folder.mkdir()
            killed.go(first + 8, {first})
            killed.resume()
            assert killed.at == first
            for one in (unbroken, killed):
                one.go(first + rows, {first, first + rows})
            assert killed.steps() == unbroken.steps(), first


def test_a_checkpoint_that_was_written_and_not_cleaned_up_after(tmp_path):
    """Killed between the two: what is idle goes on the resume."""
    told = story(3)
    run = Run(tmp_path, told)
    run.go(100, {60})
    left = set(run.steps())
    run.mark = 100  # the file was written
    run.resume()
    kept = set(run.steps())
    whole = Run(tmp_path / "whole", told)
    whole.folder.mkdir()
    whole.go(100, {100})
    assert kept == set(whole.steps()) and left > kept


def test_rows_of_regular_snapshots_are_told_from_times():
    """Rows end up to half a step from their whole multiples."""
    times = np.array([0.1, 0.499, 0.5, 0.95, 1.004, 1.5, 1.995])
    series = {"time_s": times, "stage": np.array([0, 0, 0, 1, 1, 2, 2])}
    assert frames.regular_rows(series, QUICK, None).tolist() == [False, False, False, False, True, True, True]
    assert frames.regular_rows(series, QUICK, 0.45).tolist() == [False, True, True, False, True, True, True]
