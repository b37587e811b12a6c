"""Figures of the laboratory, read from their artists: biaxial tests, slides on walls, the wedge that creeps. Needs no
YADE.
"""

import itertools
import math

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

style, biaxial, wall_shear, creep_module, moving, cycle_figure = (
    synthetic.load(f"figures.{name}") for name in ("style", "biaxial", "wall_shear", "creep", "moving", "cycle")
)
cycles, records = synthetic.load("measure.cycles"), synthetic.load("records")
BLUE, RED = "#1f5fa8", "#d62728"  # compression, tension
PEAK, PLATEAU = (style.LINES[name].lower() for name in ("blue", "orange"))


# ---- stress against strain ------------------------------------------------------------------------


def strained(confining, peak, residual):
    """A test in 1200 steps of 5e-5 of strain: a rise to ``peak`` [Pa] over 1 %, a fall to ``residual`` until 3 %, and a
    plateau; volume grows by half of the strain.
    """
    strain = 5e-5 * np.arange(1, 1201)
    axial = np.interp(strain, (0, 0.01, 0.03), (confining, peak, residual))
    # platens that differ, about the mean
    series = {
        "strain": strain,
        "sigma1_top_Pa": 1.1 * axial,
        "sigma1_bottom_Pa": 0.9 * axial,
        "volumetric_strain": 0.5 * strain - 0.002,
    }
    return (
        confining,
        series,
        {
            "strain_peak": 0.01,
            "sigma1_peak_Pa": peak,
            "residual_between_strains": [0.04, 0.08],
            "sigma1_residual_Pa": residual,
        },
    )


def test_stress_over_confining_pressure_and_volume_against_strain():
    tests = [strained(2e6, 10e6, 6e6), strained(8e6, 24e6, 20e6)]
    fig = biaxial.stress_strain(tests)
    top, bottom = fig.axes
    assert top.get_ylabel() == "σ₁ / σ₃  [-]" and bottom.get_xlabel() == "axial strain ε₁ [%]"
    assert bottom.get_ylabel() == "volumetric strain [%]\n(dilation positive)"
    assert top.get_legend().get_title().get_text() == "σ₃ [MPa]" and list(drawn.legend(top)) == ["2", "8"]
    for name, (confining, series, told) in zip(("2", "8"), tests):
        fill = drawn.legend(top)[name]
        mine = [one for one in top.lines if drawn.colour(one) == fill]
        (rows,) = (drawn.points(one) for one in mine if one.get_alpha() == 0.35)
        axial = 0.5 * (series["sigma1_top_Pa"] + series["sigma1_bottom_Pa"])
        assert rows == pytest.approx(np.column_stack([100 * series["strain"], axial / confining]))
        mean = drawn.points(drawn.line(top, name))
        # where the curve is straight over 0.2 %, the mean stands on it; a row is the mean of what it covers, half a row
        # before its end
        straight = (mean[:, 0] > 0.2) & (mean[:, 0] < 0.85)
        assert straight.sum() > 100 and mean[straight, 1] == pytest.approx(
            np.interp(mean[straight, 0] + 0.0025, 100 * series["strain"], axial / confining), rel=1e-9
        )
        (dot,) = (drawn.points(one) for one in mine if one.get_marker() == "o")
        assert dot == pytest.approx(np.array([[1.0, told["sigma1_peak_Pa"] / confining]]))
        (plateau,) = (c.get_segments()[0] for c in top.collections if drawn.hexes(c.get_color()) == [fill])
        # cut off at the test's end
        assert plateau == pytest.approx(
            np.array([[4.0, told["sigma1_residual_Pa"] / confining], [6.0, told["sigma1_residual_Pa"] / confining]])
        )
        (volume,) = (drawn.points(one) for one in bottom.lines if drawn.colour(one) == fill)
        assert volume == pytest.approx(np.column_stack([100 * series["strain"], 50 * series["strain"] - 0.2]))
    assert len(set(drawn.legend(top).values())) == 2 and bottom.get_xlim()[0] == 0 and top.get_ylim()[0] == 0


