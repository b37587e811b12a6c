"""A slope from its first step to its rest within seconds: what it does and when, every column of its series and every key of its summary, recomputed by hand."""
import json
import math

import numpy as np
import pytest
from yade.nonsmooth import contact, records, scales, toe
from yade.nonsmooth.verification import sweep_methods

MEAN = 10  # rows over which characteristic times average: 0.2 s in rows of 0.02 s


# ---- what it does ---------------------------------------------------------------------------------

def test_it_settles_gets_wet_fails_weakens_moves_and_rests(whole):
    s, times = whole.series, whole.summary["times_s"]
    assert whole.summary["finished"] is True and whole.state["stage"] == "done" and whole.state["failed_dry"] is None
    assert None not in times.values() and times["t0"] < times["t1"] <= times["t2"] < times["t3"] < times["t4"] < times["t5"]
    assert set(s["stage"]) == {0, 1, 2} and (np.diff(s["stage"]) >= 0).all()
    for name, least in (("wet_disks", 50), ("released_disks", 50), ("weakened_disks", 10), ("speed_max_m_per_s", 3.0), ("water_m", 0.5), ("slip_mean_dp_m", 0.5)):
        assert s[name].max() > least, name
    assert np.abs(s["ss_normal_N_per_m"]).max() > 1e4 and np.abs(s["fb_normal_N_per_m"]).max() > 1e4 and s["dp_water_N_per_m"].max() > 1e5
    for mode in ("tension", "shear", "torque", "mixed"):
        assert s[f"bonds_broken_{mode}"][-1] > 0, mode
    assert s["speed_mean_m_per_s"][-1] < 0.03 * s["speed_mean_m_per_s"].max()
    steps = np.diff(s["step"])
    assert set(steps[s["stage"][1:] < 2]) == {4} and steps.max() > 4  # rows of 0.02 s, steps of 5 ms and shorter ones where disks are fast


# ---- every column of the series -------------------------------------------------------------------

