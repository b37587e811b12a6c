"""Seepage against exact answers: uniform flow, layers, dams, rain, artesian pressure; symmetry, scale, balance; and
what is refused. Needs no YADE.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.water import conditions, equations, seepage  # noqa: E402
from nonsmooth.water.conditions import Head, Inflow, PressureHead, Rain, Reservoir, SeepageFace  # noqa: E402
from nonsmooth.water.mesh import Mesh, grid  # noqa: E402

#: Upstream, downstream, width [m]: height of the free surface at a quarter, half and three quarters, and where it ends,
#: by the obstacle problem extrapolated over four grids.
DAMS = {
    (24, 4, 16): ((22.58, 20.42, 17.47), 12.79),
    (10, 2, 5): ((9.546, 8.852, 7.893), 6.36),
    (10, 2, 10): ((9.193, 8.021, 6.468), 3.99),
}


def crumpled(width, height, across, up, seed=1, by=0.25):
    """A grid whose inner nodes are moved at random, by up to so much of a cell."""
    mesh = grid(np.linspace(0, width, across + 1), np.linspace(0, height, up + 1))
    x, y = mesh.nodes.T
    inner = (x > 1e-9) & (x < width - 1e-9) & (y > 1e-9) & (y < height - 1e-9)
    moves = np.random.default_rng(seed).uniform(-by, by, (len(x), 2)) * (width / across, height / up)
    return Mesh.of(mesh.nodes + np.where(inner[:, None], moves, 0), mesh.triangles)


def dam(upstream, downstream, width, size, conductivity=1.0, **options):
    """A rectangular dam between two reservoirs, on its grid."""
    mesh = grid(np.linspace(0, width, round(width / size) + 1), np.linspace(0, upstream, round(upstream / size) + 1))
    left, right = [(0, 0), (0, upstream)], [(width, 0), (width, upstream)]
    given = [Reservoir(left, upstream), Reservoir(right, downstream)]
    return seepage.solve(mesh, conductivity, given, **options), left, right


def surface(result, x):
    (line,) = result.phreatic_line()
    return np.interp(x, *line.T)


# ---- uniform flow ---------------------------------------------------------------------------------


@pytest.mark.parametrize("turned", (0, 30, 77, -140))
def test_uniform_flow_is_exact_for_any_direction_of_flow_and_bedding(turned):
    """A parallelogram with two sides along the flux and two across the gradient: whatever the conductivity, the head is
    linear and the flux −K ∇h, on any mesh, to rounding.
    """
    conductivity = seepage.tensor(3e-4, 5e-6, dip=turned)
    rise = np.array([-0.3, 0.05])
    flux = -conductivity @ rise
    along = 8 * flux / np.hypot(*flux)
    across = 5 * np.array([-rise[1], rise[0]]) / np.hypot(*rise)
    square = crumpled(1, 1, 7, 6)
    mesh = Mesh.of(square.nodes @ np.array([along, across]), square.triangles)
    heads = 60 + np.array([0, rise @ along])  # far above the body: all of it is wet
    given = [Head([a, a + across], h) for a, h in zip((np.zeros(2), along), heads)]
    result = seepage.solve(mesh, conductivity, given)
    assert result.wet.min() == 1.0
    assert result.head == pytest.approx(60 + mesh.nodes @ rise, rel=1e-12)
    assert result.flux == pytest.approx(
        np.broadcast_to(flux, result.flux.shape), rel=1e-9, abs=1e-12 * np.abs(flux).max()
    )
    # what flows in: the flux through the length that it sees
    seen = abs(flux[0] * across[1] - flux[1] * across[0])
    assert result.through == pytest.approx(seen, rel=1e-10)
    middle = 0.5 * along
    ends = [middle - 0.1 * across, middle + 1.1 * across]
    sign = 1 if flux[0] * across[1] - flux[1] * across[0] > 0 else -1
    assert result.discharge(ends) == pytest.approx(sign * seen, rel=1e-9)
    assert result.discharge(ends[::-1]) == pytest.approx(-sign * seen, rel=1e-9)


def two_layers(lower):
    """A box of 12 by 4 m under water, its triangles of layer 0 where ``lower`` of their centres holds."""
    mesh = grid(np.linspace(0, 12, 13), np.linspace(0, 4, 9))
    x, y = mesh.nodes[mesh.triangles].mean(axis=1).T
    return Mesh.of(mesh.nodes, mesh.triangles, np.where(lower(x, y), 0, 1), ("sand", "clay"))


def test_layers_along_the_flow_add_up_and_layers_across_it_add_their_resistances():
    ends = [Head([(0, 0), (0, 4)], 20), Head([(12, 0), (12, 4)], 14)]
    along = seepage.solve(two_layers(lambda x, y: y < 1), [1e-3, 1e-6], ends)
    assert along.through == pytest.approx(0.5 * (1e-3 * 1 + 1e-6 * 3), rel=1e-10)
    across = seepage.solve(two_layers(lambda x, y: x < 3), [1e-3, 1e-6], ends)
    assert across.through == pytest.approx(4 * 6 / (3 / 1e-3 + 9 / 1e-6), rel=1e-10)


# ---- dams -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("case, size", [((24, 4, 16), 0.5), ((10, 2, 5), 0.25), ((10, 2, 10), 0.25)], ids=str)
def test_the_discharge_the_free_surface_and_the_exit_of_dams(case, size):
    upstream, downstream, width = case
    result, left, right = dam(upstream, downstream, width, size)
    heights, out = DAMS[case]
    exact = (upstream**2 - downstream**2) / (2 * width)  # whatever the free surface
    assert result.inflow_on(left) == pytest.approx(exact, rel=5e-4)  # 0.02 % measured; dry ground conducts a little
    assert surface(result, width * np.array([0.25, 0.5, 0.75])) == pytest.approx(heights, rel=1e-3)
    x, y = result.exit_point(right)
    assert x == width and y == pytest.approx(out, abs=0.6 * size)  # the nearest node, mostly
    # Dupuit's surface has no seepage face, and ends in the lower reservoir
    dupuit = math.sqrt(upstream**2 - (upstream**2 - downstream**2) / 2)
    assert surface(result, width / 2) > 1.05 * dupuit
    assert result.pressure_head[np.isin(np.arange(len(result.head)), result.mesh.border)].min() > -upstream


def test_a_dam_converges_with_the_mesh():
    errors = []
    for size in (2, 1, 0.5):
        result, *_ = dam(24, 4, 16, size)
        errors.append(np.abs(surface(result, [4, 8, 12]) - (22.592, 20.431, 17.477)).max())
    assert errors[0] > 1.8 * errors[1] > 1.8**2 * errors[2] and errors[2] < 0.006


def test_what_comes_in_is_what_leaves():
    result, left, right = dam(24, 4, 16, 1)
    assert result.residual < 1e-10
    assert math.fsum(result.exchanged) == pytest.approx(0, abs=1e-11 * result.through)
    assert result.inflow_on(left) == pytest.approx(-result.inflow_on(right), rel=1e-11)
    # across a line in the middle, to the accuracy of the mesh
    assert result.discharge([(8.1, 0), (8.1, 24)]) == pytest.approx(17.5, rel=0.01)


def test_the_mirrored_dam_is_the_mirrored_answer():
    one, left, right = dam(10, 2, 5, 0.5)
    mesh = grid(np.linspace(0, 5, 11), np.linspace(0, 10, 21))
    other = seepage.solve(mesh, 1.0, [Reservoir(left, 2), Reservoir(right, 10)])
    mirrored = other.head.reshape(21, 11)[:, ::-1].ravel()
    assert mirrored == pytest.approx(one.head, rel=1e-9)
    assert other.flux[:, 0].sum() == pytest.approx(-one.flux[:, 0].sum(), rel=1e-9)


def test_a_dam_of_twice_the_size_has_twice_the_discharge_and_ground_of_a_millionth_a_millionth():
    one, *_ = dam(10, 2, 5, 0.5)
    large, *_ = dam(20, 4, 10, 1.0)
    assert np.array_equal(large.head, 2 * one.head) and large.through == 2 * one.through  # powers of two: no rounding
    fine, *_ = dam(10, 2, 5, 0.5, conductivity=1e-6)
    assert fine.head == pytest.approx(one.head, rel=1e-9) and fine.through == pytest.approx(
        1e-6 * one.through, rel=1e-9
    )


def test_the_same_input_gives_the_same_bits():
    one, other = (dam(10, 2, 10, 0.5)[0] for _ in range(2))
    assert np.array_equal(one.head, other.head) and np.array_equal(one.exchanged, other.exchanged)


def test_a_course_of_levels_is_that_of_its_states():
    mesh = grid(np.linspace(0, 10, 21), np.linspace(0, 10, 21))
    left, right = [(0, 0), (0, 10)], [(10, 0), (10, 10)]
    states = [[Reservoir(left, level), Reservoir(right, 2)] for level in (10, 8, 5, 2)]
    found = seepage.course(mesh, 1e-4, states)
    for level, given, one in zip((10, 8, 5, 2), states, found):
        alone = seepage.solve(mesh, 1e-4, given)
        assert one.head == pytest.approx(alone.head, abs=1e-6)
        assert one.inflow_on(left) == pytest.approx(1e-4 * (level**2 - 4) / 20, rel=2e-3, abs=1e-9)
    assert np.ptp(found[-1].head) == pytest.approx(0, abs=1e-6)  # still water
    assert found[1].iterations < alone.iterations + 25


# ---- rain, artesian pressure -----------------------------------------------------------------------


@pytest.mark.parametrize("rate", (5e-4, 5e-3, 0.02))
def test_rain_on_a_dam_leaves_on_both_sides(rate, monkeypatch):
    """By Girinsky's potential the discharges are exactly those of Dupuit and Forchheimer: (H₁² − H₂²)/2L ∓ N L/2."""
    monkeypatch.setattr(seepage, "FALLING", 0.0)  # at the first go
    mesh = grid(np.linspace(0, 100, 51), np.linspace(0, 16, 17))
    left, right = [(0, 0), (0, 16)], [(100, 0), (100, 16)]
    given = [Reservoir(left, 10), Reservoir(right, 8), Rain([(0, 16), (100, 16)], rate)]
    result = seepage.solve(mesh, 1.0, given)
    base, half = (10**2 - 8**2) / 200, rate * 100 / 2
    assert result.inflow_on(left) == pytest.approx(base - half, abs=1e-3 * (base + half))
    assert result.inflow_on(right) == pytest.approx(-base - half, rel=1e-3)
    assert math.fsum(result.given) == pytest.approx(100 * rate, rel=1e-12)
    x = np.array([20.0, 50, 80])
    dupuit = np.sqrt(100 - 36 * x / 100 + rate * x * (100 - x))
    assert surface(result, x) == pytest.approx(dupuit, rel=0.012)  # the body is ten times as long as high


