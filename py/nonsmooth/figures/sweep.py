"""Figure of a sweep: results against a value that was varied, with their scatter over seeds."""

import numpy as np

from . import style


@style.styled
def means(rows, key, names, path=None, pdf=False):
    """Results against the values of ``key``, a panel for each of the ``names``; dots: runs, squares: means over seeds with their 95 % interval.

    ``rows``: of `campaign.means`; those that differ in other keys too are lines of their own. Values that are no numbers stand side by side.
    """
    fig = style.figure(3.6 * len(names) + 0.6, 3.8, layout="constrained")
    groups = {}
    for row in rows:
        groups.setdefault(", ".join(f"{k} = {v}" for k, v in row["values"].items() if k != key), []).append(row)
    values = list(dict.fromkeys(str(row["values"][key]) for row in rows))
    numeric = all(isinstance(row["values"][key], (int, float)) for row in rows)
    for ax, name in zip(fig.subplots(1, len(names), squeeze=False)[0], names):
        for colour, (label, chosen) in zip(style.line_colours(len(groups)), groups.items()):
            x = [row["values"][key] if numeric else values.index(str(row["values"][key])) for row in chosen]
            found = [row["numbers"][name] for row in chosen]
            for at, one in zip(x, found):
                each = [v for v in one["values"] if v is not None]
                ax.plot([at] * len(each), each, "o", ms=3.5, color=colour, alpha=0.35, mew=0)
            ax.errorbar(
                x,
                [np.nan if one["mean"] is None else one["mean"] for one in found],
                [one["half_width"] or 0.0 for one in found],
                fmt="s-",
                ms=5,
                color=colour,
                capsize=3,
                lw=1.2,
                label=style.plain(label),
            )
        ax.set(xlabel=style.plain(key), title=style.plain(name))
        ticks = sorted({row["values"][key] for row in rows}) if numeric else range(len(values))
        if numeric and min(ticks) > 0 and max(ticks) >= 5 * min(ticks):
            ax.set_xscale("log")
        ax.set_xticks(list(ticks), [f"{t:g}" for t in ticks] if numeric else values)
        ax.minorticks_off()
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
        low, high = ax.get_ylim()
        if low > 0:
            ax.set_ylim(0, high)
    if any(groups):
        fig.axes[0].legend()
    return style.save(fig, path, pdf)
