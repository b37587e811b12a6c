"""Sphinx of yade-nonsmooth. Built inside YADE (the target "doc"), so that the reference can ask the classes
themselves.
"""
import glob
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, os.path.join(HERE, "ext"))

project = "yade-nonsmooth"
author = "the authors of yade-nonsmooth"
with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as _file:
    release = re.search(r"project\(yade-nonsmooth VERSION ([\d.]+)", _file.read()).group(1)
version = release

extensions = [
    "sphinx.ext.autodoc",
    "sphinx_copybutton",
    "sphinxcontrib.bibtex",
    "nbsphinx",  # notebooks, with the results that they were written with
    "bibliography",  # references in a page that closes what it opens
    "mathml",  # equations, without a network
    "yade_reference",  # classes of the plugin, from their docstrings
    "package_modules",  # modules of the package, from their docstrings
    "section_keys",  # keys of a section file, from the schema
    "records_columns",  # columns of series.csv, from the package
    "needed_packages",  # what a plain Python needs, from the package's list
    "measured",  # numbers and tables, from files that commands wrote
    "pictures",  # figures that a run has made, where they are there
    "checked_script",  # the README's script is the one that the tests run
]

needs_sphinx = "5.3"
default_role = "literal"  # `name` in the package's docstrings
highlight_language = "none"  # code blocks name theirs
exclude_patterns = ["ext", "figures", "measured", "examples", "notebooks/out", "**.ipynb_checkpoints"]
bibtex_bibfiles = ["references.bib"]
bibtex_default_style = "alpha"
nbsphinx_execute = "never"
copybutton_prompt_text = "$ "
smartquotes = False  # 'zXY' and --resume are code
math_eqref_format = "({number})"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"

html_math_renderer = "mathml"
html_theme = "furo"
html_title = f"yade-nonsmooth {release}"
html_static_path = ["static"]
html_css_files = ["pages.css"]
html_show_sourcelink = False
html_show_copyright = False
html_theme_options = {"sidebar_hide_name": False}


def forget_copied_notebooks(app):
    """Removes the notebooks that a build before copied here: nbsphinx copies without force, and Sphinx 8 does not
    overwrite.
    """
    for copy in glob.glob(os.path.join(app.outdir, "**", "*.ipynb"), recursive=True):
        os.remove(copy)


def setup(app):
    app.connect("builder-inited", forget_copied_notebooks)
