"""Files for ParaView, read back with the library that ParaView's users would use."""

import dataclasses
import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np

import synthetic_slope as synthetic
from yade.nonsmooth import paraview, records, section


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


def test_a_run(tmp_path):
    """Frames by time in their order, walls, broken bonds, and the contacts of t0."""
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
