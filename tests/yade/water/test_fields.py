"""Pore pressures on meshes and below lines, in time and in files, and what is refused. Needs no YADE."""

import sys
from pathlib import Path

import h5py
import meshio
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.system.whole_files import WriteError  # noqa: E402
from nonsmooth.water import field_files, fields, seepage  # noqa: E402
from nonsmooth.water.conditions import Reservoir  # noqa: E402
from nonsmooth.water.fields import FieldError, MeshField, PhreaticLine  # noqa: E402
from nonsmooth.water.mesh import Mesh, grid  # noqa: E402

MESH = grid(np.linspace(0, 4, 5), np.linspace(0, 3, 4))
POINTS = np.random.default_rng(5).uniform((0, 0), (4, 3), (200, 2))


def linear(x, y):
    return 5e4 - 300 * x - 9810 * y


def field(times=(0.0,), *factors):
    return MeshField(MESH, times, [f * linear(*MESH.nodes.T) for f in factors or (1.0,)])


# ---- meshes ---------------------------------------------------------------------------------------


def test_a_linear_pressure_is_exact_in_triangles():
    f = field()
    assert f.pressure(POINTS) == pytest.approx(linear(*POINTS.T), rel=1e-12)
    assert f.gradient(POINTS) == pytest.approx(np.tile((-300.0, -9810.0), (200, 1)), rel=1e-10)
    assert f.gradients() == pytest.approx(np.tile((-300.0, -9810.0), (24, 1)), rel=1e-10)


def test_pressures_are_linear_in_time_and_stay_before_and_after():
    f = field((1.0, 3.0, 4.0), 1.0, 2.0, 0.5)
    for time, factor in ((-9, 1), (1, 1), (1.5, 1.25), (3, 2), (3.5, 1.25), (4, 0.5), (99, 0.5)):
        assert f.at(time) == pytest.approx(factor * linear(*MESH.nodes.T), rel=1e-12)
        assert f.gradient(POINTS[:3], time)[:, 1] == pytest.approx(-9810 * factor, rel=1e-10)


def test_outside_the_mesh_is_refused_or_dry():
    f, out = field(), np.array([[1.0, 1.0], [4.2, 1.0]])
    with pytest.raises(FieldError, match=r"points: 1 of 2 lie outside the mesh .* first at \(4.2, 1\) m; .*0, 0, 4, 3"):
        f.pressure(out)
    with pytest.raises(FieldError, match="disks: 1 of 2 lie outside"):
        f.require(out, "disks")
    assert f.pressure(out, outside="dry")[1] == 0 and np.all(f.gradient(out, outside="dry")[1] == 0)
    assert f.pressure(out, outside="dry")[0] > 0
    with pytest.raises(FieldError, match="outside 'wet': give 'refuse' or 'dry'"):
        f.gradient(out, outside="wet")


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: MeshField(MESH, (0, 1, 1), np.zeros((3, 20))), r"times\[1\] = 1 and times\[2\] = 1: times must rise"),
        (lambda: MeshField(MESH, (0, np.nan), np.zeros((2, 20))), "times .*give one or more finite numbers"),
        (lambda: MeshField(MESH, (), np.zeros((0, 20))), "times .*give one or more finite numbers"),
        (lambda: MeshField(MESH, (0,), np.zeros((2, 20))), r"pressures of shape \(2, 20\): give \(1, 20\)"),
        (
            lambda: MeshField(MESH, (0,), np.full((1, 20), np.nan)),
            r"pressure nan Pa at \(0, 0\) m, t = 0 s: give finite",
        ),
        (lambda: MeshField(None, (0,), [[0]]), "mesh None: give a Mesh"),
        (lambda: field().at(np.inf), "time inf: give a finite number"),
        (lambda: field().pressure([[0, np.nan]]), r"points\[0\] \[0.0, nan\]: give finite numbers"),
        (lambda: fields.of_seepage([]), "0 results: give one or more on the same mesh"),
    ],
)
def test_fields_without_sense(make, message):
    with pytest.raises(FieldError, match=message):
        make()


def test_dry_ground_has_no_pressure_and_no_gradient():
    """The free surface of a linear pressure lies within triangles, where it passes through 0, and moves with time."""
    f = MeshField(MESH, (0, 1), [9810 * (level - MESH.nodes[:, 1]) for level in (1.3, 2.7)])
    for time, level in ((0, 1.3), (0.25, 1.65), (1, 2.7)):
        wet = POINTS[:, 1] < level
        assert 0 < wet.sum() < 200
        assert f.pressure(POINTS, time) == pytest.approx(9810 * np.maximum(level - POINTS[:, 1], 0), rel=1e-9)
        assert f.gradient(POINTS, time)[:, 1] == pytest.approx(np.where(wet, -9810, 0), rel=1e-9)


