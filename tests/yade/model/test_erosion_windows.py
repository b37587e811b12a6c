"""Windows of a section that take disks out: where they are and what they take, what is refused, and windows of
mirrored and similar sections. Needs no YADE.
"""

import copy
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.model import scales  # noqa: E402
from nonsmooth.model.section import data as section_data  # noqa: E402

SQUARE = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
ONCE = {"name": "cut", "vertices": SQUARE, "begin": 1.0}
MOVING = ONCE | {"end": 5.0, "velocity": [-0.5, 0.25]}
DUG = ONCE | {"end": 6.0, "opening": {"time": 4.0}}
CARRIED = ONCE | {"end": 9.0, "path": [[2.0, 0.0, 0.0], [4.0, 3.0, 0.0], [6.0, 3.0, -1.0]]}
UNDERCUT = section.load("undercut")


def of(*windows, **keys):
    """The undercut slope with other windows."""
    return section.of(section_data.plain(UNDERCUT) | {"erosion": [copy.deepcopy(w) for w in windows]} | keys)


def window(**keys):
    return of(ONCE | keys).erosion[0]


def taken(one, time, *points):
    return one.takes(*np.transpose(points), time).tolist()


def test_a_window_that_says_no_more_takes_once_and_all_layers():
    one = window()
    assert (one.begin, one.end, one.moves, one.hold, one.layers) == (1.0, 1.0, False, "motion", ())
    assert one.of_layers(UNDERCUT).tolist() == [True]
    assert taken(one, 1.0, (1, 1), (0.01, 1.99), (-0.01, 1), (2.01, 1), (1, 2.01)) == [True, True, False, False, False]


def test_one_that_moves_is_where_its_velocity_has_brought_it_since_its_begin():
    one = of(MOVING).erosion[0]
    assert one.way(0.0) == one.way(1.0) == (0.0, 0.0) and one.way(3.0) == (-1.0, 0.5)
    assert one.outline(3.0).tolist() == [[-1.0, 0.5], [1.0, 0.5], [1.0, 2.5], [-1.0, 2.5]]
    assert taken(one, 3.0, (-0.9, 0.6), (0.9, 2.4), (1.1, 1.0), (0.0, 0.4)) == [True, True, False, False]


def test_one_with_a_path_stands_before_and_after_it():
    one = of(CARRIED).erosion[0]
    assert [one.way(t) for t in (0.0, 2.0, 3.0, 4.0, 5.0, 8.0)] == [
        (0.0, 0.0), (0.0, 0.0), (1.5, 0.0), (3.0, 0.0), (3.0, -0.5), (3.0, -1.0)
    ]  # fmt: skip


def test_one_that_is_dug_opens_at_an_even_speed_from_its_top_down_or_where_it_is_told():
    one = of(DUG).erosion[0]
    assert [one.open_share(t) for t in (0.5, 1.0, 2.0, 5.0, 7.0)] == [0.0, 0.0, 0.25, 1.0, 1.0]
    heights = [(1.0, 1.9), (1.0, 1.51), (1.0, 1.49), (1.0, 0.1)]
    assert taken(one, 2.0, *heights) == [True, True, False, False] and taken(one, 5.0, *heights) == [True] * 4
    # from its left to its right, whatever the length of the vector
    aside = of(DUG | {"opening": {"time": 4.0, "direction": [5.0, 0.0]}}).erosion[0]
    assert taken(aside, 2.0, (0.4, 1.0), (0.49, 0.1), (0.51, 1.9), (1.9, 1.0)) == [True, True, False, False]
    # it opens along with its own motion
    both = of(DUG | {"velocity": [1.0, 0.0]}).erosion[0]
    assert taken(both, 2.0, (2.9, 1.9), (0.9, 1.9), (2.9, 1.4)) == [True, False, False]


def test_a_dug_window_ends_when_it_is_open():
    assert window(opening={"time": 3.0}).end == 4.0


@pytest.mark.parametrize("one", [ONCE, MOVING, DUG, CARRIED], ids=["once", "moving", "dug", "carried"])
def test_a_mirrored_window_takes_the_mirrored_points(one):
    here = of(one | ({"opening": {"time": 3.0, "direction": [1.0, 0.5]}} if one is DUG else {}))
    there = similar.mirrored(here)
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-4, 6, 400), rng.uniform(-2, 4, 400)
    for time in (1.4, 2.3, 4.0):
        inside = here.erosion[0].takes(x, y, time)
        assert np.array_equal(there.erosion[0].takes(-x, y, time), inside) and 0 < inside.sum() < 100
    assert similar.mirrored(there).erosion == here.erosion


@pytest.mark.parametrize("one", [ONCE, MOVING, DUG, CARRIED], ids=["once", "moving", "dug", "carried"])
def test_a_similar_window_takes_the_same_points_at_its_own_times(one):
    here = of(one)
    there = similar.scaled(here, 4.0)
    rng = np.random.default_rng(2)
    x, y = rng.uniform(-4, 6, 400), rng.uniform(-2, 4, 400)
    for time in (1.4, 2.3, 4.0):
        inside = here.erosion[0].takes(x, y, time)
        assert np.array_equal(there.erosion[0].takes(4 * x, 4 * y, 2 * time), inside) and inside.any()
    assert scales.of(there).row_seconds == 2 * scales.of(here).row_seconds
    back = similar.scaled(there, 0.25)
    assert back.erosion == here.erosion


