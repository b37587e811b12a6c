"""Figures of energy, solver, cost and convergence, read from their artists. Needs no YADE."""

import types

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

figures, style, scale, refinement, energy = (
    synthetic.load(name)
    for name in (
        "figures",
        "figures.style",
        "judges.benchmark.scale_figure",
        "judges.verification.refinement",
        "measure.energy",
    )
)
TIMES = {"t0": 10.0, "t1": 40.0, "t2": 50.0, "t3": 60.0, "t4": 70.0, "t5": 90.0}
TIME = np.linspace(0, 100, 101)
# what each column is called and how it grows [J/m a second]; each begins at a value of its own, which is taken off
ENERGIES = {
    "energy_potential_J": ("potential", -5e9),
    "energy_sliding_J": ("lost by sliding", 2e9),
    "energy_rolling_J": ("lost by rolling", 1e9),
    "energy_impact_J": ("lost in impacts", 0.7e9),
    "energy_kinetic_J": ("kinetic", 0.6e9),
    "energy_water_J": ("work of pore water", -0.2e9),
    "energy_bonds_J": ("lost on bonds", 0.3e9),
    "energy_correction_J": ("overlap correction", 0.1e9),
}


def balance(factor=1.0, error=1e-4 * TIME):
    return {"time_s": TIME, "energy_error_rel": error} | {
        name: factor * (1e9 * k + rate * TIME) for k, (name, (_, rate)) in enumerate(ENERGIES.items())
    }


@pytest.mark.parametrize(
    "factor, unit, shown", [(1.0, "GJ", 1e9), (1e-3, "MJ", 1e6), (1e-6, "kJ", 1e3), (1e-9, "J", 1.0)]
)
def test_energies_are_changes_of_their_columns_in_a_fitting_unit(factor, unit, shown):
    above, _ = figures.energy(balance(factor)).axes
    assert above.get_ylabel() == f"energy [{unit}/m]"
    for name, rate in ENERGIES.values():
        got = drawn.points(drawn.line(above, name))
        assert got[:, 0].tolist() == TIME.tolist() and got[:, 1] == pytest.approx(
            factor * rate * TIME / shown, abs=1e-9
        ), name


def test_energies_are_told_apart_and_named():
    above, below = figures.energy(balance(), times=TIMES).axes
    lines = [one for one in above.lines if not one.get_label().startswith("_")]
    assert drawn.legend(above) == {one.get_label(): drawn.colour(one) for one in lines}
    assert (
        len(
            {
                (
                    drawn.colour(one),
                    str(one._unscaled_dash_pattern if hasattr(one, "_unscaled_dash_pattern") else one._us_dashes),
                )
                for one in lines
            }
        )
        == 8
    )

    def same(*names):
        return len({drawn.colour(drawn.line(above, name)) for name in names}) == 1

    assert same("lost by sliding", "lost by rolling", "lost in impacts") and not same("kinetic", "potential")
    assert [ax.get_title(loc="left") for ax in (above, below)] == [
        "Energy since the start",
        "Error of the balance, of all that is turned over",
    ]
    assert set(drawn.uprights(above)) == set(drawn.uprights(below)) == set(TIMES.values()) and above.get_xlim() == (
        0,
        100,
    )
    assert {t.get_text(): 100 * t.get_position()[0] for t in above.texts} == pytest.approx(
        {f"$t_{{{name[1]}}}$": at for name, at in TIMES.items()}
    )
    assert below.get_xlabel() == "time [s]" and (0, "#555555") in drawn.levels(above)


# of the balance above: what was turned over until a row, and by the last one, the losses of which are the larger [GJ/m]
UNTIL = (1 + 2 + 3 + 6) + 4 + (2 + 1 + 0.7 + 0.3 + 0.6) * TIME + abs(5 - 0.2 * TIME)
IN_ALL = (1 + 2 + 3 + 6) + (2 + 1 + 0.7 + 0.3) * TIME[-1]


