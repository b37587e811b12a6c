"""The law drawn: thresholds, a bond's zone and the water's forces, read from the artists. Needs no YADE."""

import dataclasses
import math

import numpy as np
import pytest
from matplotlib.patches import Circle, Ellipse, Rectangle

import drawn
import synthetic_slope as synthetic

figures, parts, law = (synthetic.load(name) for name in ("figures", "model.section.parts", "figures.law"))
UserError = synthetic.load("errors").UserError
exact = dict(rel=1e-12, abs=1e-12)  # rounding
ROCK = parts.Material("rock", 0.5, 0.4, 0.2, 0.1, 120e3, 30e3, (0.02, 0.03), 0.05)
SIZE = 1.5  # m: F_a = 180 kN/m in a bond, 45 kN/m without
BOND, LOOSE = "bond", "touching, without a bond"
STATES = {BOND: (180.0, 0.5, 0.2), LOOSE: (45.0, 0.4, 0.1)}  # F_a [kN/m], μ_s, μ_r
GREEN, ORANGE, BLUE, INK = "#009e73", "#d55e00", "#0072b2", "#222222"


# ---- thresholds -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def thresholds():
    return figures.contact_law(ROCK, SIZE).axes


@pytest.mark.parametrize("state", STATES)
def test_bodies_part_under_the_tension_f_a_alone(thresholds, state):
    """Equation (1): N is at least −F_a without a velocity, and −F_a with one."""
    graph = drawn.points(drawn.line(thresholds[0], state))
    assert graph[:2, 0].tolist() == [0, 0] and graph[0, 1] > 180 and graph[-1, 0] > 0
    assert graph[1:, 1] == pytest.approx([-STATES[state][0]] * 2, **exact)
    assert thresholds[0].get_ylabel() == "normal force $N$ [kN/m]"
    assert drawn.text(thresholds[0], "opens, $N=-F_a$").get_position()[1] < -180  # under both lines
    low, high = thresholds[0].get_ylim()
    assert low < -180 - 0.1 * 180 and high == pytest.approx(graph[0, 1], **exact)


def test_a_bond_that_closes_bears_nothing_between_touch_and_its_length():
    ax = figures.contact_law(dataclasses.replace(ROCK, bonds_close=True), SIZE).axes[0]
    graph = drawn.points(drawn.line(ax, BOND))
    touch, length = graph[0, 0], graph[3, 0]
    assert touch < 0 < length < graph[-1, 0] and graph[1].tolist() == [touch, 0] and graph[2].tolist() == [length, 0]
    assert graph[0, 1] > 180 and graph[3:, 1] == pytest.approx([-180] * 2, **exact)
    assert [t.get_text() for t in ax.get_xticklabels()] == [
        "to touch",
        "0",
        "to length",
    ] and ax.get_xticks().tolist() == [touch, 0, length]
    assert drawn.points(drawn.line(ax, LOOSE))[:2, 0].tolist() == [0, 0]  # without a bond nothing changes


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("panel, unit", [(1, "$T$ [kN/m]"), (2, r"$\Gamma$ [kN m/m]")])
def test_shear_and_torque_are_against_their_velocities(thresholds, state, panel, unit):
    """Equations (3) and (5) with (4) and (6), at N = F_a of the bond."""
    adhesion, sliding, rolling = STATES[state]
    most = (sliding * (adhesion + 180), rolling * SIZE * (adhesion + 180))[panel - 1]
    graph = drawn.points(drawn.line(thresholds[panel], state))
    assert graph[:, 0].tolist() == [-1, 0, 0, 1]
    assert graph[:, 1] == pytest.approx([most, most, -most, -most], **exact)
    assert thresholds[panel].get_ylabel().endswith(unit) and thresholds[panel].get_title().endswith("$N$ = 180 kN/m")


@pytest.mark.parametrize("state", STATES)
def test_cones_have_their_vertex_at_f_a_and_rise_as_the_friction(thresholds, state):
    adhesion, sliding, rolling = STATES[state]
    for ax, slope in ((thresholds[4], sliding), (thresholds[5], rolling * SIZE)):
        above, vertex, below = drawn.points(drawn.line(ax, state))
        assert vertex == pytest.approx([-adhesion, 0], **exact)
        rises = [(side[1] - vertex[1]) / (side[0] - vertex[0]) for side in (above, below)]
        assert rises == pytest.approx([slope, -slope], **exact) and above[0] > 0
        (filled,) = (p for p in ax.patches if drawn.colour(p) == drawn.colour(drawn.line(ax, state)))
        assert filled.get_xy()[:3] == pytest.approx(np.array([above, vertex, below]), **exact)


