"""Rows of walls, interfaces and obstacles, and sums by role, for a few disks placed by hand on walls of several pieces:
weights, friction and momentum say what is right.
"""

import dataclasses
import math

import numpy as np
import pytest
from slope_scenes import write_changed
from yade import O
from yade.nonsmooth import packing, records, section, similar, worlds
from yade.nonsmooth.studies.slope import slope
from yade.nonsmooth.studies.slope.wall_series import WallSeries

pytestmark = pytest.mark.usefixtures("empty")

G, DENSITY, FRICTION = 9.81, 2500.0, 0.45


def written(folder, change=lambda data: None, side=1):
    """The small slope, of 25°, without water, with its plane in two walls of which one has a corner between its ends;
    nothing weakens. ``change(data)`` changes more.
    """

    def both(data):
        del data["water"]
        data["materials"]["dp"] = {"bonded": False, "friction": FRICTION, "rolling_friction": 0.0}
        (x, y), foot = data["walls"][0]["vertices"]
        data["walls"][:1] = [
            {"name": "upper", "material": "dp", "role": "slip", "vertices": [[x, y], [x / 2, y / 2]]},
            {"name": "lower", "material": "dp", "role": "slip", "vertices": [[x / 2, y / 2], [x / 4, y / 4], foot]},
        ]
        data["materials"]["rock"]["bonded"] = False
        change(data)

    made = section.load(str(write_changed(folder, both)))
    return made if side > 0 else similar.mirrored(made)


class Placed:
    """Disks in a section's scene, each (way up the slope from the foot, height of its centre above the plane, radius,
    layer); they may not turn.
    """

    def __init__(self, made, disks, folder, world=None):
        up, off, r, layer = map(np.array, zip(*disks))
        x, y = np.array([off, off]) * np.array(made.normal)[:, None] - up * np.array(made.downslope)[:, None]
        packed = packing.Packing(x, y, r.astype(float), layer.astype(int))
        self.section, self.path = made, folder / "walls.csv"
        self.built = slope.build(made, packed, world)
        self.numbers = np.argsort(slope.order_of(made, packed))  # in the scene
        self.states = [O.bodies[self.built.first_disk + int(k)].state for k in self.numbers]
        for state in self.states:
            state.blockedDOFs = "zXYZ"
        self.mass = np.array([s.mass for s in self.states])
        self.series = WallSeries(self.built, slope.layers_of(self.built), self.path, 1)

    def push(self, *speeds):
        """Gives the disks speeds [m/s] down the slope."""
        for state, speed in zip(self.states, speeds):
            state.vel = [speed * part for part in (*self.section.downslope, 0)]

    def along(self, of="vel"):
        """Speeds, or places, of the disks down the slope."""
        return np.array([[*tuple(getattr(s, of))[:2]] for s in self.states]) @ np.array(self.section.downslope)

    def forces(self):
        """Makes a step; returns the forces (n, 2) [N] besides weight that changed the momentum of the disks in it."""
        before, time = np.array([tuple(s.vel)[:2] for s in self.states]), O.time
        O.step()
        gained = np.array([tuple(s.vel)[:2] for s in self.states]) - before
        return self.mass[:, None] * (gained / (O.time - time) + [0, G])

    def rows(self):
        """The rows of the last step: {name: {column: value}}."""
        found = records.read_walls(self.path)
        last = np.flatnonzero(found["step"] == found["step"].max())
        return {str(found["wall"][k]): {name: values[k] for name, values in found.items()} for k in last}


ON_THE_WALLS = [(3.0, 0.3, 0.3, 0), (8.0, 0.5, 0.5, 0), (13.0, 0.4, 0.4, 0), (31.0, 0.5, 0.5, 0)]  # one on each piece