def test_stress_itself_of_the_papers_pressures_in_its_greys():
    tests = [strained(p, 3 * p, 2.5 * p) for p in (2e6, 4e6, 8e6, 16e6)]
    top, bottom = biaxial.stress(tests).axes
    assert top.get_ylabel() == "σ₁ [MPa]" and bottom.get_xlabel() == "axial strain ε₁ [%]"
    # as in its caption: black, dark grey, light grey
    assert drawn.legend(top) == {
        "4 (the paper's)": "#000000",
        "8 (the paper's)": "#6e6e6e",
        "16 (the paper's)": "#b4b4b4",
    }
    for (confining, series, _), name in zip(tests[1:], drawn.legend(top)):
        axial = 0.5 * (series["sigma1_top_Pa"] + series["sigma1_bottom_Pa"])
        assert drawn.points(drawn.line(top, name)) == pytest.approx(
            np.column_stack([100 * series["strain"], 1e-6 * axial])
        )
        (volume,) = (drawn.points(one) for one in bottom.lines if drawn.colour(one) == drawn.legend(top)[name])
        assert volume == pytest.approx(np.column_stack([100 * series["strain"], 100 * series["volumetric_strain"]]))
    # where none of the paper's was tested, all of ours
    top, _ = biaxial.stress([tests[0], strained(1e6, 3e6, 2e6)]).axes
    assert list(drawn.legend(top)) == ["2 (ours)", "1 (ours)"] and len(set(drawn.legend(top).values())) == 2


# ---- a cycle of stress ----------------------------------------------------------------------------


def test_a_cycle_has_its_three_curves_its_phases_and_its_chains():
    """A rise of 2 MPa between 4 and 6 % of strain, and its drop until 6.1 %."""
    strain = 1e-4 * np.arange(1, 1001)
    stress = 20e6 + np.interp(strain, (0.04, 0.06, 0.061), (0, 2e6, 0))
    series = {
        "strain": strain,
        "volumetric_strain": 0.1 * strain,
        "sigma1_top_Pa": stress + 9e6,
        "sigma1_bottom_Pa": stress + 7e6,
        "sigma3_left_Pa": np.full(1000, 8e6),
        "sigma3_right_Pa": np.full(1000, 8e6),
        "energy_kinetic_J": np.where((strain > 0.06) & (strain < 0.061), 50.0, 5.0),
    }
    rows = cycles.Cycle(399, 599, 609)
    before = synthetic.few([0.0, 2.0, 4.0], [0.0, 0.0, 3.0], [(0, 1, 4e5), (1, 2, -1e5)])
    after = synthetic.few([0.0, 2.0, 4.0], [0.0, 0.0, 3.0], [(0, 1, 1e5), (1, 2, -1e5)])
    fig = cycle_figure.cycle(series, rows, before, after, "three disks")
    curves, (left, right) = fig.axes[:3], fig.axes[3:]
    fig.draw_without_rendering()
    places = [ax.get_position() for ax in fig.axes]
    assert not any(a.overlaps(b) for a, b in itertools.combinations(places, 2))
    assert places[0].x1 < places[3].x0 < places[3].x1 < places[4].x0 and places[0].y0 > places[1].y1 > places[2].y1
    labels = ("σ₁ − σ₃ [MPa]", "volumetric strain [%]\n(dilation positive)", "kinetic energy [kJ/m]")
    columns = (1e-6 * stress, 10 * strain, 1e-3 * series["energy_kinetic_J"])
    shown = (strain > 0.0379) & (strain < 0.0631)  # 0.2 % to each side
    for ax, label, values in zip(curves, labels, columns):
        assert ax.get_ylabel() == label
        (line,) = ax.lines
        assert drawn.points(line) == pytest.approx(np.column_stack([100 * strain, values])[shown])
        spans = sorted(
            (patch.get_xy()[:, 0].min(), patch.get_xy()[:, 0].max(), drawn.colour(patch)) for patch in ax.patches
        )
        assert [one[:2] for one in spans] == [pytest.approx((4.0, 6.0)), pytest.approx((6.0, 6.1))]
        assert [one[2] for one in spans] == [cycle_figure.BUILD, cycle_figure.DROP]
    assert curves[0].get_title(loc="left") == "three disks"
    assert [ax.get_title() for ax in (left, right)] == [
        "before the drop, at 6.00 %: 22.0 MPa",
        "after it, at 6.10 %: 20.0 MPa",
    ]
    # bars of both to the scale of the first: a quarter of the force is a quarter of the width
    wide = []
    for ax in (left, right):
        (bars,) = (c for c in ax.collections if drawn.hexes(c.get_facecolor()) == [BLUE])
        (corners,) = (path.vertices[:4] for path in bars.get_paths())
        wide.append(float(np.ptp(corners[:, 1])))
    assert wide[1] == pytest.approx(wide[0] / 4, rel=1e-6)
    assert left.get_xlim() == right.get_xlim() and left.get_ylim() == right.get_ylim()
    with pytest.raises(records.RecordsError, match="no column energy_kinetic_J"):
        cycle_figure.cycle({k: v for k, v in series.items() if k != "energy_kinetic_J"}, rows, before, after, "")


