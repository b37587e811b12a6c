"""Which data a run, a campaign, a heap and a comparison hand to their figures, which are kept instead of being written
and have tests of their own.
"""

import dataclasses
import types

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic
from yade.nonsmooth import records, run_figures, section
from yade.nonsmooth.figures import style
from yade.nonsmooth.heaps import column, report as heap_report
from yade.nonsmooth.judges.verification import collapse
from yade.nonsmooth.laboratory import report as laboratory_report
from yade.nonsmooth.studies.comparison import (
    biaxial_report,
    biaxials,
    cases,
    common,
    figures,
    report,
    slope_report,
    slopes,
    summary,
)
from yade.nonsmooth.studies.comparison.outcomes import Cost, Outcome
from yade.nonsmooth.studies.slope.columns import COLUMNS


@pytest.fixture
def kept(monkeypatch):
    """Figures that are saved, by the name of their file."""
    return drawn.keep(monkeypatch, style)


# ---- a run ----------------------------------------------------------------------------------------

TIMES = {"t0": 10.0, "t1": 42.1, "t2": 51.0, "t3": 60.0, "t4": 71.0, "t5": None}


@pytest.fixture
def run(tmp_path, monkeypatch):
    """A run of 100 s whose rows, one a second, settle until 10 s, with a snapshot every ten seconds, and one of t1;
    video and ParaView files are kept as their arguments.
    """
    rows = {name: np.zeros(101) for name in COLUMNS} | {
        "step": np.arange(101) * 100,
        "time_s": np.where(np.arange(101) == 42, 42.1, np.arange(101.0)),
        "stage": (np.arange(101) >= 10).astype(int),
    }
    rows |= {
        "fb_normal_N_per_m": 1e6 * (5 + np.arange(101)),
        "energy_kinetic_J": 1e9 * np.arange(101),
        "tolerance": np.full(101, 1e-6),
    }
    with records.SeriesWriter(tmp_path / "series.csv", COLUMNS) as file:
        for k in range(101):
            file.write({name: values[k] for name, values in rows.items()})
    (tmp_path / "snapshots").mkdir()

    def state(time):
        return vars(
            synthetic.few(
                [-200.0 + time, -100.0, 0.0], [100.0, 60.0, 30.0], [(0, 1, 1e6)], time_s=time, step=int(100 * time)
            )
        )

    files = [
        records.write_snapshot(tmp_path / "snapshots" / f"{1000 * k:08d}.npz", **state(10.0 * k)) for k in range(11)
    ]
    records.write_snapshot(tmp_path / "snapshots" / "00000123.npz", **state(1.25))  # of no row: none of the run's
    files.insert(5, records.write_snapshot(tmp_path / "snapshots" / "00004200.npz", **state(42.1)))
    records.write_snapshot(tmp_path / "t0.npz", **state(10.5))
    records.write_snapshot(tmp_path / "end.npz", **state(100.0))
    told = types.SimpleNamespace(folder=tmp_path, files=files)
    monkeypatch.setattr(
        run_figures.video, "write_mp4", lambda *a, **options: (setattr(told, "video", (a, options)), (a[2], None))[1]
    )
    monkeypatch.setattr(
        run_figures.paraview, "write_run", lambda *a: (setattr(told, "paraview", a), a[0] / "vtk" / "avalanche.pvd")[1]
    )
    return told


