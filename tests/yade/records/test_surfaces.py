"""Cells along walls as arrays, from slip_surface.csv and slip_surface.h5; where they lie on walls. Needs no YADE."""

import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

records, places = synthetic.load("records"), synthetic.load("slip.cell_places")
COLUMNS = synthetic.load("studies.slope.columns").SURFACE_COLUMNS
WALLS = {"a/b %": 3, ".": 2}  # names that a group of HDF5 cannot have
TIMES = (0.1, 0.2, 0.3, 0.4)


def value(column, wall, time, cell):
    """A number that no other place has; of ``.`` there is no heat, and melt nowhere."""
    if column == "melt_m" or (wall == "." and column in ("temperature_degC", "hottest_degC", "pressure_Pa", "vapour")):
        return None
    where = 0.0 if column in ("x_m", "y_m", "length_m") else time
    return (1 + list(COLUMNS).index(column)) / 3 + 100 * cell + where + 1000 * len(wall)


def written(path, times=TIMES):
    with records.SeriesWriter(path, COLUMNS) as file:
        for step, time in enumerate(times, 1):
            file.write(
                *(
                    {name: value(name, wall, time, cell) for name in COLUMNS}
                    | {"step": 10 * step, "time_s": time, "wall": wall, "cell": cell}
                    for wall, count in WALLS.items()
                    for cell in range(count)
                )
            )
    return path


def same(one, other):
    assert list(one) == list(other)
    for wall in one:
        assert sorted(one[wall]) == sorted(other[wall])
        for name, values in one[wall].items():
            assert values.dtype == other[wall][name].dtype and np.array_equal(values, other[wall][name]), name


def test_arrays_are_the_rows_by_walls_times_and_cells(tmp_path):
    found = records.read_surface_arrays(written(tmp_path / "slip_surface.csv"))
    assert list(found) == list(WALLS)
    for wall, count in WALLS.items():
        one = found[wall]
        assert one["step"].tolist() == [10, 20, 30, 40] and one["time_s"].tolist() == list(TIMES)
        known = [name for name in COLUMNS if name not in ("wall", "cell", "step", "time_s")]
        known = [name for name in known if value(name, wall, 0.1, 0) is not None]
        assert set(one) == {"step", "time_s", *known}
        for name in known:
            expected = [[value(name, wall, time, cell) for cell in range(count)] for time in TIMES]
            assert one[name].tolist() == (expected[0] if name in ("x_m", "y_m", "length_m") else expected), name
    assert "vapour" in found["a/b %"] and not {"vapour", "temperature_degC"} & set(found["."])


def test_the_hdf5_file_has_the_same_arrays_with_units_and_meanings(tmp_path):
    found = records.read_surface_arrays(written(tmp_path / "slip_surface.csv"))
    path = records.write_surface_arrays(found, tmp_path / "slip_surface.h5", COLUMNS)
    same(records.read_surface_arrays(path), dict(sorted(found.items())))
    with h5py.File(path, "r") as file:
        assert list(file) == ["%2E", "a%2Fb %25"]
        group = file["a%2Fb %25"]
        assert group["hottest_degC"].shape == (4, 3) and group["x_m"].shape == (3,) and group["step"].shape == (4,)
        for name, dataset in group.items():
            assert dict(dataset.attrs) == {"unit": COLUMNS[name].unit, "meaning": COLUMNS[name].meaning}
        assert group["hottest_degC"].attrs["unit"] == "°C"
    again = records.write_surface_arrays(found, tmp_path / "again.h5", COLUMNS)
    assert again.read_bytes() == path.read_bytes()


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path):
    (tmp_path / "folder.h5").mkdir()
    with pytest.raises(OSError, match="folder.h5: cannot be written"):
        records.write_surface_arrays({}, tmp_path / "folder.h5", COLUMNS)
    found = records.read_surface_arrays(written(tmp_path / "slip_surface.csv"))
    with pytest.raises(KeyError):  # of a column that nobody declared
        records.write_surface_arrays(found, tmp_path / "half.h5", {"step": COLUMNS["step"]})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.h5", "slip_surface.csv"]


def test_what_a_killed_run_left_of_its_last_time_is_left_out(tmp_path):
    path = written(tmp_path / "slip_surface.csv")
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:-3]))  # without the second wall, and the last cell of the first
    found = records.read_surface_arrays(path)
    assert [len(one["time_s"]) for one in found.values()] == [3, 3]
    assert found["a/b %"]["slip_m"][-1, -1] == value("slip_m", "a/b %", 0.3, 2)


