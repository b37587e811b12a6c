"""Slopes on walls with slip laws: their heat is what sliding loses, a run goes on from a checkpoint with the same
bytes, what is written and drawn, and what is refused.
"""

import json

import h5py
import numpy as np
import pytest
import shell
import yaml
from yade.nonsmooth import experiment, records, runs, section, similar, worlds
from yade.nonsmooth.measure import heated_surface
from yade.nonsmooth.model import geometry
from yade.nonsmooth.model.section import checks as section_checks, data as section_data
from yade.nonsmooth.slip import parameter_sets
from yade.nonsmooth.slip import laws
from yade.nonsmooth.studies.safety.asked import Asked, SafetyError
from yade.nonsmooth.studies.slope.columns import SURFACE_COLUMNS
from yade.nonsmooth.studies.slope.surface_series import means

pytestmark = pytest.mark.usefixtures("empty")
ZONE = {
    "thickness": 0.01,
    "heat_capacity": 2.85e6,
    "thermal_diffusivity": 1.45e-7,
    "hydraulic_diffusivity": 7e-8,
    "pressurization_coefficient": 6.7e4,
}


def heated(disks=150, release=1e5, surface=None, **slip_law):
    """The shipped slope on a circle, whose surface is pressurized as it slides; ``surface``: keys of its material."""
    made = section_data.plain(section.load("circle").with_disks(disks))
    made["materials"]["surface"] = {"bonded": False, "friction": 0.6, "rolling_friction": 0.1} | (
        surface or {"slip_law": slip_law or {"law": "thermal_pressurization", "parameters": ZONE}}
    )
    made["name"] = "heated"
    if release is None:
        del made["water"]
    else:
        made["water"] |= {"release_distance": release}
    return made


@pytest.fixture(scope="module")
def slid(tmp_path_factory):
    """A run to its end: (folder, the wall's material, summary)."""
    folder = tmp_path_factory.mktemp("heated") / "run"
    course = experiment.begin(section.of(heated()), folder)
    course.run()
    told = course.summarise()
    return folder, course.slope.wall_material("circle").heat, told


def test_the_slope_fails_and_its_surface_is_heated_by_what_sliding_loses(slid):
    folder, heat, told = slid
    run = runs.open_run(folder)
    assert told["times_s"]["t2"] is not None, told["verdict_says"]
    lost = told["sliding_on_walls_J_per_m"]["circle"]
    assert heat == pytest.approx(lost, rel=1e-10) and heat > 1e5  # sums of the same numbers in another order
    assert told["heat_on_walls_J_per_m"] == {"circle": heat}  # the ground has no slip law
    cells = run.slip_surface
    times, count = np.unique(cells["time_s"]), cells["cell"].max() + 1
    assert len(cells["step"]) == len(times) * count and set(cells["wall"]) == {"circle"}
    assert np.array_equal(times, run.series["time_s"])
    # along the circle, from the crown's end on
    of_first = {name: values[:count] for name, values in cells.items() if name != "wall"}
    steps = np.hypot(np.diff(of_first["x_m"]), np.diff(of_first["y_m"]))
    assert steps == pytest.approx(np.full(count - 1, of_first["length_m"][0]), rel=0.02)
    # nothing had slid before gravity acted; most strength is gone in the end where the mass went, and only there
    end = {name: values[-count:] for name, values in cells.items() if name != "wall"}
    far = end["slip_m"] > 10
    assert far.any() and end["friction"][far].max() < 0.1 * 0.6 and end["hottest_degC"][far].max() > 20
    still = end["slip_m"] == 0
    assert end["friction"][still] == pytest.approx(0.6) and end["temperature_degC"][still] == pytest.approx(15)
    assert np.all(end["hottest_degC"] >= end["temperature_degC"]) and np.isnan(cells["melt_m"]).all()
    assert np.all(end["pressure_Pa"] >= 0) and run.frame("slip_surface").shape == (len(cells["step"]), 17)
    assert len(run.figure("slip_surface").axes) == 4  # two panels with their scales


def test_a_slip_law_acts_when_the_slope_has_settled(slid):
    """Settling is how it is loaded: disks slide on the wall then, and it keeps the friction before slip."""
    folder, _, _ = slid
    run = runs.open_run(folder)
    settling = run.slip_surface["time_s"] <= run.series["time_s"][run.series["stage"] == 0].max()
    assert np.count_nonzero(settling) > 100
    assert not run.slip_surface["slip_m"][settling].any()
    assert run.slip_surface["friction"][settling] == pytest.approx(0.6, rel=1e-12)  # rounding
    assert run.slip_surface["hottest_degC"][settling] == pytest.approx(15, rel=1e-12)
    assert run.slip_surface["slip_m"][~settling].any()