def test_a_run_hands_its_records_to_its_figures(kept, run):
    slope = section.load("jiufengershan")
    made, notes = run_figures.draw(run.folder, slope, {"times_s": TIMES, "failed_dry_s": None})
    assert not notes
    assert [path.name for path in made] == [
        "force_chains.png",
        "forces.png",
        "snapshots.png",
        "deposit.png",
        "energy.png",
        "solver.png",
        "avalanche.pvd",
        "avalanche.mp4",
    ]
    # t0 has a file of its own, t1 its exact snapshot, the others take the nearest; t5 did not come, so that the end is
    # shown
    at = [[t.get_text() for t in ax.texts if t.get_text().endswith(" s")][0] for ax in kept["snapshots.png"].axes]
    assert at == [
        "$t_{0}$ = 10.5 s",
        "$t_{1}$ = 42.1 s",
        "$t_{2}$ = 50.0 s",
        "$t_{3}$ = 60.0 s",
        "$t_{4}$ = 70.0 s",
        "end: 100.0 s",
    ]
    assert drawn.disks(kept["force_chains.png"].axes[0])[0][0, 0] == -189.5
    (deposit,) = kept["deposit.png"].axes
    assert drawn.disks(deposit)[0][0, 0] == -100 and drawn.text(deposit, "front").get_text() == "front: 0.0 m"
    assert "and after: 29.8 m away" in drawn.legend(deposit.figure)  # one disk of three went 89.5 m
    # energies and forces begin with the dry rest
    energy = drawn.points(drawn.line(kept["energy.png"].axes[0], "kinetic"))
    assert (
        energy[0].tolist() == [10, 0]
        and energy[-1].tolist() == [100, 90]
        and set(drawn.uprights(kept["energy.png"].axes[0])) == {t for t in TIMES.values() if t}
    )
    (back,) = (
        drawn.points(one)
        for ax in kept["forces.png"].axes
        if ax.get_ylabel() == "force [MN/m]"
        for one in ax.lines
        if one.get_label() == "$N'_{FB}$  normal on FB"
    )
    assert back[0].tolist() == [10, 15] and any("means over 1 s" in words for words in drawn.texts(kept["forces.png"]))
    assert kept["solver.png"].axes[0].get_xlim() == (10, 100)
    (files, walls, path), options = run.video
    assert (
        files == [p for k, p in enumerate(run.files) if k not in (0, 5)]  # at equal distances, since it settled
        and walls is slope
        and path.name == "avalanche.mp4"
        and options["times"] == TIMES
        and options["series"]["time_s"][0] == 10
    )
    assert run.paraview[0] == run.folder and run.paraview[2] == list(
        zip([0.0, 10.0, 20.0, 30.0, 40.0, 42.1, *np.arange(50.0, 101, 10)], run.files)
    )


def test_an_end_that_is_a_characteristic_time_is_shown_once(kept, run):
    """A run that was stopped at t4: the nearest snapshot is that of the end."""
    run_figures.draw(
        run.folder, section.load("jiufengershan"), {"times_s": TIMES | {"t4": 100.0}, "failed_dry_s": None}
    )
    at = [[t.get_text() for t in ax.texts if t.get_text().endswith(" s")][0] for ax in kept["snapshots.png"].axes]
    assert at[-2:] == ["$t_{3}$ = 60.0 s", "$t_{4}$ = 100.0 s"]


def test_a_slope_that_failed_dry_has_no_initial_state(kept, run):
    made, (note,) = run_figures.draw(
        run.folder, section.load("jiufengershan"), {"times_s": TIMES | {"t0": None}, "failed_dry_s": 7.0}
    )
    assert "on the move already" in note and "force_chains.png" not in kept and "deposit.png" not in kept
    # forces are those of all rows, energies of those that have a balance
    assert (
        run.video[0][0] == [p for k, p in enumerate(run.files) if k not in (0, 5)]  # from 7 s on
        and run.video[1]["series"]["time_s"][0] == 0
        and kept["solver.png"].axes[0].get_xlim() == (0, 100)
        and kept["energy.png"].axes[0].get_xlim() == (10, 100)
    )


# ---- a campaign of the laboratory -----------------------------------------------------------------


