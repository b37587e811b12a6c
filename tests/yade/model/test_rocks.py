"""Rocks that are asked for by cohesion and angle of friction: the law of the table, what is refused, what a run keeps,
and what their samples have.
"""

import copy
import dataclasses
import json
import math

import numpy as np
import pytest
from shell import ROOT
from slope_scenes import SMALL
from yade.nonsmooth import section, similar
from yade.nonsmooth.figures import rock_table as figures
from yade.nonsmooth.laboratory import biaxial_test, campaign, materials, pressing, rock_table
from yade.nonsmooth.measure import statistics, strength
from yade.nonsmooth.model import rocks
from yade.nonsmooth.model.section import checks as section_checks, data as section_data
from yade.nonsmooth.system import keys

MEASURED = ROOT / "doc" / "measured"
LOW, HIGH = rocks.interval()


def of(**rock):
    """The small slope with its rock asked for by c = 60 kPa and φ = 34°, and what ``rock`` says besides; None: left
    out.
    """
    data = section_data.plain(section.load(str(SMALL)))
    asked = {"cohesion": 60e3, "friction_angle": 34, "density": 2500.0, **rock}
    data["materials"]["rock"] = {key: value for key, value in asked.items() if value is not None}
    return data


def rock_of(**rock):
    return section.of(of(**rock)).materials["rock"]


# ---- the law --------------------------------------------------------------------------------------


def test_a_rock_of_the_table_is_given_back():
    for row in rocks.table()["rocks"]:
        share, angle = row["cohesion_over_tensile_strength"]["mean"], row["friction_angle_deg"]["mean"]
        if LOW <= angle <= HIGH:
            found = rocks.contacts(share * 1e5, angle)
            # four digits
            assert found.friction == pytest.approx(row["friction"], rel=1e-3)
            assert found.tensile_strength == pytest.approx(1e5, rel=1e-3)


def test_between_two_rocks_logarithms_are_linear():
    """Half way between two angles: μ_s is the geometric mean, and c/σ_ext is so too."""
    for low, high in zip(rocks.table()["rocks"], rocks.table()["rocks"][1:]):
        share, angle = (
            [row[name]["mean"] for row in (low, high)]
            for name in ("cohesion_over_tensile_strength", "friction_angle_deg")
        )
        found = rocks.contacts(1e5, np.mean(angle))
        # four digits
        assert found.friction == pytest.approx(math.sqrt(low["friction"] * high["friction"]), rel=1e-3)
        assert 1e5 / found.tensile_strength == pytest.approx(math.sqrt(share[0] * share[1]), rel=1e-3)
        # and back; four digits of μ_s are some hundredths of a degree
        assert rocks.friction_angle(found.friction) == pytest.approx(np.mean(angle), abs=0.02)


def test_beyond_the_table_an_angle_is_that_of_its_last_rock():
    rows = rocks.table()["rocks"]
    for friction, row in ((0.0, rows[0]), (1e-3, rows[0]), (10.0, rows[-1])):
        assert rocks.friction_angle(friction) == row["friction_angle_deg"]["mean"]


def test_cohesion_scales_with_the_strength_of_bonds():
    one = rocks.contacts(60e3, 34.0)
    for factor in (1e-3, 7.0, 1e4):
        other = rocks.contacts(60e3 * factor, 34.0)
        assert other.friction == one.friction and other.tensile_strength == pytest.approx(
            factor * one.tensile_strength, rel=1e-3
        )


def test_more_friction_is_a_larger_angle_and_more_cohesion_of_the_same_bonds():
    """The table is monotonic, so an angle has one friction."""
    rows = rocks.table()["rocks"]
    for name in ("friction_angle_deg", "cohesion_over_tensile_strength"):
        means = [row[name]["mean"] for row in rows]
        assert means == sorted(means), name
    assert rows[0]["friction_angle_deg"]["mean"] <= LOW < HIGH <= rows[-1]["friction_angle_deg"]["mean"]