def test_the_field_of_a_seepage_has_no_suction():
    mesh = grid(np.linspace(0, 10, 11), np.linspace(0, 10, 11))
    given = [[Reservoir([(0, 0), (0, 10)], level), Reservoir([(10, 0), (10, 10)], 2)] for level in (9, 5)]
    found = seepage.course(mesh, 1e-5, given)
    f = fields.of_seepage(found, (0, 3600))
    assert f.pressure([[0, 0]], 0) == pytest.approx(9 * 9810) and f.pressure([[0, 0]], 1800) == pytest.approx(7 * 9810)
    assert f.pressures.min() < -9810 and f.pressure([[9.9, 9.9]]) == 0 and found[0].pressure(9810).min() == 0
    with pytest.raises(FieldError, match="2 results: give one or more on the same mesh"):
        fields.of_seepage([found[0], seepage.solve(MESH, 1.0, [Reservoir([(0, 0), (0, 3)], 2)])], (0, 1))


# ---- lines ----------------------------------------------------------------------------------------


def test_the_pressure_below_a_line_and_its_gradient_are_each_others():
    """By differences, on both kinds of flow, away from the vertex and from the line."""
    for along in (False, True):
        line = PhreaticLine([[(0, 10), (20, 6), (50, 5)]], along=along)
        points = np.array([[3.0, 2.0], [15.0, -4.0], [30.0, 5.2], [44.0, 1.0]])
        step = 1e-4
        for k in (0, 1):
            move = step * np.eye(2)[k]
            slope = (line.pressure(points + move) - line.pressure(points - move)) / (2 * step)
            assert line.gradient(points)[:, k] == pytest.approx(slope, rel=1e-6, abs=1e-3)
        assert line.pressure([[0, 12]]) == 0 and np.all(line.gradient([[0, 12]]) == 0)


def test_water_that_flows_along_a_slope_has_the_pressure_of_parallel_seepage():
    """γ_w h_n cos β of the depth h_n normal to the line; sideways flow γ_w times the depth straight down."""
    beta = np.radians(21)
    line = [(0, 100), (200, 100 - 200 * np.tan(beta))]
    point = np.array([[100, 100 - 100 * np.tan(beta)]]) - 22.5 * np.array([[np.sin(beta), np.cos(beta)]])
    assert PhreaticLine([line], along=True).pressure(point) == pytest.approx(9810 * 22.5 * np.cos(beta), rel=1e-12)
    assert PhreaticLine([line]).pressure(point) == pytest.approx(9810 * 22.5 / np.cos(beta), rel=1e-12)
    # (18) of the paper: the force has no part along the slope
    gradient = PhreaticLine([line], along=True).gradient(point)[0]
    assert gradient @ (np.cos(beta), -np.sin(beta)) == pytest.approx(0, abs=1e-9)
    assert gradient @ (np.sin(beta), np.cos(beta)) == pytest.approx(-9810 * np.cos(beta), rel=1e-12)


def test_a_line_is_linear_in_time_whatever_its_vertices():
    line = PhreaticLine([[(0, 4), (10, 4)], [(0, 8), (5, 2), (10, 8)]], (0, 10))
    height, slope = line.heights([0, 2.5, 5, 10], 5)
    assert height == pytest.approx((6, 4.5, 3, 6)) and slope == pytest.approx((-0.6, -0.6, 0.6, 0.6))
    assert line.heights([5], -1)[0] == 4 and line.heights([5], 99)[0] == 2
    assert line.pressure([[5, 1]], 5) == pytest.approx(2 * 9810)


def test_beyond_the_ends_of_a_line():
    line = PhreaticLine([[(0, 4), (10, 4)], [(2, 4), (12, 4)]], (0, 10))
    assert line.pressure([[1, 0]], 0) == pytest.approx(4 * 9810)
    with pytest.raises(FieldError, match="x = 1 m lies beyond the phreatic line, which goes from 2 to 10 m at t = 5 s"):
        line.pressure([[3, 0], [1, 0]], 5)
    assert line.pressure([[3, 0], [1, 0]], 5, "dry") == pytest.approx((4 * 9810, 0))
    assert line.gradient([[3, 0], [1, 0]], 5, "dry")[1] == pytest.approx((0, 0))


