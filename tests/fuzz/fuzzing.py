"""What the tests of broken files share."""

import contextlib
import math
import os
import signal

import hypothesis


def settings(variable, default, share=1.0):
    """Hypothesis' settings: the same examples each time; the environment's ``variable``, times ``share``, says how
    many.
    """
    count = math.ceil(share * int(os.environ[variable])) if variable in os.environ else default
    return hypothesis.settings(
        max_examples=count,
        derandomize=True,
        deadline=None,
        database=None,
        print_blob=False,
        suppress_health_check=list(hypothesis.HealthCheck),
        phases=[hypothesis.Phase.explicit, hypothesis.Phase.generate, hypothesis.Phase.shrink],
    )


@contextlib.contextmanager
def at_most(seconds):
    """Raises where the block takes longer, as one that hangs does."""

    def late(*_):
        raise AssertionError(f"still not done after {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