def test_a_campaign_draws_its_first_seed_and_the_sample_nearest_8_megapascals(kept, tmp_path):
    tests, strain = [], np.linspace(1e-3, 0.06, 60)
    for pressure in (1e6, 6e6, 20e6):
        for seed in (3, 4):
            tests.append(
                {
                    "confining_Pa": pressure,
                    "seed": seed,
                    "strain_peak": 0.02,
                    "sigma1_peak_Pa": 3 * pressure,
                    "residual_between_strains": [0.04, 0.06],
                    "sigma1_residual_Pa": 2 * pressure,
                    "sigma3_peak_Pa": pressure,
                    "sigma3_residual_Pa": pressure,
                }
            )
            home = tmp_path / "tests" / f"{pressure / 1e6:g}MPa-seed{seed}"
            (home / "snapshots").mkdir(parents=True)
            with records.SeriesWriter(
                home / "series.csv", ("step", "strain", "sigma1_top_Pa", "sigma1_bottom_Pa", "volumetric_strain")
            ) as file:
                for k, e in enumerate(strain):
                    file.write(
                        {
                            "step": k,
                            "strain": e,
                            "sigma1_top_Pa": (seed - 1) * pressure,
                            "sigma1_bottom_Pa": (seed - 1) * pressure,
                            "volumetric_strain": 0.1 * e,
                        }
                    )
            for name, time in (("begin", 0.0), ("1", 1.0), ("2", 2.0), ("end", 9.0)):
                s = synthetic.few(
                    [0.0, 2.0, pressure / 1e6 + seed],
                    [0.0, 0.0, 4.0 + time],
                    [(0, 1, 1e3 * (1 + time))],
                    time_s=time,
                    angle=np.array([0.02 * time, 0.0, 0.0]),
                )
                records.write_snapshot(home / "snapshots" / f"{name}.npz", **vars(s))
    envelope = {
        "cohesion_peak_kPa": 0.0,
        "friction_peak_deg": 30.0,
        "cohesion_residual_kPa": None,
        "friction_residual_deg": None,
    }
    made = laboratory_report.draw(tmp_path, {"tests": tests, "seeds": [3, 4], **envelope})
    assert [path.name for path in made] == [
        "stress_strain.png",
        "stress.png",
        "mohr.png",
        "bands.png",
        "force_chains.png",
    ]
    top, _ = kept["stress_strain.png"].axes
    # of seed 3
    assert list(drawn.legend(top)) == ["1", "6", "20"] and all(
        drawn.points(drawn.line(top, name))[:, 1] == pytest.approx(2.0) for name in ("1", "6", "20")
    )
    assert kept["mohr.png"].axes[0].get_title() == "6 tests"
    first, last, _ = kept["bands.png"].axes
    assert (first.get_title(), last.get_title()) == ("ε₁ = 1 %, σ₃ = 6 MPa", "end, σ₃ = 6 MPa")
    assert [drawn.disks(ax)[0][2].tolist() for ax in (first, last)] == [[9, 5], [9, 13]]
    turned = [drawn.disks(ax)[2][0] for ax in (first, last)]  # a ninth of the rotation, counterclockwise, is paler
    assert int(turned[0][3:5], 16) > int(turned[1][3:5], 16)
    (sample,) = kept["force_chains.png"].axes
    assert sample.get_title() == "ε₁ = 1 %, σ₃ = 6 MPa" and drawn.disks(sample)[0][2].tolist() == [9, 5]
    # a test of less than 1 % of strain has its end alone
    for name in ("1", "2"):
        (tmp_path / "tests" / "6MPa-seed3" / "snapshots" / f"{name}.npz").unlink()
    laboratory_report.draw(tmp_path, {"tests": tests, "seeds": [3, 4], **envelope})
    only, _ = kept["bands.png"].axes
    assert only.get_title() == "end, σ₃ = 6 MPa" == kept["force_chains.png"].axes[0].get_title()
    # ParaView's frames in the course of time
    listed = (tmp_path / "tests" / "20MPa-seed4" / "vtk" / "biaxial.pvd").read_text()
    assert [
        listed.index(f'timestep="{time}"') < listed.index(f"disks-{name}.vtu")
        for time, name in ((0.0, "begin"), (1.0, "1"), (2.0, "2"), (9.0, "end"))
    ] == [True] * 4
    assert listed.index("begin") < listed.index("disks-1") < listed.index("disks-2") < listed.index("disks-end")


