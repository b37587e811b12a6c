"""The law drawn, for teachers: thresholds of a contact, the zone in which a bond lives, the forces of water on a disk.

Sketches of our own of what the paper's Figures 1, 2 and 4 are about (Taboada and Estrada 2009, sections 2.2, 3.4 and
5.4), drawn from the numbers of a material and of a slope.
"""

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.patches import Arc, Circle, Ellipse, Polygon, Rectangle

from ..errors import UserError
from ..system import checks
from . import given, style
from .style import DRY, GROUND, INK, LINES, WALL, WATER, WET

__all__ = ["bond_zone", "contact_law", "water_forces"]

BOND, LOOSE = "bond", "touching, without a bond"
COLOURS = {BOND: LINES["blue"], LOOSE: LINES["orange"]}
HALF = 0.3  # velocity at which a bond that closes comes to touch, and to its length, in the sketch
SAMPLE = 1e5  # Pa, over ℓ: the normal force that is drawn where nothing is cohesive
FAINT = "#999999"
PAPER = dict(fc="white", ec="none", alpha=0.8, pad=0.8)  # behind words that stand on a line
#: Forces on a wet disk: what each is, and its colour.
FORCES = {"W": r"\rho\,g\,V", "F_b": r"\gamma_wV", "F_s": r"\gamma_wV\,\sin\beta", "F_p": r"\gamma_wV\,\cos\beta"}
COLOUR_OF = {"W": INK, "F_b": LINES["green"], "F_s": LINES["orange"], "F_p": LINES["blue"]}
TABLE = 6.6  # height of the water table in the sketch


# ---- thresholds -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class _State:
    """Strengths of a contact: σ [Pa], μ_s, μ_r."""

    stress: float
    sliding: float
    rolling: float


@given.takes(material=given.MATERIAL)
@style.styled
def contact_law(material, diameter=2.0, path=None, pdf=False):
    """The three graphs of a contact, equations (1), (3) and (5), and below them what each threshold is, equations (2),
    (4) and (6).

    ``material``: a `section.Material`; ``diameter``: ℓ [m]. A material that is bonded has two curves, of a bond and of
    a touching contact without one; another has the second alone. With ``bonds_close`` a bond has, with a half of its
    gap closed, a way between touch and its length on which no normal force acts. Sliding and rolling are drawn at the
    normal force F_a, or 100 kPa times ℓ where there is no cohesion. Forces are those of a slice 1 m thick. Raises
    UserError where the diameter is not positive.
    """
    if not diameter > 0:
        raise UserError(f"diameter = {diameter:g} m: it must be positive; give the mean diameter of two disks")
    bond = _State(material.tensile_strength, material.friction, material.rolling_friction)
    loose = _State(material.residual_tensile_strength, material.residual_friction, material.residual_rolling_friction)
    states = {BOND: bond, LOOSE: loose} if material.bonded else {LOOSE: loose}
    normal = diameter * (max(state.stress for state in states.values()) or SAMPLE)
    fig = style.figure(8.8, 6.6)
    graphs, thresholds = fig.subplots(2, 3)
    fig.subplots_adjust(left=0.08, right=0.985, top=0.95, bottom=0.19, wspace=0.42, hspace=0.42)
    _separation(graphs[0], states, diameter, normal, material.bonds_close)
    _tension(thresholds[0], states, diameter)
    for above, below, name, speed, letter, before, arm, friction in (
        (graphs[1], thresholds[1], "Sliding", "tangential velocity $U^t$", "T", r"\mu_s", 1.0, "sliding"),
        (graphs[2], thresholds[2], "Rolling", "angular velocity $w$", r"\Gamma", r"\mu_r\ell", diameter, "rolling"),
    ):
        cones = {
            key: (state.stress * diameter, arm * getattr(state, friction)) for key, state in states.items()
        }  # its apex is at −F_a, its sides rise as μ_s or μ_r ℓ
        _friction(above, name, speed, letter, cones, normal)
        _envelope(below, letter, before, cones, normal)
    told = [
        rf"{name}: $\sigma$ = {1e-3 * s.stress:g} kPa, $\mu_s$ = {s.sliding:g}, $\mu_r$ = {s.rolling:g}"
        for name, s in states.items()
    ]
    fig.legend(
        graphs[0].get_legend_handles_labels()[0], told, loc="lower center", ncol=2, title=rf"$\ell$ = {diameter:g} m"
    )
    return style.save(fig, path, pdf)


