"""The quick checks of single contacts, bonds and impacts, and the framework that runs checks."""
import json
import math

import docutils.core
import pytest
import shell
from matplotlib.figure import Figure
from yade import O
from yade.nonsmooth.judges import verification
from yade.nonsmooth.judges.verification import Claims, Findings, paper, registry, report, runner
from yade.nonsmooth.system import keys

from contact_scenes import material
from held_claims import failed

near, between, at_most, at_least = (getattr(Claims(), kind) for kind in ("near", "between", "at_most", "at_least"))
OURS = ("contacts", "bonds", "impacts", "impact_chains", "water", "thermal")


ALL = {c.name: c for c in verification.load_checks()}
#: Checks whose quick form is run by itself; those of Siconos stand in test_siconos.
OTHERS = (
    "whole-avalanche",
    "slope-convergence",
    "sweeps-to-a-residual",
    "sweeps-in-a-running-scene",
    "ways-to-solve",
    "sweeps-by-thickness",
    "collapse-of-rounded-places",
    "priests-block",
    "published-slopes",
    "shaken-blocks",
    "shaken-slope",
    "shaken-frames",
    "paper",
    "still-water-on-a-face",
    "states-in-time",
    "parallel-seepage",
    "vertical-cuts",
    "floating-grains",
)
QUICK = [c.name for c in ALL.values() if c.group in OURS and c.name not in OTHERS and c.quick_seconds is not None]


pytestmark = pytest.mark.usefixtures("empty")


def verify(*arguments):
    """Runs the command in a process of its own; with one thread, as for scenes of a few bodies two would only wait for
    each other.
    """
    return shell.run("verify.py", *arguments, "--threads", 1)


@pytest.fixture(scope="module")
def quick_run(tmp_path_factory):
    """The folder of one run of all quick checks, and the ended command."""
    out = tmp_path_factory.mktemp("verify")
    return out, verify("--out", str(out), "--quick", "--only", *QUICK)


@pytest.mark.parametrize("name", QUICK)
def test_quick_check_holds(name, quick_run):
    # one that stopped is run again, here
    (result,) = runner.run_checks([ALL[name]], quick_run[0], quick=True, resume=True)
    assert not result.error, (quick_run[0] / "checks" / name / "error.txt").read_text()
    assert result.claims and not failed(result.claims), failed(result.claims)


@pytest.mark.parametrize("name", OTHERS)
def test_quick_form_of_a_long_check_holds(name, tmp_path, cases_here):
    assert ALL[name].quick_seconds is not None
    (result,) = runner.run_checks([ALL[name]], tmp_path, quick=True)
    assert not result.error, (tmp_path / "checks" / name / "error.txt").read_text()
    assert result.claims and not failed(result.claims), failed(result.claims)


def test_every_other_check_has_a_quick_form():
    # these do not hold at a looser tolerance; scripts/verify.py runs them in full
    assert [c.name for c in ALL.values() if c.quick_seconds is None] == [
        "siconos-slope-at-failure",
        "siconos-avalanche",
    ]


def test_strength_of_a_bonded_sample_converges(tmp_path, cases_here):
    (result,) = runner.run_checks([ALL["strength-convergence"]], tmp_path, quick=True)
    assert not result.error
    assert len(result.claims) == 6 and not failed(result.claims), failed(result.claims)


@pytest.mark.parametrize("name", [c.name for c in ALL.values() if c.group in OURS])
def test_derivation_is_sound_markup(name):
    docutils.core.publish_parts(
        ALL[name].derivation, writer_name="html5", settings_overrides={"halt_level": 2, "report_level": 2}
    )


# ---- claims ---------------------------------------------------------------------------------------


