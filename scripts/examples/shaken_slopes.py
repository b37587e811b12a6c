# From which peak acceleration on a slope fails when its ground shakes, when in the record, and how far it runs, beside the same slope under rising water.
# Usage: scripts/yade-nonsmooth scripts/examples/shaken_slopes.py [table: section (that shakes by a synthetic motion), wet (the one beside it), disks, peaks [m/s²], seeds, folder]
# Prints for each peak what became of its slopes: means over packings and half of their 95 % intervals. FOLDER/shaken.json keeps them. Draws FOLDER/shaken.png, when in the record slopes moved off
# and the way of the front against the peak, and FOLDER/shaken_runouts.png, deposits of one packing shaken and wet.
import os
from pathlib import Path

from yade import utils
from yade.nonsmooth import campaign, figures, runs, section
from yade.nonsmooth.measure import statistics
from yade.nonsmooth.system import whole_files

utils.readParamsFromTable(
    section="jiufengershan_shaken", wet="jiufengershan", disks=3000, peaks=[2, 4, 6, 8], seeds=5, folder="out/shaken", noTableOk=True
)
from yade.params import table

KEY = "shaking.synthetic.peak"
folder, seeds = Path(table.folder), list(range(1, table.seeds + 1))
dry, wet = (section.load(name).with_disks(table.disks) for name in (table.section, table.wet))
surface = dry.slip_surfaces[0][0]
threads = os.cpu_count()
found = campaign.sweep(dry, {KEY: table.peaks, "seed": seeds}).run(folder, threads=threads, resume=True)
rain = campaign.sweep(wet, {"seed": seeds}).run(folder / "wet", threads=threads, resume=True)
found["slip_m"] = [runs.open_run(folder / "runs" / name).summary["displacements_m"][surface] for name in found["run"]]
found["moves_s"] = [None if t2 is None else t2 - t0 - dry.shaking.begin for t0, t2 in zip(found["times_s.t0"], found["times_s.t2"])]


def said(row, name, digits=2):
    """A mean over packings with half of its interval."""
    return statistics.told(row["numbers"][name]["mean"], row["numbers"][name]["half_width"], digits)


means = campaign.means(found, [KEY, "seed"])
for row in means:
    line = f"{row['values'][KEY]:g} m/s²: {len(row['seeds'])} of {row['of']} {row['verdict']}"
    moved = f"; they moved off {said(row, 'moves_s', 1)} s after it began, front {said(row, 'front_travel_m', 0)} m" if row["verdict"] == "failed by shaking" else ""
    print(f"{line}, slip {said(row, 'slip_m')} m{moved}")
for row in campaign.means(rain, ["seed"]):
    print(f"water alone: {len(row['seeds'])} of {row['of']} {row['verdict']}, front {said(row, 'front_travel_m', 0)} m, mean speed {said(row, 'speed_mean_max_m_per_s', 1)} m/s at most")

NAMES = ("slip_m", "moves_s", "front_travel_m", "speed_mean_max_m_per_s", "deposit_thickness_ground_m")
told = {}
for name, rows in (("shaken", means), ("wet", campaign.means(rain, ["seed"]))):
    for row in rows:
        key = f"{name}_{row['values'][KEY]:g}".replace(".", "_") if KEY in row["values"] else name
        one = told.setdefault(key, {"packings": row["of"], "failed": 0, "stood": 0})
        kind = "failed" if row["verdict"].startswith("failed by") else "stood"
        one[kind] += len(row["seeds"])
        one[f"when_{kind}"] = {number: row["numbers"][number] for number in NAMES if number in row["numbers"]}
whole_files.write_json(folder / "shaken.json", told)
print(figures.means(means, KEY, ["moves_s", "front_travel_m"], folder / "shaken.png"))

failed = [k for k, verdict in enumerate(found["verdict"]) if verdict == "failed by shaking"]
if failed:
    seed, peak = found["seed"][failed[0]], found[KEY][failed[0]]
    pair = {"shaken": folder / "runs" / found["run"][failed[0]], "wet": folder / "wet" / "runs" / f"seed={seed}"}
    ends = {name: runs.open_run(where) for name, where in pair.items()}
    labels = {"shaken": f"shaken by {peak:g} m/s²", "wet": "under rising water"}
    cases = [(labels[name], run.snapshot("t0"), run.snapshot("end")) for name, run in ends.items()]
    print(figures.runouts(cases, dry, folder / "shaken_runouts.png"))
