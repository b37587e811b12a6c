"""Disks that windows take out of a slope: forces of what is left, the ledger to the last bit, the balance of energy,
and the same bits mirrored, resumed, and by O.run().
"""

import json
import math
import shutil

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import experiment, records, runs, scene, section, similar, worlds
from yade.nonsmooth.figures import paraview, video
from yade.nonsmooth.packing_files import Packing
from yade.nonsmooth.studies.safety.asked import Asked, SafetyError
from yade.nonsmooth.world import erosion, tables
from yade.nonsmooth.world.stepping import advance

pytestmark = pytest.mark.usefixtures("empty")
R, DENSITY, G = 0.5, 2000.0, 9.81
WEIGHT = DENSITY * math.pi * R * R * G  # N/m, of a disk
ALL = [[-30.0, -1.0], [30.0, -1.0], [30.0, 30.0], [-30.0, 30.0]]
LOOSE = {"bonded": False, "friction": 0.5, "rolling_friction": 0.1}
STRONG = {"tensile_strength": 1e6, "friction": 0.5, "rolling_friction": 0.1, "bond_creation_distance": 0.05}
SERIES_FILES = ("series.csv", "walls.csv", "eroded.csv", "end.npz")


def turned(points, dip):
    """Points turned down to the right by so many degrees about the origin."""
    c, s = math.cos(math.radians(dip)), math.sin(math.radians(dip))
    return [[c * x + s * y, c * y - s * x] for x, y in points]


def flat(*windows, rock=LOOSE, floor_law={}, end=1.5, dip=0.0, **keys):  # noqa: B006 (it is not changed)
    """A section of two layers on a floor, flat or with a ``dip`` [degrees], whose disks a test places by hand."""
    lower, upper = (turned([(-w, y), (w, y), (w - 1, y + 2), (1 - w, y + 2)], dip) for w, y in ((9, 0), (8, 2)))
    floor = turned([(-20, 0), (20, 0)], dip)
    return section.of(
        name="flat",
        walls=[{"name": "floor", "material": "floor", "role": "slip", "vertices": floor}],
        layers=[
            {"name": "lower", "material": "rock", "vertices": lower},
            {"name": "upper", "material": "rock", "vertices": upper},
        ],
        materials={"rock": rock | {"density": DENSITY}, "floor": LOOSE | floor_law},
        disks={"diameter": [1.0, 1.0]},
        stages={"settle": {"ramp": 0.1, "time_max": 0.3, "speed_rest": 1e-3}, "dry": 0.1, "end": {"time": end}},
        numerics={"time_step": 5e-3, "tolerance": 1e-9, "tolerance_moving": 1e-9, "max_iterations": 3000},
        erosion=list(windows),
        **keys,
    )


def stack(*places, dip=0.0):
    """A packing of disks at (x, y, layer) above a floor with a ``dip``."""
    x, y, layer = np.transpose(places)
    x, y = np.transpose(turned(zip(x, y), dip))
    return Packing(x, y, np.full(len(places), R), layer.astype(int))


def pile(rows=3, width=5, dip=0.0):
    """Rows of disks that touch, one less in each, the highest of the upper layer."""
    of_row = ((row, k) for row in range(rows) for k in range(width - row))
    high = math.sqrt(3) * R
    places = [(k + 0.5 * row - 0.5 * width, R + high * row, int(row == rows - 1)) for row, k in of_row]
    return stack(*places, dip=dip)


def cut(name="cut", begin=0.2, **keys):
    return {"name": name, "vertices": ALL, "begin": begin} | keys


def run(made, packed, folder, until=None, **options):
    """A run from its beginning to its end, or to a time."""
    course = experiment.begin(made, folder, packing=packed, **options)
    course.run(until)
    return course


def of_floor(folder, since):
    """Normal force on the floor in the rows from a time on [N/m]."""
    walls = records.read_walls(folder / "walls.csv")
    return walls["normal_N_per_m"][walls["time_s"] >= since]


def masses(radii):
    """Of disks, as scene.disk gives them [kg/m]."""
    return [DENSITY * math.pi * (r * r) for r in radii]


