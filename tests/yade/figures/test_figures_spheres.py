"""Figures of scenes of spheres, read from their artists. Needs no YADE."""
import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

spheres, style, records = (synthetic.load(name) for name in ("figures.spheres", "figures.style", "records"))
BLUE, PURPLE = style.LINES["blue"], style.LINES["purple"]


def run(kind, **more):
    return {
        "scene": {"kind": kind, "diameter": 0.1, "gravity": 10.0, **more.pop("scene", {})}, "unit_s": 0.5, "radius_m": 1.0,
        "opening_m": 0.6, "height_m": 2.0, "spheres": 100, "world": "hard", "tilt_deg": 30.0, **more,
    }  # fmt: skip


def places(at, time, numbers=None):
    at = np.asarray(at, float)
    return SimpleNamespace(
        at=at,
        r=np.full(len(at), 0.05),
        number=np.arange(len(at)) if numbers is None else np.asarray(numbers),
        time_s=time,
    )


def shown(fig):
    return [ax for ax in fig.axes if ax.get_visible()]


@pytest.mark.parametrize("kind", ("column", "pile", "hopper", "drum"))
def test_a_course_shows_the_slice_along_the_axis(kind):
    """Spheres more than a diameter away from the middle plane are left out, and times stand above in units of T."""
    at = [(-0.5, 0.0, 0.1), (0.5, 0.09, 0.3), (0.2, 0.2, 0.2), (0.0, -0.05, 0.4)]
    fig = spheres.course([places(at, 0.0), places(at[:2], 1.0, [0, 1])], run(kind))
    first, last = shown(fig)
    assert [ax.get_title(loc="right") for ax in (first, last)] == ["0.0 T", "2.0 T"]
    centres = drawn.disks(first)[0]
    assert sorted(map(tuple, np.round(centres, 9))) == [(-0.5, 0.1), (0.0, 0.4), (0.5, 0.3)]
    assert len(drawn.disks(last)[0]) == 2
    # the nearest to the eye is drawn last, and a sphere keeps its colour
    assert tuple(np.round(centres[-1], 9)) == (-0.5, 0.1)
    colours = [dict(zip(map(tuple, np.round(drawn.disks(ax)[0], 9)), drawn.disks(ax)[2])) for ax in (first, last)]
    assert colours[0][(-0.5, 0.1)] == colours[1][(-0.5, 0.1)]


def test_of_many_times_six_are_shown_with_the_first_and_the_last():
    fig = spheres.course([places([(0, 0, 0.1)], 0.5 * k) for k in range(11)], run("column"))
    titles = [ax.get_title(loc="right") for ax in shown(fig)]
    assert len(titles) == 6 and (titles[0], titles[-1]) == ("0.0 T", "10.0 T")
    with pytest.raises(records.RecordsError, match="no places are kept"):
        spheres.course([], run("column"))


def group(world="hard", asked=(), **values):
    return {"world": world, "asked": dict(asked)} | {
        name: {"mean": v[0], "half_width": v[1]} for name, v in values.items()
    }


def test_run_outs_stand_beside_the_published_laws():
    groups = [group(world, aspect=(a, 0.1), runout_rel=(a, 0.2), runout_95_rel=(a + 0.5, 0.1), final_height_rel=(0.7, None)) for a, world in ((1.0, "hard"), (4.0, "hard"), (2.0, "soft"))]  # fmt: skip
    left, right = spheres.runout(groups).axes
    # each law in two pieces, of which the first has the name
    below = drawn.points(drawn.line(left, "Lube et al. (2004), experiments"))
    assert below[-1] == pytest.approx([1.7, 1.24 * 1.7]) and below[0] == pytest.approx([0.85, 1.24 * 0.85])
    above = drawn.points(left.lines[list(left.lines).index(drawn.line(left, "Lube et al. (2004), experiments")) + 1])
    assert above == pytest.approx(np.array([[1.7, 1.6 * math.sqrt(1.7)], [4.6, 1.6 * math.sqrt(4.6)]]))
    bars = {one.get_label(): one for one in left.containers}
    assert drawn.points(bars["hard spheres"].lines[0]).tolist() == [[1, 1], [4, 4]]
    assert drawn.points(bars["soft spheres"].lines[0]).tolist() == [[2, 2]]
    assert drawn.colour(bars["hard spheres"].lines[0]) == BLUE.lower()
    # from 0.8 to 1.2
    lows, highs = (drawn.points(cap)[0] for cap in bars["hard spheres"].lines[1][2:])
    assert (lows[1], highs[1]) == pytest.approx((0.8, 1.2))
    assert (left.get_xscale(), right.get_yscale()) == ("log", "log")
    assert (left.get_ylabel(), right.get_ylabel()) == (r"$(r_\infty-r_0)/r_0$", r"$h_\infty/r_0$")
    mass = drawn.points(drawn.line(left, "hard spheres, 95 % of the mass"))
    assert mass.tolist() == [[1, 1.5], [4, 4.5]]


