"""Runs a YADE script of soft contacts with rigid ones, for ``yade-nonsmooth --hard`` and ``--both``, which see to its arguments."""
import os as _os
import sys as _sys

from yade.nonsmooth.world.hardening import comparison as _comparison

_how, _path, _sys.argv = _comparison.asked(_sys.argv)
if _how.both:
    _sys.exit(_comparison.both(_how, _path, _sys.argv))
_watch = _comparison.begin(_how)
__file__ = _path
_sys.path.insert(0, _os.path.dirname(_os.path.abspath(_path)))
try:
    with open(_path) as _source:
        _text = _source.read()
    globals().update(_comparison.stand_ins(_text))
    exec(compile(_text, _path, "exec"), globals())
except SystemExit:
    pass
except _comparison.HardenError as _refusal:
    _sys.exit(f"HardenError: {_path}: {_refusal}")
_comparison.end(_how, _watch, O)