def _separation(ax, states, diameter, normal, closes):
    """Normal force against the velocity at which two bodies part. A bond that ``closes`` is drawn with a half of its
    gap closed: it comes to touch at one velocity, and to its length at another.
    """
    factor, unit = style.force_unit(normal)
    high = normal / factor
    for name, state in states.items():
        adhesion = state.stress * diameter / factor
        if closes and name == BOND:
            way = ([-HALF, -HALF, HALF, HALF, 1], [2.5 * high, 0, 0, -adhesion, -adhesion])
        else:
            way = ([0, 0, 1], [2.5 * high, -adhesion, -adhesion])
        ax.plot(*way, label=name, **_look(name))
    _cross(ax, "Separation", "normal velocity $U^n$", f"normal force $N$ [{unit}]")
    ax.set(xlim=(-0.55 if closes else -0.25, 1.02), ylim=(-1.7 * high, 2.5 * high))
    lowest = -max(state.stress for state in states.values()) * diameter / factor
    ax.text(0.06, 1.4 * high, "holds", va="center")
    if closes and BOND in states:
        ax.set_xticks([-HALF, 0, HALF], ["to touch", "0", "to length"], fontsize="small")
        ax.set_xlabel("normal velocity $U^n$, bond half closed")
    ax.text(0.55, lowest - 0.12 * high, "opens, $N=-F_a$", ha="center", va="top")


def _friction(ax, name, speed, letter, cones, normal):
    """Shear force or torque against its velocity, at one normal force."""
    largest = max(slope * (adhesion + normal) for adhesion, slope in cones.values())
    factor, unit = _unit(letter, largest)
    for key, (adhesion, slope) in cones.items():
        threshold = slope * (adhesion + normal) / factor
        ax.plot([-1, 0, 0, 1], [threshold, threshold, -threshold, -threshold], label=key, **_look(key))
    what = "torque" if letter != "T" else "shear force"
    held, held_unit = style.force_unit(normal)
    _cross(ax, f"{name}, at $N$ = {normal / held:g} {held_unit}", speed, f"{what} ${letter}$ [{unit}]")
    top = 1.45 * largest / factor or 1.0
    ax.set(xlim=(-1.02, 1.02), ylim=(-top, top))
    high = largest / factor + 0.05 * top
    ax.text(-0.55, high, rf"${letter}_\mathrm{{max}}$", ha="center", va="bottom")
    ax.text(0.55, -high, rf"$-{letter}_\mathrm{{max}}$", ha="center", va="top")


def _tension(ax, states, diameter):
    """The greatest tension of a contact against ℓ."""
    reach = 2 * diameter
    largest = max(state.stress for state in states.values()) * reach
    factor, unit = style.force_unit(largest or SAMPLE * reach)
    for name, state in states.items():
        ax.plot([0, reach], [0, state.stress * reach / factor], label=name, **_look(name))
        ax.plot(diameter, state.stress * diameter / factor, "o", color=COLOURS[name], ms=5, zorder=4)
    ax.set(xlim=(0, reach), ylim=(0, 1.1 * largest / factor or 1.0), title="$F_a=\\sigma\\,\\ell$")
    ax.set(xlabel=r"mean diameter $\ell$ [m]", ylabel=f"tension $F_a$ [{unit}]")


