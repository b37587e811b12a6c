"""Every key of summary.json of a slope that does all, recomputed by hand from its records."""
import json
import math

import numpy as np
import pytest
from yade.nonsmooth import records
from yade.nonsmooth.measure import toe, toe_bands
from yade.nonsmooth.model import geometry


class Summary:
    """The keys of summary.json from the series, the snapshots and the section, by hand. Each method is a key's."""

    def __init__(self, whole, known):
        self.whole, self.known, self.section, self.state = whole, known, whole.section, whole.state
        self.all = whole.series
        self.rows = {name: values[self.all["stage"] > 0] for name, values in self.all.items()}
        self.begin, self.end = (records.read_snapshot(whole.folder / f"{name}.npz") for name in ("t0", "end"))
        self.times = self.times_s()

    def at(self, name, time, seconds):
        """Mean of a column over the rows of the seconds up to a time, of 0.02 s each, or of that row alone."""
        k = np.searchsorted(self.rows["time_s"], time - 1e-9)
        return self.rows[name][k + 1 - max(1, round(seconds / 0.02)) : k + 1].mean()

    # what was computed
    def disks(self):
        return 315

    def bonds_initial(self):
        """Close neighbours within a layer, and disks close to the backstop, in the packing: gaps of a twentieth of the
        mean diameter, or of the diameter.
        """
        made = self.known.watch
        x, y, r, layer = (*(self.known.before[name][0] for name in "xy"), made.r, self.begin.layer)
        i, j = np.triu_indices(len(r), 1)
        close = np.hypot(x[i] - x[j], y[i] - y[j]) - r[i] - r[j] <= 0.05 * (r[i] + r[j])
        (x0, y0), (x1, y1) = self.section.wall("FB").vertices
        size = math.hypot(x1 - x0, y1 - y0)
        along, off = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / size, (
            (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        ) / size
        return int((close & (layer[i] == layer[j])).sum()) + int(
            ((off - r <= 0.05 * 2 * r) & (along > 0) & (along < size)).sum()
        )

    def contacts_initial(self):
        rows = self.known.watch.begun
        return int(((rows[:, 2] != 0) | (rows[:, 7] <= 0)).sum())

    def packing_fraction(self):
        """Of the bulk: what is further than the largest diameter from the outline. Disks of a fine grid's points that
        are covered.
        """
        k, bulk = self.known.settled, self.section.outline.buffer(-2 * self.known.watch.r.max(), join_style=2)
        x, y, r = self.known.after["x"][k], self.known.after["y"][k], self.known.watch.r
        px, py = (v.ravel() for v in np.meshgrid(np.arange(-40, 3, 0.05), np.arange(-1, 22, 0.05)))
        inside = geometry.contains(bulk, px, py)
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

    def way_worst_rel(self):
        """Of every step. In a sound run no disk goes farther than its radius."""
        assert 0 < self.state["way_worst_ever"] < 1
        return self.state["way_worst_ever"]

    def overlap_mean_rel(self):
        return self.rows["overlap_mean_rel"].max()

    # times
    def times_s(self):
        s = self.rows
        t, (a, b) = s["time_s"], self.section.wall("DP").vertices
        t0, speed = self.state["t0"], s["speed_mean_m_per_s"]
        self.weakens = t[(s["weakened_disks"] >= 0.01 * math.dist(a, b) / math.sqrt(0.5 * 1.0)) & (t >= t0)][0]
        t2 = t[(speed >= 0.2 * math.sqrt(self.size())) & (t >= t0)][0]  # it does not stop again
        push = {now: self.at("fb_normal_N_per_m", now, 0.2) for now in t[(t > t0 + 0.2 - 1e-6) & (t < t2 + 1e-6)]}
        t1 = min(now for now, force in push.items() if force >= 0.98 * max(push.values()))
        t3 = min(
            now
            for now in t[t >= max(t2, self.weakens)]
            if self.at("dp_shear_N_per_m", now, 0.2) <= 0.1 * self.at("dp_shear_N_per_m", t2, 0.2)
        )
        fast = t[speed >= 0.03 * speed[t >= t2].max()]
        return {
            "t0": t0,
            "t1": t1,
            "t2": t2,
            "t3": t3,
            "t4": t[np.where(t >= t2, s["energy_kinetic_J"], 0).argmax()],
            "t5": t[t > fast[-1]][0],
        }

    def size(self):
        """Of the layers beside the shipped section's."""
        return math.sqrt(self.section.area / 78885.30336300003)

    def failed_dry_s(self):
        return None

    def moved_dry_s(self):
        return None

    def times_missing(self):
        return {}

    def verdict(self):
        return "failed by water"

    def verdict_says(self):
        return f"the slope failed by water, with the table at {self.water_at_failure_m():.4g} m; it began to move at {self.times['t2']:.1f} s"

    def water_at_failure_m(self):
        return self.at("water_m", self.times["t1"], 0)

    def fb_force_dry_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.times["t0"], 0.2)

    def fb_force_at_failure_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.times["t1"], 0.2)

    def fb_force_final_N_per_m(self):
        return self.at("fb_normal_N_per_m", self.rows["time_s"][-1], 0.4)

    def fb_force_highest_N_per_m(self):
        t = self.rows["time_s"]
        return max(
            self.at("fb_normal_N_per_m", now, 0.2)
            for now in t[(t > self.times["t0"] - 1e-6) & (t < self.times["t2"] + 1e-6)]
        )

    def bonds_broken_at_failure_rel(self):
        """The bonds that are told one by one."""
        header, *rows = (line.split(",") for line in (self.whole.folder / "breaks.csv").read_text().splitlines())
        when = header.index("time_s")
        return sum(float(row[when]) <= self.times["t1"] + 1e-9 for row in rows) / self.state["bonds_initial"]

    def dp_shear_dry_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.times["t0"], 0.2)

    def dp_shear_at_failure_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.times["t1"], 0.2)

    def dp_shear_final_N_per_m(self):
        return self.at("dp_shear_N_per_m", self.rows["time_s"][-1], 0.4)

    def water_highest_m(self):
        return self.at("water_m", self.times["t2"], 0)

    def force_stages(self):
        """Of means over the 0.2 s up to t0 to t3, to t5 and to the end; friction of DP is 0.45."""
        t = self.rows["time_s"]
        t0, t1, t2, t3, _, t5 = self.times.values()

        def at(name, when):
            return self.at(f"{name}_N_per_m", when, 0.2)

        def part(name, low, high):
            return self.rows[f"{name}_N_per_m"][(t > low) & (t < high + 1e-6)]

        rise = {
            name: at(name, t1) - at(name, t0)
            for name in ("dp_normal_total", "dp_shear", "dp_water", "fb_normal", "fb_shear")
        }
        push = [at("fb_normal", now) for now in t[(t > t1 - 1e-6) & (t < t2 + 1e-6)]]
        all_of_it = [at("fb_normal", now) for now in t[(t > t0 - 1e-6) & (t < t2 + 1e-6)]]
        most = max(all_of_it)
        speed = self.rows["speed_mean_m_per_s"][(t > t3 - 1e-6) & (t < t5 + 1e-6)]
        momentum = part("dp_normal_total", t3 - 1e-6, t5) * speed
        return {
            "normal_change": rise["dp_normal_total"] / at("dp_normal_total", t0),
            "normal_change_by_backstop": rise["fb_shear"] / rise["dp_normal_total"],
            "shear_drop": rise["dp_shear"] / (-0.45 * rise["dp_water"]),
            "shear_share": part("dp_shear", t0, t1).sum() / (0.45 * part("dp_normal_effective", t0, t1).sum()),
            "backstop_rise": -rise["fb_normal"] / rise["dp_shear"],
            "backstop_span": np.ptp(push) / push[0],
            "backstop_swing": (part("fb_normal_peak", t1 - 1e-6, t2) / part("fb_normal", t1 - 1e-6, t2)).max() - 1,
            "backstop_fall": 1 - min(all_of_it[all_of_it.index(most) :]) / most,
            "release_rise": at("dp_normal_effective", t3) / at("dp_normal_effective", t2),
            "normal_fall": at("dp_normal_total", t5) / at("dp_normal_total", t3),
            "backstop_momentum": np.corrcoef(part("fb_normal", t3 - 1e-6, t5), momentum)[0, 1],
            "shear_moving": part("dp_shear", t3 - 1e-6, t5).mean() / at("dp_shear", t0),
            "backstop_final": at("fb_normal", t[-1]) / at("fb_normal", t1),
            "shear_final": at("dp_shear", t[-1]) / at("dp_shear", t0),
        }

    def weakening_begins_s(self):
        return self.weakens

    def triggering_s(self):
        return self.times["t3"] - self.times["t2"]

    def weakening_s(self):
        return self.times["t3"] - self.weakens

    def motion_s(self):
        return self.times["t5"] - self.times["t3"]

    def t2_by_speed_s(self):
        """From the back: the last row before t4 that is slower, and the next."""
        t, speed = self.rows["time_s"], self.rows["speed_mean_m_per_s"]
        found = {}
        for percent in (50, 100, 200, 300, 400, 500):
            k = int(np.searchsorted(t, self.times["t4"] - 1e-9))
            while speed[k] >= percent / 100 * 0.2 * math.sqrt(self.size()):
                k -= 1
            found[f"{percent}"] = t[k + 1]
        return found

    def t5_by_speed_s(self):
        t, speed = self.rows["time_s"], self.rows["speed_mean_m_per_s"]
        last = {share: t[speed >= share * speed[t >= self.times["t2"]].max()][-1] for share in (0.02, 0.05, 0.1)}
        return {f"{100 * share:.0f}": t[t > when][0] if when < t[-1] else None for share, when in last.items()}

    def snapshot(self, name):
        """That of a time, by its step."""
        step = {t: s for t, s in zip(self.all["time_s"].tolist(), self.all["step"].astype(int).tolist())}
        return records.read_snapshot(self.whole.folder / "snapshots" / f"{step[self.times[name]]:08d}.npz")

    def toe_bands_triggering(self):
        return self.toe_bands(self.begin, self.snapshot("t2"))

    def toe_bands(self, before=None, after=None):
        """From the snapshots of t1 and t3; the rock's angle of friction is 35°, and the toe has too few disks to say
        that there are not two bands.
        """
        before, after = before or self.snapshot("t1"), after or self.snapshot("t3")
        found = [
            b
            and {
                "inclination_deg": b.inclination_deg,
                "width_d": b.width,
                "rotation_rad": b.rotation,
                "contrast": b.contrast,
            }
            for b in toe_bands.find(before, after, self.section)
        ]
        return {"towards_foot": found[0], "conjugate": found[1], "both_conjugate": None, "rankine_deg": 27.5}

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
        """Heights of the surface over the lowest wall in bins of three mean diameters, NaN where few disks are; and
        their width.
        """
        width, low = 6 * snapshot.r.mean(), (snapshot.x - snapshot.r).min()
        at, heights = ((snapshot.x - low) / width).astype(int), []
        number = np.bincount(at)
        for k in range(math.ceil(((snapshot.x + snapshot.r).max() - low) / width)):
            x = low + (k + 0.5) * width
            walls = [
                np.interp(x, *np.transpose(w.vertices))
                for w in self.section.walls
                if w.vertices[0][0] <= x <= w.vertices[-1][0]
            ]
            here = snapshot.y[at == k] + snapshot.r[at == k]
            heights.append(
                here.max() - min(walls) if len(here) >= 0.1 * number[number > 0].mean() and walls else math.nan
            )
        return np.array(heights), width

    def deposit_thickness_max_m(self):
        return np.nanmax(self.profile(self.end)[0])

    def deposit_thickness_ground_m(self):
        """Beyond the backstop, whose top is at 0.845 m."""
        height, width = self.profile(self.end)
        x = (self.end.x - self.end.r).min() + (np.arange(len(height)) + 0.5) * width
        return np.nanmax(height[x > 0.845])

    def travel(self):
        """Drop and run of the extreme points: a thousandth of the area may be ahead of the front, which no disk of 315
        is alone.
        """
        front = np.argmax(self.end.x)
        crown = np.argmax(self.begin.y + self.begin.r)
        top, foot = self.begin.y[crown] + self.begin.r[crown], self.end.y[front] - self.end.r[front]
        return top - foot, self.end.x[front] + self.end.r[front] - self.begin.x[crown]

    def travel_drop_m(self):
        return self.travel()[0]

    def travel_run_m(self):
        return self.travel()[1]

    def travel_angle_deg(self):
        return math.degrees(math.atan(self.travel()[0] / self.travel()[1]))

    def centroid_drop_m(self):
        weight = self.begin.r**2
        return float(np.sum(weight * (self.begin.y - self.end.y)) / np.sum(weight))

    def centroid_run_m(self):
        weight = self.begin.r**2
        return float(np.sum(weight * (self.end.x - self.begin.x)) / np.sum(weight))

    def centroid_angle_deg(self):
        return math.degrees(math.atan(self.centroid_drop_m() / self.centroid_run_m()))

    def mixing(self):
        """All pairs, one by one."""
        layer, shares = self.begin.layer, []
        i, j = np.triu_indices(len(layer), 1)
        for s in (self.begin, self.end):
            near = np.hypot(s.x[i] - s.x[j], s.y[i] - s.y[j]) - s.r[i] - s.r[j] <= 0.25 * 2 * s.r.mean()
            shares.append((layer[i] != layer[j])[near].mean())
        lower = (layer == 0).mean()
        return (shares[1] - shares[0]) / (2 * lower * (1 - lower) - shares[0])

    def overturned_m(self):
        """Cell by cell."""
        s, size, columns = self.end, 6 * self.end.r.mean(), set()
        cells = {}
        for x, y, layer in zip(s.x, s.y, s.layer):
            cells.setdefault((math.floor(x / size), math.floor(y / size)), []).append(layer)
        mean = {cell: np.mean(found) for cell, found in cells.items() if len(found) >= 4}
        for (column, row), lower in mean.items():
            if mean.get((column, row + 1), lower) <= lower - 0.5:
                columns.add(column)
        return size * len(columns)

    def bulking_factor(self):
        (end, width), (begin, was) = self.profile(self.end), self.profile(self.begin)
        return np.nansum(end) * width / (np.nansum(begin) * was)

    # energies
    def energy_losses_J_per_m(self):
        return {
            name.split("_")[1]: self.rows[name][-1]
            for name in ("energy_sliding_J", "energy_rolling_J", "energy_impact_J", "energy_bonds_J")
        }

    def sliding_on_walls_J_per_m(self):
        header, *rows = (line.split(",") for line in (self.whole.folder / "walls.csv").read_text().splitlines())
        names, slid = (header.index(name) for name in ("wall", "energy_sliding_J"))
        return {row[names]: float(row[slid]) for row in rows[-3:]}  # DP, FB and SS of the last time

    def heat_on_walls_J_per_m(self):
        return {}  # no wall of it has a slip law

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


