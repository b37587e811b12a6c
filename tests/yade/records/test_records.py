"""Series and snapshots: exact, never half-written, clear about what is wrong. Needs no YADE."""

import math
import os
import resource
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

records = synthetic.load("records")
RecordsError = records.RecordsError
count, Column, declared = (getattr(records.columns, name) for name in ("count", "Column", "declared"))
COLUMNS = declared(
    count("step", ""), *(Column(name) for name in ("time_s", "residual")), count("contacts", ""), Column("extra")
)


def row(step):
    return {"step": step, "time_s": step * 0.1, "residual": 1e-5 / (step + 3), "contacts": 7 * step, "extra": step / 7}


def fill(path, steps, **options):
    with records.SeriesWriter(path, COLUMNS, **options) as writer:
        for step in steps:
            writer.write(row(step))
    return path


def test_numbers_come_back_bit_for_bit(tmp_path):
    values = np.array([0.1 + 0.2, 1 / 3, 5e-324, -1.7976931348623157e308, 2.0**60 + 2.0**9, -0.0])
    with records.SeriesWriter(tmp_path / "series.csv", ("step", "time_s", "contacts")) as writer:
        for k, value in enumerate(values):
            writer.write({"step": k, "time_s": value, "contacts": np.int32(k)})
    series = records.read_series(tmp_path / "series.csv")
    assert series["time_s"].tobytes() == values.tobytes()
    assert series["contacts"].dtype == np.int64 and series["contacts"].tolist() == list(range(len(values)))


def test_a_float_column_stays_float_when_given_whole_numbers(tmp_path):
    with records.SeriesWriter(tmp_path / "s.csv", declared(count("step", ""), Column("time_s"))) as writer:
        writer.write({"step": 0, "time_s": 0})
    assert (tmp_path / "s.csv").read_text() == "step,time_s\n0,0.0\n"
    assert records.read_series(tmp_path / "s.csv")["time_s"].dtype == np.float64


def test_rows_are_on_file_at_once(tmp_path):
    writer = records.SeriesWriter(tmp_path / "s.csv", COLUMNS)
    writer.write(row(0))
    assert len(records.read_series(tmp_path / "s.csv")["step"]) == 1  # not closed, not synced
    writer.close()


def test_a_killed_process_loses_no_row(tmp_path):
    pid = os.fork()
    if pid == 0:
        writer = records.SeriesWriter(tmp_path / "s.csv", COLUMNS)
        for step in range(50):
            writer.write(row(step))
        os.kill(os.getpid(), 9)
    os.waitpid(pid, 0)
    assert records.read_series(tmp_path / "s.csv")["step"].tolist() == list(range(50))


@pytest.mark.parametrize("tail", [b"", b"70,7.0,1e", b"70,7.0,1e-6,490,10."])
def test_a_resumed_series_has_the_bytes_of_an_unbroken_one(tmp_path, tail):
    whole = fill(tmp_path / "whole.csv", range(0, 100, 10)).read_bytes()
    broken = tmp_path / "broken.csv"
    mark = marked(broken, range(0, 50, 10), range(50, 70, 10))
    with open(broken, "ab") as file:
        file.write(tail)
    fill(broken, range(50, 100, 10), resume_from=mark)  # rows 50 and 60 are computed again
    assert broken.read_bytes() == whole


def marked(path, before, after=()):
    """Writes a series and returns its mark between two ranges of steps."""
    with records.SeriesWriter(path, COLUMNS) as writer:
        for step in before:
            writer.write(row(step))
        mark = writer.mark()
        for step in after:
            writer.write(row(step))
    return mark


@pytest.mark.parametrize("rows", [0, 5])
def test_resume_at_the_last_row_keeps_all(tmp_path, rows):
    path = tmp_path / "s.csv"
    mark = marked(path, range(rows))
    before = path.read_bytes()
    with records.SeriesWriter(path, COLUMNS, resume_from=mark) as writer:
        assert writer.last_step == (rows - 1 if rows else None) and writer.mark() == mark
    assert path.read_bytes() == before


