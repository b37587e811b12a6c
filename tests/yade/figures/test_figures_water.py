"""Figures of water: what is drawn where, read from the artists. Needs no YADE."""

import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section  # noqa: E402
from nonsmooth.figures import style, water  # noqa: E402
from nonsmooth.records import RecordsError  # noqa: E402
from nonsmooth.water import fields, seepage  # noqa: E402
from nonsmooth.water.conditions import Head, Reservoir  # noqa: E402
from nonsmooth.water.mesh import Mesh, grid  # noqa: E402

MESH = grid(np.linspace(0, 20, 21), np.linspace(0, 10, 11))
LEFT, RIGHT = [(0, 0), (0, 10)], [(20, 0), (20, 10)]


def dam(level):
    return seepage.solve(MESH, 1e-5, [Reservoir(LEFT, level), Reservoir(RIGHT, 2)])


def lines(ax, colour):
    return [one.get_xydata() for one in ax.lines if to_hex(one.get_color()) == colour]


def flow_lines(ax):
    chosen = [c for c in ax.collections if isinstance(c, LineCollection)]
    return [c for c in chosen if to_hex(c.get_color()[0]) == style.LINES["orange"].lower()]


def limits(fig):
    """Lowest and highest number of the scale of colours."""
    return fig.axes[-1].get_ylim()


def test_a_seepage_has_its_free_surface_its_scale_and_what_lines_mean():
    result = dam(10)
    fig = water.seepage(result)
    ax = fig.axes[0]
    (line,) = (one for one in lines(ax, style.WATER))
    assert np.array_equal(line, result.phreatic_line()[0])
    assert (ax.get_xlim(), ax.get_ylim()) == (pytest.approx((-0.4, 20.4)), pytest.approx((-0.4, 10.4)))
    assert limits(fig) == (0, 10) and fig.axes[-1].get_ylabel() == "pressure head $p/γ_w$ [m]"
    told = [text.get_text() for text in ax.get_legend().get_texts()]
    assert told == ["equal head, a tenth of its range apart", "flow line", "free surface"]
    # flow lines lie in wet ground
    places = np.concatenate(flow_lines(ax)[0].get_segments())
    height = np.interp(places[:, 0], *line.T)
    assert len(places) > 100 and np.all(places[:, 1] < height + 0.6) and places[:, 1].min() > 0


def test_between_flow_lines_flows_the_same():
    """In uniform flow they are equally far apart, on the line of middle head; in two layers as these conduct."""
    ends = [Head(LEFT, 20), Head(RIGHT, 15)]
    places = water._equal_flows(seepage.solve(MESH, 1e-5, ends))
    assert places[:, 0] == pytest.approx(10) and sorted(places[:, 1]) == pytest.approx((np.arange(12) + 0.5) / 1.2)
    upper = MESH.nodes[MESH.triangles].mean(axis=1)[:, 1] > 8
    layered = Mesh.of(MESH.nodes, MESH.triangles, upper.astype(int))
    places = water._equal_flows(seepage.solve(layered, [1e-5, 2e-5], ends))
    assert (places[:, 1] > 8).sum() == 4  # 2 × 2 m of 8 + 2 × 2


def test_still_water_has_no_flow_lines():
    fig = water.seepage(dam(2))
    told = [text.get_text() for text in fig.axes[0].get_legend().get_texts()]
    assert told == ["free surface"]
    assert flow_lines(fig.axes[0]) == []


def test_pressures_at_times_have_one_scale_in_kilopascals():
    field = fields.of_seepage([dam(10), dam(4)], (0, 60))
    fig = water.pore_pressures(field)
    assert [ax.get_title(loc="left") for ax in fig.axes[:2]] == ["t = 0.0 s", "t = 60.0 s"]
    assert limits(fig) == (0, 100) and fig.axes[-1].get_ylabel() == "pore pressure [kPa]"  # 98.1 kPa
    fig = water.pore_pressures(field, times=[30])
    assert len(fig.axes) == 2 and limits(fig) == (0, 70)  # (98.1 + 39.2)/2 kPa


def test_the_layers_of_a_section_are_drawn():
    s = section.load("circle")
    fig = water.seepage(dam(10), s)
    (ring,) = (one for one in lines(fig.axes[0], style.INK) if len(one) == len(s.layers[0].vertices) + 1)
    assert np.array_equal(ring[:-1], s.layers[0].points)

    def rims(fig):
        found = [c for c in fig.axes[0].collections if isinstance(c, LineCollection)]
        return [c for c in found if to_hex(c.get_color()[0]) == to_hex(style.INK)]

    assert rims(fig) == []
    # without a section the border of the mesh is drawn
    (rim,) = rims(water.seepage(dam(10)))
    assert np.array_equal(np.array(rim.get_segments()), MESH.nodes[MESH.border]) and len(MESH.border) == 60


def test_the_frame_is_a_fiftieth_wider_than_the_mesh_wherever_that_is():
    away = Mesh.of(MESH.nodes + (1000.0, 300.0), MESH.triangles)
    solved = seepage.solve(away, 1e-5, [Head([(1000, 300), (1000, 310)], 308), Head([(1020, 300), (1020, 310)], 303)])
    ax = water.seepage(solved).axes[0]
    assert ax.get_xlim() == pytest.approx((1000 - 0.4, 1020 + 0.4)) and ax.get_ylim() == pytest.approx((299.6, 310.4))


def test_what_cannot_be_drawn(tmp_path):
    field = fields.of_seepage(dam(10))
    for call, message in (
        (lambda: water.seepage(field), "result MeshField.*: give a Seepage"),
        (lambda: water.pore_pressures(dam(10)), "field Seepage.*: give a MeshField"),
        (lambda: water.pore_pressures(field, times=[]), r"times \[\]: give a list of times"),
        (lambda: water.seepage(dam(10), "circle"), "section 'circle': give a Section"),
    ):
        with pytest.raises(RecordsError, match=message):
            call()
    assert water.seepage(dam(10), path=tmp_path / "a.png").stat().st_size > 10_000


def test_flow_lines_are_drawn_where_water_flows_and_none_where_it_stands():
    states = {0.0: dam(10), 5.0: dam(2)}
    field = fields.of_seepage(list(states.values()), list(states))

    def flow(time):
        return states[time].head, states[time].flux, states[time].wet, 1e-5

    fig = water.pore_pressures(field, flow=flow)
    assert [len(flow_lines(ax)) for ax in fig.axes[:2]] == [1, 0]
    assert not any(flow_lines(ax) for ax in water.pore_pressures(field).axes)