def test_the_tables_numbers_follow_from_what_its_samples_bear():
    """The envelope of each sample's circles, and Student's interval of their scatter: 2.7764 with four degrees of
    freedom.
    """
    table = rocks.table()
    c, phi = [], []
    for row in table["rocks"]:
        fits = []
        for seed in row["seeds"]:
            onsets = [p for p in row["onsets"] if p["seed"] == seed]
            assert len(onsets) == len(rock_table.PRESSURES)
            fits.append(
                strength.envelope(
                    *([p[f"{of}_over_tensile_strength"] for p in onsets] for of in ("confining", "axial"))
                )
            )
        for name, values in (
            ("cohesion_over_tensile_strength", [f.cohesion for f in fits]),
            ("friction_angle_deg", [f.friction_deg for f in fits]),
        ):
            assert row[name]["values"] == pytest.approx(values, rel=1e-6)
            assert row[name]["mean"] == pytest.approx(np.mean(values), rel=1e-6)
        c.append(np.var(np.log([f.cohesion for f in fits]), ddof=1))
        phi.append(np.var([f.friction_deg for f in fits], ddof=1))
    n = len(table["samples"]["seeds"])
    assert n == 5
    sample = table["one_sample_95"]
    assert sample["cohesion_rel"] == pytest.approx(2.7764 * math.sqrt(np.mean(c) * (1 + 1 / n)), rel=1e-4)
    assert sample["friction_angle_deg"] == pytest.approx(2.7764 * math.sqrt(np.mean(phi) * (1 + 1 / n)), rel=1e-4)
    assert table["mean_95"]["friction_angle_deg"] == pytest.approx(2.7764 * math.sqrt(np.mean(phi) / n), rel=1e-4)


def test_what_the_law_misses_is_less_than_samples_scatter():
    """A rock that is left out of the table: the gap is twice as wide then, and the error of a line about four times as
    large.
    """
    table = rocks.table()
    assert table["left_out"] == pytest.approx(rock_table.left_out(table["rocks"]))
    for missed in table["left_out"]:
        for name in ("friction_angle_deg", "cohesion_rel"):
            assert abs(missed[name]) / 4 < table["one_sample_95"][name]


# ---- sections and material files ------------------------------------------------------------------


def test_a_section_asks_by_cohesion_and_angle():
    found, made = rocks.contacts(60e3, 34.0), rock_of()
    assert (made.friction, made.tensile_strength) == (found.friction, found.tensile_strength)
    assert made.envelope == section.Envelope(60e3, 34.0) and made.bonded and made.density == 2500.0
    wwr = materials.load("wwr")
    for key in rock_table.FIXED:
        assert getattr(made, key) == getattr(wwr, key), key
    # as in the paper's rock: a quarter of the strength, all of the friction
    assert made.residual_tensile_strength == pytest.approx(found.tensile_strength / 4, rel=1e-3)
    assert made.residual_friction == made.friction


def test_what_the_table_leaves_open_may_be_given():
    made = rock_of(residual_friction=0.2, residual_tensile_strength=5e3, density=2100.0, rolling_friction=0.1)
    assert (made.residual_friction, made.residual_tensile_strength, made.density) == (0.2, 5e3, 2100.0)
    assert (made.friction, made.tensile_strength) == (rock_of().friction, rock_of().tensile_strength)


def test_residual_values_are_given_within_what_was_measured():
    """Half of the friction, and no residual strength, are the table's variants; the ends are within."""
    found = rocks.contacts(60e3, 34.0)
    for residual, strength_left in ((found.friction, found.tensile_strength / 4), (found.friction / 2, 0.0)):
        made = rock_of(residual_friction=residual, residual_tensile_strength=strength_left)
        assert (made.residual_friction, made.residual_tensile_strength) == (residual, strength_left)


