"""Scenes of spheres as plain data: parameters, sizes, places, walls; results and reports of made-up runs."""
import dataclasses
import math

import numpy as np
import pytest
from yade.nonsmooth import errors
from yade.nonsmooth.studies.spheres import column, drum, grains, hopper, pile, places, report, study, walls

#: Those with gravity and a container.
KINDS = tuple(kind for kind in study.KINDS.values() if issubclass(kind, grains.SphereScene))
EACH = pytest.mark.parametrize("kind", KINDS, ids=[kind.KIND for kind in KINDS])


# ---- parameters ---------------------------------------------------------------------------------------


@EACH
@pytest.mark.parametrize(
    "wrong, said",
    (
        (dict(diameter=0), "^diameter 0: give a number from 1e-06 to 1000 m"),
        (dict(diameter=1e-300), "^diameter 1e-300: give a number from 1e-06 to 1000 m"),
        (dict(density=1e300), "^density 1e.300: give a number from 0.001 to 1e.06 kg/m³"),
        (dict(size_spread=0.5), "size_spread 0.5: give largest over smallest diameter"),
        (dict(friction=30), "friction 30: 30 is no coefficient of friction"),
        (dict(friction="0.5"), "friction '0.5': give 0 or more"),
        (dict(rolling_friction=-0.1), "rolling_friction -0.1"),
        (dict(twisting_friction=3), "twisting_friction 3: it is in mean diameters"),
        (dict(restitution=1), "restitution 1: give a number from 0 to less than 1"),
        (dict(seed=-1), "seed -1: give a whole number from 0"),
        (dict(seed=1.5), "seed 1.5"),
        (dict(gravity=math.nan), "gravity nan"),
        (dict(size=200), "size 200"),
    ),
)
def test_wrong_parameters_are_named(kind, wrong, said):
    with pytest.raises(grains.SpheresError, match=said):
        kind(**wrong)


@pytest.mark.parametrize(
    "make, said",
    (
        (lambda: column.RoundColumn(aspect=0), "aspect 0: give height over radius of the column, from 0.1 to 20"),
        (lambda: column.RoundColumn(aspect=20, size=100), "that is .* spheres; give values for 1 to 200000"),
        (lambda: hopper.RoundHopper(opening=20, size=8), "opening 20: give the opening's diameter .* 14.4"),
        (lambda: hopper.RoundHopper(opening=1.2), "opening 1.2: Beverloo's law, .* has no flow up to 1.4"),
        (lambda: drum.TurningDrum(filling=0.8), "filling 0.8: give the share of the drum that is filled"),
        (lambda: drum.TurningDrum(froude=0), "froude 0"),
        (lambda: drum.TurningDrum(turns=0), "turns 0"),
        (lambda: drum.TurningDrum(size=5, length=2).sites(np.full(400, 0.005)), "400 spheres do not fit .*, .* do"),
    ),
)
def test_wrong_shapes_are_named(make, said):
    with pytest.raises(grains.SpheresError, match=said):
        make()


@EACH
@pytest.mark.parametrize(
    "world, said",
    (
        (dict(name="firm"), "world 'firm': give hard or soft"),
        (dict(name="soft", stiffness=1e7, path=0.1), "path 0.1 with world 'soft': springs have no such value"),
        (dict(stiffness=1e7), "stiffness 10000000.0 with world 'hard': rigid spheres have no such value; .* 'soft'"),
        (dict(path=0), "path 0: give a number above 0"),
        (dict(reach=-1), "reach -1: give a number above 0"),
        (dict(name="soft", stiffness=1e7, reach=0.1), "reach 0.1 with world 'soft'"),
        (dict(tolerance="fine"), "tolerance 'fine'"),
        (dict(name="soft"), "stiffness None: the soft world needs Young's modulus"),
        (
            dict(name="soft", stiffness=1e3),
            "stiffness 1000 Pa: spheres at the bottom would overlap by .* give .* or more",
        ),
        (dict(name="soft", stiffness=1e300), "stiffness 1e.300: give a number above 0, to 1e.15 at most"),
        (dict(name="soft", stiffness=1e7, damping=1), "damping 1"),
        (dict(name="soft", stiffness=1e7, colour=1), "colour: no value of the soft world"),
    ),
)
def test_wrong_numerics_are_named_before_anything_is_computed(kind, world, said):
    with pytest.raises(errors.UserError, match=said):
        grains.world_of(kind(), **world)


