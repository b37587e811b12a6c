"""Readings of what the paper leaves open: what each changes, how near it is to the paper, and that runs which several
share are made once.
"""

import dataclasses
import math

import numpy as np
import pytest
from shapely.geometry import LineString, Polygon
from shapely.ops import unary_union
from yade.nonsmooth import records, section
from yade.nonsmooth.laboratory import biaxial_test
from yade.nonsmooth.model.section import data as section_data
from yade.nonsmooth.studies.paper import reading_numbers, readings, readings_figure as figures

import drawn
from made_up_readings import made_up

SHIPPED = readings.READINGS[reading_numbers.SHIPPED]


def all_of(reading, platens=biaxial_test.BiaxialTest.platens):
    return section_data.plain(readings.slope_of(reading, 3000, 1)), readings.tests_of(reading, 400, [1], platens)


def test_the_default_is_the_shipped_section_and_its_rock():
    slope, tests = all_of(SHIPPED)
    assert slope == section_data.plain(section.load("jiufengershan").with_disks(3000))
    assert {t.material.bond_creation_distance for t in tests} == {slope["materials"]["rock"]["bond_creation_distance"]}
    assert [t.confining for t in tests] == list(reading_numbers.PRESSURES)
    assert {t.platens for t in tests} == {biaxial_test.BiaxialTest.platens}


def test_each_reading_is_another_one():
    """No two have both the same slopes and the same tests: a slip of the pen in a key or a value would make one of them
    the default.
    """
    told = {(name, p): repr(all_of(one, p)) for name, one in readings.READINGS.items() for p in one.platens}
    assert len(set(told.values())) == len(told)


def test_samples_stand_between_both_platens_or_their_own():
    """What is about the boundary itself stands once; all others between smooth and rough ones, and in nothing else do
    the two differ.
    """
    once = {name: one.platens for name, one in readings.READINGS.items() if one.platens != readings.PLATENS}
    assert once == {"membrane": ("rough",), "glued": ("glued",)}
    smooth, rough = (all_of(SHIPPED, p)[1] for p in readings.PLATENS)
    assert [dataclasses.replace(t, platens="rough") for t in smooth] == rough != smooth


@pytest.mark.parametrize("distance", [0.015, 0.02, 0.025])
def test_closing_bonds_close_in_the_rock_and_at_fb(distance):
    slope, tests = all_of(readings.READINGS[f"closing-{distance:g}"])
    for material in (slope["materials"]["rock"], slope["materials"]["fb"]):
        assert (material["bond_creation_distance"], material["bonds_close"]) == (distance, True)
    assert {(t.material.bond_creation_distance, t.material.bonds_close) for t in tests} == {(distance, True)}


@pytest.mark.parametrize(
    "name", [name for name in readings.READINGS if name.startswith(("ellipse-", "gap-", "packed-0"))]
)
def test_a_readings_name_has_its_number(name):
    """Both half axes of the ellipse, or the largest gap that is bonded, in the slope and in the samples; the other of
    the two is the shipped one.
    """
    kind, number = name.split("-")
    slope, tests = all_of(readings.READINGS[name])
    shipped = all_of(SHIPPED)[0]["materials"]["rock"]
    ellipse, gap = shipped["bond_ellipse"], shipped["bond_creation_distance"]
    wanted = ([float(number)] * 2, gap) if kind == "ellipse" else (ellipse, float(number))
    rock = slope["materials"]["rock"]
    assert (list(rock["bond_ellipse"]), rock["bond_creation_distance"]) == (list(wanted[0]), wanted[1])
    assert {(t.material.bond_ellipse, t.material.bond_creation_distance) for t in tests} == {
        (tuple(wanted[0]), wanted[1])
    }


def test_residual_strength_reaches_as_far_as_bonds_are_made():
    slope, tests = all_of(readings.READINGS["residual-0.025"])
    assert {t.adhesion_range for t in tests} == {t.material.bond_creation_distance for t in tests} == {0.025}
    assert slope == all_of(SHIPPED)[0]  # no key of a section has it


@pytest.mark.parametrize("aspect", [1.5, 3])
def test_samples_have_the_aspect_of_their_reading(aspect):
    slope, tests = all_of(readings.READINGS[f"aspect-{aspect:g}"])
    assert {t.shape.aspect for t in tests} == {aspect} and slope == all_of(SHIPPED)[0]


@pytest.mark.parametrize("name", ["packed", "packed-0.05"])
def test_what_is_not_pressed_is_so_in_both(name):
    slope, tests = all_of(readings.READINGS[name])
    assert not slope["disks"].get("pressed") and {t.shape.friction for t in tests} == {None}


