"""What a section can say besides walls and one rock: interfaces inside it, layers with disks of their own, an erodible
bed, obstacles of disks.
"""

import dataclasses
import json
import math
import re

import numpy as np
import pytest
import shell
from slope_scenes import SMALL, write_changed
from yade.nonsmooth import experiment, packing, records, section, similar
from yade.nonsmooth.model import geometry
from yade.nonsmooth.studies.slope import results
from yade.nonsmooth.world.stepping import advance

pytestmark = pytest.mark.usefixtures("empty")


def written(tmp_path, **changes):
    """The small slope with changed parts of its data, by their keys; lists are appended to."""

    def change(data):
        for key, value in changes.items():
            if isinstance(value, list):
                data.setdefault(key, []).extend(value)
            else:
                data[key].update(value)

    return section.load(str(write_changed(tmp_path, change)))


def run(made, out, end=None):
    """The course of a section in this process, with its series and summary."""
    out.mkdir()
    course = experiment.begin(made, out, packing=packing.cached_pack(made))
    course.run(end)
    return course, records.read_series(out / "series.csv"), results.summarise(out, made, vars(course.state))


def joint(**more):
    return dict(
        materials={"joint": {"bonded": False, "friction": 0.7, "rolling_friction": 0.1}},
        interfaces=[{"between": ["L1", "L2"], "material": "joint", **more}],
    )


def heights(packed, line):
    """Of disks' centres above a straight line [m], in radii."""
    (ax, ay), (bx, by) = line
    along = np.array([bx - ax, by - ay]) / math.hypot(bx - ax, by - ay)
    return ((packed.y - ay) * along[0] - (packed.x - ax) * along[1]) / packed.r


# ---- packings -------------------------------------------------------------------------------------


def test_disks_at_a_flat_interface_keep_to_their_sides(tmp_path):
    made = written(tmp_path, **joint())
    packed = packing.pack(made)
    line = made.line_of(made.interfaces[0])
    assert line == pytest.approx(np.array([[-35.155, 18.5995], [0.845, 1.8125]]))
    h = heights(packed, line)
    lower, upper = h[packed.layer == 0], h[packed.layer == 1]
    # they touch it, and pass it by no more than packings pass walls: a thousandth of a diameter
    assert -1.05 < lower.max() < -0.997 and 0.997 < upper.min() < 1.05
    assert packing.overlaps(packed, made.outline).worst < 1e-3
    rough = packing.pack(dataclasses.replace(made, interfaces=(dataclasses.replace(made.interfaces[0], flat=False),)))
    h = heights(rough, line)
    assert h[rough.layer == 0].max() > -0.7 and h[rough.layer == 1].min() < 0.7


def test_the_border_of_two_layers_is_found_also_where_vertices_differ():
    one = geometry.Polygon([(0, 0), (10, 0), (10, 1), (0, 1)])
    other = geometry.Polygon([(2, 1 + 1e-7), (10, 1), (10, 3), (2, 3)])
    found = geometry.border(one, other, 1e-6)
    assert found[[0, -1]] == pytest.approx(np.array([[2, 1], [10, 1]]), abs=1e-5) and found[:, 1] == pytest.approx(
        1, abs=1e-5
    )
    assert geometry.border(one, geometry.Polygon([(0, 5), (1, 5), (1, 6)]), 1e-6).shape == (0, 2)


def test_a_layer_has_disks_of_its_own(tmp_path):
    made = written(
        tmp_path,
        layers=[
            {
                "name": "L3",
                "material": "rock",
                "disks": {"diameter": [0.3, 0.4], "packing_fraction": 0.78},
                "vertices": [[10.0, 2.1322], [30.0, 2.8306], [30.0, 5.0], [10.0, 5.0]],
            }
        ],
    )
    packed = packing.pack(made)
    counts = np.bincount(packed.layer)
    assert tuple(counts) == made.disk_counts() and counts[:2].tolist() == list(section.load(str(SMALL)).disk_counts())
    small = packed.r[packed.layer == 2]
    assert 0.15 <= small.min() < 0.155 and 0.195 < small.max() <= 0.2 and packed.r[packed.layer < 2].min() >= 0.25
    assert (made.smallest, made.largest) == (0.3, 1.0)
    covered = math.pi * np.sum(small**2) / made.layers[2].area
    assert covered == pytest.approx(0.78, abs=0.03)  # less along its borders
    fewer = made.with_disks(400)
    assert sum(fewer.disk_counts()) == pytest.approx(400, abs=3)
    assert fewer.layers[2].disks.d_max / fewer.disks.d_max == pytest.approx(0.4) and fewer.smallest == pytest.approx(
        0.3 * fewer.scale
    )
    half = similar.scaled(made, 0.25)
    assert half.smallest == pytest.approx(0.075) and half.disk_counts() == made.disk_counts()