def test_the_series_tells_how_much_of_the_surface_is_weak(slid):
    """As its cells have it, by the load that they bear; so weakening is known to have begun."""
    folder, _, told = slid
    run = runs.open_run(folder)
    cells, series = run.slip_surface, run.series
    rows = len(series["time_s"])
    length, stress, slip, left = (
        cells[name].reshape(rows, -1) for name in ("length_m", "normal_stress_Pa", "slip_m", "friction")
    )  # every row has all cells
    load, left = length * stress, left / 0.6
    for name, values in (("cells_slip_m", slip), ("cells_friction_rel", left), ("cells_weakened_rel", left < 0.5)):
        expected = (values * load).sum(axis=1)[1:] / load.sum(axis=1)[1:]  # nothing presses in the first
        assert series[name][1:] == pytest.approx(expected, rel=1e-6, abs=1e-12), name  # numbers as they are written
        assert run.columns[name].unit == ("m" if name.endswith("_m") else "1")
    assert series["cells_weakened_rel"][0] == 0 and series["cells_weakened_rel"][-1] > 0.1
    assert not series["weakened_disks"].any()
    assert told["times_missing"].get("t3") != "no slip surface weakened"


def test_cells_have_their_middles_on_the_bent_wall(slid):
    """Half way along each, where the chord's middle is off it."""
    cells = runs.open_run(slid[0]).slip_surface_arrays["circle"]
    start, end = geometry.pieces([section.of(heated()).of_role("slip")[0].points])
    off = geometry.nearest(np.column_stack([cells["x_m"], cells["y_m"]]), start, end)[0]
    assert len(off) > 3 and off.max() < 1e-9 * cells["length_m"].sum()


def test_the_end_of_a_run_leaves_arrays_of_all_rows(slid):
    """With what the law has not, melt and reactions, left out, and units and meanings as the columns have them."""
    folder, run = slid[0], runs.open_run(slid[0])
    rows, arrays = run.slip_surface, records.read_surface_arrays(folder / "slip_surface.h5")
    assert list(arrays) == ["circle"] and sorted(arrays["circle"]) == sorted(run.slip_surface_arrays["circle"])
    one, count = arrays["circle"], rows["cell"].max() + 1
    assert set(SURFACE_COLUMNS) - set(one) == {"wall", "cell", "reacted", "melt_m"}
    for name, values in one.items():
        table = rows[name].reshape(-1, count)
        expected = {"step": table[:, 0], "time_s": table[:, 0], "x_m": table[0], "y_m": table[0], "length_m": table[0]}
        assert np.array_equal(values, expected.get(name, table)), name
    with h5py.File(folder / "slip_surface.h5", "r") as file:
        for name, dataset in file["circle"].items():
            assert dict(dataset.attrs) == {"unit": SURFACE_COLUMNS[name].unit, "meaning": SURFACE_COLUMNS[name].meaning}


def test_cells_say_where_the_water_of_the_zone_has_boiled(tmp_path):
    """Of a thin zone whose water hardly expands: from where it is too hot for a liquid under 0.1 MPa and the pressure
    of the zone, on.
    """
    zone = ZONE | {"thickness": 1e-3, "pressurization_coefficient": 3e3}
    course = experiment.begin(section.of(heated(law="thermal_pressurization", parameters=zone)), tmp_path / "run")
    course.run()
    cells = runs.open_run(tmp_path / "run").slip_surface_arrays["circle"]
    boiled = cells["vapour"]
    line = np.vectorize(laws.vapour_pressure)(cells["temperature_degC"])
    beyond = line > 1e5 + cells["pressure_Pa"]
    assert set(np.unique(boiled)) == {0, 1} and np.all(boiled[beyond] == 1)
    assert np.array_equal(boiled[-1] == 1, beyond.any(axis=0)) and np.all(np.diff(boiled, axis=0) >= 0)


def test_ground_with_a_slip_law_is_no_slip_surface(tmp_path):
    made = heated(surface={"rolling_friction": 0.1})
    made["materials"]["ground"] |= {"slip_law": {"law": "thermal_pressurization", "parameters": ZONE}}
    run = experiment.begin(section.of(made), tmp_path / "run")
    run.run(end=0.1)
    found = runs.open_run(tmp_path / "run")
    assert len(found.slip_surface["cell"]) and "cells_slip_m" not in found.series