@pytest.mark.parametrize(
    "name, thickness, inclination", [("toe-67.5", 67.5, 90), ("backstop-70", 65, 70), ("backstop-110", 65, 110)]
)
def test_the_toe_has_its_thickness_and_the_backstop_its_inclination(name, thickness, inclination):
    """Thickness normal to DP, and the angle in the mass between DP, upslope, and FB: to the rounding of the file, 1 mm
    in 65 m. Layers end on FB in equal parts, and the crown stays.
    """
    made, shipped = readings.slope_of(readings.READINGS[name], 3000, 1), section.load("jiufengershan")
    top = made.wall("FB").points[-1]
    assert np.dot(top, made.normal) == pytest.approx(thickness, abs=2e-3)
    assert math.degrees(math.acos(np.dot(top, made.downslope) / -np.hypot(*top))) == pytest.approx(
        inclination, abs=2e-3
    )
    assert made.wall("SS").points[0] == pytest.approx(top) and made.wall("DP").points == pytest.approx(
        shipped.wall("DP").points
    )
    for k, (layer, before) in enumerate(zip(made.layers, shipped.layers)):
        # the file gives them to the millimetre
        assert layer.points[:2] == pytest.approx(np.array([k / 5 * top, (k + 1) / 5 * top]), abs=1e-3)
        assert layer.points[2:] == pytest.approx(before.points[2:])


def test_layers_of_one_thickness_are_cut_by_the_surface():
    """Above DP: bottoms at 13.5 m times their number; five at the foot, the rest of 65 m being the uppermost's; three
    at the crown. Together they fill what the shipped ones fill, overlap nowhere, and none is thinner than the largest
    disk."""
    made, shipped = (readings.section_of(readings.READINGS[name]) for name in ("layers-13.5", reading_numbers.SHIPPED))
    axes = np.array([np.negative(shipped.downslope), shipped.normal])  # up DP, and off it
    polygons = [Polygon(np.array(layer.points) @ axes.T) for layer in made.layers]
    whole = unary_union([Polygon(np.array(layer.points) @ axes.T) for layer in shipped.layers])
    # the file gives places to a millimetre, along borders of 1.5 km: 2 m²
    assert unary_union(polygons).symmetric_difference(whole).area < 2 and sum(
        p.area for p in polygons
    ) == pytest.approx(whole.area, abs=2)
    for k, polygon in enumerate(polygons):
        at_foot = [off for up, off in polygon.exterior.coords if abs(up) < 1e-2]
        assert (min(at_foot), max(at_foot)) == pytest.approx((13.5 * k, min(13.5 * (k + 1), 65)), abs=2e-3)
    at_crown = whole.intersection(LineString([(1440, 0), (1440, 70)]))
    pieces = [p.intersection(at_crown).length for p in polygons]
    surface = 65 - (65 - 42) * 1440 / 1458
    assert pieces == pytest.approx([13.5, 13.5, surface - 27, 0, 0], abs=2e-3)
    for polygon in polygons[3:]:
        up = polygon.exterior.bounds[2]
        assert polygon.intersection(LineString([(up - 1e-3, 0), (up - 1e-3, 70)])).length == pytest.approx(4, abs=2e-3)


PAPER = {name: wanted for name, (wanted, _) in reading_numbers.PAPER.items()}


def test_misses_are_in_units_of_what_is_allowed():
    assert set(reading_numbers.misses(PAPER).values()) == {0.0}
    off = {name: wanted + allowed for name, (wanted, allowed) in reading_numbers.PAPER.items()} | {"strain_peak": 0.02}
    assert reading_numbers.misses(off) == pytest.approx(dict.fromkeys(PAPER, 1.0))
    # half the strain is as far from it as twice
    assert reading_numbers.misses(PAPER | {"strain_peak": 0.005, "water_highest_m": None}) == pytest.approx(
        dict.fromkeys(PAPER, 0.0) | {"strain_peak": 1.0, "water_highest_m": None}
    )


def test_peaks_to_both_sides_of_the_papers_are_no_peak_at_the_papers():
    """At an eighth and at eight times of 1 % the mean logarithm is that of 1 %: each sample misses by three octaves,
    and so do all.
    """
    assert reading_numbers.misses(PAPER | {"strain_peak": [[0.01 / 8, 0.08], [0.08, 0.01 / 8]]})[
        "strain_peak"
    ] == pytest.approx(3.0)


