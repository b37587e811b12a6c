"""The figure of water that is released by one rule beside another, read from its artists. Needs no YADE."""

import dataclasses

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

records, release, style = (synthetic.load(name) for name in ("records", "figures.release", "figures.style"))
SECTION = synthetic.Section()
T = np.arange(0, 601) / 10
TIMES = {"t0": 10.0, "t1": 28.0, "t2": 30.0, "t3": 36.0, "t4": 45.0, "t5": 58.0}


def series(gone):
    """The force of the water grows to 8 MN/m at 30 s, and is gone so many seconds later."""
    return {"time_s": T, "dp_water_N_per_m": np.interp(T, [10, 30, 30 + gone], [0, 8e6, 0])}


def slope(**changes):
    """Four disks at 33 s: dry, wet, half released and released."""
    known = dict(wet=[False, True, True, False], released=[False, False, False, True]) | changes
    made = synthetic.few([0.0, 5.0, 10.0, 15.0], [0.0] * 4)
    return dataclasses.replace(made, time_s=33.0, **{name: np.array(values) for name, values in known.items()})


def test_forces_are_those_of_t2_and_disks_have_the_colour_of_their_share():
    half = slope(released_share=[0.0, 0.0, 0.5, 1.0])
    cases = [
        ("by slip", [(series(4.0), TIMES), (series(2.0), TIMES)], slope(), SECTION),
        ("by dilatancy", [(series(8.0), TIMES)], half, SECTION),
        ("stood", [(series(8.0), dict.fromkeys(TIMES))], half, SECTION),
    ]
    fig = release.releases(cases, seconds=10.0)
    ax, *below = fig.axes
    assert list(drawn.legend(ax)) == ["by slip", "by dilatancy"] and len(below) == 2
    for one, gone in zip(ax.lines, (4.0, 2.0, 8.0)):
        t, force = drawn.points(one).T
        assert (t[0], t[-1]) == pytest.approx((-3.0, 10.0)) and np.interp(0.0, t, force) == pytest.approx(1.0)
        assert np.interp(gone / 2, t, force) == pytest.approx(0.5) and force[-1] == 0
    dry, wet, released = (style.DRY[0], style.WET[0], style.RELEASED[0])
    (_, _, slip), (_, _, share) = (drawn.disks(one) for one in below)
    assert slip == [dry, wet, wet, released]
    assert share[:2] == [dry, wet] and share[3] == released and share[2] not in (dry, wet, released)
    assert drawn.text(below[1], "by dilatancy").get_text() == "by dilatancy, 3.0 s after $t_2$"


def test_slopes_that_did_not_accelerate_have_none():
    with pytest.raises(records.RecordsError, match="no slope came to accelerate"):
        release.releases([("stood", [(series(8.0), dict.fromkeys(TIMES))], slope(), SECTION)])