def test_a_resumed_series_has_the_mark_of_an_unbroken_one(tmp_path):
    mark = marked(tmp_path / "s.csv", range(5), range(5, 9))
    with records.SeriesWriter(tmp_path / "s.csv", COLUMNS, resume_from=mark) as writer:
        for step in range(5, 12):
            writer.write(row(step))
        assert writer.mark() == marked(tmp_path / "whole.csv", range(12))


@pytest.mark.parametrize("place", [0, 3, 60, 150, -1])
def test_one_flipped_bit_in_the_part_that_is_kept_is_refused_and_nothing_is_lost(tmp_path, place):
    path = tmp_path / "s.csv"
    mark = marked(path, range(5), range(5, 9))
    data = bytearray(path.read_bytes())
    data[place if place >= 0 else mark["bytes"] - 1] ^= 4
    path.write_bytes(data)
    with pytest.raises(RecordsError, match="s.csv.*does not match the checkpoint"):
        records.SeriesWriter(path, COLUMNS, resume_from=mark)
    assert path.read_bytes() == data
    data[place if place >= 0 else mark["bytes"] - 1] ^= 4
    data[mark["bytes"] + 3] ^= 4  # a row that is computed again
    path.write_bytes(data)
    records.SeriesWriter(path, COLUMNS, resume_from=mark).close()


def test_a_series_that_has_become_shorter_is_refused(tmp_path):
    mark = marked(tmp_path / "s.csv", range(5))
    (tmp_path / "s.csv").write_bytes((tmp_path / "s.csv").read_bytes()[:-1])
    with pytest.raises(RecordsError, match=f"has {mark['bytes'] - 1} bytes of the {mark['bytes']} it had then"):
        records.SeriesWriter(tmp_path / "s.csv", COLUMNS, resume_from=mark)


def test_reading_leaves_out_a_half_written_row(tmp_path):
    path = fill(tmp_path / "s.csv", range(3))
    path.write_bytes(path.read_bytes()[:-4])
    assert records.read_series(path)["step"].tolist() == [0, 1]


def test_an_earlier_run_is_not_overwritten_unasked(tmp_path):
    path = fill(tmp_path / "s.csv", range(3))
    before = path.read_bytes()
    with pytest.raises(RecordsError, match="earlier run"):
        records.SeriesWriter(path, COLUMNS)
    assert path.read_bytes() == before
    fill(path, range(1), overwrite=True)
    assert len(records.read_series(path)["step"]) == 1


@pytest.mark.parametrize(
    "change, message",
    [
        ({"residual": float("nan")}, "residual = nan at step 3"),
        ({"extra": float("inf")}, "extra = inf"),
        ({"contacts": 1.5}, "contacts = 1.5.*whole"),
        ({"step": 2}, "step 2 does not come after 2"),
        ({"unheard": 1}, "unknown.*unheard"),
    ],
)
def test_a_bad_row_is_refused_and_nothing_written(tmp_path, change, message):
    with records.SeriesWriter(tmp_path / "s.csv", COLUMNS) as writer:
        for step in range(3):
            writer.write(row(step))
        before = (tmp_path / "s.csv").read_bytes()
        with pytest.raises(RecordsError, match=message):
            writer.write({**row(3), **change})
        with pytest.raises(RecordsError, match="lacks.*contacts"):
            writer.write({k: v for k, v in row(3).items() if k != "contacts"})
        assert (tmp_path / "s.csv").read_bytes() == before
        writer.write(row(3))


def test_a_row_that_does_not_fit_is_refused_whole(tmp_path):
    """As on a full disk; with room again the run goes on."""
    with records.SeriesWriter(tmp_path / "s.csv", COLUMNS) as writer:
        writer.write(row(0))
        before, mark, limits = (
            (tmp_path / "s.csv").read_bytes(),
            writer.mark(),
            resource.getrlimit(resource.RLIMIT_FSIZE),
        )
        resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) + 5, limits[1]))
        try:
            with pytest.raises(RecordsError, match="a row could not be written.*free some space"):
                writer.write(row(1))
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert (tmp_path / "s.csv").read_bytes() == before and writer.mark() == mark
        writer.write(row(1))
    assert (tmp_path / "s.csv").read_bytes() == fill(tmp_path / "whole.csv", range(2)).read_bytes()


