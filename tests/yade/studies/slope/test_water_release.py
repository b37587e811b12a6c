"""Water that local dilatancy releases in a slope's run: when, how much, and the same bits after a resume."""

import numpy as np
import pytest
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import experiment, records, section, tables, worlds
from yade.nonsmooth.course import State
from yade.nonsmooth.model.section import values as section_values
from yade.nonsmooth.studies.slope.columns import RELEASED
from yade.nonsmooth.studies.slope.water_release import WaterRelease

pytestmark = pytest.mark.usefixtures("empty")
END = 7.0  # s, when the small slope moves


def chosen(**release):
    return section_values.with_values(section.load(str(SMALL)), {"water.release": {"by": "dilatancy", **release}})


def begun(folder, world=None, **release):
    O.reset()
    return experiment.begin(chosen(**release), folder, world=world)


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """The folder of a run to END, its state, and the shares that were released there."""
    folder = tmp_path_factory.mktemp("moved") / "out"
    run = begun(folder)
    run.run(END)
    shares = tables.released_shares(run.slope.water, run.slope.first_disk, run.slope.count)
    return folder, run.state, run.release.content(), shares


def bytes_of(folder):
    names = ["series.csv", "walls.csv", *sorted(p.relative_to(folder) for p in (folder / "snapshots").glob("*.npz"))]
    return {str(name): (folder / name).read_bytes() for name in names}


def test_nothing_is_released_before_the_slope_moves(moved):
    folder, state, content, shares = moved
    series = records.read_series(folder / "series.csv")
    assert state.moving is not None
    before = series["time_s"] <= state.moving + 1e-9
    assert not series[RELEASED.name][before].any() and not series["released_disks"][before].any()
    assert series[RELEASED.name][-1] > 0.2 and (np.diff(series[RELEASED.name]) >= 0).any()
    assert series["released_disks"][-1] > 0 and 0 <= shares.min() and shares.max() == 1
    assert ((0 < shares) & (shares < 1)).any() and max(content["largest"]) > 0.03


def test_snapshots_tell_the_share_of_each_disk(moved):
    folder, state, _, _ = moved
    shots = [records.read_snapshot(p) for p in sorted((folder / "snapshots").glob("*.npz"))]
    times = [shot.time_s for shot in shots]
    assert all(not shot.released_share.any() for shot in shots if shot.time_s <= state.moving)
    last = shots[int(np.argmax(times))]
    assert last.released_share.max() == 1 and (last.released_share[last.released] == 1).all()
    for one, other in zip(shots, shots[1:]):  # never less
        assert (other.released_share >= one.released_share).all()


def test_a_resumed_run_has_the_bits_of_one(moved, tmp_path):
    """Stopped twice: before the slope moves, and while it releases its water."""
    folder, state, content, shares = moved
    begun(tmp_path / "out").run(state.moving - 0.1)
    for end in (state.moving + 0.4, END):
        O.reset()
        run = experiment.resume(chosen(), tmp_path / "out")
        run.run(end)
    assert bytes_of(tmp_path / "out") == bytes_of(folder)
    assert run.release.content() == content
    assert np.array_equal(tables.released_shares(run.slope.water, run.slope.first_disk, run.slope.count), shares)


def test_slip_alone_has_no_column_and_no_array(tmp_path):
    run = begun(tmp_path / "out", by="slip")
    run.run(0.2)
    run.snapshot(tmp_path / "one.npz")
    assert run.release is None and RELEASED.name not in records.read_series(tmp_path / "out" / "series.csv")
    assert records.read_snapshot(tmp_path / "one.npz").released_share is None


def test_stretched_by_hand_it_releases_by_its_rule(tmp_path):
    """2 % of area more: of a whole dilation of 4 % about the half, and with a drainage time it comes back."""
    run = begun(tmp_path / "out", dilation=0.04, drainage_time=3.0)
    disks = tables.bodies(run.slope.solver)
    release = WaterRelease(run.slope)
    release.look(disks, False)
    assert release.content() is None
    release.look(disks, True)
    wide = disks | {"x": 1.02 * disks["x"]}
    release.look(wide, True)
    shares = tables.released_shares(run.slope.water, run.slope.first_disk, run.slope.count)
    assert np.median(shares) == pytest.approx((1 - 1 / 1.02) / 0.04, abs=0.02) and release.relaxes
    release.time -= 3.0
    release.look(wide, True)
    later = tables.released_shares(run.slope.water, run.slope.first_disk, run.slope.count)
    assert later == pytest.approx(shares / np.e, rel=1e-9) and release.time == O.time  # from which on it counts next
    again = WaterRelease(run.slope, release.content())
    assert again.content() == release.content()
    release.time -= 100.0
    release.look(wide, True)
    assert not release.relaxes and isinstance(run.state, State)


def test_soft_contacts_release_too(tmp_path):
    run = begun(tmp_path / "soft", world=worlds.Soft(2e7, (0.5, 1.0)))
    run.run(0.1)
    disks = tables.bodies(run.slope.solver)
    run.release.look(disks, True)
    run.release.look(disks | {"x": 1.05 * disks["x"]}, True)
    run.run(0.2)
    assert tables.released_shares(run.slope.water, run.slope.first_disk, run.slope.count).mean() > 0.9
    assert RELEASED.name in records.read_series(tmp_path / "soft" / "series.csv")
