"""Steady seepage and its forces: dams against the exact discharge and an obstacle problem, rain, layers against
FreeFEM, and disks in still, artesian and rising water.
"""

from __future__ import annotations

import math
import shutil
import subprocess

import numpy as np
from matplotlib.figure import Figure
from scipy import sparse
from scipy.sparse.linalg import spsolve

from ....figures import water as water_figures
from ....water import fields, forces, seepage
from ....water.conditions import Head, PressureHead, Rain, Reservoir, SeepageFace
from ....water.mesh import Mesh, grid
from ..claims import Claims, Findings
from ..registry import check

BLUE, RED, GREY = "#0072B2", "#D55E00", "#777777"
GAMMA = fields.UNIT_WEIGHT
#: Upstream, downstream and width [m] of dams.
DAMS = ((24, 4, 16), (10, 2, 5), (10, 2, 10))


def dam(upstream, downstream, width, size):
    """A rectangular dam on a grid of so long edges [m]; and the sides, upstream and downstream."""
    mesh = grid(np.linspace(0, width, round(width / size) + 1), np.linspace(0, upstream, round(upstream / size) + 1))
    left, right = [(0, 0), (0, upstream)], [(width, 0), (width, upstream)]
    return seepage.solve(mesh, 1.0, [Reservoir(left, upstream), Reservoir(right, downstream)]), left, right


def obstacle(upstream, downstream, width, size):
    """The free surface of the same dam by another way: places x and heights [m] of it.

    Baiocchi's w(x, y), the integral of h − t over t from y to the free surface, has Δw = 1 where it is above 0, and its
    values at the rim are known: an obstacle problem, solved here on a grid of five-point differences by the method of
    active sets. √w falls to 0 with a slope at the free surface, from which it is continued.
    """
    nx, ny = round(width / size), round(upstream / size)
    x, y = np.meshgrid(np.linspace(0, width, nx + 1), np.linspace(0, upstream, ny + 1))
    w = np.zeros(x.shape)
    w[:, 0] = 0.5 * (upstream - y[:, 0]) ** 2
    w[:, -1] = 0.5 * np.maximum(downstream - y[:, -1], 0) ** 2
    w[0] = 0.5 * (upstream**2 - (upstream**2 - downstream**2) * x[0] / width)

    def line(n):
        return sparse.diags([1.0, -2.0, 1.0], [-1, 0, 1], (n, n))

    laplace = sparse.kronsum(line(nx - 1), line(ny - 1), format="csr") / size**2
    rim = np.zeros((ny - 1, nx - 1))
    rim[:, 0] += w[1:-1, 0]
    rim[:, -1] += w[1:-1, -1]
    rim[0] += w[0, 1:-1]
    rim = 1.0 - rim.ravel() / size**2
    wet = np.ones(rim.size, bool)
    for _ in range(500):
        inner = np.zeros(rim.size)
        inner[wet] = spsolve(laplace[wet][:, wet].tocsc(), rim[wet])
        push = laplace @ inner - rim  # below 0 where w lies on 0 and would go on down
        after = np.where(wet, inner > 0, push > 0)
        if np.array_equal(after, wet):
            break
        wet = after
    root = np.sqrt(np.maximum(inner.reshape(ny - 1, nx - 1), 0))
    last = (root > 0).sum(axis=0) - 1
    heights = []
    for k, top in enumerate(last):  # off the surface itself, where differences of w are its own size
        at = top - np.array([2, 4, 6])
        heights.append(np.polyfit(root[at, k], y[at + 1, 0], 2)[-1])
    return x[0, 1:-1], np.array(heights)


def surface(result, x):
    """Height of the free surface [m] at places x."""
    return np.interp(x, *result.phreatic_line()[0].T)