def _envelope(ax, letter, before, cones, normal):
    """What a contact bears of shear or torque against the normal force: a cone whose apex is at −F_a."""
    reach = 2.0 * normal
    across, across_unit = style.force_unit(normal)
    largest = max(slope * (adhesion + reach) for adhesion, slope in cones.values())
    factor, unit = _unit(letter, largest)
    for name, (adhesion, slope) in cones.items():
        apex, end = -adhesion / across, reach / across
        threshold = slope * (adhesion + reach) / factor
        ax.add_patch(
            Polygon([(end, threshold), (apex, 0), (end, -threshold)], fc=COLOURS[name], ec="none", alpha=0.08, zorder=1)
        )
        ax.plot([end, apex, end], [threshold, 0, -threshold], label=name, **_look(name))
    top = 1.3 * largest / factor or 1.0
    _cross(
        ax, rf"${letter}_\mathrm{{max}}={before}\,(F_a+N)$", f"normal force $N$ [{across_unit}]", f"${letter}$ [{unit}]"
    )
    ax.set(xlim=(-1.6 * normal / across, reach / across), ylim=(-top, top))
    adhesion, slope = next(iter(cones.values()))  # the bond, where there is one
    if adhesion > 0:
        ax.annotate("$-F_a$", (-adhesion / across, 0), (-4, 4), textcoords="offset points", ha="right", va="bottom")
    legs = np.array([0.6, 0.6, 1.6]) * normal
    heights = slope * (adhesion + legs[[0, 2, 2]])
    ax.plot(legs / across, heights / factor, color=INK, lw=0.9, zorder=4, label="slope")
    ax.annotate(
        f"${before}$",
        (legs[0] / across, heights[:2].mean() / factor),
        (-4, 2),
        textcoords="offset points",
        ha="right",
        va="center",
    )


def _unit(letter, largest):
    """Newtons, or newton metres, in the unit of a force or torque of a slice, and its name."""
    factor, unit = style.force_unit(largest)
    return factor, unit if letter == "T" else unit.replace("N/m", "N m/m")


def _look(name):
    """How the curve of a state is drawn."""
    return dict(
        color=COLOURS[name], lw=2.2 if name == BOND else 1.8, ls="-" if name == BOND else (0, (3, 1.5)), zorder=3
    )


def _cross(ax, title, across, up):
    """Axes through zero; velocities have no scale."""
    ax.axhline(0, color=FAINT, lw=0.7, zorder=0.5)
    ax.axvline(0, color=FAINT, lw=0.7, zorder=0.5)
    ax.set(title=title, xlabel=across, ylabel=up)
    if "velocity" in across:
        ax.set_xticks([0])


# ---- the bond's zone ------------------------------------------------------------------------------


@given.takes(material=given.MATERIAL)
@style.styled
def bond_zone(material, gap=None, path=None, pdf=False):
    """Which disks are bonded, and the ellipse in which a bond lives; lengths in units of ℓ, true to scale.

    ``material``: a `section.Material`, of which Δ, ε_n and ε_t are taken; ``gap``: δ [ℓ] of the bond that is drawn, 0.6
    Δ unless given. Disks i and j have the diameter ℓ. Raises UserError for a gap that is negative or not below Δ.
    """
    reach = material.bond_creation_distance
    gap = 0.6 * reach if gap is None else gap
    if not 0 <= gap < reach:
        raise UserError(f"gap = {gap:g} ℓ: no bond is made over it; give a gap from 0 to below Δ = {reach:g} ℓ")
    zone = np.array(material.bond_ellipse)
    fig = style.figure(8.8, 3.7)
    whole, begin, later = (fig.add_axes([left, 0.1, 0.32, 0.8]) for left in (0.005, 0.34, 0.675))
    half = 1.35 * max(reach, gap + zone[0], zone[1])
    centre = (0.5 + gap, 0.0)  # where P_j stands at first; the centre of disk i is the origin
    _pair(whole, reach, gap, half)
    _creation(begin, reach, gap, half)
    _zone(later, gap, zone, centre, half)
    return style.save(fig, path, pdf)


def _disk(ax, x, y, name=None, **look):
    ax.add_patch(Circle((x, y), 0.5, **{**dict(fc=DRY[1], ec=WALL, lw=1.2, zorder=2), **look}))
    if name:
        ax.text(x, y, f"${name}$", ha="center", va="center", fontsize=12, zorder=5)


def _pair(ax, reach, gap, half):
    """Two disks with a bond and one that is too far for it."""
    far = 1 + 2.5 * reach  # between the centres of k and the others
    along = (1 + gap) / 2
    top = (along, math.sqrt(far**2 - along**2))
    side = 0.95 + far / 2  # room for all three, and for words
    style.frame(ax, along - side, along + side, top[1] / 2 - side, top[1] / 2 + side)
    for x, y, name in ((0, 0, "i"), (1 + gap, 0, "j"), (*top, "k")):
        _disk(ax, x, y, name)
    ax.add_patch(Circle((0, 0), 0.5 + reach, fc="none", ec=LINES["green"], lw=1.1, ls=(0, (4, 2)), zorder=3))
    ax.plot([0.12, 1 + gap - 0.12], [0, 0], color=COLOURS[BOND], lw=2.2, zorder=4, label=BOND)
    ax.add_patch(Rectangle((0.5 + gap / 2 - half, -half), 2 * half, 2 * half, fc="none", ec=INK, lw=0.9, zorder=5))
    ax.text(0, -0.6 - reach, r"$\Delta\,\ell$ around $i$", color=LINES["green"], ha="center", va="top")
    ax.set(title="Which are bonded", xlabel="$i$ with $j$; $k$ is too far from both")


