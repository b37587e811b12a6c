"""A quantity of the same samples for several values of one number, such as the time step: changes from the finest
value, scatter, and panels that show them.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ...figures import style
from ...measure.statistics import standard_error


@dataclasses.dataclass
class Sweep:
    """A quantity of the same samples for several values of one number; ``values``: {value: {seed: quantity}}."""

    varied: str  # in words
    unit: str
    default: float
    values: dict

    @classmethod
    def of(cls, cases, found, key, quantity, default, **fixed):
        """From the cases in which all but ``key`` have the values in ``fixed``; cases without the quantity (None) are
        left out.
        """
        values = {}
        for case, result in zip(cases, found):
            if all(case[name] == value for name, value in fixed.items()) and result[quantity] is not None:
                values.setdefault(case[key], {})[case["seed"]] = result[quantity]
        return cls(*AXES[key], default, dict(sorted(values.items())))

    @property
    def finest(self):
        """The smallest of the values."""
        return min(self.values)

    def change(self, value, reference):
        """Change from ``reference`` to ``value`` of the same seeds over the mean of the reference's: (mean, its
        standard error; NaN for one seed).
        """
        a, b = self.values[value], self.values[reference]
        common = [seed for seed in a if seed in b]
        changes, mean = [a[seed] - b[seed] for seed in common], np.mean([b[seed] for seed in common])
        return float(np.mean(changes) / mean), float(standard_error(changes) / mean)

    def largest_step(self):
        """Largest mean change from one value to the next finer one, of values up to ten times the default."""
        order = [value for value in sorted(self.values) if value <= 10 * (1 + 1e-9) * self.default]
        return max((self.change(b, a) for a, b in zip(order, order[1:])), key=lambda change: abs(change[0]))

    def scatter(self):
        """Standard deviation over seeds at the default, relative to the mean; NaN for one seed."""
        at = list(self.values[self.default].values())
        return float(np.std(at, ddof=1) / np.mean(at)) if len(at) > 1 else math.nan

    def draw(self, ax, scale, relative):
        """Every seed as a thin line, the mean with its standard error as a thick one; the default as a dashed vertical.

        ``relative``: changes from the finest value in per cent of its mean (see :meth:`change`) instead of the quantity
        times ``scale``.
        """
        order, points = sorted(self.values), {}
        for v in order:
            for seed, x in self.values[v].items():
                points.setdefault(seed, {})[v] = x * scale
        if relative:
            points = {seed: line for seed, line in points.items() if self.finest in line}
            mean = np.mean([line[self.finest] for line in points.values()])
            points = {
                seed: {v: 100 * (x - line[self.finest]) / mean for v, x in line.items()}
                for seed, line in points.items()
            }
        for line in points.values():
            ax.plot(line.keys(), line.values(), color="#0072B2", lw=0.8, alpha=0.5)
        columns = [[line[v] for line in points.values() if v in line] for v in order]
        ax.errorbar(
            order,
            [np.mean(c) for c in columns],
            [np.nan_to_num(standard_error(c)) for c in columns],
            fmt="o-",
            color="#0072B2",
            lw=1.8,
            ms=4.5,
            capsize=3,
        )
        ax.axvline(self.default, color="#777777", lw=1, ls=(0, (4, 3)))
        ax.set(xscale="log", xlabel=f"{self.varied} [{self.unit}]")
        ax.set_xticks(order, [f"{v:g}" for v in order])
        ax.minorticks_off()
        if relative:
            ax.axhline(0, color="#555555", lw=0.7)
            # at least 5 %, so that a rounding error does not fill the panel, and what the panels that share the axis
            # need
            reach = max(5, *(1.2 * abs(x) for line in points.values() for x in line.values()), *map(abs, ax.get_ylim()))
            ax.set_ylim(-reach, reach)
        else:
            ax.set_ylim(0, 1.2 * max(map(max, columns)))

    def rows(self, scale):
        """Rows of text: value, mean, standard error, change from the finest."""
        for v in sorted(self.values, reverse=True):
            at = [x * scale for x in self.values[v].values()]
            mean, error = self.change(v, self.finest)
            yield [
                f"{v:g}",
                f"{np.mean(at):.4g}",
                f"{standard_error(at):.2g}",
                f"{100 * mean:+.2f} ± {100 * error:.2f}",
            ]


AXES = {
    "time_step": ("time step", "s"),
    "tolerance": ("tolerance", "-"),
    "tolerance_moving": ("tolerance in motion", "-"),
}


def plus_minus(error):
    """A standard error behind a claim's words; nothing for one seed."""
    return f", ± {error:.3f}" if math.isfinite(error) else ""


@style.styled
def sheet(bench, name, title, panels, relative=False):
    """Panels side by side, (sweep, scale, label of the y axis) each; written into the check's folder as ``name`` and
    returned.
    """
    figure = style.figure(3.2 * len(panels), 3.3, layout="constrained")
    for ax, (sweep, scale, label) in zip(figure.subplots(1, len(panels), squeeze=False, sharey=relative)[0], panels):
        sweep.draw(ax, scale, relative)
        ax.set_ylabel(label)
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    figure.suptitle(title, x=0.01, ha="left", fontsize=10.5)
    style.save(figure, bench.folder / name)
    return figure
