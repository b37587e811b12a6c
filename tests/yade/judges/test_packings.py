"""The quick variants of the checks of packings hold: friction of frictionless disks, statistics of forces."""
import numpy as np
import pytest
from yade.nonsmooth.judges.verification import packings
from yade.nonsmooth.judges.verification.registry import Bench


pytestmark = pytest.mark.usefixtures("empty")


@pytest.mark.parametrize("check", [packings.frictionless_packing, packings.force_network])
def test_quick_check_holds(check, tmp_path, cases_here):
    outcome = check(Bench(folder=tmp_path, quick=True, threads=1))
    for claim in outcome.claims:
        print(f"{claim.what}: {claim.measured:.6g} {claim.unit}, allowed {claim.low:.6g} to {claim.high:.6g}")
    assert outcome.claims and all(claim.passed for claim in outcome.claims)
    assert outcome.plots and outcome.tables


def test_exponents_of_a_known_distribution_are_found():
    dice = np.random.default_rng(1)
    # by inversion: density ∝ x^-0.3 on (0, 1), and 1 + an exponential with the rate 1.4
    low, high = dice.random(20000) ** (1 / 0.7), 1 + dice.exponential(1 / 1.4, 10000)
    shares = np.concatenate((low, high))
    for (found, error), known in ((packings.below_mean(shares, 0.01), 0.3), (packings.above_mean(shares), 1.4)):
        assert 0 < error < 0.03
        assert abs(found - known) < 4 * error
