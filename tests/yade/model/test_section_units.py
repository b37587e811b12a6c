"""Values in another unit than a section's are refused with what they would be; what is meant all the same is taken.
Needs no YADE.
"""

import math
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.laboratory import materials  # noqa: E402
from nonsmooth.model.section import checks as section_checks, data as section_data  # noqa: E402
from nonsmooth.section import SectionError  # noqa: E402

SHIPPED = section.load("jiufengershan")  # 281 m; ρ g L is 5.5 MPa

# key, value, what the message says, a value just within the bounds
WRONG = [
    ("materials.rock.friction", 30, "the tangent of an angle: 30 degrees are 0.577", 3.0),
    ("materials.rock.residual_friction", 25.0, "25 degrees are 0.466", 0.466),
    ("materials.dp.friction", 3.01, "3.01 degrees are 0.0526", 0.0),
    ("materials.dp.slip_weakening.friction", 12, "12 degrees are 0.213", 0.2),
    ("materials.rock.rolling_friction", 2.1, "in mean diameters", 2.0),
    ("materials.rock.density", 25, "25 kN/m³ are 2548", 300),
    ("materials.rock.density", 2.5, "2.5 g/cm³ are 2500", 10_000),
    ("materials.rock.density", 25_000, "25000 N/m³ are 2548", 9_999),
    ("materials.rock.density", 299, "rock has some 2500", 301),
    ("materials.rock.tensile_strength", 300, "300 kPa are 300000", 0),
    ("materials.rock.tensile_strength", 1100, "beside the weight of this slope, some 5.5 MPa", 1110),
    ("materials.rock.residual_tensile_strength", 20, "20 kPa are 20000", 20e3),
    ("materials.rock.envelope.friction_deg", 0.6, "0.6 rad are 34.4", 34.0),
    ("water.unit_weight", 9.81, "9.81 kN/m³ are 9810", 9810),
    ("water.unit_weight", 1000, "1000 kg/m³ are 9810", 2950),
    ("water.unit_weight", 250, "its density times gravity: some 9810", 9810),
    ("water.unit_weight", 2e5, "a fluid of 2.04e+04 kg/m³", 1.9e5),
    ("water.pressure_gradient", [0, 9810], "still water has [0, -9810]", [0, -9810]),
    ("water.pressure_gradient", [100.0, 1e-3], "pressure that grows upwards", [4000.0, 0.0]),
    ("water.pressure_gradient", [0, -9.81], "9.81 kN/m³ are 9810", [0, -200]),
    ("water.pressure_gradient", [0, -5e5], "51 of the unit weight of water", [0, -4.9e5]),
    ("water.pressure_gradient", [0, -5e5], "the gradient is in N/m³; if it is meant", [0, -4.9e5]),
]


@pytest.mark.parametrize("key, value, said, right", WRONG)
def test_another_unit_is_refused_with_what_it_would_be(key, value, said, right):
    with pytest.raises(SectionError) as refused:
        SHIPPED.with_values({key: value}, "f=1")
    message = str(refused.value)
    assert message.startswith(f"f=1: {key}: ") and said in message and "\n" not in message
    assert SHIPPED.with_values({key: right})


@pytest.mark.parametrize(
    "key, value",
    [("materials.rock.friction", 30), ("materials.rock.tensile_strength", 300), ("water.pressure_gradient", [0, 9810])],
)
def test_what_is_meant_is_taken_and_kept(key, value, tmp_path):
    with pytest.raises(SectionError, match=rf"; if it is meant, add `unusual: \[{key}\]` to the section"):
        SHIPPED.with_values({key: value})
    meant = SHIPPED.with_values({key: value, "unusual": [key]})
    assert meant.unusual == (key,)
    # a run's own file of it, its mirror image, and another size are sections again
    section_data.write(meant, tmp_path / "section.yaml")
    again = section.load(str(tmp_path / "section.yaml"))
    assert again.unusual == (key,) == similar.mirrored(meant).unusual == similar.scaled(meant, 0.01).unusual
    assert SHIPPED.unusual == () and "unusual" not in section_data.plain(SHIPPED)
    with pytest.raises(SectionError, match="density: 25000"):  # one key is not all
        meant.with_values({"materials.rock.density": 25_000})