@check("Seepage through dams", subject="Water", seconds=60, quick=8)
def seepage_through_dams(bench):
    """A rectangular dam of the width L between water of the depths H₁ and H₂, on a base that is tight. Water leaves
    below the lower level and through a seepage face above it. Whatever the free surface φ, with G the integral of h − y
    from 0 to φ, G' = −Q/k, and G goes from H₁²/2 to H₂²/2: so Q/k = (H₁² − H₂²)/2L exactly (Charny). The free surface
    is that of an obstacle problem, which another program solves on a finer grid. Dupuit's parabola, which has no
    seepage face, must not come out.
    """
    claims, figure = Claims(), Figure(figsize=(8.4, 3.6), layout="constrained")
    profile, errors = figure.subplots(1, 2)
    sizes = (1, 0.5) if bench.quick else (2, 1, 0.5, 0.25)
    marks, table = {24: "o", 5: "s", 10: "^"}, []
    for case in DAMS:
        upstream, downstream, width = case
        name = f"{upstream}/{downstream} m, {width} m wide"
        bench.progress(name)
        exact = (upstream**2 - downstream**2) / (2 * width)
        own = np.array(sizes) * (1 if upstream > 20 else 0.5)
        x, height = obstacle(*case, own[-1] / 2)
        places = width * np.array([0.25, 0.5, 0.75])
        reference, found = np.interp(places, x, height), []
        for size in own:
            result, left, right = dam(*case, size)
            found.append(surface(result, places))
            out = result.exit_point(right)
            table.append(
                (name, f"{size:g}", str(len(result.head)), str(result.iterations), f"{result.inflow_on(left):.4f}")
                + tuple(f"{v:.3f}" for v in surface(result, places))
                + (f"{out[1]:.2f}",)
            )
        why = "asked for; dry ground conducts a thousandth of wet, which measures 0.02 %"
        claims.near(f"{name}: discharge over k [m]", result.inflow_on(left), exact, why, relative=5e-3)
        balance = abs(result.inflow_on(left) + result.inflow_on(right)) / exact
        claims.at_most(f"{name}: what comes in and does not leave, by the flow", balance, 1e-9, "the linear solver's")
        off = np.abs(np.array(found) - reference).max(axis=1) / upstream
        why = "asked for is 0.02; dry ground that conducts lifts it by 0.0003"
        claims.at_most(
            f"{name}: free surface from the obstacle problem's, by H₁", off[-1], 2e-3, why, against="obstacle"
        )
        if case == DAMS[0]:
            for place, known in zip(places, (22.58, 20.42, 17.47)):
                at = f"{name}: free surface at {place:g} m [m]"
                claims.near(at, surface(result, place), known, "asked for", relative=0.02, against="literature")
            claims.near(
                f"{name}: end of it [m]",
                out[1],
                12.79,
                "asked for",
                relative=0.02 + 0.02 * bench.quick,
                against="literature",
            )
            dupuit = math.sqrt((upstream**2 + downstream**2) / 2)
            lift = surface(result, width / 2) - dupuit
            claims.at_least(f"{name}: above Dupuit's parabola in the middle [m]", lift, 3.0, "it is 3.2 m higher")
            profile.plot(*result.phreatic_line()[0].T, color=BLUE, label="triangles")
            profile.plot(x, height, color=RED, lw=0.8, ls="--", label="obstacle problem")
            all_x = np.linspace(0, width, 200)
            parabola = np.sqrt(upstream**2 - (upstream**2 - downstream**2) * all_x / width)
            profile.plot(all_x, parabola, color=GREY, lw=0.8, ls=":", label="Dupuit")
            largest = result
        change = np.abs(np.diff(found, axis=0)).max(axis=1) / upstream
        if len(change) > 1:
            rate = math.log2(change[-2] / change[-1])
            why = "linear in the length of edges, or better"
            claims.at_least(
                f"{name}: order of convergence of the free surface", rate, 0.8, why, against="itself, finer"
            )
        errors.loglog(own[:-1] / upstream, change, marker=marks[upstream if upstream > 20 else width], label=name)
    profile.set(xlabel="x [m]", ylabel="free surface [m]")
    errors.set(xlabel="length of edges by H₁", ylabel="change with half of it, by H₁")
    for ax in (profile, errors):
        ax.legend(frameon=False)
    heads = ("dam", "edges [m]", "nodes", "iterations", "Q/k [m]", "at L/4 [m]", "L/2", "3L/4", "end")
    plots = [
        (figure, "Left: free surfaces of the largest dam. Right: how it changes when edges are half as long."),
        (water_figures.seepage(largest), "The largest dam."),
    ]
    return Findings(claims, plots=plots, tables=[("Dams by the length of edges", heads, table)])


