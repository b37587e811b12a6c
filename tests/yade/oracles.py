"""Other people's programs that tests ask and that may be missing: the last line of the run then says what was not held,
and in CI it is an error.
"""
import os
import shutil

import numpy as np
import pytest
from yade.nonsmooth.judges.verification import siconos_solve


class _LastLine:
    """Says so after everything else that pytest prints."""

    def __init__(self, text):
        self.text = text

    def pytest_unconfigure(self):
        print(f"NOT HELD: {self.text}", flush=True)


def program(name, held):
    """Path of a program. Where it is not installed, the tests that want it are skipped; they fail where NONSMOOTH_CI is
    set. ``held``: what is not held without it.
    """
    path = shutil.which(name)
    if path is None:
        if os.environ.get("NONSMOOTH_CI"):
            pytest.fail(f"in CI every oracle must be there: {name} is not installed", pytrace=False)
        pytest.skip(f"{name} is not installed (apt install {name}): {held}")
    return path


def siconos(config):
    """Path of siconos_solve. Where it is not built, the tests that want it are skipped; they fail where NONSMOOTH_CI is
    set.
    """
    try:
        return siconos_solve.program()
    except siconos_solve.OracleError as missing:
        if os.environ.get("NONSMOOTH_CI"):
            pytest.fail(f"in CI every oracle must be there: {missing}", pytrace=False)
        if not config.pluginmanager.has_plugin("not held: Siconos"):
            config.pluginmanager.register(
                _LastLine(f"Siconos was not asked; its kept answers alone were. {missing}"), "not held: Siconos"
            )
        pytest.skip(str(missing))


def apart_from_siconos(problem, ours, folder):
    """The largest difference of velocities between Siconos's answer to one problem and our own to another [m/s, rad/s]."""
    theirs = siconos_solve.solve_with_siconos(problem, folder, 1e-10, 100000)
    return np.abs(theirs.velocity - siconos_solve.solve_with_ours(ours, 1e-10, 100000).velocity).max()