def test_restitution_is_not_dropped_in_silence():
    with pytest.raises(errors.UserError, match="restitution 0.5 with soft contacts"):
        grains.world_of(column.RoundColumn(restitution=0.5), "soft", stiffness=1e7)
    assert grains.world_of(column.RoundColumn(restitution=0.5)).name == "hard"


def test_the_least_stiffness_that_is_named_is_taken():
    c = column.RoundColumn()
    with pytest.raises(grains.SpheresError) as refused:
        grains.world_of(c, "soft", stiffness=1e3)
    least = float(str(refused.value).split("give ")[1].split()[0])
    assert grains.world_of(c, "soft", stiffness=least).stiffness == least


def test_the_step_takes_a_sphere_over_a_tenth_of_a_diameter():
    c = column.RoundColumn(aspect=2, size=5, diameter=0.02)
    speed = math.sqrt(2 * 9.81 * 2 * 5 * 0.02)  # from the top
    assert grains.world_of(c).time_step * speed == pytest.approx(0.1 * 0.02, rel=1e-12)
    assert grains.world_of(c, path=0.3).time_step == pytest.approx(3 * grains.world_of(c).time_step, rel=1e-12)


@pytest.mark.parametrize(
    "world, duration, key, usual",
    (
        (dict(path=1e-9), None, "path", 0.1),
        (dict(name="soft", stiffness=1e15), None, "stiffness", 1e7),
        (dict(name="soft", stiffness=1e9, step_share=1e-6), None, "step_share", 0.5),
        (dict(), 1e9, "duration", 200.0),
    ),
)
def test_a_course_without_end_is_refused_with_what_would_do(world, duration, key, usual):
    c = hopper.RoundHopper()
    with pytest.raises(
        grains.SpheresError, match=f"^{key} .*: that is .* steps to the end of the course; give "
    ) as told:
        study.planned("one", "/tmp/none", c, world, duration)
    least = float(str(told.value).split("give ")[1].split()[0])
    # towards the usual value, and no further than need be: what is named is taken, and half of the way is not
    given = {**world, key: least} if key != "duration" else world
    assert study.planned("one", "/tmp/none", c, given, least if key == "duration" else duration)
    further = least * (2 if usual < least else 0.5)
    given = {**world, key: further} if key != "duration" else world
    with pytest.raises(grains.SpheresError, match=f"^{key}"):
        study.planned("one", "/tmp/none", c, given, further if key == "duration" else duration)


def test_spheres_that_do_not_fit_are_told_before_anything_runs():
    small = drum.TurningDrum(size=5, length=3, filling=0.5)
    with pytest.raises(grains.SpheresError, match="size 5, length 3, filling 0.5: .* do not fit into the container"):
        study.planned("one", "/tmp/none", small, {})
    assert study.planned("one", "/tmp/none", dataclasses.replace(small, filling=0.2), {})


def test_a_scene_is_asked_for():
    with pytest.raises(
        grains.SpheresError, match="'column': is no scene of spheres; give one of column, hopper, drum, pile, triaxial"
    ):
        study.planned("one", "/tmp/none", "column", {})
    with pytest.raises(grains.SpheresError, match="duration 0: give a number above 0"):
        study.planned("one", "/tmp/none", column.RoundColumn(), {}, duration=0)
    keys = {study.planned("one", "/tmp/none", column.RoundColumn(seed=k), {}).key for k in (1, 2)}
    assert len(keys) == 2


# ---- sizes and places ---------------------------------------------------------------------------------