def test_a_wall_has_the_sum_of_all_its_pieces(tmp_path):
    """Disks that slide on different pieces of two walls: N = m g cos β, T = μ N, and what sliding costs is T times the
    way, by the mean of the speeds before and after each step.
    """
    placed = Placed(written(tmp_path), ON_THE_WALLS, tmp_path)
    built = placed.built
    assert len(built.walls["lower"]) > 3 and len(built.walls["upper"]) > 2
    placed.push(1.0, 2.0, 0.5, 1.5)
    way, pieces = np.zeros(4), set()
    for _ in range(12):
        before, time = placed.along(), O.time
        O.step()
        way += 0.5 * (before + placed.along()) * (O.time - time)
        pieces |= {i.id1 for i in O.interactions if i.isReal}
    assert len(pieces) >= 4
    (found, _), rows = placed.series.take(), placed.rows()
    normal = placed.mass * G * math.cos(math.radians(placed.section.dip))
    for name, chosen in (("lower", slice(0, 3)), ("upper", slice(3, 4))):
        n = normal[chosen].sum()
        told = [rows[name][f"{what}_N_per_m"] for what in ("normal", "shear", "normal_peak")]
        assert told == pytest.approx([n, FRICTION * n, n], rel=1e-6)  # of walls that are placed to six digits
        assert rows[name]["energy_sliding_J"] == pytest.approx(FRICTION * (normal * way)[chosen].sum(), rel=1e-6)
        assert math.isnan(rows[name]["slip_mean_m"])  # it does not weaken
    n = normal.sum()
    assert found["slip"] == pytest.approx((n, FRICTION * n, n), rel=1e-6)
    assert found["backstop"] == found["ground"] == (0.0, 0.0, 0.0)
    assert [rows[name]["energy_sliding_J"] for name in ("FB", "SS")] == [0.0, 0.0]


def test_a_role_without_walls_has_no_force(tmp_path):
    made = written(tmp_path)
    walls = tuple(dataclasses.replace(w, role="ground") if w.role == "backstop" else w for w in made.walls)
    made = dataclasses.replace(made, walls=walls)
    placed = Placed(made, ON_THE_WALLS, tmp_path)
    O.step()
    found, _ = placed.series.take()
    assert set(found) >= {"slip", "backstop", "ground"} and found["backstop"] == found["ground"] == (0.0, 0.0, 0.0)
    assert found["slip"][0] == pytest.approx(placed.mass.sum() * G * math.cos(math.radians(made.dip)), rel=1e-6)


@pytest.mark.parametrize("side", [1, -1])
def test_shear_that_holds_the_mass_back_is_positive(tmp_path, side):
    """On a slope to the left too; and where the mass is driven uphill it is negative."""
    for speed, sign in ((1.0, 1), (-1.0, -1)):
        placed = Placed(written(tmp_path, side=side), ON_THE_WALLS[:1], tmp_path)
        placed.push(speed)
        O.step()
        normal = placed.mass[0] * G * math.cos(math.radians(abs(placed.section.dip)))
        assert placed.series.take()[0]["slip"] == pytest.approx((normal, sign * FRICTION * normal, normal), rel=1e-6)


def test_what_came_before_is_forgotten(tmp_path):
    """A hit in the first step counts in the mean and the peak until they begin anew."""
    placed = Placed(written(tmp_path), ON_THE_WALLS[:1], tmp_path)
    placed.states[0].vel = [-5.0 * part for part in (*placed.section.normal, 0)]
    O.step()
    O.step()
    weight = placed.mass[0] * G * math.cos(math.radians(placed.section.dip))
    normal, _, peak = placed.series.take()[0]["slip"]
    assert peak > 10 * weight and normal > 5 * weight
    placed.states[0].vel = [-5.0 * part for part in (*placed.section.normal, 0)]
    O.step()
    placed.series.forget()
    O.step()
    # the solver's tolerance, from the hit's impulse down
    assert placed.series.take()[0]["slip"][::2] == pytest.approx((weight, weight), rel=1e-4)


# ---- slip -----------------------------------------------------------------------------------------
WEAKENS = {"lower": 0.055, "upper": 0.02}  # m, D_c