@pytest.mark.parametrize("error, limit", [(1e-4 * TIME, 0.02), (-5e-4 * TIME, 0.01)])
def test_the_error_is_in_per_cent_with_its_limit(error, limit):
    _, below = figures.energy(balance(error=error), limit=limit).axes
    (curve,) = (one for one in below.lines if len(one.get_xdata()) == len(TIME))
    shown = 100 * error * UNTIL / IN_ALL
    assert drawn.points(curve)[:, 1] == pytest.approx(shown) and below.get_ylabel() == "error [%]"
    orange = style.LINES["orange"].lower()
    assert sorted(drawn.levels(below)) == [(-100 * limit, orange), (0, "#555555"), (100 * limit, orange)]
    words = drawn.text(below, "limit")
    assert words.get_text() == f"limit {100 * limit:g} %" and words.get_position()[1] == 100 * limit
    reach = 1.3 * max(100 * limit, abs(shown).max())
    assert below.get_ylim() == pytest.approx((-0.05 * reach if error[-1] > 0 else -reach, reach))


def test_an_error_of_next_to_nothing_is_small():
    """A slope that stands has turned over a joule when its balance is half a joule off, and an avalanche's gigajoule
    later: half a billionth.
    """
    rest = {name: np.zeros(3) for name in balance()} | {"time_s": np.arange(3.0)}
    rest |= {"energy_sliding_J": np.array([0.0, 1.0, 1e9]), "energy_error_rel": np.array([0.0, 0.5, 0.0])}
    assert energy.balance_error(rest) == pytest.approx([0, 0.5e-9, 0]) and energy.turned_over(rest) == 1e9
    falling = rest | {"energy_kinetic_J": np.array([0.0, 4e9, 0.0])}
    assert energy.turned_over(falling) == 4e9  # what moves now has been turned over, lost or not
    assert energy.balance_error(falling)[1] == pytest.approx(0.5 * (1 + 4e9) / 4e9)


def solved(**changes):
    """Sweeps that rise, residuals within the tolerance in three of four rows, overlaps in a millionth a second."""
    residual = np.where(np.arange(101) % 4 == 3, 3e-6, 0.5e-6)
    return {
        "time_s": TIME,
        "iterations": 50 + TIME,
        "residual": residual,
        "tolerance": np.where(TIME < 60, 1e-6, 2e-6),
        "overlap_worst_rel": 2e-4 * TIME,
        "overlap_mean_rel": 1e-5 * TIME,
        **changes,
    }


def test_sweeps_residual_and_overlap_are_their_columns():
    fig = figures.solver(solved(), times=TIMES)
    sweeps, residual, overlap = fig.axes
    assert [(ax.get_title(loc="left"), ax.get_ylabel(), ax.get_yscale()) for ax in fig.axes] == [
        ("Sweeps per step", "sweeps", "linear"),
        ("Residual at the end of the step", "residual [-]", "log"),
        ("Overlap of the contacts", "overlap [% of $\\ell$]", "log"),
    ]
    dots, mean = (drawn.points(one) for one in sweeps.lines if len(one.get_xdata()) == 101)
    assert (
        dots[:, 1].tolist() == (50 + TIME).tolist()
        and mean[:, 1] == pytest.approx(50 + TIME)
        and list(drawn.legend(sweeps)) == ["mean 100"]
    )
    assert sweeps.get_ylim() == pytest.approx((0, 165))
    tolerance = drawn.line(residual, "tolerance, kept by\n75 % of the steps")  # 76 of 101
    assert drawn.points(tolerance)[:, 1].tolist() == solved()["tolerance"].tolist()
    (dots,) = (one for one in residual.lines if one.get_marker() == ".")
    assert drawn.points(dots)[:, 1].tolist() == solved()["residual"].tolist() and drawn.colour(dots) != drawn.colour(
        tolerance
    )
    for name, rate, limit in (("worst", 2e-2, 2.0), ("mean", 1e-3, 0.1)):
        one, level = drawn.line(overlap, name), drawn.line(overlap, f"limit {limit:g} %")
        # a logarithm has no 0
        assert drawn.points(one)[1:, 1] == pytest.approx(rate * TIME[1:]) and np.isnan(one.get_ydata()[0])
        assert level.get_ydata()[0] == limit and drawn.colour(level) == drawn.colour(one) == drawn.legend(overlap)[name]
    assert drawn.legend(overlap)["worst"] != drawn.legend(overlap)["mean"]
    assert all(set(drawn.uprights(ax)) == set(TIMES.values()) for ax in fig.axes)