def test_messages_name_the_file_and_the_remedy(tmp_path):
    with pytest.raises(RecordsError, match="nowhere.*cannot be written.*writable"):
        records.SeriesWriter(tmp_path / "nowhere" / "s.csv", COLUMNS)
    with pytest.raises(RecordsError, match="missing.*without --resume"):
        records.SeriesWriter(tmp_path / "s.csv", COLUMNS, resume_from={"bytes": 40, "sha256": "", "last_step": 0})
    with pytest.raises(RecordsError, match="cannot be read"):
        records.read_series(tmp_path / "s.csv")
    path = tmp_path / "s.csv"
    mark = marked(path, range(3))
    with pytest.raises(RecordsError, match="columns are not those"):
        records.SeriesWriter(path, (*list(COLUMNS)[:-1], "other"), resume_from=mark)
    path.write_text(path.read_text().replace("\n1,", "\n1,?,"))
    with pytest.raises(RecordsError, match="line 3: damaged row"):
        records.read_series(path)
    (tmp_path / "empty.csv").write_text("")
    with pytest.raises(RecordsError, match="no header"):
        records.read_series(tmp_path / "empty.csv")


def test_rows_since_settled_are_those_after_stage_0():
    series = {"step": np.arange(6), "stage": np.array([0, 0, 0, 1, 2, 2]), "x": np.arange(6.0)}
    assert records.since_settled(series)["step"].tolist() == [3, 4, 5] and records.since_settled(series)[
        "x"
    ].tolist() == [3.0, 4.0, 5.0]
    for whole in (
        {**series, "stage": np.zeros(6, int)},
        {"step": np.arange(6)},
    ):  # still settling; of a version without stages
        assert records.since_settled(whole) is whole


def test_all_losses_are_columns():
    """Kinetic and potential energy, what water and walls do, and the correction are none."""
    assert (
        set(records.LOSSES)
        == {f"energy_{name}_J" for name in ("sliding", "rolling", "impact", "bonds")}
        <= set(synthetic.load("studies.slope.columns").COLUMNS)
    )


@pytest.mark.parametrize(
    "module, name",
    [
        ("studies.slope.columns", "COLUMNS"),
        ("studies.slope.columns", "WALL_COLUMNS"),
        ("studies.slope.columns", "ERODING"),
        ("studies.slope.columns", "LEDGER_COLUMNS"),
        ("studies.slope.columns", "SURFACE_COLUMNS"),
        ("studies.slope.columns", "OF_SURFACES"),
        ("studies.laboratory.biaxial_test", "COLUMNS"),
        ("studies.laboratory.tension_test", "COLUMNS"),
        ("studies.laboratory.wall_shear", "COLUMNS"),
        ("studies.heaps.columns", "COLUMNS"),
        ("slip.block", "COLUMNS"),
    ],
)
def test_every_declared_column_is_documented(module, name):
    for name, column in getattr(synthetic.load(module), name).items():
        assert column.name == name and column.unit and column.meaning, name
        for ending, unit in (("_N_per_m", "N/m"), ("_m_per_s", "m/s"), ("_J", "J/m"), ("_rel", "1"), ("_Pa", "Pa")):
            if name.endswith(ending):
                assert column.unit == unit, name


def test_what_is_declared_decides_how_a_number_is_written_and_whether_a_cell_is_empty(tmp_path):
    columns = declared(count("step", ""), Column("name", "-", kind=str), Column("x"), count("n", "", optional=True))
    with records.SeriesWriter(tmp_path / "s.csv", columns) as writer:
        writer.write({"step": 1, "name": "a,b", "x": 2, "n": None})
        with pytest.raises(RecordsError, match="x = None at step 2: give a number"):
            writer.write({"step": 2, "name": "a", "x": None, "n": 1})
        with pytest.raises(RecordsError, match="x = 'a' at step 2: give a number"):
            writer.write({"step": 2, "name": "a", "x": "a", "n": 1})
    assert (tmp_path / "s.csv").read_text() == 'step,name,x,n\n1,"a,b",2.0,\n'


def test_a_column_says_what_it_is():
    columns = synthetic.load("studies.slope.columns").COLUMNS
    assert (columns["step"].integer, columns["time_s"].description) == (True, "simulated time")


