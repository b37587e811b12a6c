"""Laws of slip surfaces from Python: what a law is given and refuses, cells as arrays, named parameter sets. The laws'
numbers are held by tests/contact/slip_*_test.cpp and the checks of judges.verification.thermal.
"""

import numpy as np
import pytest
from yade.nonsmooth.slip import laws, parameter_sets
from yade.nonsmooth.slip.laws import SlipError, SlipLaw

STEP = dict(friction=0.4, critical_slip=5.0)


def test_every_law_says_what_it_takes():
    assert list(laws.known())[:4] == ["none", "step", "linear", "exponential"] and len(laws.known()) == 9
    for name, what in laws.known().items():
        asked = laws.parameters(name)
        assert what and asked and len({one.key for one in asked}) == len(asked)
        for one in asked:
            assert one.what and one.unit and (one.fallback is None) == one.required, (name, one)
    both = {one.key for one in laws.parameters("thermal_pressurization", "flash_heating")}
    assert {"hydraulic_diffusivity", "asperity_slip", "thickness"} <= both
    with pytest.raises(SlipError, match="slip law 'gel': it must be one of none, step"):
        laws.parameters("gel")


@pytest.mark.parametrize(
    "names, values, said",
    [
        ("gel", {}, "'gel': it must be one of"),
        ([], {}, "no slip law is named"),
        (["step", "linear"], STEP, "step\\+linear do not share a zone"),
        ("step", dict(STEP, critical_slip=-1), "critical_slip = -1 m, it must be positive"),
        ("step", dict(STEP, friction="0.4"), "step: friction = '0.4': give a number"),
        ("step", dict(STEP, friction=True), "friction = True: give a number"),
        ("step", dict(STEP, friction=[0.4, 0.5]), "friction is a list: give one number"),
        ("step", dict(STEP, friction=[None]), "friction holds None: give numbers"),
        ("step", dict(STEP, friction=None), "friction = None: give a number"),
        ("step", dict(STEP, slip=1), "it has no slip; it takes friction, critical_slip"),
    ],
)
def test_a_law_refuses_in_one_message(names, values, said):
    with pytest.raises(SlipError, match=said) as refused:
        SlipLaw(names, **values)
    assert "\n" not in str(refused.value)


def test_cells_are_arrays_of_the_library():
    law = SlipLaw("step", **STEP)
    cells = law.cells(3, 1e6)
    law.prepare(0.01)
    cells.path[:] = [0, 4, 6]
    assert np.array_equal(law.strength(cells), [4e5] * 3)
    law.advance(cells)
    assert np.array_equal(cells.slip, [0, 4, 6]) and len(cells) == 3
    cells.normal_stress[0] = 2e6
    assert np.array_equal(law.strength(cells), [8e5, 4e5, 0])
    slip = cells.slip
    del cells  # an array keeps its cells
    assert np.array_equal(slip, [0, 4, 6])


def test_a_step_is_asked_for_before_it_is_taken():
    law = SlipLaw("step", **STEP)
    cells = law.cells()
    with pytest.raises(SlipError, match="ask for the strength of a step first"):
        law.advance(cells)
    with pytest.raises(SlipError, match="h = 0.* s: a step's length must be positive"):
        law.prepare(0)


def test_to_ask_for_friction_changes_no_step():
    """That of a law before slip, which may be asked for at any time."""
    found = []
    for asks in (False, True):
        law = parameter_sets.law("vaiont")
        cells = law.cells(1, 2e6)
        law.prepare(0.25)
        for _ in range(3):
            if asks:
                assert law.friction() == pytest.approx(0.4, rel=1e-12)
            law.strength(cells)
            cells.slip_rate[:], cells.path[:], cells.heat[:] = 2.0, 0.5, 0.5 * cells.strength
            law.advance(cells)
        found.append([float(cells.strength[0]), *cells.columns["temperature"][0], *cells.columns["pressure"][0]])
    assert found[0] == found[1] and found[0][0] < 0.5 * 0.4 * 2e6


