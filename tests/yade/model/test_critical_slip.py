"""One critical distance D_c, of slip and of the release from water: the rule where a section says nothing, what is
noted, and the option that sets both.
"""

import copy
import sys
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.model.scales import AREA  # noqa: E402
from nonsmooth.model.section import checks as section_checks, data as section_data  # noqa: E402
from slope_scenes import SMALL, write_changed  # noqa: E402

WEAK = {"law": "linear", "critical_slip": 0.5}
OTHER = {
    "friction": 0.3,
    "rolling_friction": 0.1,
    "bonded": False,
    "slip_weakening": {"law": "step", "critical_slip": 2.0},
}
SAME = {**OTHER, "slip_weakening": WEAK}
JOINT = {"name": "joint", "between": ["L1", "L2"], "material": "other", "role": "slip"}
POINT = {"point": [0.0, 0.0], "dip": 25.0}
LOST = None  # no slip surface says it


def data(dp=WEAK, other=None, floor=None, joint=None, plane="DP", release=None):
    """The small slope's data: the law of its plane, a second weak material, of which the floor is (then with this role)
    or an interface, what the water is measured from, and what it says of the release."""
    made = section_data.plain(section.load(str(SMALL)))
    for wall in made["walls"]:
        del wall["role"]
    made["materials"]["dp"]["slip_weakening"] = dp
    if dp is None:
        del made["materials"]["dp"]["slip_weakening"]
    if other is not None:
        made["materials"]["other"] = copy.deepcopy(other)
    if floor is not None:
        made["walls"][2] |= {"material": "other", "role": floor}
    if joint is not None:
        made["interfaces"] = [joint]
    made["water"]["plane"] = plane
    del made["water"]["release_distance"]
    if release is not None:
        made["water"]["release_distance"] = release
    return made


@pytest.mark.parametrize(
    "given, metres",
    [
        (dict(), 0.5),
        (dict(plane=POINT), 0.5),  # the only one
        (dict(other=SAME, floor="slip"), 0.5),
        (dict(other=SAME, floor="slip", plane=POINT), 0.5),  # both have it
        (dict(other=OTHER, floor="slip"), 0.5),  # that of the water's plane
        (dict(other=OTHER, floor="slip", plane="SS"), 2.0),
        (dict(other=OTHER, floor="slip", plane=POINT), LOST),
        (dict(other=OTHER, floor="slip", plane="FB"), LOST),
        (dict(other=OTHER, floor="slip", plane=POINT, release=0.7), 0.7),
        (dict(other=OTHER, floor="ground"), 0.5),  # a floor that weakens is no slip surface
        (dict(other=OTHER, floor="ground", plane="SS"), 0.5),
        (dict(other=OTHER, joint=JOINT), 0.5),
        (dict(other=OTHER, joint=JOINT, plane=POINT), LOST),
        (dict(dp=None, other=OTHER, joint=JOINT), 2.0),
        (dict(other=OTHER, joint={k: v for k, v in JOINT.items() if k != "role"}, plane=POINT), 0.5),
        (dict(dp=None), "default"),
        (dict(dp=None, other=OTHER, joint={k: v for k, v in JOINT.items() if k != "role"}), "default"),
        (dict(release="critical_slip"), 0.5),
        (dict(dp=None, release="critical_slip"), "default"),
        (dict(release=0.5), 0.5),
        (dict(release=3), 3.0),
    ],
)
def test_the_release_from_water_goes_by_the_critical_slip(given, metres):
    if metres is LOST:
        with pytest.raises(
            section.SectionError,
            match=r"^s: water\.release_distance: .*several, 0.5 m \(DP\), 2 m .*; give a distance \[m\]$",
        ):
            section.of(data(**given), "s")
        return
    made = section.of(data(**given), "s")
    if metres == "default":  # the paper's, in proportion to the slope
        assert made.release_distance == 5.0 * (made.area / AREA) ** 0.5
    else:
        assert made.release_distance == metres
    # it follows where nothing else was said, as data, in the mirror and at another size
    assert (made.water.release_distance == "critical_slip") == (
        metres != "default" and given.get("release", "critical_slip") == "critical_slip"
    )
    assert section.of(section_data.plain(made), "s").water == made.water
    assert similar.mirrored(made).release_distance == made.release_distance
    assert similar.scaled(made, 0.25).release_distance == 0.25 * made.release_distance


def test_a_dry_slope_releases_nothing():
    dry = data()
    del dry["water"]
    assert section.of(dry).release_distance is None and section.of(dry).critical_slips == {"DP": 0.5}


def test_the_papers_slope_has_one_distance():
    made = section.load("jiufengershan")
    assert made.release_distance == 5.0 == made.materials["dp"].critical_slip and section_checks.notes(made) == []


@pytest.mark.parametrize(
    "given, noted",
    [
        (dict(), None),
        (dict(release=0.5), None),
        (dict(release=3.0), "after 3 m downslope, and the critical slip is 0.5 m (DP);"),
        (dict(other=OTHER, floor="slip", release=2.0), None),  # the other's
        (dict(other=OTHER, floor="slip", release=1.0), "critical slip is 0.5 m (DP), 2 m (SS);"),
        (dict(dp=None, release=3.0), None),  # nothing that it could differ from
        (dict(dp=None), None),
    ],
)
def test_two_distances_are_noted_in_one_line(given, noted):
    found = section_checks.notes(section.of(data(**given), "s"))
    assert len(found) == (noted is not None) and all(
        noted in n and n.startswith("s: ") and "\n" not in n for n in found
    )