def test_without_an_envelope_there_is_no_figure_of_it(kept, tmp_path, monkeypatch):
    monkeypatch.setattr(laboratory_report, "_pictures", lambda test, frames, out: [])
    test = {
        "confining_Pa": 1e6,
        "seed": 1,
        "strain_peak": 0.02,
        "sigma1_peak_Pa": 3e6,
        "residual_between_strains": [0.04, 0.06],
        "sigma1_residual_Pa": 2e6,
    }
    (tmp_path / "tests" / "1MPa-seed1").mkdir(parents=True)
    with records.SeriesWriter(
        tmp_path / "tests" / "1MPa-seed1" / "series.csv",
        ("step", "strain", "sigma1_top_Pa", "sigma1_bottom_Pa", "volumetric_strain"),
    ) as file:
        for k in range(1, 41):
            file.write(
                {"step": k, "strain": 1e-3 * k, "sigma1_top_Pa": 2e6, "sigma1_bottom_Pa": 2e6, "volumetric_strain": 0.0}
            )
    assert [path.name for path in laboratory_report.draw(tmp_path, {"tests": [test], "seeds": [1]})] == [
        "stress_strain.png",
        "stress.png",
    ]


# ---- a heap ---------------------------------------------------------------------------------------


def test_a_heap_draws_its_places_in_widths_with_its_gate(kept, tmp_path):
    x, y = (g.ravel() for g in np.meshgrid(0.5 + np.arange(4), 0.5 + np.arange(6)))
    for name, time, stretch, press in (("00000000", 0.0, 1, 1), ("00000100", 1.0, 1.25, 0.8), ("end", 4.5, 1.5, 0.7)):
        path = tmp_path / "snapshots" / f"{name}.npz"
        records.write_snapshot(path, time_s=time, step=100 * time, x=stretch * x, y=press * y, r=np.full(24, 0.5))
    heap = column.Column(disks=200, aspect=1.5)
    path = heap_report.draw_collapse(heap, {"width_m": 4.0, "fall_time_s": 0.8}, tmp_path, tmp_path / "collapse.png")
    fig = kept[path.name]
    # 1.25, to even
    assert [drawn.texts(ax) for ax in fig.axes] == [
        ["t = 0.0 T (0.00 s)"],
        ["t = 1.2 T (1.00 s)"],
        ["at rest (4.50 s)"],
    ]
    for ax, stretch, press in zip(fig.axes, (1, 1.25, 1.5), (1, 0.8, 0.7)):
        assert drawn.disks(ax)[0] == pytest.approx(np.column_stack([stretch * x, press * y]) / 4) and list(
            drawn.uprights(ax)
        ) == [pytest.approx(heap.box()[0] / 4)]


# ---- a comparison ---------------------------------------------------------------------------------

BROKEN = {"tension": 30, "shear": 12, "torque": 6, "mixed": 3}


def outcome(case, k):
    """A made-up run: columns are straight lines whose slopes tell the run, ``k``."""
    t = np.linspace(0, 10, 11)
    modes = {f"bonds_broken_{mode}": np.linspace(0, count + k, 11) for mode, count in BROKEN.items()}
    series = {
        "time_s": t,
        "strain": 0.01 * t,
        "fb_normal_N_per_m": 1e6 * (k + t),
        "dp_shear_N_per_m": 2e6 * (k + t),
        "dp_normal_effective_N_per_m": 3e6 * (k + t),
        "energy_kinetic_J": 1e9 * (k + t),
        "bonds_alive": 200.0 - k - t,
        "water_m": k + 0.5 * t,
        "front_m": 100 + k + t,
        "speed_mean_m_per_s": 1e-3 * (k + t),
        **modes,
    }
    curves = {
        "abscissa": t,
        "front": (k + 1) * t,
        "centroid": (k + 1) * 0.5 * t,
        "stress": 2 + k + 0 * t,
        "volume": 0.001 * (k + 1) * t,
    }
    row = np.arange(5.0)
    values = {
        q: 1.0 + 0.1 * k for q in ("water_at_failure_m", "front_travel_m", "sigma1_peak_Pa", "sigma1_residual_Pa")
    }
    forces = {(0, 1): 1.0, (1, 2): 3.0 + k, (2, 3): 2.0 + k % 3}
    begin, end = (row - 10, row, np.full(5, 0.8)), (row + k, 0 * row, np.full(5, 0.8))
    return Outcome(
        case,
        values,
        curves,
        series,
        begin,
        end,
        forces,
        0.01 / (k + 1),
        0.001 / (k + 1),
        Cost(100, 10.0 ** -(k + 1), 5.0 + k, 10.0, 20.0 + k),
    )


