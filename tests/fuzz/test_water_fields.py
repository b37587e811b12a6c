"""Fields of pore pressure broken in many ways, as bytes of their files and as arrays in them: each gives a MeshField or
a WaterError of one line that names the file, within 20 s. Needs no YADE.

NONSMOOTH_FUZZ_FIELDS: how many files (default: a share of CI's time); the same ones each time.
"""

import sys
import tempfile
from pathlib import Path

import h5py
import meshio
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))
import fuzzing  # noqa: E402
from nonsmooth.water import field_files, fields  # noqa: E402
from nonsmooth.water.error import WaterError  # noqa: E402

NODES = np.array([[0.0, 0], [10, 0], [10, 5], [0, 5], [5, 8]])
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
TIMES = np.array([0.0, 10.0, 25.0])
ARRAYS = {
    "nodes": NODES,
    "triangles": TRIANGLES,
    "layer": np.array([0, 0, 1]),
    "times": TIMES,
    "pressure": 1e4 * (np.arange(15.0).reshape(3, 5) - 4),
}
GRID = {
    "x": np.array([0.0, 2.0, 7.0]),
    "y": np.array([-1.0, 4.0]),
    "times": TIMES,
    "pressure": 1e3 * np.arange(18.0).reshape(3, 2, 3),
}
SUFFIXES = (".h5", ".vtu", ".vtk", ".msh", ".xdmf")
ODD = st.sampled_from(
    [np.nan, np.inf, -np.inf, -1.0, 0.0, 1e300, 5e-324, 1e9, 2.5, np.array([]), np.zeros((2, 2)), np.array(["text", "x"]),
     np.array(b"bytes"), np.int64(7), np.array([[0, 1, 99]]), np.array([1 + 2j]), np.zeros((0, 3)), np.full((3, 5), np.nan)]
)  # fmt: skip
CHANGES = st.lists(
    st.tuples(
        st.sampled_from(["value", "whole", "gone", "turned", "shorter", "another"]),
        st.integers(0, 9),
        st.integers(),
        ODD,
    ),
    min_size=1,
    max_size=3,
)
CUTS = st.lists(
    st.tuples(st.sampled_from(["put", "drop", "cut", "twice"]), st.integers(0, 4000), st.integers(1, 300), st.binary(max_size=6)),
    min_size=1,
    max_size=3,
)  # fmt: skip


def changed(arrays, changes):
    made = dict(arrays)
    for kind, which, at, odd in changes:
        name = sorted(arrays)[which % len(arrays)]
        value = np.array(made.get(name, arrays[name]))
        if kind == "gone":
            made.pop(name, None)
        elif kind == "whole":
            made[name] = odd
        elif kind == "another":
            made["pressure" if name != "pressure" else "times"] = value
        elif not value.ndim or not value.size:
            continue
        elif kind == "turned":
            made[name] = value.T if value.ndim > 1 else value[::-1]
        elif kind == "shorter":
            made[name] = value[: at % len(value)]
        elif np.ndim(odd) == 0 and value.dtype.kind in "iuf" and np.asarray(odd).dtype.kind in "iuf":
            value = value.astype(float)
            value.flat[at % value.size] = odd
            made[name] = value
    return made


def is_answered(path):
    """The file gives a field whose numbers are finite, or an error of one line that names it."""
    with fuzzing.at_most(20):
        try:
            field = field_files.read(path)
        except WaterError as error:
            said = str(error)
            assert str(path) in said and len(said.splitlines()) == 1 and len(said) < 2000, said
            return
        assert isinstance(field, fields.MeshField)
        assert np.isfinite(field.pressures).all() and np.isfinite(field.mesh.nodes).all()
        middle = field.mesh.nodes[field.mesh.triangles[:1]].mean(axis=1)
        assert np.isfinite(field.pressure(middle, float(field.times[0]), outside="dry")).all()


@fuzzing.settings("NONSMOOTH_FUZZ_FIELDS", 60)
@given(st.sampled_from([ARRAYS, GRID]), CHANGES)
def test_arrays_without_sense(arrays, changes):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "field.h5"
        with h5py.File(path, "w") as file:
            for name, value in changed(arrays, changes).items():
                value = np.asarray(value)
                file[name] = value.astype("S8") if value.dtype.kind == "U" else value
        is_answered(path)


def raw(suffix, folder):
    """The bytes of a sound file of this kind."""
    path = Path(folder) / f"sound{suffix}"
    if suffix == ".h5":
        with h5py.File(path, "w") as file:
            for name, value in ARRAYS.items():
                file[name] = value
    else:
        nodes = np.column_stack((NODES, np.zeros(len(NODES))))
        mesh = meshio.Mesh(nodes, [("triangle", TRIANGLES)], point_data={"pressure": ARRAYS["pressure"][1]})
        how = {
            ".xdmf": {"data_format": "XML"},
            ".msh": {"file_format": "gmsh22", "binary": False},
            ".vtu": {"binary": True},
            ".vtk": {"binary": True},
        }[suffix]
        mesh.write(path, **how)
    return path.read_bytes()


@fuzzing.settings("NONSMOOTH_FUZZ_FIELDS", 60)
@given(st.sampled_from(SUFFIXES), CUTS)
def test_bytes_without_sense(suffix, cuts):
    with tempfile.TemporaryDirectory() as folder:
        content = raw(suffix, folder)
        for kind, at, length, part in cuts:
            at = at % (len(content) + 1)
            if kind == "put":
                content = content[:at] + part + content[at:]
            elif kind == "drop":
                content = content[:at] + content[at + length :]
            elif kind == "cut":
                content = content[:at]
            else:
                content = content[: at + length] + content[at:]
        path = Path(folder) / f"broken{suffix}"
        path.write_bytes(content)
        is_answered(path)


def test_a_sound_file_of_each_kind_is_read():
    with tempfile.TemporaryDirectory() as folder:
        for suffix in SUFFIXES:
            path = Path(folder) / f"whole{suffix}"
            path.write_bytes(raw(suffix, folder))
            field = field_files.read(path)
            assert len(field.mesh.triangles) == 3 and field.pressures.shape[1] == 5
