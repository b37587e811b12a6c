"""Parts of a summary that made-up slopes of other kinds need: a table that falls, walls without losses, beds, no
backstop, soft contacts, a slope to the left; and what a run leaves in its folder. Needs no YADE."""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import known_slope  # noqa: E402
import synthetic_slope as synthetic  # noqa: E402

records, results, run_files, similar, toe = (
    synthetic.load(name)
    for name in ("records", "studies.slope.results", "studies.slope.run_files", "model.section.similar", "measure.toe")
)
SHIPPED, STATE = known_slope.SHIPPED, known_slope.STATE
SAME = 1e-9  # relative: rounding


def summary_of(folder, section=SHIPPED, series=None, start=known_slope.begin, stop=known_slope.end, **state):
    """The summary of the known run, but for what is given."""
    folder.mkdir(exist_ok=True)
    known_slope.write(folder, series, start, stop)
    return results.summarise(folder, section, STATE | state)


def changed(**columns):
    """The known series with other columns, functions of the time [s]."""
    series = known_slope.series()
    return series | {name: values(series["time_s"]) for name, values in columns.items()}


# ---- water --------------------------------------------------------------------------------------------
def test_the_highest_water_is_not_the_last(tmp_path):
    """A table that rises to 12 m at 34 s and is let down to 3 m; and one that fell before it rose, and was highest
    while it settled, before t0.
    """
    falls = changed(water_m=lambda t: np.interp(t, (10, 34, 50, 60), (0, 12, 12, 3)))
    found = summary_of(tmp_path, series=falls)
    assert found["water_highest_m"] == pytest.approx(12.0, rel=SAME)
    assert found["water_at_failure_m"] == pytest.approx(0.5 * 19.1, rel=SAME)  # at t1, 29.1 s
    early = changed(water_m=lambda t: np.where(t < 4, 40.0, np.interp(t, (10, 34), (0, 12))))
    assert summary_of(tmp_path, series=early)["water_highest_m"] == pytest.approx(12.0, rel=SAME)


def test_a_slope_that_slid_before_the_water_has_no_water_at_failure(tmp_path):
    found = summary_of(tmp_path, failed_dry=3.0)
    assert found["water_highest_m"] is None and found["water_at_failure_m"] is None


# ---- the toe's strength -------------------------------------------------------------------------------
def test_without_a_packing_fraction_the_toes_strength_is_that_of_the_sections(tmp_path):
    """The toe's weight goes with the fraction, and all of its strength with its weight but for the cohesion."""
    envelope = SHIPPED.materials["rock"].envelope
    for fraction in (0.8, None):
        found = summary_of(tmp_path, packing_fraction=fraction)
        wanted = toe.passive(
            SHIPPED, envelope.cohesion, envelope.friction_deg, fraction or SHIPPED.disks.packing_fraction
        )
        assert (found["water_passive_m"], found["passive_resistance_dry_N_per_m"], found["passive_force_N_per_m"]) == (
            wanted.water_m,
            wanted.resistance_dry,
            wanted.push_N_per_m,
        )
        assert found["water_at_failure_over_passive"] == pytest.approx(9.55 / wanted.water_m, rel=SAME)
        assert found["fb_force_at_failure_over_passive"] == pytest.approx(
            found["fb_force_at_failure_N_per_m"] / wanted.push_N_per_m, rel=SAME
        )
        assert found["packing_fraction"] == fraction


def test_a_toe_without_a_height_or_a_push_has_no_ratio_to_it(tmp_path, monkeypatch):
    bare = toe.passive(SHIPPED, 85.9e3, 37.2, 0.84)
    monkeypatch.setattr(results.toe, "passive", lambda *_: dataclasses.replace(bare, water_m=None, push_N_per_m=None))
    found = summary_of(tmp_path)
    for name in (
        "water_passive_m",
        "water_at_failure_over_passive",
        "passive_force_N_per_m",
        "fb_force_at_failure_over_passive",
    ):
        assert name in found and found[name] is None
    assert found["passive_resistance_dry_N_per_m"] == bare.resistance_dry