def weakening(data):
    for name, slip in WEAKENS.items():
        data["materials"][name] = {
            "bonded": False,
            "friction": FRICTION,
            "rolling_friction": 0.0,
            "slip_weakening": {"law": "step", "critical_slip": slip, "friction": 0.2},
        }
    for wall in data["walls"][:2]:
        wall["material"] = wall["name"]


@pytest.mark.parametrize("soft", [False, True])
def test_the_slip_of_several_walls_is_the_mean_over_their_disks(tmp_path, soft):
    """Three disks on one wall and one on the other: each has slipped as far as it has gone, and the mean of all is that
    over four disks, not over two walls.
    """
    made = written(tmp_path, weakening)
    world = worlds.Soft(stiffness=1e8, diameter=(0.6, 1.0), damping=0.0) if soft else None
    # springs, of E R and 0.3 E R, bear a disk once it overlaps, here by its weight, and give way before it slides
    sink = np.array([DENSITY * math.pi * r * G * math.cos(math.radians(made.dip)) / 1e8 for _, _, r, _ in ON_THE_WALLS])
    placed = Placed(made, [(s, h - soft * d, r, k) for (s, h, r, k), d in zip(ON_THE_WALLS, sink)], tmp_path, world)
    start = placed.along("pos")
    assert placed.series.slip()[:3] == (0.0, 0, 0)
    placed.push(1.0, 2.0, 0.5, 1.5)
    while O.time < 0.0395:
        O.step()
    gone = placed.along("pos") - start  # m: some 0.04, 0.08, 0.02 and 0.06
    if soft:  # what their springs are strained by, T/k_s, is no slip; the second and the fourth have weakened
        gone -= np.array([FRICTION, 0.2, FRICTION, 0.2]) * sink / 0.3
    near = dict(abs=1.5e-4) if soft else dict(rel=1e-6)  # m, of springs that tremble
    slip = placed.series.slip()
    assert slip.mean == pytest.approx(gone.mean(), **near) and (slip.weakened, slip.touched, slip.counts) == (
        2,
        4,
        True,
    )
    assert abs(slip.mean - 0.5 * (gone[:3].mean() + gone[3])) > 1e-3  # the mean of means is another
    past = placed.series.weakened()
    assert [one.name for one in made.weakening] == ["upper", "lower"]
    assert past[placed.numbers].tolist() == [[False, False], [False, True], [False, False], [True, False]]
    placed.series.take()
    rows = placed.rows()
    for name, chosen, weak in (("lower", slice(0, 3), 1), ("upper", slice(3, 4), 1)):
        assert rows[name]["slip_mean_m"] == pytest.approx(gone[chosen].mean(), **near)
        assert rows[name]["weakened_disks"] == weak and rows[name]["weakened_share"] == weak / len(gone[chosen])
        assert math.isnan(rows[name]["energy_sliding_J"]) == soft  # springs do not tell it
    placed.series.forget_slip()
    assert placed.series.slip() == (0.0, 0, 0, True) and not placed.series.weakened().any()


def test_where_nothing_weakens_no_slip_counts(tmp_path):
    placed = Placed(written(tmp_path), ON_THE_WALLS, tmp_path)
    placed.push(1.0, 1.0, 1.0, 1.0)
    O.step()
    placed.series.forget_slip()  # nothing to forget
    assert placed.series.slip() == (0.0, 0, 0, False) and placed.series.weakened().shape == (4, 0)


