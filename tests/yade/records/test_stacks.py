"""Slip surfaces one above another: which is lowest, what each bears, and what columns, times and figures tell of each.
Needs no YADE.
"""

import copy

import numpy as np
import pytest
import yaml
from shapely.geometry import box

import drawn
import known_slope
import synthetic_slope as synthetic

section, stacks, records, figures = (
    synthetic.load(name) for name in ("model.section", "model.stacks", "records", "figures")
)
characteristic_times, video = synthetic.load("measure.characteristic_times"), synthetic.load("figures.video")
STATE = known_slope.STATE

# four layers of 100 m² each, one upon another; an interface between each two, the first of which is no slip surface
TWO = {
    "name": "two joints",
    "walls": [{"name": "base", "role": "ground", "material": "base", "vertices": [[-50, 20], [0, 0], [80, 0]]}],
    "layers": [
        {
            "name": f"L{k}",
            "material": "rock",
            "vertices": [[-50, 20 + 2 * k], [0, 2 * k], [0, 2 * k + 2], [-50, 22 + 2 * k]],
        }
        for k in range(4)
    ],
    "interfaces": [
        {"name": "glued", "between": ["L0", "L1"], "material": "joint"},
        {"name": "lower", "between": ["L1", "L2"], "material": "joint", "role": "slip"},
        {"name": "upper, weak", "between": ["L2", "L3"], "material": "joint", "role": "slip"},
    ],
    "materials": {
        "rock": {"friction": 0.5, "rolling_friction": 0.1, "tensile_strength": 1e6, "density": 2500},
        "base": {"friction": 0.5, "rolling_friction": 0.1, "bonded": False},
        "joint": {
            "friction": 0.6,
            "rolling_friction": 0.1,
            "bonded": False,
            "slip_weakening": {"law": "linear", "critical_slip": 0.5},
        },
    },
    "disks": {"diameter": [0.4, 1.0]},
}


def line(*points):
    return np.array(points, float)


@pytest.mark.parametrize(
    "lines, found",
    [
        ([line((0, 5), (10, 0)), line((0, 9), (10, 3))], [0, 1]),  # two joints
        ([line((0, 9), (10, 3)), line((0, 5), (10, 0)), line((0, 7), (10, 1))], [2, 0, 1]),  # three, in any order
        ([line((0, 5), (10, 0)), line((10, 0), (20, -1))], [0, 0]),  # pieces of one surface
        ([line((0, 5), (10, 0)), line((10, 0), (10, 8))], [0, 0]),  # a vertical scarp is beside all
        ([line((0, 5), (10, 0)), line((9.5, 2), (20, 1))], [0, 0]),  # they share a twentieth of the shorter one
        ([line((0, 5), (10, 0)), line((8, 3), (18, 1))], [0, 1]),  # and a fifth
        # nested circles that end at one toe
        ([line((0, 10), (5, 3), (10, 0)), line((3, 9), (6, 5), (10, 0))], [0, 1]),
        # a long one over two that lie side by side, drawn from right to left
        ([line((0, 5), (10, 2)), line((10, 2), (20, 0)), line((20, 3), (0, 9))], [0, 0, 1]),
    ],
)
def test_a_surface_lies_above_those_below_it(lines, found):
    assert stacks.levels(lines) == found
    assert stacks.levels([one * (-1, 1) for one in lines]) == found  # in a mirror
    assert stacks.levels([one[::-1] for one in lines]) == found


def test_the_part_of_a_polygon_beside_a_line():
    """A box of 4 m that a line parts in the middle, one that lies below it and one above; the line ends between the
    sides of the first.
    """
    boxes = [box(0, low, 10, low + 4) for low in (0, -5, 5)]
    whole, half = line((0, 2), (10, 2)), line((5, 2), (0, 2))
    assert stacks.part_beside(boxes, [whole]) == pytest.approx([0.5, 0, 1])
    assert stacks.part_beside(boxes, [whole], above=False) == pytest.approx([0.5, 1, 0])
    assert stacks.part_beside(boxes[:1], [half]) == pytest.approx([0.25])
    assert stacks.part_beside(boxes[:1], [half], above=False) == pytest.approx([0.25])


def test_each_surface_bears_the_layers_above_it():
    made = section.of(TWO)
    assert made.slip_levels == {"lower": 0, "upper, weak": 1} and made.stacked == ("lower", "upper, weak")
    assert [one.name for one in made.lowest_surfaces] == ["lower"]
    assert made.borne.tolist() == [False, False, True, True]
    assert made.borne_by("lower").tolist() == [0, 0, 1, 1] and made.borne_by("upper, weak").tolist() == [0, 0, 0, 1]
    # what is no mass is borne by none, and a layer half of which lies beyond a surface is borne by half
    other = copy.deepcopy(TWO)
    other["layers"][3] |= {"vertices": [[-50, 26], [0, 6], [50, 6], [50, 8], [0, 8], [-50, 28]]}
    other["walls"].append(
        {"name": "shelf", "apart": True, "material": "base", "role": "ground", "vertices": [[0, 6], [50, 6]]}
    )
    assert section.of(other).borne_by("upper, weak")[3] == pytest.approx(0.5, abs=1e-6)
    other["layers"][3]["role"] = "bed"
    assert section.of(other).borne_by("upper, weak")[3] == 0 and section.of(other).borne.tolist() == [
        False,
        False,
        True,
        False,
    ]


def test_a_slope_whose_surfaces_lie_side_by_side_has_no_further_columns():
    one = copy.deepcopy(TWO)
    one["interfaces"] = one["interfaces"][:2]
    for made in (section.of(one), *map(section.load, section.shipped())):
        more = ("cells_weakened_rel",) if made.heated_surfaces else ()  # a slip law weakens cells, and no disks
        assert made.stacked == () and characteristic_times.columns(made) == (*characteristic_times.COLUMNS, *more)
        assert {item.name for item in made.lowest_surfaces} == {item.name for item in made.sliding}