# ---- the world --------------------------------------------------------------------------------------
def test_what_is_left_keeps_its_motion_and_what_it_bears():
    """Of four disks in a heap that slides, the highest is taken: momentum of the others to the last bit, and the forces
    of their contacts.
    """
    floor, rock = (scene.material(m) for m in (section.Material("f", 0.5, 0.5, 0.0, 0.0, bonded=False),
                                               section.Material("r", 0.5, 0.5, 0.1, 0.1, density=DENSITY)))  # fmt: skip
    floor.wall = True
    O.materials.append([floor, rock])
    O.bodies.append(scene.segments([(-9, 0), (9, 0)], floor, sense=1))
    ids = [O.bodies.append(scene.disk(p, R, rock)) for p in ((0, R), (1, R), (2, R), (0.5, R + math.sqrt(3) * R))]
    for k in ids:
        O.bodies[k].state.vel = (0.3, 0, 0)
        O.bodies[k].state.angVel = (0, 0, -0.2)
    O.dt, O.engines = 1e-3, scene.engines(gravity=(0, -G, 0))
    advance(40, view=False)
    engine = scene.contact_dynamics()
    before, forces = tables.bodies(engine), tables.contacts(engine)
    taken = erosion.take_out(ids[3:])
    after, left = tables.bodies(engine), tables.contacts(engine)
    assert all(np.array_equal(before[name][:3], after[name]) for name in before) and abs(after["vx"]).max() > 0.1
    kept = (forces["id1"] != ids[3]) & (forces["id2"] != ids[3])
    assert kept.sum() >= 3 and all(np.array_equal(forces[name][kept], left[name]) for name in forces)
    mass = DENSITY * math.pi * (R * R)
    speed = math.hypot(before["vx"][3], before["vy"][3])
    assert taken.mass.tolist() == [mass] and taken.potential[0] == pytest.approx(mass * G * before["y"][3], rel=1e-14)
    assert taken.kinetic[0] == pytest.approx(
        mass * (0.5 * speed**2 + 0.25 * (R * before["omega"][3]) ** 2), rel=1e-14
    )
    error = engine.energyError
    advance()
    assert engine.broughtEnergy == pytest.approx(-(taken.kinetic[0] + taken.potential[0]), rel=1e-9)
    # as well as steps of this tolerance keep it
    assert abs(engine.energyError - error) < 2e-6 * taken.potential[0]


@pytest.mark.parametrize("bonded", [False, True])
def test_taking_out_what_bears_nothing_changes_no_bit_of_the_others(bonded):
    """A disk that falls far above a heap, which slides on meanwhile."""
    found = []
    for takes in (False, True):
        O.reset()
        floor = scene.material(section.Material("f", 0.3, 0.3, 0.0, 0.0, bonded=False), wall=True)
        rock = scene.material(section.Material("r", 0.5, 0.5, 0.1, 0.1, 1e4 * bonded, density=DENSITY, bonded=bonded))
        O.materials.append([floor, rock])
        O.bodies.append(scene.segments([(-9, 9), (0, 0), (30, 0)], floor, sense=1))
        places = [(-2.0 + k, 4.0 + k % 3) for k in range(6)]
        ids = [O.bodies.append(scene.disk(p, R, rock)) for p in ((5.0, 900.0), *places)]
        O.dt, O.engines = 2e-3, scene.engines(gravity=(0, -G, 0))
        advance()
        scene.contact_dynamics().bond()
        advance(300, view=False)
        if takes:
            erosion.take_out(ids[:1])
        advance(300, view=False)
        table, contacts = (read(scene.contact_dynamics()) for read in (tables.bodies, tables.contacts))
        of_heap = table["id"] != ids[0]
        found.append([*(v[of_heap] for v in table.values()), *contacts.values()])
    assert len(found[0][0]) == 6 and len(found[0][-1]) > 3
    assert all(np.array_equal(one, other) for one, other in zip(*found))


# ---- forces, by hand --------------------------------------------------------------------------------
def test_of_two_disks_one_is_taken_and_the_other_weighs_what_it_weighs(tmp_path):
    """One lies on the other: the floor bears two weights, and then one."""
    made = flat(cut(layers=["upper"]))
    course = run(made, stack((0.0, R, 0), (0.0, 3 * R, 1)), tmp_path)
    cut_at = course.state.t0 + 0.2
    rows = records.read_walls(tmp_path / "walls.csv")
    before = rows["normal_N_per_m"][(rows["time_s"] > course.state.t0) & (rows["time_s"] <= cut_at + 1e-9)]
    assert before == pytest.approx(2 * WEIGHT, rel=1e-6) and len(before) >= 5
    assert of_floor(tmp_path, cut_at + 0.3) == pytest.approx(WEIGHT, rel=1e-6)
    ledger = records.read_eroded(tmp_path / "eroded.csv")
    assert [ledger[name].tolist() for name in ("window", "disk", "layer", "x_m", "r_m")] == [
        ["cut"], [1], ["upper"], [pytest.approx(0.0, abs=1e-9)], [R]
    ]  # fmt: skip
    assert ledger["time_s"][0] == pytest.approx(cut_at) and ledger["window_time_s"][0] == pytest.approx(0.2)
    assert ledger["y_m"][0] == pytest.approx(3 * R, abs=1e-3) and course.state.moving is None
    assert course.state.stage == "done"