# ---- interfaces and obstacles ---------------------------------------------------------------------
def two_on_one(data):
    """Beside L2 a layer L3, both on L1, each with an interface of its own: of μ = 0.2, and of 0.6 that falls with
    slip.
    """
    rock = data["layers"][1]
    rock["vertices"] = [[0.845, 1.8125], [-1.029, 4.893], [-17.6695, 12.6526], [-17.155, 10.206]]
    other = [[-17.155, 10.206], [-17.6695, 12.6526], [-34.31, 20.4122], [-35.155, 18.5995]]
    data["layers"].append({**rock, "name": "L3", "vertices": other})
    data["materials"]["smooth"] = {"bonded": False, "friction": 0.2, "rolling_friction": 0.0}
    data["materials"]["rough"] = {
        "bonded": False,
        "friction": 0.6,
        "rolling_friction": 0.0,
        "slip_weakening": {"law": "step", "critical_slip": 5.0, "friction": 0.1},
    }
    data["interfaces"] = [
        {"name": "first", "between": ["L1", "L2"], "material": "smooth", "role": "slip"},
        {"name": "second", "between": ["L1", "L3"], "material": "rough"},
    ]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("lean", [0.05, -0.05])
def test_each_interface_of_a_layer_has_its_own_law(tmp_path, side, lean):
    """Two disks of L1 that are held, and on each one of L2 or L3 that slides down the slope, a little before or behind
    its crest: so the upper one has the higher id or the lower.
    """
    made = written(tmp_path, two_on_one, side)
    lower, upper = [(6.0, 5.0, 0.5, 0), (20.0, 5.0, 0.5, 0)], []
    for k, (up, off, *_) in enumerate(lower):
        upper.append((up + math.sin(lean), off + math.cos(lean), 0.5, 1 + k))
    placed = Placed(made, lower + upper, tmp_path)
    laws = [slope.interface_law(placed.built, i) for i in made.interfaces]
    assert [math.tan(law.frictionAngle) for law in laws] == pytest.approx([0.2, 0.6], rel=1e-12)
    assert [hasattr(law, "criticalSlip") for law in laws] == [False, True]
    for state in placed.states[:2]:
        state.blockedDOFs = "xyzXYZ"
    normal, down = np.array(made.normal), np.array(made.downslope)
    # where they touch, the frame leans
    n, t = (math.cos(lean) * one + math.sin(lean) * other for one, other in ((normal, -down), (down, normal)))
    for state in placed.states[2:]:
        state.vel = (*(2.0 * t), 0)
    start = np.array([tuple(s.pos)[:2] for s in placed.states])
    force = placed.forces()
    (found, surfaces), rows = placed.series.take(), placed.rows()
    for name, k, friction in (("first", 2, 0.2), ("second", 3, 0.6)):
        on_upper = force[k]
        told = [rows[name][f"{what}_N_per_m"] for what in ("normal", "shear", "normal_peak")]
        assert told == pytest.approx([on_upper @ normal, -(on_upper @ down), on_upper @ normal], rel=1e-6)
        assert -(on_upper @ t) == pytest.approx(friction * (on_upper @ n), rel=1e-6) and on_upper @ n > 0
    # the role of the first alone is that of a slip surface, and it lies above those of the plane, on which nothing lies
    # here
    assert set(surfaces) == {"upper", "lower", "first"} and found["slip"] == pytest.approx((0, 0, 0), abs=1e-9)
    assert surfaces["first"] == pytest.approx(
        [rows["first"][f"{w}_N_per_m"] for w in ("normal", "shear", "normal_peak")]
    )
    assert math.isnan(rows["first"]["slip_mean_m"])
    # both disks of the contact have slipped by what one of them has gone
    gone = (np.array(tuple(placed.states[3].pos)[:2]) - start[3]) @ t
    assert rows["second"]["slip_mean_m"] == pytest.approx(gone, rel=1e-6) and gone > 0
    assert placed.series.slip().counts is False  # that of the slip surfaces


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("way", [1, -1])
def test_an_obstacle_is_pushed_by_what_hits_it_alone(tmp_path, side, way):
    """A disk of the obstacle lies on another and is hit by one of the mass, from upslope or from below, in the air. Its
    own contacts do not count, nor does a wall's.
    """

    def house(data):
        vertices = [[17.0, 2.3764], [20.0, 2.4812], [20.0, 6.0], [17.0, 6.0]]
        data["layers"].append({"name": "house", "role": "obstacle", "material": "rock", "vertices": vertices})

    made = written(tmp_path, house, side)
    # below the plane, in front of the foot: on the ground, of 2° up
    ground = made.of_role("ground")[0].points
    placed = Placed(made, [(0, 50.0, 0.5, 2), (2, 50.0, 0.5, 2), (4, 50.0, 0.5, 0)], tmp_path)
    (ax, ay), (bx, by) = ground[np.argsort(side * ground[:, 0])][:2]
    slant = math.atan2(by - ay, side * (bx - ax))
    base = np.array([ax + side * 15.0, ay + 15.0 * math.tan(slant) + 0.5 / math.cos(slant)])
    below, top, hits = placed.states
    below.pos, top.pos = (*base, 0), (base[0], base[1] + 1.0, 0)
    hits.pos = (base[0] - way * side * math.cos(0.3), base[1] + 1.0 + math.sin(0.3), 0)
    hits.vel = (way * side * 3.0, 0.5, 0)
    force = placed.forces()[2]
    placed.series.take()
    told = placed.rows()["house"]
    assert way * side * force[0] < 0  # it was stopped
    assert told["normal_N_per_m"] == pytest.approx(-side * force[0], rel=1e-6)
    assert (
        told["shear_N_per_m"] == pytest.approx(force[1], rel=1e-6)
        and told["normal_peak_N_per_m"] == told["normal_N_per_m"]
    )
    assert math.isnan(told["slip_mean_m"]) and math.isnan(told["energy_sliding_J"])