def test_a_column_of_a_surface_is_read_as_it_was_written(tmp_path):
    names = ("step", "weakened_disks", *records.own_columns(("upper, weak", 'a "b"\nc')))
    assert names[2:4] == ("dp_normal_total_N_per_m:upper weak", "dp_normal_effective_N_per_m:upper weak")
    row = {name: 7 if records.stem(name) in ("step", "weakened_disks") else 0.1 for name in names}
    with records.SeriesWriter(tmp_path / "series.csv", names) as writer:
        writer.write(row)
    found = records.read_series(tmp_path / "series.csv")
    assert {name: values.tolist() for name, values in found.items()} == {name: [v] for name, v in row.items()}
    assert found["weakened_disks:upper weak"].dtype == np.int64 and found["slip_mean_dp_m:a b c"].dtype == np.float64


def stacked_series(**weakened):
    """The known slope's series, whose dp_… are those of the lower joint; the upper one bears a third of its shear,
    which falls within 1 s, 4 s later. ``weakened``: from when [s].
    """
    series = known_slope.series()
    t = series["time_s"]
    for name, surface in (("lower", "lower"), ("upper", "upper, weak")):
        shear = series["dp_shear_N_per_m"] if name == "lower" else 100e6 * np.clip(1 - (t - 43), 0, 1)
        series[records.column("dp_shear_N_per_m", surface)] = shear
        since = weakened.get(name, np.inf)
        series[records.column("weakened_disks", surface)] = np.where(t >= since - 1e-9, 10**4, 0)
    return series


def test_times_are_of_the_surface_that_weakens_first():
    made = section.of(TWO)

    def rows(**when):
        return characteristic_times.chosen_rows(stacked_series(**when), STATE)

    def of(**when):
        return characteristic_times.of_run(rows(**when), made, STATE)

    def begins(**when):
        return characteristic_times.weakening_begins(rows(**when), made, STATE)

    assert begins(lower=33.0, upper=40.0) == 33.0 and begins(lower=40.0, upper=33.0) == 33.0 and begins() is None
    # the lower one's mean over what counts as a second for a slope of this size has fallen by 90 % at 39 s, the upper
    # one's at 44 s
    second = synthetic.load("model.scales").of(made).mean_seconds
    assert 38.6 - 0.11 <= of(lower=33.0, upper=40.0)["t3"] <= 38.6 + second + 0.11
    assert 43.9 - 0.11 <= of(lower=40.0, upper=33.0)["t3"] <= 43.9 + second + 0.11
    assert of()["t3"] is None
    held = rows(upper=33.0) | {records.column("dp_shear_N_per_m", "upper, weak"): np.full(len(rows()["step"]), 1e6)}
    why = characteristic_times.missing(held, made, STATE)["t3"]
    assert why == "the shear force on upper, weak did not fall by 90 %"
    # a series of a version before has no columns of each
    before = {name: values for name, values in rows(lower=33.0).items() if ":" not in name}
    assert characteristic_times.weakening_begins(before, made, STATE) == 32.0  # 7 disks suffice on so short surfaces


def forces_of(made, wet=True):
    t = np.linspace(0, 10, 101)
    series = {"time_s": t, "water_m": t * wet, "fb_normal_N_per_m": 0 * t}
    for k, surface in enumerate(made.stacked):
        of = {
            "dp_normal_total_N_per_m": 9e6,
            "dp_normal_effective_N_per_m": 9e6 - 1e5 * t,
            "dp_shear_N_per_m": 4e6 - 1e5 * t,
        }
        for name, values in of.items():
            series[records.column(name, surface)] = values / (k + 1) + 0 * t
    for name in ("dp_normal_total_N_per_m", "dp_normal_effective_N_per_m", "dp_shear_N_per_m"):
        series[name] = series[records.column(name, made.stacked[0])]
    return series | {"dp_water_N_per_m": 1e5 * t * wet}


def test_each_surface_has_its_own_line():
    made = section.of(TWO)
    fig = figures.forces_against_time(forces_of(made), {}, walls=made)
    upper, lower = (ax for ax in fig.axes if ax.get_ylabel() == "force [MN/m]")

    def told(ax):
        return {one.get_label(): drawn.points(one)[-1, 1] for one in ax.lines if not one.get_label().startswith("_")}

    assert told(upper) == pytest.approx(
        {
            "$N$  total on lower": 9,
            "$N$  total on upper, weak": 4.5,
            "$N'$  effective on lower": 8,
            "$N'$  effective on upper, weak": 4,
        }
    )
    assert told(lower) == pytest.approx({"$T$  shear on lower": 3, "$T$  shear on upper, weak": 1.5})
    colours = {name: colour for name, colour in drawn.legend(fig).items() if "$h_w$" not in name}
    assert set(colours) == {*told(upper), *told(lower)} and len(set(colours.values())) == 2
    assert {colour for name, colour in colours.items() if name.endswith("weak")} == {
        colours["$T$  shear on upper, weak"]
    }
    assert "Forces on lower, upper, weak (slip surfaces, each for itself)" in drawn.texts(fig)
    # dry: no effective force beside the total one
    dry = figures.forces_against_time(forces_of(made, wet=False), {}, walls=made)
    assert not any("effective" in name for name in drawn.legend(dry))


def test_a_section_in_yaml_gives_the_same(tmp_path):
    (tmp_path / "two.yaml").write_text(yaml.safe_dump(TWO))
    assert section.load(str(tmp_path / "two.yaml")).stacked == section.of(TWO).stacked
