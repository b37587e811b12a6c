"""Loading the plugin, refusing a wrong YADE, the launcher, and the set-up's messages.

Everything runs in a subprocess: a library that fails to load makes YADE abort.
"""
import ast
import importlib.util
import os
import re
import shutil
import sys
import textwrap

from pathlib import Path

import pytest
import shell
from shell import BUILD, PREFIX, ROOT
import yade.config

LAUNCHER = os.path.join(ROOT, "scripts", "yade-nonsmooth")


def run(command, **changes):
    return shell.run(*command, limit=120, **changes)


@pytest.fixture
def script(tmp_path):
    def write(text, name="script.py"):
        path = tmp_path / name
        path.write_text(textwrap.dedent(text))
        return path

    return write


# ---- loading --------------------------------------------------------------------------------------


def test_plugin_loads_and_registers_its_classes(script):
    result = run(
        [
            LAUNCHER,
            script(
                """
        from yade import nonsmooth
        import yade.system
        print("engines:", ContactDynamicsEngine().getClassName() if hasattr(ContactDynamicsEngine, "getClassName")
              else type(ContactDynamicsEngine()).__name__)
        print("material:", type(NscdMat()).__name__)
        print("base:", "FrictMat" in [c.__name__ for c in NscdMat.__mro__])
        """
            ),
        ]
    )
    assert result.returncode == 0, result.stderr
    assert "material: NscdMat" in result.stdout
    assert "base: True" in result.stdout


def links_to_prefix(folder, without):
    """A prefix like the build tree's, but for one file of the library folder."""
    for root, _, files in os.walk(PREFIX):
        target = os.path.join(folder, os.path.relpath(root, PREFIX))
        os.makedirs(target, exist_ok=True)
        for name in files:
            if name != without:
                os.symlink(os.path.join(root, name), os.path.join(target, name))
    library_dir = os.path.join(folder, os.path.relpath(yade.config.libDir, PREFIX))
    package = os.path.join(library_dir, "py", "yade", "nonsmooth")
    if not os.path.exists(package):
        os.symlink(os.path.join(yade.config.libDir, "py", "yade", "nonsmooth"), package)
    # the program names its prefix
    for name in ("yade", "yade-batch"):
        program = os.path.join(folder, "bin", name)
        with open(program) as source:
            text = source.read().replace(str(PREFIX), str(folder))
        os.remove(program)
        with open(program, "w") as changed:
            changed.write(text)
        os.chmod(program, 0o755)
    return library_dir


IMPORT = """
    print("yade runs:", O.iter)
    try:
        from yade import nonsmooth
    except RuntimeError as error:
        print("refused:", error)
    try:
        NscdMat()
    except NameError:
        print("no NscdMat")
    """


def test_wrong_class_layout_is_refused_without_a_crash(script, tmp_path):
    wrong = os.path.join(BUILD, "wrong_layout", "libnonsmooth.so")
    if not os.path.exists(wrong):
        pytest.skip("the wrong gate is not built")
    prefix = tmp_path / "build" / "prefix"
    library_dir = links_to_prefix(prefix, without="libnonsmooth.so")
    shutil.copy(wrong, library_dir)
    result = run([LAUNCHER, script(IMPORT)], NONSMOOTH_BUILD=str(prefix.parent))
    assert result.returncode == 0, result.stderr
    assert "yade runs: 0" in result.stdout
    assert "refused: the plugin yade-nonsmooth was not loaded: YADE's" in result.stdout
    assert "Scene" in result.stdout
    assert "no NscdMat" in result.stdout
    assert "error: the plugin yade-nonsmooth was not loaded" in result.stderr


def test_other_features_and_missing_engines_are_refused(script, tmp_path):
    prefix = tmp_path / "build" / "prefix"
    library_dir = links_to_prefix(prefix, without="nonsmooth_engines.so")
    environment = {"NONSMOOTH_BUILD": str(prefix.parent)}
    result = run([LAUNCHER, script(IMPORT)], **environment)
    assert result.returncode == 0 and "nonsmooth_engines.so" in result.stdout, result.stderr

    config = os.path.join(library_dir, "py", "yade", "config.py")
    with open(config) as source:
        text = source.read()
    for change, expected in (
        ("features=features+['OTHER']", "and this one has"),
        ("version='1999.01'", "and this is YADE 1999.01"),
    ):
        os.remove(config)
        with open(config, "w") as changed:
            changed.write(text + "\n" + change + "\n")
        result = run([LAUNCHER, script(IMPORT)], **environment)
        assert result.returncode == 0 and expected in result.stdout, result.stdout + result.stderr