def test_claims_are_two_sided_and_say_why():
    assert near("x", 1.05, 1, absolute=0.05 + 1e-12, why="w").passed
    assert near("x", -1.01, -1, relative=0.02, why="w").passed  # relative to the magnitude
    assert (
        not near("x", 1.03, 1, relative=0.02, why="w").passed and not near("x", 0.97, 1, relative=0.02, why="w").passed
    )
    assert between("x", 2, 2, 3, why="w").passed and not between("x", 3.1, 2, 3, why="w").passed
    # an error cannot be negative
    assert at_most("x", 0, 1, why="w").passed and not at_most("x", -1e-9, 1, why="w").passed
    assert at_least("x", 1e300, 1, why="w").passed and not at_least("x", 0.5, 1, why="w").passed
    with pytest.raises(ValueError, match="does not say why"):
        near("x", 1, 1, "")
    with pytest.raises(ValueError, match="allows nothing"):
        between("x", 1, 3, 2, why="w")


def test_a_claim_has_its_unit_from_the_brackets_behind_its_name():
    claims = Claims(against="a table")
    claims.near("speed [of light] at noon [m/s]", 1, 1, "w")
    claims.at_most("speed [of light] at noon", 1, 1, "w", against="a clock")
    assert [(c.what, c.unit, c.against) for c in claims] == [
        ("speed [of light] at noon", "m/s", "a table"),
        ("speed [of light] at noon", "", "a clock"),
    ]


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_a_number_never_passes(value):
    assert not at_least("x", value, -math.inf, why="w").passed


def test_an_outcome_without_claims_does_not_pass():
    assert not Findings().passed
    good, bad = near("x", 1, 1, why="w"), near("x", 2, 1, why="w")
    assert Findings([good]).passed and not Findings([good, bad]).passed


# ---- the statements of the paper's section 6 ------------------------------------------------------


def failing(**changes):
    """The statements whose claim does not hold, where all numbers are in the middle of what is claimed but for
    ``changes``, lists of one value a packing.
    """
    middle = {name: [0.5 * (said.low + said.high)] * 3 for name, said in paper.STATEMENTS.items()}
    claims = paper.claims_of(middle | changes)
    return [name for name, claim in zip(paper.STATEMENTS, claims, strict=True) if not claim.passed]


def test_a_foot_that_loses_its_strength_before_the_slope_accelerates_fails_its_claim():
    """The force on FB may fall by a twentieth from its largest value until t2, in the mean over packings; it cannot
    fall by less than nothing.
    """
    assert failing() == []
    assert failing(backstop_fall=[0.12, 0.01, 0.019]) == []  # 4.97 % in the mean
    for values in ([0.12, 0.01, 0.021], [0.25, 0.25, 0.25], [-0.01, 0.0, 0.0]):
        assert failing(backstop_fall=values) == ["backstop_fall"]
    assert failing(backstop_fall=[0.01, None, 0.01]) == ["backstop_fall"]  # a packing that did not come to t2


@pytest.mark.parametrize("name", paper.STATEMENTS)
def test_every_statement_can_fail_on_both_sides(name):
    said = paper.STATEMENTS[name]
    span = said.high - said.low
    assert failing(**{name: [said.low - 0.01 * span]}) == failing(**{name: [said.high + 0.01 * span]}) == [name]


@pytest.mark.parametrize(
    "lengths, holds", [([64.7], True), ([0.0, 0.9], False), ([140.0, 170.0], False), ([None], False)]
)
def test_the_foot_of_dp_keeps_its_strength_and_no_more_of_it(lengths, holds):
    assert paper.wedge_claim(lengths).passed is holds


# ---- registry and runner --------------------------------------------------------------------------


def made(run, name="made"):
    return registry.Check(name, "Made by a test", "Tests", "Nothing to derive.", 1.0, 1.0, run)


@pytest.fixture
def no_checks(monkeypatch):
    monkeypatch.setattr(registry, "_checks", {})


def test_a_check_has_a_docstring_and_a_name_of_its_own(no_checks):
    def undocumented(bench):
        return Findings()

    def one_check(bench):
        """Something."""

    with pytest.raises(ValueError, match="no docstring"):
        registry.check("t", subject="s")(undocumented)
    registry.check("t", subject="s", seconds=7, quick=None)(one_check)
    with pytest.raises(ValueError, match="two checks named one-check"):
        registry.check("t", subject="s")(one_check)
    assert [(c.name, c.seconds, c.quick_seconds) for c in registry.registered()] == [("one-check", 7, None)]