@pytest.mark.parametrize(
    "lines, times, message",
    [
        ([[(0, 1)]], (0,), r"lines\[0\] \[\(0, 1\)\]: give two points or more"),
        ([[(0, 1), (3, 2), (2, 5)]], (0,), r"lines\[0\] goes from x = 3 to x = 2 m: give points with rising x"),
        ([[(0, 1), (0, 2)]], (0,), r"lines\[0\] goes from x = 0 to x = 0 m"),
        ([[(0, 1), (1, np.nan)]], (0,), r"lines\[0\]\[1\] \[1.0, nan\]: give finite"),
        ([[(0, 1), (1, 2)]], (0, 1), "lines: 1 were given for 2 times"),
        (np.array([(0.0, 1), (1, 2)]), (0, 1), "lines: one line was given; give a list"),
        ([[(0, 1), (1, 2)]] * 2, (1, 0), r"times\[0\] = 1 and times\[1\] = 0: times must rise"),
    ],
)
def test_lines_without_sense(lines, times, message):
    with pytest.raises(FieldError, match=message):
        PhreaticLine(lines, times)


def test_a_unit_weight_without_sense():
    with pytest.raises(FieldError, match="unit_weight 0: give a number above 0"):
        PhreaticLine([[(0, 1), (1, 2)]], unit_weight=0)


def test_a_line_on_a_mesh_has_its_pressures_at_the_nodes():
    line = PhreaticLine([[(0, 2.5), (4, 1.5)], [(0, 5), (4, 5)]], (0, 60))
    # a field whose time is not said is that of the beginning
    point, mesh = [[1.0, 0.5]], line.on(MESH)
    for field in (line, mesh):
        for ask in (field.pressure, field.gradient):
            assert np.array_equal(ask(point), ask(point, 0.0)) and not np.array_equal(ask(point), ask(point, 1.0))
    assert np.array_equal(line.heights([1.0])[0], line.heights([1.0], 0.0)[0])
    assert line.heights([1.0])[0] != line.heights([1.0], 1.0)[0]
    assert np.array_equal(mesh.gradients(), mesh.gradients(0.0)) and not np.array_equal(
        mesh.gradients(), mesh.gradients(1.0)
    )
    f = line.on(MESH)
    assert np.array_equal(f.times, (0, 60))
    assert f.at(0) == pytest.approx(9810 * (2.5 - MESH.nodes[:, 0] / 4 - MESH.nodes[:, 1]))
    for time in (0, 25, 60):
        assert f.gradient(POINTS, time) == pytest.approx(line.gradient(POINTS, time), abs=1e-6)
        assert f.pressure(POINTS, time) == pytest.approx(line.pressure(POINTS, time), abs=1e-6)
    beyond = PhreaticLine([[(0, 2.5), (2, 2.5)]]).on(MESH, outside="dry")
    assert np.all(beyond.at(0)[MESH.nodes[:, 0] > 2] == 0)


# ---- files ----------------------------------------------------------------------------------------


def same(one, other):
    assert np.array_equal(one.mesh.nodes, other.mesh.nodes) and np.array_equal(one.mesh.triangles, other.mesh.triangles)
    assert np.array_equal(one.mesh.layer, other.mesh.layer)
    assert np.array_equal(one.times, other.times) and np.array_equal(one.pressures, other.pressures)


def test_a_field_that_is_written_reads_back_and_has_the_same_bytes_each_time(tmp_path):
    f = field((0.0, 2.0), 1.0, 0.3)
    path = field_files.write(f, tmp_path / "a.h5")
    same(field_files.read(path), f)
    assert path.read_bytes() == field_files.write(f, tmp_path / "b.hdf5").read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.h5", "b.hdf5"]


def test_idle_nodes_of_an_hdf5_file_take_their_pressures_along(tmp_path):
    hdf5(
        tmp_path / "a.h5",
        nodes=np.vstack(([[-9, -9]], MESH.nodes)),
        triangles=MESH.triangles + 1,
        pressure=[np.append(77.0, linear(*MESH.nodes.T))],
    )
    assert field_files.read(tmp_path / "a.h5").pressure(POINTS) == pytest.approx(linear(*POINTS.T), rel=1e-12)


def test_pressures_on_a_grid_in_hdf5(tmp_path):
    x, y = np.linspace(0, 4, 5), np.linspace(0, 3, 4)
    with h5py.File(tmp_path / "grid.h5", "w") as file:
        file["x"], file["y"], file["times"] = x, y, [0.0, 5.0]
        file["u"] = [linear(*np.meshgrid(x, y)), np.zeros((4, 5))]
    f = field_files.read(tmp_path / "grid.h5", name="u")
    assert f.pressure(POINTS, 2.5) == pytest.approx(0.5 * linear(*POINTS.T), rel=1e-12)


