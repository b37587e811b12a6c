import sys; sys.path.insert(0, "py")  # in YADE: from yade.nonsmooth import figures, section, and so on
from nonsmooth import figures, section
from nonsmooth.water import field_files, fields, mesher, seepage
from nonsmooth.water.conditions import Head, Reservoir

slope = section.load("circle")
soil = slope.layer("soil").points
ground, mountain = [(0, 0), (57.126, 40)], soil[soil[:, 0] > 74]  # the face of the slope, and the end of the circle
# a lake at its foot is drawn down, and water from the mountain falls more slowly: (lake, mountain) in m
levels = [(14, 26), (8, 25), (3, 24)]
mesh = mesher.of_section(slope, size=1.5, points=[(57.126 * lake / 40, lake) for lake, _ in levels])
states = [[Reservoir(ground, lake), Head(mountain[:-1], head)] for lake, head in levels]
found = seepage.course(mesh, 1e-6, states)  # m/s; seepage.tensor(1e-6, 2e-7, dip=-10) is bedded ground
for (lake, _), state in zip(levels, found):
    print(f"lake {lake:2d} m: {state.through:.2e} m2/s, water leaves up to {state.exit_point(ground)[1]:.1f} m")

field = fields.of_seepage(found, times=(0, 86400, 3 * 86400))
field_files.write(field, "out/seepage/field.h5")
figures.seepage(found[2], slope, path="out/seepage/seepage.png")
figures.pore_pressures(field, section=slope, path="out/seepage/pressures.png")