def test_an_error_is_kept_and_the_next_check_runs(tmp_path):
    def stops(bench):
        material(0.3)
        raise RuntimeError("the disk is square")

    def empty_scene(bench):
        return Findings([near("materials in a fresh scene", len(O.materials), 0, why="a count")])

    first, second = runner.run_checks([made(stops, "stops"), made(empty_scene, "empty")], tmp_path)
    assert not first.passed and first.error == "RuntimeError: the disk is square"
    assert "Traceback" in (tmp_path / "checks" / "stops" / "error.txt").read_text()
    assert second.passed


def test_resume_takes_over_what_has_finished(tmp_path, monkeypatch):
    calls = []

    def counted(bench):
        calls.append(bench.quick)
        figure = Figure()
        figure.add_subplot().plot([0, 1])
        return Findings(
            [near("x", 1, 1, why="w"), at_least("y", math.nan, 0, why="w")],
            plots=[(figure, "a line")],
            tables=[("t", ["a"], [["1"]])],
            remarks=["r"],
        )

    def failing(bench):
        calls.append("failing")
        raise ValueError("no")

    checks = [made(counted, "counted"), made(failing, "failing")]
    first = list(runner.run_checks(checks, tmp_path))
    again = list(runner.run_checks(checks, tmp_path, resume=True))
    assert calls == [False, "failing", "failing"]  # an error is tried again
    assert (
        again[0].claims[0] == first[0].claims[0]
        and math.isnan(again[0].claims[1].measured)
        and again[0].claims[1].high == math.inf
    )
    assert (again[0].plots, again[0].remarks, again[0].wall_s) == (first[0].plots, first[0].remarks, first[0].wall_s)
    assert [c.passed for c in again[0].claims] == [True, False]
    list(runner.run_checks(checks[:1], tmp_path, quick=True, resume=True))
    assert calls[-1] is True  # a quick run is not a full one
    with monkeypatch.context() as other:
        other.setattr(keys, "statements", lambda path: "others")
        list(runner.run_checks(checks[:1], tmp_path, quick=True, resume=True))
        assert len(calls) == 5  # that of other code is run again
    calls.pop()
    (tmp_path / "checks" / "counted" / "result.json").write_text("{")
    list(runner.run_checks(checks[:1], tmp_path, quick=True, resume=True))
    assert len(calls) == 5  # what cannot be read is run
    assert json.loads((tmp_path / "checks" / "counted" / "result.json").read_text())["claims"][0]["passed"] is True


def test_report_shows_claims_plots_and_errors(tmp_path):
    def good(bench):
        figure = Figure()
        figure.add_subplot().plot([0, 1])
        return Findings(
            [near("speed < light [m/s]", 1, 1, why="w")],
            plots=[(figure, "a line")],
            tables=[("a table", ["head"], [["cell"]])],
            remarks=["a remark"],
        )

    def off(bench):
        return Findings([at_most("error", 2, 1, why="w")])

    def stops(bench):
        raise RuntimeError("the disk is square")

    results = list(runner.run_checks([made(good, "good"), made(off, "off"), made(stops, "stops")], tmp_path))
    page = report.write_report(tmp_path / "report.html", results, quick=True, versions={"YADE": "1"}).read_text()
    for text in (
        "speed &lt; light",
        "data:image/png;base64,",
        "a table",
        "cell",
        "a remark",
        "FAIL",
        "the disk is square",
        "quick subset",
        "2 of 2 claims do not hold",
        "Nothing to derive",
        "YADE 1",
    ):
        assert text in page, text


# ---- the command ----------------------------------------------------------------------------------


def test_command_refuses_an_unknown_check(tmp_path):
    ended = verify("--out", str(tmp_path / "out"), "--only", "perpetual-motion")
    assert ended.returncode != 0 and "perpetual-motion" in ended.stderr and "--list" in ended.stderr
    assert not (tmp_path / "out").exists()


def test_command_writes_the_report(quick_run):
    out, ended = quick_run
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert f"{len(QUICK)} of {len(QUICK)} checks hold" in ended.stdout
    page = (out / "report.html").read_text()
    for name in QUICK:
        assert f'<section id="{name}">' in page