class Known:
    """What the rows of the series follow from: the steps by hand, cut into rows. Each method is a column's."""

    def __init__(self, whole):
        self.section, self.state, self.watch, self.series = whole.section, whole.state, whole.watch, whole.series
        self.steps, self.folder = whole.watch.steps, whole.folder
        self.last = np.searchsorted(self.steps.iter, self.series["step"])  # each row's last step
        self.first = np.r_[2, self.last[:-1] + 1]  # two steps without gravity come before the first row
        self.before, self.after = (dict(zip(self.watch.BODY, np.moveaxis(part, 1, 0))) for part in (self.steps.before, self.steps.after))
        self.settled = int(np.searchsorted(self.steps.time, self.state["settled"]))  # the last step of the settling
        self.table = {name: [rows[:, k] for rows in self.watch.rows] for k, name in enumerate(("i", "j", "normal"))}
        self.breaks = records.read_breaks(whole.folder / "breaks.csv")

    def since_settled(self, per_step):
        """Sums over the steps since the settling, at each row; while settling those since the begin."""
        total = np.cumsum(per_step, axis=0)
        return np.where(self.series["stage"] > 0, total[self.last] - total[self.settled], total[self.last])

    def mean(self, per_step):
        return np.array([np.average(per_step[a:b + 1], weights=self.steps.dt[a:b + 1]) for a, b in zip(self.first, self.last)])

    def peak(self, per_step):
        return np.array([per_step[a:b + 1].max() for a, b in zip(self.first, self.last)])

    # time and stage
    def time_s(self):
        return np.cumsum(self.steps.dt)[self.last]

    def step(self):
        """The first steps that end at, or less than half a step before, whole multiples of 0.02 s."""
        rows = np.floor((self.steps.time + 0.5 * self.steps.dt) / 0.02 + 1e-9)
        return self.steps.iter[np.flatnonzero(np.diff(rows, prepend=0) > 0)]

    def stage(self):
        return 1 * (self.series["time_s"] > self.state["settled"]) + 1 * (self.series["time_s"] > self.state["t0"])

    # water
    def heights(self):
        """1.5 m/s from t0 on, at the begin of each step, until the slope moves."""
        begin = self.steps.time - self.steps.dt
        return np.where(begin < self.state["moving"] - 1e-9, 1.5 * np.clip(begin - self.state["t0"], 0, None), self.state["water_hold"])

    def water_m(self):
        return self.heights()[self.last]

    def released(self):
        x, y = self.before["x"], self.before["y"]
        down = np.array(self.section.downslope)
        way = (x - x[self.settled + 1]) * down[0] + (y - y[self.settled + 1]) * down[1]
        way[:self.settled + 1] = 0
        return np.maximum.accumulate(way > 3.0, axis=0)

    def wet(self):
        n = self.section.normal
        h = self.heights()[:, None]
        return (self.before["x"] * n[0] + self.before["y"] * n[1] < h) & (h > 0) & ~self.released()

    def lift(self):
        """Force [N/m] of the water on each disk along the plane's normal: γ_w cos β on its share of the bulk."""
        return self.wet() * 9810 * math.cos(math.radians(self.section.dip)) * math.pi * self.watch.r**2 / 0.82

    def wet_disks(self):
        return self.wet().sum(1)[self.last]

    def released_disks(self):
        return self.released().sum(1)[self.last]

    def dp_water_N_per_m(self):
        return self.lift().sum(1)[self.last]

    # walls
    def dp_normal_effective_N_per_m(self):
        return self.mean(self.watch.on_walls("DP")[0])

    def dp_normal_total_N_per_m(self):
        return self.dp_normal_effective_N_per_m() + self.dp_water_N_per_m()

    def dp_shear_N_per_m(self):
        return self.mean(self.watch.on_walls("DP")[1])

    def fb_normal_N_per_m(self):
        return self.mean(self.watch.on_walls("FB")[0])

    def fb_shear_N_per_m(self):
        return self.mean(self.watch.on_walls("FB")[1])

    def ss_normal_N_per_m(self):
        return self.mean(self.watch.on_walls("SS")[0])

    def ss_shear_N_per_m(self):
        return self.mean(self.watch.on_walls("SS")[1])

    def dp_normal_peak_N_per_m(self):
        return self.peak(self.watch.on_walls("DP")[0])

    def fb_normal_peak_N_per_m(self):
        return self.peak(self.watch.on_walls("FB")[0])

    def ss_normal_peak_N_per_m(self):
        return self.peak(self.watch.on_walls("SS")[0])

    # motion
    def speeds(self):
        return np.hypot(self.after["vx"], self.after["vy"])[self.last]

    def speed_mean_m_per_s(self):
        return self.speeds().mean(1)

    def speed_max_m_per_s(self):
        return self.speeds().max(1)

    def front_m(self):
        """The first disk from the right that, with those before it, is more than a thousandth of the area."""
        found = []
        for x in self.after["x"][self.last]:
            order = np.argsort(-x)
            ahead = np.cumsum(self.watch.r[order] ** 2)
            k = order[np.flatnonzero(ahead > 1e-3 * ahead[-1])[0]]
            found.append(x[k] + self.watch.r[k])
        return np.array(found)

    def centroid_x_m(self):
        return np.average(self.before["x"][self.last], axis=1, weights=self.watch.mass)

    def centroid_y_m(self):
        return np.average(self.before["y"][self.last], axis=1, weights=self.watch.mass)

    # bonds and contacts
    def bonds_alive(self):
        return np.array([int((rows[:, 8] > 0).sum()) for rows in self.watch.rows])

    def broken(self, mode):
        return np.searchsorted(np.sort(self.breaks["step"][self.breaks["mode"] == mode]), self.series["step"], side="right")

    def bonds_broken_tension(self):
        return self.broken("tension")

    def bonds_broken_shear(self):
        return self.broken("shear")

    def bonds_broken_torque(self):
        return self.broken("torque")

    def bonds_broken_mixed(self):
        return self.broken("mixed")

    def touching(self):
        return [(rows[:, 2] != 0) | (rows[:, 7] <= 0) for rows in self.watch.rows]

    def contacts(self):
        return np.array([int(t.sum()) for t in self.touching()])

    def overlaps(self):
        """Overlap by mean diameter, or by the diameter at a wall, of all contacts of each row."""
        r, found = np.r_[np.zeros(self.watch.first), self.watch.r], []
        for rows in self.watch.rows:
            i, j = rows[:, :2].astype(int).T
            found.append(np.maximum(-rows[:, 7], 0) / np.where(r[i] > 0, r[i] + r[j], 2 * r[j]))
        return found

    def overlap_worst_rel(self):
        return np.array([o.max() for o in self.overlaps()])

    def overlap_mean_rel(self):
        return np.array([o.sum() / t.sum() for o, t in zip(self.overlaps(), self.touching())])

    def slips(self):
        slip = np.cumsum(self.steps.slip, axis=0)
        slip[self.settled + 1:] -= slip[self.settled]
        return slip[self.last]

    def slip_mean_dp_m(self):
        slip = self.slips()
        return slip.sum(1) / np.maximum((slip > 0).sum(1), 1)

    def weakened_disks(self):
        return (self.slips() >= 0.5).sum(1)

    # energies
    def energy_kinetic_J(self):
        return self.watch.kinetic("before")[self.last]

    def energy_potential_J(self):
        return self.watch.potential("before")[self.last]

    def works(self):
        """Of the water in each step: its forces times the mean velocities."""
        n, v = self.section.normal, (self.before, self.after)
        return self.steps.dt * (0.5 * self.lift() * sum(part["vx"] * n[0] + part["vy"] * n[1] for part in v)).sum(1)

    def energy_water_J(self):
        return self.since_settled(self.works())

    def energy_walls_J(self):
        """They stand."""
        return np.zeros(len(self.last))

    def energy_sliding_J(self):
        return self.since_settled(self.steps.losses[:, 0])

    def energy_rolling_J(self):
        return self.since_settled(self.steps.losses[:, 1])

    def energy_impact_J(self):
        return self.since_settled(self.steps.losses[:, 2])

    def energy_bonds_J(self):
        return self.since_settled(self.steps.losses[:, 3])

    def parabolas(self):
        """What each step's balance misses, −h/2 M g·ΔV: it moves disks with the velocity at its end, not with the mean one."""
        gain = [(self.watch.mass * (self.after[v] - self.before[v])).sum(1) for v in ("vx", "vy")]
        return -0.5 * self.steps.dt * (gain[0] * self.steps.gravity[:, 0] + gain[1] * self.steps.gravity[:, 1])

    def energy_correction_J(self):
        """What the sum of all others leaves over."""
        energy = [self.watch.kinetic(at) + self.watch.potential(at) for at in ("before", "after")]
        return self.since_settled(energy[1] - energy[0] - self.works() + self.steps.losses.sum(1) - self.parabolas())

    def energy_error_rel(self):
        """At the begin of the row's last step, of the energy turned over until its end."""
        error = self.since_settled(self.parabolas()) - self.parabolas()[self.last]
        turned = self.since_settled(self.steps.losses.sum(1)) + self.energy_kinetic_J() + np.abs(self.energy_water_J())
        return np.where(self.series["stage"] > 0, error / turned, 0)

    # the solver
    def tolerance(self):
        """The section's, a quarter of it where nothing has moved for 1.06 s, more while the slope flows."""
        s, found, last, fastest = self.series, [], 1e-4, 0.0
        for k in range(len(s["step"])):
            found.append(last)
            if s["stage"][k] == 2:
                fastest = max(fastest, s["speed_mean_m_per_s"][k])
                moves = s["time_s"][k] >= self.state["moving"] - 1e-9
                last = max(1e-4, 2e-3 * min(1, s["speed_mean_m_per_s"][k] / (0.1 * fastest)) * moves)
        return np.array(found)

    def iterations(self):
        """Looks are one in ten sweeps; at the last one the residual is below the tolerance, or 200 sweeps are done."""
        s = self.series
        done = (s["residual"] <= s["tolerance"]) | (s["iterations"] >= 200)
        return np.where(done & (s["iterations"] % 10 == 0), s["iterations"], -1)

    def dumped(self, figure):
        """A column of the solver from its contact problems, where they were kept; elsewhere as it is."""
        found = np.array(figure, float)
        for row, path in self.watch.dumps:
            problem = contact.load(path)
            sweeps = sweep_methods.Sweeps(problem)
            relative = sweeps.residual(problem.impulse, sweeps.velocities(problem.impulse))
            force = relative * np.sqrt(((problem.impulse * sweeps.units) ** 2).sum() / len(problem.length)) / problem.time_step
            found[row] = relative if figure is self.series["residual"] else force
        return found

    def residual(self):
        return self.dumped(self.series["residual"])

    def residual_N_per_m(self):
        return self.dumped(self.series["residual_N_per_m"])