@pytest.mark.parametrize("suffix", (".vtu", ".vtk", ".msh", ".xdmf"))
def test_a_mesh_of_meshio(tmp_path, suffix):
    nodes = np.column_stack((MESH.nodes, np.zeros(len(MESH.nodes))))
    nodes = np.vstack((nodes, [[9, 9, 0]]))  # which no triangle has
    values = np.append(linear(*MESH.nodes.T), np.nan)
    meshio.Mesh(nodes, [("triangle", MESH.triangles), ("line", [[0, 1]])], point_data={"pressure": values}).write(
        tmp_path / f"a{suffix}", **({"file_format": "gmsh22"} if suffix == ".msh" else {})
    )
    f = field_files.read(tmp_path / f"a{suffix}", time=3.0)
    assert f.pressure(POINTS) == pytest.approx(linear(*POINTS.T), rel=1e-9) and f.times.tolist() == [3.0]


def test_rectangles_of_meshio_are_cut(tmp_path):
    nodes = np.array([(0, 0, 0), (2, 0, 0), (2, 3, 0), (0, 3, 0.0)])
    mesh = meshio.Mesh(nodes, [("quad", [[0, 1, 2, 3]])], point_data={"p": linear(*nodes[:, :2].T)})
    mesh.write(tmp_path / "a.vtu")
    f = field_files.read(tmp_path / "a.vtu", name="p")
    assert f.mesh.area.sum() == pytest.approx(6) and f.pressure([[1, 1]]) == pytest.approx(linear(1, 1))


def test_a_series_of_xdmf_and_of_single_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where meshio puts the HDF5 file of a series
    f = field((0.0, 2.0, 7.0), 1.0, 0.5, 0.1)
    cells = [("triangle", MESH.triangles)]
    with meshio.xdmf.TimeSeriesWriter(tmp_path / "s.xdmf") as writer:
        writer.write_points_cells(MESH.nodes, cells)
        for time, values in zip(f.times, f.pressures):
            writer.write_data(time, point_data={"pressure": values})
    same(field_files.read(tmp_path / "s.xdmf"), f)
    entries = []
    for time, values in zip(f.times, f.pressures):
        entries.append((time, tmp_path / f"{time:g}.vtu"))
        meshio.Mesh(MESH.nodes, cells, point_data={"pressure": values}).write(entries[-1][1])
    same(field_files.read_series(entries), f)
    meshio.Mesh(MESH.nodes + 1, cells, point_data={"pressure": values}).write(tmp_path / "other.vtu")
    with pytest.raises(FieldError, match="other.vtu: its mesh is not that of .*0.vtu"):
        field_files.read_series([entries[0], (1, tmp_path / "other.vtu")])
    with pytest.raises(FieldError, match=r"7.vtu: times\[0\] = 7 and times\[1\] = 2: times must rise"):
        field_files.read_series(entries[::-1])


def hdf5(path, **changed):
    arrays = {"nodes": MESH.nodes, "triangles": MESH.triangles, "times": [0.0], "pressure": [linear(*MESH.nodes.T)]}
    with h5py.File(path, "w") as file:
        for name, values in {**arrays, **changed}.items():
            if values is not None:
                file[name] = values


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"times": None}, "a.h5: has no dataset times; it has nodes, pressure, triangles"),
        ({"x": [0, 1]}, "a.h5: has no dataset y;"),
        ({"times": [0.0, 1.0]}, r"a.h5: pressures of shape \(1, 20\): give \(2, 20\)"),
        ({"pressure": np.zeros((1, 3))}, r"a.h5: pressure of shape \(1, 3\): give \(times, nodes\), here \(…, 20\)"),
        ({"pressure": np.full((1, 20), np.inf)}, "a.h5: pressure inf Pa at"),
        ({"triangles": [[0, 1, 99]]}, "a.h5: triangle 0 has the node 99: give numbers from 0 to 19"),
        ({"triangles": [[0, 1, 2]]}, r"a.h5: triangle 0 at \(0, 0\) m has no area"),
        ({"triangles": [[0.0, 1, 5]]}, r"a.h5: triangles .*: give whole numbers of shape \(n, 3\)"),
        ({"nodes": MESH.nodes[:, :1]}, r"a.h5: nodes .*: give numbers of shape \(n, 2\)"),
        (
            {"nodes": np.where(MESH.nodes == 3, np.inf, MESH.nodes)},
            r"a.h5: nodes\[3\] \[inf, 0.0\]: give finite numbers",
        ),
    ],
)
def test_hdf5_files_that_are_wrong(tmp_path, changed, message):
    hdf5(tmp_path / "a.h5")
    field_files.read(tmp_path / "a.h5")  # as it is, it can be read
    hdf5(tmp_path / "a.h5", **changed)
    with pytest.raises(FieldError, match=message):
        field_files.read(tmp_path / "a.h5")