def test_sizes_are_uniform_by_volume_and_have_their_mean():
    c = column.RoundColumn(aspect=5, size=12, size_spread=2.0, diameter=0.01)
    r = c.radii()
    low, high = c.diameters()
    assert len(r) == c.count() > 8000 and high / low == pytest.approx(2)
    assert low <= 2 * r.min() < 1.01 * low and 0.99 * high < 2 * r.max() <= high
    # a standard deviation of 18 %: 4 standard errors of 8,000 are 0.8 %
    assert 2 * r.mean() == pytest.approx(0.01, rel=0.008)
    volume = math.pi / 6 * (2 * r) ** 3
    assert volume.mean() == pytest.approx(c.mean_volume(), rel=0.03)
    # half of the volume is of spheres below the middle size
    assert volume[2 * r < (low + high) / 2].sum() / volume.sum() == pytest.approx(0.5, abs=0.02)
    assert np.array_equal(r, c.radii()) and not np.array_equal(r, dataclasses.replace(c, seed=2).radii())
    assert column.RoundColumn(size_spread=1).radii() == pytest.approx(0.005)


@EACH
def test_spheres_begin_apart_and_inside(kind):
    scene = kind(size=6, seed=3)
    r = scene.radii()
    at = scene.sites(r)
    from yade.nonsmooth.measure import sphere_heaps

    assert len(at) == len(r) == scene.count()
    assert len(sphere_heaps.gaps(at, r, 0.0)[0]) == 0
    assert scene.inside(at, r.max()).all()
    low = np.asarray(scene.box()[0])
    assert (at[:, 2] - r >= low[2]).all()


# ---- walls --------------------------------------------------------------------------------------------


def area(triangles):
    a, b, c = np.transpose(triangles, (1, 0, 2))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def test_walls_have_the_area_of_their_polygons_and_share_their_corners():
    n = walls.SEGMENTS
    polygon = 0.5 * n * math.sin(2 * math.pi / n)
    side = 2 * math.sin(math.pi / n)
    assert area(walls.disc(3.0)) == pytest.approx(polygon * 9, rel=1e-12)
    assert area(walls.annulus(1.0, 3.0)) == pytest.approx(polygon * 8, rel=1e-12)
    for axis in (1, 2):
        made = walls.mantle(3.0, -1.0, 4.0, axis)
        assert area(made) == pytest.approx(n * side * 3 * 5, rel=1e-12)
        assert set(np.round(made[:, :, axis], 12).ravel()) == {-1.0, 4.0}
        # two ends of n corners each, the last facet's bits those of the first
        assert len({tuple(corner) for corner in made.reshape(-1, 3)}) == 2 * n
    shared = {tuple(c) for c in walls.annulus(1.0, 3.0).reshape(-1, 3)}
    assert {tuple(c) for c in walls.disc(1.0).reshape(-1, 3)} - {(0, 0, 0)} <= shared


def test_room_is_the_distance_from_the_nearest_side():
    n, radius = walls.SEGMENTS, 2.0
    half = math.pi / n
    assert walls.inner(radius) == pytest.approx(radius * math.cos(half), rel=1e-12)
    towards_side = [math.cos(half), math.sin(half)]
    at = np.array([[0, 0], np.multiply(1.5, towards_side), [radius, 0], [3 * radius, 0]])
    # in the middle, half way to a side, in a corner, and outside
    assert walls.room(at, radius) == pytest.approx(
        [walls.inner(radius), walls.inner(radius) - 1.5, 0, walls.inner(radius) - 6 * math.cos(half)], abs=1e-12
    )


def test_the_opening_has_the_area_of_its_circle():
    h = hopper.RoundHopper(opening=6, diameter=0.01)
    n = walls.SEGMENTS
    assert 0.5 * n * math.sin(2 * math.pi / n) * h.hole() ** 2 == pytest.approx(math.pi * 0.03**2, rel=1e-12)


@EACH
def test_a_scene_stands_on_something_and_something_is_opened_or_turns(kind):
    made = walls.RoundWalls()
    kind().stand(made, 0.3)
    groups = {group for _, _, group in made.facets} | {group for *_, group in made.boxes}
    assert ("gate" in groups) != ("turning" in groups)
    assert (kind().sink() is None) == (kind in (column.RoundColumn, drum.TurningDrum))


# ---- rows and results ---------------------------------------------------------------------------------


def made_places(at, r=0.005, time=1.0):
    at = np.asarray(at, float)
    return places.Places(at, np.full(len(at), r), np.arange(len(at)), np.zeros(len(at)), time, 7)


