"""Displacement of a wedge on a joint against time, hard and soft."""

import numpy as np

from . import style
from .style import INK

__all__ = ["creep"]


@style.styled
def creep(panels, path=None):
    """Displacement on a logarithmic axis against time, one panel a joint.

    ``panels``: list of (title, curves), and ``curves`` a list of (label, colour, time [s], displacement down the joint
    [mm]), arrays of shape (n,). The size of the displacement is drawn, whether down the joint or up, and 1e-6 mm where
    it is less.
    """
    fig = style.figure(9.0, 4.2)
    axes = fig.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    fig.subplots_adjust(left=0.08, right=0.98, top=0.92, bottom=0.26, wspace=0.08)
    for ax, (title, curves) in zip(axes, panels):
        for label, colour, time, way in curves:
            ax.plot(time, np.maximum(np.abs(way), 1e-6), color=colour, label=label)
        ax.axhline(1, color=INK, linewidth=0.8, linestyle=(0, (4, 3)))
        ax.text(0.985, 0.87, "1 mm", transform=ax.get_yaxis_transform(), ha="right", va="top", color=INK)
        ax.set(title=title, xlabel="time [s]", yscale="log", xlim=(0, None))
    axes[0].set_ylabel("displacement along the joint [mm]")
    handles, labels = axes[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="lower center", ncol=2)
    return style.save(fig, path)
