"""Figure of sliding tests on walls, for the walls' rows of the paper's Table 1."""

import numpy as np

from . import style

__all__ = ["slides"]

MEGA = 1e6


@style.styled
def slides(walls, path=None, pdf=False):
    """Shear stress over normal stress against slip, one panel a wall, and strengths against the normal stress for all
    walls.

    ``walls``: list of (found, series): a dictionary of `laboratory.wall_shear.strength_of`, and for each of its
    pressures columns of `laboratory.wall_shear.COLUMNS`. Curves are those of the first block of each wall, dots those
    of all.
    """
    names = list(dict.fromkeys(found["material"] for found, _ in walls))
    fig = style.figure(2.6 * len(names) + 6.4, 3.6, layout="constrained")
    axes = fig.subplots(1, len(names) + 1, squeeze=False, width_ratios=[1.0] * len(names) + [1.3])[0]
    for ax, name, colour in zip(axes, names, style.line_colours(len(names))):
        ax.sharey(axes[0])
        found, series = next((f, s) for f, s in walls if f["material"] == name)
        for k, (pressure, rows) in enumerate(zip(found["pressures_Pa"], series)):
            slip, normal, shear = (np.asarray(rows[column]) for column in ("slip_m", "normal_Pa", "shear_Pa"))
            borne = normal > 0.01 * pressure  # where bonds break the block may fly for some steps
            ax.plot(
                100 * slip[borne],
                shear[borne] / normal[borne],
                color=colour,
                alpha=1 - 0.7 * k / max(1, len(series) - 1),
                lw=1.2,
                label=f"{pressure / MEGA:g} MPa",
            )
        ax.set(xlabel="slip of the wall [cm]", title=name, xlim=(0, None))
    axes[0].set_ylim(0, None)
    axes[0].legend(title="normal stress", loc="upper right")
    axes[0].set_ylabel("shear stress over normal stress")
    last = axes[-1]
    for name, colour in zip(names, style.line_colours(len(names))):
        mine = [f for f, _ in walls if f["material"] == name]
        for kind, mark, line in (("peak", "o", "-"), ("residual", "s", "--")):
            normal, shear = (
                np.array([s[f"{what}_{kind}"] for f in mine for s in f["slides"]]) / MEGA
                for what in ("normal", "shear")
            )
            friction, cohesion = (
                float(np.mean([f[f"{what}_{kind}{unit}"] for f in mine]))
                for what, unit in (("friction", ""), ("cohesion", "_kPa"))
            )
            x = np.array([0, 1.05 * normal.max()])
            last.plot(normal, shear, mark, ms=4, color=colour, mfc=colour if kind == "peak" else "none")
            last.plot(
                x,
                1e-3 * cohesion + friction * x,
                line,
                lw=1.1,
                color=colour,
                label=f"{name}, {kind}: μ = {friction:.2f}, c = {abs(round(cohesion)):d} kPa",
            )
    last.set(
        xlabel="normal stress [MPa]",
        ylabel="shear stress [MPa]",
        xlim=(0, None),
        ylim=(0, None),
        title=f"strength, {len(walls) // len(names)} block{'s' if len(walls) > len(names) else ''} each",
    )
    last.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return style.save(fig, path, pdf)