def test_a_run_keeps_the_contact_parameters():
    made = section.of(of())
    kept = section_data.plain(made)["materials"]["rock"]
    assert "cohesion" not in kept and "friction_angle" not in kept
    assert (kept["friction"], kept["tensile_strength"]) == (
        made.materials["rock"].friction,
        made.materials["rock"].tensile_strength,
    )
    assert kept["envelope"] == {"cohesion": 60e3, "friction_deg": 34.0}
    again = section.of(section_data.plain(made))
    assert again.materials["rock"] == made.materials["rock"] and again.key() == made.key()


def test_a_material_file_asks_too(tmp_path):
    path = tmp_path / "granite.yaml"
    path.write_text("cohesion: 2e6\nfriction_angle: 40\ndensity: 2600\n")
    made, found = materials.load(path), rocks.contacts(2e6, 40.0)
    assert (made.friction, made.tensile_strength, made.density) == (found.friction, found.tensile_strength, 2600.0)
    path.write_text("cohesion: 2e6\ndensity: 2600\nfriction_angle: 80\n")
    with pytest.raises(section.SectionError, match=f"{path}: line 3: friction_angle: 80 degrees is outside"):
        materials.load(path)


BESIDE = "is given beside cohesion: 60000 and friction_angle: 34"


@pytest.mark.parametrize(
    "rock, said",
    [
        ({"friction": 0.3}, f"rock.friction: 0.3 {BESIDE}"),
        ({"tensile_strength": 1e5}, f"rock.tensile_strength: 100000.0 {BESIDE}"),
        ({"envelope": {"cohesion": 1e4, "friction_deg": 30}}, f"rock.envelope: {BESIDE}"),
        ({"slip_weakening": {"law": "step", "critical_slip": 1.0}}, "only walls weaken with slip"),
        ({"bonded": False}, f"rock.bonded: false {BESIDE}"),
        ({"rolling_friction": 0.2}, f"rock.rolling_friction: 0.2 {BESIDE}, and the table of calibrated rocks was measured with 0.1"),
        ({"residual_rolling_friction": 0.0}, "measured with 0.1; leave residual_rolling_friction out"),
        ({"bond_ellipse": [0.02, 0.03]}, "measured with [0.02, 0.02]"),
        ({"bond_creation_distance": 0.05}, "measured with 0.025"),
        ({"bonds_close": True}, f"rock.bonds_close: True {BESIDE}, and the table of calibrated rocks was measured with False"),
        ({"restitution": 0.5}, "measured with 0.0"),
        ({"residual_friction": 0.9}, f"rock.residual_friction: 0.9 {BESIDE}, of which the table"),
        ({"residual_friction": 0.05}, "measured with 0.11"),
        ({"residual_tensile_strength": 80e3}, f"measured with 0 to {rocks.contacts(60e3, 34.0).tensile_strength / 4:g}"),
        ({"cohesion": None}, "the key 'cohesion' is missing; add it (a rock of the table is asked for by"),
        ({"friction_angle": None}, "the key 'friction_angle' is missing"),
        ({"cohesion": -1}, "cohesion: -1 is not allowed; needed: peak cohesion"),
        ({"cohesion": 0, "bonded": True}, "rock.bonded: True is given beside cohesion: 0"),
        ({"cohesion": None, "friction_angle": None, "rolling_friction": 0.1}, "the key 'friction' is missing; add it (coefficients of sliding"),
        ({"friction_angle": HIGH + 0.5}, f"which has {LOW:g} to {HIGH:g} degrees; give an angle within, or let scripts/calibrate.py --cohesion 60000 --friction {HIGH + 0.5:g} search"),
        ({"friction_angle": LOW - 0.5}, f"friction_angle: {LOW - 0.5:g} degrees is outside the table of calibrated rocks"),
        ({"friction_angle": 75}, f"which has {LOW:g} to {HIGH:g} degrees; give an angle within"),
    ],
)  # fmt: skip
def test_what_the_table_cannot_give_is_one_message(rock, said):
    with pytest.raises(section.SectionError) as refused:
        section.of(of(**rock), "mine")
    message = str(refused.value)
    assert message.startswith("mine: materials.rock") and said in message and "\n" not in message
    # beyond 60° no search gets there
    assert rock.get("friction_angle") != 75 or "calibrate.py" not in message