@pytest.mark.parametrize("one", [ONCE, MOVING, DUG, CARRIED, ONCE | {"layers": ["slab"], "hold": "never"}])
def test_windows_are_written_down_as_they_are(one, tmp_path):
    made = of(one)
    section_data.write(made, tmp_path / "section.yaml")
    assert section.load(str(tmp_path / "section.yaml")).erosion == made.erosion
    assert section.of(section_data.plain(made)).erosion == made.erosion
    assert made.key("settled") == UNDERCUT.key("settled")  # a packing that has settled is none of its business


def test_a_value_of_a_window_is_changed_by_its_name():
    made = of(MOVING).with_values({"erosion.cut.velocity": [-0.1, 0.0], "erosion.cut.end": 7.0})
    assert (made.erosion[0].velocity, made.erosion[0].end) == ((-0.1, 0.0), 7.0)
    larger = similar.scaled(of(MOVING), 4.0).with_values({"erosion.cut.end": 14.0})
    assert larger.erosion[0].end == 14.0 and larger.like[0].erosion[0].end == 7.0


@pytest.mark.parametrize(
    "keys, message",
    [
        (
            dict(vertices=[[0, 0], [2, 2], [2, 0], [0, 2]]),
            r"erosion\[cut\].vertices: no simple polygon: Self-intersection",
        ),
        (dict(vertices=[[0, 0], [1, 1], [2, 2]]), r"erosion\[cut\].vertices: no simple polygon"),
        (dict(vertices=[[0, 0], [1, 1]]), r"erosion\[cut\].vertices: has 2 entries"),
        (dict(begin=-1.0), r"erosion\[cut\].begin: -1.0 is not allowed; needed: when it begins"),
        (dict(end=0.5), r"erosion\[cut\].end: 0.5 s is before its begin, 1 s; give a later end, or none"),
        (dict(begin=89.5), r"erosion\[cut\].begin: 89.5 s after t0 is no time of the run, which ends 89 s after t0"),
        (dict(end=4.0, opening={"time": 3.5}), r"erosion\[cut\].opening: opens in 3.5 s, and there are 3 s"),
        (dict(opening={"time": 1.0, "direction": [0, 0]}), r"erosion\[cut\].opening: its direction is zero"),
        (dict(layers=["slab", "top"]), r"erosion\[cut\].layers: no layer is called 'top'; give some of slab"),
        (dict(layers=["slab", "slab"]), r"erosion\[cut\].layers: named twice: 'slab'"),
        (dict(velocity=[1.0, 0.0]), r"erosion\[cut\].velocity: moves a window that takes once; give its `end`"),
        (dict(path=[[0, 0, 0], [1, 1, 0]]), r"erosion\[cut\].path: moves a window that takes once; give its `end`"),
        (
            dict(end=3.0, velocity=[1.0, 0.0], path=[[0, 0, 0], [1, 1, 0]]),
            r"erosion\[cut\].path: is given beside a velocity; keep one",
        ),
        (
            dict(end=3.0, path=[[1, 0, 0], [1, 1, 0]]),
            r"erosion\[cut\].path: the time 1 s does not follow 1 s; give the times in rising order",
        ),
        (
            dict(end=3.0, velocity=[0.0, 50.0]),
            r"erosion\[cut\].velocity: at 50 m/s it goes 2.5 m .* is 2 m long .* let it go 40 m/s at most",
        ),
        (dict(end=3.0, path=[[1, 0, 0], [2, 41, 0]]), r"erosion\[cut\].path: at 41 m/s it goes"),
        (dict(hold="always"), r"erosion\[cut\].hold: 'always' is not allowed; needed: motion"),
        (dict(name=""), r"erosion\[\].name"),
        (dict(motion=[1, 0]), r"erosion\[cut\].motion: unknown key"),
    ],
)
def test_what_is_wrong_with_a_window_is_told(keys, message):
    with pytest.raises(section.SectionError, match=message):
        window(**keys)


def test_windows_have_names_of_their_own():
    with pytest.raises(section.SectionError, match=r"erosion\[cut\].name: 'cut' is taken"):
        of(ONCE, MOVING)
    with pytest.raises(section.SectionError, match="erosion: has 0 entries; needed: a list of windows"):
        of()
    assert [one.name for one in of(ONCE, MOVING | {"name": "river"}).erosion] == ["cut", "river"]


def test_a_window_that_meets_no_layer_is_noted():
    from nonsmooth.model.section import checks

    far = ONCE | {"vertices": [[90.0, 20.0], [95.0, 20.0], [95.0, 30.0]]}
    said = [note for note in checks.notes(of(far)) if "window" in note]
    assert len(said) == 1 and "the window cut meets no layer" in said[0]
    comes = far | {"end": 9.0, "path": [[1.0, 0.0, 0.0], [9.0, -80.0, -15.0]]}
    assert not [note for note in checks.notes(of(comes, MOVING | {"name": "b"})) if "window" in note]
    assert math.isfinite(UNDERCUT.area)