def test_rain_that_the_ground_does_not_take_runs_off():
    mesh = grid(np.linspace(0, 20, 11), np.linspace(0, 4, 9))
    top = [(0, 4), (20, 4)]
    given = [Reservoir([(0, 0), (0, 4)], 1), Reservoir([(20, 0), (20, 4)], 1), Rain(top, 0.9)]
    result = seepage.solve(mesh, 1.0, given)
    assert result.inflow_on(top) < -0.3 * 20 * 0.9 and result.pressure_head.max() == pytest.approx(4, rel=0.3)
    assert result.pressure_head[mesh.nodes[:, 1] == 4].max() < 1e-3  # no water stands on it
    assert math.fsum(np.concatenate((result.exchanged, result.given))) == pytest.approx(0, abs=1e-10 * result.through)


def test_what_flows_through_a_body_is_what_rain_brings_and_a_face_lets_out():
    """40 m of a hill under rain of 2e-7 m/s, which leaves on a face to the right; misfits are told by it."""
    mesh, rain = grid(np.linspace(0, 40, 21), np.linspace(0, 10, 11)), 2e-7
    given = [Rain([(0, 10), (40, 10)], rain), SeepageFace([(40, 0), (40, 10)])]
    result = seepage.solve(mesh, 1e-5, given)
    tensors = np.broadcast_to(1e-5 * np.eye(2), (len(mesh.triangles), 2, 2))
    problem = equations.Equations(mesh, tensors, conditions.apply(mesh, given))
    assert problem.flow(result.head, 1e-3) == pytest.approx(rain * 40, rel=1e-6)
    higher = result.head + 1e-6  # off by a little: of each node's balance
    worst = np.abs(problem.parts(higher, 1e-3)[0][problem.free]).max()
    assert problem.residual(higher, 1e-3) == pytest.approx(worst / problem.flow(higher, 1e-3), rel=1e-12)