def test_one_distance_is_set_for_all_that_weakens():
    made = section.of(data(other=OTHER, floor="slip", joint=JOINT, release=3.0), "s")
    one = made.with_critical_slip(7)
    assert one.critical_slips == {"DP": 7.0, "SS": 7.0, "joint": 7.0} and one.release_distance == 7.0
    assert section_checks.notes(one) == []
    # nothing else: laws, and what does not slide
    assert one.materials["other"].slip_weakening.law == "step" and one.materials["rock"] == made.materials["rock"]
    apart = section.of(data(other=OTHER, floor="ground"), "s").with_critical_slip(7)
    assert (apart.materials["dp"].critical_slip, apart.materials["other"].critical_slip) == (7.0, 2.0)
    # FB, above which the water stands, is a slip surface that keeps its strength
    stands = section.of(data(plane="FB"), "s").with_critical_slip(7)
    assert stands.wall("FB").role == "slip" and stands.critical_slips == {"DP": 7.0}
    dry = data()
    del dry["water"]
    assert section.of(dry).with_critical_slip(7).critical_slips == {"DP": 7.0}


@pytest.mark.parametrize(
    "given, distance, said",
    [
        (dict(dp=None), 7.0, "a critical slip of 7 m, and no slip surface weakens; add `slip_weakening`"),
        (dict(), 0.0, "a critical slip of 0.0: give a distance above 0"),
        (dict(), float("nan"), "a critical slip of nan: give"),
    ],
)
def test_a_distance_that_nothing_goes_by_is_refused(given, distance, said):
    with pytest.raises(section.SectionError) as refused:
        section.of(data(**given), "s").with_critical_slip(distance)
    assert str(refused.value).startswith(f"s: {said}")


# ---- the commands ---------------------------------------------------------------------------------


def test_a_run_keeps_the_distance_that_it_was_given(in_process, tmp_path):
    out = tmp_path / "out"
    words = ("slope.py", "--section", SMALL, "--end", 0.05, "--no-figures", "--out", out)
    done = in_process(*words, "--critical-slip", 0.25)
    assert done.status == 0, done.err
    assert "critical slip is" not in done.out
    kept = yaml.safe_load((out / "section.yaml").read_text())
    assert kept["materials"]["dp"]["slip_weakening"]["critical_slip"] == 0.25
    assert kept["water"]["release_distance"] == "critical_slip"
    for other in (("--critical-slip", 0.3), ()):
        refused = in_process(*words, *other, "--resume")
        assert refused.status == 1 and "other settings" in refused.last, refused.err
    # without the option the file's two distances are noted
    assert "released from the water after 3 m downslope, and the critical slip is 0.5 m (DP)" in refused.out
    again = in_process(*words, "--critical-slip", 0.25, "--resume")
    assert again.status == 0, again.err
    # and by the section that it kept
    kept = in_process(*words[:2], out / "section.yaml", *words[3:], "--resume")
    assert kept.status == 0, kept.err


def test_a_sweep_notes_two_distances_and_not_more_often_than_is_read(in_process, tmp_path):
    words = ("--over", "materials.dp.slip_weakening.critical_slip=1,2,3,4,5", "--plan", "--out", tmp_path / "out")
    said = in_process("sweep.py", "--section", SMALL, *words).out.strip().split("\n")
    assert ["released from the water after 3 m" in line for line in said] == [True, True, True, False, False], said
    assert said[3] == "and so for 1 more of the runs"  # 3 m is that of one of the five
    said = in_process("sweep.py", "--section", SMALL, *words, "--over", "water.release_distance=critical_slip").out
    assert "released" not in said


def test_a_sweep_counts_runs_and_not_notes(in_process, tmp_path):
    def change(made):
        made["water"]["plane"] = {
            "point": [0.0, 0.0],
            "dip": -25.0,
        }  # a sign that nobody meant: a second note for each run

    words = ("--section", write_changed(tmp_path, change), "--over", "seed=1,2,3", "--plan", "--out", tmp_path / "out")
    *said, planned = in_process("sweep.py", *words).out.strip().split("\n")
    assert [line.partition(":")[0] for line in said[:2]] == ["seed=1", "seed=1"] and planned.startswith(
        "3 runs planned"
    )
    assert said[2:] == ["and so for 2 more of the runs"]


def test_the_option_is_refused_where_nothing_weakens(in_process, tmp_path):
    def change(made):
        del made["materials"]["dp"]["slip_weakening"]

    stiff = write_changed(tmp_path, change)
    done = in_process("slope.py", "--section", stiff, "--critical-slip", 2, "--out", tmp_path / "out")
    assert done.status == 1 and done.err.count("\n") == 1 and "no slip surface weakens" in done.last
    done = in_process("slope.py", "--section", stiff, "--critical-slip", 0, "--out", tmp_path / "out")
    assert done.status == 2 and "m from 1e-9" in done.last and not (tmp_path / "out").exists()
