"""Slopes of any section: shipped ones, mirrored and similar ones, with walls of any name and role, without water,
weakening or backstop.
"""

import argparse
import json

import numpy as np
import pytest
import shell
from slope_scenes import SMALL, write_changed
from yade import O
from yade.nonsmooth import experiment, records, run_figures, scene, section, similar, tables
from yade.nonsmooth.commands import section_arguments
from yade.nonsmooth.figures import style
from yade.nonsmooth.packing_files import Packing
from yade.nonsmooth.studies.slope import results, slope, slope_packing
from yade.nonsmooth.world.stepping import advance

import drawn

SLOPE = "slope.py"
pytestmark = pytest.mark.usefixtures("empty")


def run(made, out, end=None):
    """A section's run in this process, its summary and the names of its figures; nothing is drawn."""
    out.mkdir()
    course = experiment.begin(made, out)
    course.run(end)
    state = vars(course.state)
    return records.read_series(out / "series.csv"), results.summarise(out, made, state)


def written(tmp_path, change):
    """The small slope with its data changed."""
    return section.load(str(write_changed(tmp_path, change)))


def test_shipped_sections_are_listed(in_process):
    done = in_process(SLOPE, "--list")
    assert done.status == 0 and done.out.split() == section.shipped() and len(section.shipped()) >= 4
    assert in_process(SLOPE).status == 2  # which one?


@pytest.mark.parametrize(
    "name, disks, end",
    [
        ("acads_1a", 300, 5.0),
        ("acads_1c", 300, 5.0),
        ("chair", 500, 9.4),
        ("circle", 500, 4.0),
        ("flume", 500, 0.7),
        ("griffiths_lane", 300, 5.0),
        ("interface", 1500, 5.3),
        ("jiufengershan", 300, 0.5),
        ("rain", 500, 5.0),
        ("reservoir", 500, 5.0),
        ("undercut", 400, 3.2),
        ("vaiont", 400, 12.0),
    ],
)
def test_every_shipped_section_begins(name, disks, end, in_process, monkeypatch, tmp_path):
    """Up to where its water begins to rise, with all figures (the paper's section, which has tests of its own, up to
    its first rows).
    """
    kept = drawn.keep(monkeypatch, style)
    out = tmp_path / "out"
    done = in_process(SLOPE, "--section", name, "--disks", disks, "--end", end, "--out", out)
    assert done.status == 0, done.err
    made = section.load(name)
    walls = records.read_walls(out / "walls.csv")
    rows = [*made.walls, *made.interfaces, *(layer for layer in made.layers if layer.role == "obstacle")]
    assert set(walls["wall"]) == {row.name for row in rows} and (np.diff(walls["step"]) >= 0).all()
    if name == "jiufengershan":
        assert "300 disks, no bulk between their edges" in done.out  # so few are two to a layer
        return
    told = json.loads((out / "summary.json").read_text())
    assert told["times_s"]["t0"] is not None and told["failed_dry_s"] is None, told
    assert {"force_chains.png", "forces.png", "snapshots.png", "energy.png", "solver.png"} <= set(kept)
    assert ("water.png" in kept) == (made.water_field is not None)
    assert ("weakening.png" in kept) == bool(made.weakening)
    assert [ax.get_ylabel() for ax in (kept["weakening.png"].axes if made.weakening else ())] == [
        f"along {one.name},\nfrom its upper end [m]" for one in made.weakening
    ]
    # a wall of a few metres has no room for its name beside those of its neighbours
    corners = [np.asarray(wall.vertices, float) for wall in made.walls]
    wide = np.ptp(np.concatenate(corners)[:, 0])
    long = [np.hypot(*np.diff(c, axis=0).T).sum() > 0.1 * wide for c in corners]
    names = [style.plain(wall.name) for wall, named in zip(made.walls, long) if named]
    said = " ".join(
        drawn.texts(kept["snapshots.png"].axes[0])
        + [t.get_text() for t in kept["snapshots.png"].legends[0].get_texts()]
    )
    assert all(word in said for word in names), (names, said)
    labels = {line.get_label() for ax in kept["forces.png"].axes for line in ax.lines}
    assert (
        made.water is None
        and any("$N$ (" in label or label.startswith("$N_") for label in labels)
        or any(
            label.startswith("$N'$" if "," in kept["forces.png"].texts[0].get_text() else "$N'_") or "$N'$ (" in label
            for label in labels
        )
    )
    assert any("backstop" in t.get_text() for t in kept["forces.png"].texts) == bool(made.of_role("backstop"))


