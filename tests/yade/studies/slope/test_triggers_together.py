"""All triggers of a slope at once: water that dilatancy releases, a window at its foot, an earthquake. Each does its
part, the energies balance, and a run that is stopped amid all of them goes on with the same bits.
"""

import numpy as np
import pytest
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import experiment, records, section, section_values
from yade.nonsmooth.studies.slope import run_files

pytestmark = pytest.mark.usefixtures("empty")
LINE = [[-50.0, 19.0], [0.5, 2.0], [70.0, 2.0]]  # 1 to 2 m above the plane, below the ground
WINDOW = {"name": "river", "vertices": [[-2.0, 0.5], [4.0, 0.5], [4.0, 6.0], [-2.0, 6.0]], "begin": 0.3}
SHAKING = {"synthetic": {"peak": 8.0, "duration": 2.0, "frequency": 2.0, "seed": 2}, "begin": 0.5}


def slope(**changes):
    data = section_values.given(section.load(str(SMALL)))
    return section.of(data | {"erosion": [WINDOW], "shaking": SHAKING} | changes)


def of_table():
    water = section_values.given(section.load(str(SMALL)))["water"]
    return slope(water=water | {"release": {"by": "slip_or_dilatancy", "dilation": 0.02}})


def of_lines():
    water = {"phreatic": {"lines": [{"time": 0.4, "points": LINE}], "flow": "along"}, "volume": "bulk"}
    stages = section_values.given(section.load(str(SMALL)))["stages"]
    stages.pop("water", None)
    return slope(water=water | {"release": {"by": "dilatancy"}}, stages=stages)


@pytest.fixture(scope="module", params=[of_table, of_lines], ids=["table", "lines"])
def together(request, tmp_path_factory):
    """A section with all triggers, its run's folder and summary."""
    made, folder = request.param(), tmp_path_factory.mktemp("together") / "run"
    course = experiment.begin(made, folder)
    course.run(stands=True)
    return made, folder, course.summarise()


def test_each_does_its_part(together):
    made, folder, summary = together
    series = records.read_series(folder / "series.csv")
    eroded = np.genfromtxt(folder / run_files.LEDGER, delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert len(np.atleast_1d(eroded)) > 0  # the window took some
    assert np.abs(series["ground_acceleration_x_m_per_s2"]).max() > 1.0
    assert series["wet_disks"].max() > 0 and series["water_released_rel"][-1] > 0.1
    assert summary["finished"] and summary["times_s"]["t2"] is not None
    begins = records.read_snapshot(folder / run_files.BEGIN)
    assert summary["disks"] == len(begins.x) > len(records.read_snapshot(folder / run_files.END).x)


def test_the_energies_balance(together):
    """But for what disks that are taken out have had, which is told apart."""
    _, _, summary = together
    assert summary["energy_error_rel"] < 0.02


def test_stopped_amid_all_of_them_it_goes_on_with_the_same_bits(together, tmp_path):
    made, folder, _ = together
    t0 = records.read_snapshot(folder / run_files.BEGIN).time_s
    O.reset()
    course = experiment.begin(made, tmp_path / "run")
    course.run(t0 + 1.2, stands=True)
    course.checkpoint()
    O.reset()
    again = experiment.resume(section.load(str(tmp_path / "run" / "section.yaml")), tmp_path / "run")
    again.run(stands=True)
    for name in ("series.csv", "walls.csv", "breaks.csv", run_files.LEDGER):
        assert (tmp_path / "run" / name).read_bytes() == (folder / name).read_bytes(), name
