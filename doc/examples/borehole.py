import sys; sys.path.insert(0, "py")  # in YADE: from yade.nonsmooth import section
import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from matplotlib.figure import Figure
from nonsmooth import section

here, out = Path(__file__).parent / "borehole", Path("out/borehole")
survey, log, piezometers = (pd.read_csv(here / f"{name}.csv") for name in ("survey", "log", "piezometers"))
CROWN = -62.0  # where the section ends uphill [m]


def ground(x):
    return np.interp(x, survey.x_m, survey.y_m)


# ---- layers: the lower boundary of each is the straight line that fits its depths best
def boundary(layer):
    rows = log[log.layer == layer]
    return np.polyfit(rows.x_m, ground(rows.x_m) - rows.to_m, 1)


def comes_to_light(line):
    x, over = survey.x_m, survey.y_m - np.polyval(line, survey.x_m)
    k = over[over <= 0].index[0] - 1
    at = x[k] + over[k] / (over[k] - over[k + 1]) * (x[k + 1] - x[k])
    return float(at), float(np.polyval(line, at))


bedding, between = boundary("siltstone"), boundary("weathered")
foot, edge = comes_to_light(bedding), comes_to_light(between)
left = [(CROWN, float(np.polyval(line, CROWN))) for line in (bedding, between)] + [(CROWN, float(ground(CROWN)))]
face = [(float(x), float(ground(x))) for x in survey.x_m[::-1] if CROWN < x < foot[0]]
corners = [p for p in face if p[0] > edge[0]]  # of the face below the weathered rock
dip = math.degrees(math.atan(-bedding[0]))


# ---- strengths: Hoek, Carranza-Torres and Corkum (2002) for the rock, Barton and Bandis for the bedding
def hoek_brown(strength, gsi, mi, stress):
    """Cohesion [Pa] and angle of friction [degrees] of a rock mass in a slope with this vertical stress [Pa] at its foot."""
    m, s = mi * math.exp((gsi - 100) / 28), math.exp((gsi - 100) / 9)
    a = 0.5 + (math.exp(-gsi / 15) - math.exp(-20 / 3)) / 6
    mass = strength * (m + 4 * s - a * (m - 8 * s)) * (m / 4 + s) ** (a - 1) / (2 * (1 + a) * (2 + a))
    largest = 0.72 * mass * (mass / stress) ** -0.91 / strength
    base, both = (s + m * largest) ** (a - 1), (1 + a) * (2 + a)
    cohesion = strength * ((1 + 2 * a) * s + (1 - a) * m * largest) * base / (both * math.sqrt(1 + 6 * a * m * base / both))
    return cohesion, math.degrees(math.asin(6 * a * m * base / (2 * both + 6 * a * m * base)))


def barton_bandis(residual, roughness, wall, stress):
    """Angle of friction [degrees] of a joint under a normal stress [Pa], its walls as strong as ``wall`` [Pa]."""
    return residual + roughness * math.log10(wall / stress)


WEIGHT = 23e3  # N/m3, of the bulk
materials = {}
for name, rows in log.groupby("layer"):
    c, phi = hoek_brown(1e6 * rows.ucs_MPa.mean(), rows.gsi.mean(), rows.mi.mean(), WEIGHT * (ground(CROWN) - foot[1]))
    materials[name] = {"cohesion": 1e3 * round(c / 1e3), "friction_angle": round(phi, 1), "density": 2790}
    print(f"{name}: c = {c / 1e3:.0f} kPa, phi = {phi:.1f} degrees")
normal = WEIGHT * log[log.layer == "siltstone"].to_m.mean() * math.cos(math.radians(dip)) ** 2
joint = barton_bandis(residual=21, roughness=4, wall=10e6, stress=normal)
print(f"bedding: dips {dip:.1f} degrees, phi = {joint:.1f} degrees under {normal / 1e3:.0f} kPa")
materials["bedding"] = {"bonded": False, "friction": round(math.tan(math.radians(joint)), 3), "rolling_friction": 0}
materials["valley"] = {"bonded": False, "friction": 0.6, "rolling_friction": 0.1}


# ---- water: lines through the piezometers, down to where the bedding comes to light
def phreatic(heads):
    x, y = piezometers.x_m, ground(piezometers.x_m) - piezometers.tip_m + heads
    crown = y[0] + (y[1] - y[0]) / (x[1] - x[0]) * (CROWN - x[0])
    return [(CROWN, crown), *zip(x, y), foot]


def water(*columns):  # one state after another, 3 s apart
    lines = [{"time": 3 * k, "points": phreatic(piezometers[name])} for k, name in enumerate(columns, 1)]
    return {"water": {"volume": "bulk", "phreatic": {"flow": "along", "lines": lines}}}


slope = {
    "name": "Three boreholes",
    "walls": [
        {"name": "bedding", "role": "slip", "material": "bedding", "vertices": [(-72, np.polyval(bedding, -72)), foot]},
        {"name": "valley", "material": "valley", "vertices": [foot, *survey[survey.x_m > foot[0]].to_numpy(), (110, 10)]},
    ],
    "layers": [
        {"name": "siltstone", "material": "siltstone", "vertices": [foot, *corners, edge, left[1], left[0]]},
        {"name": "weathered", "material": "weathered", "vertices": [edge, *face[len(corners) :], left[2], left[1]]},
    ],
    "materials": materials,
    "disks": {"diameter": [0.8, 2.0], "packing_fraction": 0.84},
}
states = {"dry": {}, "measured": water("head_m"), "storm": water("head_m", "head_after_storm_m")}
out.mkdir(parents=True, exist_ok=True)
for name, more in states.items():
    plain = json.loads(json.dumps({**slope, **more}, default=lambda value: np.asarray(value).tolist()))
    (out / f"{name}.yaml").write_text(yaml.safe_dump(plain, sort_keys=False))
    made = section.load(str(out / f"{name}.yaml"))  # says what is wrong with it

figure = Figure(figsize=(9, 4.6), layout="constrained")
axes = figure.add_subplot()
for layer, colour in zip(made.layers, ("#c8b48c", "#e6d8b4")):
    axes.fill(*layer.points.T, color=colour, label=layer.name)
for wall in made.walls:
    axes.plot(*wall.points.T, color="black", lw=1.6)
for name, colour in (("head_m", "#0072B2"), ("head_after_storm_m", "#56B4E9")):
    axes.plot(*np.transpose(phreatic(piezometers[name])), color=colour, label=name.replace("_m", "").replace("_", " "))
for name, rows in log.groupby("borehole"):
    x, y = rows.x_m.iloc[0], ground(rows.x_m.iloc[0])
    axes.plot([x, x], [y, y - rows.to_m.max()], color="black", lw=1)
    axes.plot([x] * len(rows), y - rows.to_m, "k_", ms=9)
    axes.annotate(name, (x, y), (0, 5), textcoords="offset points", ha="center")
axes.plot(piezometers.x_m, ground(piezometers.x_m) - piezometers.tip_m, "v", color="#0072B2", label="tips of piezometers")
axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", xlim=(-75, 60))
axes.legend(frameon=False)
figure.savefig(out / "section.png", dpi=150)