def _window(ax, gap, half, shift=(0.0, 0.0)):
    """Around the gap: disk i, and disk j, which is where it was at first but for ``shift`` [ℓ]."""
    middle = 0.5 + gap / 2
    style.frame(ax, middle - half, middle + half, -half, half)
    for spine in ax.spines.values():
        spine.set_visible(True)
    _disk(ax, 0, 0)
    _disk(ax, 1 + gap + shift[0], shift[1])
    for name, side in (("i", -1), ("j", 1)):
        ax.text(middle + 0.88 * side * half, 0.86 * half, f"${name}$", ha="center", va="center", fontsize=12, zorder=6)


def _creation(ax, reach, gap, half):
    """The gap between the two nearest points, against Δ."""
    _window(ax, gap, half)
    for name, x, side in (("i", 0.5, -1), ("j", 0.5 + gap, 1)):
        ax.plot(x, 0, "o", color=INK, ms=5, zorder=6)
        ax.text(x + 0.08 * side * half, 0, f"$P_{name}$", ha="right" if side < 0 else "left", va="center", zorder=6)
    for end, way, colour, word in ((gap, 1, INK, r"$\delta$"), (reach, -1, LINES["green"], r"$\Delta\,\ell$")):
        y = 0.55 * way * half
        for x in (0.5, 0.5 + end):
            ax.plot([x, x], [0, 1.12 * y], color=FAINT, lw=0.7, zorder=4)
        _measure(ax, (0.5, y), (0.5 + end, y), colour)
        ax.text(0.5 + end / 2, 1.12 * y, word, color=colour, ha="center", va="bottom" if way > 0 else "top", zorder=6)
    ax.set_title(r"A bond is made: $\delta<\Delta\,\ell$")
    ax.set_xlabel(rf"$\delta$ = {gap:g} $\ell$, $\Delta$ = {reach:g}")


def _zone(ax, gap, zone, centre, half):
    """The ellipse around the place where P_j stood, and where it stands now."""
    way = zone * (0.5, 0.55)  # inside: 0.25 + 0.3025 < 1
    _window(ax, gap, half, way)
    _disk(ax, 1 + gap, 0, fc="none", ec=FAINT, ls=(0, (2, 2)), zorder=3)
    ax.add_patch(Ellipse(centre, *(2 * zone), fc=to_rgba(COLOURS[BOND], 0.18), ec=COLOURS[BOND], lw=1.6, zorder=4))
    for end in ((centre[0] - zone[0], 0), (centre[0], -zone[1])):
        ax.plot(*zip(centre, end), color=COLOURS[BOND], lw=1.2, zorder=5)
    ax.text(centre[0] - zone[0] / 2, 0.05 * half, r"$\epsilon_n\ell$", ha="center", va="bottom", zorder=6)
    ax.text(centre[0] + 0.05 * half, -zone[1] / 2, r"$\epsilon_t\ell$", ha="left", va="center", zorder=6)
    now = np.add(centre, way)
    look = dict(arrowstyle="-|>", color=INK, lw=1.1, shrinkA=3, shrinkB=2)
    ax.annotate("", now, centre, arrowprops=look, zorder=6)
    ax.plot(*centre, "o", color=INK, mfc="white", ms=5, zorder=6)
    ax.plot(*now, "o", color=INK, ms=5, zorder=7)
    ax.text(now[0] + 0.07 * half, now[1] + 0.04 * half, "$P_j$", ha="left", va="center", zorder=7)
    ax.set_title("It lives while $P_j$ is in the zone")
    ax.set_xlabel(rf"seen from $i$; $\epsilon_n$ = {zone[0]:g}, $\epsilon_t$ = {zone[1]:g}")


