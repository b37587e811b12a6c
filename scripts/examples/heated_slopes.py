# How a slope runs away as its slip surface heats: slip, time, temperature and speed until its strength has gone, for values of one key of its slip law, over packings.
# Usage: [YADE_BATCH=TABLE:2] scripts/yade-nonsmooth scripts/examples/heated_slopes.py [TABLE, its names in the first line, values in the second: section, key (of the section), values, labels, disks, seeds, folder]
# Prints for each value what became of its slopes: means over packings and half of their 95 % intervals. FOLDER/heated.json keeps them. Draws FOLDER/heated.png, friction
# that is left against slip and speed against time, and FOLDER/slip_surface.png, where along the surface of the first packing of the first value it was hot and weak.
import os
import sys
from pathlib import Path

from yade import utils
from yade.nonsmooth import campaign, figures, runs, section
from yade.nonsmooth.measure import heated_surface, statistics
from yade.nonsmooth.system import whole_files

utils.readParamsFromTable(
    section="vaiont", key="materials.clay.slip_law.set", values=["vaiont", "vaiont_thin"], labels=["a zone of 10 mm", "a zone of 1.4 mm"], disks=2500, seeds=5,
    folder="out/heated", noTableOk=True,
)  # fmt: skip
from yade.params import table

OF_RUN = ("water_at_failure_m", "weakening_s", "motion_s", "front_travel_m", "speed_mean_max_m_per_s")
TOLD = (
    ("after_s_5", "{} s after it moved at 0.1 m/s", 1), ("slip_m_5", "{} m of slip", 1), ("speed_m_per_s_5", "{} m/s", 1), ("temperature_degC_5", "{} °C in the mean", 0),
    ("hottest_degC_5", "{} °C at most", 0),
)  # fmt: skip
folder, seeds = Path(table.folder), list(range(1, table.seeds + 1))
if not isinstance(table.values, (list, tuple)) or (table.labels and len(table.labels) != len(table.values)):
    sys.exit(f"values {table.values}, labels {table.labels}: give a list of values, and a label for each or None")
slope = section.load(table.section).with_disks(table.disks)
walls = [wall.name for wall in slope.heated_surfaces]
if not walls:
    sys.exit(f"section {table.section}: no wall of role slip has a slip_law; give a section in which one has")
found = campaign.sweep(slope, {table.key: list(table.values), "seed": seeds}).run(folder, threads=os.cpu_count(), resume=True)
opened = [runs.open_run(folder / "runs" / name) for name in found["run"]]
of_surface = [heated_surface.numbers(run.series, run.slip_surface, walls) for run in opened]
for name in of_surface[0]:
    found[name] = [one[name] for one in of_surface]
label_of = dict(zip(map(str, table.values), table.labels or map(str, table.values)))
labels = [label_of[str(value)] for value in found[table.key]]


def said(row, name, digits):
    """A mean over packings with half of its interval."""
    return statistics.told(row["numbers"][name]["mean"], row["numbers"][name]["half_width"], digits)


told = {}
for row in campaign.means(found, [table.key, "seed"]):
    value = str(row["values"][table.key])
    print(f"{label_of[value]}: {len(row['seeds'])} of {row['of']} {row['verdict']}, the water at {said(row, 'water_at_failure_m', 0)} m")
    if row["numbers"]["after_s_5"]["mean"] is not None:
        print("  95 % of the strength had gone: " + ", ".join(words.format(said(row, name, digits)) for name, words, digits in TOLD))
    print(f"  mean speed up to {said(row, 'speed_mean_max_m_per_s', 1)} m/s, front {said(row, 'front_travel_m', 0)} m")
    one = told.setdefault(value.replace(".", "_"), {"packings": row["of"], "failed": 0, "stood": 0})
    kind = "failed" if row["verdict"].startswith("failed by") else row["verdict"].replace(" ", "_")
    one[kind] = one.get(kind, 0) + len(row["seeds"])
    one[f"when_{kind}"] = {name: row["numbers"][name] for name in (*OF_RUN, *of_surface[0]) if name in row["numbers"]}
whole_files.write_json(folder / "heated.json", told)
slid = [(label, run.series) for label, run in zip(labels, opened) if heated_surface.begin(run.series) is not None]
if slid:
    print(figures.heated_slopes(slid, folder / "heated.png"))
    first = next(run for run in opened if heated_surface.begin(run.series) is not None)
    print(figures.slip_surface(first.slip_surface, folder / "slip_surface.png", times=first.summary["times_s"]))