#: Relative to the column's largest value; where not rounding of sums over thousands of steps, the reason stands beside.
CLOSE = {
    "slip_mean_dp_m": 1e-3, "energy_water_J": 1e-4, "energy_sliding_J": 1e-3, "energy_rolling_J": 1e-3, "energy_impact_J": 1e-3, "energy_bonds_J": 1e-3,
    "energy_correction_J": 0.05,  # disks that are turned back (ContactSeamCorrect) have two velocities at a step's end, of which the table has the second
    "residual": 1e-6, "residual_N_per_m": 1e-6,  # velocities are computed anew, in another order of contacts
}


@pytest.fixture(scope="module")
def known(whole):
    return Known(whole)


def test_every_column_is_recomputed(whole):
    assert set(whole.series) == set(records.COLUMNS) == {name for name in vars(Known) if name in records.COLUMNS}


@pytest.mark.parametrize("name", records.COLUMNS)
def test_a_column_is_what_the_steps_say(known, name):
    found, expected = known.series[name], getattr(known, name)()
    if records.COLUMNS[name].integer:
        assert np.array_equal(found, expected), np.flatnonzero(found != expected)[:5]
    else:
        assert np.abs(found - expected).max() <= CLOSE.get(name, 1e-9) * np.abs(expected).max(), np.argmax(np.abs(found - expected))