def compared(source, moving):
    """Two seeds and two stiffnesses, with runs for damping and fragile bonds: the plan, and {case: outcome} with k by
    the case.
    """
    plan = cases.plan(source, 100, [1, 2], [1e8, 1e9], damping_moving=moving, bonds_run=True, fragile=False)
    return plan, {case: outcome(case, k) for k, case in enumerate(plan.cases)}


@pytest.fixture(scope="module")
def slope():
    return compared("jiufengershan", 0.02)


def lines(ax):
    """{label or None: [(colour, y values)]} in the order drawn."""
    return [
        (one.get_label() if not one.get_label().startswith("_") else None, drawn.colour(one), drawn.points(one)[:, 1])
        for one in ax.lines
    ]


def test_forces_energies_and_ways_of_slopes(kept, tmp_path, slope):
    plan, outcomes = slope
    (tmp_path / "figures").mkdir()
    made = {s.title: s for s in slope_report.sections(tmp_path, slopes, plan, outcomes, None)}
    k = {case: n for n, case in enumerate(plan.cases)}
    t = np.linspace(0, 10, 11)
    (hard1, soft1), (hard2, soft2) = plan.ensemble
    seeds = [
        ("hard", figures.HARD.lower(), hard1),
        (None, figures.HARD.lower(), hard2),
        (f"soft, {cases.modulus_label(soft1.stiffness)}", figures.SOFT.lower(), soft1),
        (None, figures.SOFT.lower(), soft2),
    ]
    sweep = [("hard", figures.HARD.lower(), hard1)] + [
        (f"soft, {cases.modulus_label(c.stiffness)}", figures.shade(c.stiffness, [1e8, 1e9]).lower(), c)
        for c in plan.sweep
    ]

    def holds(name, panels, expected):
        fig = kept[name]
        for ax, (label, value) in zip(fig.axes, panels, strict=True):
            assert ax.get_ylabel() == label
            got = lines(ax)
            assert [(word, fill) for word, fill, _ in got] == [(word, fill) for word, fill, _ in expected], name
            for (_, _, y), (_, _, case) in zip(got, expected):
                assert y == pytest.approx(value(k[case])), name

    holds(
        "forces.png",
        (
            ("normal force on FB\n[MN/m]", lambda n: n + t),
            ("shear force on DP\n[MN/m]", lambda n: 2 * (n + t)),
            ("effective normal force\non DP [MN/m]", lambda n: 3 * (n + t)),
        ),
        seeds,
    )
    holds(
        "energy.png",
        (
            ("kinetic energy [GJ/m]", lambda n: n + t),
            ("bonds that hold", lambda n: 200 - n - t),
            ("water table [m]", lambda n: n + 0.5 * t),
        ),
        sweep,
    )
    ways = (
        ("way of the front [m]", lambda n: (n + 1) * t),
        ("way of the centre\nof mass [m]", lambda n: (n + 1) * 0.5 * t),
    )
    holds("motion_seeds.png", ways, seeds)
    holds("motion_stiffness.png", ways, sweep)
    usual = next(c for c in plan.sweep if c.stiffness == plan.damping.stiffness)
    dark = figures.SHADES[4].lower()
    holds(
        "damping.png",
        ways,
        [
            ("hard", figures.HARD.lower(), hard1),
            ("soft, damping 0.02 on the move", figures.SOFT.lower(), usual),
            ("soft, damping 0.2 throughout", dark, plan.damping),
        ],
    )
    usual = next(c for c in plan.sweep if c.stiffness == plan.fragile.stiffness)
    holds(
        "bond_kinds.png",
        (("bonds that hold", lambda n: 200 - n - t), ("place of the front [m]", lambda n: 100 + n + t)),
        [
            ("hard", figures.HARD.lower(), hard1),
            ("soft, ductile bonds", figures.SOFT.lower(), usual),
            ("soft, fragile bonds", dark, plan.fragile),
        ],
    )
    # one stops after (1 - λ)/(1 + λ) of the way: 0.8/1.2 and 0.98/1.02
    assert "0.67 for λ = 0.2, 0.96 for λ = 0.02" in made["What damping does"].text[0]
    # P(N/⟨N⟩) of the first packing, with all stiffnesses
    assert list(drawn.legend(kept["force_distribution.png"].axes[0]).values()) == [fill for _, fill, _ in sweep]