def _measure(ax, a, b, colour):
    """A length between two points, with an arrow at each end."""
    look = dict(arrowstyle="<|-|>", color=colour, lw=0.9, shrinkA=0, shrinkB=0, mutation_scale=8)
    ax.annotate("", b, a, arrowprops=look, zorder=6)


# ---- water ----------------------------------------------------------------------------------------


@given.takes(
    dip=checks.real("give the slope of the layers to the horizontal [degrees]"),
    **{name: checks.real("give a number above 0") for name in ("diameter", "density", "unit_weight", "gravity")},
)
@style.styled
def water_forces(dip, diameter=2.0, density=2500.0, unit_weight=9810.0, gravity=9.81, path=None, pdf=False):
    """Weight of a disk below a water table that is parallel to the slope, the forces of the water on it, and how these
    add up: F_p = F_b + F_s.

    The buoyancy F_b = γ_w V points upwards, the seepage force F_s = γ_w V sin β down the slope; so F_p = γ_w V cos β is
    normal to the slope (equations (7) and (18)), with V = π d²/4 of a slice 1 m thick. Arrows of one panel are true to
    scale, the slope is not.

    ``dip``: β [degrees], positive where the slope falls to the right; ``diameter`` d [m]; ``density`` of the disk
    [kg/m³]; ``unit_weight`` γ_w [N/m³]; ``gravity`` [m/s²]. Raises UserError for a dip that is no slope's and for
    numbers that are not positive.
    """
    if not -90 < dip < 90:
        raise UserError(
            f"dip = {dip:g}°: it must lie between -90° and 90°; give the slope of the layers to the horizontal"
        )
    for name, value in dict(diameter=diameter, density=density, unit_weight=unit_weight, gravity=gravity).items():
        if not value > 0:
            raise UserError(f"{name} = {value:g}: it must be positive; leave it out for the default")
    volume = math.pi * diameter**2 / 4
    along, normal = _axes(dip)
    lift = unit_weight * volume
    buoyancy, seepage = np.array([0.0, lift]), lift * math.sin(math.radians(abs(dip))) * along
    forces = {
        "F_b": buoyancy,
        "F_s": seepage,
        "F_p": buoyancy + seepage,
        "W": np.array([0.0, -density * gravity * volume]),
    }
    fig = style.figure(8.8, 4.6)
    _slope(fig.add_axes([0.0, 0.0, 0.6, 1.0]), dip, along, normal, forces)
    _sums(fig.add_axes([0.62, 0.34, 0.37, 0.64]), dip, forces)
    factor, unit = style.force_unit(max(math.hypot(*force) for force in forces.values()))
    for k, (name, is_what) in enumerate(FORCES.items()):
        size = math.hypot(*forces[name]) / factor
        fig.text(0.64, 0.26 - 0.07 * k, f"${name}={is_what}$ = {size:.1f} {unit}", color=COLOUR_OF[name], va="center")
    return style.save(fig, path, pdf)


def _axes(dip):
    """Unit vectors down the slope and normal to it, upwards."""
    beta, side = math.radians(abs(dip)), -1.0 if dip < 0 else 1.0
    return np.array([side * math.cos(beta), -math.sin(beta)]), np.array([side * math.sin(beta), math.cos(beta)])


def _arrow(ax, tail, vector, name):
    look = dict(arrowstyle="-|>", color=COLOUR_OF[name], lw=2.2, shrinkA=0, shrinkB=0, mutation_scale=13)
    if np.any(vector != 0):
        ax.annotate("", tail + vector, tail, arrowprops=look, zorder=6)


def _named(ax, name, place, ha, va="center"):
    """A force's symbol at a place."""
    ax.text(*place, f"${name}$", color=COLOUR_OF[name], ha=ha, va=va, fontsize=12, zorder=7)


def _beta(ax, vertex, radius, beta, middle):
    """The angle β [degrees] at a point, between two lines whose middle has the direction ``middle`` [degrees]; nothing
    where it is zero.
    """
    if beta > 0:
        turn = math.radians(middle)
        ax.add_patch(
            Arc(
                vertex,
                2 * radius,
                2 * radius,
                theta1=middle - beta / 2,
                theta2=middle + beta / 2,
                color=INK,
                lw=0.9,
                zorder=3,
            )
        )
        ax.text(
            *np.add(vertex, 1.18 * radius * np.array([math.cos(turn), math.sin(turn)])),
            r"$\beta$",
            ha="center",
            va="center",
            fontsize=11,
        )


