"""The shipped slope and its control runs: what each variant changes, what runs after what, and what is told of them."""

import dataclasses
import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
import drawn
from yade.nonsmooth import runs, section
from yade.nonsmooth.campaign.plan import PlanError
from yade.nonsmooth.figures import style
from yade.nonsmooth.model.section import data as section_data
from yade.nonsmooth.model.section.parts import Release
from yade.nonsmooth.studies.paper import paper_figures, paper_slopes

SUMMARY = {"water_at_failure_m": 17.25}


def plain(name, seed=2):
    return section_data.plain(paper_slopes.slope_of(name, 700, seed, SUMMARY))


def test_the_shipped_one_is_the_shipped_section():
    wanted = dataclasses.replace(section.load("jiufengershan").with_disks(700), seed=2)
    assert plain("shipped") == section_data.plain(wanted)


CASES = {  # D_c, way that releases from water [m]
    "shipped": (5.0, 5.0),
    "no-weakening": (1e5, 5.0),
    "no-release": (5.0, 1e5),
    "release-10": (5.0, 10.0),
    "release-2.5": (5.0, 2.5),
    "dilatancy": (5.0, math.inf),
    "dilatancy-5": (5.0, math.inf),
    "drained": (5.0, math.inf),
    "slip-or-dilatancy": (5.0, 5.0),
    "neither": (1e5, 1e5),
    "held": (5.0, 5.0),
}


def test_all_variants_have_a_case():
    assert set(CASES) == set(paper_slopes.VARIANTS)


@pytest.mark.parametrize("name", CASES)
def test_a_variant_changes_what_it_says_and_nothing_else(name):
    """1e5 m are farther than anything goes. All else is the shipped slope of the same packing."""
    made, (slip, release) = paper_slopes.slope_of(name, 700, 2, SUMMARY), CASES[name]
    assert (made.critical_slips, made.release_distance) == ({"DP": slip}, release)
    # from 0 at 1 m/s, for good or to the height of t1; it waits while the slope moves
    assert (made.water.table, made.water.rate) == (
        (((0.0, 0.0), (17.25, 17.25)), 0.0) if name == "held" else (((0.0, 0.0),), 1.0)
    )
    rules = {
        "dilatancy": Release("dilatancy", 0.03, 3.0),
        "dilatancy-5": Release("dilatancy", 0.05, 3.0),
        "drained": Release("dilatancy", 0.03, 3.0, drainage_time=2.0),
        "slip-or-dilatancy": Release("slip_or_dilatancy", 0.03, 3.0),
    }
    assert made.water.release == rules.get(name)
    data, shipped = plain(name), plain("shipped")
    for one in (data, shipped):
        del one["materials"]["dp"]["slip_weakening"]["critical_slip"]
        del one["water"]["release_distance"], one["water"]["table"]
        one["water"].pop("release", None)
    assert data == shipped


def test_what_waits_for_the_shipped_slope_says_so_where_that_did_not_fail_by_water():
    for told in (None, {}, {"water_at_failure_m": None}):
        with pytest.raises(
            PlanError, match="held, seed 3: the shipped slope of this packing has no water_at_failure_m"
        ):
            paper_slopes.slope_of("held", 700, 3, told)


@pytest.fixture
def ran(monkeypatch, tmp_path):
    """Plans that are run, without a slope: [(folder, title, {name: data})]; each run of seed s failed at s + 0.5 m of
    water.
    """
    asked = []

    class Plan:
        def __init__(self, title, function, runs):
            self.title, self.function, self.runs = title, function, runs

        def run(self, out, threads, resume, progress):
            asked.append((out, threads, resume, {one.name: one.arguments["data"] for one in self.runs}))
            for k, one in enumerate(self.runs):
                folder = out / "runs" / one.name
                folder.mkdir(parents=True)
                (folder / "section.yaml").touch()
                (folder / "summary.json").write_text(json.dumps({"water_at_failure_m": one.values["seed"] + 0.5}))
                progress((k + 1) / len(self.runs), k + 1)

    monkeypatch.setattr(paper_slopes, "Plan", Plan)
    return asked


def test_the_table_that_stops_at_t1_runs_after_the_shipped_slopes(ran, tmp_path):
    shown = []
    found = paper_slopes.run(
        ["held", "no-release"], tmp_path, 700, [4, 5], 3, True, lambda share, ended: shown.append((share, ended))
    )
    (first, threads, resume, slopes), (then, _, _, after) = ran
    assert (first, then, threads, resume) == (tmp_path / "slopes", tmp_path / "after", 3, True)
    assert list(slopes) == ["shipped-4", "shipped-5", "no-release-4", "no-release-5"]
    assert {name: data["water"]["table"]["points"][-1] for name, data in after.items()} == {
        "held-4": [4.5, 4.5],
        "held-5": [5.5, 5.5],
    }
    assert [data["seed"] for data in slopes.values()] == [4, 5, 4, 5]
    # in the order of the table, without what was run for its numbers alone
    assert list(found) == ["no-release", "held"]
    assert [run.folder.name for run in found["held"]] == ["held-4", "held-5"]
    assert shown == [(pytest.approx(k / 6), k) for k in range(1, 7)]