def test_a_residual_of_nothing_is_drawn_at_the_least_that_there_is():
    residual = np.where(TIME < 50, 0.0, 1e-7)
    (dots,) = (one for one in figures.solver(solved(residual=residual)).axes[1].lines if one.get_marker() == ".")
    assert set(dots.get_ydata()) == {1e-7}
    still = {name: np.zeros(101) for name in solved()} | {"time_s": TIME}
    (dots,) = (one for one in figures.solver(still).axes[1].lines if one.get_marker() == ".")
    assert set(dots.get_ydata()) == {1e-16}


def test_nothing_that_moves_can_be_drawn():
    still = {name: np.zeros(101) for name in balance()} | {"time_s": TIME}
    above, below = figures.energy(still).axes
    assert above.get_ylabel() == "energy [J/m]" and below.get_ylim() == pytest.approx((-0.13, 2.6))


# ---- cost and convergence -------------------------------------------------------------------------


def test_cost_by_size():
    sizes = [
        {
            "disks": n,
            "sweep_ns_per_contact": {"1": {"median": 40.0 + k}, "12": {"median": 9.0 + k}, "2": {"median": 22.0 + k}},
            "step_ms": {"median": 2e-3 * n},
            "bytes_per_contact": 2100 + k,
            "bytes_per_contact_viewed": 2900 + k,
            "packing_s": 0.01 * n,
        }
        for k, n in enumerate((100, 1000))
    ]
    fig = scale.cost_by_size(sizes)
    fig.draw_without_rendering()  # formulae that cannot be read show here
    step, sweep, memory, packing = fig.axes
    assert [(ax.get_title(loc="left"), ax.get_ylabel()) for ax in fig.axes] == [
        ("A step", "time [ms]"),
        ("A sweep, for each contact", "time [ns]"),
        ("Memory, for each contact", "memory [kB]"),
        ("Packing", "time [s]"),
    ]
    assert [ax.get_xlabel() for ax in fig.axes] == ["", "", "disks", "disks"] and all(
        ax.get_xscale() == "log" for ax in fig.axes
    )
    for ax, values in ((step, (0.2, 2.0)), (packing, (1.0, 10.0))):
        measured, proportional = (drawn.points(one) for one in ax.lines)
        assert (
            measured == pytest.approx(np.column_stack([(100, 1000), values]))
            and proportional == pytest.approx(measured)
            and ax.get_yscale() == "log"
        )
    assert drawn.points(drawn.line(sweep, "1 thread"))[:, 1].tolist() == [40, 41] and drawn.points(
        drawn.line(sweep, "2 threads")
    )[:, 1].tolist() == [22, 23]
    bare, viewed = (drawn.line(memory, name) for name in ("nobody has looked", "all have an interaction"))
    assert drawn.points(bare)[:, 1] == pytest.approx([2.1, 2.101]) and drawn.points(viewed)[:, 1] == pytest.approx(
        [2.9, 2.901]
    )
    assert drawn.legend(memory) == {
        one.get_label(): drawn.colour(one) for one in (bare, viewed)
    } and memory.get_ylim() == pytest.approx((0, 1.25 * 2.901))


