"""How cost grows with the number of disks."""

from . import style
from .style import LINES


@style.styled
def cost_by_size(sizes, path, pdf=False):
    """Time of a step, of a sweep, memory and packing against the number of disks, on logarithmic axes.

    ``sizes``: list of dictionaries as benchmark.scale.measure returns them. Dashed: proportional to the number of disks. Returns ``path``.
    """
    disks = [s["disks"] for s in sizes]
    panels = (
        ("A step", "time [ms]", [s["step_ms"]["median"] for s in sizes], True),
        ("A sweep, for each contact", "time [ns]", [s["solve_ns_per_contact_and_sweep"] for s in sizes], False),
        ("Memory, for each disk", "memory [kB]", [1e-3 * s["bytes_per_disk"] for s in sizes], False),
        ("Packing", "time [s]", [s["packing_s"] for s in sizes], True),
    )
    fig = style.figure(10, 6.6, layout="constrained")
    for ax, (title, label, values, grows) in zip(fig.subplots(2, 2, sharex=True).flat, panels):
        ax.set_xscale("log")
        ax.plot(disks, values, color=LINES["blue"], marker="o")
        if grows:
            ax.set_yscale("log")
            ax.plot(disks, [values[0] * n / disks[0] for n in disks], color=LINES["grey"], ls=(0, (4, 3)), lw=0.9)
        else:
            ax.set_ylim(0, 1.15 * max(values))
        ax.set_title(title, loc="left")
        ax.set_ylabel(label)
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)
    for ax in fig.axes[2:]:
        ax.set_xlabel("disks")
    return style.save(fig, path, pdf)