# What the layout check looks at for each of YADE's headers that the engines include: names as in check("NAME", …),
# make<…>("NAME") or misplaced("NAME…").
LOOKED_AT = {
    "core/Aabb": ["Aabb"],
    "core/Body": ["Body"],
    "core/BodyContainer": ["BodyContainer"],
    "core/Dispatching": ["BoundDispatcher", "IGeomDispatcher"],
    "core/GlobalEngine": ["GlobalEngine"],
    "core/Interaction": ["Interaction"],
    "core/InteractionLoop": ["InteractionLoop"],
    "core/Scene": [
        "Scene",
        "State",
        "Interaction",
        "InteractionContainer",
        "ForceContainer",
        "BodyContainer",
        "Cell",
        "EnergyTracker",
    ],
    "core/Shape": ["Sphere"],
    "core/TimeStepper": ["GlobalStiffnessTimeStepper"],
    "pkg/common/Bo1_Aabb": ["Bo1_Sphere_Aabb"],
    "pkg/common/Box": ["Box"],
    "pkg/common/InsertionSortCollider": ["InsertionSortCollider"],
    "pkg/common/Collider": ["InsertionSortCollider"],
    "pkg/common/ElastMat": ["FrictMat"],
    "pkg/common/Facet": ["Facet"],
    "pkg/common/ForceEngine": ["ForceEngine"],
    "pkg/common/PeriodicEngines": ["PeriodicEngine"],
    "pkg/common/Sphere": ["Sphere"],
    "pkg/common/TorqueEngine": ["TorqueEngine"],
    "pkg/common/Wall": ["Wall"],
    "pkg/dem/CohesiveFrictionalContactLaw": ["CohFrictMat", "CohFrictPhys"],
    "pkg/dem/DomainLimiter": ["LawTester"],
    "pkg/dem/FrictPhys": ["FrictPhys"],
    "pkg/dem/Ig2_Sphere_Sphere_ScGeom": ["Ig2_Sphere_Sphere_ScGeom"],
    "pkg/dem/NewtonIntegrator": ["NewtonIntegrator"],
    "pkg/dem/ScGeom": ["ScGeom"],
    "pkg/dem/TriaxialStressController": ["TriaxialStressController"],
    "pkg/dem/UniaxialStrainer": ["UniaxialStrainer"],
    "core/Omega": [],
    "core/Engine": [],
    "pkg/common/ForceResetter": [],
    "pkg/common/PyRunner": [],
    "pkg/common/Recorder": [],
    "lib/high-precision/Constants": [],
    "lib/serialization/Serializable": [],  # the base of every class that is looked at
    # the runner of O.run()'s thread, which no macro changes
    "core/ThreadRunner": [],
    "lib/base/Math": [],
    "lib/pyutil/gil": [],  # functions, a class that is only recognised, and numbers
}


def test_the_layout_check_knows_every_class_that_the_engines_include():
    folder = os.path.join(ROOT, "pkg", "dem")
    texts = {}
    for path in Path(folder).rglob("*.?pp"):
        texts[path.name] = path.read_text()
    gate = texts.pop("LayoutCheck.cpp")
    included = {
        header for text in texts.values() for header in re.findall(r"#include <((?:core|pkg|lib)/[^>]+)\.hpp>", text)
    }
    assert included == set(LOOKED_AT)  # a new header: check what the engines touch of its classes, and add it here
    for header, names in LOOKED_AT.items():
        for name in names:
            assert re.search(r'(check|misplaced|make<\w+>)\("%s\b' % name, gate), (header, name)


# ---- the launcher ---------------------------------------------------------------------------------


