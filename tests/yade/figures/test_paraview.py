"""Files for ParaView, read back with the library that ParaView's users would use."""

import dataclasses
import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np

import pytest
import synthetic_slope as synthetic
from yade.nonsmooth import paraview, records, section
from yade.nonsmooth.studies.slope.columns import SURFACE_COLUMNS


def hand(x=(1.0, 3.0, -4.0), y=(2.0, 2.5, 7.0)):
    """Three disks of which no two numbers are alike, with contacts between them and with walls."""
    contacts = [(0, 1, 4e6), (1, 2, -2e6), (2, -1, 3e6, -5.0, 6.5), (0, -3, 1e6, 1.5, 2.5)]
    fields = dict(
        r=[1.0, 1.25, 0.75],
        angle=[0.1, -0.2, 0.3],
        vx=[3.0, -5.0, 8.0],
        vy=[4.0, 12.0, -15.0],
        layer=[0, 2, 1],
        wet=[True, False, True],
        released=[False, False, True],
        ever_wet=[True, False, True],
        weakened=[[False, False], [False, True], [True, False]],
    )
    return synthetic.few(x, y, contacts, **fields)


def test_disks_are_the_snapshot_field_by_field(tmp_path):
    s = hand()
    disks = meshio.read(paraview.write_disks(s, tmp_path / "d.vtu"))
    expected = {
        "radius": s.r,
        "layer": s.layer,
        "velocity": np.column_stack([s.vx, s.vy, np.zeros(3)]),
        "speed": [5.0, 13.0, 17.0],
        "angle": s.angle,
        "wet": s.wet,
        "released": s.released,
        "ever_wet": s.ever_wet,
        "weakened": [0, 1, 1],  # on one wall or another
    }
    assert set(disks.point_data) == set(expected)
    for name, values in expected.items():
        assert np.array_equal(disks.point_data[name], values), name
    assert np.array_equal(disks.points, np.column_stack([s.x, s.y, np.zeros(3)]))
    (cells,) = disks.cells
    assert cells.type == "vertex" and cells.data.tolist() == [[0], [1], [2]]


def test_what_an_earlier_version_did_not_tell_is_left_out(tmp_path):
    disks = meshio.read(
        paraview.write_disks(dataclasses.replace(hand(), ever_wet=None, weakened=None), tmp_path / "d.vtu")
    )
    assert {"wet", "released"} <= set(disks.point_data) and not {"ever_wet", "weakened"} & set(disks.point_data)


def test_contacts_are_the_snapshot_field_by_field(tmp_path):
    s = hand()
    contacts = meshio.read(paraview.write_contacts(s, tmp_path / "c.vtu"))
    expected = {"normal": s.cn, "tangential": s.ct, "bonded": [1, 1, 0, 0]}
    assert set(contacts.cell_data) == set(expected)
    for name, values in expected.items():
        assert np.array_equal(contacts.cell_data[name][0], values), name
    (lines,) = contacts.cells
    # from centre to centre, from centre to the point on the wall
    ends = [[[1, 2], [3, 2.5]], [[3, 2.5], [-4, 7]], [[-4, 7], [-5, 6.5]], [[1, 2], [1.5, 2.5]]]
    assert (
        lines.type == "line"
        and contacts.points[lines.data][:, :, :2].tolist() == ends
        and not contacts.points[:, 2].any()
    )


def test_walls_are_those_of_the_section_in_its_order(tmp_path):
    slope = section.load("jiufengershan")
    walls = meshio.read(paraview.write_walls(slope, tmp_path / "w.vtu"))
    (lines,), (number,) = walls.cells, walls.cell_data["wall"]
    pieces = walls.points[lines.data][:, :, :2]
    for k, wall in enumerate(slope.walls):
        assert np.array_equal(pieces[number == k], np.stack([wall.points[:-1], wall.points[1:]], axis=1))
    assert sorted(set(number)) == list(range(len(slope.walls)))


