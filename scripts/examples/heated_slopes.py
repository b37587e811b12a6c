# How a slope runs away as its slip surface heats: slip, time, temperature and speed until its strength has gone, for values of one key of its slip law, over packings;
# beside it, if asked, slopes whose slip surface has none, for values of another key.
# Usage: [YADE_BATCH=TABLE:2] scripts/yade-nonsmooth scripts/examples/heated_slopes.py [TABLE, its names in the first line, values in the second: section, key (of the section),
# values, labels, disks (None: as many as it has), seeds, folder; beside (a section), beside_key, beside_values, beside_labels]
# Prints for each value what became of its slopes: means over packings and half of their 95 % intervals. FOLDER/heated.json keeps them. Draws FOLDER/heated.png, friction
# that is left against slip and speed against time, and FOLDER/slip_surface.png, where along the surface of the first packing of the first value it was hot and weak.
import os
from pathlib import Path

from yade import utils
from yade.nonsmooth import campaign, commands, figures, runs, section
from yade.nonsmooth.errors import UserError
from yade.nonsmooth.measure import heated_surface, statistics
from yade.nonsmooth.system import whole_files

utils.readParamsFromTable(
    section="vaiont", key="materials.clay.slip_law.set", values=["vaiont", "vaiont_thin"], labels=["a zone of 10 mm", "a zone of 1.4 mm"], disks=2500, seeds=5,
    folder="out/heated", beside=None, beside_key=None, beside_values=None, beside_labels=None, noTableOk=True,
)  # fmt: skip
from yade.params import table

OF_RUN = ("water_at_failure_m", "triggering_s", "weakening_s", "motion_s", "front_travel_m", "speed_mean_max_m_per_s")
TOLD = (
    ("after_s", "{} s after it moved at 0.1 m/s", 1), ("slip_m", "{} m of slip", 1), ("speed_m_per_s", "{} m/s", 1), ("temperature_degC", "{} °C in the mean", 0),
    ("hottest_degC", "{} °C at most", 0),
)  # fmt: skip
folder = Path(table.folder)
told, drawn, heated = {}, [], []


def said(row, name, digits):
    """A mean over packings with half of its interval."""
    return statistics.told(row["numbers"][name]["mean"], row["numbers"][name]["half_width"], digits)


def planned(name, key, values, labels, heats):
    """The section, with its number of disks, and the plan of its runs, where all fits; nothing is run as yet."""
    if not isinstance(values, (list, tuple)) or (labels and len(labels) != len(values)):
        raise UserError(f"values {values}, labels {labels}: give a list of values, and a label for each or None")
    slope = section.load(name)
    if table.disks is not None:
        slope = slope.with_disks(table.disks)
    if heats and not slope.heated_surfaces:
        raise UserError(f"section {name}: no wall of role slip has a slip_law; give a section in which one has")
    return slope, campaign.sweep(slope, {key: list(values), "seed": list(range(1, table.seeds + 1))})


def compare(slope, plan, key, values, labels, out, heats):
    """Runs the plan, prints and keeps what became of each value."""
    walls = [wall.name for wall in slope.heated_surfaces]
    found = plan.run(out, threads=os.cpu_count(), resume=True)
    opened = [runs.open_run(out / "runs" / one) for one in found["run"]]
    of_surface = [heated_surface.numbers(run.series, run.slip_surface, walls) if heats else {} for run in opened]
    for one in of_surface[0]:
        found[one] = [numbers[one] for numbers in of_surface]
    label_of = {str(value): str(label).replace("_", " ") for value, label in zip(values, labels or values)}  # tables know no spaces
    for row in campaign.means(found, [key, "seed"]):
        value = str(row["values"][key])
        print(f"{label_of[value]}: {len(row['seeds'])} of {row['of']} {row['verdict']}, the water at {said(row, 'water_at_failure_m', 1)} m")
        for left in (50, 10, 5) if heats else ():
            if row["numbers"][f"after_s_{left}"]["mean"] is not None:
                numbers = (words.format(said(row, f"{name}_{left}", digits)) for name, words, digits in TOLD)
                print(f"  {left} % of the strength were left after {', '.join(numbers)}")
            elif row["numbers"][f"cells_slip_m_{left}"]["mean"] is not None:
                share, slip, heat = (said(row, f"cells_{name}_{left}", 1) for name in ("share", "slip_m", "temperature_degC"))
                print(f"  {left} % of the strength were left in a share of {share} of the cells, after {slip} m of slip there, at {heat} °C (medians)")
            elif row["verdict"] == "failed dry":
                print(f"  when {left} % of the strength were left is not told: it moved before it had settled, so nobody knows since when")
                break
        print(f"  mean speed up to {said(row, 'speed_mean_max_m_per_s', 1)} m/s, front {said(row, 'front_travel_m', 0)} m")
        one = told.setdefault(value.replace(".", "_"), {"packings": row["of"], "failed": 0, "stood": 0})
        kind = "failed" if row["verdict"].startswith("failed by") else row["verdict"].replace(" ", "_")
        one[kind] = one.get(kind, 0) + len(row["seeds"])
        one[f"when_{kind}"] = {name: row["numbers"][name] for name in (*OF_RUN, *of_surface[0]) if name in row["numbers"]}
    for value, run in zip(found[key], opened):
        if heated_surface.begin(run.series) is not None:
            drawn.append((label_of[str(value)], run.series))
            heated.extend([run] if heats else [])


def main():
    kinds = [(table.section, table.key, table.values, table.labels, folder, True)]
    if table.beside:
        kinds.append((table.beside, table.beside_key, table.beside_values, table.beside_labels, folder / "beside", False))
    plans = [planned(name, key, values, labels, heats) for name, key, values, labels, _, heats in kinds]
    for plan, (_, *rest) in zip(plans, kinds):
        compare(*plan, *rest)
    whole_files.write_json(folder / "heated.json", told)
    if heated:
        print(figures.heated_slopes(drawn, folder / "heated.png"))
        print(figures.slip_surface(heated[0].slip_surface, folder / "slip_surface.png", times=heated[0].summary["times_s"]))


commands.run(main, "what has ended is kept: run it again")
