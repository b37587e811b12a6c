"""How the weakening of slip surfaces spreads along them in the course of time (the paper's section 6.3, paragraph
117).
"""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Patch

from ..measure.ground import ground_of
from ..measure.weakening import weakened_share
from . import given, style

__all__ = ["weakening"]

SHADES = LinearSegmentedColormap.from_list("weakened", [style.STRONG, style.WEAKENED])


@given.takes(cases=given.SNAPSHOTS, walls=given.WALLS)
@style.styled
def weakening(cases, walls, path=None, times=None, pdf=False):
    """Which part of each surface that weakens is weakened, along the surface against time, one panel a surface.

    ``cases``: :class:`~nonsmooth.records.Snapshot` in the course of time, which tell who is ``weakened``; they may be
    read one by one. ``walls``: a Section. Each column is a snapshot and reaches halfway to its neighbours; its cells
    are about three mean diameters of the surface, from the upper end, at the top, to the foot. Grey: the disks there
    have not slipped as far as D_c; red: they have; shades between: a share of them; white: no disk is there. ``times``:
    t0 to t5 to mark; what was long before t1 and the first weakening is left out. See
    :func:`~nonsmooth.measure.weakening.weakened_share`.
    """
    ground, seen, places, shares = ground_of(walls), [], {}, {column: [] for column in ground_of(walls).weakening}
    for snapshot in cases:
        if snapshot.weakened is None or snapshot.weakened.shape[1] != len(shares):
            raise style.RecordsError(
                "a snapshot does not tell which disks are weakened, or on other walls; draw those of a run of this version, with its section"
            )
        seen.append(snapshot.time_s)
        for column, wall in ground.weakening.items():
            places[column], share = weakened_share(snapshot, wall.vertices, column, ground.side)
            shares[column].append(share)
    if not seen or not shares:
        raise style.RecordsError("there is no snapshot to draw, or no wall that weakens; give at least one of each")
    seen = np.array(seen)
    middle = (seen[:-1] + seen[1:]) / 2
    edges = np.r_[seen[0], middle, seen[-1]] if len(seen) > 1 else np.r_[seen[0], seen[0] + 1.0]
    weak = [np.nanmax(share, initial=0.0) > 0 for row in zip(*shares.values()) for share in [np.concatenate(row)]]
    first = min([style.known_times(times).get("t1", np.inf), *seen[weak][:1], edges[-1]]) if any(weak) else edges[0]
    fig = style.figure(10, 1.0 + 2.7 * len(shares), layout="constrained")
    axes = fig.subplots(len(shares), 1, sharex=True, squeeze=False)[:, 0]
    for k, (ax, (column, wall)) in enumerate(zip(axes, ground.weakening.items())):
        factor, unit = style.length_unit(places[column][-1])
        ax.pcolormesh(
            edges, factor * places[column], np.array(shares[column]).T, cmap=SHADES, vmin=0, vmax=1, rasterized=True
        )
        ax.set_ylim(factor * places[column][-1], 0)
        ax.set_xlim(max(edges[0], first - 0.1 * (edges[-1] - first)), edges[-1])
        ax.set_ylabel(f"along {style.plain(wall.name)},\nfrom its upper end [{unit}]")
        style.mark_times(ax, times, labels=k == 0)
    axes[-1].set_xlabel("time [s]")
    axes[0].legend(
        handles=[
            Patch(color=style.STRONG, label="slip below $D_c$"),
            Patch(color=style.WEAKENED, label="slip beyond $D_c$:\nweakened"),
            Patch(fc="white", ec="#999999", label="no disk on it"),
        ],
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
    )
    return style.save(fig, path, pdf)