def test_what_was_rounded_to_four_digits_is_within():
    """By a thousandth beyond either end, and no more."""
    friction = rock_of().friction
    for share in (0.5, 1.0):
        for off, taken in ((0.9, True), (1.5, False)):
            value = share * friction * (1 + (-1 if share < 1 else 1) * off * 1e-3)
            if taken:
                assert rock_of(residual_friction=value).residual_friction == value
            else:
                with pytest.raises(section.SectionError, match="residual_friction: .* the table of calibrated rocks"):
                    rock_of(residual_friction=value)


def test_the_ends_of_the_interval_are_within():
    for angle in (LOW, HIGH):
        assert rock_of(friction_angle=angle).friction > 0
    for angle in (LOW - 0.2, HIGH + 0.2):
        with pytest.raises(ValueError, match="the table holds"):
            rocks.contacts(60e3, angle)
    with pytest.raises(ValueError, match="the table holds c of 0 or more"):
        rocks.contacts(-1.0, 34.0)


def test_a_rock_without_cohesion_has_no_bonds():
    made = rock_of(cohesion=0)
    assert (made.bonded, made.tensile_strength, made.residual_tensile_strength) == (False, 0.0, 0.0)
    assert made.friction == rocks.contacts(60e3, 34.0).friction and made.envelope == section.Envelope(0.0, 34.0)
    assert rocks.asked(made).friction == made.friction and rock_of(cohesion=0, bonded=False) == made
    # one with bonds has cohesion
    assert rocks.asked(dataclasses.replace(made, bonded=True)) is None
    assert rocks.asked(dataclasses.replace(rock_of(), bonded=False)) is None


# ---- envelopes that are divided --------------------------------------------------------------------


@pytest.mark.parametrize("factor", [0.8, 1.3])
def test_a_divided_envelope_is_that_of_the_table(factor):
    """c and tan φ, both: the rock that a section would have asked for."""
    angle = math.degrees(math.atan(math.tan(math.radians(34.0)) / factor))
    asked = rock_of(cohesion=60e3 / factor, friction_angle=angle)
    made = rocks.reduced(rock_of(), factor)
    assert made.envelope.friction_deg == pytest.approx(angle) and made.envelope.cohesion == 60e3 / factor
    assert made.friction == asked.friction and made.tensile_strength == pytest.approx(asked.tensile_strength)
    # what is left after slip and breaks keeps its share
    half = dataclasses.replace(rock_of(), residual_friction=rock_of().friction / 2, residual_tensile_strength=0.0)
    less = rocks.reduced(half, factor)
    assert less.residual_friction == pytest.approx(less.friction / 2) and less.residual_tensile_strength == 0
    assert made.residual_tensile_strength == pytest.approx(made.tensile_strength / 4, rel=1e-3)
    assert (made.rolling_friction, made.density) == (asked.rolling_friction, asked.density)
    loose = rocks.reduced(rock_of(cohesion=0), factor)
    assert (loose.friction, loose.tensile_strength, loose.bonded) == (asked.friction, 0.0, False)


def test_a_factor_of_one_leaves_the_rock_as_it_is():
    scaled = dataclasses.replace(rock_of(), tensile_strength=rock_of().tensile_strength * (1 + 1e-5))
    assert rocks.asked(scaled) is not None and rocks.reduced(scaled, 1.0) == scaled


def test_an_envelope_is_divided_as_far_as_the_table_goes():
    rock = rock_of()
    least, most = rocks.reach(rock)
    low, high = (math.tan(math.radians(angle)) for angle in (LOW, HIGH))
    assert (least, most) == pytest.approx((math.tan(math.radians(34.0)) / high, math.tan(math.radians(34.0)) / low))
    assert rocks.reduced(rock, most).envelope.friction_deg == pytest.approx(LOW)
    assert rocks.reduced(rock, least).envelope.friction_deg == pytest.approx(HIGH)
    for beyond in (0.99 * least, 1.01 * most):
        with pytest.raises(ValueError, match="the table holds"):
            rocks.reduced(rock, beyond)