# ---- Mohr's circles -------------------------------------------------------------------------------


def envelope(cohesion, friction, confining):
    sine = math.sin(math.radians(friction))
    return (confining * (1 + sine) + 2 * cohesion * math.sqrt(1 - sine * sine)) / (1 - sine)


@pytest.fixture(scope="module")
def campaign():
    """Tests that fail on lines of 500 kPa and 35° at the peak, 0 and 25° on the plateau, whose lines their circles
    touch.
    """
    tests = [
        {
            "confining_Pa": p,
            "sigma3_peak_Pa": p,
            "sigma1_peak_Pa": envelope(5e5, 35, p),
            "sigma3_residual_Pa": p,
            "sigma1_residual_Pa": envelope(0, 25, p),
        }
        for p in (1e6, 2e6, 4e6, 8e6, 16e6)
    ]
    return {
        "tests": tests,
        "cohesion_peak_kPa": 500.0,
        "friction_peak_deg": 35.0,
        "cohesion_residual_kPa": 0.0,
        "friction_residual_deg": 25.0,
    }


def test_circles_touch_their_envelopes_in_megapascals(campaign):
    fig = biaxial.mohr(campaign)
    whole, close = fig.axes
    assert drawn.legend(whole) == {"peak: c′ = 500 kPa, φ′ = 35.0°": PEAK, "residual: c′ = 0 kPa, φ′ = 25.0°": PLATEAU}
    assert (whole.get_xlabel(), whole.get_ylabel(), whole.get_title()) == (
        "normal stress [MPa]",
        "shear stress [MPa]",
        "5 tests",
    )
    for ax, count, far in ((whole, 5, 16.0), (close, 3, 4.0)):  # on the right the three lowest pressures
        assert ax.get_xlim() == pytest.approx((0, 1.05 * envelope(5e5, 35, 1e6 * far) / 1e6)) and ax.get_aspect() == 1
        for kind, fill, c, angle in (("peak", PEAK, 0.5, 35), ("residual", PLATEAU, 0.0, 25)):
            lines = [drawn.points(one) for one in ax.lines if drawn.colour(one) == fill]
            circles, (line,) = [one for one in lines if len(one) > 2], [one for one in lines if len(one) == 2]
            slope = math.tan(math.radians(angle))
            assert (
                len(circles) == count
                and line[0] == pytest.approx([0, c])
                and line[1, 1] == pytest.approx(c + slope * line[1, 0])
            )
            for circle, test in zip(circles, campaign["tests"]):
                assert [circle[:, 0].min(), circle[:, 0].max()] == pytest.approx(
                    [1e-6 * test[f"sigma3_{kind}_Pa"], 1e-6 * test[f"sigma1_{kind}_Pa"]]
                )
                # half of it, drawn by 181 points
                assert np.ptp(circle[:, 0]) == pytest.approx(2 * circle[:, 1].max(), rel=1e-4)
                # touched, by a chord of 1°
                assert np.max(circle[:, 1] - c - slope * circle[:, 0]) == pytest.approx(
                    0, abs=1e-3 * circle[:, 1].max()
                )
    assert close.get_title() == "the lowest pressures, where cohesion shows"
    top = max(0.5 * (t["sigma1_peak_Pa"] - t["sigma3_peak_Pa"]) for t in campaign["tests"])
    assert whole.get_ylim() == pytest.approx((0, 1.6e-6 * top))


def test_without_a_residual_envelope_there_are_no_circles_of_it(campaign):
    fig = biaxial.mohr(campaign | {"cohesion_residual_kPa": None, "friction_residual_deg": None})
    assert all(drawn.colour(one) == PEAK for ax in fig.axes for one in ax.lines) and len(drawn.legend(fig.axes[0])) == 1


# ---- samples --------------------------------------------------------------------------------------