def test_the_tables_tell_all_strains_of_peaks_and_no_mean_of_them():
    """Of three packings one has its peak at 0.1 %; a reading between two kinds of platens has two lines, the nearer one
    first, and what shares its samples has none of its own in the second table.
    """
    strains = [[0.001, 0.01, 0.012], [0.006, 0.021, 0.019], [0.01, 0.0049, 0.011]]
    near, far = made_up("a", "smooth", strain_peak=strains), made_up("a", "rough", friction_peak_deg=48.5)
    other = made_up("b", "smooth", friction_peak_deg=40.5, folder=near["folder"])
    (title, heads, lines), (_, sample_heads, samples) = reading_numbers.tables([far, other, near])
    assert title == "Readings" and {len(line) for line in lines} == {len(heads)}
    assert [line[:2] for line in lines] == [["the paper", ""], ["b", "smooth"], ["a", "smooth"], ["a", "rough"]]
    assert [line[-2] for line in lines[2:]] == ["6 of 9", "9 of 9"]
    assert [line[:2] for line in samples] == [["a", "smooth"], ["a", "rough"]] and len(samples[0]) == len(sample_heads)
    # under 8 MPa
    assert samples[0][2:4] == ["1.00, 2.10, 0.49", "1 of 3"] and samples[0][5] == "2, 2, 2"


def test_a_line_of_samples_by_hand():
    """Two samples with 1 to both sides of 24.25 MPa: Student's 12.706 of one degree of freedom is the interval."""
    one = {"strain_peak": 0.0104, "deviator_peak_MPa": 23.25, "bands_at_1_percent": 2, "residual_deg": {}}
    other = {"strain_peak": 0.0021, "deviator_peak_MPa": 25.25, "bands_at_1_percent": 1, "residual_deg": {}}
    for sample, angle in ((one, 26.0), (other, 28.0)):
        sample["residual_deg"] = dict.fromkeys(reading_numbers.WINDOWS, angle)
    found = reading_numbers._of_samples([one, other])
    assert found[:4] == ["1.04, 0.21", "1 of 2", "24.2 ± 12.7", "2, 1"]
    assert found[4:] == ["27.0 ± 12.7"] * len(reading_numbers.WINDOWS)


def test_what_each_sample_says_by_hand(tmp_path):
    """Two pressures, whose circles touch the line of 50 kPa and 30°; stresses over 4 to 6 and 8 to 10 % of strain are
    those of steps, of which half a window is one step and half another.
    """
    root, tests = math.tan(math.radians(60)), []
    for confining in (0.5e6, 8e6):
        tests.append(
            {"confining_Pa": confining, "seed": 3, "disks": 1900, "strain_peak": 0.0012, "sigma3_peak_Pa": confining}
            | {"sigma1_peak_Pa": confining * root**2 + 2 * 50e3 * root, "bands": [{"angle_deg": 60.0}, None]}
        )
    strain = np.arange(1, 1001) * 1e-4
    # the plateau falls at 5 % from 32 to 16 MPa
    axial = np.where(strain <= 0.05 + 1e-9, 32e6, 16e6)
    series = {"step": np.arange(1000), "strain": strain, "sigma1_top_Pa": 1.1 * axial, "sigma1_bottom_Pa": 0.9 * axial}
    series |= {"sigma3_left_Pa": np.full(1000, 7e6), "sigma3_right_Pa": np.full(1000, 9e6)}
    (tmp_path / "tests" / "8MPa-seed3").mkdir(parents=True)
    with records.SeriesWriter(tmp_path / "tests" / "8MPa-seed3" / "series.csv", list(series)) as writer:
        writer.write(*({name: float(values[k]) for name, values in series.items()} for k in range(1000)))
    (found,) = reading_numbers.samples_of(tests, tmp_path)
    assert (found["seed"], found["disks"], found["strain_peak"], found["bands_at_1_percent"]) == (3, 1900, 0.0012, 1)
    assert found["deviator_peak_MPa"] == pytest.approx(16 + 0.1 * root, rel=1e-9)  # rounding, as below
    assert found["cohesion_peak_kPa"] == pytest.approx(50.0, rel=1e-6)
    assert found["residual_deg"] == pytest.approx(
        {"4 to 6 %": math.degrees(math.asin((24 - 8) / (24 + 8))), "8 to 10 %": math.degrees(math.asin(8 / 24))}
    )