# ---- interfaces -----------------------------------------------------------------------------------


def test_an_interface_bears_what_lies_on_it(tmp_path):
    """The upper layer touches the lower one alone: at rest the force across the interface is its weight."""
    made = written(tmp_path, **joint())
    course, series, _ = run(made, tmp_path / "out", 4.0)
    assert series["energy_kinetic_J"][-1] < 0.1  # of a layer that falls freely for one step: 300
    walls = records.read_walls(tmp_path / "out" / "walls.csv")
    last = (walls["wall"] == "L1-L2") & (walls["step"] == walls["step"].max())
    packed = packing.cached_pack(made)
    weight = 2500 * 9.81 * math.pi * np.sum(packed.r[packed.layer == 1] ** 2)
    beta = math.radians(made.dip)
    # the backstop bears 0.8 % of it
    assert walls["normal_N_per_m"][last] == pytest.approx(weight * math.cos(beta), rel=0.01)
    assert walls["shear_N_per_m"][last] == pytest.approx(weight * math.sin(beta), rel=0.02)
    assert np.isnan(walls["slip_mean_m"][last]).all() and course.slope.solver.bonds > 300


def test_an_interface_is_a_slip_surface_like_a_wall(tmp_path):
    """Of a weak joint the upper layer slides off: its slip, forces and times are those of the series; DP is ground."""
    data = joint(name="joint", role="slip")
    data["materials"]["joint"] |= {
        "friction": 0.18,
        "slip_weakening": {"law": "linear", "critical_slip": 0.3, "friction": 0.0},
    }
    made = written(tmp_path, **data)
    made = dataclasses.replace(
        made, walls=tuple(dataclasses.replace(w, role="ground") if w.name == "DP" else w for w in made.walls)
    )
    assert [name for name, _ in made.slip_surfaces] == ["joint"] and made.dip == pytest.approx(25, abs=0.01)
    course, series, told = run(made, tmp_path / "out", 8.0)
    walls = records.read_walls(tmp_path / "out" / "walls.csv")
    mine = walls["wall"] == "joint"
    assert np.array_equal(walls["normal_N_per_m"][mine], series["dp_normal_effective_N_per_m"]) and np.array_equal(
        walls["shear_N_per_m"][mine], series["dp_shear_N_per_m"]
    )
    assert np.array_equal(walls["slip_mean_m"][mine], series["slip_mean_dp_m"]) and series["weakened_disks"].max() > 10
    # it does not bear its own weight; slip begins anew when it has settled
    assert told["failed_dry_s"] is not None and told["times_s"]["t4"] is not None and told["front_travel_m"] > 3
    slip, settled = series["slip_mean_dp_m"], int(np.argmax(series["stage"] > 0))
    assert slip[settled] < slip[settled - 1] and slip[-1] > 0.3
    # and the run goes on with the same law after a resume
    again = experiment.resume(made, tmp_path / "out")
    assert again.walls.slip().mean == pytest.approx(series["slip_mean_dp_m"][-1], rel=1e-12)
    again.series.close()