@pytest.mark.parametrize("lost, wall", [(1, "a/b %"), (2, "a/b %"), (9, ".")])
def test_a_wall_whose_cells_change_is_refused(tmp_path, lost, wall):
    path = written(tmp_path / "slip_surface.csv")
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:lost] + lines[lost + 1 :]))
    with pytest.raises(records.RecordsError, match=f"the wall {wall} has not the same cells at all times"):
        records.read_surface_arrays(path)


def test_files_that_are_none(tmp_path):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["pressure"] = [1.0]
    (tmp_path / "text.h5").write_text("time_s")
    for name in ("other.h5", "text.h5", "none.h5"):
        with pytest.raises(records.RecordsError, match=f"{name}: cannot be read as the cells of walls with slip laws"):
            records.read_surface_arrays(tmp_path / name)
    with pytest.raises(records.RecordsError, match="none.csv: cannot be read as the cells of walls"):
        records.read_surface_arrays(tmp_path / "none.csv")


def test_what_came_before_slip_was_set_back_can_be_left_out():
    """That of the wall a at the third time, that of b at the second."""

    def of(slip):
        slip = np.array(slip, float)
        times = np.arange(len(slip)) + 0.5
        return {"time_s": times, "x_m": np.array([3.0, 4.0]), "slip_m": slip, "friction": 0.5 - 0.01 * slip}

    rising = of([[0, 1], [1, 2], [2, 2], [3, 2]])
    set_back = {"a": of([[0, 1], [1, 2], [1, 0], [2, 1]]), "b": of([[0, 1], [0, 0], [0, 2], [2, 3]])}
    found = records.since_set_back(set_back)
    for wall, one in found.items():
        assert one["time_s"].tolist() == [2.5, 3.5] and one["x_m"].tolist() == [3.0, 4.0]
        assert np.array_equal(one["slip_m"], set_back[wall]["slip_m"][2:])
    same(records.since_set_back({"a": rising}), {"a": rising})
    assert records.since_set_back({}) == {}


# ---- where cells lie ------------------------------------------------------------------------------

CORNER = np.array([(0.0, 3.0), (0.0, 0.0), (5.0, 0.0)])  # 8 m


def ends_of(cells):
    return np.array([(cell[0], cell[-1]) for cell in cells])


@pytest.mark.parametrize("backwards", [False, True])
def test_cells_are_equal_parts_of_a_bent_wall_from_either_end(backwards):
    """Two of 4 m, the corner 3 m from an end: in the first cell, half way along which is (0, 1)."""
    cells = places.parts(CORNER[::-1] if backwards else CORNER, 2, (0.0, 1.0))
    assert [cell.tolist() for cell in cells] == [[[0, 3], [0, 0], [1, 0]], [[1, 0], [5, 0]]]
    assert places.middles(CORNER[::-1] if backwards else CORNER, ends_of(cells)) == pytest.approx(
        np.array([(0.0, 1.0), (3.0, 0.0)]), abs=1e-12
    )
    from_there = places.parts(CORNER, 2, (3.0, 0.0))
    assert [cell.tolist() for cell in from_there] == [[[5, 0], [1, 0]], [[1, 0], [0, 0], [0, 3]]]


def test_a_corner_between_two_cells_is_in_neither():
    assert [len(cell) for cell in places.parts(CORNER, 8, (0.0, 2.5))] == [2] * 8


def test_cells_of_a_wall_that_was_turned_and_pushed_have_their_middles_on_it():
    cells = ends_of(places.parts(CORNER, 3, (0.0, 2.0)))
    still = places.middles(CORNER, cells)
    assert still == pytest.approx(np.array([(0, 5 / 3), (1, 0), (11 / 3, 0)]), abs=1e-12)
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    moved = places.middles(CORNER, cells @ turn.T + (7.0, -2.0))
    assert moved == pytest.approx(still @ turn.T + (7.0, -2.0), abs=1e-12)
    assert places.middles(CORNER, np.zeros((0, 2, 2))).shape == (0, 2)


def test_the_one_cell_of_a_wall_that_ends_where_it_begins_has_its_middle_half_way_along():
    """Of a square of 2 m: at the corner across."""
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)], float)
    assert places.middles(square, np.zeros((1, 2, 2))).tolist() == [[2.0, 2.0]]
