"""A heap that has come to rest stays there: over 20,000 steps overlaps do not add up and nothing creeps."""
import pytest
from yade import O

from contact_scenes import begin, box, engine, loose_heap, material, run, state


pytestmark = pytest.mark.usefixtures("empty")


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8])
def test_heap_rests_for_twenty_thousand_steps(tolerance):
    stuff = material(0.3, 0.1)
    box(stuff, 9.5, 12)
    disks = loose_heap(stuff)
    begin(dt=5e-3, tolerance=tolerance, maxIterations=1000)
    run(2000)  # 10 s of falling and settling
    e = engine()
    before, weight = state(disks), sum(O.bodies[d].state.mass for d in disks) * 9.81
    given, fallen = e.correctionEnergy, e.slidingLoss + e.rollingLoss + e.impactLoss
    worst = []
    for _ in range(20000):
        O.step()
        worst.append(e.overlapWorst)
    moved = max((s[0] - b[0]).norm() for s, b in zip(state(disks), before))
    correction = e.correctionEnergy - given
    # what all disks would gain by falling freely through each of these steps: the scale of an error of one step
    scale = 20000 * weight * 9.81 * O.dt**2
    print(
        f"\ntolerance {tolerance:g}: worst overlap {max(worst):.2e} l, moved {moved:.2e} m, correctionEnergy {given:.3g} J while falling "
        f"({given / fallen:.2e} of what was dissipated), {correction:.3g} J at rest ({correction / scale:.2e} of free fall)"
    )
    assert max(worst) < 1e-4 + 1e-4  # ℓ, what is left as it is, and as much again
    # and it does not grow, beyond what is left as it is
    assert max(worst[-5000:]) <= max(2 * max(worst[:5000]), 1.1e-4)
    assert moved < 5e-3  # m in 100 s: less than 1 % of a diameter
    assert abs(sum(O.forces.f(i)[1] for i in range(O.bodies[disks[0]].id)) / weight + 1) < 0.05
    assert given < 1e-3 * fallen
    # observed 6 tolerances in both cases: it is the solver's error that is taken back, and goes with it
    assert correction < 30 * tolerance * scale