def test_means_are_by_the_load_that_cells_bear():
    """Two walls, of one cell of 1 m and of cells of 2 and 5 m, which bear 4, 4 and 5 N; by length where they bear none."""
    one = {"length_m": [1.0], "normal_stress_Pa": [4.0], "slip_m": [8.0], "friction": [0.15]}
    other = {"length_m": [2.0, 5.0], "normal_stress_Pa": [2.0, 1.0], "slip_m": [4.0, 0.0], "friction": [0.3, 0.4]}
    one, other = ({name: np.array(values) for name, values in wall.items()} for wall in (one, other))
    assert means([(one, 0.6), (other, 0.4)]) == {
        "cells_slip_m": pytest.approx(48 / 13),
        "cells_friction_rel": pytest.approx((4 * 0.25 + 4 * 0.75 + 5) / 13),
        "cells_weakened_rel": pytest.approx(4 / 13),
    }
    free = [wall | {"normal_stress_Pa": 0 * wall["length_m"]} for wall in (one, other)]
    assert means([(free[0], 0.6), (free[1], 0.4)])["cells_slip_m"] == pytest.approx(2.0)
    none = {name: np.array([]) for name in one}
    assert list(means([(none, 0.6)]).values()) == [0.0, 1.0, 0.0]


def test_cells_have_the_length_that_a_section_gives_them(tmp_path):
    made = heated()
    made["materials"]["surface"]["slip_law"]["cell_length"] = 40.0
    run = experiment.begin(section.of(made), tmp_path / "run")
    run.run(end=0.1)
    length = runs.open_run(tmp_path / "run").slip_surface["length_m"]
    whole = section.of(made).of_role("slip")[0].points
    whole = np.hypot(*np.diff(whole, axis=0).T).sum()
    assert length[0] == pytest.approx(whole / round(whole / 40.0), rel=1e-3)
    for wrong in (0, -1, "long", 0.001):  # the last one of disks of a metre and more
        made["materials"]["surface"]["slip_law"]["cell_length"] = wrong
        with pytest.raises(section.SectionError, match="cell_length"):
            section.of(made)


def test_a_run_goes_on_from_its_checkpoint_with_the_same_bytes(slid, tmp_path):
    folder, _, told = slid
    moving = told["times_s"]["t2"] + 0.5
    course = experiment.begin(section.of(heated()), tmp_path / "run")
    course.run(end=moving)
    course.checkpoint()
    arrays = tmp_path / "run" / "slip_surface.h5"
    assert arrays.exists()
    resumed = experiment.resume(section.of(heated()), tmp_path / "run")
    assert not arrays.exists()  # which ended before the run does
    resumed.run()
    for name in ("slip_surface.csv", "slip_surface.h5", "series.csv"):
        assert (tmp_path / "run" / name).read_bytes() == (folder / name).read_bytes(), name


def test_other_walls_have_no_such_file(tmp_path):
    run = experiment.begin(section.of(heated(surface={"rolling_friction": 0.1})), tmp_path / "run")
    run.run(end=0.1)
    assert not list((tmp_path / "run").glob("slip_surface.*"))
    for name in ("slip_surface", "slip_surface_arrays"):
        with pytest.raises(runs.RunError, match="slip_surface.csv"):
            getattr(runs.open_run(tmp_path / "run"), name)


@pytest.mark.parametrize(
    "made, words",
    [
        (lambda: heated(set="vaiont", law="tabulated"), "set and law are both there"),
        (lambda: heated(set="vaiont", parameters={"friction": 0.4}), "friction 0.4 before slip; give 0.4"),
        (lambda: heated(set="marble", parameters={"initial_friction": 0.5}), "friction 0.5 before slip; give 0.5"),
        (lambda: heated(set="vajont"), "'vajont': it must be one of vaiont"),
        (
            lambda: heated(law="thermal_pressurization", parameters={"thickness": 1.0}),
            "pressurization_coefficient .* is missing",
        ),
        (lambda: heated(law="melting"), "'melting'"),
        (lambda: heated(law="thermal_pressurization", parameters=ZONE | {"heat_capacity": 2.85}), "2.85 MJ"),
        (lambda: heated(law="thermal_pressurization", parameters=ZONE | {"thermal_diffusivity": 0.145}), "0.145 mm²/s"),
        (lambda: heated(law="thermal_pressurization", parameters=ZONE | {"thickness": 10.0}), "10 mm are 0.01"),
        (lambda: heated(law="thermal_pressurization", parameters=ZONE | {"thickness": -1.0}), "thickness = -1"),
        (lambda: heated(release=5.0), "release_distance: 5 m, and the slip law of the wall circle"),
        (
            lambda: heated(
                surface={
                    "slip_law": {"law": "thermal_pressurization", "parameters": ZONE},
                    "slip_weakening": {"law": "step", "critical_slip": 1.0},
                }
            ),
            "slip_weakening is there too",
        ),
        (
            lambda: heated(
                surface={"slip_law": {"law": "thermal_pressurization", "parameters": ZONE}, "residual_friction": 0.1}
            ),
            "residual_friction",
        ),
    ],
)
def test_what_makes_no_sense_is_refused_before_anything_is_packed(made, words):
    with pytest.raises(section.SectionError, match=words):
        section.of(made())