@pytest.mark.parametrize("name", ["vaiont", "circle"])
def test_a_mirrored_slope_of_other_disks_has_the_diameters_of_the_slope(name):
    """To the last bit, though the areas of mirrored outlines differ there."""
    parser = argparse.ArgumentParser()
    section_arguments.add(parser)
    here, there = (
        section_arguments.read(parser.parse_args(["--section", name, "--disks", "300", *more]))
        for more in ([], ["--mirror"])
    )
    assert there.side == -here.side and (here.disks.d_min, here.disks.d_max) == (there.disks.d_min, there.disks.d_max)


def test_a_mirrored_slope_has_the_mirrored_bits(whole, tmp_path):
    """From its packing to its rest, by the command in a process of its own."""
    done = shell.run(SLOPE, "--section", SMALL, "--mirror", "--out", tmp_path, "--threads", 1, "--no-figures")
    assert done.returncode == 0, done.stderr
    here, there = whole.series, records.read_series(tmp_path / "series.csv")
    for name, values in here.items():
        assert np.array_equal(-there[name] if name in ("front_m", "centroid_x_m") else there[name], values), name
    one, other = (records.read_snapshot(folder / "end.npz") for folder in (whole.folder, tmp_path))
    assert (
        np.array_equal(one.x, -other.x)
        and np.array_equal(one.y, other.y)
        and np.array_equal(one.vx, -other.vx)
        and np.array_equal(one.angle, -other.angle)
    )
    left, right = (records.read_breaks(folder / "breaks.csv") for folder in (whole.folder, tmp_path))
    assert np.array_equal(left["x_m"], -right["x_m"]) and all(
        np.array_equal(left[k], right[k]) for k in ("step", "disk1", "disk2", "mode", "y_m")
    )
    walls = [records.read_walls(folder / "walls.csv") for folder in (whole.folder, tmp_path)]
    for wall in ("DP", "FB", "SS"):
        rows = [{k: v[w["wall"] == wall] for k, v in w.items()} for w in walls]
        assert all(np.array_equal(rows[0][k], rows[1][k], equal_nan=k != "wall") for k in rows[0])
    told = json.loads((tmp_path / "summary.json").read_text())
    for name in (
        "times_s",
        "front_travel_m",
        "centroid_travel_m",
        "deposit_thickness_max_m",
        "bulking_factor",
        "water_at_failure_m",
        "dp_shear_dry_N_per_m",
    ):
        assert told[name] == whole.summary[name], name
    assert told["front_travel_m"] > 1


def test_strips_of_a_mirrored_slope_are_mirrored():
    """A slope of so many contacts that sweeps go strip by strip."""
    here = section.load("jiufengershan").with_disks(1200)
    found = []
    for made in (here, similar.mirrored(here)):
        built = slope.build(made, slope_packing.of(made))
        advance()
        built.solver.bond()
        advance(30)
        found.append(tables.bodies(built.solver))
    assert built.solver.contacts > 1024
    one, other = found
    for name, sign in (("x", -1), ("y", 1), ("vx", -1), ("vy", 1), ("angle", -1), ("omega", -1)):
        assert np.array_equal(one[name], sign * other[name]), name
    assert np.hypot(one["vx"], one["vy"]).max() > 1e-3


def test_rows_of_walls_are_the_series_by_wall(whole):
    walls, series = records.read_walls(whole.folder / "walls.csv"), whole.series

    def of(wall, name):
        return walls[name][walls["wall"] == wall]

    assert len(walls["step"]) == 3 * len(series["step"]) and np.array_equal(of("FB", "step"), series["step"])
    for wall, column in (("DP", "dp_normal_effective"), ("FB", "fb_normal"), ("SS", "ss_normal")):
        assert (
            np.array_equal(of(wall, "normal_N_per_m"), series[f"{column}_N_per_m"])
            and of(wall, "normal_N_per_m").max() > 0
        )
    for wall, column in (("DP", "dp_shear"), ("FB", "fb_shear"), ("SS", "ss_shear")):
        assert np.array_equal(of(wall, "shear_N_per_m"), series[f"{column}_N_per_m"])
    assert np.array_equal(of("DP", "slip_mean_m"), series["slip_mean_dp_m"]) and np.array_equal(
        of("DP", "weakened_disks"), series["weakened_disks"]
    )
    share = of("DP", "weakened_share")
    assert (
        share[0] == 0
        and 0 < share.max() <= 1
        and (np.diff(share[series["time_s"] > whole.summary["weakening_begins_s"]]) > -0.2).all()
    )
    assert np.isnan(of("FB", "slip_mean_m")).all() and np.isnan(of("SS", "weakened_share")).all()


