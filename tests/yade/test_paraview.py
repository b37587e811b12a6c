"""Files for ParaView, read back with the library that ParaView's users would use."""

import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np

import synthetic_slope as synthetic
from yade.nonsmooth import paraview, records, section


def snapshots(folder, times):
    for k, time in enumerate(times):
        records.write_snapshot(folder / "snapshots" / f"{k:08d}.npz", **synthetic.snapshot_arrays(count=200, time=time, contacts=False))
    return [(time, folder / "snapshots" / f"{k:08d}.npz") for k, time in enumerate(times)]


def test_a_run(tmp_path):
    (tmp_path / "snapshots").mkdir()
    frames = snapshots(tmp_path, [5.0, 60.0])
    records.write_snapshot(tmp_path / "t0.npz", **synthetic.snapshot_arrays(count=200, time=5.0))
    made = paraview.write_run(tmp_path, section.load("jiufengershan"), frames)
    entries = ElementTree.parse(made).getroot().findall("./Collection/DataSet")
    assert [float(e.get("timestep")) for e in entries] == [5.0, 60.0]

    disks, first = meshio.read(made.parent / entries[0].get("file")), records.read_snapshot(frames[0][1])
    assert np.array_equal(disks.points[:, :2], np.column_stack([first.x, first.y])) and not disks.points[:, 2].any()
    assert np.array_equal(disks.point_data["radius"], first.r) and np.array_equal(disks.point_data["layer"], first.layer)
    assert np.array_equal(disks.point_data["velocity"][:, 1], first.vy) and np.array_equal(disks.point_data["wet"] > 0, first.wet)

    contacts, start = meshio.read(tmp_path / "vtk" / "contacts-t0.vtu"), records.read_snapshot(tmp_path / "t0.npz")
    assert np.array_equal(contacts.cell_data["normal"][0], start.cn)
    ends = contacts.points[contacts.cells[0].data]
    assert np.allclose(ends[:, 0, 0], start.x[start.ci])
    walls = meshio.read(tmp_path / "vtk" / "walls.vtu")
    assert set(walls.cell_data["wall"][0]) == {0, 1, 2}
    assert not list(tmp_path.rglob(".part*"))


def test_breaks(tmp_path):
    table = {"step": np.array([3, 3, 9]), "time": np.array([0.015, 0.015, 0.045]), "id1": np.array([2, 7, 8]), "id2": np.array([9, 8, 12]),
             "mode": np.array([1, 2, 4]), "x": np.array([0.1, 0.2, 0.3]), "y": np.array([1 / 3, 0.5, 0.7])}  # fmt: skip
    records.write_breaks(tmp_path / "breaks.csv", table, first_disk=5)
    back = records.read_breaks(tmp_path / "breaks.csv")
    assert back["disk1"].tolist() == [-1, 2, 3] and back["disk2"].tolist() == [4, 3, 7]  # body 2 is a wall
    assert back["mode"].tolist() == ["tension", "shear", "mixed"] and np.array_equal(back["y_m"], table["y"])
    points = meshio.read(paraview.write_breaks(back, tmp_path / "breaks.vtu"))
    assert points.point_data["mode"].tolist() == [1, 2, 4] and np.array_equal(points.point_data["time"], table["time"])


def test_no_breaks(tmp_path):
    records.write_breaks(tmp_path / "breaks.csv", {name: np.zeros(0) for name in ("step", "time", "id1", "id2", "mode", "x", "y")})
    assert len(records.read_breaks(tmp_path / "breaks.csv")["mode"]) == 0
    assert paraview.write_breaks(records.read_breaks(tmp_path / "breaks.csv"), tmp_path / "breaks.vtu").exists()