def test_a_sweep_of_time_steps_shows_seeds_mean_and_the_default(tmp_path):
    swept = refinement.Sweep(
        "time step", "s", 0.01, {0.005: {1: 100.0, 2: 200.0}, 0.01: {1: 110.0, 2: 210.0}, 0.02: {1: 130.0, 2: 240.0}}
    )
    fig = refinement.sheet(
        types.SimpleNamespace(folder=tmp_path), "s.png", "Strength", [(swept, 1e-3, "strength [kPa]")]
    )
    assert (tmp_path / "s.png").stat().st_size > 0 and fig._suptitle.get_text() == "Strength"
    (ax,) = fig.axes
    assert (
        ax.get_ylabel() == "strength [kPa]"
        and ax.get_xlabel() == "time step [s]"
        and list(drawn.uprights(ax)) == [0.01]
    )
    assert [t.get_text() for t in ax.get_xticklabels()] == ["0.005", "0.01", "0.02"]
    thin = [drawn.points(one) for one in ax.lines if one.get_alpha() == 0.5]
    assert thin[0] == pytest.approx(np.array([[0.005, 0.1], [0.01, 0.11], [0.02, 0.13]])) and thin[1][
        :, 1
    ] == pytest.approx([0.2, 0.21, 0.24])
    (mean, _, (whiskers,)) = ax.containers[0]
    assert drawn.points(mean)[:, 1] == pytest.approx([0.15, 0.16, 0.185])
    # the standard error of two values is half their difference
    assert [np.ptp(s[:, 1]) / 2 for s in whiskers.get_segments()] == pytest.approx(
        [0.05, 0.05, 0.055]
    ) and ax.get_ylim() == pytest.approx((0, 1.2 * 0.24))
    relative = refinement.sheet(
        types.SimpleNamespace(folder=tmp_path), "s.png", "Strength", [(swept, 1e-3, "change [%]")] * 2, relative=True
    )
    for ax in relative.axes:
        assert [drawn.points(one)[:, 1] for one in ax.lines if one.get_alpha() == 0.5] == [
            pytest.approx([0, 10 / 1.5, 20]),  # over the mean of the finest, 150
            pytest.approx([0, 10 / 1.5, 40 / 1.5]),
        ]
        assert drawn.points(ax.containers[0][0])[:, 1] == pytest.approx(
            [0, 10 / 1.5, 35 / 1.5]
        ) and ax.get_ylim() == pytest.approx((-32, 32))


def test_changes_are_over_the_mean_of_the_reference_and_of_the_same_seeds():
    """A slope that does not stand counts with the 0 m of water that it bears."""
    values = {1.0: {1: 10.0, 2: 0.0}, 10.0: {1: 13.0, 2: 4.0, 3: 99.0}, 20.0: {1: 14.0, 2: 5.0}}
    swept = refinement.Sweep("tolerance", "-", 1.0, values)
    # 3 and 4 m over a mean of 5 m: 0.7, and half their difference as its standard error
    assert swept.change(10.0, 1.0) == pytest.approx((0.7, 0.1))
    # 20 is coarser than ten times the default
    assert swept.largest_step() == pytest.approx((0.7, 0.1))
    steep = refinement.Sweep("tolerance", "-", 2.0, values | {20.0: {1: 40.0, 2: 40.0}})
    assert steep.largest_step() == pytest.approx((((40 - 13) + (40 - 4)) / 17, abs(36 - 27) / 17))


def test_time_is_that_of_the_series():
    """A series that begins at 20 s, as one since the dry rest does."""

    def late(series):
        return {name: values + 20 if name == "time_s" else values for name, values in series.items()}

    for fig in (
        figures.energy(late(balance()), times={"t1": 60.0}),
        figures.solver(late(solved()), times={"t1": 60.0}),
    ):
        for ax in fig.axes:
            assert ax.get_xlim() == (20, 120) and list(drawn.uprights(ax)) == [60]
            assert all(one.get_xdata().tolist() == (TIME + 20).tolist() for one in ax.lines if len(one.get_xdata()) > 2)
        assert [t.get_position()[0] for t in fig.axes[0].texts] == [pytest.approx(0.4)]