def test_a_film_of_a_test_has_the_colours_of_rotations_and_its_walls(monkeypatch, tmp_path):
    told, paths = {}, []
    monkeypatch.setattr(moving, "write", lambda frames, path, **how: told.update(frames=frames, **how) or path)
    for k in range(3):
        paths.append(tmp_path / f"{k:04d}.npz")
        disks = dict(x=[1, 3], y=[1, 2 - 0.1 * k], r=[1, 1], angle=[7.0, 7 + 0.1 * k])
        walls = [(1, 0.0), (0, 6.0), (1, 10.0 - 0.1 * k), (0, -1.0)]
        records.write_snapshot(paths[-1], compact=True, time_s=2.0 * k, step=k, walls=walls, **disks)
    assert biaxial.film(paths, "σ₃ = 6 MPa", tmp_path / "b.mp4") == tmp_path / "b.mp4"
    assert [t for t, _ in told["frames"]] == [0, 2, 4] and told["words"](4.0, None) == "ε₁ = 2.00 %,  σ₃ = 6 MPa"
    scale, name = told["bar"]
    assert name.startswith("rotation [rad]")
    for k, (_, s) in enumerate(told["frames"]):
        assert s.axes == [(1, 0.0), (0, 6.0), (1, 10.0 - 0.1 * k), (0, -1.0)] and s.y[1] == pytest.approx(2 - 0.1 * k)
        # what has turned since the begin; single precision
        assert s.colour == pytest.approx(scale.to_rgba([0.0, 0.1 * k])[:, :3], abs=1e-5)
    with pytest.raises(records.RecordsError, match="no frames"):
        biaxial.film([], "", tmp_path / "b.mp4")
    records.write_snapshot(tmp_path / "no.npz", time_s=0.0, step=0, x=[1], y=[1], r=[1])
    with pytest.raises(records.RecordsError, match="no.npz: has no angle, walls; give snapshots of a biaxial test"):
        biaxial.film([tmp_path / "no.npz"], "", tmp_path / "b.mp4")


def test_rotations_are_told_by_colour_since_the_begin_of_shear():
    """Counterclockwise is red, clockwise blue, and the scale says which."""
    x, y = [0.0, 4.0, 8.0, 0.0], [0.0, 0.0, 0.0, 16.0]
    begin, half, end = (
        synthetic.few(x, y, angle=np.array(a))
        for a in ([1.0, 2.0, 3.0, 0.0], [1.1, 1.9, 3.0, 0.0], [1.2, 1.8, 3.0, 0.05])
    )
    fig = biaxial.rotations(begin, [("half", half), ("end", end)])
    first, second, bar = fig.axes
    assert [first.get_title(), second.get_title()] == [
        "half",
        "end",
    ] and bar.get_ylabel() == "rotation [rad], counterclockwise positive"
    assert bar.get_ylim() == pytest.approx((-0.2, 0.2))  # a round number that 98 % of the rotations stay below
    for ax, sample, turned in ((first, half, (0.1, -0.1, 0, 0)), (second, end, (0.2, -0.2, 0, 0.05))):
        centres, _, fills = drawn.disks(ax)
        assert np.array_equal(centres, np.column_stack([sample.x, sample.y]))
        parts = [[int(fill[k : k + 2], 16) for k in (1, 3, 5)] for fill in fills]
        for (red, green, blue), angle in zip(parts, turned):
            assert red > blue + 20 if angle > 0 else (blue > red + 20 if angle < 0 else abs(red - blue) < 5)
    assert drawn.disks(first)[2][2] == drawn.disks(second)[2][2]
    assert first.get_xlim() == second.get_xlim() and first.get_ylim() == second.get_ylim()