# ---- every key of the summary ---------------------------------------------------------------------

class Summary:
    """The keys of summary.json from the series, the snapshots and the section, by hand. Each method is a key's."""

    def __init__(self, whole, known):
        self.whole, self.known, self.section, self.state = whole, known, whole.section, whole.state
        self.all = whole.series
        self.rows = {name: values[self.all["stage"] > 0] for name, values in self.all.items()}
        self.begin, self.end = (records.read_snapshot(whole.folder / f"{name}.npz") for name in ("t0", "end"))
        self.times = self.times_s()

    def at(self, name, time, seconds):
        """Mean of a column over the seconds up to a time, both ends included."""
        t = self.rows["time_s"]
        return self.rows[name][(t > time - seconds - 1e-6) & (t < time + 1e-6)].mean()

    # what was computed
    def disks(self):
        return 321

    def bonds_initial(self):
        """Close neighbours within a layer, and disks close to the backstop, in the packing: gaps of a twentieth of the mean diameter, or of the diameter."""
        made = self.known.watch
        x, y, r, layer = (*(self.known.before[name][0] for name in "xy"), made.r, self.begin.layer)
        i, j = np.triu_indices(len(r), 1)
        close = np.hypot(x[i] - x[j], y[i] - y[j]) - r[i] - r[j] <= 0.05 * (r[i] + r[j])
        (x0, y0), (x1, y1) = self.section.wall("FB").vertices
        size = math.hypot(x1 - x0, y1 - y0)
        along, off = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / size, ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / size
        return int((close & (layer[i] == layer[j])).sum()) + int(((off - r <= 0.05 * 2 * r) & (along > 0) & (along < size)).sum())

    def contacts_initial(self):
        rows = self.known.watch.begun
        return int(((rows[:, 2] != 0) | (rows[:, 7] <= 0)).sum())

    def packing_fraction(self):
        """Of the bulk: what is further than the largest diameter from the outline. Disks of a fine grid's points that are covered."""
        k, bulk = self.known.settled, self.section.outline.buffer(-2 * self.known.watch.r.max(), join_style=2)
        x, y, r = self.known.after["x"][k], self.known.after["y"][k], self.known.watch.r
        px, py = (v.ravel() for v in np.meshgrid(np.arange(-40, 3, 0.05), np.arange(-1, 22, 0.05)))
        from shapely import contains_xy

        inside = contains_xy(bulk, px, py)
        px, py = px[inside], py[inside]
        covered = np.zeros(len(px), bool)
        for a, b, c in zip(x, y, r):
            covered |= (px - a) ** 2 + (py - b) ** 2 < c**2
        return covered.mean()

    def time_step_s(self):
        return 5e-3

    def path_rel(self):
        return 0.02

    def steps(self):
        return self.all["step"][-1] - 1

    def simulated_s(self):
        return self.all["time_s"][-1] - self.state["settled"]

    def wall_packing_s(self):
        return 0.0

    def threads(self):
        return 2

    # the solver
    def iterations_mean(self):
        return self.rows["iterations"].mean()

    def tolerance(self):
        return 1e-4

    def tolerance_moving(self):
        return 2e-3

    def residual_p95(self):
        return np.percentile(self.rows["residual"], 95)

    def residual_N_per_m_p95(self):
        return np.percentile(self.rows["residual_N_per_m"], 95)

    def residual_p95_over_tolerance(self):
        return np.percentile(self.rows["residual"] / self.rows["tolerance"], 95)

    def overlap_worst_rel(self):
        """Of every step, and no less than that of the rows."""
        assert self.state["overlap_worst_ever"] >= self.all["overlap_worst_rel"].max()
        return self.state["overlap_worst_ever"]

    def overlap_mean_rel(self):
        return self.rows["overlap_mean_rel"].max()

    # times
    def times_s(self):
        s = self.rows
        t, (a, b) = s["time_s"], self.section.wall("DP").vertices
        t0 = self.state["t0"]
        t2 = t[(s["weakened_disks"] >= 0.01 * math.dist(a, b) / math.sqrt(0.5 * 1.0)) & (t >= t0)][0]
        push = {now: self.at("fb_normal_N_per_m", now, 0.2) for now in t[(t > t0 + 0.2 - 1e-6) & (t < t2 + 1e-6)]}
        t1 = min(now for now, force in push.items() if force >= 0.98 * max(push.values()))
        t3 = min(now for now in t[t >= t2] if self.at("dp_shear_N_per_m", now, 0.2) <= 0.1 * self.at("dp_shear_N_per_m", t2, 0.2))
        fast = t[s["speed_mean_m_per_s"] >= 0.03 * s["speed_mean_m_per_s"].max()]
        return {"t0": t0, "t1": t1, "t2": t2, "t3": t3, "t4": t[s["energy_kinetic_J"].argmax()], "t5": t[t > fast[-1]][0]}

    def failed_dry_s(self):
        return None

    def water_at_failure_m(self):
        return self.at("water_m", self.times["t1"], 0)

    def fb_force_dry_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.times["t0"], 0.2)

    def fb_force_at_failure_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.times["t1"], 0.2)

    def fb_force_final_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.rows["time_s"][-1], 0.4)

    def dp_shear_dry_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.times["t0"], 0.2)

    def dp_shear_at_failure_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.times["t1"], 0.2)

    def dp_shear_final_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.rows["time_s"][-1], 0.4)

    def fb_rise_over_dp_drop(self):
        return (self.fb_force_at_failure_N_per_m() - self.fb_force_dry_N_per_m()) / (self.dp_shear_dry_N_per_m() - self.dp_shear_at_failure_N_per_m())

    def triggering_s(self):
        return self.times["t3"] - self.times["t2"]

    def motion_s(self):
        return self.times["t5"] - self.times["t3"]

    # the motion and the deposit
    def front_travel_m(self):
        front = self.rows["front_m"]
        return front[-1] - front[np.searchsorted(self.rows["time_s"], self.times["t0"] - 1e-9)]

    def centroid_travel_m(self):
        k = np.searchsorted(self.rows["time_s"], self.times["t0"] - 1e-9)
        return math.dist(*((self.rows["centroid_x_m"][at], self.rows["centroid_y_m"][at]) for at in (k, -1)))

    def speed_max_m_per_s(self):
        return self.rows["speed_max_m_per_s"].max()

    def speed_mean_max_m_per_s(self):
        return self.rows["speed_mean_m_per_s"].max()

    def profile(self, snapshot):
        """Heights of the surface over the lowest wall in bins of three mean diameters, NaN where few disks are; and their width."""
        width, low = 6 * snapshot.r.mean(), (snapshot.x - snapshot.r).min()
        at, heights = ((snapshot.x - low) / width).astype(int), []
        number = np.bincount(at)
        for k in range(math.ceil(((snapshot.x + snapshot.r).max() - low) / width)):
            x = low + (k + 0.5) * width
            walls = [np.interp(x, *np.transpose(w.vertices)) for w in self.section.walls if w.vertices[0][0] <= x <= w.vertices[-1][0]]
            here = snapshot.y[at == k] + snapshot.r[at == k]
            heights.append(here.max() - min(walls) if len(here) >= 0.1 * number[number > 0].mean() and walls else math.nan)
        return np.array(heights), width

    def deposit_thickness_max_m(self):
        return np.nanmax(self.profile(self.end)[0])

    def bulking_factor(self):
        (end, width), (begin, was) = self.profile(self.end), self.profile(self.begin)
        return np.nansum(end) * width / (np.nansum(begin) * was)

    # energies
    def energy_losses_J_per_m(self):
        return {name.split("_")[1]: self.rows[name][-1] for name in ("energy_sliding_J", "energy_rolling_J", "energy_impact_J", "energy_bonds_J")}

    def energy_dissipated_J_per_m(self):
        return sum(self.energy_losses_J_per_m().values())

    def turned(self):
        return max(self.energy_dissipated_J_per_m(), self.rows["energy_kinetic_J"].max())

    def energy_correction_rel(self):
        return self.rows["energy_correction_J"][-1] / self.turned()

    def energy_error_rel(self):
        error = self.known.since_settled(self.known.parabolas()) - self.known.parabolas()[self.known.last]
        return np.abs(error[self.all["stage"] > 0]).max() / self.turned()

    # the toe
    def toe(self):
        return toe.passive(self.section, 10e3, 35.0, self.state["packing_fraction"])

    def water_passive_m(self):
        return self.toe().water_m

    def water_at_failure_over_passive(self):
        return self.water_at_failure_m() / self.toe().water_m

    def passive_resistance_dry_N_per_m(self):
        return self.toe().resistance_dry

    def passive_force_N_per_m(self):
        return self.toe().push_N_per_m

    def fb_force_at_failure_over_passive(self):
        return self.fb_force_at_failure_N_per_m() / self.toe().push_N_per_m


