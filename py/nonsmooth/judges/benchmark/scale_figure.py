"""How cost grows with the number of disks."""

from ...figures import style
from ...figures.style import LINES


@style.styled
def cost_by_size(sizes, path=None, pdf=False):
    """Time of a step, of a sweep, memory and packing against the number of disks, on logarithmic axes.

    ``sizes``: list of dictionaries as benchmark.scale.measure returns them. Dashed: proportional to the number of
    disks.
    """
    disks = [s["disks"] for s in sizes]

    def of_sweep(n):
        return [s["sweep_ns_per_contact"][n]["median"] for s in sizes]

    threads = sorted(sizes[0]["sweep_ns_per_contact"], key=int)
    panels = (
        ("A step", "time [ms]", {"": [s["step_ms"]["median"] for s in sizes]}, True),
        (
            "A sweep, for each contact",
            "time [ns]",
            {"1 thread" if n == "1" else f"{n} threads": of_sweep(n) for n in threads},
            False,
        ),
        (
            "Memory, for each contact",
            "memory [kB]",
            {
                "nobody has looked": [1e-3 * s["bytes_per_contact"] for s in sizes],
                "all have an interaction": [1e-3 * s["bytes_per_contact_viewed"] for s in sizes],
            },
            False,
        ),
        ("Packing", "time [s]", {"": [s["packing_s"] for s in sizes]}, True),
    )
    fig = style.figure(10, 6.6, layout="constrained")
    for ax, (title, label, curves, grows) in zip(fig.subplots(2, 2, sharex=True).flat, panels):
        ax.set_xscale("log")
        for colour, (name, values) in zip((LINES["blue"], LINES["orange"]), curves.items()):
            ax.plot(disks, values, color=colour, marker="o", label=name)
        if grows:
            ax.set_yscale("log")
            values = next(iter(curves.values()))
            ax.plot(disks, [values[0] * n / disks[0] for n in disks], color=LINES["grey"], ls=(0, (4, 3)), lw=0.9)
        else:
            ax.set_ylim(0, 1.25 * max(max(values) for values in curves.values()))
            ax.legend(loc="lower left", frameon=False)
        ax.set_title(title, loc="left")
        ax.set_ylabel(label)
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)
    for ax in fig.axes[2:]:
        ax.set_xlabel("disks")
    return style.save(fig, path, pdf)
