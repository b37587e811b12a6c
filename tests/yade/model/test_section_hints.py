"""Keys that people try in a section and that it does not have: each gets the sentence that helps."""

import math
import sys
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.laboratory import materials  # noqa: E402
from nonsmooth.model.section import hints as section_hints  # noqa: E402
from nonsmooth.section import FOLDER, SectionError, load  # noqa: E402


@pytest.fixture
def said(tmp_path):
    """The message on a section file with a key below a path of keys."""

    def run(place, key):
        data = yaml.safe_load((FOLDER / "jiufengershan.yaml").read_text(encoding="utf-8"))
        at = data
        for step in place:
            at = at[step]
        at[key] = 1
        path = tmp_path / "slope.yaml"
        path.write_text(yaml.safe_dump(data), encoding="utf-8")
        with pytest.raises(SectionError) as info:
            load(path)
        return str(info.value)

    return run


@pytest.mark.parametrize(
    "place, key, words",
    [
        ((), "earthquake", "is the key `shaking`"),
        ((), "seismic", "RECORD.AT2"),
        (("stages",), "kh", "atan(kh)"),
        ((), "ky", "a result and not an input"),
        ((), "phreatic", "water: {phreatic: {lines:"),
        (("water",), "piezometric", "water: {phreatic: {lines:"),
        ((), "rainfall", "steady flow is computed by `water.seepage`"),
        (("water",), "ru", "h = ru γ H / (γ_w cos² β)"),
        ((), "reservoir", "drained: false for a rapid drawdown"),
        ((), "cohesion", "belongs to a material"),
        (("layers", 0), "phi", "belongs to a material"),
        (("layers", 0), "friction_angle", "belongs to a material"),
        (("materials", "rock"), "phi", "scripts/calibrate.py"),
        (("materials", "rock"), "young", "contacts are rigid"),
        (("materials", "rock"), "poisson", "contacts are rigid"),
        (("walls", 0), "Joint-Set", "interfaces"),  # capital letters, and - for _
    ],
)
def test_a_key_that_people_try(said, place, key, words):
    message = said(place, key)
    assert f"{key}: unknown key; " in message and words in message and "What a section cannot say" in message
    assert "\n" not in message


@pytest.mark.parametrize("key", ["cohesion", "friction_angle"])
def test_strengths_of_a_rock_are_not_sent_away_from_a_material(key):
    assert section_hints.instead_of(key, ("materials", "rock")) is None


def test_a_slip_of_the_pen_is_still_one(said):
    assert "did you mean 'gravity'?" in said((), "gravitation")


@pytest.mark.parametrize(
    "place, key, words",
    [
        (("stages", "settle"), "max_time", "did you mean 'time_max'?"),
        (("stages", "settle"), "rest-speed", "did you mean 'speed_rest'?"),
        (("stages", "settle"), "duration", "after `time_max` [s] at the latest"),
        (("stages", "settle"), "tmax", "after `time_max` [s] at the latest"),
        (("stages", "end"), "duration", "`stages.end.time`, counted from where the slope has settled"),
        (("numerics",), "dt", "the step is `numerics.time_step`"),
        (("numerics",), "step_time", "did you mean 'time_step'?"),
        (("materials", "rock"), "strength_tensile", "did you mean 'tensile_strength'?"),
        ((), "tensile_strength", "belongs to a material"),
    ],
)
def test_the_answer_is_of_the_place(said, place, key, words):
    assert words in said(place, key)


def test_a_material_file_has_the_hints_of_materials(tmp_path):
    path = tmp_path / "rock.yaml"
    path.write_text("friction: 0.3\nrolling_friction: 0.1\ndensity: 2500\nphi: 30\n")
    with pytest.raises(SectionError, match="line 4: phi: unknown key; .*calibrate.py"):
        materials.load(path)


def test_no_key_has_two_answers_and_none_is_a_key():
    seen = {}
    for hint in section_hints.HINTS:
        assert hint.instead[0] != " " and not hint.instead.endswith(".") and not (hint.inside and hint.outside)
        for key in hint.keys.split():
            assert key == key.lower() and "-" not in key
            other = seen.setdefault(key, hint)
            inside, outside = {hint.inside, other.inside}, {hint.outside, other.outside}
            assert other is hint or (inside == outside and "" in inside and len(inside) == 2), key


def test_the_height_for_a_pore_pressure_ratio():
    """The sentence's h gives u = r_u γ z on the plane: u is the gradient along the normal times h, z the thickness H /
    cos β.
    """
    slope = load("jiufengershan")
    ru, rock, thickness, dip = 0.3, 22e3, 50.0, math.radians(slope.dip)
    h = ru * rock * thickness / (slope.water.unit_weight * math.cos(dip) ** 2)
    u = -h * sum(a * b for a, b in zip(slope.water.pressure_gradient_xy, slope.normal))
    assert u == pytest.approx(ru * rock * thickness / math.cos(dip), rel=1e-6)  # a dip of 21° to six digits