@pytest.mark.parametrize("rock", [LOOSE, STRONG], ids=["loose", "bonded"])
def test_a_whole_layer_on_top_is_taken_out_to_the_last_bit(rock, tmp_path):
    """From its left to its right: the ledger, what is left, and both together are what there was."""
    around = {"vertices": [[-2.0, 0.0], [1.0, 0.0], [1.0, 9.0], [-2.0, 9.0]]}
    opening = {"time": 0.3, "direction": [1.0, 0.0]}
    made, packed = flat(cut(layers=["upper"], opening=opening) | around, rock=rock), pile()
    course = run(made, packed, tmp_path)
    series, ledger = records.read_series(tmp_path / "series.csv"), records.read_eroded(tmp_path / "eroded.csv")
    start, end = (records.read_snapshot(tmp_path / f"{name}.npz") for name in ("t0", "end"))
    top = np.flatnonzero(start.layer == 1)
    assert sorted(ledger["disk"]) == top.tolist() and len(top) == 3
    assert (np.diff(ledger["x_m"]) > 0).all() and len(set(ledger["time_s"])) == 3  # one after the other
    assert math.fsum(ledger["mass_kg_per_m"]) == series["eroded_kg_per_m"][-1]
    assert math.fsum([*ledger["mass_kg_per_m"], *masses(end.r)]) == math.fsum(masses(start.r))
    assert series["eroded_disks"][-1] == 3 and (np.diff(series["eroded_disks"]) >= 0).all()
    assert end.number.tolist() == [k for k in range(12) if k not in top] and (end.layer == 0).all()
    assert start.number is None and (end.ci < 9).all() and (end.cj < 9).all() and end.weakened.shape == (9, 0)
    # the balance of energy closes, and what has left is told apart
    energy = math.fsum([*ledger["energy_kinetic_J"], *ledger["energy_potential_J"]])
    assert series["energy_eroded_J"][-1] == energy
    assert course.slope.solver.broughtEnergy == pytest.approx(-energy, rel=1e-9)
    # of what left, as the column's share is of what a slope at rest turns over
    assert abs(course.slope.solver.energyError) < 1e-5 * energy and course.state.outside == 0.0
    # bonds that go with their disks have not broken
    broken = sum(series[f"bonds_broken_{mode}"][-1] for mode in ("tension", "shear", "torque", "mixed"))
    assert broken == 0 and series["bonds_alive"][-1] == (15 if rock is STRONG else 0)
    # the centre of what is left has not moved, whatever the column's own does
    told = json.loads(json.dumps(course.summarise()))
    assert told["verdict"] == "stood" and "and 3 disks (4.71 t/m) taken out of it" in told["verdict_says"]
    assert told["centroid_travel_m"] < 1e-3 < 0.2 < series["centroid_y_m"][0] - series["centroid_y_m"][-1]
    assert told["eroded_disks"] == 3 and told["eroded_kg_per_m"] == series["eroded_kg_per_m"][-1]
    assert told["energy_eroded_J_per_m"] == energy and told["eroded_at_failure_kg_per_m"] is None
    assert abs(told["front_travel_m"]) < 1e-3 and told["bulking_factor"] is None


@pytest.mark.parametrize("roles", [{}, {"lower": "bed"}])
def test_windows_that_leave_nothing_of_the_mass_are_told(roles, tmp_path):
    """What nobody is left of has no speed, no front and no centre."""
    made = flat(cut(layers=["upper"] if roles else ["upper", "lower"]))
    if roles:
        made = made.with_values({"layers.lower.role": "bed"})
    with pytest.raises(experiment.ExperimentError, match="the window cut takes the last disks of the mass out"):
        run(made, pile(), tmp_path)
    assert not len(records.read_eroded(tmp_path / "eroded.csv")["disk"])


def test_windows_may_take_all_but_what_they_may_not(tmp_path):
    """Two windows over one another: the first takes what both may, and a layer that none may take stays."""
    made = flat(
        cut("first", layers=["upper"]), cut("second", layers=["upper"]), cut("late", begin=0.4, layers=["upper"])
    )
    run(made, pile(), tmp_path)
    ledger = records.read_eroded(tmp_path / "eroded.csv")
    assert set(ledger["window"]) == {"first"} and len(ledger["disk"]) == 3