#: Where a key's value is recomputed less exactly: how much less, relative. ``wall_s`` is a clock's, ``section`` and ``finished`` stand in tests of their own.
ROUGH = {"packing_fraction": 2e-3, "energy_error_rel": 1e-6}  # points of a grid, 0.05 m apart; sums over thousands of steps
OTHERWISE = {"section", "finished", "wall_s"}


@pytest.fixture(scope="module")
def summary(whole, known):
    return Summary(whole, known)


def test_every_key_of_the_summary_is_recomputed(whole):
    assert {name for name in vars(Summary) if name in whole.summary} | OTHERWISE == set(whole.summary)
    assert whole.summary == json.loads((whole.folder / "summary.json").read_text())
    assert whole.summary["section"] == "small slope" and whole.summary["wall_s"] >= whole.state["wall_steps_s"] > whole.state["wall_moving_s"] > 0
    assert whole.state["moving_s"] == pytest.approx(whole.series["time_s"][-1] - whole.state["moving"], abs=1e-9)


@pytest.mark.parametrize("name", [name for name in vars(Summary) if not name.startswith("_") and name not in ("at", "profile", "turned", "toe")])
def test_a_key_of_the_summary_is_what_the_records_say(whole, summary, name):
    expected = getattr(summary, name)()
    if expected is None or isinstance(expected, dict):
        assert whole.summary[name] == (expected and pytest.approx(expected, rel=1e-9))
    else:
        assert whole.summary[name] == pytest.approx(expected, rel=ROUGH.get(name, 1e-9))
