"""Other people's solvers that tests ask and that may be missing: the last line of the run then says what was not held, and in CI it is an error."""
import os

import pytest
from yade.nonsmooth.verification import siconos_solve


class _LastLine:
    """Says so after everything else that pytest prints."""

    def __init__(self, text):
        self.text = text

    def pytest_unconfigure(self):
        print(f"NOT HELD: {self.text}", flush=True)


def siconos(config):
    """Path of siconos_solve. Where it is not built, the tests that want it are skipped; they fail where NONSMOOTH_CI is set."""
    try:
        return siconos_solve.program()
    except siconos_solve.OracleError as missing:
        if os.environ.get("NONSMOOTH_CI"):
            pytest.fail(f"in CI every oracle must be there: {missing}", pytrace=False)
        if not config.pluginmanager.has_plugin("not held: Siconos"):
            config.pluginmanager.register(_LastLine(f"Siconos was not asked; its kept answers alone were. {missing}"), "not held: Siconos")
        pytest.skip(str(missing))