def test_a_slope_whose_foot_is_gone_fails_by_erosion(tmp_path):
    """Towers of three disks, whose lowest are taken: the others fall on the floor."""
    made = flat(cut(layers=["lower"]), end=6.0)
    towers = [(x, R + 2 * R * k, int(k > 0)) for x in (0.0, 4.0) for k in range(3)]
    course = run(made, stack(*towers), tmp_path)
    told = course.summarise()
    assert told["verdict"] == "failed by erosion" and told["eroded_disks"] == 2, told["verdict_says"]
    assert told["eroded_at_failure_kg_per_m"] == told["eroded_kg_per_m"] > 0
    assert told["times_s"]["t2"] == course.state.moving and told["failed_dry_s"] is None
    assert told["water_at_failure_m"] is None


@pytest.mark.parametrize("rock, became", [(STRONG, "stood"), (LOOSE, "failed by erosion")], ids=["bonded", "loose"])
def test_a_vertical_cut_of_bonded_rock_stands_and_one_of_loose_disks_does_not(rock, became, tmp_path):
    """A heap is cut down to the floor through its middle, from its top; all in one layer, so that bonds hold it."""
    half = {"vertices": [[0.0, -1.0], [9.0, -1.0], [9.0, 9.0], [0.0, 9.0]]}
    rows = 8
    high = math.sqrt(3) * R
    places = [(k + 0.5 * j - 0.5 * rows, R + high * j, 0) for j in range(rows) for k in range(rows - j)]
    made = flat(cut(opening={"time": 0.4}) | half, rock=rock, end=5.0)
    told = run(made, stack(*places), tmp_path).summarise()
    assert told["verdict"] == became and told["eroded_disks"] >= 12, told["verdict_says"]
    end = records.read_snapshot(tmp_path / "end.npz")
    assert ((end.x > 0.1).sum() == 0) == (became == "stood")


# ---- the same bits ----------------------------------------------------------------------------------
RIVER = {"vertices": [[2.2, -1.0], [9.0, -1.0], [9.0, 9.0], [2.2, 9.0]], "velocity": [-3.0, 0.0]}


def river(**keys):
    """A heap on a floor that weakens with slip, which water wets and a river eats."""
    water = {
        "plane": "floor",
        "table": {"points": [[0.0, 0.0], [0.5, 1.5]]},
        "pressure_gradient": "hydrostatic",
        "volume": "disk",
        "release_distance": 0.2,
    }
    weak = {"friction": 0.15, "slip_weakening": {"law": "linear", "critical_slip": 1e-4, "friction": 0.1}}
    window = cut("river", begin=0.1, end=0.9, hold="never") | RIVER
    return flat(window, dip=3.0, floor_law=weak, water=water, **keys)


def eaten_pile():
    return pile(4, 6, dip=3.0)


@pytest.fixture(scope="module")
def eaten(tmp_path_factory):
    """The folder of a heap that a river has eaten from its right."""
    O.reset()
    folder = tmp_path_factory.mktemp("eaten")
    run(river(), eaten_pile(), folder)
    yield folder
    O.reset()


def same(one, other):
    return [name for name in SERIES_FILES if (one / name).read_bytes() != (other / name).read_bytes()]


def test_a_mirrored_window_gives_the_mirrored_run(eaten, tmp_path):
    run(similar.mirrored(river()), similar.mirrored_packing(eaten_pile()), tmp_path)
    here, there = (records.read_series(folder / "series.csv") for folder in (eaten, tmp_path))
    turned = ("front_m", "centroid_x_m", "eroded_shift_x_m")
    for name, values in here.items():
        assert np.array_equal(there[name] * (-1 if name in turned else 1), values), name
    one, other = (records.read_eroded(folder / "eroded.csv") for folder in (eaten, tmp_path))
    assert len(one["disk"]) >= 6 and (one["energy_kinetic_J"] > 0).any()
    # water acts, and slip counts, while disks go
    assert here["wet_disks"].max() >= 5 and 0 < here["slip_mean_dp_m"].max() and np.ptp(here["dp_water_N_per_m"]) > 0
    for name, values in one.items():
        assert np.array_equal(-other[name] if name in ("x_m", "vx_m_per_s") else other[name], values), name