def test_a_hopper_counts_what_has_left_and_is_over_when_nothing_leaves():
    h = hopper.RoundHopper(opening=6, diameter=0.01)
    row = h.row(made_places([(0, 0, 0.1), (0, 0, -0.01), (0.01, 0, -0.02)]), dict(out=5, out_kg=2.0))
    assert row["discharged_spheres"] == 7
    assert row["discharged_kg"] == pytest.approx(2 + 2 * 2500 * 4 / 3 * math.pi * 0.005**3, rel=1e-12)
    still = hopper.STILL * math.sqrt(0.06 / 9.81)
    rows = [(0.0, 0), (0.1, 5), (0.1 + 0.9 * still, 5)]
    assert not h.over(rows) and h.over([*rows, (0.1 + 1.1 * still, 5)])
    assert not h.over([*rows, (0.1 + 1.1 * still, 6)])


def test_the_bulk_density_of_one_sphere_by_its_cap():
    """A sphere of radius r at the height r, cut at 0.7 of that height: p = 0.35 of its diameter lies below."""
    h = hopper.RoundHopper(size=2, opening=2, diameter=0.01)
    r, n = 0.005, walls.SEGMENTS
    room = 0.5 * n * math.sin(2 * math.pi / n) * h.radius**2 * 0.7 * r
    part = 0.35**2 * (3 - 2 * 0.35)
    assert h.bulk_density(made_places([(0, 0, r)])) == pytest.approx(
        2500 * 4 / 3 * math.pi * r**3 * part / room, rel=1e-12
    )


def test_a_pile_is_measured_without_its_rim():
    """A cone of 30 degrees that ends two diameters high at the rim, as a wall."""
    p = pile.PlatePile(size=20, diameter=0.01)
    x, y = (one.ravel() for one in np.meshgrid(*[np.arange(-0.2, 0.2, 0.003)] * 2))
    far = np.hypot(x, y)
    inside = far < 0.2
    top = 0.02 + math.tan(math.radians(30)) * (0.2 - far)
    places_ = made_places(np.column_stack((x, y, top - 0.0025 / math.cos(math.radians(30))))[inside], 0.0025)
    row = p.row(dataclasses.replace(places_), {"out": 3})
    assert row["repose_deg"] == pytest.approx(30, abs=1) and row["lost_spheres"] == 3


def test_a_drum_takes_its_mean_over_the_second_half():
    d = drum.TurningDrum(froude=0.04, size=10, diameter=0.01, gravity=10.0)
    assert d.turning() == pytest.approx(math.sqrt(0.04 * 10 / 0.1), rel=1e-12)
    assert d.DURATION * math.sqrt(0.1 / 10) * d.turning() == pytest.approx(2 * math.pi * d.turns, rel=1e-12)
    turned = np.arange(0, 181, 10.0)
    tilt = np.where(turned < 90, 0, 30 + np.where(turned % 20 == 0, 1.0, -1.0))
    told = d.results({"turned_deg": turned, "tilt_deg": tilt, "tilt_surface_deg": tilt}, None, {})
    assert told["tilt_deg"] == pytest.approx(tilt[turned >= 90].mean()) and told["tilt_swing_deg"] == pytest.approx(1)
    # what lies to the left of the axis has a surface that rises to the left, against the turn
    row = d.row(made_places([(-0.03, 0, -0.04)], time=0.1), {})
    assert row["tilt_deg"] == pytest.approx(math.degrees(math.atan2(3, 4)), rel=1e-9)
    assert row["turned_deg"] == pytest.approx(math.degrees(0.1 * d.turning()), rel=1e-12)


def made_run(kind, seed, world="hard", **numbers):
    scene = kind(seed=seed, **{k: v for k, v in numbers.items() if k in {f.name for f in dataclasses.fields(kind)}})
    own = {name: None for name, _, _ in report.VALUES[kind.KIND]}
    return {
        "scene": scene.plain(), "world": world, "settings": {"tolerance": 1e-4}, "spheres": 100, "ended": True, "steps": 50,
        "wall_s": 3.0, "overlap_worst_rel": 0.001 * seed, "unit_s": 0.1, **own, **numbers,
    }  # fmt: skip


