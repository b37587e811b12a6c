"""Changes that compute the same for every input, or what nobody can be asked to test: the generators leave them out.

{(file, what stands there, what takes its place): reason}, both texts as the table of `random_mutants.py` shows them.
"""

STYLE = "py/nonsmooth/figures/style.py"

SAME = {
    (
        "pkg/dem/space/NscdSpacePhys.cpp",
        "m.bondEllipseTwisting < 0",
        "m.bondEllipseTwisting <= 0",
    ): "0 is refused where it is set",
    (
        "py/nonsmooth/studies/comparison/answers.py",
        'cheaper = found["factor"] if found["factor"] > 1 else 1 / found["factor"]',
        'cheaper = found["factor"] if found["factor"] >= 1 else 1 / found["factor"]',
    ): "1 and 1/1 are the same",
    (
        "py/nonsmooth/studies/laboratory/table1.py",
        "threads=1,",
        "threads=2,",
    ): "a choice: how many samples at a time where nobody says it; results have the same bits",
    ("py/nonsmooth/water/section_seepage.py", "if state.rain:", "if True:"): "a rain of 0 m/s brings nothing",
    (
        "py/nonsmooth/figures/scene.py",
        "strengths = np.concatenate(strengths) if strengths else np.zeros(0)",
        "strengths = np.concatenate(strengths) if strengths else np.zeros(1)",
    ): "a reference of no force draws no bars, as none does",
    (
        "py/nonsmooth/world/scene.py",
        "Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1 + far),",
        "Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=2 + far),",
    ): "the law leaves out what is beyond its reach: it costs time alone",
    (
        "py/nonsmooth/world/soft/functors.py",
        "model, damping, rolling_ratio=1.0, gravity=(0, -9.81, 0), verlet=0.1, before=(), after=(), every=200, ductile=False",
        "model, damping, rolling_ratio=1.0, gravity=(0, -9.81, 0), verlet=0.2, before=(), after=(), every=200, ductile=False",
    ): "a choice: how far boxes of neighbours reach costs time alone",
    (
        "py/nonsmooth/figures/film.py",
        'fps=fps, codec="h264", bitrate=-1,',
        'fps=fps, codec="h264", bitrate=-2,',
    ): "no bit rate at all is asked for by any number below 0",
    (
        "py/nonsmooth/judges/benchmark/scale.py",
        "of_sweeps = 5 + 1e-4 * sum(sizes)",
        "of_sweeps = 5 + 1e-4 / sum(sizes)",
    ): "a choice: how many seconds are foreseen",
    (
        "py/nonsmooth/water/phreatic.py",
        "pieces = [piece[np.isfinite(piece[:, 0])] for piece in ends]",
        "pieces = [piece[np.isfinite(piece[:, 1])] for piece in ends]",
    ): "a place that there is not has neither coordinate",
    (
        "py/nonsmooth/studies/slope/states.py",
        "KEPT_DAYS = 14 # without use; every build of the engines has states of its own",
        "KEPT_DAYS = 15 # without use; every build of the engines has states of its own",
    ): "a choice: how long states are kept that nobody uses",
    (
        "py/nonsmooth/measure/fluctuations.py",
        "return float(np.std(stress[inside] / about - 1)) if inside.any() else math.nan",
        "return float(np.std(stress[inside] / about - 1)) if True else math.nan",
    ): "the deviation of nothing is no number, with a warning of NumPy's",
    ("py/nonsmooth/figures/toe.py", "width = 2 * WIDTH / 3", "width = 2 * WIDTH / 4"): "a choice: how wide a panel is",
    (
        "py/nonsmooth/model/free_surface.py",
        "if reach < along < length - reach and geometry.distance(*(end - a - along * t)) <= reach:",
        "if reach < along < length + reach and geometry.distance(*(end - a - along * t)) <= reach:",
    ): "a piece that is shorter than the tolerance, at a wall's end, belongs to the wall",
    (
        "py/nonsmooth/studies/comparison/biaxials.py",
        'SOURCE, DISKS = "wwr", 1000',
        'SOURCE, DISKS = "wwr", 1001',
    ): "a choice: how many disks a sample has that is compared",
    (
        "pkg/dem/space/FaceGeom.cpp",
        "known && at.feature == space::Nearest::Face && known->normal.dot(normal) < 0",
        "known && at.feature == space::Nearest::Face && known->normal.dot(normal) <= 0",
    ): "two normals of one face are alike or opposite, and never at right angles",
    (
        "pkg/dem/space/SpaceSeamScatter.cpp",
        "phys.restitution > 0 && !phys.bonded && c.biasN > 0 && rows.n > 0",
        "phys.restitution > 0 && !phys.bonded && c.biasN >= 0 && rows.n > 0",
    ): "where nothing is to close and nothing comes nearer, no work is missed",
    (
        "pkg/dem/space/FaceJoints.cpp",
        "apartOfFaces * size + 16 * std::numeric_limits<Real>::epsilon() * farthest",
        "apartOfFaces * size + 16 * std::numeric_limits<Real>::epsilon() / farthest",
    ): "an allowance for rounding, of scenes ten million sizes away from the origin",
    (
        "py/nonsmooth/world/hardening/energies.py",
        "_heard = True",
        "_heard = False",
    ): "asked twice, a question is answered twice over, the same",
    (
        "py/nonsmooth/water/mesh.py",
        "low = np.clip(np.floor(corner.min(axis=1) - 1e-6).astype(int), 0, count - 1)",
        "low = np.clip(np.floor(corner.min(axis=1) - 2e-06).astype(int), 0, count - 1)",
    ): "an allowance for rounding; triangles that are listed twice are asked twice",
    (
        "py/nonsmooth/water/seepage.py",
        "out = nodes[self.exchanged[nodes] < -1e-9 * self.through]",
        "out = nodes[self.exchanged[nodes] < -2e-09 * self.through]",
    ): "an allowance for rounding",
    (
        "py/nonsmooth/figures/water.py",
        "still = np.ptp(result.head) <= 1e-9 * max(np.abs(result.head).max(), 1e-300)",
        "still = np.ptp(result.head) <= 2e-09 * max(np.abs(result.head).max(), 1e-300)",
    ): "an allowance for rounding",
    (
        "py/nonsmooth/studies/heaps/course.py",
        "RECORDS = 20 # to T = √(H/g)",
        "RECORDS = 21 # to T = √(H/g)",
    ): "a choice: how many rows a course has; what is read from them does not depend on it",
    (
        STYLE,
        'def draw_disks(ax, snapshot, colours, mask=slice(None), edge="none", width=0.0, zorder=2):',
        'def draw_disks(ax, snapshot, colours, mask=slice(None), edge="none", width=1.0, zorder=2):',
    ): "an edge of no colour is not drawn, however wide; who gives a colour gives a width",
    (
        "py/nonsmooth/studies/comparison/cases.py",
        "HARD_NUMERICS = ((2.0, 10.0), (2.0, 1.0), (1.0, 10.0), (0.5, 0.5))",
        "HARD_NUMERICS = ((2.0, 10.0), (2.0, 1.0), (1.0, 20.0), (0.5, 0.5))",
    ): "a choice: any coarser numerics can be compared with the last, and its rows say which they are",
    (
        "py/nonsmooth/studies/comparison/precision.py",
        "float(np.corrcoef(a, b)[0, 1]) if a.std() > 0 and b.std() > 0 else math.nan,",
        "float(np.corrcoef(a, b)[0, 1]) if True and b.std() > 0 else math.nan,",
    ): "NaN either way, with a warning of NumPy's besides",
    (
        "py/nonsmooth/measure/statistics.py",
        "return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) > 1 else math.nan",
        "return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) >= 1 else math.nan",
    ): "NaN either way, with a warning of NumPy's besides",
    (
        "py/nonsmooth/model/section/units.py",
        "return isinstance(value, (int, float)) and not isinstance(value, bool)",
        "return True and not isinstance(value, bool)",
    ): "what else a checked material holds, words, stands under no key that has bounds",
    (
        "py/nonsmooth/figures/toe.py",
        'bar = fig.colorbar(scale, ax=panels.tolist(), location="bottom", shrink=0.4, aspect=40, label=told, extend="both")',
        'bar = fig.colorbar(scale, ax=panels.tolist(), location="bottom", shrink=0.4, aspect=41, label=told, extend="both")',
    ): "a bar of colours that is thinner by a fortieth shows the same colours at the same places",
    (
        "py/nonsmooth/measure/strength.py",
        "if strain[-1] < plateau[0] + PEAK_WINDOW - 1e-8:",
        "if strain[-1] < plateau[0] + PEAK_WINDOW - 2e-08:",
    ): "rounding of a strain is far below either, and rows stand farther apart",
    (
        "py/nonsmooth/studies/laboratory/wall_shear.py",
        '"material": tests[0].material.name,',
        '"material": tests[1].material.name,',
    ): "all are of one material, and a line needs two",
    (
        "py/nonsmooth/packing/__init__.py",
        "h = sampler.random(int(1.1 * sum(counts) * box / section.area) + 100) + shift",
        "h = sampler.random(int(2.2 * sum(counts) * box / section.area) + 100) + shift",
    ): "more points of the same sequence, of which the first are taken",
    (
        "py/nonsmooth/studies/laboratory/rock_table.py",
        'seeds, fractions = found[0]["seeds"], [row["packing_fraction"] for row in found]',
        'seeds, fractions = found[1]["seeds"], [row["packing_fraction"] for row in found]',
    ): "all rocks have samples of the same seeds, and a table needs several",
    ("py/nonsmooth/studies/slope/wall_series.py", "if len(names) > 1", "if len(names) >= 1"): (
        "the sum over one wall is that of the wall, and is not asked for"
    ),
    (
        "py/nonsmooth/studies/laboratory/membrane.py",
        "if len(chain) > len(edges):",
        "if len(chain) >= len(edges):",
    ): "an outline that closes has fewer places than the triangles have sides; one that does not ends a step sooner",
    # ---- pkg/dem: what is only looked up, shown or asked once more
    (
        "pkg/dem/engines/PlateLoadEngine.cpp",
        "!former.empty()",
        "true",
    ): "interactions are shown where none is taken away, which changes no bit",
    ("pkg/dem/seam/Turn.cpp", "!data->shownAlone.empty()", "true"): "of no bodies none is taken again",
    (
        "pkg/dem/walls/WallJoints.cpp",
        "now != walls",
        "true",
    ): "joints of the same walls are found again and are the same",
    ("pkg/dem/engines/PlateLoadEngine.cpp", "rail < 0", "rail < 1"): (
        "hold() takes the former guide away where the rail is body #0, and soft contacts have none"
    ),
    (
        "pkg/dem/checks/ContactCheck.cpp",
        "known.count(b->material->getClassIndex()) || loop->physDispatcher->getFunctor2D(b->material, ours, swap)",
        "false || loop->physDispatcher->getFunctor2D(b->material, ours, swap)",
    ): "a class whose functor was found is asked about again, with the same answer",
    (
        "pkg/dem/seam/Audience.cpp",
        "1 - 1e-9",
        "1 - 2e-09",
    ): "who may act a rounding sooner is shown the bodies for nothing, which changes no bit",
    (
        "pkg/dem/walls/Arc.cpp",
        "-shift2",
        "shift2",
    ): "YADE turns the interaction round and calls go(): nobody calls goReverse()",
    # ---- pkg/dem: other numbers with the same answer
    (
        "pkg/dem/seam/GivenMotion.cpp",
        "s[0].velocity != 0 || s[1].velocity != 0 || s[2].velocity != 0",
        "true",
    ): "0 is added to the velocity of a body that nobody moves",
    (
        "pkg/dem/seam/ContactSeamGiven.cpp",
        "ri > 0 && rj > 0",
        "ri > 0 && rj >= 0",
    ): "no radius is 0: that of a disk is positive, else it is refused, and all others have -1",
    (
        "pkg/dem/materials/Law2_SegmentGeom_WallPhys_SlipWeakening.cpp",
        "-1",
        "-2",
    ): "to YADE's EnergyTracker any negative place is none yet",
    (
        "pkg/dem/engines/ContactDynamicsWarnings.cpp",
        "heaviest > 0 && lightest > contact::massJump * heaviest",
        "heaviest >= 0 && lightest > contact::massJump * heaviest",
    ): "where no body can move both are 0, and 0 is no more than 0",
    (
        "pkg/dem/checks/ContactCheck.cpp",
        "state.nx + state.ny + state.nz",
        "state.nx - state.ny + state.nz",
    ): "parts of a normal of length 1, or not finite: so is their sum, with either sign",
}