def test_the_water_of_a_passive_toe_is_nearer_to_the_papers_on_the_disks_than_on_the_bulk():
    """Rankine's passive toe with Table 1: below 22.5 m in both, whichever way that is measured, and nearer to it with
    water on the disks, which is the shipped reading.
    """
    found = reading_numbers.toe_water()
    # to the tenth that the page gives them with
    assert {volume: one["normal_m"] for volume, one in found.items()} == pytest.approx(
        {"disk": 18.9, "bulk": 16.1}, abs=0.05
    )
    for one in found.values():
        assert one["normal_m"] < one["upright_m"] < 22.5
        assert one["upright_m"] * math.cos(math.radians(21)) == pytest.approx(one["normal_m"], rel=1e-5)  # DP's ends


def test_each_number_of_a_reading_has_a_column_with_the_papers_band():
    rows = [
        made_up("shipped", "smooth"),
        made_up("shipped", "rough", friction_peak_deg=44.5),
        made_up("glued", "glued"),
    ]
    axes = dict(zip((*reading_numbers.SHOWN, "strain_peak", "distance"), figures.beside(rows).axes))
    for name, (wanted, allowed) in reading_numbers.PAPER.items():
        low, high = (wanted / 2, wanted * 2) if name == "strain_peak" else (wanted - allowed, wanted + allowed)
        factor = 100 if name == "strain_peak" else 1
        (band,) = axes[name].patches
        x = np.array(band.get_xy())[:, 0]
        assert (x.min(), x.max()) == pytest.approx((factor * low, factor * high))
    assert [text.get_text() for text in axes["cohesion_peak_kPa"].get_yticklabels()] == ["shipped", "glued"]
    dots = {
        name: [
            (line.get_marker(), *np.round(line.get_data(), 6).ravel())
            for line in ax.lines
            if len(line.get_xdata()) == 1
        ]
        for name, ax in axes.items()
    }
    assert dots["friction_peak_deg"] == [("o", 38.5, -0.17), ("o", 44.5, 0.17), ("s", 38.5, 1.0)]
    fills = [line.get_markerfacecolor() for line in axes["distance"].lines]
    assert fills[1] == "white" != fills[0]
    # the shipped one stands out
    orange, ink = figures.style.LINES["orange"], figures.style.INK
    assert [line.get_color() for line in axes["distance"].lines] == [orange, orange, ink]
    assert [text.get_color() for text in axes["cohesion_peak_kPa"].get_yticklabels()] == [orange, ink]
    assert {len(line.get_xdata()) for line in axes["strain_peak"].lines} == {9}  # three samples under three pressures


def test_stress_against_strain_of_each_sample_beside_the_papers_peaks():
    """Two packings that peak at 0.4 and at 1.5 % of strain; shipped bonds above, closing ones below, Δ from left to
    right.
    """
    strain = np.arange(1, 1001) * 1e-4

    def curve(at, height):
        axial = height - 1e9 * np.abs(strain - at)
        return {"strain": strain, "sigma1_top_Pa": axial, "sigma1_bottom_Pa": axial}

    names = [name for line in figures.BONDS.values() for name in line]
    assert names == ["gap-0.015", "gap-0.02", "shipped", "closing-0.015", "closing-0.02", "closing-0.025"]
    curves = {name: {1: curve(0.004, 3e7 + 1e6 * k), 2: curve(0.015, 2.5e7)} for k, name in enumerate(names)}
    axes = figures.stress_strain(curves).axes
    assert axes[0].get_xlim() == (0, 6)
    short = {name: {1: {key: values[:400] for key, values in of[1].items()}} for name, of in curves.items()}
    assert figures.stress_strain(short).axes[0].get_xlim() == pytest.approx((0, 4))
    assert [ax.get_title() for ax in axes] == ["Δ = 0.015 ℓ", "Δ = 0.02 ℓ", "Δ = 0.025 ℓ", "", "", ""]
    for k, ax in enumerate(axes):
        (band,) = ax.patches
        x = np.array(band.get_xy())[:, 0]
        assert (x.min(), x.max()) == pytest.approx((1, 2))
        peaks = [drawn.points(line)[0] for line in ax.lines if line.get_marker() == "o"]
        # of means over 0.2 % of strain: below the tip by a quarter of that fall, 0.5 MPa
        assert peaks[0] == pytest.approx((0.4, 30 + k - 0.5), abs=0.03)
        assert peaks[1] == pytest.approx((1.5, 24.5), abs=0.03)