@check("Rain on a strip between two reservoirs", subject="Water", seconds=10, quick=4)
def rain_between_reservoirs(bench):
    """Rain N falls on a strip of the width L between water of the depths H₁ and H₂. As for a dam, G' = −Q/k, now with
    Q = Q₀ + N x: so Q₀ = k (H₁² − H₂²)/2L − N L/2 leaves upstream, and Q₀ + N L downstream. The free surface is that of
    Dupuit and Forchheimer where the strip is long.
    """
    claims, figure = Claims(), Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    width, height, left, right = 100, 16, 10, 8
    x = np.linspace(0, width, 101 if bench.quick else 201)
    mesh = grid(x, np.linspace(0, height, 17 if bench.quick else 33))
    sides = [(0, 0), (0, height)], [(width, 0), (width, height)]
    for rate, colour in ((5e-4, BLUE), (5e-3, RED), (2e-2, GREY)):
        given = [Reservoir(sides[0], left), Reservoir(sides[1], right), Rain([(0, height), (width, height)], rate)]
        result = seepage.solve(mesh, 1.0, given)
        base = (left**2 - right**2) / (2 * width)
        scale = base + rate * width / 2
        for side, expected, name in zip(sides, (base - rate * width / 2, -base - rate * width / 2), ("left", "right")):
            why = "dry ground conducts a little sideways"
            claims.near(
                f"N/k = {rate:g}: from the {name} by the flow",
                result.inflow_on(side) / scale,
                expected / scale,
                why,
                absolute=1e-3,
            )
        dupuit = np.sqrt(left**2 - (left**2 - right**2) * x / width + rate * x * (width - x))
        off = np.abs(surface(result, x) - dupuit)[10:-10].max() / dupuit.max()
        claims.at_most(
            f"N/k = {rate:g}: free surface from Dupuit and Forchheimer's",
            off,
            0.015,
            "the strip is ten times as long as high",
        )
        axes.plot(*result.phreatic_line()[0].T, color=colour, label=f"N/k = {rate:g}")
        axes.plot(x, dupuit, color=colour, lw=0.8, ls=":")
    axes.set(xlabel="x [m]", ylabel="free surface [m]")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Dotted: Dupuit and Forchheimer.")])


#: Flow below a weir in two layers, for FreeFEM: quadratic elements, finer at the weir's edges.
FREEFEM = """
int n = %d;
border b1(t=0, 40) {x=t; y=0;} border b2(t=0, 4) {x=40; y=t;} border b3(t=4, 10) {x=40; y=t;}
border b4(t=40, 26) {x=t; y=10;} border b5(t=26, 14) {x=t; y=10;} border b6(t=14, 0) {x=t; y=10;}
border b7(t=10, 4) {x=0; y=t;} border b8(t=4, 0) {x=0; y=t;} border b9(t=0, 40) {x=t; y=4;}
mesh Th = buildmesh(b1(4*n) + b2(n) + b3(n) + b4(4*n) + b5(8*n) + b6(4*n) + b7(n) + b8(n) + b9(8*n));
fespace Vh(Th, P2); fespace Ph(Th, P0);
Ph low = y < 4;
Ph kxx = low*(%.17g) + (1-low)*(%.17g), kxy = low*(%.17g) + (1-low)*(%.17g), kyy = low*(%.17g) + (1-low)*(%.17g);
Vh h, v;
solve weir(h, v) = int2d(Th)((kxx*dx(h) + kxy*dy(h))*dx(v) + (kxy*dx(h) + kyy*dy(h))*dy(v))
    + on(b6, h=16) + on(b4, h=11);
real energy = int2d(Th)((kxx*dx(h) + kxy*dy(h))*dx(h) + (kxy*dx(h) + kyy*dy(h))*dy(h));
cout.precision(12);
cout << "RESULT " << energy/5 << " " << h(17, 10) << " " << h(20, 10) << " " << h(20, 2) << endl;
"""