def test_a_role_of_two_walls_has_their_sum(tmp_path):
    """DP in two parts, at a vertex in its middle: the same slope, its forces added up."""

    def cut(data):
        data["walls"][:1] = [
            dict(name=name, material="dp", vertices=points, role="slip")
            for name, points in (("upper", [[-40.0, 18.652], [-20.0, 9.326]]), ("lower", [[-20.0, 9.326], [0.0, 0.0]]))
        ]
        data["water"]["plane"] = "lower"

    series, told = run(written(tmp_path, cut), tmp_path / "out", 1.0)
    walls = records.read_walls(tmp_path / "out" / "walls.csv")

    def of(wall, name):
        return walls[name][walls["wall"] == wall]

    for name, column in (("normal_N_per_m", "dp_normal_effective_N_per_m"), ("shear_N_per_m", "dp_shear_N_per_m")):
        assert of("upper", name) + of("lower", name) == pytest.approx(series[column], rel=1e-12)  # rounding
        assert of("upper", name)[-1] > 0 and of("lower", name)[-1] > 0
    peak = series["dp_normal_peak_N_per_m"]
    assert (peak <= (of("upper", "normal_peak_N_per_m") + of("lower", "normal_peak_N_per_m")) * (1 + 1e-12)).all()
    assert (peak >= series["dp_normal_effective_N_per_m"] * (1 - 1e-12)).all() and (
        peak[1:] > of("lower", "normal_peak_N_per_m")[1:]
    ).all()


def bare(data):
    """Walls of other names, no water, no weakening, no backstop, all of it left of x = 0."""
    del data["water"], data["stages"]["water"], data["materials"]["dp"]["slip_weakening"]
    for item in (*data["walls"], *data["layers"]):
        item["vertices"] = [[x - 200.0, y] for x, y in item["vertices"]]
    data["walls"] = [
        dict(name="bed of $rock_1", material="dp", vertices=data["walls"][0]["vertices"]),
        dict(name="flat", material="ss", vertices=[[-200.0, 0.0], [-140.0, 2.0]]),
    ]
    data["layers"] = [
        dict(
            name="soil", material="rock", vertices=[[-200.0, 0.0], [-202.0, 3.5], [-234.31, 20.4122], [-236.0, 16.7868]]
        )
    ]
    data["materials"]["dp"]["friction"] = 0.2


def test_a_slope_without_water_weakening_and_backstop(monkeypatch, tmp_path):
    """It slides by its weight: numbers that have no meaning are null, and all figures are drawn."""
    kept = drawn.keep(monkeypatch, style)
    made = written(tmp_path, bare)
    assert [wall.role for wall in made.walls] == ["slip", "ground"]
    series, told = run(made, tmp_path / "out", 6.0)
    assert told["failed_dry_s"] is not None and told["times_s"]["t4"] is not None and told["front_travel_m"] > 5
    for name in (
        "water_at_failure_m",
        "fb_force_dry_N_per_m",
        "fb_force_at_failure_N_per_m",
        "fb_force_final_N_per_m",
        "weakening_begins_s",
        "triggering_s",
    ):
        assert told[name] is None, name
    assert (
        "water_passive_m" not in told and not series["fb_normal_N_per_m"].any() and not series["dp_water_N_per_m"].any()
    )
    assert series["dp_shear_N_per_m"].max() > 0 and series["front_m"].max() < 0
    drawn_files, notes = run_figures.draw(tmp_path / "out", made, told)
    assert {"forces.png", "snapshots.png", "energy.png", "solver.png"} <= set(kept) and len(drawn_files) >= 5
    assert "weakening.png" not in kept  # nothing weakens
    labels = {line.get_label() for ax in kept["forces.png"].axes for line in ax.lines}
    assert not any("U" in label or "h_w" in label or "FB" in label for label in labels) and any(
        "bed of" in label for label in labels
    )


def test_a_slope_of_another_size_does_the_same_until_it_fails(whole, tmp_path):
    """At a hundredth of the size, lengths, times and forces come down by 100, 10 and 10⁴. Rounding is another one, so
    all is the same as far as it is for disks that were shifted by the last bit: bounds are twice the widest of what
    eleven sizes from 0.01 to 0.3 gave, before bonded disks were turned as one and after. That nothing has a unit that
    does not go along is the next test's."""
    small = similar.scaled(section.load(str(SMALL)), 0.01)
    O.reset()
    series, told = run(small, tmp_path / "out")
    big = whole.summary
    assert told["contacts_initial"] == pytest.approx(big["contacts_initial"], abs=2) and told["disks"] == big["disks"]
    for name, factor, scatter in (
        ("fb_force_dry_N_per_m", 1e-4, 0.06),  # 164 to 170 kN/m
        ("dp_shear_dry_N_per_m", 1e-4, 0.01),  # 1,114 to 1,119 kN/m
        ("water_passive_m", 1e-2, 1e-6),
        ("packing_fraction", 1.0, 2e-4),
        ("water_at_failure_m", 1e-2, 0.06),  # 2.72 to 2.81 m
        ("front_travel_m", 1e-2, 0.5),  # 5.3 to 8.0 m
    ):
        assert told[name] / big[name] == pytest.approx(factor, rel=scatter), name
    for name in ("t0", "t1", "t2"):
        assert 10 * told["times_s"][name] == pytest.approx(big["times_s"][name], abs=0.3)  # 0.1 to 0.16 s apart