def test_forces_of_a_sample():
    """Compression blue, tension red, widths as the forces, 1.2 median radii at the strong ones."""
    forces = [(0, 1, 4e6), (1, 2, -2e6), (0, 2, 1e6), (0, -1, 3e6, 0.0, -1.0)]
    sample = synthetic.few([0.0, 2.0, 1.0], [0.0, 0.0, 2.0], forces)
    fig = biaxial.chains(sample, "ε₁ = 1 %")
    assert drawn.legend(fig) == {"compression": BLUE, "tension": RED} and fig.axes[0].get_title() == "ε₁ = 1 %"
    bars = drawn.bars(fig.axes[0])
    strong = np.quantile([4e6, 2e6, 1e6, 3e6], 0.98)

    def wide(part):
        return np.hypot(*(part[:, 0] - part[:, 3]).T)

    assert wide(bars[BLUE]) == pytest.approx(1.2 * np.array([4e6, 1e6, 3e6]) / strong) and wide(
        bars[RED]
    ) == pytest.approx(1.2 * np.array([2e6]) / strong)
    assert (bars[RED][0, 0] + bars[RED][0, 3]) / 2 == pytest.approx([2, 0]) and (
        bars[RED][0, 1] + bars[RED][0, 2]
    ) / 2 == pytest.approx([1, 2])
    assert (bars[BLUE][2, 1] + bars[BLUE][2, 2]) / 2 == pytest.approx([0, -1])
    centres, radii, _ = drawn.disks(fig.axes[0])
    assert np.array_equal(centres, [[0, 0], [2, 0], [1, 2]]) and set(radii) == {1}


# ---- effects --------------------------------------------------------------------------------------


def test_effects_show_samples_means_and_the_usual_value():
    rows = [
        {
            "effect": name,
            "label": f"{name} [-]",
            "value": v,
            "usual": v == 2,
            "peak_deg": [40 + v, 42 + v],
            "peak_mean_deg": 41 + v,
            "peak_95_deg": 0.5 * v,
            "residual_deg": [20 + v, 22 + v],
            "residual_mean_deg": 21 + v,
            "residual_95_deg": None,
        }
        for name in ("step", "disks")
        for v in (4, 1, 2)
    ]
    fig = biaxial.effects(rows)
    fig.draw_without_rendering()  # formulae that cannot be read show here
    assert (
        [ax.get_xlabel() for ax in fig.axes] == ["step [-]", "disks [-]"]
        and fig.axes[0].get_ylabel() == "angle of friction [°]"
        and fig.axes[0].get_ylim()[0] == 0
    )
    assert drawn.legend(fig.axes[0]) == {"peak": PEAK, "plateau": PLATEAU}
    for ax in fig.axes:
        assert (
            list(drawn.uprights(ax)) == [2]
            and ax.get_xscale() == "log"
            and [t.get_text() for t in ax.get_xticklabels()] == ["1", "2", "4"]
        )
        for container, fill, base, reach in zip(ax.containers, (PEAK, PLATEAU), (41, 21), ([0.5, 1, 2], [0, 0, 0])):
            mean, _, (whiskers,) = container
            # in the order of values
            assert drawn.colour(mean) == fill and drawn.points(mean).tolist() == [[v, base + v] for v in (1, 2, 4)]
            assert [np.ptp(s[:, 1]) / 2 for s in whiskers.get_segments()] == pytest.approx(reach)
            dots = [
                drawn.points(one).tolist() for one in ax.lines if one.get_alpha() == 0.35 and drawn.colour(one) == fill
            ]
            assert dots == [[[v, base - 1 + v], [v, base + 1 + v]] for v in (1, 2, 4)]


# ---- walls and wedge ------------------------------------------------------------------------------


def slid(material, seed, friction):
    """A wall's strengths: peak and residual friction, 10 kPa of cohesion at the peak, of two pressures; and their
    courses.
    """
    pressures, (peak, residual) = [0.5e6, 2e6], friction
    slides = [
        {
            "normal_peak": 1.01 * p,
            "shear_peak": 1e4 + peak * 1.01 * p,
            "normal_residual": 0.99 * p,
            "shear_residual": residual * 0.99 * p,
        }
        for p in pressures
    ]
    slip = np.linspace(0, 0.2, 21)
    # the third row: the block flies
    series = [
        {"slip_m": slip, "normal_Pa": np.where(slip == slip[2], 0.001 * p, p), "shear_Pa": p * (peak - slip)}
        for p in pressures
    ]
    return {
        "material": material,
        "seed": seed,
        "pressures_Pa": pressures,
        "slides": slides,
        "friction_peak": peak,
        "friction_residual": residual,
        "cohesion_peak_kPa": 10.0,
        "cohesion_residual_kPa": -0.2,
    }, series