# --- snapshots ---------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def arrays():
    return synthetic.snapshot_arrays(800, 30.0)


def test_a_snapshot_comes_back_bit_for_bit_and_equal_ones_have_equal_bytes(tmp_path, arrays):
    first = records.write_snapshot(tmp_path / "a.npz", **arrays)
    second = records.write_snapshot(tmp_path / "b.npz", **arrays)
    assert first.read_bytes() == second.read_bytes()
    snapshot = records.read_snapshot(first)
    for name, value in arrays.items():
        assert np.array_equal(getattr(snapshot, name), value), name
    assert isinstance(snapshot.step, int) and isinstance(snapshot.time_s, float) and snapshot.wet.dtype == bool
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.npz", "b.npz"]  # nothing left beside


def test_a_file_of_an_earlier_version_does_not_tell_who_was_ever_wet_or_is_weakened(tmp_path, arrays):
    old = {name: value for name, value in arrays.items() if name not in ("ever_wet", "weakened")}
    np.savez(tmp_path / "old.npz", **old)
    found = records.read_snapshot(tmp_path / "old.npz")
    assert found.ever_wet is None and found.weakened is None and np.array_equal(found.released, old["released"])
    again = records.read_snapshot(records.write_snapshot(tmp_path / "again.npz", **vars(found)))
    assert again.ever_wet is None and again.weakened is None and np.array_equal(again.x, found.x)


def test_weakened_has_a_column_for_each_wall(tmp_path, arrays):
    count = len(arrays["x"])
    for walls in (0, 1, 3):
        told = np.arange(count * walls).reshape(count, walls) % 2 == 0
        found = records.read_snapshot(records.write_snapshot(tmp_path / "a.npz", **{**arrays, "weakened": told}))
        assert found.weakened.dtype == bool and np.array_equal(found.weakened, told)
    for wrong in (np.zeros(count, bool), np.zeros((count - 1, 2), bool), np.zeros((2, count), bool)):
        with pytest.raises(RecordsError, match="weakened has shape"):
            records.write_snapshot(tmp_path / "b.npz", **{**arrays, "weakened": wrong})


def test_contacts_may_be_left_out(tmp_path):
    records.write_snapshot(tmp_path / "a.npz", **synthetic.snapshot_arrays(300, 30.0, contacts=False))
    assert len(records.read_snapshot(tmp_path / "a.npz").ci) == 0


def test_what_a_study_has_not_is_left_out_and_asked_for_by_what_needs_it(tmp_path):
    disks = dict(time_s=0.5, step=7, x=[0.1, 2.0], y=[0.3, 0.3], r=[0.5, 0.7], walls=[(1, 0.1), (0, 1 / 3)])
    for compact in (False, True):
        found = records.read_snapshot(records.write_snapshot(tmp_path / "a.npz", compact=compact, **disks))
        assert (found.angle, found.vx, found.layer, found.wet, found.water_m, len(found.ci)) == (None,) * 5 + (0,)
        assert np.array_equal(found.walls, disks["walls"]) and found.x.dtype == np.float64
        # single precision is for what a picture shows
        assert np.array_equal(found.x, np.float32(disks["x"]) if compact else disks["x"])
    with pytest.raises(RecordsError, match=r"walls has shape \(2,\); give an axis"):
        records.write_snapshot(tmp_path / "b.npz", **{**disks, "walls": [0.0, 1.0]})
    rule, remedy = synthetic.load("records.snapshots").given_with("layer", "wet")
    assert not rule(found) and "a Snapshot that has layer, wet" in remedy
    assert rule(records.read_snapshot(records.write_snapshot(tmp_path / "c.npz", **disks, layer=[0, 1], wet=[1, 0])))