def test_of_two_slip_surfaces_one_above_the_other_each_bears_its_own_weight(tmp_path):
    """At rest and wet, whatever the table: N of the plane is the weight of both layers, N of the joint that of the
    upper one, and dp_… are those of the plane alone.
    """

    def change(data):
        data.update(joint(name="joint", role="slip"), materials=data["materials"])
        data["materials"] |= {"joint": {"bonded": False, "friction": 2.0, "rolling_friction": 0.1}}
        data["materials"]["dp"]["friction"], data["materials"]["rock"]["tensile_strength"] = 2.0, 1e6
        data["water"] |= {"table": {"points": [[0.0, 0.0], [0.5, 6.0]]}, "volume": "disk"}
        data["stages"] |= {"water": {"hold": "never"}}

    made = section.load(str(write_changed(tmp_path, change)))
    assert made.stacked == ("DP", "joint")
    course, series, _ = run(made, tmp_path / "out", 3.0)
    walls = records.read_walls(tmp_path / "out" / "walls.csv")
    packed = packing.cached_pack(made)
    area = [math.pi * np.sum(packed.r[packed.layer == k] ** 2) for k in (0, 1)]
    beta = math.radians(made.dip)
    for name, of in (("DP", sum(area)), ("joint", area[1])):
        total, effective, water, shear = (
            series[f"dp_{what}_N_per_m:{name}"] for what in ("normal_total", "normal_effective", "water", "shear")
        )
        mine = walls["wall"] == name
        assert np.array_equal(effective, walls["normal_N_per_m"][mine]) and np.array_equal(
            shear, walls["shear_N_per_m"][mine]
        )
        assert np.array_equal(total, effective + water)
        # all disks are wet: γ_w cos β on the area of what lies above
        assert series["wet_disks"][-1] == len(packed.r)
        assert water[-1] == pytest.approx(9810 * math.cos(beta) * of, rel=1e-5)  # digits of the vertices
        # dry and wet: the weight, less what the backstop bears by its friction, which stands across the plane
        for row in (np.argmax(series["stage"] == 2), -1):
            held = -series["fb_shear_N_per_m"][row] if name == "DP" else 0.0
            # 0.5 % rests on the backstop's upper end, and is the motion that is left
            assert total[row] + held == pytest.approx(2500 * 9.81 * math.cos(beta) * of, rel=0.01)
    for name in (
        "dp_normal_total_N_per_m",
        "dp_water_N_per_m",
        "dp_shear_N_per_m",
        "dp_normal_peak_N_per_m",
        "slip_mean_dp_m",
        "weakened_disks",
    ):
        assert np.array_equal(series[name], series[f"{name}:DP"])
    assert course.section.lowest_surfaces == (course.section.wall("DP"),)


def test_a_slip_wall_above_another_is_no_part_of_the_sum(tmp_path):
    def block(name, y):
        return {
            "name": name,
            "material": "rock",
            "vertices": [[-20, y + 10], [-5, y + 2.5], [-5, y + 6.5], [-20, y + 14]],
        }

    def wall(name, y, **more):
        return {"name": name, "material": "floor", "role": "slip", "vertices": [[-20, y + 10], [0, y]], **more}

    rock = {"friction": 0.8, "rolling_friction": 0.1, "density": 2500, "tensile_strength": 1e6}
    made = section.of(
        name="two floors",
        walls=[wall("low", 0), wall("shelf", 12, apart=True)],
        layers=[block("under", 0), block("upper", 12)],
        materials={"rock": rock, "floor": {"friction": 0.8, "rolling_friction": 0.1, "tensile_strength": 1e6}},
        disks={"diameter": [0.8, 1.6], "packing_fraction": 0.78},
    )
    assert made.stacked == ("low", "shelf")
    _, series, _ = run(made, tmp_path / "out", 1.0)
    walls = records.read_walls(tmp_path / "out" / "walls.csv")
    for what, column in (("normal", "normal_effective"), ("shear", "shear"), ("normal_peak", "normal_peak")):
        of = {name: walls[f"{what}_N_per_m"][walls["wall"] == name] for name in made.stacked}
        assert np.array_equal(series[f"dp_{column}_N_per_m"], of["low"]) and of["shelf"].any()
        for name in made.stacked:
            assert np.array_equal(series[f"dp_{column}_N_per_m:{name}"], of[name])