def test_the_triangle_has_the_slope_of_the_bonds_cone(thresholds):
    for ax, slope in ((thresholds[4], 0.5), (thresholds[5], 0.2 * SIZE)):
        low, corner, high = drawn.points(drawn.line(ax, "slope"))
        assert low[0] == corner[0] and corner[1] == high[1]
        assert (high[1] - low[1]) / (high[0] - low[0]) == pytest.approx(slope, **exact)
        assert low[1] == pytest.approx(slope * (180 + low[0]), **exact)  # it stands on the cone


def test_tension_grows_with_the_diameter(thresholds):
    """Equation (2), with a dot at the diameter of the other panels."""
    for state, stress in ((BOND, 120.0), (LOOSE, 30.0)):
        line = drawn.points(drawn.line(thresholds[3], state))
        assert line == pytest.approx(np.array([[0, 0], [2 * SIZE, stress * 2 * SIZE]]), **exact)
    dots = [drawn.points(one)[0] for one in thresholds[3].lines if one.get_marker() == "o"]
    assert np.array(dots) == pytest.approx(np.array([[SIZE, 180], [SIZE, 45]]), **exact)


def test_the_legend_has_the_materials_numbers():
    told = drawn.legend(figures.contact_law(ROCK, SIZE))
    assert told == {
        r"bond: $\sigma$ = 120 kPa, $\mu_s$ = 0.5, $\mu_r$ = 0.2": BLUE,
        r"touching, without a bond: $\sigma$ = 30 kPa, $\mu_s$ = 0.4, $\mu_r$ = 0.1": ORANGE,
    }


def test_a_contact_that_is_never_bonded_has_one_curve():
    """Nothing cohesive: the cone begins at zero, and 100 kPa times ℓ are on the contact; a small one has small
    units.
    """
    wall = dataclasses.replace(ROCK, bonded=False, residual_tensile_strength=0.0)
    axes = figures.contact_law(wall, 0.02).axes
    assert [[one.get_label() for one in ax.lines if one.get_label() == BOND] for ax in axes] == [[]] * 6
    graph = drawn.points(drawn.line(axes[1], LOOSE))
    assert graph[0, 1] == pytest.approx(0.4 * 100e3 * 0.02, **exact) and axes[1].get_ylabel().endswith("[N/m]")
    assert drawn.points(drawn.line(axes[4], LOOSE))[1].tolist() == [0, 0]
    assert axes[3].get_ylim() == (0, 1)  # nothing there to be seen
    # one that is cohesive when it touches
    axes = figures.contact_law(dataclasses.replace(ROCK, bonded=False), SIZE).axes
    assert drawn.points(drawn.line(axes[4], LOOSE))[1] == pytest.approx([-45, 0], **exact)


# ---- the bond's zone ------------------------------------------------------------------------------


def disks(ax):
    """Centres (n, 2) of the disks of diameter 1 (ℓ), as drawn."""
    return np.array([p.center for p in ax.patches if isinstance(p, Circle) and p.get_radius() == 0.5])


def test_a_bond_is_made_over_a_gap_below_delta():
    whole, begin, _ = figures.bond_zone(ROCK, gap=0.04).axes
    i, j, k = disks(whole)
    gaps = [math.dist(*pair) - 1 for pair in ((i, j), (i, k), (j, k))]
    assert gaps[0] == pytest.approx(0.04, **exact) and min(gaps[1:]) > ROCK.bond_creation_distance * 1.5
    (reach,) = (p for p in whole.patches if isinstance(p, Circle) and p.get_radius() != 0.5)
    assert np.array_equal(reach.center, i) and reach.get_radius() == pytest.approx(0.55, **exact)
    bar = drawn.points(drawn.line(whole, "bond"))
    assert i[0] < bar[0, 0] < 0.5 < j[0] - 0.5 < bar[1, 0] < j[0]
    # the two measures of the window begin at P_i
    (delta, colour), (most, green) = ((arrow[:2], arrow[2]) for arrow in drawn.arrows(begin))
    assert (colour, green) == (INK, GREEN)
    assert delta[0][0] == pytest.approx(0.5, **exact) and delta[1][0] == pytest.approx(0.54, **exact)
    assert most[0][0] == pytest.approx(0.5, **exact) and most[1][0] == pytest.approx(0.55, **exact)
    assert begin.get_xlabel() == r"$\delta$ = 0.04 $\ell$, $\Delta$ = 0.05"