# ---- what is said of it ----------------------------------------------------------------------------


def test_a_scene_says_what_its_rock_is_made_of():
    made = section.of(of(), "mine")
    found = rocks.contacts(60e3, 34.0)
    notes = [note for note in section_checks.notes(made) if "σ_ext" in note]
    assert notes == [
        f"mine: rock has c = 60 kPa ± {100 * found.cohesion_95_rel:.0f} % and φ = 34 ± {found.friction_angle_95_deg:.1f}° (95 % of samples of 1000 disks), "
        f"by contacts with σ_ext = {1e-3 * found.tensile_strength:g} kPa and μ_s = {found.friction:g}"
    ]
    # a kept run and a slope of another size say so too
    assert any("σ_ext" in note for note in section_checks.notes(section.of(section_data.plain(made), "kept")))
    assert any("c = 180 kPa" in note for note in section_checks.notes(similar.scaled(made, 3.0)))
    assert not any("σ_ext" in note for note in section_checks.notes(section.load(str(SMALL))))
    # the envelope of another rock, which was measured, is none of the table's
    assert rocks.asked(dataclasses.replace(made.materials["rock"], tensile_strength=1e5)) is None


def test_a_wall_of_the_rock_is_noted():
    """A wall has the friction of its contacts, exactly (eq. 4), which is much less than the tangent of the rock's
    angle.
    """
    data = of()
    data["walls"][0]["material"] = "rock"
    name, friction = data["walls"][0]["name"], rocks.contacts(60e3, 34.0).friction
    (note,) = [note for note in section_checks.notes(section.of(data, "mine")) if "material of its own" in note]
    assert note.startswith(f"mine: {name} has the friction of the contacts of rock, {friction:g}")
    assert note.endswith("with friction: 0.675")  # tan 34°


def test_other_samples_than_the_tables_are_noted():
    data = of()
    data["disks"] |= {
        "diameter": [1.0, 4.0],
        "distribution": "uniform_by_volume",
        "packing_fraction": 0.845,
        "pressed": True,
    }
    assert not any("was measured on" in note for note in section_checks.notes(_large(data)))
    for key, value, said in (
        ("diameter", [1.0, 3.0], "diameters in the ratio 1 to 4 (uniform_by_volume)"),
        ("distribution", "uniform_by_number", "diameters in the ratio 1 to 4"),
        ("packing_fraction", 0.8, "a packing fraction of 0.848"),
        ("pressed", False, "`pressed: true`"),
    ):
        other = copy.deepcopy(data)
        other["disks"][key] = value
        (note,) = [note for note in section_checks.notes(_large(other)) if "was measured on" in note]
        assert said in note and "biaxial.py" in note
    # nor are disks of a layer of another material asked
    other = copy.deepcopy(data)
    other["materials"]["fill"] = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False, "density": 2000.0}
    other["layers"][1] |= {"material": "fill", "disks": {"diameter": [0.1, 0.3]}}
    assert not any("was measured on" in note for note in section_checks.notes(_large(other)))
    other["layers"][1]["material"] = "rock"
    assert any("was measured on" in note for note in section_checks.notes(_large(other)))


def _large(data):
    """The section ten times as large, for disks of metres."""
    small = copy.deepcopy(data)
    small["disks"]["diameter"] = [d / 10 for d in small["disks"]["diameter"]]
    return section.of(small, "mine")


def test_another_table_is_another_code(monkeypatch):
    """Results that were kept are not taken for those of a table that was measured anew."""
    before = keys.made_by(rocks.__name__)
    assert "sections/rocks.json" in before
    monkeypatch.setattr(keys, "digest", lambda path: "another" if path.name == "rocks.json" else "same")
    assert {f for f, h in keys.made_by(rocks.__name__).items() if h == "another"} == {"sections/rocks.json"}