def test_broken_bonds_are_parts_of_those_made(kept, tmp_path, slope):
    plan, outcomes = slope
    (tmp_path / "figures").mkdir()
    slope_report.modes_section(tmp_path / "figures", plan, outcomes)
    k = {case: n for n, case in enumerate(plan.cases)}
    bars = [c for c in kept["modes.png"].axes[0].containers if hasattr(c, "patches")]
    for group, pair in zip(bars, zip(*plan.ensemble)):
        # 200 - k bonds to begin with, of which all but those that hold are told by mode at the end
        assert [bar.get_height() for bar in group] == pytest.approx(
            [100 * np.mean([(count + k[c]) / (200 - k[c]) for c in pair]) for count in BROKEN.values()]
        )


def test_deposits_of_the_first_seed_with_the_ground(kept, tmp_path, slope):
    plan, outcomes = slope
    walls = [("DP", [[-20.0, 5.0], [0.0, -1.0]], "slip"), ("SS", [[0.0, -1.0], [30.0, -1.0]], "ground")]
    (made,) = common.deposit_section(tmp_path, plan, outcomes, walls)
    hard, soft = (outcomes[c].deposit for c in plan.ensemble[0])
    fig = kept["deposits.png"]
    share = hard.intersection(soft).area / hard.union(soft).area
    assert (
        list(drawn.legend(fig))
        == [f"both: {100 * share:.0f} % of the area of either", "hard alone", "soft alone", "before"]
        and "seed 1" in made.plots[0][1]
    )
    bounds = {drawn.colour(p): p.get_path().get_extents().bounds for p in fig.axes[0].patches}
    (x0, _, x1, _), (u0, _, u1, _) = hard.bounds, soft.bounds
    assert x0 != u0 and bounds[figures.HARD.lower() if x0 < u0 else figures.SOFT.lower()][0] == pytest.approx(
        min(x0, u0)
    )
    assert not common.deposit_section(
        tmp_path, plan, {c: dataclasses.replace(o, end=None) for c, o in outcomes.items()}, walls
    )


def test_stress_and_volume_of_biaxial_tests(kept, tmp_path):
    plan, outcomes = compared("wwr", None)
    (tmp_path / "figures").mkdir()
    biaxial_report.sections(tmp_path, biaxials, plan, outcomes, None)
    k = {case: n for n, case in enumerate(plan.cases)}
    t = np.linspace(0, 10, 11)
    for name, chosen in (
        ("stress_seeds.png", [c for pair in zip(*plan.ensemble) for c in pair]),
        ("stress_stiffness.png", [plan.ensemble[0][0], *plan.sweep]),
    ):
        stress, volume = kept[name].axes
        assert (stress.get_ylabel(), volume.get_ylabel(), volume.get_xlabel()) == (
            "σ₁/σ₃ [-]",
            "volumetric strain [%]",
            "axial strain [%]",
        )
        for one, other, case in zip(stress.lines, volume.lines, chosen, strict=True):
            # strains, here up to 10, are in per cent
            assert drawn.points(one) == pytest.approx(np.column_stack([100 * t, 2 + k[case] + 0 * t]))
            assert drawn.points(other)[:, 1] == pytest.approx(0.1 * (k[case] + 1) * t)
    speed = kept["speed.png"].axes[0]
    assert speed.get_ylabel() == "mean speed of disks [m/s]" and drawn.points(speed.lines[0]) == pytest.approx(
        np.column_stack([t, 1e-3 * (k[plan.ensemble[0][0]] + t)])
    )
    assert drawn.points(kept["bonds.png"].axes[0].lines[0])[:, 1] == pytest.approx(200 - k[plan.ensemble[0][0]] - t)


