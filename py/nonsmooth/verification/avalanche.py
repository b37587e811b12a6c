"""A whole avalanche: energy, residuals, bonds."""

from __future__ import annotations

import dataclasses

import numpy as np

from .. import experiment, figures, packing, records, results, section, slope, tables
from . import Outcome, at_most, check, near

SUBJECT = "A whole avalanche"


@check("Energy, residuals and broken bonds of the rain-triggered avalanche", subject=SUBJECT, seconds=240, quick=None)
def whole_avalanche(bench):
    """The slope of Jiufengershan from its first step to its deposit, with larger disks than the paper's.

    Kinetic and potential energy change by the work of the pore water and of driven walls, less what contacts dissipate by sliding, by
    rolling, in impacts and on bonds. Each of these is summed on its own, as the work of the step's impulses over the mean of the velocities
    before and after it, which is exact for constant masses. What is left over is the error of the balance; only the rounding of the
    positions' update (potential energy of a parabola taken in steps) can be in it. The overlap correction pushes disks apart and so adds
    energy; the balance counts it within the impacts, and it is shown on its own, because it is not physics.

    The solver may make 1,000 sweeps a step here, instead of the section's 300.
    """
    count = 3000
    s = section.load("jiufengershan").with_disks(count)
    # a foot a few disks thick yields for many seconds, and 300 sweeps are then often too few for the tolerance
    s = dataclasses.replace(s, numerics=dataclasses.replace(s.numerics, max_iterations=1000))
    folder = bench.folder / "run"
    folder.mkdir(exist_ok=True)
    run = experiment.Experiment(slope.build(s, packing.cached_pack(s)), folder)
    run.progress = lambda stage, now, foreseen: bench.progress(f"{stage}, {now:.0f} of {foreseen:.0f} s")
    run.run()
    engine = run.slope.solver
    state = {**vars(run.state), "overlap_worst_ever": engine.overlapWorstEver}
    summary = results.summarise(folder, s, state)
    series = results.chosen_rows(records.read_series(folder / "series.csv"), state)
    log = tables.breaks(engine)

    losses = {name: series[name] for name in records.LOSSES}
    total = sum(losses.values())
    turned = max(total[-1], series["energy_kinetic_J"].max())
    falls = max(float(np.max(np.maximum.accumulate(v) - v)) for v in losses.values())
    broken = sum(int(series[f"bonds_broken_{mode}"][-1]) for mode in ("tension", "shear", "torque", "mixed"))
    table = [(name.split("_")[1], f"{v[-1]:.4g}", f"{100 * v[-1] / total[-1]:.2f} %") for name, v in losses.items()]
    table += [("all losses", f"{total[-1]:.4g}", "100 %"),
              ("potential energy released", f"{series['energy_potential_J'][0] - series['energy_potential_J'][-1]:.4g}", ""),
              ("work of the pore water", f"{series['energy_water_J'][-1]:.4g}", ""),
              ("work of driven walls", f"{series['energy_walls_J'][-1]:.4g}", ""),
              ("added by the overlap correction", f"{series['energy_correction_J'][-1]:.4g}", f"{100 * summary['energy_correction_rel']:.2f} %")]
    claims = [
        at_most("largest error of the energy balance, of the energy turned over", summary["energy_error_rel"], 0.01,
                why="the project's limit; larger errors could hide a loss that is not accounted for"),
        at_most("largest fall of a loss that should only grow, of the energy turned over", falls / turned, 1e-3,
                why="rounding and unfinished solves may return a little energy, a wrong sign would return all of it"),
        at_most("energy added by the overlap correction, of the energy turned over", summary["energy_correction_rel"], 0.05,
                why="it is spurious; a twentieth changes a runout, which goes with the energy, by no more than that"),
        near("95th percentile of the step's independent residual over the tolerance asked for", summary["residual_p95_over_tolerance"], 0.75,
             absolute=0.25, against="definition", why="a step ends below its tolerance, and at ten sweeps between two looks not far below"),
        near("rows in the log of broken bonds", len(log["step"]), broken, against="the engine's counters", why="each break is one row"),
        near("bonds that hold at the end and broken ones", int(series["bonds_alive"][-1]) + broken, run.state.bonds_initial,
             against="bonds made", why="a bond holds or is broken"),
    ]
    figures.energy(series, bench.folder / "energy.png", times=summary["times_s"], limit=0.01)
    figures.solver(series, bench.folder / "solver.png", times=summary["times_s"])
    return Outcome(
        claims,
        plots=[(bench.folder / "energy.png", f"Energies of an avalanche of about {count} disks."),
               (bench.folder / "solver.png", "What the solver needed and left in the same run; the tolerance is looser while the slope moves.")],
        tables=[("Where the energy went [J/m]", ("", "J/m", "of the losses"), table)],
        remarks=[f"The run took {summary['wall_s']:.0f} s; its failure came at {summary['water_at_failure_m']:.1f} m of water. "
                 "With so few disks a slope fails earlier than with the paper's; the gallery shows the paper's size."])