# ---- the measuring of the table -------------------------------------------------------------------


def circles(entry, seeds, law):
    """What campaign.measure says of an Entry's tests, where samples fail on the line of c/σ_ext and φ [degrees] that
    ``law(seed)`` gives.
    """
    unit, found = entry.material.tensile_strength, []
    for test in entry.tests(seeds):
        share, phi = law(test.shape.seed)
        made = strength.MohrEnvelope(share * unit, phi, ())
        found.append(
            {
                "seed": test.shape.seed,
                "disks": entry.count,
                "confining_Pa": test.confining,
                "sigma3_onset_Pa": test.confining,
                "sigma1_onset_Pa": float(made.strength(test.confining)),
                "strain_onset": 0.001,
                "packing_fraction": 0.85,
                "steps": 3000,
                "wall_steps_s": 9.0,
                "wall_s": 10.0,
            }
        )
    return found


def made_up(seeds=(1, 2, 3)):
    """A table of three rocks on the law's own lines, φ = 40° + 10° ln(μ_s/0.3) and c/σ_ext = μ_s, whose samples differ
    by ±5 % and ±1°.
    """

    def angle(mu):
        return 40 + 10 * math.log(mu / 0.3)

    found = [
        rock_table.row(
            e,
            circles(
                e, seeds, lambda seed, mu=e.material.friction: (mu * math.exp(0.05 * (seed - 2)), angle(mu) + seed - 2)
            ),
        )
        for e in rock_table.entries((0.2, 0.3, 0.5), 700)
    ]
    return rock_table.table(found, [], "made up")


def test_a_made_up_table_by_hand():
    table = made_up()
    middle = table["rocks"][1]
    assert middle["friction_angle_deg"]["mean"] == pytest.approx(40, rel=1e-9)  # rounding
    assert middle["cohesion_over_tensile_strength"]["values"] == pytest.approx(
        [0.3 * math.exp(0.05 * k) for k in (-1, 0, 1)]
    )
    assert middle["cohesion_without_lowest"]["values"] == pytest.approx(
        middle["cohesion_over_tensile_strength"]["values"]
    )
    # variances of −1, 0, 1 are 1; Student's 4.3027 with two degrees of freedom
    assert table["scatter"] == pytest.approx(
        {"cohesion_rel": 0.05, "friction_angle_deg": 1.0, "freedom": 2, "disks": 700}
    )
    assert table["one_sample_95"]["friction_angle_deg"] == pytest.approx(4.3027 * math.sqrt(4 / 3), rel=1e-4)
    assert table["mean_95"]["cohesion_rel"] == pytest.approx(4.3027 * 0.05 / math.sqrt(3), rel=1e-4)
    # the rocks are on the lines
    (missed,) = table["left_out"]
    assert missed["friction_angle_deg"] == pytest.approx(0, abs=1e-9) and missed["friction"] == 0.3
    assert table["samples"]["confining_over_tensile_strength"] == list(rock_table.PRESSURES)


def test_the_shipped_table_is_what_its_rocks_make():
    """The file is as the command writes it: nothing in it was changed by hand."""
    table = rocks.table()
    made = rock_table.table(table["rocks"], table["variants"], table["command"])
    assert made.keys() == table.keys()
    for key in ("fixed", "usual", "open", "samples", "scatter", "mean_95", "one_sample_95"):
        assert made[key].keys() == table[key].keys()
        for name, value in table[key].items():
            assert made[key][name] == (pytest.approx(value) if isinstance(value, float) else value), (key, name)
    assert made["tables"] == table["tables"]