def test_a_snapshot_tells_which_disks_are_left(tmp_path, arrays):
    number = np.flatnonzero(np.arange(len(arrays["x"])) % 3 > 0)
    disks = {k: v[number] for k, v in arrays.items() if np.shape(v)[:1] == np.shape(arrays["x"]) and k[0] != "c"}
    told = {"time_s": 31.0, "step": 9, "water_m": 1.0, **disks, "number": number}
    left = records.read_snapshot(records.write_snapshot(tmp_path / "a.npz", **told))
    assert left.number.dtype == np.int64 and np.array_equal(left.number, number)
    for wrong in (number[::-1], number - number[0] - 1, number * 0):
        with pytest.raises(RecordsError, match="number does not rise from 0 or more"):
            records.write_snapshot(tmp_path / "b.npz", **told | {"number": wrong})
    whole = records.read_snapshot(records.write_snapshot(tmp_path / "c.npz", **arrays))
    for one, other in (records.in_both(whole, left), reversed(records.in_both(left, whole))):
        assert np.array_equal(one.x, other.x) and np.array_equal(one.x, arrays["x"][number])
        assert np.array_equal(one.weakened, other.weakened) and len(one.ci) == len(other.ci) == 0
        assert (one.time_s, other.time_s) == (whole.time_s, 31.0) and np.array_equal(one.layer, other.layer)
    fewer = left.chosen(left.number % 2 == 0)
    one, other = records.in_both(left, fewer)
    assert np.array_equal(one.number, other.number) and (one.number % 2 == 0).all() and len(one.x) == len(fewer.x)
    assert records.in_both(whole, whole) == (whole, whole)


def test_a_ledger_comes_back_with_its_words_and_whole_numbers(tmp_path):
    columns = synthetic.load("studies.slope.columns").LEDGER_COLUMNS
    rows = [
        {name: 0.1 * k for name in columns} | {"step": 7, "window": "a, b", "layer": "top", "disk": 2**40 - k}
        for k in (0, 1)
    ]
    with records.SeriesWriter(tmp_path / "eroded.csv", columns) as ledger:
        assert len(records.read_eroded(tmp_path / "eroded.csv")["disk"]) == 0
        ledger.write(*rows)
    found = records.read_eroded(tmp_path / "eroded.csv")
    assert list(found) == list(columns) and found["window"].tolist() == ["a, b"] * 2
    assert found["disk"].dtype == found["step"].dtype == np.int64 and found["disk"].tolist() == [2**40, 2**40 - 1]
    assert found["mass_kg_per_m"].tolist() == [0.0, 0.1]
    with open(tmp_path / "eroded.csv", "a") as file:
        file.write("8,0.2,a")  # half-written
    assert len(records.read_eroded(tmp_path / "eroded.csv")["disk"]) == 2
    (tmp_path / "eroded.csv").write_text("step,time_s,window\n1,0.1,a\n")
    with pytest.raises(RecordsError, match="cannot be read as the ledger of disks that were taken out .wrong columns"):
        records.read_eroded(tmp_path / "eroded.csv")
    with pytest.raises(RecordsError, match="No such file"):
        records.read_eroded(tmp_path / "none.csv")


def test_a_refused_snapshot_leaves_the_old_file(tmp_path, arrays):
    path = records.write_snapshot(tmp_path / "a.npz", **arrays)
    before = path.read_bytes()
    bad_x = arrays["x"].copy()
    bad_x[7] = np.nan
    for change, message in (
        ({"x": bad_x}, r"x\[7\] is not a finite"),
        ({"y": arrays["y"][:-1]}, "y has shape"),
        ({"r": -arrays["r"]}, "radius of disk"),
        ({"ci": arrays["ci"] + 10**6}, "beyond"),
        ({"colour": 1}, "unknown.*colour"),
        ({"time_s": [1.0, 2.0]}, "time_s has shape"),
        ({"time_s": "now"}, "time_s holds .* instead of numbers"),
        ({"layer": arrays["layer"] + 0.5}, r"layer\[0\] is .*5, no whole number; give whole numbers"),
        ({"step": 10.5}, "step is 10.5, no whole number"),
        (
            {"cj": np.where(np.arange(len(arrays["ci"])) == 3, arrays["ci"], arrays["cj"])},
            f"contact 3 is of disk {arrays['ci'][3]} with itself; give another disk as cj",
        ),
        ({"cj": arrays["cj"] + 0.25}, r"cj\[0\] is .*no whole number"),
        ({"wet": arrays["wet"] + 0.5}, r"wet\[0\] is .*neither True nor False"),
    ):
        with pytest.raises(RecordsError, match=message):
            records.write_snapshot(path, **{**arrays, **change})
    assert path.read_bytes() == before and len(list(tmp_path.iterdir())) == 1
    whole = {name: arrays[name].astype(float) for name in ("layer", "ci", "cj", "wet")}
    assert records.write_snapshot(path, **{**arrays, **whole, "step": float(arrays["step"])}).read_bytes() == before
    with pytest.raises(synthetic.load("system.whole_files").WriteError, match="a.npz.*cannot be written"):
        records.write_snapshot(path / "a.npz", **arrays)  # a file is no folder