def test_without_a_backstop_there_is_no_force_on_one(tmp_path):
    """The same records; the wall at the foot is ground."""
    walls = tuple(dataclasses.replace(w, role="ground") if w.role == "backstop" else w for w in SHIPPED.walls)
    found = summary_of(tmp_path, dataclasses.replace(SHIPPED, walls=walls))
    backstop = [name for name in found if name.startswith("fb_")]
    assert len(backstop) == 4 and all(found[name] is None for name in backstop)
    assert found["toe_bands"] is None and not [name for name in found if "passive" in name]
    assert all(value is None for name, value in found["force_stages"].items() if name.startswith("backstop"))
    assert found["dp_shear_dry_N_per_m"] == pytest.approx(440e6 + 0.9e6, rel=SAME)  # that of the plane is told


def test_bands_in_the_toe_are_told_with_their_numbers(tmp_path, monkeypatch):
    """A band in a toe of which nothing else turns has no contrast that a file could hold; one beside others has."""
    band = results.toe_bands.ToeBand(28.0, (1.0, 2.0), (0.6, 0.8), 6.0, -0.3, math.inf)
    other = dataclasses.replace(band, inclination_deg=40.0, width=8.0, rotation=0.2, contrast=5.0)
    seen = []

    def find(*shots):
        seen.append([shot.time_s for shot in shots[:2]])
        return band, other

    monkeypatch.setattr(results.toe_bands, "find", find)
    (tmp_path / "snapshots").mkdir()
    series = known_slope.series()
    for time in (29.1, 30.5, 39.1):  # t1, t2 and t3; t0 has a file of its own, at time 0 here
        step = int(series["step"][np.argmin(np.abs(series["time_s"] - time))])
        path = tmp_path / "snapshots" / f"{step:08d}.npz"
        records.write_snapshot(path, time_s=time, step=step, water_m=0.0, **known_slope.begin())
    told = {
        "towards_foot": {"inclination_deg": 28.0, "width_d": 6.0, "rotation_rad": -0.3, "contrast": None},
        "conjugate": {"inclination_deg": 40.0, "width_d": 8.0, "rotation_rad": 0.2, "contrast": 5.0},
        "both_conjugate": None,  # there are too few disks to say
        "rankine_deg": 45 - 37.2 / 2,
    }
    found = summary_of(tmp_path)
    assert found["toe_bands"] == told == found["toe_bands_triggering"] and seen == [[29.1, 39.1], [0.0, 30.5]]
    # by the rule for samples: equally steep to 10°, and both there
    monkeypatch.setattr(results.toe_bands, "FEWEST", 0)
    for one, both in ((dataclasses.replace(other, inclination_deg=38.0), True), (other, False), (None, False)):
        monkeypatch.setattr(results.toe_bands, "find", lambda *_, one=one: (band, one))
        assert summary_of(tmp_path)["toe_bands"]["both_conjugate"] is both
    monkeypatch.undo()
    monkeypatch.setattr(results.toe_bands, "find", find)
    rock = dataclasses.replace(SHIPPED.materials["rock"], envelope=None)
    bare = dataclasses.replace(SHIPPED, materials={**SHIPPED.materials, "rock": rock})
    assert summary_of(tmp_path, bare)["toe_bands"] == told | {"rankine_deg": None}


# ---- walls and contacts -------------------------------------------------------------------------------
def test_what_slides_on_each_wall_is_that_of_its_last_row(tmp_path):
    """Losses add up in a run, so the last row has all; a wall whose world does not tell them has none. So has the heat
    of walls with slip laws.
    """
    blank = dict.fromkeys(known_slope.WALL_COLUMNS, 0.0)
    steps = ({"DP": 1.0, "SS": 30.0, "lake": None}, {"DP": 5.0, "SS": 40.0, "lake": None}, {"DP": 7.5})
    with records.SeriesWriter(tmp_path / "walls.csv", known_slope.WALL_COLUMNS, overwrite=True) as writer:
        for k, losses in enumerate(steps):
            rows = (
                blank | {"step": k, "wall": wall, "energy_sliding_J": e, "heat_J": 2 * e if wall == "DP" else None}
                for wall, e in losses.items()
            )
            writer.write(*rows)
    told = summary_of(tmp_path)
    assert told["sliding_on_walls_J_per_m"] == {"DP": 7.5, "SS": 40.0}
    assert told["heat_on_walls_J_per_m"] == {"DP": 15.0}