def test_launcher_passes_arguments_and_exit_status(script):
    path = script(
        """
        import os, sys
        print("arguments", sys.argv[1:], "threads", os.environ["OMP_NUM_THREADS"])
        sys.exit(int(sys.argv[1]))
        """
    )
    result = run([LAUNCHER, path, "3", "--threads", "1", "--help"])
    assert result.returncode == 3
    assert "arguments ['3', '--threads', '1', '--help'] threads 1" in result.stdout
    result = run([LAUNCHER, path, "0", "--threads=2"])
    assert result.returncode == 0 and "threads 2" in result.stdout
    result = run([LAUNCHER, path, "0"], OMP_NUM_THREADS="")
    assert "threads %d" % len(os.sched_getaffinity(0)) in result.stdout


@pytest.mark.parametrize(
    "text, status, message",
    [
        ("raise ValueError('a mistake')", 1, "ValueError: a mistake"),
        ("import sys; sys.exit('a reason')", 1, "a reason"),
        ("x = (", 1, "SyntaxError"),
        ("O.bodies.append(sphere((0,0,0), 1)); O.step()", 0, ""),
    ],
)
def test_launcher_exit_status(script, text, status, message):
    result = run([LAUNCHER, script(text)])
    assert result.returncode == status
    assert message in result.stderr


def test_launcher_refuses_bad_calls(script, tmp_path):
    for arguments, message in (
        ([], "SCRIPT [ARGS]"),
        ([tmp_path / "missing.py"], "cannot be read"),
        ([script("", "notes.txt")], "must be a Python file"),
        ([script(""), "--threads", "none"], "--threads wants a positive number"),
        ([script(""), "--threads", "08"], "--threads wants a positive number"),
        # YADE crashed
        ([script(""), "--threads", "100000"], "--threads 100000 is more than this machine has a use for"),
        ([script(""), "--threads", "9" * 30], "give at most"),
        (["-j", "0", script("")], "wants a positive number, not '0'"),
        (["-j"], "-j wants a number"),
        # it took the script's name for one, and then missed a script
        (["-j", script("")], "-j wants a positive number, not '"),
        (["-nj", script(""), "2"], "-j wants a positive number, not '"),
        (["-jx", script("")], "-j wants a positive number, not 'x'"),
        (["--threads=", script("")], "--threads wants a positive number, not ''"),
        (["--cores=0,1", script("")], "YADE's option --cores=0,1 is none of the launcher's"),
        (["-f3", script("")], os.path.join("prefix", "bin", "yade --help")),
        (["-nq", script("")], "there is no option -q"),
        (["-xi", script("")], "give one of them"),
        (["-i", "-"], "give a file"),
    ):
        result = run([LAUNCHER, *arguments])
        assert result.returncode == 2 and message in result.stderr
    result = run([LAUNCHER, script("")], NONSMOOTH_BUILD=str(tmp_path / "nowhere"))
    assert result.returncode == 2 and "setup.sh" in result.stderr


@pytest.mark.parametrize(
    "options, own",
    [
        (["-x", "-j1"], ["--", "-x", "-j3", "--cores", "", "a b"]),
        (["-nxj", "1", "--"], ["-h"]),
        (["-j", "1"], ["-1", "-"]),
    ],
)
def test_yades_options_and_the_scripts_own(options, own, script):
    path = script("print('seen', sys.argv, O.numThreads)")
    result = run([LAUNCHER, *options, path, *own])
    assert f"seen {[str(path), *own]} 1\n" in result.stdout, result.stdout + result.stderr
    assert result.returncode == 0


@pytest.mark.parametrize("words", [[], ["-", "--", "-x"]])
def test_a_script_from_standard_input(words):
    text = "import sys\nprint('seen', sys.argv, O.iter)\ndef fail():\n    raise ValueError('of ' + 'a pipe')\nfail()\n"
    result = run([LAUNCHER, "-j1", *words], given=text)
    assert f"seen {['-', *words[1:]]} 0\n" in result.stdout, result.stdout + result.stderr
    # the traceback shows the lines
    assert result.returncode == 1 and "    raise ValueError('of ' + 'a pipe')\nValueError: of a pipe" in result.stderr


def test_standard_input_without_a_script():
    result = run([LAUNCHER], given="\n")
    assert result.returncode == 2 and "standard input holds no script" in result.stderr