def test_grids_in_files_that_are_wrong(tmp_path):
    for x, shape, message in (
        ([0, 1, 1], (1, 2, 3), r"g.h5: x\[1\] = 1 and x\[2\] = 1: lines of a grid must rise"),
        ([0, 1, 2], (1, 3, 2), r"g.h5: pressure of shape \(1, 3, 2\): give \(times, y, x\), here \(…, 2, 3\)"),
        ([0, 1, 2], (0, 2, 3), r"g.h5: pressures of shape \(0, 6\): give \(1, 6\)"),
    ):
        with h5py.File(tmp_path / "g.h5", "w") as file:
            file["x"], file["y"], file["times"], file["pressure"] = x, [0, 1], [0], np.zeros(shape)
        with pytest.raises(FieldError, match=message):
            field_files.read(tmp_path / "g.h5")


def test_damaged_bytes_and_numbers_that_are_not_real(tmp_path):
    hdf5(tmp_path / "a.h5")
    content = (tmp_path / "a.h5").read_bytes()
    (tmp_path / "b.h5").write_bytes(content[:48] + content)  # all addresses are wrong
    with pytest.raises(FieldError, match="b.h5: .*cannot be read") as error:
        field_files.read(tmp_path / "b.h5")
    assert "\n" not in str(error.value)
    hdf5(tmp_path / "a.h5", pressure=np.ones((1, 4)) * 1j)
    with pytest.raises(FieldError, match="a.h5: pressure holds complex128; give real numbers"):
        field_files.read(tmp_path / "a.h5")


def test_other_files_that_are_wrong(tmp_path, capfd):
    with pytest.raises(FieldError, match="none.h5: there is no such file"):
        field_files.read(tmp_path / "none.h5")
    for name, message in (
        ("a.h5", "is no HDF5 file that can be read"),
        ("a.vtu", "meshio cannot read it"),
        ("a.xdmf", "meshio cannot read it"),
        ("a.pdf", "meshio cannot read it"),
    ):
        (tmp_path / name).write_text("this is no mesh")
        with pytest.raises(FieldError, match=f"{name}: {message}"):
            field_files.read(tmp_path / name)
    assert capfd.readouterr() == ("", "")  # meshio itself says nothing
    nodes = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1.0)])
    data = {"p": np.zeros(4)}
    meshio.Mesh(nodes, [("triangle", [[0, 1, 2]])], point_data=data).write(tmp_path / "a.vtu")
    with pytest.raises(FieldError, match="a.vtu: has no values 'pressure' at its points; it has 'p'"):
        field_files.read(tmp_path / "a.vtu")
    with pytest.raises(FieldError, match="a.vtu: its points have different z"):
        field_files.read(tmp_path / "a.vtu", name="p")
    meshio.Mesh(nodes, [("tetra", [[0, 1, 2, 3]])], point_data=data).write(tmp_path / "a.vtu")
    with pytest.raises(FieldError, match=r"a.vtu: has no triangles or quadrilaterals \(cells: tetra\)"):
        field_files.read(tmp_path / "a.vtu", name="p")
    meshio.Mesh(nodes[:3], [("triangle", [[0, 1, 2]])], point_data={"p": np.zeros((3, 3))}).write(tmp_path / "a.vtu")
    with pytest.raises(FieldError, match=r"a.vtu: p of shape \(3, 3\): give one number for each of 3 points"):
        field_files.read(tmp_path / "a.vtu", name="p")
    with pytest.raises(FieldError, match="entries 'a.vtu': give a list of"):
        field_files.read_series("a.vtu")


def test_what_cannot_be_written(tmp_path):
    with pytest.raises(FieldError, match="a.vtu: give a name that ends in .h5 or .hdf5"):
        field_files.write(field(), tmp_path / "a.vtu")
    with pytest.raises(FieldError, match="field PhreaticLine.*becomes one by .on"):
        field_files.write(PhreaticLine([[(0, 1), (1, 2)]]), tmp_path / "a.h5")
    (tmp_path / "file").write_text("")
    with pytest.raises(WriteError, match="a.h5: cannot be written"):
        field_files.write(field(), tmp_path / "file" / "a.h5")