def test_stress_against_strain_is_drawn_where_all_of_its_readings_were_tested(tmp_path, monkeypatch):
    """Between smooth platens all six, between rough ones five; a reading that shares its samples has those of the
    folder that it names.
    """
    kept, rows = drawn.keep(monkeypatch, figures.style), []
    for k, name in enumerate(name for line in figures.BONDS.values() for name in line):
        folder = tmp_path / f"kept{k}" / "tests" / "8MPa-seed1"
        folder.mkdir(parents=True)
        columns = ("step", "strain", "sigma1_top_Pa", "sigma1_bottom_Pa")
        with records.SeriesWriter(folder / "series.csv", columns) as writer:
            writer.write(*(dict(zip(columns, (i, 1e-3 * (i + 1), 1e6 * (k + 10), 1e6 * (k + 10)))) for i in range(20)))
        rows += [
            made_up(name, platens, [[0.01] * 3], folder=f"kept{k}")
            for platens in readings.PLATENS
            if (name, platens) != ("gap-0.02", "rough")
        ]
    assert [path.name for path in figures.stress_strain_of(rows, tmp_path)] == ["readings_stress_strain.png"]
    (fig,) = kept.values()
    assert [drawn.points(ax.lines[0])[0][1] for ax in fig.axes] == pytest.approx(range(10, 16))


def test_small_runs_and_what_is_shared(tmp_path):
    """Sides rule samples alone, the backstop slopes alone: of three readings there are two kinds of samples and two of
    slopes. What stands between platens of its own is run whichever are asked for.
    """
    chosen = {name: readings.READINGS[name] for name in (reading_numbers.SHIPPED, "membrane", "backstop-loose")}
    rows = readings.run(chosen, tmp_path, 600, 150, [1], ["smooth"], strain=0.01, threads=2)
    assert sorted(f"{p.parent.name}/{p.name}" for p in (tmp_path / "samples").glob("*/*")) == [
        "membrane/rough",
        "shipped/smooth",
    ]
    assert sorted(p.name for p in (tmp_path / "slopes").iterdir()) == ["backstop-loose", "shipped"]
    assert [(row["name"], row["platens"], row["folder"]) for row in rows] == [
        ("shipped", "smooth", "samples/shipped/smooth"),
        ("membrane", "rough", "samples/membrane/rough"),
        ("backstop-loose", "smooth", "samples/shipped/smooth"),
    ]
    rows = {row["name"]: row for row in rows}
    peak, water = ({name: row[key] for name, row in rows.items()} for key in ("friction_peak_deg", "water_highest_m"))
    assert peak["shipped"] == peak["backstop-loose"] != peak["membrane"]
    assert water["shipped"] == water["membrane"] is not None
    one = rows["shipped"]
    assert np.shape(one["strain_peak"]) == (1, 3)
    # one seed has no interval; a test of 1 % has no residual strength, so nobody says how near it is
    assert one["friction_peak_deg_95"] is None and one["misses"]["friction_residual_deg"] is None
    assert one["distance"] is None and set(one["samples"][0]["residual_deg"].values()) == {None}
    assert figures.beside(list(rows.values()), tmp_path / "readings.png").stat().st_size > 1e4


def test_samples_under_one_pressure_without_slopes(tmp_path, monkeypatch):
    """What other pressures and slopes would tell is missing, and nothing is made up for it; the sample that was tested
    is told, and drawn where 8 MPa were asked for.
    """
    chosen = {reading_numbers.SHIPPED: SHIPPED}
    monkeypatch.setattr(readings, "slope_of", None)  # no section is made for a slope that nobody runs

    def of(*pressures):
        return readings.run(
            chosen, tmp_path / str(pressures[0]), 600, 150, [1], ["smooth"], 0.01, pressures, slopes=False
        )

    (row,) = of(reading_numbers.FIGURE_9)
    assert [folder.name for folder in (tmp_path / "8000000.0").iterdir()] == ["samples"]
    assert [name for name in PAPER if row[name] is None] == list(PAPER)[:4] + ["water_highest_m"]
    assert np.shape(row["strain_peak"]) == (1, 1) and row["misses"]["strain_peak"] is not None
    assert row["water_highest_m_each"] == [] and row["distance"] is None and row["water_highest_m_95"] is None
    (sample,) = row["samples"]
    assert sample["cohesion_peak_kPa"] is None and sample["strain_peak"] == row["strain_peak"][0][0]
    (_, heads, (_, line)), (_, _, samples) = reading_numbers.tables([row])
    assert line[2:7] == ["–"] * 5 and len(samples) == 1
    (other,) = of(0.5e6)
    assert other["samples"] == [] and other["misses"]["strain_peak"] is None
    assert reading_numbers.tables([other])[1][2] == [] and figures.stress_strain_of([other], tmp_path) == []
    assert figures.beside([row, other], tmp_path / "readings.png").stat().st_size > 1e4