def test_rain_falls_on_the_horizontal_and_inflow_goes_through_the_line():
    """A slope of 3 in 4: its length is 5/4 of what rain sees; an overhang gets none."""
    square = grid(np.linspace(0, 4, 5), np.linspace(0, 2, 3))
    tilted = Mesh.of(square.nodes @ np.array([[1.0, 0.75], [0.0, 1.0]]), square.triangles)
    top, base = [(0, 2), (4, 5)], [(0, 0), (4, 3)]
    for given, expected in ((Rain(top, 2e-3), 8e-3), (Inflow(top, 2e-3), 1e-2), (Rain(base, 2e-3), 0)):
        assert conditions.apply(tilted, [given, Head([(0, 0), (0, 2)], 9)]).inflow.sum() == pytest.approx(
            expected, abs=1e-15
        )


def test_an_artesian_base_has_its_pressure_everywhere_and_the_body_a_linear_one():
    square = crumpled(6, 3, 8, 6)
    mesh = Mesh.of(square.nodes + (0, 20), square.triangles)
    result = seepage.solve(mesh, 2e-5, [PressureHead([(0, 20), (6, 20)], 4.5), SeepageFace([(0, 23), (6, 23)])])
    y = square.nodes[:, 1]
    assert result.pressure_head == pytest.approx(4.5 * (1 - y / 3), abs=2e-4 * 4.5)  # the face's κ is 1e4 times k/size
    assert result.through == pytest.approx(2e-5 * 6 * (4.5 - 3) / 3, rel=1e-3)