@pytest.mark.parametrize(
    "changes, key, remedy",
    [
        (dict(between=["L1", "L9"]), "interfaces[0].between: no layer is called 'L9'", "L1, L2"),
        (dict(between=["L1", "L1"]), "interfaces[0].between: both are L1", "two different"),
        (dict(material="jointt"), "interfaces[0].material: 'jointt' is not defined", "joint"),
        (dict(name="DP"), "interfaces[DP].name: the name 'DP' is taken", "its own"),
    ],
)
def test_interfaces_that_are_none_are_refused(tmp_path, changes, key, remedy):
    data = joint()
    data["interfaces"][0].update(changes)
    with pytest.raises(section.SectionError) as refused:
        written(tmp_path, **data)
    assert key in str(refused.value) and remedy in str(refused.value)


def test_two_laws_for_one_interface_are_refused(tmp_path):
    data = joint()
    data["interfaces"].append({"name": "again", "between": ["L2", "L1"], "material": "joint"})
    with pytest.raises(section.SectionError, match="L2 and L1 have an interface already, L1-L2"):
        written(tmp_path, **data)


# ---- a bed and an obstacle ------------------------------------------------------------------------

BED = {
    "name": "bed",
    "role": "bed",
    "material": "gravel",
    "disks": {"diameter": [0.4, 0.7], "packing_fraction": 0.72},
    "vertices": [[2.0, 1.8528], [14.0, 2.2717], [14.0, 3.0], [2.0, 3.2]],
}
HOUSE = {
    "name": "house",
    "role": "obstacle",
    "material": "rock",
    "disks": {"diameter": [0.4, 0.6], "packing_fraction": 0.72},
    "vertices": [[17.0, 2.3764], [20.0, 2.4812], [20.0, 6.0], [17.0, 6.0]],
}
GRAVEL = {"gravel": {"bonded": False, "friction": 0.4, "rolling_friction": 0.1, "density": 2200.0}}


@pytest.fixture(scope="module")
def eroded(tmp_path_factory):
    from yade import O

    O.reset()
    home = tmp_path_factory.mktemp("bed")
    made = written(home, layers=[BED, HOUSE], materials=GRAVEL)
    told = (made, *run(made, home / "out"), home / "out")
    yield (*told, _one_more_step(told[1]))
    O.reset()


def _one_more_step(course):
    """Force [N/m] that changes the momentum of all disks in a step, and what acts on them in it: weight, water, walls;
    each (x, y).
    """
    from yade import O

    def momentum():
        return np.sum([np.array(tuple(O.bodies[k].state.vel)[:2]) * O.bodies[k].state.mass for k in disks], axis=0)

    disks = range(course.slope.first_disk, course.slope.first_disk + course.slope.count)
    course.walls.forget()
    before = momentum()
    advance()
    rate = (momentum() - before) / O.dt
    walls = np.zeros(2)
    for wall in course.section.walls:
        (ax, ay), (bx, by) = wall.vertices
        along = np.array([bx - ax, by - ay]) / math.hypot(bx - ax, by - ay)
        normal, shear, _ = course.walls._forces._engines[wall.name].take()
        walls -= normal * np.array([along[1], -along[0]]) + shear * along
    weight = sum(O.bodies[k].state.mass for k in disks) * np.array([0.0, -9.81])
    return rate, weight, np.array(tuple(course.slope.water.totalForce)[:2]), walls


def test_the_mass_is_counted_apart_from_its_bed(eroded):
    made, course, series, told, out, _ = eroded
    start, end = (records.read_snapshot(out / name) for name in ("t0.npz", "end.npz"))
    assert told["finished"] and course.monitor.mass.tolist() == (start.layer < 2).tolist()
    # fronts, speeds and centres are of the mass, which begins behind the bed
    assert series["front_m"][0] < 2 < start.x[start.layer == 2].max() < start.x[start.layer == 3].max()
    mass = end.layer < 2
    assert series["front_m"][-1] == pytest.approx(np.max((end.x + end.r)[mass]), abs=1.0) and told["front_travel_m"] > 5
    assert series["centroid_x_m"][-1] == pytest.approx(np.average(end.x[mass], weights=end.r[mass] ** 2), rel=1e-9)
    weight = math.pi * end.r**2 * np.array([2500.0, 2500.0, 2200.0, 2500.0])[end.layer]
    moved = np.hypot(end.x - start.x, end.y - start.y) > 2 * math.sqrt(made.disks_of(made.layers[2]).mean_square)
    assert told["bed_kg_per_m"] == pytest.approx(weight[end.layer == 2].sum()) and told[
        "mass_kg_per_m"
    ] == pytest.approx(weight[mass].sum())
    assert (
        told["entrained_kg_per_m"] == pytest.approx(weight[(end.layer == 2) & moved].sum())
        and 0 < told["entrained_kg_per_m"] < told["bed_kg_per_m"]
    )
    assert (
        told["deposited_kg_per_m"] == pytest.approx(weight[mass & (end.x > 0)].sum())
        and 0 < told["deposited_kg_per_m"] < told["mass_kg_per_m"]
    )