def test_without_it_there_is_one_plan(ran, tmp_path):
    paper_slopes.run(["no-weakening"], tmp_path, 700, [1])
    assert [list(slopes) for *_, slopes in ran] == [["no-weakening-1"]]


@pytest.mark.parametrize(
    "names, seeds, said",
    [
        ([], [1], "slopes none: give some of shipped,"),
        (["dry"], [1], "slopes dry: give some of shipped,"),
        (["held", "held"], [1], "each once"),
        (["held"], [], "seeds none: give one or more"),
        (["held"], [2, 2], "seeds 2, 2: give one or more, each once"),
        (["held"], [1.5], "seeds 1.5: give whole numbers from 0"),
    ],
)
def test_what_is_no_variant_or_seed_is_refused_before_anything_runs(ran, tmp_path, names, seeds, said):
    with pytest.raises(PlanError, match=said):
        paper_slopes.run(names, tmp_path, 700, seeds)
    with pytest.raises(section.SectionError, match="disks 0: give a whole number"):
        paper_slopes.run(["held"], tmp_path, 0, [1])
    assert not ran


# of the water's force, which falls to half 1.5 s after 30 s
SERIES = {"time_s": np.array([29.0, 30.0, 31.0, 31.5, 32.0]), "dp_water_N_per_m": np.array([1.0, 8.0, 5.0, 4.0, 0.0])}


def runs_of(*summaries):
    return [SimpleNamespace(summary=one, series=SERIES) for one in summaries]


def test_the_half_of_the_slip_surface_that_is_ahead_is_told(whole):
    """Beside the slips of the disks on DP, between the snapshots that hold their mean of D_c."""
    run = runs.open_run(whole.folder)
    (row,) = paper_slopes.rows({"shipped": [run]})
    upper, lower, ahead = (row["numbers"][f"slip_m.{name}"]["mean"] for name in ("upper", "lower", "ahead"))
    assert ahead == pytest.approx(upper - lower, rel=1e-12) and min(upper, lower) > 0
    d_c = run.section.critical_slips["DP"]
    # halves of a line have not quite as many disks each, so the mean of both is that of all by half or so
    assert abs((upper + lower) / 2 - d_c) < 0.5 * abs(ahead) + 1e-9 and upper != lower
    stood = {"summary": run.summary | {"weakening_begins_s": None}}
    (row,) = paper_slopes.rows({"shipped": [SimpleNamespace(**vars_of(run) | stood)]})
    assert not any(name.startswith("slip_m") for name in row["numbers"])


def test_rows_have_means_over_the_slopes_that_have_a_number(monkeypatch):
    """Student's t of two: 12.706; of one there is no interval. What became of slopes is counted."""
    monkeypatch.setattr(paper_slopes, "_slips", lambda run: {})  # these have no snapshots
    found = {
        "held": runs_of(
            {
                "verdict": "stood",
                "water_highest_m": 18.0,
                "mixing": None,
                "times_s": {"t2": None},
                "verdict_says": "it",
            },
            {
                "verdict": "failed by water",
                "water_highest_m": 20.0,
                "mixing": 0.1,
                "weakening_begins_s": 33.0,
                "times_s": {"t0": 10.0, "t2": 30.0, "t3": 36.0},
                "t2_by_speed_s": {"50": 29.5, "500": None},
                "t5_by_speed_s": {"10": 70.0},
            },
            {"verdict": "stood", "water_highest_m": 19.0, "mixing": None, "times_s": {"t2": None}},
        )
    }
    (row,) = paper_slopes.rows(found)
    assert (row["name"], row["label"], row["paper"]) == ("held", "table stops at t1", "[115], [116]")
    assert row["verdicts"] == {"stood": 2, "failed by water": 1} and (row["of"], row["weakened"]) == (3, 1)
    times = {name: one["mean"] for name, one in row["numbers"].items() if name.endswith(("t2", "t3", "50", "10"))}
    assert times == {
        "times_s.t2": 30.0,
        "times_s.t3": 36.0,
        "since_t0_s.t2": 20.0,
        "since_t0_s.t3": 26.0,
        "t2_by_speed_s.50": 29.5,
        "t5_by_speed_s.10": 70.0,
        "triggering_by_speed_s.50": 6.5,
        "motion_by_speed_s.10": 34.0,
    }
    others = {"water_highest_m", "mixing", "weakening_begins_s", "times_s.t0", "water_halved_s"}
    assert set(row["numbers"]) - set(times) == others and row["numbers"]["water_halved_s"]["mean"] == 1.5
    assert row["numbers"]["water_highest_m"] == {
        "mean": 19.0,
        "half_width": pytest.approx(4.3027 / 3**0.5, rel=1e-4),
        "values": [18.0, 20.0, 19.0],
        "of": 3,
    }
    assert row["numbers"]["mixing"] == {"mean": 0.1, "half_width": None, "values": [None, 0.1, None], "of": 1}
    heads, (line,) = paper_slopes.table([row])
    told = dict(zip(heads, line, strict=True))
    assert told["what became of it"] == "2 stood, 1 failed by water" and told["highest water [m]"] == "19.0 ± 2.5"
    assert told["mixing [%]"] == "10.0 (1)" and told["way of the front [m]"] == "–"