def test_what_left_hoppers_and_beverloo():
    runs = {"one": run("hopper", scene={"opening": 6.0}), "two": run("hopper", scene={"opening": 6.0}, world="soft")}
    series = {name: {"time_s": np.array([0.0, 1.0]), "discharged_spheres": np.array([0, 50])} for name in runs}
    groups = [
        group(asked={"opening": 6.0}, rate_rel=(20.0, 1.0)),
        group("soft", asked={"opening": 6.0}, rate_rel=(None, None)),
    ]
    left, right = spheres.discharge(series, {"runs": runs, "groups": groups}).axes
    # unit √(d/g) = 0.1 s: half of the spheres after ten of them
    assert drawn.points(drawn.line(left, "D = 6 d, hard")).tolist() == [[0, 0], [pytest.approx(10), 0.5]]
    assert drawn.line(left, "D = 6 d, soft").get_linestyle() == ":"
    law = drawn.points(drawn.line(right, "Beverloo, C = 0.58, k = 1.4"))
    assert law[:, 1] == pytest.approx(0.58 * (law[:, 0] - 1.4) ** 2.5, rel=1e-9)
    bars = {one.get_label(): one for one in right.containers}
    assert drawn.points(bars["hard spheres"].lines[0]).tolist() == [[6, 20]]
    assert "soft spheres" not in bars  # stopped before it had a rate


def test_tilts_are_drawn_against_the_turn_and_reposes_against_friction():
    series = {"one": {name: np.array([0.0, 9.0]) for name in ("turned_deg", "tilt_deg", "tilt_surface_deg")}}
    (ax,) = spheres.tilts(series, {"runs": {"one": run("drum")}}).axes
    assert drawn.points(drawn.line(ax, "one: 30.0°")).tolist() == [[0, 0], [9, 9]]
    groups = [
        group(asked={"friction": mu, "rolling_friction": rolling}, repose_deg=(20 + 10 * mu, 1.0))
        for mu in (0.4, 0.2)
        for rolling in (0.0, 0.1)
    ]
    (ax,) = spheres.reposes(groups).axes
    bars = {one.get_label(): one for one in ax.containers}
    assert list(bars) == [r"$\mu_r$ = 0, hard", r"$\mu_r$ = 0.1, hard"]
    assert drawn.points(bars[r"$\mu_r$ = 0, hard"].lines[0]).tolist() == [[0.2, 22.0], [0.4, 24.0]]


def test_runs_without_an_answer_are_left_out_without_a_warning(tmp_path):
    """A hopper that was stopped early, columns without an edge, piles without a flank."""
    runs = {"one": run("hopper", scene={"opening": 6.0})}
    series = {"one": {"time_s": np.array([0.0, 1.0]), "discharged_spheres": np.array([0, 5])}}
    none = (None, None)
    hoppers = {"runs": runs, "groups": [group(asked={"opening": 6.0}, rate_rel=none)]}
    columns = [
        group(aspect=(a, None), runout_rel=none, runout_95_rel=(9.0, None), final_height_rel=(0.1, None))
        for a in (1, 2)
    ]
    piles = [group(asked={"friction": mu, "rolling_friction": 0.0}, repose_deg=none) for mu in (0.0, 0.1)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn_ones = [spheres.discharge(series, hoppers), spheres.runout(columns), spheres.reposes(piles)]
        for k, fig in enumerate(drawn_ones):
            fig.savefig(tmp_path / f"{k}.png")
    (_, right), (left, heights), (ax,) = (fig.axes for fig in drawn_ones)
    assert not right.containers and not left.containers and not ax.containers
    assert drawn.points(heights.containers[0].lines[0]).tolist() == [[1, 0.1], [2, 0.1]]


@pytest.mark.parametrize(
    "draw, said",
    (
        (lambda: spheres.runout([]), "no columns"),
        (lambda: spheres.discharge({}, {}), "no hoppers"),
        (lambda: spheres.tilts({}, {}), "no drums"),
        (lambda: spheres.reposes([]), "no piles"),
    ),
)
def test_nothing_to_draw_is_said(draw, said):
    with pytest.raises(records.RecordsError, match=said):
        draw()