def test_layers_and_interfaces_have_no_cells():
    law = {"slip_law": {"law": "thermal_pressurization", "parameters": ZONE | {"friction": 0.4}}}
    made = heated()
    made["materials"]["soil"] |= law
    made["materials"]["soil"] |= {"friction": 0.4, "residual_friction": 0.4}
    with pytest.raises(section.SectionError, match="give slip_law to materials of walls only"):
        section.of(made)


def test_soft_contacts_searches_and_other_sizes_are_refused(tmp_path):
    made = section.of(heated())
    with pytest.raises(worlds.WorldError, match="slip_law needs rigid contacts"):
        worlds.Soft(1e8, 1.0).wall_material(made.materials["surface"])
    with pytest.raises(SafetyError, match="is that of a slip law, which is not divided"):
        Asked(made)
    with pytest.raises(section.SectionError, match="no similar one"):
        similar.scaled(made, 2.0)
    assert similar.mirrored(similar.mirrored(made)).materials == made.materials


def test_several_walls_have_their_rows(tmp_path):
    made = heated()
    made["materials"]["ground"] = made["materials"]["surface"]
    run = experiment.begin(section.of(made), tmp_path / "run")
    run.run(end=0.2)
    cells = runs.open_run(tmp_path / "run").slip_surface
    assert list(dict.fromkeys(cells["wall"].tolist())) == ["valley", "circle", "plateau"]
    arrays = tmp_path / "run" / "slip_surface.h5"
    assert list(records.read_surface_arrays(arrays)) == ["circle", "plateau", "valley"]
    run.attach()  # it goes on, and arrays of its first part would miss the rest
    assert not arrays.exists()


def test_a_mirrored_slope_has_mirrored_cells(tmp_path):
    made, rows = section.of(heated()), []
    for k, one in enumerate((made, similar.mirrored(made))):
        run = experiment.begin(one, tmp_path / str(k))
        run.run(end=2.0)
        cells = runs.open_run(tmp_path / str(k)).slip_surface
        order = np.lexsort((one.side * cells["x_m"], cells["step"]))
        rows.append({name: values[order] for name, values in cells.items() if name not in ("cell", "x_m", "wall")})
    for name in ("length_m", "slip_m", "normal_stress_Pa", "friction", "hottest_degC"):
        assert np.array_equal(rows[0][name], rows[1][name]), name


def test_a_law_without_friction_of_its_own_has_that_of_the_material():
    """Of a set too, so that a sweep over the friction varies one key; what a set says of other things stays."""
    made = section.of(heated(set="vaiont_thin")).with_values({"materials.surface.friction": 0.5})
    law = made.materials["surface"].slip_law.make()
    assert law.friction() == pytest.approx(0.5, rel=1e-12) and law.values["thickness"] == 0.0014  # rounding


def test_a_law_with_more_friction_than_the_mass_bears_is_warned_of():
    """Of dry rock, which melts with a friction of 1, on the paper's rock: samples of its contacts have 37.7°, its envelope
    37.2°. One of 0.7 is not. Without an envelope the contacts' friction counts.
    """

    def notes(before, law, **layers):
        made = section_data.plain(section.load("jiufengershan_heated"))
        made["materials"]["dp"] = {"bonded": False, "friction": before, "rolling_friction": 0.1, "slip_law": law}
        made["materials"]["rock"] = {k: v for k, v in (made["materials"]["rock"] | layers).items() if v is not None}
        return [note for note in section_checks.notes(section.of(made)) if "slip law" in note]

    (found,) = notes(0.8, {"set": "gabbro"})
    assert "the slip law of dp has a friction of up to 1, and rock, that lies on such walls, bears 0.76" in found
    assert notes(0.7, {"set": "jiufengershan"}) == []
    (found,) = notes(0.7, {"set": "jiufengershan"}, envelope=None, friction=0.15)
    assert "bears 0.5" in found  # some 27°, between the rocks with 0.1 and 0.3 of the table