@pytest.mark.parametrize("zone", [(0.02, 0.03), (0.05, 0.01)])
def test_the_zone_has_the_materials_half_axes_around_the_place_of_p_j(zone):
    whole, _, later = figures.bond_zone(dataclasses.replace(ROCK, bond_ellipse=zone), gap=0.04).axes
    (ellipse,) = (p for p in later.patches if type(p) is Ellipse)
    assert (ellipse.width / 2, ellipse.height / 2, ellipse.angle) == pytest.approx((*zone, 0), **exact)
    assert {"$i$", "$j$", "$k$"} <= set(drawn.texts(whole))
    i, now, then = disks(later)  # the disk that stays, j as it is, j as it was
    assert then == pytest.approx([1.04, 0], **exact) and ellipse.center == pytest.approx([0.54, 0], **exact)
    ((tail, head, _, _),) = drawn.arrows(later)  # of P_j, which goes with its disk
    assert tail == pytest.approx(ellipse.center, **exact) and head - tail == pytest.approx(now - then, **exact)
    assert 0.2 < np.sum(((head - tail) / zone) ** 2) < 0.8  # clearly in the zone, and clearly moved
    # all of it is seen, and the frame of the whole picture is this window
    (frame,) = (p for p in whole.patches if isinstance(p, Rectangle))
    (x0, x1), (y0, y1) = later.get_xlim(), later.get_ylim()
    assert frame.get_xy() == pytest.approx((x0, y0), **exact) and frame.get_width() == pytest.approx(x1 - x0, **exact)
    assert x0 < 0.5 and 0.54 + zone[0] < x1 and zone[1] < y1
    assert later.get_xlabel().endswith(rf"$\epsilon_n$ = {zone[0]:g}, $\epsilon_t$ = {zone[1]:g}")


# ---- water ----------------------------------------------------------------------------------------


def water(dip, **others):
    """Of the slope and of the sums: {colour: (tail, head)} of the thick arrows, and the axes."""
    fig = figures.water_forces(dip, **others)
    told = [{c: (tail, head) for tail, head, c, look in drawn.arrows(ax) if look == "-|>"} for ax in fig.axes]
    return fig, *told


@pytest.mark.parametrize("dip", [21.0, -21.0, 50.0])
def test_buoyancy_and_seepage_make_a_force_normal_to_the_slope(dip):
    """γ_w V up and γ_w V sin β down the slope have no part along the slope left over, and γ_w V cos β normal to it;
    with the weight, in one scale.
    """
    fig, at_disk, summed = water(dip)
    (top, foot) = drawn.points(drawn.line(fig.axes[0], "plane"))
    down = (foot - top) / math.dist(top, foot)
    assert down[1] < 0 and np.sign(down[0]) == np.sign(dip)
    assert math.degrees(math.asin(-down[1])) == pytest.approx(abs(dip), **exact)
    for arrows in (at_disk, summed):
        force = {c: head - tail for c, (tail, head) in arrows.items()}
        one = force[GREEN][1]  # of γ_w V
        assert force[GREEN] == pytest.approx([0, one], **exact) and one > 0
        assert force[ORANGE] / one == pytest.approx(math.sin(math.radians(abs(dip))) * down, **exact)
        assert force[BLUE] == pytest.approx(force[GREEN] + force[ORANGE], **exact)
        assert force[BLUE] @ down == pytest.approx(0, abs=1e-12 * one) and force[BLUE][1] > 0
        assert math.hypot(*force[BLUE]) / one == pytest.approx(math.cos(math.radians(dip)), **exact)
    assert at_disk[INK][1] - at_disk[INK][0] == pytest.approx(
        [0, -2500 / 1000 * (at_disk[GREEN][1][1] - at_disk[GREEN][0][1])], **exact
    )
    # at the disk all begin at its centre; in the sum the seepage begins where the buoyancy ends
    (disk,) = (p for p in fig.axes[0].patches if isinstance(p, Circle))
    assert all(tail == pytest.approx(disk.center, **exact) for tail, _ in at_disk.values())
    assert summed[ORANGE][0] == pytest.approx(summed[GREEN][1], **exact)
    assert summed[ORANGE][1] == pytest.approx(summed[BLUE][1], **exact)


def test_a_slope_to_the_left_is_the_mirrored_one():
    right, left = (figures.water_forces(dip) for dip in (30.0, -30.0))

    def mirrored(points):
        return np.asarray(points) * (-1, 1)

    for a, b in zip(right.axes, left.axes):
        for one, other in zip(drawn.arrows(a), drawn.arrows(b), strict=True):
            assert other[0] == pytest.approx(mirrored(one[0]), **exact) and other[2:] == one[2:]
            assert other[1] == pytest.approx(mirrored(one[1]), **exact)
        for one, other in zip(a.texts, b.texts, strict=True):
            assert other.get_position() == pytest.approx(mirrored(one.get_position()), **exact)
            assert (one.get_text(), one.get_rotation()) == (other.get_text(), -other.get_rotation() % 360)
        assert b.get_xlim() == pytest.approx(tuple(-np.array(a.get_xlim()[::-1])), **exact)
    assert drawn.texts(left) == drawn.texts(right)