#: Where a key's value is recomputed less exactly: how much less, relative. ``wall_s`` is a clock's, ``section`` and
#: ``finished`` stand in tests of their own.
# points of a grid, 0.05 m apart; sums over thousands of steps
ROUGH = {"packing_fraction": 2e-3, "energy_error_rel": 1e-6}
OTHERWISE = {"section", "finished", "wall_s"}


@pytest.fixture(scope="module")
def summary(whole, known):
    return Summary(whole, known)


def test_every_key_of_the_summary_is_recomputed(whole):
    assert {name for name in vars(Summary) if name in whole.summary} | OTHERWISE == set(whole.summary)
    assert whole.summary == json.loads((whole.folder / "summary.json").read_text())
    assert (
        whole.summary["section"] == "small slope"
        and whole.summary["wall_s"] >= whole.state["wall_steps_s"] > whole.state["wall_moving_s"] > 0
    )
    assert whole.state["moving_s"] == pytest.approx(whole.series["time_s"][-1] - whole.state["moving"], abs=1e-9)


@pytest.mark.parametrize(
    "name",
    [
        name
        for name in vars(Summary)
        if not name.startswith("_") and name not in ("at", "profile", "snapshot", "travel", "turned", "toe", "size")
    ],
)
def test_a_key_of_the_summary_is_what_the_records_say(whole, summary, name):
    expected = getattr(summary, name)()
    if expected is None or isinstance(expected, dict):
        assert whole.summary[name] == (expected and pytest.approx(expected, rel=1e-9))
    else:
        assert whole.summary[name] == pytest.approx(expected, rel=ROUGH.get(name, 1e-9))