# powers of the size with which what a run tells grows, by the unit in its name
GROWS = {"N_per_m": 2, "m_per_s": 0.5, "J": 3, "s": 0.5, "m": 1}


def power_of(name):
    return next((power for unit, power in GROWS.items() if name.endswith("_" + unit)), 0)


def test_a_slope_of_a_64th_of_the_size_has_its_bits_in_proportion(whole, tmp_path):
    """From its packing to its rest. Lengths in the ratio of a power of four, times and speeds then of a power of two,
    are the only ones that rounding leaves in proportion: a number with a unit that does not go along is seen, at
    whatever time it acts."""
    size = 1 / 64
    O.reset()
    series, told = run(similar.scaled(section.load(str(SMALL)), size), tmp_path / "out")
    for name, values in whole.series.items():
        assert np.array_equal(series[name], values * size ** power_of(name)), name
    one, other = (records.read_snapshot(folder / "end.npz") for folder in (whole.folder, tmp_path / "out"))
    for name, power in {"x": 1, "y": 1, "r": 1, "vx": 0.5, "vy": 0.5, "angle": 0, "cn": 2, "ct": 2}.items():
        assert np.array_equal(getattr(other, name), getattr(one, name) * size**power), name
    for name in ("front_travel_m", "deposit_thickness_max_m", "water_at_failure_m", "dp_shear_dry_N_per_m"):
        assert told[name] == pytest.approx(whole.summary[name] * size ** power_of(name), rel=1e-12), name
    assert told["front_travel_m"] > 1 * size


def test_disks_have_mass_and_inertia_in_proportion_to_the_bit():
    """Some in ten thousand had not, with a power function that rounds in its own way."""
    rock = scene.material(section.load("jiufengershan").materials["rock"])
    for radius in np.random.default_rng(1).uniform(0.1, 10, 10_000):
        big, small = (scene.disk((0, 0), r, rock).state for r in (float(radius), float(radius) / 64))
        assert small.mass == big.mass / 64**2 and small.inertia[2] == big.inertia[2] / 64**4


# powers of the size with which numbers of a scene grow (Froude); all others have no unit, or one that does not depend
# on it
POWERS = {
    "dt": 0.5,
    "NonsmoothTimeStepper.smallest": 0.5,
    "NonsmoothTimeStepper.largest": 0.5,
    "ContactDynamicsEngine.correctionSpeed": 0.5,
    "PorePressureEngine.releaseDistance": 1.0,
    "NscdMat.tensileStrength": 1.0,
    "NscdMat.residualTensileStrength": 1.0,
    "SlipWeakeningMat.tensileStrength": 1.0,
    "SlipWeakeningMat.criticalSlip": 1.0,
}


def numbers_of_the_scene(chosen):
    """(class and attribute, which one of the class, value) of all numbers that engines, their functors and materials
    have.
    """
    x, y = chosen.layers[0].polygon.representative_point().coords[0]
    slope.build(chosen, Packing([x], [y], [1e-3 * chosen.smallest], [0]))
    dispatchers = ("lawDispatcher", "geomDispatcher", "physDispatcher", "boundDispatcher")
    things = [*O.engines, *O.materials]
    things += [f for e in O.engines for name in dispatchers for f in getattr(getattr(e, name, None), "functors", ())]
    return [("dt", 0, O.dt)] + [
        (f"{type(one).__name__}.{name}", k, value)
        for k, one in enumerate(things)
        for name, value in one.dict().items()
        if isinstance(value, (int, float))
    ]


def test_every_number_of_a_scene_goes_with_its_size():
    big = section.load("jiufengershan")
    found, grown = numbers_of_the_scene(similar.scaled(big, 0.0625)), numbers_of_the_scene(big)
    assert [row[:2] for row in found] == [row[:2] for row in grown] and {row[0] for row in found} >= set(POWERS)
    for (name, _, small), (_, _, large) in zip(found, grown):
        assert small == pytest.approx(large * 0.0625 ** POWERS.get(name, 0), rel=1e-12, nan_ok=True), name