@pytest.mark.parametrize("names", [("first",), ("first", "second")])
def test_interfaces_that_bear_the_mass_alone_are_its_slip_surface(tmp_path, names):
    """The plane is ground here: the sum of role slip is over the interfaces of that role."""

    def change(data):
        two_on_one(data)
        for wall in data["walls"][:2]:
            wall["role"] = "ground"
        for interface in data["interfaces"]:
            interface.pop("role", None)
            if interface["name"] in names:
                interface["role"] = "slip"

    made = written(tmp_path, change)
    assert [one.name for one in made.lowest_surfaces] == list(names)
    disks = [(6.0, 5.0, 0.5, 0), (20.0, 5.0, 0.5, 0), (6.0, 6.0, 0.5, 1), (20.0, 6.0, 0.5, 2)]
    placed = Placed(made, disks, tmp_path)
    for state in placed.states[:2]:
        state.blockedDOFs = "xyzXYZ"
    placed.push(0.0, 0.0, 2.0, 2.0)
    force = placed.forces()[2 : 2 + len(names)].sum(axis=0)
    found, _ = placed.series.take()
    normal, shear = force @ np.array(made.normal), -(force @ np.array(made.downslope))
    assert normal > 0 and shear > 0
    # of several the peaks are added too, each of the last step
    assert found["slip"] == pytest.approx((normal, shear, normal), rel=1e-6)
    assert found["ground"] == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_slip_is_that_of_the_disks_that_are_there(tmp_path):
    """Two that slide on one wall, past its critical slip and not so far; the farther one is taken out, and then both."""
    placed = Placed(written(tmp_path, weakening), ON_THE_WALLS, tmp_path)
    start = placed.along("pos")
    placed.push(1.0, 2.0, 0.5, 1.5)
    while O.time < 0.0395:
        O.step()
    gone = placed.along("pos") - start
    assert placed.series.slip("lower").weakened == 1 and placed.series.slip("lower").touched == 3
    placed.series.there = np.sort(placed.numbers[[0, 2, 3]])
    slip = placed.series.slip("lower")
    assert slip == (pytest.approx(gone[[0, 2]].mean(), rel=1e-6), 0, 2, True)
    assert placed.series.slip() == (pytest.approx(gone[[0, 2, 3]].mean(), rel=1e-6), 1, 3, True)
    placed.series.there = placed.numbers[[3]]
    assert placed.series.slip("lower") == (0.0, 0, 0, True)