def test_a_prompt_behind_a_script(script):
    path = script("answer = 6 * int(sys.argv[1])")
    result = run([LAUNCHER, "-i", "-j1", path, "7"], given="print('it is', answer)\nprint(O.iter, 'steps')\n")
    assert result.returncode == 0 and "it is 42" in result.stdout and "0 steps" in result.stdout, result.stderr
    result = run([LAUNCHER, "-i", "-j1"], given="print('it is', 6 * 7)\n")
    assert result.returncode == 0 and "it is 42" in result.stdout, result.stderr


@pytest.mark.parametrize(
    "text, lines, status",
    [
        ("", "raise SystemExit(3)\nprint('too far')\n", 3),
        ("", "import sys\nsys.exit('a reason')\nprint('too far')\n", 1),
        ("", "1/0\nprint('goes on')\n", 1),
        ("", "x = = 1\nprint('goes on')\n", 1),
        ("", "1/0\nraise SystemExit(0)\n", 0),
        ("raise ValueError('of the script')", "print('goes on')\n", 1),
        ("import sys; sys.exit(4)", "print('too far')\n", 4),
        ("", "print('goes on')\nexit()\n", 0),
    ],
)
def test_a_prompt_whose_lines_come_by_a_pipe_ends_as_a_script_does(text, lines, status, script):
    result = run([LAUNCHER, "-i", "-j1", script(text)], given=lines)
    assert result.returncode == status, result.stdout + result.stderr
    assert "too far" not in result.stdout and ("goes on" in result.stdout) == ("goes on" in lines)


def test_the_file_that_a_script_is(script):
    """As in Python: the script, and no name where it comes by standard input."""
    path = script("import sys\nprint('file', __file__)\nprint('main', sys.modules['__main__'].__file__)")
    result = run([LAUNCHER, "-j1", path])
    assert f"file {path}\nmain {path}\n" in result.stdout, result.stdout + result.stderr
    result = run([LAUNCHER, "-j1"], given="print('file', globals().get('__file__'))\n")
    assert "file None\n" in result.stdout, result.stdout + result.stderr


def test_a_script_does_not_wait_for_the_shell_of_a_prompt(script):
    """YADE makes IPython's shell before each script; where no prompt follows, none is made, and the script still finds
    all of IPython.
    """
    text = """
        import sys
        print("before", [name for name in sys.modules if name.partition(".")[0] in ("IPython", "prompt_toolkit", "jedi")])
        import IPython, yade.runtime
        from IPython.terminal.embed import InteractiveShellEmbed
        print("after", InteractiveShellEmbed.__mro__[1].__name__, IPython.version_info[0] == yade.runtime.ipython_version // 100)
        """
    result = run([LAUNCHER, script(text)])
    assert "before []" in result.stdout and "after TerminalInteractiveShell True" in result.stdout, result


def test_script_started_as_it_is_finds_the_launcher(tmp_path, script):
    """The lines that every scripts/NAME.py begins with, as the launcher's comment gives them."""
    with open(LAUNCHER) as source:
        lines = [line[4:] for line in source.read().splitlines() if line.startswith("#   ")]
    start = lines.index("#!/usr/bin/env python3")
    prelude = lines[start : start + 5]
    assert prelude[-1].lstrip().startswith("os.execv")
    os.symlink(LAUNCHER, tmp_path / "yade-nonsmooth")
    path = script("\n".join(prelude) + "\nprint('iteration', O.iter, sys.argv[1:])\n")
    path.chmod(0o755)
    for command in ([path, "--disks", "3"], [LAUNCHER, path, "--disks", "3"]):
        result = run(command)
        assert result.returncode == 0, result.stderr
        assert "iteration 0 ['--disks', '3']" in result.stdout


# ---- the set-up -----------------------------------------------------------------------------------


def test_wrong_tarball_is_refused(tmp_path):
    wrong = tmp_path / "yade.tar.bz2"
    wrong.write_bytes(b"not YADE")
    steps = " ".join('. "$0/%s.sh";' % step for step in ("common", "packages", "yade"))
    for tarball, message in ((wrong, "SHA-256"), (tmp_path / "missing", "cannot be read")):
        result = run(
            ["bash", "-c", "set -euo pipefail; %s yade_sources" % steps, os.path.join(ROOT, "scripts", "setup")],
            YADE_TARBALL=str(tarball),
            XDG_CACHE_HOME=str(tmp_path / "cache"),
        )
        assert result.returncode != 0
        assert message in result.stderr and str(tarball) in result.stderr


