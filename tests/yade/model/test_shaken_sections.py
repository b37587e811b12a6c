"""Sections that shake: what a file may say, what is refused, the mirrored and the larger one, and what a run keeps."""

import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.model import ground_motion  # noqa: E402
from nonsmooth.model.ground_motion import GroundMotion  # noqa: E402
from nonsmooth.model.section import data as section_data, values as section_values  # noqa: E402

DATA = Path(__file__).resolve().parents[2] / "data"
SMALL, RECORD = DATA / "small_slope.yaml", DATA / "four_values.at2"


def data(shaking, **changes):
    return section_values.given(section.load(str(SMALL))) | {"shaking": shaking} | changes


def slope(shaking, **changes):
    return section.of(data(shaking, **changes))


def motion(made):
    m = made.shaking.motion
    return np.column_stack((m.times, m.horizontal, m.vertical))


def test_a_record_is_looked_for_beside_the_file(tmp_path):
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "one.csv").write_text("time_s,horizontal_g,vertical_g\n0,0,0\n0.1,0.5,0.25\n0.2,0,0\n")
    path = tmp_path / "slope.yaml"
    path.write_text(yaml.safe_dump(data({"file": "records/one.csv", "begin": 2.5})))
    made = section.load(str(path))
    g = 9.80665
    assert motion(made) == pytest.approx(np.array([[0, 0, 0], [0.1, 0.5 * g, 0.25 * g], [0.2, 0, 0]]))
    assert (made.shaking.begin, made.shaking.end) == (2.5, pytest.approx(2.7))


def test_numbers_of_a_record_are_changed_in_this_order():
    """Its baseline first, then the peak, then the factor of times, then the side."""
    raw = ground_motion.read(RECORD, unit="m/s2")
    made = slope(
        {"file": str(RECORD), "unit": "m/s2", "baseline": "line", "peak": 5.0, "stretch": 3.0, "reversed": True}
    )
    by_hand = raw.corrected("line").scaled(peak=5.0).stretched(3.0).reversed()
    assert np.array_equal(made.shaking.motion.horizontal, by_hand.horizontal)
    assert np.array_equal(made.shaking.motion.times, by_hand.times) and made.shaking.motion.source == by_hand.source


def test_a_record_that_begins_later_begins_with_the_shaking(tmp_path):
    path = tmp_path / "late.csv"
    path.write_text("time_s,horizontal_g\n10,0\n10.1,0.5\n10.2,0\n")
    made = slope({"file": str(path), "begin": 1.0})
    assert made.shaking.motion.times == pytest.approx([0, 0.1, 0.2]) and made.shaking.end == pytest.approx(1.2)


def test_a_synthetic_motion_has_the_default_seed_one():
    said = {"peak": 2.0, "duration": 3.0, "frequency": 2.0}
    one, same, other = (slope({"synthetic": said | more}) for more in ({}, {"seed": 1}, {"seed": 2}))
    assert np.array_equal(motion(one), motion(same)) and not np.array_equal(motion(one), motion(other))
    assert one.shaking == same.shaking != other.shaking


@pytest.mark.parametrize(
    "shaking, words",
    [
        ({}, "shaking: has neither `file` nor `synthetic`; give the file of a record"),
        (
            {"file": "a.at2", "synthetic": {"peak": 1, "duration": 1, "frequency": 1}},
            "shaking: has both `file` and `synthetic`",
        ),
        ({"file": "nowhere.at2"}, "shaking.file: "),
        ({"file": str(RECORD)}, "does not say the unit of its values"),
        ({"file": str(SMALL), "unit": "g"}, "shaking.file: "),
        ({"file": str(RECORD), "unit": "ft/s2"}, "shaking.unit: 'ft/s2' is not allowed; needed: unit of a .AT2"),
        ({"file": str(RECORD), "unit": "m/s2", "peak": 1.0, "factor": 2.0}, "shaking.factor: stands beside `peak`"),
        ({"file": str(RECORD), "unit": "m/s2", "begin": -1.0}, "shaking.begin: -1.0 is not allowed"),
        ({"file": str(RECORD), "unit": "m/s2", "factor": 0}, "shaking.factor: 0 is not allowed"),
        ({"file": str(RECORD), "unit": "m/s2", "peak": 300.0}, "at most 10 g: 3.0 are 0.31 g"),
        ({"file": str(RECORD), "unit": "m/s2", "factor": 100.0}, "at most 98.0665"),
        ({"synthetic": {"peak": 1.0, "duration": 3.0}}, "shaking.synthetic: the key 'frequency' is missing"),
        ({"synthetic": {"peak": 1.0, "duration": 3.0, "frequency": 1.0, "step": 5.0}}, "shaking.synthetic: step 5"),
        (
            {"synthetic": {"peak": 1.0, "duration": 3.0, "frequency": 1.0}, "unit": "g"},
            "shaking.unit: belongs to a record of a file; leave it out",
        ),
        ({"file": str(RECORD), "unit": "m/s2", "pga": 1.0}, "shaking.pga: unknown key"),
    ],
)
def test_what_makes_no_motion_is_refused(shaking, words):
    with pytest.raises(section.SectionError) as info:
        slope(shaking)
    assert words in str(info.value) and "\n" not in str(info.value)