def test_the_height_of_the_water_is_along_the_normal():
    fig = figures.water_forces(21.0)
    slope = fig.axes[0]
    ((foot, head, _, _),) = (arrow for arrow in drawn.arrows(slope) if arrow[3] == "<|-|>")

    def above(name, point):
        """Distance from a line, to its left as it falls to the right."""
        begin, end = drawn.points(drawn.line(slope, name))
        (a, b), (c, d) = end - begin, point - begin
        return (a * d - b * c) / math.hypot(a, b)

    assert above("plane", foot) == pytest.approx(0, abs=1e-9) and above("water table", head) == pytest.approx(
        0, abs=1e-9
    )
    way = np.diff(drawn.points(drawn.line(slope, "plane")), axis=0)[0]
    assert (head - foot) @ way == pytest.approx(0, abs=1e-9)
    assert drawn.text(slope, "water table").get_rotation() == pytest.approx(360 - 21, **exact)  # along its line
    (disk,) = (p for p in slope.patches if isinstance(p, Circle))
    assert above("plane", disk.center) > 0 > above("water table", disk.center)  # the disk is wet


def test_the_words_have_the_forces():
    """Of a disk of 2 m, V = π m² per metre: ρ g V, γ_w V, and these times sine and cosine of 30°."""
    told = drawn.texts(figures.water_forces(-30.0, density=2000.0, unit_weight=10e3, gravity=10.0))
    values = {t.split("=")[0].strip("$"): float(t.split("=")[-1].removesuffix(" kN/m")) for t in told}
    known = {"W": 20, "F_b": 10, "F_s": 5, "F_p": 10 * math.sqrt(3) / 2}
    assert values == pytest.approx({name: math.pi * f for name, f in known.items()}, abs=0.051)  # one digit
    (small,) = (t for t in drawn.texts(figures.water_forces(21.0, diameter=0.02)) if t.startswith("$W"))
    assert small.endswith("= 7.7 N/m")


def test_level_water_lifts_alone():
    fig, at_disk, summed = water(0.0)
    assert set(at_disk) == {INK, GREEN, BLUE} and set(summed) == {GREEN, BLUE}
    assert summed[GREEN][1] == pytest.approx(summed[BLUE][1], **exact)
    assert not any("beta" in t or t == "$F_s$" for ax in fig.axes for t in drawn.texts(ax))
    assert {"$W$", "$F_b$", "$F_p$"} <= set(drawn.texts(fig.axes[0]))
    tilted = figures.water_forces(21.0)
    assert {"$W$", "$F_b$", "$F_s$", "$F_p$"} <= set(drawn.texts(tilted.axes[0]))


# ---- all ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "draw, message",
    [
        (lambda: figures.contact_law(ROCK, 0.0), "diameter = 0 m: it must be positive"),
        (lambda: figures.bond_zone(ROCK, gap=0.05), "gap = 0.05 ℓ: no bond .* below Δ = 0.05"),
        (lambda: figures.bond_zone(ROCK, gap=-0.01), "gap = -0.01 ℓ"),
        (lambda: figures.water_forces(90.0), "dip = 90°: it must lie between"),
        (lambda: figures.water_forces(-90.0), "dip = -90°: it must lie between"),
        (lambda: figures.water_forces(21.0, unit_weight=-1.0), "unit_weight = -1: it must be positive"),
    ],
)
def test_what_cannot_be_drawn_is_told(draw, message):
    with pytest.raises(UserError, match=message):
        draw()


@pytest.mark.parametrize(
    "draw",
    [
        lambda path: figures.contact_law(ROCK, SIZE, path),
        lambda path: figures.bond_zone(ROCK, path=path),
        lambda path: figures.water_forces(21.0, path=path),
    ],
)
def test_words_are_on_the_picture_and_not_on_each_other(draw, tmp_path):
    fig = draw(None)
    fig.draw_without_rendering()
    whole = fig.bbox
    boxes = []
    for one in fig.texts + [t for ax in fig.axes for t in (*ax.texts, ax.title, ax.xaxis.label, ax.yaxis.label)]:
        if one.get_text() and one.get_rotation() in (0, 90):
            boxes.append((one.get_text(), one.get_window_extent()))
    for text, box in boxes:
        assert whole.x0 <= box.x0 and box.x1 <= whole.x1 and whole.y0 <= box.y0 and box.y1 <= whole.y1, text
    for k, (text, box) in enumerate(boxes):
        assert not [other for other, b in boxes[:k] if box.overlaps(b)], text
    assert draw(tmp_path / "law.png") == tmp_path / "law.png" and (tmp_path / "law.png").stat().st_size > 1000