def test_overlaps_cost_and_precision_of_a_comparison(kept, tmp_path, slope):
    plan, outcomes = slope
    told = summary.summarise(slopes, plan, outcomes)
    (tmp_path / "figures").mkdir()
    report.common_sections(tmp_path, slopes, plan, outcomes, told)
    hard, sweep = outcomes[plan.ensemble[0][0]], [outcomes[c] for c in plan.sweep]
    rest, moving = slopes.OVERLAP_WHEN
    (ax,) = kept["overlaps.png"].axes
    assert drawn.points(drawn.line(ax, f"soft, {rest}")).tolist() == [[o.case.stiffness, o.overlap_rest] for o in sweep]
    assert drawn.points(drawn.line(ax, f"soft, {moving}")).tolist() == [[o.case.stiffness, o.overlap] for o in sweep]
    assert drawn.line(ax, f"hard, {rest}: {hard.overlap_rest:.1e}").get_ydata()[0] == hard.overlap_rest
    assert drawn.line(ax, f"hard, {moving}: {hard.overlap:.1e}").get_ydata()[0] == hard.overlap
    wall, steps = kept["cost.png"].axes
    assert (
        drawn.points(drawn.line(wall, "soft"))[:, 1].tolist() == [o.cost.rate for o in sweep]
        and drawn.levels(wall)[0][0] == hard.cost.rate
    )
    assert drawn.points(drawn.line(steps, "soft"))[:, 1] == pytest.approx([1 / o.cost.step_s for o in sweep])
    assert drawn.levels(steps)[0][0] == pytest.approx(1 / hard.cost.step_s)
    against_hard, against_own = kept["work_precision.png"].axes
    assert (against_hard.get_title(), against_own.get_title()) == (
        "against the finest hard run",
        "against the finest run of its own world",
    )
    for ax, kind in ((against_hard, "against_hard"), (against_own, "against_own")):
        for world in ("hard", "soft"):
            points = [[p["wall_s"], p["error"]] for p in told["work_precision"][kind][world] if p["error"] > 0]
            assert drawn.points(drawn.line(ax, world)).tolist() == points
    titles = [ax.get_title() for ax in kept["convergence.png"].axes if ax.get_visible()]
    rows = {r["means"]: r for r in told["convergence"]["rows"].values()}
    for ax in kept["convergence.png"].axes[: len(titles)]:
        shown = [
            [e, d] for e, d in zip(told["convergence"]["stiffnesses_Pa"], rows[ax.get_title()]["differences"]) if d
        ]
        assert [drawn.points(one).tolist() for one in ax.lines if one.get_marker() == "s"] == [shown]
    shown = {"error", "overlap", "front_travel_m", *slopes.KEYS, *slopes.CURVES}
    assert (
        sorted(titles) == sorted(r["means"] for name, r in told["convergence"]["rows"].items() if name in shown)
        and len(titles) > 3
    )
    correlations = drawn.points(drawn.line(kept["network.png"].axes[0], "soft"))
    assert correlations[:, 1].tolist() == pytest.approx(told["convergence"]["forces"]["correlation"], nan_ok=True)


# ---- a check's sheet ------------------------------------------------------------------------------


def test_profiles_of_a_collapse(tmp_path):
    kinds = {"h": (0.1, 0.01, 0.2), "h/4": (0.025, 0.01, 0.2), "h/4, nothing taken back": (0.025, 0.01, 0.0)}
    x = np.linspace(0, 4, 5)
    profiles = {
        (7, *kind): {"x0": x, "height0": 9 - x, "x": x + n, "height": 5 - x + n}
        for n, kind in enumerate(kinds.values())
    }
    (ax,) = collapse._sheet(types.SimpleNamespace(folder=tmp_path), profiles, kinds, 7).axes
    grey, *curves = ax.lines
    assert drawn.points(grey).tolist() == [[a, 9 - a] for a in x] and (ax.get_xlabel(), ax.get_ylabel()) == (
        "x [m]",
        "height [m]",
    )
    for n, name in enumerate(kinds):
        one = drawn.line(ax, name)
        assert drawn.points(one).tolist() == [[a + n, 5 - a + n] for a in x] and drawn.legend(ax)[name] == drawn.colour(
            one
        )
    assert len({drawn.colour(one) for one in ax.lines}) == 4 and len(curves) == 3