def test_a_run_that_ends_before_the_record_is_refused():
    said = {"synthetic": {"peak": 1.0, "duration": 40.0, "frequency": 1.0}, "begin": 2.0}
    with pytest.raises(section.SectionError) as info:
        slope(said)  # which ends 30 s after settling, with a dry rest of 0.2 s
    assert str(info.value).endswith("give stages.end.time of 43 s and more") and "42 s after t0" in str(info.value)
    with pytest.raises(section.SectionError, match="43 s and more"):  # the dry rest counts too
        slope(said, stages=data(said)["stages"] | {"end": {"time": 42.1}})
    longer = data(said)
    longer["stages"]["end"]["time"] = 43.0
    assert section.of(longer).shaking.end == 42.0


def test_mirrored_the_ground_goes_to_the_other_side():
    made = slope({"file": str(RECORD), "unit": "m/s2", "begin": 1.0})
    other = similar.mirrored(made)
    assert np.array_equal(other.shaking.motion.horizontal, -made.shaking.motion.horizontal)
    assert np.array_equal(other.shaking.motion.vertical, made.shaking.motion.vertical)
    assert similar.mirrored(other) == made and other != made


def test_a_slope_four_times_as_large_shakes_half_as_fast():
    """Froude: times in the ratio of the root of that of sizes, the same accelerations."""
    made = slope({"file": str(RECORD), "unit": "m/s2", "begin": 1.0})
    large = similar.scaled(made, 4.0)
    assert large.shaking.begin == 2.0 and large.shaking.motion.times == pytest.approx(2 * made.shaking.motion.times)
    assert np.array_equal(large.shaking.motion.horizontal, made.shaking.motion.horizontal)
    values = large.with_values({"materials.dp.friction": 0.5})
    assert values.shaking == large.shaking


def test_values_are_varied():
    made = slope({"file": str(RECORD), "unit": "m/s2"})
    assert made.with_values({"shaking.peak": 4.0}).shaking.motion.peak_acceleration() == pytest.approx(4.0)
    assert made.with_values({"shaking.begin": 3.0}).shaking.begin == 3.0


def test_what_a_run_keeps_needs_no_other_file(tmp_path):
    """The record as it shakes the slope, to the last bit, whatever becomes of the one that it was read from."""
    path = tmp_path / "uneven.csv"
    path.write_text("time_s,horizontal_g\n0,0\n0.1,0.3333333333333333\n0.7,-1e-05\n1,0\n")
    made = slope({"file": str(path), "uneven": True, "name": "a record, of a name", "peak": 1 / 3, "begin": 0.25})
    run = tmp_path / "run"
    run.mkdir()
    section_data.write(made, run / section_data.FILE)
    path.unlink()
    again = section.load(str(run / section_data.FILE))
    assert np.array_equal(motion(again), motion(made)) and again.shaking == made.shaking
    assert again.shaking.motion.name == "a record, of a name"
    moved = tmp_path / "moved"
    run.rename(moved)  # to another place
    assert section.load(str(moved / section_data.FILE)).shaking == made.shaking


def test_what_is_kept_by_plain_data_knows_the_content_of_the_file(tmp_path):
    """A sweep takes a run for another one where the file's values have changed meanwhile."""
    path = tmp_path / "record.csv"
    path.write_text("time_s,horizontal_g\n0,0\n0.1,0.5\n")
    before = section_data.plain(slope({"file": str(path), "factor": 2.0}))
    assert section.of(before).shaking.motion.peak_acceleration() == pytest.approx(9.80665)
    path.write_text("time_s,horizontal_g\n0,0\n0.1,0.4\n")
    after = section_data.plain(slope({"file": str(path), "factor": 2.0}))
    assert before["shaking"]["sha256"] != after["shaking"]["sha256"]
    with pytest.raises(section.SectionError, match="shaking.sha256: .* is not that of the values of .*record.csv"):
        section.of(before)


def test_a_synthetic_motion_is_kept_by_its_numbers(tmp_path):
    made = slope({"synthetic": {"peak": 2.0, "duration": 3.0, "frequency": 2.0}})
    section_data.write(made, tmp_path / section_data.FILE)
    assert [p.name for p in tmp_path.iterdir()] == [section_data.FILE]
    assert section.load(str(tmp_path / section_data.FILE)).shaking == made.shaking


def test_a_motion_is_written_and_read_to_the_same_bits(tmp_path):
    made = GroundMotion([0.0, 0.1, 1 / 3], [1e-300, -1 / 3, 0.0], [2.0, 0.1, 5e-324], name="two\nlines")
    ground_motion.write_csv(made, tmp_path / "a.csv")
    again = ground_motion.read(tmp_path / "a.csv", uneven=True)
    for part in ("times", "horizontal", "vertical"):
        assert np.array_equal(getattr(made, part), getattr(again, part))
    assert (tmp_path / "a.csv").read_text().startswith("# two lines\n# arrays\ntime_s,")


@pytest.mark.parametrize("what, path", [("no motion", "a.csv"), (GroundMotion([0, 1], [1, 1]), 3)])
def test_only_a_motion_is_written(tmp_path, what, path):
    with pytest.raises(ground_motion.GroundMotionError):
        ground_motion.write_csv(what, tmp_path / path if isinstance(path, str) else path)