def surfaces(slope, *walls):
    """{wall: arrays} of walls with two cells each at 5, 60 and 61 s, from the wall's end on; the last has no heat."""
    found = {}
    for number, name in enumerate(walls):
        (line,) = (wall.points for wall in slope.walls if wall.name == name)
        ways = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))))
        middles = [np.interp(share * ways[-1], ways, line[:, axis]) for axis in (0, 1) for share in (0.75, 0.25)]
        slip = np.array([[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]) + 10 * number
        found[name] = {
            "step": np.array([1, 2, 3]),
            "time_s": np.array([5.0, 60.0, 61.0]),
            "x_m": np.array(middles[:2]),
            "y_m": np.array(middles[2:]),
            "length_m": np.full(2, ways[-1] / 2),
            "slip_m": slip,
            "friction": 0.4 - 0.01 * slip,
        } | ({"hottest_degC": 15 + slip} if number < len(walls) - 1 else {})
    return found


def test_cells_of_slip_laws_are_lines_on_their_walls_with_their_columns(tmp_path):
    slope = section.load("jiufengershan")
    names = [wall.name for wall in slope.walls]
    of_walls = surfaces(slope, "SS", "DP")
    path = paraview.write_slip_surface(of_walls, slope, 60.2, tmp_path / "s.vtu")
    found = meshio.read(path)
    ((lines,), points) = found.cells, found.points[:, :2]
    fields = {name: values[0] for name, values in found.cell_data.items()}
    assert lines.type == "line" and set(fields) == {"wall", "cell", "slip_m", "friction", "hottest_degC"}
    lengths = np.hypot(*(points[lines.data[:, 1]] - points[lines.data[:, 0]]).T)
    for name, slip in (("SS", (2.0, 3.0)), ("DP", (12.0, 13.0))):
        (line,) = (wall.points for wall in slope.walls if wall.name == name)
        whole, of_wall = np.hypot(*np.diff(line, axis=0).T).sum(), fields["wall"] == names.index(name)
        for cell in (0, 1):
            mine = of_wall & (fields["cell"] == cell)
            assert lengths[mine].sum() == pytest.approx(whole / 2) and set(fields["slip_m"][mine]) == {slip[cell]}
            assert fields["friction"][mine] == pytest.approx(0.4 - 0.01 * slip[cell])
            heat = fields["hottest_degC"][mine]
            assert np.isnan(heat).all() if name == "DP" else set(heat) == {15 + slip[cell]}
        # the first cell begins at the wall's end, and all of its vertices are there
        assert points[lines.data[of_wall][0, 0]].tolist() == line[-1].tolist()
        there = {tuple(p) for p in points[lines.data[of_wall]].reshape(-1, 2).tolist()}
        assert {tuple(p) for p in line.tolist()} <= there
    with pytest.raises(records.RecordsError, match="the section has no wall 'XY'"):
        paraview.write_slip_surface({"XY": of_walls["DP"]}, slope, 5.0, tmp_path / "x.vtu")
    empty = ElementTree.parse(paraview.write_slip_surface({}, slope, 5.0, tmp_path / "x.vtu")).getroot()
    assert empty.find("./UnstructuredGrid/Piece").get("NumberOfCells") == "0"


def test_a_run_with_slip_laws_has_their_cells_at_the_times_of_its_disks(tmp_path):
    (tmp_path / "snapshots").mkdir()
    slope = section.load("jiufengershan")
    one = surfaces(slope, "DP")["DP"]
    with records.SeriesWriter(tmp_path / "slip_surface.csv", SURFACE_COLUMNS) as file:
        for row in range(3):
            file.write(*(row_of(one, row, cell) for cell in (0, 1)))
    frames = [
        (time, records.write_snapshot(tmp_path / "snapshots" / f"{k:08d}.npz", **vars(hand())))
        for k, time in enumerate((5.0, 61.0))
    ]
    made = paraview.write_run(tmp_path, slope, frames)
    entries = ElementTree.parse(made.with_name("slip_surface.pvd")).getroot().findall("./Collection/DataSet")
    assert [(float(e.get("timestep")), e.get("file")) for e in entries] == [
        (5.0, "slip_surface-00000000.vtu"),
        (61.0, "slip_surface-00000001.vtu"),
    ]
    slips = [meshio.read(made.parent / e.get("file")).cell_data["slip_m"][0].tolist() for e in entries]
    assert slips == [[0.0, 1.0], [4.0, 5.0]]
    disks = ElementTree.parse(made).getroot().findall("./Collection/DataSet")
    assert [e.get("timestep") for e in disks] == [e.get("timestep") for e in entries]


def row_of(one, row, cell):
    """A row of slip_surface.csv of one wall, DP."""
    found = dict.fromkeys(SURFACE_COLUMNS) | {"step": row + 1, "time_s": one["time_s"][row], "wall": "DP", "cell": cell}
    found |= {name: one[name][cell] for name in ("x_m", "y_m", "length_m")}
    found |= {name: one[name][row, cell] for name in ("slip_m", "friction")}
    return found | {"slip_rate_m_per_s": 0.0, "normal_stress_Pa": 1e6}


def test_a_run(tmp_path):
    """Frames by time in their order, walls, broken bonds, and the contacts of t0; nothing of slip laws."""
    (tmp_path / "snapshots").mkdir()
    frames, done = [], []
    for k, time in enumerate((5.0, 60.0)):
        frames.append(
            (
                time,
                records.write_snapshot(
                    tmp_path / "snapshots" / f"{k:08d}.npz", **vars(hand(x=[1.0 + time, 3.0, -4.0]))
                ),
            )
        )
    start = hand(y=[2.0, 2.5, 9.0])
    records.write_snapshot(tmp_path / "t0.npz", **vars(start))
    records.write_breaks(tmp_path / "breaks.csv", BROKEN, first_disk=5)
    made = paraview.write_run(tmp_path, section.load("jiufengershan"), frames, progress=done.append)
    entries = ElementTree.parse(made).getroot().findall("./Collection/DataSet")
    assert made.name == "avalanche.pvd"
    assert [(float(e.get("timestep")), meshio.read(made.parent / e.get("file")).points[0, 0]) for e in entries] == [
        (5.0, 6.0),
        (60.0, 61.0),
    ]
    contacts = meshio.read(tmp_path / "vtk" / "contacts-t0.vtu")
    assert (
        np.array_equal(contacts.cell_data["normal"][0], start.cn)
        and contacts.points[contacts.cells[0].data][1, 1, 1] == 9
        and done == [0.5, 1.0]
    )
    assert sorted(p.name for p in (tmp_path / "vtk").iterdir()) == [
        "avalanche.pvd",
        "breaks.vtu",
        "contacts-t0.vtu",
        "disks-00000000.vtu",
        "disks-00000001.vtu",
        "walls.vtu",
    ]


BROKEN = {"step": np.array([3, 3, 9]), "time": np.array([0.015, 0.015, 0.045]), "id1": np.array([2, 7, 8]), "id2": np.array([9, 8, 12]),
          "mode": np.array([1, 2, 4]), "x": np.array([0.1, 0.2, 0.3]), "y": np.array([1 / 3, 0.5, 0.7])}  # fmt: skip


def test_breaks(tmp_path):
    records.write_breaks(tmp_path / "breaks.csv", BROKEN, first_disk=5)
    back = records.read_breaks(tmp_path / "breaks.csv")
    assert back["disk1"].tolist() == [-1, 2, 3] and back["disk2"].tolist() == [4, 3, 7]  # body 2 is a wall
    assert back["mode"].tolist() == ["tension", "shear", "mixed"] and np.array_equal(back["y_m"], BROKEN["y"])
    points = meshio.read(paraview.write_breaks(back, tmp_path / "breaks.vtu"))
    assert points.point_data["mode"].tolist() == [1, 2, 4] and np.array_equal(points.point_data["time"], BROKEN["time"])
    assert np.array_equal(points.points, np.column_stack([BROKEN["x"], BROKEN["y"], np.zeros(3)]))


def test_no_breaks_and_no_contacts(tmp_path):
    records.write_breaks(
        tmp_path / "breaks.csv", {name: np.zeros(0) for name in ("step", "time", "id1", "id2", "mode", "x", "y")}
    )
    assert len(records.read_breaks(tmp_path / "breaks.csv")["mode"]) == 0
    made = [
        paraview.write_breaks(records.read_breaks(tmp_path / "breaks.csv"), tmp_path / "breaks.vtu"),
        paraview.write_contacts(synthetic.few([0.0], [1.0]), tmp_path / "contacts.vtu"),
    ]
    for path in made:  # which meshio writes and cannot read
        piece = ElementTree.parse(path).getroot().find("./UnstructuredGrid/Piece")
        assert (piece.get("NumberOfPoints"), piece.get("NumberOfCells")) == ("0", "0")