def test_a_check_counts_samples_within_the_interval():
    """Of four samples of each rock, one is off by twice the interval in φ, another in c."""
    said, found = rocks.table()["one_sample_95"], []
    for entry, (cohesion, angle) in zip(rock_table.checks(700), rock_table.CHECKED):
        share = cohesion / entry.material.tensile_strength
        off = {2: (share, angle + 2 * said["friction_angle_deg"]), 3: (share * (1 + 2 * said["cohesion_rel"]), angle)}
        measured = circles(entry, (1, 2, 3, 4), lambda seed, s=share, a=angle, off=off: off.get(seed, (s, a)))
        found.append(rock_table.row(entry, measured))
    told = rock_table.check(found, "made up")
    assert [row["within"] for row in told["rows"]] == [{"cohesion": 3, "friction_angle": 3}] * 3
    assert (told["within"], told["of"]) == (18, 24)
    # c is that which was asked for, in Pa, whatever the bonds' strength
    assert [row["cohesion_Pa"]["values"][0] for row in told["rows"]] == pytest.approx(
        [c for c, _ in rock_table.CHECKED]
    )


def test_the_table_is_drawn_with_its_samples_and_its_law():
    table = made_up()
    left, right = figures.table(table).axes
    for ax, name, label in (
        (left, "friction_angle_deg", "φ [°]"),
        (right, "cohesion_over_tensile_strength", "c / σ_ext"),
    ):
        assert label in ax.get_ylabel() and "μ_s" in ax.get_xlabel()
        law = next(line for line in ax.lines if line.get_label() == "law")
        mu, value = law.get_data()
        # through the means: φ = 40° + 10° ln(μ_s/0.3); c/σ_ext = μ_s but for the mean of exp(±0.05)
        expected = 40 + 10 * np.log(mu / 0.3) if name == "friction_angle_deg" else mu * (1 + 2 * math.cosh(0.05)) / 3
        assert value == pytest.approx(expected, rel=1e-9)
        dots = [line for line in ax.lines if line.get_marker() == "o"]
        assert [list(line.get_ydata()) for line in dots] == [row[name]["values"] for row in table["rocks"]]


# ---- what samples have ----------------------------------------------------------------------------


def measured(name):
    return json.loads((MEASURED / f"{name}.json").read_text())


def angle_of(friction):
    """φ [degrees] of the table for μ_s."""
    rows = rocks.table()["rocks"]
    return np.interp(
        math.log(friction),
        [math.log(row["friction"]) for row in rows],
        [row["friction_angle_deg"]["mean"] for row in rows],
    )


def test_the_table_gives_the_papers_rock_back():
    """Asked for what five samples of 5,000 disks of Table 1 have, c and φ: σ_ext = 100 kPa and μ_s = 0.3, within the
    interval that the table states.
    """
    found = measured("table1")["rock"]
    asked = 1e3 * found["cohesion_peak_kPa"], found["friction_peak_deg"]
    made = rocks.contacts(*asked)
    assert made.tensile_strength == pytest.approx(100e3, rel=made.cohesion_95_rel)
    assert angle_of(0.3) == pytest.approx(asked[1], abs=made.friction_angle_95_deg)
    # under the table's own pressures but the lowest one, as Table 1 has them, no curvature is between: both means are
    # known to their 95 %
    fits = []
    for seed in found["seeds"]:
        tests = [t for t in found["tests"] if t["seed"] == seed and t["confining_Pa"] in (0.25e6, 1e6, 4e6)]
        fits.append(strength.envelope([t["sigma3_peak_Pa"] for t in tests], [t["sigma1_peak_Pa"] for t in tests]))
    (row,) = [row for row in rocks.table()["rocks"] if row["friction"] == 0.3]
    ours, theirs = row["cohesion_without_lowest"], statistics.over_seeds([f.cohesion / 100e3 for f in fits])
    assert ours["mean"] == pytest.approx(theirs["mean"], abs=math.hypot(ours["half_width"], theirs["half_width"]))