def test_still_water_has_its_level_everywhere_and_does_not_flow():
    mesh = crumpled(6, 3, 8, 6)
    result = seepage.solve(mesh, 1e-4, [Reservoir([(0, 0), (0, 3)], 2.1), Reservoir([(6, 0), (6, 3)], 2.1)])
    assert result.head == pytest.approx(2.1, rel=1e-9) and result.through < 1e-12
    (line,) = result.phreatic_line()
    assert line[:, 1] == pytest.approx(2.1, rel=1e-9) and line[[0, -1], 0] == pytest.approx((0, 6))
    assert result.pressure(9810.0) == pytest.approx(9810 * np.maximum(2.1 - mesh.nodes[:, 1], 0), abs=1e-4)
    assert result.exit_point([(6, 0), (6, 3)]) is None


# ---- what is refused ------------------------------------------------------------------------------

BOX = grid(np.linspace(0, 2, 3), np.linspace(0, 1, 3))
LEFT, RIGHT, TOP = [(0, 0), (0, 1)], [(2, 0), (2, 1)], [(0, 1), (2, 1)]


@pytest.mark.parametrize(
    "given, message",
    [
        ([], "conditions give no head anywhere: add"),
        ([Inflow(LEFT, 1e-6)], "conditions give no head anywhere: add"),
        (None, "conditions None: give a list of Reservoir"),
        (["rain"], r"conditions\[0\] 'rain': give Reservoir"),
        (
            [Head([(0.5, 0), (0.5, 1)], 3)],
            r"conditions\[0\], Head: no edge of the border lies on its line from \(0.5, 0\) to \(0.5, 1\) m; give",
        ),
        ([Head(LEFT, 3), Reservoir(LEFT, 2)], r"Reservoir: conditions\[0\] lies on the border at \(0, 0.75\) m too"),
        ([Head(LEFT, 3), Head(TOP, 2)], r"Head: the node at \(0, 1\) m has the head 3 m already"),
    ],
)
def test_conditions_that_do_not_hold_together(given, message):
    with pytest.raises(conditions.ConditionError, match=message):
        seepage.solve(BOX, 1e-5, given)


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: Head([(0, 0)], 3), r"Head: line \[\(0, 0\)\]: give two points or more"),
        (lambda: Head("left", 3), "Head: line 'left': give numbers of shape"),
        (lambda: Reservoir(LEFT, math.nan), "Reservoir: level nan: give a finite number"),
        (lambda: Rain(TOP, -1e-6), "Rain: rate -1e-06: give a finite number, 0 or more"),
        (lambda: Inflow(TOP, None), "Inflow: rate None: give a finite number"),
    ],
)
def test_conditions_without_sense(make, message):
    with pytest.raises(conditions.ConditionError, match=message):
        make()


