"""The series of a watched slope recomputed from its steps by hand."""
import math

import numpy as np
from yade.nonsmooth import contact, records
from yade.nonsmooth.judges.verification import sweep_methods


class Known:
    """What the rows of the series follow from: the steps by hand, cut into rows. Each method is a column's."""

    def __init__(self, whole):
        self.section, self.state, self.watch, self.series = whole.section, whole.state, whole.watch, whole.series
        self.steps, self.folder = whole.watch.steps, whole.folder
        self.last = np.searchsorted(self.steps.iter, self.series["step"])  # each row's last step
        self.first = np.r_[2, self.last[:-1] + 1]  # two steps without gravity come before the first row
        self.before, self.after = (
            dict(zip(self.watch.BODY, np.moveaxis(part, 1, 0))) for part in (self.steps.before, self.steps.after)
        )
        self.settled = int(np.searchsorted(self.steps.time, self.state["settled"]))  # the last step of the settling
        self.table = {name: [rows[:, k] for rows in self.watch.rows] for k, name in enumerate(("i", "j", "normal"))}
        self.breaks = records.read_breaks(whole.folder / "breaks.csv")

    def since_settled(self, per_step):
        """Sums over the steps since the settling, at each row; while settling those since the begin."""
        total = np.cumsum(per_step, axis=0)
        return np.where(self.series["stage"] > 0, total[self.last] - total[self.settled], total[self.last])

    def mean(self, per_step):
        return np.array(
            [np.average(per_step[a : b + 1], weights=self.steps.dt[a : b + 1]) for a, b in zip(self.first, self.last)]
        )

    def peak(self, per_step):
        return np.array([per_step[a : b + 1].max() for a, b in zip(self.first, self.last)])

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
        return np.where(
            begin < self.state["moving"] - 1e-9,
            1.5 * np.clip(begin - self.state["t0"], 0, None),
            self.state["water_hold"],
        )

    def water_m(self):
        return self.heights()[self.last]

    def moved(self):
        """Whether each disk has gone further than the 3 m of the section's release_distance."""
        x, y = self.before["x"], self.before["y"]
        down = np.array(self.section.downslope)
        way = (x - x[self.settled + 1]) * down[0] + (y - y[self.settled + 1]) * down[1]
        way[: self.settled + 1] = 0
        return np.maximum.accumulate(way > 3.0, axis=0)

    def wet(self):
        n = self.section.normal
        h = self.heights()[:, None]
        return (self.before["x"] * n[0] + self.before["y"] * n[1] < h) & (h > 0) & ~self.moved()

    def ever_wet(self):
        return np.maximum.accumulate(self.wet(), axis=0)

    def released(self):
        return self.moved() & self.ever_wet()

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
        """A break is listed with the number of steps made before its own."""
        return np.searchsorted(
            np.sort(self.breaks["step"][self.breaks["mode"] == mode]), self.series["step"], side="left"
        )

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
        slip[self.settled + 1 :] -= slip[self.settled]
        return slip[self.last]

    def slip_mean_dp_m(self):
        slip = self.slips()
        return slip.sum(1) / np.maximum((slip > 0).sum(1), 1)

    def weakened(self):
        return self.slips() >= 0.5

    def weakened_disks(self):
        return self.weakened().sum(1)

    # energies
    def energy_kinetic_J(self):
        return self.watch.kinetic("before")[self.last]

    def energy_potential_J(self):
        return self.watch.potential("before")[self.last]

    def works(self):
        """Of the water in each step: its forces times the mean velocities."""
        n = self.section.normal
        vx, vy = (self.before[v] + self.steps.solved[:, k] for k, v in enumerate(("vx", "vy")))
        return self.steps.dt * (0.5 * self.lift() * (vx * n[0] + vy * n[1])).sum(1)

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
        """What each step's balance misses, −h/2 M g·ΔV: it moves disks with the velocity at its end, not with the mean
        one.
        """
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
            force = (
                relative
                * np.sqrt(((problem.impulse * sweeps.units) ** 2).sum() / len(problem.length))
                / problem.time_step
            )
            found[row] = relative if figure is self.series["residual"] else force
        return found

    def residual(self):
        return self.dumped(self.series["residual"])

    def residual_N_per_m(self):
        return self.dumped(self.series["residual_N_per_m"])