def test_soft_contacts_have_no_energies_and_no_solver(tmp_path):
    """Their series has no losses; all that follows from motion alone is the same."""
    series = {name: values for name, values in known_slope.series().items() if name not in records.LOSSES}
    soft, hard = summary_of(tmp_path, series=series), summary_of(tmp_path)
    gone = {
        "iterations_mean",
        "residual_p95",
        "residual_N_per_m_p95",
        "residual_p95_over_tolerance",
        "energy_dissipated_J_per_m",
        "energy_losses_J_per_m",
        "energy_correction_rel",
        "energy_error_rel",
    }
    assert all(soft[name] is None and hard[name] is not None for name in gone)
    assert {k: v for k, v in soft.items() if k not in gone} == {k: v for k, v in hard.items() if k not in gone}


def test_a_run_without_rows_is_refused(tmp_path):
    none = {name: values[:0] for name, values in known_slope.series().items()}
    with pytest.raises(records.RecordsError, match="series.csv: has no rows yet; let the run go on with --resume"):
        summary_of(tmp_path, series=none)
    assert not (tmp_path / "summary.json").exists()


def test_a_mirrored_slope_has_the_same_summary(tmp_path):
    """Left and right exchanged in the section, the series and the snapshots."""

    def mirror(made):
        return lambda: {n: -v if n in ("x", "angle", "vx") else v for n, v in made().items()}

    series = {n: -v if n in ("front_m", "centroid_x_m") else v for n, v in known_slope.series().items()}
    here = summary_of(tmp_path / "here")
    there = summary_of(
        tmp_path / "there",
        similar.mirrored(SHIPPED),
        series,
        mirror(known_slope.begin),
        mirror(known_slope.end),
        front0=-STATE["front0"],
    )
    for name in set(here) - {"section"}:
        assert there[name] == (
            pytest.approx(here[name], rel=1e-7) if isinstance(here[name], float) else here[name]
        ), name


# ---- beds ---------------------------------------------------------------------------------------------
def bedded(side=1):
    """The shipped section whose lowest layer is a bed of 1000 kg/m³ and disks of 2 to 8 m, √(2 · 8) m in the mean, and
    whose second is an obstacle; the others are the mass, of 2000 kg/m³ and disks of 1 to 4 m, 2 m in the mean."""
    disks = dataclasses.replace(SHIPPED.disks, d_min=2.0, d_max=8.0, distribution="uniform_by_volume")
    bed = dataclasses.replace(SHIPPED.layers[0], role="bed", material="gravel", disks=disks)
    house = dataclasses.replace(SHIPPED.layers[1], role="obstacle")
    rock = dataclasses.replace(SHIPPED.materials["rock"], density=2000.0)
    made = dataclasses.replace(
        SHIPPED,
        layers=(bed, house, *SHIPPED.layers[2:]),
        materials={**SHIPPED.materials, "rock": rock, "gravel": dataclasses.replace(rock, density=1000.0)},
    )
    return made if side > 0 else similar.mirrored(made)


@pytest.mark.parametrize("side", [1, -1])
def test_what_a_bed_gives_and_what_lies_beyond_the_foot(tmp_path, side):
    """Disks of a bed whose mean diameter is 4 m are entrained once they went 8 m, along a slanting way; disks of the
    mass never are. Deposited is of the mass alone what lies beyond the foot, at x = 0."""
    way = np.array([0.6, -0.8])
    start, moved, layer, r = (
        np.array([[-100, 90], [-90, 80], [-80, 70], [-70, 60], [-60, 50], [-50, 40], [-9, 9]], float),
        np.array([8.1, 7.9, 500.0, 100.0, 4.1, 0.0, 14.9]),
        np.array([0, 0, 0, 1, 2, 3, 4]),
        np.array([1.0, 2.0, 1.5, 1.0, 2.0, 0.5, 1.2]),
    )
    # beyond the foot comes the third, of the bed; the last one, of the mass, stops 6 cm short of it
    end = start + moved[:, None] * way

    def shot(places):
        return synthetic.few(side * places[:, 0], places[:, 1], r=r, layer=layer)

    found = results._of_bed(bedded(side), shot(start), shot(end))
    area = math.pi * r**2
    wanted = {
        "entrained_kg_per_m": 1000 * (area[0] + area[2]),
        "bed_kg_per_m": 1000 * area[:3].sum(),
        "deposited_kg_per_m": 0.0,
        "mass_kg_per_m": 2000 * area[4:].sum(),
    }
    assert found == pytest.approx(wanted, rel=SAME)
    end[5:, 0] = 0.01  # now two of the mass are 1 cm beyond
    found = results._of_bed(bedded(side), shot(start), shot(end))
    assert found == pytest.approx(wanted | {"deposited_kg_per_m": 2000 * area[5:].sum()}, rel=SAME)