def _slope(ax, dip, along, normal, forces):
    """The disk in its slope: the longest arrow is four units long, the water table stands at TABLE above the plane, the
    surface at 8.
    """
    side, beta = -1.0 if dip < 0 else 1.0, abs(dip)
    low, high = -5.0, 5.0  # down the slope

    def at(s, n):
        return s * along + n * normal

    def strip(a, b):
        return [at(low, a), at(high, a), at(high, b), at(low, b)]

    box = np.array(strip(0, 8.3))
    (x0, y0), (x1, y1) = box.min(axis=0) - (0.3, 1.3), box.max(axis=0) + (0.3, 0.2)
    style.frame(ax, x0, x1, y0, y1)
    ax.add_patch(Polygon(strip(-30, 0), fc=GROUND, ec="none", zorder=0.5))
    ax.add_patch(Polygon(strip(0, 8), fc=DRY[1], ec="none", alpha=0.6, zorder=1))
    ax.add_patch(Polygon(strip(0, TABLE), fc=WET[1], ec="none", alpha=0.3, zorder=1.1))
    for n in np.arange(1.6, 8.1, 1.6):
        ax.plot(*zip(at(low, n), at(high, n)), color=FAINT, lw=0.7, zorder=1.2)
    ax.plot(*zip(at(low, 0), at(high, 0)), color=WALL, lw=1.8, zorder=3, label="plane")
    ax.plot(*zip(at(low, TABLE), at(high, TABLE)), color=WATER, lw=1.5, ls=(0, (5, 2)), zorder=3, label="water table")
    turned = dict(rotation=-dip, rotation_mode="anchor", ha="center", va="bottom")
    ax.text(*at(3.2, TABLE + 0.12), "water table", color=WATER, **turned)
    _measure(ax, at(-3.9, 0), at(-3.9, TABLE), WATER)
    ax.text(*at(-3.9, TABLE / 2), "$h_w$", color=WATER, ha="center", va="center", fontsize=11, bbox=PAPER, zorder=7)
    foot = at(4.4, 0)
    if beta > 0:
        ax.plot([foot[0], foot[0] - 3.4 * side], [foot[1], foot[1]], color=INK, lw=0.8, zorder=3)
    _beta(ax, foot, 2.7, beta, 180 - beta / 2 if side > 0 else beta / 2)
    centre, scale = at(-0.6, 4.5), 4 / max(math.hypot(*force) for force in forces.values())
    ax.add_patch(Circle(centre, 0.62, fc=WET[1], ec=WALL, lw=1.1, zorder=4))
    left, right = ("right", "left") if side > 0 else ("left", "right")  # of the tips, as of a slope to the right
    for name, dx, dy, ha, va in (
        ("W", 0, -0.15, "center", "top"),
        ("F_b", -0.15, 0.15, left, "center"),
        ("F_s", 0.2, -0.1, right, "center"),
        ("F_p", 0.15, 0.15, right, "center"),
    ):
        _arrow(ax, centre, scale * forces[name], name)
        if np.any(forces[name] != 0):
            _named(ax, name, centre + scale * forces[name] + (side * dx, dy), ha, va)


def _sums(ax, dip, forces):
    """The water's forces head to tail, F_b being one unit long."""
    side, beta = -1.0 if dip < 0 else 1.0, abs(dip)
    one = math.hypot(*forces["F_b"])
    corner, end = forces["F_b"] / one, forces["F_p"] / one
    style.frame(ax, *sorted((-0.45 * side, 0.95 * side)), -0.06, 1.12)
    for name, tail in (("F_b", (0, 0)), ("F_s", corner), ("F_p", (0, 0))):
        _arrow(ax, np.array(tail, float), forces[name] / one, name)
    left, right = ("right", "left") if side > 0 else ("left", "right")
    _named(ax, "F_b", (-0.05 * side, 0.5), left)
    _named(ax, "F_p", end / 2 + (0.06 * side, -0.02), right)
    if beta > 0:
        _named(ax, "F_s", (corner + end) / 2 + (0.05 * side, 0.06), right)
    _beta(ax, (0, 0), min(0.36, 0.8 * math.hypot(*end)), beta, 90 - side * beta / 2)
