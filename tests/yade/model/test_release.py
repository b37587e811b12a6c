"""What a section says of the release of its water: by slip, by local dilatancy, or by the one that comes first."""

import math

import pytest
from slope_scenes import SMALL
from yade.nonsmooth import section, similar
from yade.nonsmooth.model.section import checks as section_checks, data as section_data, values as section_values
from yade.nonsmooth.model.section.parts import Release


def of(release, **water):
    made = section_values.given(section.load(str(SMALL)))
    made["water"] |= water | ({"release": release} if release is not None else {})
    return section.of(made, "s")


def test_slip_is_what_it_was_and_leaves_no_trace():
    """Whether it is said or not."""
    without, said = of(None), of({"by": "slip"})
    assert without.water == said.water and without.water.release is None
    assert "release" not in section_data.plain(said)["water"] and said.release_distance == 3.0


def test_dilatancy_has_defaults_and_no_distance():
    made = of({"by": "dilatancy"})
    assert made.water.release == Release("dilatancy", 0.03, 3.0, None)
    assert made.release_distance == math.inf and made.water.release_distance == 3.0
    both = of({"by": "slip_or_dilatancy", "dilation": 0.05, "over": 4, "drainage_time": 2})
    assert both.water.release == Release("slip_or_dilatancy", 0.05, 4.0, 2.0) and both.release_distance == 3.0


def test_what_is_written_down_is_read_again():
    for release in ({"by": "dilatancy"}, {"by": "slip_or_dilatancy", "dilation": 0.02, "drainage_time": 4.5}):
        made = of(release)
        again = section.of(section_data.plain(made), "s")
        assert again.water == made.water


def test_a_slope_of_another_size_drains_in_its_own_time():
    made = of({"by": "dilatancy", "drainage_time": 2.0})
    small = similar.scaled(made, 0.25)
    assert small.water.release == Release("dilatancy", 0.03, 3.0, 1.0)
    assert similar.mirrored(made).water.release == made.water.release


def test_a_sweep_changes_it_by_its_keys():
    made = of(None)
    other = section_values.with_values(made, {"water.release.by": "dilatancy", "water.release.dilation": 0.05})
    assert other.water.release == Release("dilatancy", 0.05, 3.0)
    assert section_values.with_values(other, {"water.release": {"by": "slip"}}).water == made.water


def test_a_distance_that_does_not_release_is_no_note():
    """The small slope's 3 m are no slip surface's 0.5 m, which a run says where slip releases."""
    assert any("released from the water after 3 m" in note for note in section_checks.notes(of(None)))
    assert not any("released from the water" in note for note in section_checks.notes(of({"by": "dilatancy"})))


@pytest.mark.parametrize(
    "release, said",
    [
        ({"by": "time"}, "water.release.by: .*dilatancy or slip_or_dilatancy"),
        ({"dilation": 0.03}, "water.release: .*by"),
        ({"by": "dilatancy", "dilation": 3}, "water.release.dilation: .*0.03 is 3 %"),
        ({"by": "dilatancy", "dilation": 0}, "water.release.dilation"),
        ({"by": "dilatancy", "over": 0.5}, "water.release.over: .*in mean diameters, 1 to 50"),
        ({"by": "dilatancy", "drainage_time": 0}, "water.release.drainage_time: .*above 0"),
        ({"by": "dilatancy", "delay": 3}, "delay"),
        ({"by": "slip", "dilation": 0.02}, "water.release.dilation: 0.02 does nothing where slip releases the water"),
    ],
)
def test_what_makes_no_sense_is_refused(release, said):
    with pytest.raises(section.SectionError, match=said):
        of(release)