def test_a_heated_zone_shows_its_profiles():
    law = parameter_sets.law("vaiont")
    cells = law.cells(2, [2e6][0])
    law.prepare(1e-3)
    law.strength(cells)
    cells.heat[:] = [0, 1e5]
    law.advance(cells)
    columns = cells.columns
    places = law.places()
    assert set(columns) == set(cells.units) == {"temperature", "pressure", "vapour"}
    assert columns["temperature"].shape == columns["pressure"].shape == (2, len(places))
    assert columns["vapour"].shape == (2,) and cells.units["pressure"] == "Pa"
    assert np.all(np.diff(places) > 0) and places[0] < 0.005 < places[-1]
    mean = law.zone_mean(columns["temperature"])
    assert mean[0] == 36 and abs(mean[1] - 36 - 1e5 / (2.85e6 * 0.01)) < 0.02  # 0.6 % of it leaves the zone
    assert np.allclose(law.heat_in(cells), [0, 1e5], rtol=1e-9)
    assert law.heats and not SlipLaw("step", **STEP).heats
    with pytest.raises(ValueError, match="this slip law has no flash_heating"):
        law.flash_velocity(20)
    with pytest.raises(ValueError, match="this slip law has no shear_melting"):
        law.melt_hottest(1)
    with pytest.raises(ValueError, match="this slip law has no heated zone"):
        SlipLaw("step", **STEP).places()


def test_water_boils_near_the_line_of_iapws():
    saturation = pytest.importorskip("iapws.iapws97", reason="python3-iapws is not installed")._PSat_T
    own = [1e-6 * laws.vapour_pressure(t) / saturation(t + 273.15) - 1 for t in (100, 200, 250, 300)]
    assert np.allclose(own, [-0.116, 0.018, 0.126, 0.240], atol=2e-3)  # what eq. (14) misses


# ---- parameter sets ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", parameter_sets.known())
def test_every_set_makes_a_law_and_says_where_each_value_comes_from(name):
    law = parameter_sets.law(name)
    cells = law.cells(1, 1e6)
    law.prepare(1e-3)
    assert 0 < law.strength(cells)[0] <= 1e6
    told = parameter_sets.values(name)
    assert told and all(ground in parameter_sets.GROUNDS and why for _, ground, why in told.values())
    assert set(law.values) >= set(told) - {"form"}
    asked = {one.key for one in laws.parameters(*law.names) if one.required}
    assert asked <= set(law.values)


def test_a_set_takes_over_another_and_values_can_be_changed():
    thick, thin = parameter_sets.law("vaiont").values, parameter_sets.law("vaiont_thin").values
    assert {key for key in thick if thick[key] != thin[key]} == {"thickness"}
    assert parameter_sets.values("vaiont")["thickness"][1] == "fitted"
    assert parameter_sets.law("vaiont", thickness=0.02).values["thickness"] == 0.02
    with pytest.raises(SlipError, match="parameter set 'vajont': it must be one of vaiont"):
        parameter_sets.law("vajont")
    with pytest.raises(SlipError, match="it has no thicknes;"):
        parameter_sets.law("vaiont", thicknes=1)


def test_tables_of_formulas_are_what_the_formulas_are():
    fast = SlipLaw("tabulated", **parameter_sets.by_velocity(0.8, 0.1, 4.0))
    cells = fast.cells(3, 1.0)
    cells.slip_rate[:] = [0, 4, 1e9]
    assert np.allclose(fast.strength(cells), [0.8, 0.45, 0.1], atol=1e-3)
    far = SlipLaw("tabulated", **parameter_sets.by_slip(0.4, 0.5, -1 / 3))
    cells = far.cells(3, 1.0)
    cells.slip[:] = [0, 0.5, 13]
    assert np.allclose(far.strength(cells), [0.4, 0.4 * 2 ** (-1 / 3), 0.4 / 3], atol=4e-4)
    for wrong in (lambda: parameter_sets.by_velocity(1, 0, 0), lambda: parameter_sets.by_slip(1, -1, 0)):
        with pytest.raises(SlipError, match="above 0"):
            wrong()