def test_truncated_damaged_or_foreign_snapshots_are_named(tmp_path, arrays):
    data = records.write_snapshot(tmp_path / "a.npz", **arrays).read_bytes()
    bad = tmp_path / "bad.npz"
    for content in (data[: len(data) // 2], data[:10], b"", b"not a snapshot", data[:3000] + b"\0" * 50 + data[3050:]):
        bad.write_bytes(content)
        with pytest.raises(RecordsError, match="bad.npz"):
            records.read_snapshot(bad)
    np.savez(bad, x=arrays["x"])
    with pytest.raises(RecordsError, match="lacks"):
        records.read_snapshot(bad)
    with pytest.raises(RecordsError, match="gone.npz.*cannot be read"):
        records.read_snapshot(tmp_path / "gone.npz")


# ---- rows and breaks that are none ------------------------------------------------------------------
@pytest.mark.parametrize(
    "name, value",
    [("time_s", "a"), ("time_s", None), ("front_m", "a"), ("front_m", None), ("front_m", [1.0]), ("step", "1")],
)
def test_a_row_of_texts_leaves_the_file_as_it_was(tmp_path, name, value):
    row = {"step": 2, "time_s": 2.0, "front_m": 1.0}
    with records.SeriesWriter(tmp_path / "series.csv", tuple(row)) as series:
        series.write({"step": 1, "time_s": 1.0, "front_m": 0.5})
        before = series.path.read_bytes()
        with pytest.raises(records.RecordsError, match=f"{name} = .*: give a number"):
            series.write(row | {name: value})
        assert series.path.read_bytes() == before
        series.write(row)
    assert records.read_series(tmp_path / "series.csv")["front_m"].tolist() == [0.5, 1.0]


BROKEN = {
    "step": [1, 2],
    "time": [0.1, 0.2],
    "id1": [0, 3],
    "id2": [3, 4],
    "mode": [1, 4],
    "x": [0.0, 1.0],
    "y": [0.0, 2.0],
}


@pytest.mark.parametrize(
    "changes, first_disk, said",
    [
        ({"x": [1.0]}, 3, "x has shape"),
        ({"x": [math.nan, 0.0]}, 3, "x .*finite numbers"),
        ({"mode": [0, 1]}, 3, "mode .*from 1, tension, shear, torque, mixed"),
        ({"mode": [1, 9]}, 3, "mode .*from 1"),
        ({"mode": [-1, 1]}, 3, "mode .*from 1"),
        ({"mode": ["shear", "shear"]}, 3, "mode .*whole numbers"),
        ({"id2": [3.5, 4.0]}, 3, "id2 .*whole numbers"),
        ({}, 4, "first_disk 4: a bond broke between bodies 0 and 3"),
        ({}, 1.5, "first_disk 1.5: give"),
        ({}, -3, "first_disk -3: give"),
    ],
)
def test_what_is_no_broken_bond_is_not_written(tmp_path, changes, first_disk, said):
    made = {name: np.array(values) for name, values in (BROKEN | changes).items()}
    with pytest.raises(records.RecordsError, match=said):
        records.write_breaks(tmp_path / "breaks.csv", made, first_disk)
    assert not list(tmp_path.iterdir())


def test_broken_bonds_come_back_with_walls_and_modes(tmp_path):
    records.write_breaks(tmp_path / "breaks.csv", {name: np.array(v) for name, v in BROKEN.items()}, 3)
    found = records.read_breaks(tmp_path / "breaks.csv")
    assert (found["disk1"].tolist(), found["disk2"].tolist(), found["mode"].tolist()) == (
        [-1, 0],
        [0, 1],
        ["tension", "mixed"],
    )