def test_slides_and_the_strength_of_walls():
    walls = [
        slid("dp", 1, (0.6, 0.3)),
        slid("dp", 2, (0.64, 0.34)),
        slid("fb", 1, (0.5, 0.4)),
        slid("fb", 2, (0.5, 0.4)),
    ]
    fig = wall_shear.slides(walls)
    fig.draw_without_rendering()  # formulae that cannot be read show here
    dp, fb, strength = fig.axes
    assert [ax.get_title() for ax in fig.axes] == ["dp", "fb", "strength, 2 blocks each"]
    assert dp.get_ylabel() == "shear stress over normal stress" and dp.get_xlabel() == "slip of the wall [cm]"
    assert (
        list(drawn.legend(dp)) == ["0.5 MPa", "2 MPa"]
        and dp.get_legend().get_title().get_text() == "normal stress"
        and dp.get_ylim() == fb.get_ylim()
    )
    for ax, (found, series) in ((dp, walls[0]), (fb, walls[2])):  # the first block of each
        for name, rows, p in zip(("0.5 MPa", "2 MPa"), series, found["pressures_Pa"]):
            borne = np.arange(21) != 2
            assert drawn.points(drawn.line(ax, name)) == pytest.approx(
                np.column_stack([100 * rows["slip_m"], rows["shear_Pa"] / p])[borne]
            )
        assert drawn.line(ax, "0.5 MPa").get_alpha() > drawn.line(ax, "2 MPa").get_alpha()
    assert (strength.get_xlabel(), strength.get_ylabel()) == ("normal stress [MPa]", "shear stress [MPa]")
    expected = {
        "dp, peak: μ = 0.62, c = 10 kPa": ("dp", 0.62, 0.01, "-"),
        "dp, residual: μ = 0.32, c = 0 kPa": ("dp", 0.32, -0.0002, "--"),
        "fb, peak: μ = 0.50, c = 10 kPa": ("fb", 0.5, 0.01, "-"),
        "fb, residual: μ = 0.40, c = 0 kPa": ("fb", 0.4, -0.0002, "--"),
    }
    assert list(drawn.legend(strength)) == list(expected)
    fills = {"dp": drawn.colour(dp.lines[0]), "fb": drawn.colour(fb.lines[0])}
    for name, (wall, friction, cohesion, dash) in expected.items():
        one = drawn.line(strength, name)
        x, y = drawn.points(one).T
        assert (
            y == pytest.approx(cohesion + friction * x)
            and x[0] == 0
            and x[1] == pytest.approx(1.05 * 2 * (1.01 if dash == "-" else 0.99))
        )
        assert drawn.colour(one) == fills[wall] == drawn.legend(strength)[name] and one.get_linestyle() == dash
    assert fills["dp"] != fills["fb"]
    marks = [one for one in strength.lines if one.get_marker() in "os"]
    assert (
        drawn.points(marks[0])
        == pytest.approx(np.array([[1.01 * p, 0.01 + f * 1.01 * p] for f in (0.6, 0.64) for p in (0.5, 2)]))
        and marks[0].get_marker() == "o"
    )
    assert (
        drawn.points(marks[1])
        == pytest.approx(np.array([[0.99 * p, f * 0.99 * p] for f in (0.3, 0.34) for p in (0.5, 2)]))
        and marks[1].get_markerfacecolor() == "none"
    )


def test_creep_is_drawn_by_its_size_on_a_logarithm():
    t = np.linspace(0, 60, 7)
    dry = [("hard", "#0072b2", t, np.zeros(7)), ("soft", "#d55e00", t, -0.02 * t)]
    wet = [("hard", "#0072b2", t, 1e-3 * t), ("soft", "#d55e00", t, 0.1 * t)]
    fig = creep_module.creep([("dry", dry), ("water", wet)])
    fig.draw_without_rendering()  # formulae that cannot be read show here
    assert [ax.get_title() for ax in fig.axes] == ["dry", "water"] and fig.axes[
        0
    ].get_ylabel() == "displacement along the joint [mm]"
    assert drawn.legend(fig) == {"hard": "#0072b2", "soft": "#d55e00"}
    for ax, curves in zip(fig.axes, (dry, wet)):
        assert ax.get_yscale() == "log" and ax.get_xlabel() == "time [s]" and ax.get_xlim()[0] == 0
        for name, fill, time, way in curves:
            one = drawn.line(ax, name)
            assert (
                drawn.points(one) == pytest.approx(np.column_stack([time, np.maximum(np.abs(way), 1e-6)]))
                and drawn.colour(one) == fill
            )
        assert [y for y, _ in drawn.levels(ax)] == [1] and drawn.texts(ax) == ["1 mm"]