def test_seeds_are_taken_together_and_laws_stand_beside():
    runs = {
        f"a{a:g}-{seed}": made_run(column.RoundColumn, seed, aspect=a, runout_rel=2 * a**0.5 + 0.1 * (seed - 2), final_height_rel=0.5, repose_deg=20.0)
        for a in (2.0, 4.0, 8.0)
        for seed in (1, 2, 3)
    }  # fmt: skip
    summary = report.summarise(runs)
    assert [group["seeds"] for group in summary["groups"]] == [[1, 2, 3]] * 3
    group = summary["groups"][1]
    assert group["runout_rel"]["mean"] == pytest.approx(4.0) and group["overlap_worst_rel"] == pytest.approx(0.003)
    assert group["runout_rel"]["half_width"] == pytest.approx(
        4.303 * 0.1 / math.sqrt(3), rel=1e-3
    )  # Student, 2 degrees
    fit = summary["fits"]["runout_above"]
    # a pure square root but for the seeds' ± 0.1, which cancel to first order
    assert (fit["exponent"], fit["factor"]) == pytest.approx((0.5, 2.0), rel=0.01)
    assert (fit["published_exponent"], fit["published_factor"]) == (0.5, 1.6) and summary["fits"][
        "runout_below"
    ] is None
    ((_, header, rows),) = summary["tables"]
    assert len(header) == len(rows[0]) and rows[1][:3] == ["aspect 4", "100", "3"]
    assert rows[1][header.index("Lube et al.")] == "3.20"  # 1.6 · √4
    assert "runout above a = 1.7: 2.00 a^(0.500" in report.table(summary)


def test_a_mass_that_is_nowhere_half_a_diameter_high_has_no_run_out():
    """As spheres without friction, which spread without end: 40 of them lie far apart on the floor."""
    c = column.RoundColumn(aspect=1, size=2, friction=0.0, rolling_friction=0.0)
    k = np.arange(40)
    at = np.column_stack((0.2 * (k % 8 - 3.5), 0.2 * (k // 8 - 2), np.full(40, 0.005)))
    flat = places.Places(at, np.full(40, 0.005), k, np.zeros(40), 1.0, 100)
    row = c.row(flat, {})
    assert row["edge_m"] == 0
    series = {name: np.array([0.1, value]) for name, value in row.items()} | {"height_m": np.array([0.1, 0.01])}
    found = c.results(series, flat, {"height": 0.02})
    assert found["edge_m"] is None and found["runout_rel"] is None
    thick = c.results(series | {"edge_m": np.array([0.1, 0.05])}, flat, {"height": 0.02})
    assert (thick["edge_m"], thick["runout_rel"]) == pytest.approx((0.05, 0.05 / 0.02 - 1))
    summary = report.summarise({"a": made_run(column.RoundColumn, 1, **{**found, "aspect": 1.0})})
    assert summary["groups"][0]["runout_rel"]["mean"] is None and summary["fits"]["runout_above"] is None
    ((_, header, rows),) = summary["tables"]
    assert rows[0][header.index("run-out")] == "–"
    assert "no run-out, as the mass is nowhere half a mean diameter high: a" in report.table(summary)


@pytest.mark.parametrize("kind", (hopper.RoundHopper, drum.TurningDrum, pile.PlatePile))
def test_runs_without_an_answer_are_dashes(kind):
    runs = {str(seed): made_run(kind, seed) for seed in (1, 2)}
    summary = report.summarise(runs)
    ((_, header, rows),) = summary["tables"]
    assert "–" in rows[0] and len(header) == len(rows[0])
    with pytest.raises(grains.SpheresError, match="there are no runs"):
        report.summarise({})


def test_places_come_back_and_what_is_none_is_refused(tmp_path):
    written = made_places([(1, 2, 3), (4, 5, 6)], time=0.25)
    places.write(tmp_path / "snapshots" / "00000007.npz", written)
    places.write(tmp_path / "snapshots" / "end.npz", made_places([(1, 2, 3)]))
    first, last = places.read_all(tmp_path)
    assert np.array_equal(first.at, written.at) and (first.time_s, first.step, len(last)) == (0.25, 7, 1)
    (tmp_path / "wrong.npz").write_text("none")
    with pytest.raises(grains.SpheresError, match="wrong.npz: holds no places of spheres"):
        places.read(tmp_path / "wrong.npz")
    with pytest.raises(grains.SpheresError, match="has no snapshots"):
        places.read_all(tmp_path / "snapshots")