def test_a_slope_that_goes_on_from_a_checkpoint_has_the_same_files(eaten, tmp_path):
    """Stopped after a part has been taken out, with rows written beyond the checkpoint."""
    course = run(river(), eaten_pile(), tmp_path, until=0.75)
    gone = course.eroding.disks
    assert 0 < gone < len(records.read_eroded(eaten / "eroded.csv")["disk"])
    assert records.read_series(tmp_path / "series.csv")["slip_mean_dp_m"][-1] > 0
    course.checkpoint()
    kept = tmp_path / "kept"
    shutil.copytree(tmp_path / "checkpoint", kept)
    course.run(0.9)
    assert course.eroding.disks > gone  # the ledger is longer than at the checkpoint
    shutil.rmtree(tmp_path / "checkpoint")
    kept.rename(tmp_path / "checkpoint")
    O.reset()
    course = experiment.resume(river(), tmp_path)
    assert course.eroding.disks == gone
    course.run()
    assert same(eaten, tmp_path) == []
    other = river().with_values({"erosion.river.end": 0.8})
    with pytest.raises(experiment.ExperimentError, match="another"):
        experiment.resume(other, tmp_path)


def test_steps_by_o_run_take_the_same_disks(eaten, tmp_path):
    course = experiment.begin(river(), tmp_path, packing=eaten_pile())
    course.attach(stands=True)
    while course.state.stage != "done":
        O.run(400, True)
    assert same(eaten, tmp_path) == []


def test_soft_contacts_go_through_the_same_code(tmp_path):
    """Springs lose the same disks of the same layer, and no bond breaks."""
    made, soft = flat(cut(layers=["upper"]), rock=STRONG), worlds.Soft(1e8, (1.0, 1.0))
    course = run(made, pile(), tmp_path, world=soft)
    series, ledger = records.read_series(tmp_path / "series.csv"), records.read_eroded(tmp_path / "eroded.csv")
    assert sorted(ledger["disk"]) == [9, 10, 11] or len(ledger["disk"]) == 3
    assert series["eroded_kg_per_m"][-1] == math.fsum(ledger["mass_kg_per_m"])
    assert series["eroded_kg_per_m"][-1] == pytest.approx(3 * WEIGHT / G, rel=1e-12)
    broken = sum(series[f"bonds_broken_{mode}"][-1] for mode in ("tension", "shear", "torque", "mixed"))
    assert broken == 0 and series["bonds_alive"][-1] < series["bonds_alive"][0]
    assert of_floor(tmp_path, series["time_s"][-1] - 0.1) == pytest.approx(9 * WEIGHT, rel=1e-2)
    assert len(records.read_snapshot(tmp_path / "end.npz").x) == 9 and course.state.stage == "done"


# ---- what is read of it -----------------------------------------------------------------------------
def test_an_opened_run_tells_what_was_taken(eaten, tmp_path):
    opened = runs.open_run(eaten)
    assert opened.frame("eroded").mass_kg_per_m.sum() == pytest.approx(opened.series["eroded_kg_per_m"][-1])
    assert opened.columns["energy_eroded_J"].unit == "J/m" and opened.section.erosion[0].name == "river"
    end = opened.snapshot("end")
    path = paraview.write_disks(end, tmp_path / "disks.vtu")
    import meshio

    assert meshio.read(path).point_data["number"].tolist() == end.number.tolist()
    with pytest.raises(records.RecordsError, match="walls.csv: cannot be read as the ledger"):
        records.read_eroded(eaten / "walls.csv")


def test_a_gone_disk_is_in_no_frame_of_the_video(eaten, monkeypatch):
    drawn, frames = [], runs.open_run(eaten).snapshots.values()
    monkeypatch.setattr(video.film, "missing", lambda: None)

    def write(path, fig, pictures, fps):
        for _ in pictures:
            (disks,) = [c for c in fig.axes[0].collections if hasattr(c, "_widths")]
            drawn.append(np.asarray(disks.get_offsets(), float))

    monkeypatch.setattr(video.film, "write", write)
    shots = sorted((p for p in frames if p.stem.isdecimal()), key=lambda p: int(p.stem))
    video.write_mp4(shots, runs.open_run(eaten).section, eaten / "none.mp4")
    for offsets, path in zip(drawn, shots):
        s = records.read_snapshot(path)
        there = np.isfinite(offsets).all(axis=1)
        assert there.sum() == len(s.x) and np.array_equal(offsets[there], np.column_stack([s.x, s.y]))
    assert np.isfinite(drawn[-1]).all(axis=1).sum() < np.isfinite(drawn[0]).all(axis=1).sum()


def test_a_search_for_the_factor_of_safety_refuses_windows():
    with pytest.raises(SafetyError, match="erosion: a search takes no disks out, and cut would not act"):
        Asked(flat(cut()))
