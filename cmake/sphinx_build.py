"""sphinx-build inside YADE (run by scripts/yade-nonsmooth), so that the reference can be taken from docstrings."""
import sys

from sphinx.cmd.build import main

sys.exit(main(sys.argv[1:]))