def test_forces_change_the_momentum_of_mass_bed_and_house(eroded):
    """Exact but for rounding in sums of 400 disks; and energy is kept as on any slope."""
    rate, weight, water, walls = eroded[-1]
    assert rate == pytest.approx(weight + water + walls, abs=1e-9 * abs(weight[1])) and np.hypot(*walls) > 0.5 * abs(
        weight[1]
    )
    assert eroded[3]["energy_error_rel"] < 0.01


def test_what_hits_an_obstacle_pushes_it(eroded):
    made, _, series, told, out, _ = eroded
    walls = records.read_walls(out / "walls.csv")
    push = walls["normal_N_per_m"][walls["wall"] == "house"]
    at = int(np.argmin(np.abs(series["time_s"] - told["times_s"]["t0"])))  # some gravel has rolled against it by then
    assert push.max() > 5 * push[at] and push.max() > 3e4 and (push >= 0).all()


def test_disks_of_a_bed_that_cannot_move_erode_no_more(tmp_path, eroded):
    """The same bed of bonded rock, fixed to the ground: the mass runs over it."""
    rigid = written(
        tmp_path,
        layers=[{**BED, "material": "fixed"}],
        materials={
            "fixed": {
                "friction": 0.4,
                "rolling_friction": 0.1,
                "tensile_strength": 1e9,
                "bond_creation_distance": 0.05,
                "density": 2200.0,
            },
            "ss": {
                "bonded": True,
                "tensile_strength": 1e9,
                "friction": 0.3,
                "rolling_friction": 0.1,
                "bond_creation_distance": 0.05,
            },
        },
    )
    _, _, told = run(rigid, tmp_path / "out")
    assert told["entrained_kg_per_m"] == 0 and told["front_travel_m"] > 1


def test_the_example_compares_three_beds(tmp_path):
    """The shipped script on the small slope, each bed to its rest."""

    def change(data):
        data["materials"] |= {**GRAVEL, "base": data["materials"].pop("ss")}
        data["walls"][2]["material"] = "base"
        data["layers"].append(BED)

    path = write_changed(tmp_path, change)
    done = shell.example("erodible_bed.py", tmp_path, section=f"'{path}'", disks=0, seeds=1, folder=f"'{tmp_path}/out'")
    assert done.returncode == 0, done.stderr
    rows = {
        found[1]: (float(found[2]), float(found[3]))
        for found in re.finditer(
            r"^(\w+) +1 of 1 .*: .* m of water, front (\S+) m, entrained (\S+) %$", done.stdout, re.M
        )
    }
    assert set(rows) == {"loose", "cemented", "rigid"} and all(front > 1 for front, _ in rows.values())
    assert rows["rigid"][1] == 0 < rows["loose"][1] <= 100
    told = json.loads((tmp_path / "out" / "beds.json").read_text())
    for name, bed in told.items():
        end = json.loads((tmp_path / "out" / name / "runs" / "seed=1" / "summary.json").read_text())
        assert bed["packings"] == 1 and bed["failed"] == (end["verdict"] == "failed by water")
        assert not bed["failed"] or bed["front_m"]["values"] == [end["front_travel_m"]]
        assert not bed["failed"] or bed["entrained"]["values"] == [end["entrained_kg_per_m"] / end["bed_kg_per_m"]]
        assert round(end["front_travel_m"], 1) == rows[name][0]
    assert (tmp_path / "out" / "beds.png").stat().st_size > 1000
