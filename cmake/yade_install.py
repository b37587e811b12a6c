#!/usr/bin/python3
"""Read what CMake needs to know of a YADE install, and lay out a prefix of links to it.

    yade_install.py query CONFIG.PY            prints NAME=value lines
    yade_install.py prefix LIBDIR NEW_LIBDIR   links every file of LIBDIR below NEW_LIBDIR
"""
import os
import runpy
import sys
import tempfile


def query(config):
    # The install's own config.py is the only place that lists its features. It looks at the
    # home folder (and would move an old ~/.yade), so it is given an empty one.
    os.environ.pop("YADE_PREFIX", None)
    os.environ.pop("XDG_CONFIG_HOME", None)
    with tempfile.TemporaryDirectory() as home:
        os.environ["HOME"] = home
        values = runpy.run_path(config)
    print("version=" + values["version"])
    print("features=" + ";".join(f for f in values["features"] if f))
    print("realBits=%d" % values["highPrecisionBits"])
    print("realDigits=%d" % values["highPrecisionDecimalPlaces"])
    print("mpmath=%d" % bool(values["highPrecisionMpmath"]))
    print("python=%d.%d" % sys.version_info[:2])


def prefix(library_dir, new_dir):
    # Real folders with links to files: YADE walks libDir without following links to folders.
    # The plugin's own files are left out: an installed plugin must not replace that of the build tree.
    own = ("libnonsmooth.so", "nonsmooth_engines.so", "nonsmooth", "__pycache__")
    wanted = set()
    for root, dirs, files in os.walk(library_dir):
        dirs[:] = [d for d in dirs if d not in own]
        files = [f for f in files if f not in own]
        target = os.path.join(new_dir, os.path.relpath(root, library_dir))
        os.makedirs(target, exist_ok=True)
        for name in files:
            link = os.path.normpath(os.path.join(target, name))
            wanted.add(link)
            source = os.path.join(root, name)
            if os.path.islink(link) and os.readlink(link) == source:
                continue
            if os.path.lexists(link):
                os.remove(link)
            os.symlink(source, link)
    # links left over from an earlier install
    for root, _, files in os.walk(new_dir):
        for name in files:
            link = os.path.normpath(os.path.join(root, name))
            if os.path.islink(link) and link not in wanted and not os.path.exists(link):
                os.remove(link)


if __name__ == "__main__":
    {"query": query, "prefix": prefix}[sys.argv[1]](*sys.argv[2:])