@pytest.mark.parametrize("side", [1, -1])
def test_where_disks_were_taken_out_the_front_is_that_of_those_that_are_left(side):
    made = synthetic.load("model.section").load("undercut")
    made = made if side == made.side else similar.mirrored(made)
    x = np.linspace(0, 30, 7)
    start = synthetic.few(side * x, 0 * x + 5, r=np.full(7, 0.5), layer=np.zeros(7, int))
    left = np.arange(6)  # the foremost is gone
    end = synthetic.few(side * (x[left] + 4), 0 * left + 5.0, r=np.full(6, 0.5), layer=np.zeros(6, int), number=left)
    series = {"eroded_disks": np.array([0, 1]), "front_m": side * np.array([30.5, 29.5])}
    assert results._front_travel(made, series, side * 30.5, start, end) == pytest.approx(4.0)
    assert results._front_travel(made, series, side * 30.5, None, end) is None
    assert results._front_travel(made, series, side * 30.5, start, None) is None
    untouched = series | {"eroded_disks": np.array([0, 0])}
    assert results._front_travel(made, untouched, side * 30.5, None, None) == pytest.approx(-1.0)


def test_a_bed_is_told_once_the_run_has_ended(tmp_path):
    names = {"entrained_kg_per_m", "bed_kg_per_m", "deposited_kg_per_m", "mass_kg_per_m"}
    for start, stop in ((known_slope.begin, None), (None, known_slope.end)):
        found = summary_of(tmp_path / f"{start is None}", bedded(), start=start, stop=stop)
        assert {name: found[name] for name in names} == dict.fromkeys(names)
    assert not names & set(summary_of(tmp_path / "none"))


# ---- what a run leaves --------------------------------------------------------------------------------
LEFT = ("snapshots/00000050.npz", "snapshots/00000100.npz", "snapshots/00000150.npz", "snapshots/mine.npz")
OTHERS = ("series.csv", "walls.csv", "notes.txt", "checkpoint/scene.yade.gz", "vtk/disks-00000150.vtu")
HALF = (
    ".part-01-t0.npz",
    "snapshots/.part-02-00000200.npz",
    "vtk/.part-03-disks.vtu",
    "checkpoint/.part-04-state.json",
)


@pytest.mark.parametrize(
    "stage, gone",
    [("settle", ("t0.npz", "end.npz")), ("dry", ("t0.npz", "end.npz")), ("water", ("end.npz",)), ("done", ())],
)
def test_a_resumed_run_forgets_what_it_has_not_reached(tmp_path, stage, gone):
    """At step 100: the snapshot of step 150 is of later; t0's is of later before the water rises, and the end's before
    the end. What is half-written goes, all else stays.
    """
    whole = (*LEFT, *OTHERS, "t0.npz", "end.npz", "summary.json")
    for name in (*whole, *HALF):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    run_files.forget_later(tmp_path, stage, 100)
    left = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert left == set(whole) - {"snapshots/00000150.npz", *gone}


def test_a_run_that_begins_forgets_what_an_earlier_one_has_left(tmp_path):
    """But for its series and its checkpoint, which others forget, and for what no run has made."""
    old = (
        "summary.json",
        "breaks.csv",
        "t0.npz",
        "end.npz",
        *run_files.FIGURES,
        *LEFT[:3],
        "vtk/disks-00000150.vtu",
        "vtk/avalanche.pvd",
    )
    kept = (
        "series.csv",
        "walls.csv",
        "notes.txt",
        LEFT[3],  # a user's own
        "checkpoint/scene.yade.gz",
        "checkpoint/.part-04-state.json",
        "snapshots/notes.txt",
    )
    for name in (*old, *kept, *HALF[:3]):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    run_files.forget(tmp_path)
    left = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert left == set(kept)
    run_files.forget(tmp_path / "nowhere")  # a folder that is not there has nothing
