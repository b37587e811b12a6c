"""Every option of every command reaches what it is for: the value is found in what the command asks its library to do.
The lists of options are the parsers' own.
"""
import argparse
import contextlib
import runpy
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from shell import SCRIPTS
from slope_scenes import SMALL
from yade.nonsmooth import campaign as campaigns, errors, experiment, lessons, packing, section
from yade.nonsmooth.heaps import study
from yade.nonsmooth.judges.benchmark import scale, space_suite, suite
from yade.nonsmooth.judges.verification import runner, soak
from yade.nonsmooth.laboratory import calibration, campaign, effects, rock_table, table1, tension_campaign, wall_shear
from yade.nonsmooth.slip import block
from yade.nonsmooth.studies.comparison import cost, course
from yade.nonsmooth.studies.paper import paper_slopes, readings
from yade.nonsmooth.studies.slope import slope

COMMANDS = sorted(path.name for path in SCRIPTS.glob("*.py"))
ROCK = dict(friction=0.35, rolling_friction=0.11, tensile_strength=7e4, density=2400.0)


class Asked(errors.UserError):
    """The command has asked its library; nothing is computed."""


class Asks:
    """What a command asked: ``words`` and ``named`` arguments of its library's function."""

    def __init__(self):
        self.words, self.named = (), {}

    def __call__(self, *words, **named):
        self.words, self.named = words, named
        raise Asked("asked")


