"""Pictures of the documentation that take seconds, as PNGs in a folder: the law drawn, the end of each lesson, hard (-1) and soft (-2), of the recipes, and of the README's script.

  scripts/yade-nonsmooth doc/examples/pictures.py FOLDER [law] [recipes] [LESSON …]
"""
import argparse
import dataclasses
import os
import sys

import numpy as np
from yade.nonsmooth import figures, scene_arrays, section
from yade.nonsmooth.figures import style
from yade.nonsmooth.figures.scene import Look as _Look

_ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(sys.argv[0]))))
_WORLDS = (("hard", "rigid disks"), ("soft", "springs"))


def _end_of(script):
    """Runs a script to its end in an empty scene, as YADE does: with its names among these, where engines look for them."""
    O.reset()
    with open(script) as text:
        exec(compile(text.read(), script, "exec"), globals())


def _the_law(folder):
    """Of the paper's slope; its two half-axes, which are equal, are drawn as different ones."""
    slope = section.load("jiufengershan")
    rock = slope.materials["rock"]
    figures.contact_law(rock, 2.0, f"{folder}/contact_law.png")
    figures.bond_zone(dataclasses.replace(rock, bond_ellipse=(0.02, 0.03)), path=f"{folder}/bond_zone.png")
    figures.water_forces(slope.water.dip, 2.0, rock.density, slope.water.unit_weight, slope.gravity, f"{folder}/water_forces.png")


def _drawn(script, title, path, width=5.6):
    """The end of a script as a picture ``width`` inches wide and as high as the scene asks for, with a title."""
    _end_of(script)
    x0, x1, y0, y1 = _Look([scene_arrays.read(O)]).box
    height = width * min(1.0, (y1 - y0) / (x1 - x0)) + 0.4
    figure = style.figure(width, height)
    axes = figure.add_axes([0.01, 0.0, 0.98, 1 - 0.4 / height])
    figures.draw(O, ax=axes)
    axes.set_title(title, fontsize=13, fontweight="bold")
    return figure, axes, path


def _the_recipes(folder):
    for k, (name, title) in enumerate((("conveyor", "a conveyor belt"), ("feeding", "feeding and erasing"), ("boulder", "a boulder"), ("gas", "a gas"))):
        figure, _, path = _drawn(f"{_ROOT}/doc/examples/{name}.py", title, f"{folder}/recipes-{k + 1}.png")
        style.save(figure, path, dpi=110)


def _the_lesson(name, folder):
    for k, (world, title) in enumerate(_WORLDS):
        # flat ones stand one above the other, others beside each other
        figure, axes, path = _drawn(f"{_ROOT}/scripts/examples/{world}_{name}.py", title, f"{folder}/lesson_{name}-{k + 1}.png", 9.0 if name in ("beam", "column") else 5.6)
        if name == "incline":  # of the lesson's own names
            for body, ratio in zip(blocks, RATIOS):
                place = O.bodies[body].state.pos
                label = f"μ = {ratio:g} tan θ" if ratio else "μ = 0"
                axes.annotate(label, (place[0], place[1]), (9, 7), textcoords="offset points", fontsize=9, zorder=6, path_effects=style.EDGE)
        style.save(figure, path, dpi=110)