def test_shipped_sets_may_be_written_out(tmp_path):
    """The numbers of each: a reaction's rate is 3e15 a second."""
    values = {key: value for key, (value, *_) in parameter_sets.values("calcite").items()}
    made = section.of(heated(surface={"friction": 0.6, "slip_law": {"law": "decomposition", "parameters": values}}))
    assert made.materials["surface"].slip_law.make().values["reaction_rate"] == 2.95e15


def test_it_is_written_down_as_it_is(tmp_path):
    made = section.of(heated(set="vaiont", parameters={"friction": 0.6, "thickness": 0.0014}, cell_length=25.0))
    assert made.materials["surface"].slip_law.cell_length == 25.0
    section_data.write(made, tmp_path / "section.yaml")
    assert section.load(str(tmp_path / "section.yaml")).materials == made.materials


def test_the_script_that_compares_slip_laws(tmp_path):
    """Of zones of 1 and of 5 cm, two packings each: what it tells is what its runs have."""
    (tmp_path / "heated.yaml").write_text(yaml.safe_dump(heated()))
    done = shell.example(
        "heated_slopes.py",
        tmp_path,
        section=f"'{tmp_path}/heated.yaml'",
        key="'materials.surface.slip_law.parameters.thickness'",
        values="[0.01,0.05]",
        labels=None,
        disks=150,
        seeds=2,
        folder=f"'{tmp_path}/out'",
        beside="'circle'",
        beside_key="'materials.surface.slip_weakening.critical_slip'",
        beside_values="[1,3]",
        beside_labels="['told','told_at_3_m']",
    )
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "out" / "heated.json").read_text())
    assert {name: (told[name]["packings"], told[name]["failed"]) for name in ("0_01", "0_05")} == {
        "0_01": (2, 2),
        "0_05": (2, 2),
    }
    for value, key in ((0.01, "0_01"), (0.05, "0_05")):
        of_runs = [runs.open_run(tmp_path / "out" / "runs" / f"thickness={value}_seed={seed}") for seed in (1, 2)]
        lost = [heated_surface.lost(run.series, 0.5) for run in of_runs]
        numbers = told[key]["when_failed"]
        assert numbers["slip_m_50"]["mean"] == pytest.approx(np.mean([one["slip_m"] for one in lost]))
        assert numbers["after_s_50"]["mean"] == pytest.approx(np.mean([one["after_s"] for one in lost]))
        assert numbers["front_travel_m"]["mean"] == pytest.approx(
            np.mean([run.summary["front_travel_m"] for run in of_runs])
        )
        assert f"{value}: 2 of 2 failed by water" in done.stdout
    # beside them, slopes whose surface is told to weaken
    assert {name: (told[name]["packings"], told[name]["failed"]) for name in ("1", "3")} == {"1": (2, 2), "3": (2, 2)}
    of_runs = [runs.open_run(tmp_path / "out" / "beside" / "runs" / f"critical_slip=3_seed={seed}") for seed in (1, 2)]
    assert told["3"]["when_failed"]["front_travel_m"]["mean"] == pytest.approx(
        np.mean([run.summary["front_travel_m"] for run in of_runs])
    )
    assert "slip_m_50" not in told["3"]["when_failed"] and "told at 3 m: 2 of 2 failed by water" in done.stdout
    # a thick zone takes more slip, and D_c goes with its thickness
    thin, thick = (told[key]["when_failed"]["slip_m_50"]["mean"] for key in ("0_01", "0_05"))
    assert thick > 2 * thin
    for name in ("heated", "slip_surface"):
        assert (tmp_path / "out" / f"{name}.png").stat().st_size > 1000


def test_a_section_with_a_slip_law_is_read_without_yade_and_without_a_path():
    """As a sweep of it is planned: the laws' library is found in the build."""
    code = "import sys; sys.path.insert(0, 'py'); from nonsmooth import section; print(section.load('vaiont').name)"
    done = shell.run("/usr/bin/python3", "-c", code, cwd=shell.ROOT, PYTHONPATH="")
    assert done.stdout == "Vaiont\n", done.stderr