class Search(Asks):
    """A calibration: made, then run."""

    def __call__(self, *words, **named):
        self.words, self.named = words, named
        self.run = Asks()
        return self


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A folder with a material file, packings for a slope and for a column, and a section."""
    home = tmp_path_factory.mktemp("files")
    (home / "stone.yaml").write_text(yaml.safe_dump(ROCK))
    (home / "small.yaml").write_text(SMALL.read_text())
    made = packing.cached_pack(section.load(str(SMALL)), 5)
    packing.write_text(made, home / "slope.txt")
    packing.write_text(
        packing.Packing([3, 4, 5, 3, 4, 5], [7.5, 7.5, 7.5, 8.5, 8.5, 8.5], [0.5] * 6, [0] * 6), home / "heap.txt"
    )
    return home


FIRST = {
    "slope.py": ("--section", "jiufengershan"),
    "wall_shear.py": ("--material", "ss"),
    "calibrate.py": ("--cohesion", 60e3, "--friction", 35),
    "column.py": ("--aspect", "1"),
    "sweep.py": ("--section", "jiufengershan", "--over", "seed=1,2"),
    "factor_of_safety.py": ("--section", "jiufengershan"),
    "soak.py": ("--steps", 500),
}
SOFT = ("--world", "soft", "--stiffness", "1e9")
HOLDER = {  # what a command asks: a module or class, and its function
    "jiufengershan.py": (slope, "build"),
    "slope.py": (slope, "build"),
    "biaxial.py": (campaign, "run"),
    "wall_shear.py": (wall_shear, "run"),
    "biaxial_effects.py": (effects, "run"),
    "calibrate.py": (calibration, "Calibration"),
    "column.py": (study, "run"),
    "compare_hard_soft.py": (course, "compare"),
    "benchmark.py": (suite, "run"),
    "soak.py": (soak, "run"),
    "sweep.py": (campaigns, "sweep"),
    "factor_of_safety.py": (campaigns, "factors_of_safety"),
    "lessons.py": (lessons, "run"),
    "paper.py": (paper_slopes, "run"),
    "readings.py": (readings, "run"),
    "table1.py": (table1, "run"),
    "tension_test.py": (tension_campaign, "run"),
    "rocks.py": (rock_table, "run"),
    "sliding_block.py": (block, "slide"),
    "verify.py": (runner, "run_checks"),
    "wedge.py": (subprocess, "run"),
}
OTHERS = {
    ("compare_hard_soft.py", "--cost"): (cost, "run"),
    ("benchmark.py", "--scale"): (scale, "run"),
    ("benchmark.py", "--space"): (space_suite, "run"),
    ("jiufengershan.py", "--resume"): (experiment, "resume"),
    ("slope.py", "--resume"): (experiment, "resume"),
    **{
        (command, word): (campaigns.Plan, "run")
        for command in ("sweep.py", "factor_of_safety.py")
        for word in ("--resume", "--threads")
    },
    ("sweep.py", "--plan"): (campaigns.Plan, "write"),
    ("sweep.py", "--run"): (campaigns, "run_one"),
    ("sweep.py", "--number"): (campaigns, "run_one"),
    ("sweep.py", "--collect"): (campaigns, "collect"),
}


def ran_by(a):
    """Of biaxial.py, tension_test.py and wall_shear.py."""
    return a.words[0]


def first(a):
    return ran_by(a)[0]


def heap(a):
    return next(iter(a.words[0].values()))[0]


def world(a):
    return next(iter(a.words[0].values()))[1]


def made_of(a):
    """Materials of the layers of a slope."""
    return {a.words[0].materials[layer.material].friction for layer in a.words[0].layers}


def effect(a):
    """The usual test of an effect, of the first seed."""
    e = a.words[0][0]
    return e.tests[e.usual][0]


# of the two commands that run a slope
SLOPE = {
    "--section": (("--section", "{files}/small.yaml"), lambda a: a.words[0].name, "small slope"),
    "--packing": (
        ("--section", "{files}/small.yaml", "--packing", "{files}/slope.txt"),
        lambda a: (len(a.words[1]), float(a.words[1].x[7])),
        lambda files: (315, float(packing.read_text(files / "slope.txt").x[7])),
    ),
    "--rock": (("--section", "{files}/small.yaml", "--rock", "{files}/stone.yaml"), made_of, {0.35}),
    "--disks": (
        ("--section", "{files}/small.yaml", "--disks", 150),
        lambda a: len(a.words[1]),
        pytest.approx(150, abs=2),
    ),
    "--seed": (
        ("--section", "{files}/small.yaml", "--seed", 5),
        lambda a: (a.words[0].seed, float(a.words[1].x[7])),
        lambda files: (5, float(packing.read_text(files / "slope.txt").x[7])),
    ),
    "--water": (
        ("--section", "{files}/small.yaml", "--water", 0.25),
        lambda a: (a.words[0].water.rate, a.words[0].water.table),
        (0.25, ((0.0, 0.0),)),
    ),
    # in metres of the slope that is run; the file's are 0.5 m of slip and 3 m of release
    "--critical-slip": (
        ("--section", "{files}/small.yaml", "--critical-slip", 0.25, "--size", 0.5),
        lambda a: (a.words[0].materials["dp"].critical_slip, a.words[0].release_distance),
        (0.25, 0.25),
    ),
    "--resume": (
        ("--section", "{files}/small.yaml", "--resume"),
        lambda a: (a.words[0].name, a.words[1].name),
        ("small slope", "out"),
    ),
    "--mirror": (
        ("--section", "{files}/small.yaml", "--mirror"),
        lambda a: (a.words[0].side, a.words[1].x.mean() > 0),
        (-1.0, True),
    ),
    "--size": (
        ("--section", "{files}/small.yaml", "--size", 0.01),
        lambda a: (a.words[0].area, a.words[1].x.mean()),
        lambda files: (
            pytest.approx(1e-4 * section.load(str(SMALL)).area),
            pytest.approx(0.01 * packing.cached_pack(section.load(str(SMALL))).x.mean()),
        ),
    ),
    "--out": (("--section", "{files}/small.yaml", "--resume"), lambda a: str(a.words[1]), "{out}"),
}
#: command: option: its words, where its value is found, and the value.
WHERE = {
    "jiufengershan.py": SLOPE,
    "slope.py": SLOPE,
    "biaxial.py": {
        "--material": (
            ("--material", "{files}/stone.yaml"),
            lambda a: (first(a).material.friction, first(a).material.name),
            (0.35, "stone"),
        ),
        "--confining": (("--confining", "0.5,4"), lambda a: [t.confining for t in ran_by(a)], [0.5e6, 4e6]),
        "--disks": (("--disks", 77), lambda a: first(a).shape.count, 77),
        "--diameter": (("--diameter", 1.5, 2.5), lambda a: (first(a).shape.d_min, first(a).shape.d_max), (1.5, 2.5)),
        "--fraction": (("--fraction", 0.8), lambda a: first(a).shape.fraction, 0.8),
        "--aspect": (("--aspect", 1.5), lambda a: first(a).shape.aspect, 1.5),
        "--seeds": (("--seeds", 3, 4, "--confining", "1"), lambda a: [t.shape.seed for t in ran_by(a)], [3, 4]),
        "--platens": (("--platens", "glued"), lambda a: first(a).platens, "glued"),
        "--sides": (("--sides", "flexible"), lambda a: first(a).sides, "flexible"),
        "--strain": (("--strain", 0.03), lambda a: first(a).strain, 0.03),
        "--inertia": (("--inertia", 3e-4), lambda a: first(a).inertia, 3e-4),
        "--step": (("--step", 0.2), lambda a: first(a).step, 0.2),
        "--tolerance": (("--tolerance", 1e-3), lambda a: first(a).tolerance, 1e-3),
        "--sample": (("--sample", "packed"), lambda a: first(a).shape.friction, None),
        "--pressing-friction": (("--pressing-friction", 0.4), lambda a: first(a).shape.friction, 0.4),
        "--bond-distance": (("--bond-distance", 0.013), lambda a: first(a).material.bond_creation_distance, 0.013),
        "--closing-bonds": (("--closing-bonds",), lambda a: first(a).material.bonds_close, True),
        # the last 3 % of strain, and no more than the plateau
        "--cycle": (("--cycle", "--strain", 0.2), lambda a: round(first(a).forces_from, 9), 0.17),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
    },
    "tension_test.py": {
        "--material": (
            ("--material", "{files}/stone.yaml"),
            lambda a: (first(a).material.friction, first(a).material.name),
            (0.35, "stone"),
        ),
        "--disks": (("--disks", 77, 99, "--grip", 0), lambda a: sorted({t.shape.count for t in ran_by(a)}), [77, 99]),
        "--diameter": (("--diameter", 1.5, 2.5), lambda a: (first(a).shape.d_min, first(a).shape.d_max), (1.5, 2.5)),
        "--fraction": (("--fraction", 0.8), lambda a: first(a).shape.fraction, 0.8),
        "--aspect": (("--aspect", 1.5), lambda a: first(a).shape.aspect, 1.5),
        "--seeds": (("--seeds", 3, 4), lambda a: [t.shape.seed for t in ran_by(a)], [3, 4]),
        "--inertia": (("--inertia", 3e-4, 1e-4, "--seeds", 1), lambda a: [t.inertia for t in ran_by(a)], [3e-4, 1e-4]),
        "--grip": (("--grip", 1.5), lambda a: first(a).grip, 1.5),
        "--fallen": (("--fallen", 0.2), lambda a: first(a).fallen, 0.2),
        "--opening": (("--opening", 0.3), lambda a: first(a).opening, 0.3),
        "--step": (("--step", 0.2), lambda a: first(a).step, 0.2),
        "--tolerance": (("--tolerance", 1e-3), lambda a: first(a).tolerance, 1e-3),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
    },
    "wall_shear.py": {
        "--material": (
            ("--material", "ss", "{files}/stone.yaml"),
            lambda a: sorted({t.material.friction for t in ran_by(a)}),
            [0.2, 0.35],
        ),
        "--bonded": (("--bonded", "--tensile-strength", 5), lambda a: first(a).material.bonded, True),
        "--tensile-strength": (("--tensile-strength", 5), lambda a: first(a).material.tensile_strength, 5e3),
        "--pressures": (("--pressures", "0.5,3"), lambda a: sorted({t.pressure for t in ran_by(a)}), [0.5e6, 3e6]),
        "--seeds": (("--seeds", 8, 9), lambda a: sorted({t.seed for t in ran_by(a)}), [8, 9]),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
    },
    "biaxial_effects.py": {
        "--material": (("--material", "{files}/stone.yaml"), lambda a: effect(a).material.friction, 0.35),
        "--disks": (("--disks", 88), lambda a: effect(a).shape.count, 88),
        "--confining": (("--confining", 2), lambda a: effect(a).confining, 2e6),
        "--seeds": (("--seeds", 6, 7), lambda a: [t.shape.seed for t in a.words[0][0].tests[2000]], [6, 7]),
        "--only": (("--only", "step", "inertia"), lambda a: [e.name for e in a.words[0]], ["inertia", "step"]),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
    },
    "calibrate.py": {
        "--cohesion": (("--cohesion", 80e3), lambda a: a.words[0].cohesion, 80e3),
        "--friction": (("--friction", 31), lambda a: a.words[0].friction_deg, 31.0),
        "--residual-cohesion": (
            ("--residual-cohesion", 9e3, "--residual-friction", 25),
            lambda a: a.words[0].residual_cohesion,
            9e3,
        ),
        "--residual-friction": (
            ("--residual-cohesion", 9e3, "--residual-friction", 25),
            lambda a: a.words[0].residual_friction_deg,
            25.0,
        ),
        "--start": (("--start", "{files}/stone.yaml"), lambda a: a.words[1].rolling_friction, 0.11),
        "--quick": (
            ("--quick",),
            lambda a: (len(a.run.words), a.run.named, a.run.words[0][0]),
            (1, {"trials": (4, 0)}, 1000),
        ),
        "--coarse": (("--coarse", 301), lambda a: a.run.words[0][0], 301),
        "--fine": (("--fine", 302), lambda a: a.run.words[1][0], 302),
        "--seeds": (("--seeds", 4, 5, 6), lambda a: [kind[1] for kind in a.run.words], [[4, 5, 6]] * 2),
        "--out": ((), lambda a: str(a.words[2]), "{out}-calibration"),
        "--threads": (("--threads", 7), lambda a: a.words[3], 7),
        "--resume": (("--resume",), lambda a: a.words[5], True),
    },
    "column.py": {
        "--kind": (("--kind", "pile"), lambda a: type(heap(a)).__name__, "Pile"),
        "--aspect": (("--aspect", "0.7,1.9"), lambda a: [h.aspect for h, _ in a.words[0].values()], [0.7, 1.9]),
        "--disks": (("--disks", 123), lambda a: heap(a).disks, 123),
        "--seeds": (("--seeds", 5, 6), lambda a: [h.seed for h, _ in a.words[0].values()], [5, 6]),
        "--diameter": (("--diameter", 0.02), lambda a: heap(a).diameter, 0.02),
        "--size-spread": (("--size-spread", 2.5), lambda a: heap(a).size_spread, 2.5),
        "--friction": (("--friction", 0.7), lambda a: heap(a).friction, 0.7),
        "--rolling-friction": (("--rolling-friction", 0.2), lambda a: heap(a).rolling_friction, 0.2),
        "--restitution": (("--restitution", 0.3), lambda a: heap(a).restitution, 0.3),
        "--base": (("--base", "smooth"), lambda a: heap(a).base, "smooth"),
        "--base-friction": (("--base-friction", 0.25), lambda a: heap(a).base_friction, 0.25),
        "--wall-friction": (("--wall-friction", 0.15), lambda a: heap(a).wall_friction, 0.15),
        "--packing": (
            ("--packing", "{files}/heap.txt"),
            lambda a: (heap(a).box(), list(a.words[0])),
            ((3.0, 2.0), ["heap"]),
        ),
        "--world": (SOFT, lambda a: world(a)["name"], "soft"),
        "--path": (("--path", 0.3), lambda a: world(a)["path"], 0.3),
        "--tolerance": (("--tolerance", 1e-3), lambda a: world(a)["tolerance"], 1e-3),
        "--stiffness": (SOFT, lambda a: world(a)["stiffness"], 1e9),
        "--damping": ((*SOFT, "--damping", 0.35), lambda a: world(a)["damping"], 0.35),
        "--damping-moving": ((*SOFT, "--damping-moving", 0.05), lambda a: world(a)["damping_moving"], 0.05),
        "--step-share": ((*SOFT, "--step-share", 0.4), lambda a: world(a)["step_share"], 0.4),
        "--model": ((*SOFT, "--model", "friction"), lambda a: world(a)["model"], "friction"),
        "--duration": (("--duration", 3), lambda a: a.words[4], 3.0),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
    },
    "compare_hard_soft.py": {
        "--scenario": (("--scenario", "pile"), lambda a: a.words[0], "pile"),
        "--source": (("--source", "{files}/small.yaml"), lambda a: Path(a.named["source"]).name, "small.yaml"),
        "--disks": (("--disks", 99), lambda a: a.named["disks"], 99),
        "--stiffness": (("--stiffness", "1e8,2e8"), lambda a: a.named["stiffnesses"], [1e8, 2e8]),
        "--ensemble-stiffness": (("--ensemble-stiffness", "3e8"), lambda a: a.named["ensemble"], 3e8),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[2], [7, 8]),
        "--model": (("--model", "jcfpm"), lambda a: a.named["model"], "jcfpm"),
        "--bonds": (("--bonds", "fragile"), lambda a: a.named["fragile"], True),
        "--damping": (("--damping", 0.3), lambda a: a.named["damping"], 0.3),
        "--damping-moving": (("--damping-moving", 0.07), lambda a: a.named["damping_moving"], 0.07),
        "--step-share": (("--step-share", 0.6), lambda a: a.named["step_share"], 0.6),
        "--without": (("--without", "numerics", "bonds"), lambda a: a.named["without"], ["numerics", "bonds"]),
        "--cost": (("--cost",), lambda a: (a.words[1], a.words[2]), (cost.SOURCE, cost.DISKS)),
        "--steps": (("--cost", "--steps", 315), lambda a: a.words[5], 315),
        "--end": (("--end", 12), lambda a: a.named["options"]["end"], 12.0),
        "--confining": (("--scenario", "biaxial", "--confining", 2), lambda a: a.named["options"]["confining"], 2e6),
        "--strain": (("--scenario", "biaxial", "--strain", 0.05), lambda a: a.named["options"]["strain"], 0.05),
        "--sides": (
            ("--scenario", "biaxial", "--sides", "flexible"),
            lambda a: a.named["options"]["sides"],
            "flexible",
        ),
        "--platens": (
            ("--scenario", "biaxial", "--platens", "rough"),
            lambda a: a.named["options"]["platens"],
            "rough",
        ),
        "--aspect": (("--scenario", "column", "--aspect", 1.3), lambda a: a.named["options"]["aspect"], 1.3),
        "--friction": (("--scenario", "column", "--friction", 0.6), lambda a: a.named["options"]["friction"], 0.6),
        "--base": (("--scenario", "column", "--base", "smooth"), lambda a: a.named["options"]["base"], "smooth"),
        "--size": (("--scenario", "triaxial", "--size", 7), lambda a: a.named["options"]["size"], 7.0),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.named["threads"], 7),
        "--resume": (("--resume",), lambda a: a.named["resume"], True),
    },
    "benchmark.py": {
        "--out": ((), lambda a: str(a.words[0]), "{out}"),
        "--section": (("--section", "{files}/small.yaml"), lambda a: Path(a.words[1]).name, "small.yaml"),
        "--disks": (("--disks", 2222), lambda a: a.words[2], 2222),
        "--threads": (("--threads", 7), lambda a: a.words[3], 7),
        "--quick": (("--quick",), lambda a: a.words[4], suite.QUICK),
        "--scale": (("--scale", "2000,3000"), lambda a: a.words[2], [2000, 3000]),
        "--space": (("--space", "2000,3000"), lambda a: a.words[1], [2000, 3000]),
    },
    "soak.py": {
        "--disks": (("--disks", 61), lambda a: a.words[0], 61),
        "--spheres": (("--spheres", 62), lambda a: (a.words[0], a.words[5]), (62, "spheres")),
        "--steps": (("--steps", 1234), lambda a: a.words[1], 1234),
        "--seed": (("--seed", 9), lambda a: a.words[2], 9),
        "--way": (("--way", "step"), lambda a: a.words[4], "step"),
    },
    "sweep.py": {
        "--section": (("--section", "{files}/small.yaml"), lambda a: a.words[0].name, "small slope"),
        "--over": (
            ("--over", "materials.rock.friction=0.3,1e-1", "--over", "walls.DP.material=dp,ss"),
            lambda a: a.words[1],
            {"seed": [1, 2], "materials.rock.friction": [0.3, 0.1], "walls.DP.material": ["dp", "ss"]},
        ),
        "--rock": (("--rock", "{files}/stone.yaml"), made_of, {0.35}),
        "--disks": (("--disks", 150), lambda a: sum(a.words[0].disk_counts()), pytest.approx(150, abs=2)),
        "--seed": (("--seed", 5), lambda a: a.words[0].seed, 5),
        "--water": (("--water", 0.25), lambda a: a.words[0].water.rate, 0.25),
        "--critical-slip": (
            ("--critical-slip", 2),
            lambda a: (a.words[0].materials["dp"].critical_slip, a.words[0].release_distance),
            (2.0, 2.0),
        ),
        "--mirror": (("--mirror",), lambda a: a.words[0].side, -1.0),
        "--size": (("--size", 0.01), lambda a: a.words[0].disks.d_max, pytest.approx(0.04)),
        "--end": (("--end", 3), lambda a: a.named["end"], 3.0),
        "--figures": (("--figures",), lambda a: a.named["figures"], True),
        "--out": (("--plan",), lambda a: str(a.words[0]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[1], 7),
        "--resume": (("--threads", 7, "--resume"), lambda a: a.words[2], True),
        "--plan": (("--plan",), lambda a: len(a.words), 1),
        "--run": (("--run", "seed=2"), lambda a: a.words[1], "seed=2"),
        "--number": (("--number", 1), lambda a: a.words[1], 1),
        "--collect": (("--collect",), lambda a: str(a.words[0]), "{out}"),
    },
    "factor_of_safety.py": {
        "--section": (("--section", "{files}/small.yaml"), lambda a: a.words[0].name, "small slope"),
        "--over": (
            ("--over", "materials.rock.friction=0.3,1e-1"),
            lambda a: a.words[1],
            {"materials.rock.friction": [0.3, 0.1]},
        ),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[1], {"seed": [7, 8]}),
        "--rock": (("--rock", "{files}/stone.yaml"), made_of, {0.35}),
        "--disks": (("--disks", 150), lambda a: sum(a.words[0].disk_counts()), pytest.approx(150, abs=2)),
        "--seed": (("--seed", 5), lambda a: a.words[0].seed, 5),
        "--water": (("--water", 0.25), lambda a: a.words[0].water.rate, 0.25),
        "--critical-slip": (("--critical-slip", 2), lambda a: a.words[0].release_distance, 2.0),
        "--mirror": (("--mirror",), lambda a: a.words[0].side, -1.0),
        "--size": (("--size", 0.01), lambda a: a.words[0].disks.d_max, pytest.approx(0.04)),
        "--table": (("--table", 12.5), lambda a: a.named["table"], 12.5),
        "--divide": (("--divide", "friction,tension"), lambda a: a.named["quantities"], ["friction", "tension"]),
        "--materials": (("--materials", "rock,dp"), lambda a: a.named["materials"], ["rock", "dp"]),
        "--step": (("--step", 0.25), lambda a: a.named["step"], 0.25),
        "--within": (("--within", 0.005), lambda a: a.named["within"], 0.005),
        "--most": (("--most", 4), lambda a: a.named["most"], 4.0),
        "--least": (("--least", 0.25), lambda a: a.named["least"], 0.25),
        "--world": (SOFT, lambda a: a.named["world"]["name"], "soft"),
        "--stiffness": (SOFT, lambda a: a.named["world"]["stiffness"], 1e9),
        "--no-figures": (("--no-figures",), lambda a: a.named["figures"], False),
        "--threads": (("--threads", 7), lambda a: a.words[1], 7),
        "--resume": (("--threads", 7, "--resume"), lambda a: a.words[2], True),
        "--out": (("--threads", 7), lambda a: str(a.words[0]), "{out}"),
    },
    "lessons.py": {
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[2], 7),
        "--resume": (("--resume",), lambda a: a.words[3], True),
        "--no-films": (("--no-films",), lambda a: a.words[5], False),
    },
    "paper.py": {
        "--only": (("--only", "held", "shipped"), lambda a: a.words[0], ["held", "shipped"]),
        "--disks": (("--disks", 666), lambda a: a.words[2], 666),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[3], [7, 8]),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.named["threads"], 7),
        "--resume": (("--resume",), lambda a: a.named["resume"], True),
    },
    "readings.py": {
        "--only": (("--only", "packed", "half"), lambda a: sorted(a.words[0]), ["half", "packed"]),
        "--platens": (("--platens", "rough"), lambda a: a.words[5], ["rough"]),
        "--strain": (("--strain", 0.06), lambda a: a.words[6], 0.06),
        "--confining": (("--confining", "0.5,8"), lambda a: a.words[7], [0.5e6, 8e6]),
        "--no-slopes": (("--no-slopes",), lambda a: a.words[8], False),
        "--disks": (("--disks", 66), lambda a: a.words[2], 66),
        "--samples": (("--samples", 77), lambda a: a.words[3], 77),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[4], [7, 8]),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.named["threads"], 7),
        "--resume": (("--resume",), lambda a: a.named["resume"], True),
    },
    "rocks.py": {
        "--check": (("--check",), lambda a: [e.name for e in a.words[1]][0], "c-20-phi-25"),
        "--add": (("--add", "--frictions", 0.5, 0.6), lambda a: [e.material.friction for e in a.words[1]], [0.5, 0.6]),
        "--disks": (("--disks", 321), lambda a: a.words[1][0].count, 321),
        "--frictions": (("--frictions", 0.5, 0.6), lambda a: [e.material.friction for e in a.words[1][:2]], [0.5, 0.6]),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[2], [7, 8]),
        "--out": ((), lambda a: str(a.words[0]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[3], 7),
        "--resume": (("--resume",), lambda a: a.words[4], True),
    },
    "sliding_block.py": {
        "--law": (
            ("--law", "step", "--value", "friction=0.3", "critical_slip=2"),
            lambda a: (a.words[0].names, a.words[0].values),
            (("step",), {"friction": 0.3, "critical_slip": 2.0}),
        ),
        "--set": (("--set", "lucas"), lambda a: a.words[0].names, ("tabulated",)),
        "--value": (("--set", "vaiont", "--value", "thickness=0.02"), lambda a: a.words[0].values["thickness"], 0.02),
        "--dip": (("--set", "vaiont", "--dip", 25), lambda a: a.words[1].dip, 25.0),
        "--depth": (("--set", "vaiont", "--dip", 25, "--depth", 50), lambda a: a.words[1].depth, 50.0),
        "--density": (("--set", "vaiont", "--dip", 25, "--density", 2100), lambda a: a.words[1].density, 2100.0),
        "--speed": (("--set", "vaiont", "--speed", 3), lambda a: a.words[1].speed, 3.0),
        "--normal-stress": (("--set", "vaiont", "--normal-stress", 2e6), lambda a: a.words[1].normal_stress, 2e6),
        "--step": (("--set", "vaiont", "--step", 0.02), lambda a: a.words[2], 0.02),
        "--time": (("--set", "vaiont", "--time", 7), lambda a: a.words[3].time, 7.0),
        "--slip": (("--set", "vaiont", "--slip", 4), lambda a: a.words[3].slip, 4.0),
        "--share": (("--set", "vaiont", "--share", 0.2), lambda a: a.words[3].share, 0.2),
    },
    "table1.py": {
        "--material": (("--material", "{files}/stone.yaml"), lambda a: Path(a.words[7]).name, "stone.yaml"),
        "--disks": (("--disks", 88), lambda a: a.words[1], 88),
        "--seeds": (("--seeds", 7, 8), lambda a: a.words[2], [7, 8]),
        "--confining": (("--confining", "0.5,4"), lambda a: a.words[3], [0.5e6, 4e6]),
        "--slide-seeds": (("--slide-seeds", 9), lambda a: a.words[4], [9]),
        "--slide-pressures": (("--slide-pressures", "0.25,3"), lambda a: a.words[5], [0.25e6, 3e6]),
        "--strain": (("--strain", 0.03), lambda a: a.words[6], 0.03),
        "--out": ((), lambda a: str(a.words[0]), "{out}"),
        "--threads": (("--threads", 7), lambda a: a.words[8], 7),
        "--resume": (("--resume",), lambda a: a.words[9], True),
    },
    "verify.py": {
        "--only": (
            ("--only", "bonds", "cradle"),
            lambda a: sorted({c.run.__module__.split(".")[-1] for c in a.words[0]}),
            ["bonds", "impacts"],
        ),
        "--quick": (("--quick",), lambda a: a.named["quick"], True),
        "--threads": (("--threads", 7), lambda a: a.named["threads"], 7),
        "--resume": (("--resume",), lambda a: a.named["resume"], True),
        "--out": ((), lambda a: str(a.words[1]), "{out}"),
    },
    "wedge.py": {
        "--seconds": (
            ("--seconds", 3),
            lambda a: (Path(a.named["cwd"]) / "dry_hard.table").read_text().splitlines()[1].split()[0],
            "3.0",
        ),
        "--out": ((), lambda a: str(a.named["cwd"]), "{out}"),
    },
}

#: command: option: the file and the test that run it to its end.
RUN = {
    "jiufengershan.py": {
        "--threads": "test_experiment.py::test_another_number_of_threads_gives_the_same_bits",
        "--end": "test_experiment.py::test_an_early_end_and_a_resume_give_the_same_bits",
        "--no-figures": "test_experiment.py::test_another_number_of_threads_gives_the_same_bits",
    },
    "slope.py": {
        "--threads": "test_any_slope.py::test_a_mirrored_slope_has_the_mirrored_bits",
        "--end": "test_any_slope.py::test_every_shipped_section_begins",
        "--no-figures": "test_any_slope.py::test_a_mirrored_slope_has_the_mirrored_bits",
        "--list": "test_any_slope.py::test_shipped_sections_are_listed",
    },
    "yade_examples.py": dict.fromkeys(
        ("--kind", "--only", "--steps", "--soft", "--sources", "--out", "--threads"),
        "test_yade_scripts.py::test_the_command_writes_what_became_of_the_scripts_asked_for",
    ),
    "column.py": {"--profiles": "test_columns.py::test_profiles_are_those_of_the_columns_that_came_to_rest"},
    "film.py": {
        "--out": "test_moving.py::test_any_script_is_filmed_as_it_is",
        "--frames": "test_moving.py::test_any_script_is_filmed_as_it_is",
        "--threads": "test_moving.py::test_any_script_is_filmed_as_it_is",
        "--period": "test_moving.py::test_options_of_the_command_reach_the_film",
        "--fps": "test_moving.py::test_options_of_the_command_reach_the_film",
        "--no-forces": "test_moving.py::test_options_of_the_command_reach_the_film",
    },
    "sweep.py": {"--draw": "test_campaign.py::test_results_are_drawn_against_what_was_varied"},
    "sliding_block.py": {
        "--out": "test_slip_block.py::test_the_command_writes_series_summary_and_figure",
        "--list": "test_slip_block.py::test_the_command_tells_laws_and_sets",
    },
    "soak.py": {"--out": "test_soak.py::test_a_short_soak", "--threads": "test_soak.py::test_a_short_soak"},
    "verify.py": {"--list": "test_options.py::test_checks_are_listed"},
    "wedge.py": {"--resume": "test_examples.py::test_the_wedge_runs_what_is_not_there_and_draws_all"},
}
CASES = [(name, option) for name, options in WHERE.items() for option in options]


def parser_of(name, monkeypatch):
    """The parser that a command makes."""
    found = []

    def taken(self, *_):
        found.append(self)
        raise SystemExit

    monkeypatch.setattr(argparse.ArgumentParser, "parse_args", taken)
    monkeypatch.setattr(sys, "argv", [name])
    with pytest.raises(SystemExit):
        runpy.run_path(str(SCRIPTS / name), run_name="__main__")
    return found[0]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_of_a_command_has_its_place(name, monkeypatch):
    options = {word for action in parser_of(name, monkeypatch)._actions for word in action.option_strings} - {
        "-h",
        "--help",
    }
    assert options == set(WHERE.get(name, ())) | set(RUN.get(name, ())), name
    assert not set(WHERE.get(name, ())) & set(RUN.get(name, ()))


@pytest.mark.parametrize("where", [where for options in RUN.values() for where in options.values()])
def test_a_test_that_is_named_is_there(where):
    file, test = where.split("::")
    assert f"\ndef {test}(" in next(Path(__file__).resolve().parents[1].rglob(file)).read_text()


@pytest.fixture
def asked(in_process, monkeypatch, tmp_path, files):
    """Calls a command with words until it asks its library: what it asked, None where it refuses the words."""

    def ask(name, words):
        holder, function = next((OTHERS[name, w] for w in words if (name, w) in OTHERS), HOLDER[name])
        asks = Search() if name == "calibrate.py" else Asks()
        out = tmp_path / {"calibrate.py": "out.yaml", "soak.py": "out.json"}.get(name, "out")
        words = [str(w).format(files=files) for w in (*FIRST.get(name, ()), *words)]
        with monkeypatch.context() as patch:
            patch.setattr(holder, function, asks)
            done = in_process(name, *words, "--out", out)
        assert done.status in (1, 2) and "Traceback" not in done.err, done.err
        return asks if done.last.endswith("error: asked") else None  # behind a bar that is gone

    return ask


@pytest.mark.parametrize("name, option", CASES, ids=[f"{name.removesuffix('.py')}{option}" for name, option in CASES])
def test_an_option_acts(asked, name, option, files, tmp_path):
    words, found, expected = WHERE[name][option]
    expected = expected(files) if callable(expected) else expected
    if isinstance(expected, str):
        expected = expected.format(out=tmp_path / "out")
    assert found(asked(name, words)) == expected
    if (
        option in words
    ):  # without it something else is asked, or nothing: no option passes because its value is the default
        with contextlib.suppress(AttributeError, KeyError, TypeError):
            assert found(asked(name, without(words, option))) != expected


def without(words, option):
    """The words without an option and its values."""
    at = words.index(option)
    following = [k for k in range(at + 1, len(words)) if str(words[k]).startswith("--")]
    return (*words[:at], *words[(following or [len(words)])[0] :])


def test_checks_are_listed(in_process):
    done = in_process("verify.py", "--list")
    assert done.status == 0 and "cradle" in done.out and "whole-avalanche" in done.out


# ---- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name, words, said",
    [
        ("sliding_block.py", (), "give --law, or --set"),
        ("sliding_block.py", ("--set", "lucas", "--depth", 3), "--depth and --density are of a slope: give --dip"),
        ("sliding_block.py", ("--set", "lucas", "--dip", 3, "--normal-stress", 1e6), "--normal-stress with --dip"),
        ("sliding_block.py", ("--set", "lucas", "--value", "friction"), "'friction': give KEY=NUMBER"),
        ("sliding_block.py", ("--set", "vajont"), "parameter set 'vajont': it must be one of vaiont"),
        ("sliding_block.py", ("--law", "gel"), "slip law 'gel': it must be one of none"),
        ("sliding_block.py", ("--set", "vaiont", "--dip", 95), "dip 95.0: give degrees from 0"),
        ("sliding_block.py", ("--set", "vaiont", "--share", 2), "share 2.0: give a share from 0"),
        ("calibrate.py", ("--cohesion", 0, "--friction", 30), "--cohesion 0: it must be positive"),
        (
            "calibrate.py",
            ("--cohesion", 60, "--friction", 30),
            "--cohesion 60: it is in Pa, as in sections, and 60 kPa are 60000",
        ),
        (
            "calibrate.py",
            ("--cohesion", 60e3, "--friction", 30, "--residual-friction", 20, "--residual-cohesion", 6),
            "--residual-cohesion 6: it is in Pa, as in sections, and 6 kPa are 6000",
        ),
        ("calibrate.py", ("--cohesion", 50e3, "--friction", 5), "--friction 5: granular samples reach 6°"),
        ("calibrate.py", ("--cohesion", 50e3, "--friction", 61), "--friction 61"),
        ("calibrate.py", ("--cohesion", 50e3, "--friction", 30, "--quick", "--fine", 900), "--fine 900 with --quick"),
        ("rocks.py", ("--seeds", 1), "--seeds 1: give 2 or more, each once"),
        ("rocks.py", ("--frictions", 0.3, 0.3), "--frictions 0.3 0.3: give 2 or more, each once"),
        ("rocks.py", ("--add", "--seeds", 4, 5), "--add with 1000 disks and seeds 4 5: samples are compared"),
        ("rocks.py", ("--add", "--check"), "not allowed with argument"),
        ("calibrate.py", ("--cohesion", 50e3, "--friction", 30, "--residual-friction", 20), "give both"),
        (
            "calibrate.py",
            ("--cohesion", 50e3, "--friction", 30, "--residual-friction", 31, "--residual-cohesion", 1e3),
            "--residual-friction 31",
        ),
        (
            "calibrate.py",
            ("--cohesion", 50e3, "--friction", 30, "--residual-friction", 20, "--residual-cohesion", 51e3),
            "--residual-cohesion 51000: give 0 or more",
        ),
        (
            "calibrate.py",
            ("--cohesion", 50e3, "--friction", 30, "--start", "granite"),
            "--start granite: neither a file nor one of",
        ),
        ("wall_shear.py", ("--material", "dp", "--bonded"), "--bonded with dp: its tensile strength is 0"),
        ("tension_test.py", ("--diameter", 4, 1), "--diameter 4 1: give the smallest first"),
        ("tension_test.py", ("--material", "dp"), "it bears no tension; give a material that is bonded"),
        ("tension_test.py", ("--grip", 30), "grip 30.0: give mean diameters from 0 to 15.2"),
        ("tension_test.py", ("--disks", 500, 500), "--disks: 500 500: give each once"),
        ("tension_test.py", ("--opening", 0.01), "opening 0.01: give mean diameters above 0.04"),
        ("wall_shear.py", ("--pressures", "1"), "give 2 or more positive pressures"),
        ("wall_shear.py", ("--pressures", "1,1"), "each once"),
        ("biaxial_effects.py", ("--confining", -1), "it must be positive"),
        ("biaxial_effects.py", ("--only", "colour"), "colour"),
        ("readings.py", ("--only", "shipped", "colour"), "colour"),
        ("readings.py", ("--platens", "glued"), "glued"),
        ("paper.py", ("--only", "shipped", "colour"), "colour"),
        ("paper.py", ("--only", "shipped", "shipped"), "each once"),
        ("paper.py", ("--seeds", 1, 1), "--seeds: 1 1: give each once"),
        ("paper.py", ("--seeds", -1), "seeds -1: give whole numbers from 0"),
        ("paper.py", ("--disks", 0), "disks 0: give a whole number from 1"),
        ("wedge.py", ("--seconds", 0.5), "--seconds: 0.5 is too short"),
        ("benchmark.py", ("--threads", 0), "--threads 0"),
        ("benchmark.py", ("--scale", "10,10"), "each once"),
        ("benchmark.py", ("--space", "10,0"), "give numbers of spheres"),
        ("benchmark.py", ("--space", "--scale", "10"), "--space --scale: give one of them"),
        ("column.py", ("--aspect", "1,1"), "give each number once"),
        (
            "column.py",
            ("--friction", 30),
            "30 is no coefficient of friction; friction is the tangent of an angle: 30 degrees are 0.577",
        ),
        *(
            (f"{name}.py", ("--seeds", 1, 2, 1, *more), "--seeds: 1 2 1: give each once")
            for name, *more in (
                ("column",),
                ("biaxial",),
                ("biaxial_effects",),
                ("readings",),
                ("table1",),
                ("tension_test",),
                ("wall_shear",),
                ("calibrate", "--cohesion", 5e4, "--friction", 30),
            )
        ),
        ("column.py", ("--profiles", "--kind", "pile"), "--profiles with --kind pile"),
        ("verify.py", ("--only", "perpetual-motion"), "--list names them"),
    ],
)
def test_a_command_refuses_in_one_line(in_process, tmp_path, name, words, said):
    out = tmp_path / ("out.yaml" if name == "calibrate.py" else "out")
    done = in_process(name, *words, "--out", out)
    assert done.status in (1, 2) and said in done.last and "Traceback" not in done.err
    assert not out.exists()