@style.styled
def _the_tester(folder):
    """What LawTester finds, of springs and of rigid disks, beside the law's thresholds."""
    curves = {}
    for world, title in reversed(_WORLDS):  # the rigid ones' names stay
        _end_of(f"{_ROOT}/scripts/examples/{world}_tester.py")
        curves[title] = globals()["curves"]
    bond, arms = BOND, dict(pull=1, shear=table.friction, roll=ROLLING * LENGTH)
    figure = style.figure(11.0, 3.9)
    panels = (
        ("pull", "Pulled", "gap [mm]", 1e3, "tension [kN]", "F_a"),
        ("shear", "Sheared", "slip [mm]", 1e3, "shear force [kN]", r"\mu_s\,(F_a+N)"),
        ("roll", "Rolled", "angle [rad]", 1, "torque [kN m]", r"\mu_r\ell\,(F_a+N)"),
    )
    for ax, (way, title, across, unit, up, threshold) in zip(figure.subplots(1, 3), panels):
        for world, rows in curves.items():
            for (what, load), row in rows.items():
                if what != way:
                    continue
                x, _, y = np.array([(0, 0, 0), *row]).T
                look = dict(color=style.LINES["blue" if load else "orange"], ls="-" if world == "rigid disks" else (0, (2, 1.2)))
                ax.plot(unit * x, 1e-3 * y, **look, lw=2.2 if world == "rigid disks" else 1.4, label=f"{world}, N = {'F_a' if load else '0'}".replace("F_a", "$F_a$"))
                ax.plot(unit * x[-2], 1e-3 * y[-2], "o", ms=4.5, color=look["color"])
                if world == "rigid disks":
                    ax.axhline(1e-3 * arms[way] * (bond + load), color="#999999", lw=0.8, zorder=0.5)
        ax.set(title=f"{title}: ${threshold}$", xlabel=across, ylabel=up, ylim=(0, None))
        ax.margins(y=0.12)
    handles = figure.axes[1].get_legend_handles_labels()
    figure.legend(*handles, loc="lower center", ncol=4)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.91, bottom=0.26, wspace=0.28)
    style.save(figure, f"{folder}/lesson_tester.png", dpi=110)


@style.styled
def _the_heated(folder):
    """What is left of the strength by slip and by time, of springs and of rigid disks, beside the closed form."""
    figure = style.figure(11.0, 4.2)
    by_slip, by_time = figure.subplots(1, 2, sharey=True)
    lanes = ("heated", "pushed", "twice as thick")  # half as deep is the same line as heated
    for world, title in reversed(_WORLDS):
        _end_of(f"{_ROOT}/scripts/examples/{world}_heated.py")
        for name, colour in zip(lanes, style.line_colours(len(lanes))):
            time, slip, share, _ = np.array(globals()["curves"][name]).T
            look = dict(color=colour, ls="-" if world == "hard" else (0, (2, 1.2)), lw=1.6 if world == "hard" else 2.4)
            by_slip.plot(slip, share, **look)
            by_time.plot(time, share, **look, label=f"{name}, {title}")
    for thick in (1, 2):
        slip = np.linspace(0, 6, 200)
        by_slip.plot(slip, np.exp(-slip * table.friction * PRESSURE / (HEAT * thick * table.thickness)), color="k", lw=0.8, ls=":", label=r"$e^{-\delta/D_c}$" if thick == 1 else None)
    by_slip.set(xlabel="slip [m]", ylabel="strength that is left", xlim=(0, 6), ylim=(0, 1.05))
    by_time.set(xlabel="time [s]", xlim=(0, 3))
    by_slip.axhline(0.1, color="#999999", lw=0.8, zorder=0.5)
    by_slip.legend()
    lines = dict(zip(*reversed(by_time.get_legend_handles_labels())))
    names = [f"{name}, {title}" for name in lanes for _, title in _WORLDS]  # a column a lane
    figure.legend([lines[name] for name in names], names, loc="lower center", ncol=3)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.97, bottom=0.26, wspace=0.06)
    style.save(figure, f"{folder}/lesson_heated.png", dpi=110)


_parser = argparse.ArgumentParser(description=__doc__)
_parser.add_argument("folder")
_parser.add_argument("pictures", nargs="*", metavar="LESSON")
_parser.add_argument("--threads", help="read by the launcher")
_given = _parser.parse_args()
for _name in _given.pictures or ("law", "recipes", "beam", "column", "drum", "heated", "incline", "pile", "press", "shear", "slope", "tester", "wedge"):
    if _name == "law":
        _the_law(_given.folder)
        continue
    if _name == "recipes":
        _the_recipes(_given.folder)
        continue
    if _name in ("heated", "tester"):
        {"heated": _the_heated, "tester": _the_tester}[_name](_given.folder)
        continue
    _the_lesson(_name, _given.folder)
if not _given.pictures:
    _end_of(f"{_ROOT}/doc/examples/falling_block.py")
    figures.draw(O, f"{_given.folder}/falling_block.png")