def test_changes_are_those_of_the_same_packing():
    """Of 610 and 590 m, and of 640 and none, from 600 and 570 m."""
    found = {
        "shipped": runs_of({"centroid_travel_m": 600.0}, {"centroid_travel_m": 570.0}),
        "dilatancy": runs_of({"centroid_travel_m": 610.0}, {"centroid_travel_m": 590.0}),
        "drained": runs_of({"centroid_travel_m": 640.0, "mixing": 0.1}, {"centroid_travel_m": None}),
    }
    one, other = paper_slopes.changes(paper_slopes.rows(found))
    assert (one["name"], one["numbers"]["centroid_travel_m"]["values"]) == ("dilatancy", [10.0, 20.0])
    assert one["numbers"]["centroid_travel_m"]["mean"] == 15.0 and set(other["numbers"]) == {"centroid_travel_m"}
    assert (other["numbers"]["centroid_travel_m"]["values"], other["of"]) == ([40.0, None], 2)
    _, lines = paper_slopes.table([one, other], paper_slopes.TIMES | paper_slopes.CHANGES)
    assert [line[-3] for line in lines] == ["15 ± 64", "40 (1)"]
    assert paper_slopes.changes(paper_slopes.rows({"dilatancy": found["dilatancy"]})) == []


def test_the_figures_are_of_the_runs_that_there_are(whole, monkeypatch, tmp_path):
    """Of the small slope's run, taken for the shipped slope and for one of its controls."""
    kept = drawn.keep(monkeypatch, style)
    run = runs.open_run(whole.folder)
    made = paper_figures.draw({"shipped": [run], "no-weakening": [run], "held": [run]}, tmp_path)
    names = "controls forces toes markers speeds".split()
    assert [path.name for path in made] == [f"paper_{name}.png" for name in names] and set(kept) == {
        path.name for path in made
    }
    assert list(drawn.legend(kept["paper_controls.png"].axes[0])) == ["as shipped", "DP keeps its friction"]
    assert list(drawn.legend(kept["paper_forces.png"].axes[0]))[:2] == [
        "shear force on DP, each packing",
        "force on FB, each packing",
    ]
    (panel, _) = kept["paper_toes.png"].axes
    assert panel.get_title(loc="left") == "packing 3"
    times = run.summary["times_s"]
    told = [next(t for t in drawn.texts(ax) if t.endswith(" s")) for ax in kept["paper_markers.png"].axes]
    assert told == [
        f"$t_{{0}}$, water begins to rise: {times['t0']:.0f} s",
        f"$t_{{4}}$, during motion: {times['t4']:.0f} s",
        f"$t_{{5}}$, at rest: {times['t5']:.0f} s",
    ]
    # 0.2 m/s of the shipped slope are less of a small one
    speed = float(list(drawn.legend(kept["paper_speeds.png"].axes[0]))[0].split(" m/s")[0])
    assert 0.01 < speed < 0.05
    assert paper_figures.draw({"no-weakening": [run]}, tmp_path) == []


def test_variants_of_release_are_drawn_beside_the_shipped_slope(whole, monkeypatch, tmp_path):
    """Those that there are, ten seconds after t2 each."""
    asked = []

    def releases(cases, path):
        asked.append(cases)
        return path

    monkeypatch.setattr(paper_figures.figures, "releases", releases)
    run = runs.open_run(whole.folder)
    made = paper_figures.draw({"shipped": [run], "dilatancy": [run], "no-weakening": [run]}, tmp_path)
    assert made[1] == tmp_path / "paper_release.png"
    ((shipped, dilatancy),) = asked
    variants = paper_slopes.VARIANTS
    assert (shipped[0], dilatancy[0]) == (variants["shipped"].label, variants["dilatancy"].label)
    times = run.summary["times_s"]
    assert shipped[1][0][1] == times and len(shipped[1]) == 1
    assert np.array_equal(shipped[2].x, run.snapshot(times["t2"] + 10.0).x) and shipped[3] is run.section


def test_a_slope_that_stood_has_no_figures_of_a_failure(whole, monkeypatch, tmp_path):
    """Nor has one that did not come to rest a t5."""
    kept = drawn.keep(monkeypatch, style)
    run = runs.open_run(whole.folder)
    stood = run.summary | {"times_s": run.summary["times_s"] | dict.fromkeys(("t1", "t2", "t3", "t4", "t5"))}
    made = paper_figures.draw({"shipped": [SimpleNamespace(**vars_of(run) | {"summary": stood})]}, tmp_path)
    assert [path.name for path in made] == ["paper_controls.png"]
    goes_on = run.summary | {"times_s": run.summary["times_s"] | {"t5": None}}
    paper_figures.draw({"shipped": [SimpleNamespace(**vars_of(run) | {"summary": goes_on})]}, tmp_path)
    assert drawn.text(kept["paper_markers.png"].axes[-1], "the end: ") is not None


def vars_of(run):
    return {name: getattr(run, name) for name in ("folder", "section", "series", "snapshot")}