def test_a_density_of_water_is_told_up_to_the_heaviest_fluids():
    """3000 kg/m³ where gravity is 12 m/s²; beyond it, no fluid of the laboratory has that density."""
    for value, said in ((3000, "3000 kg/m³ are 36000"), (3001, "its density times gravity: some 12000")):
        with pytest.raises(SectionError, match=said):
            SHIPPED.with_values({"gravity": 12.0, "water.unit_weight": value})


@pytest.mark.parametrize("name", section.shipped())
def test_bounds_go_with_the_size_of_a_slope(name):
    """What a slope of metres may have is no kPa: strengths are set beside its weight, and the shipped sections are
    slopes at all sizes and on the moon; but one with a slip law that heats has no similar one.
    """
    shipped = section.load(name)
    for factor in (1e-4, 0.01, 10.0) if not shipped.with_slip_law else ():
        similar.scaled(shipped, factor)
    shipped.with_values({"gravity": 1.62})


def test_weak_rock_of_a_small_slope_is_no_rock_in_kilopascals():
    small = similar.scaled(SHIPPED, 0.01)
    assert small.with_values({"materials.rock.tensile_strength": 300}).materials["rock"].tensile_strength == 300
    bound = 2e-4 * 2000 * 9.81 * math.sqrt(small.area)
    with pytest.raises(SectionError, match="next to nothing"):
        small.with_values({"materials.rock.tensile_strength": 0.99 * bound})
    small.with_values({"materials.rock.tensile_strength": 1.01 * bound})


GRAINS = "rolling_friction: 0.1\ndensity: 2500\n"


@pytest.mark.parametrize(
    "text, said",
    [
        (
            f"friction: 30\n{GRAINS}",
            "line 1: friction: 30 is no coefficient of friction; friction is the tangent of an angle: 30 degrees are 0.577",
        ),
        ("friction: 0.5\nrolling_friction: 0.1\ndensity: 25000\n", "density: 25000 kg/m³ is no density"),
        ("friction: 0.5\nrolling_friction: 0.1\ndensity: 25\n", "25 kN/m³ are 2548"),
        (
            "rock:\n  friction: 0.5\n  rolling_friction: 0.1\n",
            "line 1: rock: holds keys, as in a section, and this file is of one item, a material; give its keys at the top",
        ),
        ("materials:\n  rock: {friction: 0.5}\n", "without `materials:`"),
        ("walls: []\nlayers: []\n", "line 1: walls: holds a list"),
    ],
)
def test_a_material_file_has_the_same_units_and_no_names(tmp_path, text, said):
    path = tmp_path / "stone.yaml"
    path.write_text(text)
    for read in (materials.load, materials.data):
        with pytest.raises(SectionError) as refused:
            read(path)
        assert (
            str(refused.value).startswith(f"{path}: ")
            and said in str(refused.value)
            and "unusual" not in str(refused.value)
        )


def test_a_material_that_is_none_is_told_by_the_option_that_gave_it():
    for read, option in ((materials.load, "--material"), (materials.data, "--rock")):
        with pytest.raises(SectionError, match=f"^{option} granite: neither a file nor one of wwr"):
            read("granite")
    with pytest.raises(SectionError, match="^--start granite: neither"):
        materials.load("granite", "--start")


def test_water_that_runs_up_the_slope_is_told():
    def notes(values):
        return [n for n in section_checks.notes(SHIPPED.with_values(values)) if "water" in n]

    def plane(dip):
        return {"water.plane": {"point": [0, 0], "dip": dip}}

    assert notes({}) == notes(plane(21)) == notes(plane(0)) == notes({"water.pressure_gradient": [-3000, -9000]}) == []
    (note,) = notes(plane(-21))
    assert note.endswith(
        "the water's plane dips 21° to the left, and the slope falls to the right; a dip to the left is negative"
    )
    (note,) = notes({"water.pressure_gradient": [3000, -9000]})
    assert "pressure_gradient [3000, -9000] pushes the slope up" in note
    mirrored = similar.mirrored(SHIPPED)
    assert mirrored.with_values(plane(-21)) and not list(section_checks._water_notes(mirrored.with_values(plane(-21))))
    assert (
        len(list(section_checks._water_notes(mirrored.with_values({"water.pressure_gradient": [-3000, -9000]})))) == 1
    )


def test_a_sweep_refuses_degrees_before_anything_runs():
    from nonsmooth import campaign

    with pytest.raises(SectionError, match="^friction=30: materials.rock.friction: 30 is no coefficient"):
        campaign.sweep(SHIPPED, {"materials.rock.friction": [0.5, 30]})