@check("Flow below a weir in two layers, against FreeFEM", subject="Water", seconds=30, quick=6)
def flow_below_a_weir(bench):
    """Ground of two layers whose beddings dip by 20° and −35°, ten and four times as conductive along as across them,
    40 m wide and 10 m deep; a weir of 12 m tightens the middle of its top, with water 6 m deep on its left and 1 m on
    its right. No closed form is known. FreeFEM solves it with quadratic elements on a mesh of its own; here triangles
    of a grid converge to it. At the weir's edges the flux is infinite, so that the discharge converges slowly, with the
    length of edges; two lengths are extrapolated. Without FreeFEM, convergence alone is claimed.
    """
    claims = Claims(against="FreeFEM")
    tensors = [seepage.tensor(1e-5, 1e-6, 20), seepage.tensor(4e-5, 1e-5, -35)]
    sizes, found = (1.0, 0.5) if bench.quick else (0.5, 0.25), []
    left, right = [(0, 10), (14, 10)], [(26, 10), (40, 10)]
    points = np.array([(17.0, 10.0), (20.0, 10.0), (20.0, 2.0)])
    for size in sizes:
        bench.progress(f"edges of {size:g} m")
        mesh = grid(np.linspace(0, 40, round(40 / size) + 1), np.linspace(0, 10, round(10 / size) + 1))
        lower = mesh.nodes[mesh.triangles].mean(axis=1)[:, 1] < 4
        mesh = Mesh.of(mesh.nodes, mesh.triangles, np.where(lower, 0, 1))
        result = seepage.solve(mesh, tensors, [Head(left, 16), Head(right, 11)])
        heads = mesh.at(result.head, points, mesh.locate(points))
        found.append(np.array([result.through, *heads]))
    coarse, fine = found
    best = 2 * fine - coarse
    change = abs(fine[0] / coarse[0] - 1)
    why = "the discharge is linear in the length of edges"
    claims.at_most("discharge: change with half the length of edges", change, 0.06, why, against="itself, finer")
    program, remarks = shutil.which("FreeFem++"), []
    if program is None:
        remarks.append("FreeFEM is not installed (apt install freefem++): not compared with it.")
    else:
        numbers = [t[k] for k in ((0, 0), (0, 1), (1, 1)) for t in tensors]
        script = bench.folder / "weir.edp"
        script.write_text(FREEFEM % (10 if bench.quick else 20, *numbers))
        done = subprocess.run(
            [program, "-nw", "-v", "0", script.name], cwd=bench.folder, capture_output=True, text=True, timeout=300
        )
        (line,) = (one for one in done.stdout.splitlines() if one.startswith("RESULT"))
        theirs = np.array([float(v) for v in line.split()[1:]])
        why = "two lengths extrapolated, and FreeFEM's own error at the edges"
        claims.near("discharge [m²/s]", best[0], theirs[0], why, relative=0.02 if bench.quick else 0.01)
        for (px, py), ours, other in zip(points, best[1:], theirs[1:]):
            claims.near(f"head at ({px:g}, {py:g}) m [m]", ours, other, why, absolute=0.02)
    figure = water_figures.seepage(result)
    return Findings(claims, plots=[(figure, "The weir lies on the top, from x = 14 to 26 m.")], remarks=remarks)


@check("Forces of water on disks", subject="Water", seconds=5)
def forces_of_water(bench):
    """Disks of any sizes and places. Still water bears the weight of what gives way: of the disks (area 'disk'), of
    their share of the bulk ('bulk'), or of the disks again where the bulk's forces and the water in the pores are both
    counted. A base with the uniform pressure u is relieved of u per metre. Grains float at the upward gradient
    (1 − n)(G − 1).
    """
    claims, dice = Claims(), np.random.default_rng(4)
    x, y = dice.uniform((0.5, 0.5), (29.5, 9.5), (2000, 2)).T
    r = dice.uniform(0.05, 0.25, 2000)
    area, share = math.pi * math.fsum(r**2), 0.84
    mesh = grid(np.linspace(0, 30, 61), np.linspace(0, 10, 21))
    still = fields.PhreaticLine([[(0, 25), (30, 25)]]).on(mesh)
    counts = {
        "disk": ({}, area),
        "bulk": ({"area": "bulk", "packing_fraction": share}, area / share),
        "bulk with the pores' water": ({"area": "bulk", "packing_fraction": share, "pore_water": True}, area),
    }
    for name, (options, volume) in counts.items():
        force = forces.on_disks(still, x, y, r, **options).sum(axis=0) / (GAMMA * volume)
        claims.near(f"still water, {name}: force over displaced weight", force[1], 1, "rounding", absolute=1e-10)
        claims.near(f"still water, {name}: sideways", force[0], 0, "rounding", absolute=1e-10)
    u = 2.1e5
    base = seepage.solve(mesh, 1e-6, [PressureHead([(0, 0), (30, 0)], u / GAMMA), SeepageFace([(0, 10), (30, 10)])])
    force = forces.on_disks(fields.of_seepage(base), x, y, r, area="bulk", packing_fraction=area / 300).sum(axis=0)
    why = "the seepage face lets a ten-thousandth of an edge stand on it"
    claims.near("artesian base: uplift over u times its length", force[1] / (30 * u), 1, why, absolute=3e-4)
    critical = forces.critical_gradient(0.6, 2650)
    rising = seepage.solve(mesh, 1e-4, [Head([(0, 0), (30, 0)], 40 + 10 * critical), Head([(0, 10), (30, 10)], 40)])
    options = {"area": "bulk", "packing_fraction": 0.6, "pore_water": True}
    lift = forces.on_disks(fields.of_seepage(rising), x, y, r, **options).sum(axis=0)[1]
    claims.near("lift over weight at the critical gradient", lift / (2.65 * GAMMA * area), 1, "rounding", absolute=1e-9)
    return Findings(claims)