@pytest.mark.parametrize(
    "conductivity, options, message",
    [
        (-1e-5, {}, "conductivity -1e-05: give a number above 0"),
        ([1e-5, -2e-5], {}, "conductivity has 2 entries: give one number or tensor .* 1 layers"),
        ([-2e-5], {}, "conductivity of layer 0 -2e-05: give a number above 0"),
        (np.array([[1e-5, 2e-5], [2e-5, 1e-5]]), {}, "conductivity array.*give a number above 0"),
        (np.array([[1e-5, 1e-6], [0, 1e-5]]), {}, "conductivity array.*give a number above 0"),
        ("fast", {}, "conductivity 'fast': give a number above 0"),
        (1e-5, {"dry": 0}, "dry 0: give a share above 0"),
        (1e-5, {"tolerance": 0.1}, "tolerance 0.1: give 1e-12 to 1e-3"),
        (1e-5, {"start": [1, 2]}, r"start of shape \(2,\): give a finite head for each of 9 nodes"),
    ],
)
def test_conductivities_and_options_without_sense(conductivity, options, message):
    with pytest.raises(seepage.SeepageError, match=message):
        seepage.solve(BOX, conductivity, [Head(LEFT, 3), Head(RIGHT, 2)], **options)


def test_what_is_no_mesh():
    with pytest.raises(seepage.SeepageError, match="mesh 'circle': give a Mesh"):
        seepage.solve("circle", 1e-5, [Head(LEFT, 3)])


def test_tensors():
    assert seepage.tensor(3, 1, 90) == pytest.approx(np.diag((1, 3)), abs=1e-12)
    # bedding that dips down to the right leads water down
    assert (seepage.tensor(3, 1, 30) @ (1, 0))[1] < 0
    with pytest.raises(seepage.SeepageError, match="across 0: give a conductivity above 0"):
        seepage.tensor(1, 0)


def test_water_that_drips_from_a_seam_of_clay_falls_through_dry_ground(monkeypatch):
    """It does not converge where dry ground conducts a thousandth in all directions."""
    mesh = grid(np.linspace(0, 40, 21), np.linspace(0, 20, 21))
    y = mesh.nodes[mesh.triangles].mean(axis=1)[:, 1]
    seam = Mesh.of(mesh.nodes, mesh.triangles, np.where((y > 8) & (y < 10), 1, 0))
    left, right = [(0, 0), (0, 20)], [(40, 0), (40, 20)]
    given = [Reservoir(left, 18), Reservoir(right, 3)]
    result = seepage.solve(seam, [1.0, 3e-3], given)
    # between what the sand carries, its part below the seam under pressure alone, and a body of sand
    assert 8 * 15 / 40 < result.inflow_on(left) < (18**2 - 3**2) / 80
    assert result.inflow_on(left) == pytest.approx(-result.inflow_on(right), rel=1e-9)
    # near the low side the seam hangs over dry ground, through which falls what it lets through
    x = mesh.nodes[mesh.triangles].mean(axis=1)[:, 0]
    seeps, falls = ((x > 36) & (y > low) & (y < low + 1) for low in (9, 7))
    assert result.wet[falls].max() < 1e-6
    through, on = (float((result.flux[rows, 1] * mesh.area[rows]).sum()) for rows in (seeps, falls))
    assert on == pytest.approx(through, rel=0.06) and on < 0  # dry sand lets a little go aside
    monkeypatch.setattr(seepage, "FALLING", 0.0)
    with pytest.raises(seepage.Unconverged, match="or a larger dry share"):
        seepage.solve(seam, [1.0, 3e-3], given)


def test_what_does_not_converge_says_how_far_it_is_off(monkeypatch):
    monkeypatch.setattr(equations, "TRIED", 1)
    with pytest.raises(
        seepage.Unconverged, match="did not converge: after .* iterations .* of the flow.* give a finer"
    ) as told:
        dam(10, 2, 5, 1)
    assert told.value.iterations >= 1 and told.value.residual > 0
