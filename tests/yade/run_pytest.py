"""Runs pytest inside YADE: scripts/yade-nonsmooth tests/yade/run_pytest.py [PYTEST ARGUMENTS]."""
import os
import sys

import pytest

here = os.path.dirname(os.path.realpath(sys.argv[0]))
arguments = sys.argv[1:]
if not any(os.path.exists(a.split("::")[0]) for a in arguments):
    arguments.append(here)
sys.exit(int(pytest.main(["-ra", "--rootdir=" + here, "-p", "no:cacheprovider", *arguments])))
