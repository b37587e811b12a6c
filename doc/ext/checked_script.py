"""Warns unless the README holds the script of doc/examples word for word (the tests run that file)."""
import pathlib
import re

from sphinx.util import logging

log = logging.getLogger(__name__)
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = "doc/examples/falling_block.py"


def check(app):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    script = (ROOT / SCRIPT).read_text(encoding="utf-8")
    if script.strip() not in [block.strip() for block in re.findall(r"```python\n(.*?)```", readme, re.S)]:
        log.warning("the script in README.md is not that of %s: copy it there", SCRIPT)


def setup(app):
    app.connect("builder-inited", check)
    return {"parallel_read_safe": True}