def test_headers_of_another_version_stop_the_configuration(tmp_path):
    headers = tmp_path / "headers"
    (headers / "core").mkdir(parents=True)
    (headers / "core" / "Scene.hpp").write_text("")
    (headers / "RELEASE").write_text("1999.01\n")
    real_prefix = os.path.dirname(os.path.dirname(os.path.realpath(os.path.join(yade.config.libDir, "libyade.so"))))
    while not os.path.exists(os.path.join(real_prefix, "bin", "yade")):
        real_prefix = os.path.dirname(real_prefix)
    result = run(
        ["cmake", "-S", ROOT, "-B", tmp_path / "build", "-DYADE_PREFIX=" + real_prefix, "-DYADE_HEADERS=%s" % headers],
        PATH="/usr/bin:/bin",
    )
    assert result.returncode != 0
    message = " ".join(result.stderr.split())
    assert "holds the headers of 1999.01" in message and yade.config.version in message


@pytest.mark.parametrize(
    "command, status, message",
    [
        (["setup.sh", "--help"], 0, "YADE_TARBALL"),
        (["demo.sh", "--help"], 0, "--full"),
        (["test.sh", "--help"], 0, "every test"),
        (["setup.sh", "now"], 1, "takes no arguments but --tests and --notebooks, and was given: now"),
        (["demo.sh", "--disks"], 2, "--disks needs a value"),
        (["demo.sh", "--disks", "many"], 2, "not 'many'"),
        (["demo.sh", "--speed", "3"], 2, "unknown argument '--speed'"),
        (["demo.sh", "--out", "/proc/results"], 2, "cannot be written"),
    ],
)
def test_commands_answer_before_they_set_anything_up(command, status, message, tmp_path):
    result = run([os.path.join(ROOT, "scripts", command[0]), *command[1:]], XDG_CACHE_HOME=str(tmp_path))
    assert result.returncode == status
    assert message in result.stdout + result.stderr
    assert not os.listdir(tmp_path)


@pytest.mark.parametrize(
    "packages, folders", [(("PROJECT",), ("py", "scripts")), (("PROJECT", "TESTS"), ("tests", "doc", "cmake"))]
)
def test_every_imported_module_comes_from_a_package_that_is_installed(packages, folders):
    """What a fresh machine lacks, this one may have by chance: every import must be listed in packages.sh, where what
    it is for is.
    """
    listed = run(
        [
            "bash",
            "-c",
            '. "$0"; printf "%%s\\n" %s' % " ".join('"${PACKAGES_%s[@]}"' % name for name in packages),
            os.path.join(ROOT, "scripts", "setup", "packages.sh"),
        ]
    ).stdout.split()
    # tests/coverage/run.sh asks for coverage itself
    imported, own = {}, {
        "yade",
        "nonsmooth",
        "_nonsmooth_packing",
        "_nonsmooth_contact",
        "_nonsmooth_slip",
        "__main__",
        "coverage",
    }
    for folder in ("py", "scripts", "tests", "doc", "cmake"):
        for root, _, files in os.walk(os.path.join(ROOT, folder)):
            if "__init__.py" in files:
                own.add(os.path.basename(root))
            for name in (f for f in files if f.endswith(".py")):
                own.add(name[:-3])
                if folder not in folders:
                    continue
                with open(os.path.join(root, name)) as source:
                    tree = ast.parse(source.read())
                for node in ast.walk(tree):
                    if isinstance(node, ast.Import):
                        modules = [alias.name for alias in node.names]
                    elif isinstance(node, ast.ImportFrom) and not node.level:
                        modules = [node.module]
                    else:
                        continue
                    imported.update({m.split(".")[0]: os.path.join(root, name) for m in modules})
    missing = []
    for module in sorted(set(imported) - own - set(sys.stdlib_module_names)):
        found = importlib.util.find_spec(module)
        owner = run(["dpkg-query", "-S", found.origin]).stdout.split(":")[0] if found else "nothing installed"
        if owner not in listed:
            missing.append("%s (%s, from %s)" % (module, imported[module], owner or "no Debian package"))
    assert not missing