@pytest.mark.parametrize("k", range(6))
def test_rocks_that_were_calibrated_are_those_of_the_table(k):
    """Trials of a search, 1,500 and 5,000 disks, two samples that the table does not know: each has the strengths that
    the table's law gives its contacts, within what one sample may differ by.
    """
    trial = measured("calibration")["trials"][k]
    cohesion, angle = trial["found"]
    made = rocks.contacts(cohesion, angle)
    assert made.tensile_strength == pytest.approx(trial["parameters"]["tensile_strength"], rel=made.cohesion_95_rel)
    assert angle_of(trial["parameters"]["friction"]) == pytest.approx(angle, abs=made.friction_angle_95_deg)


def test_a_sample_of_a_rock_that_was_asked_for_has_its_strengths(tmp_path):
    """Biaxial tests of a material file with c and φ under the lowest and the highest pressure of the table, of a sample
    of as many disks that the table does not know, sheared past its first maximum, which is at 0.12 % of strain: both
    within the stated interval."""
    path = tmp_path / "asked.yaml"
    path.write_text("{cohesion: 60e3, friction_angle: 34, density: 2500}")
    rock, known = materials.load(path), rocks.contacts(60e3, 34.0)
    shape = pressing.Shape(rocks.table()["samples"]["disks"], 11)
    tests = [
        biaxial_test.BiaxialTest(rock, p * rock.tensile_strength, shape, strength.SHORTEST)
        for p in (rock_table.PRESSURES[0], rock_table.PRESSURES[-1])
    ]
    found = campaign.summarise(rock, campaign.run(tests, tmp_path / "tests", 2))
    assert 1e3 * found["cohesion_peak_kPa"] == pytest.approx(60e3, rel=known.cohesion_95_rel)
    assert found["friction_peak_deg"] == pytest.approx(34.0, abs=known.friction_angle_95_deg)
    # the interval tells a rock from its contacts, whose angle of friction is 20° less
    assert known.cohesion_95_rel < 0.25 and math.degrees(math.atan(rock.friction)) < 34 - 15


def test_the_command_writes_its_table_and_its_check(in_process, monkeypatch, tmp_path):
    def run(out, wanted, seeds, *_):
        def law(seed, mu):
            return (mu * math.exp(0.05 * seed), 40 + 10 * math.log(mu / 0.3) + 0.1 * seed)

        return [
            rock_table.row(e, circles(e, seeds, lambda seed, mu=e.material.friction: law(seed, mu))) for e in wanted
        ]

    monkeypatch.setattr(rock_table, "run", run)
    done = in_process("rocks.py", "--frictions", 0.2, 0.3, 0.5, "--seeds", 4, 5, "--out", tmp_path / "table")
    assert done.status == 0, done.err
    told = json.loads((tmp_path / "table" / "rocks.json").read_text())
    assert [row["friction"] for row in told["rocks"]] == [0.2, 0.3, 0.5] and told["samples"]["seeds"] == [4, 5]
    assert [row["name"] for row in told["variants"]] == [e.name for e in rock_table.variants()]
    assert (tmp_path / "table" / "rocks.png").stat().st_size > 10_000 and "μ_s = 0.5" in done.out
    # rocks that are added stand beside those of the shipped table, or in their place
    done = in_process("rocks.py", "--add", "--frictions", 0.3, 0.6, "--out", tmp_path / "added")
    assert done.status == 0, done.err
    told = json.loads((tmp_path / "added" / "rocks.json").read_text())
    shipped = rocks.table()
    assert [row["friction"] for row in told["rocks"]] == [row["friction"] for row in shipped["rocks"]] + [0.6]
    for row, old in zip(told["rocks"], shipped["rocks"]):
        assert (row == old) == (row["friction"] != 0.3)
    assert told["variants"] == shipped["variants"] and told["scatter"]["freedom"] == 4
    assert told["command"].startswith(shipped["command"] + ", then scripts/rocks.py --add --frictions 0.3 0.6")
    assert in_process("rocks.py", "--check", "--out", tmp_path / "check").status == 0
    told = json.loads((tmp_path / "check" / "rocks_check.json").read_text())
    assert [row["seeds"] for row in told["rows"]] == [list(rock_table.CHECK_SEEDS)] * 3 and told["of"] == 24
