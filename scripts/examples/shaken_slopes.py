# From which peak acceleration on a slope fails when its ground shakes, dry and wet, when in the record, and how far it runs, beside the same slope under rising water alone.
# Usage: scripts/yade-nonsmooth scripts/examples/shaken_slopes.py [table: dry, wet (sections that shake by a synthetic motion), water (the one that does not), disks,
#        dry_peaks, wet_peaks [m/s²], seeds, folder]
# Prints for each peak what became of its slopes: means over packings and half of their 95 % intervals. FOLDER/shaken.json keeps them. Draws FOLDER/shaken.png, when in the
# record slopes moved off and the way of the front against the peak, and FOLDER/shaken_runouts.png, deposits of one packing.
import os
from pathlib import Path

from yade import utils
from yade.nonsmooth import campaign, figures, runs, section
from yade.nonsmooth.measure import statistics
from yade.nonsmooth.system import whole_files

utils.readParamsFromTable(
    dry="jiufengershan_shaken", wet="jiufengershan_wet_shaken", water="jiufengershan", disks=3000, dry_peaks=[2, 4, 6, 8], wet_peaks=[1, 2, 4], seeds=5, folder="out/shaken",
    noTableOk=True,
)  # fmt: skip
from yade.params import table

KEY, SHAKEN = "shaking.synthetic.peak", "failed by shaking"
NAMES = ("slip_m", "moves_s", "front_travel_m", "speed_mean_max_m_per_s", "deposit_thickness_ground_m")
folder, seeds = Path(table.folder), list(range(1, table.seeds + 1))
threads = os.cpu_count()


def said(row, name, digits=2):
    """A mean over packings with half of its interval."""
    return statistics.told(row["numbers"][name]["mean"], row["numbers"][name]["half_width"], digits)


def shaken(name, peaks):
    """The runs of a section under these peaks, and their means over packings."""
    slope = section.load(getattr(table, name)).with_disks(table.disks)
    surface = slope.slip_surfaces[0][0]
    found = campaign.sweep(slope, {KEY: peaks, "seed": seeds}).run(folder / name, threads=threads, resume=True)
    begins = [t0 and t0 + slope.shaking.begin for t0 in found["times_s.t0"]]
    found["slip_m"] = [runs.open_run(folder / name / "runs" / one).summary["displacements_m"][surface] for one in found["run"]]
    found["moves_s"] = [None if t2 is None else t2 - begin for begin, t2 in zip(begins, found["times_s.t2"])]
    means = campaign.means(found, [KEY, "seed"])
    for row in means:
        line = f"{name}, {row['values'][KEY]:g} m/s²: {len(row['seeds'])} of {row['of']} {row['verdict']}, slip {said(row, 'slip_m')} m"
        print(line + (f"; they moved off {said(row, 'moves_s', 1)} s after it began, front {said(row, 'front_travel_m', 0)} m" if row["verdict"] == SHAKEN else ""))
        row["values"]["water"] = name
    return found, means


told, every = {}, []
for name in ("dry", "wet"):
    found, means = shaken(name, getattr(table, f"{name}_peaks"))
    every += means
    if name == "dry":
        failed = [k for k, verdict in enumerate(found["verdict"]) if verdict == SHAKEN]
        first = {key: found[key][failed[0]] for key in ("seed", "run", KEY)} if failed else None
rain = campaign.sweep(section.load(table.water).with_disks(table.disks), {"seed": seeds}).run(folder / "water", threads=threads, resume=True)
alone = campaign.means(rain, ["seed"])
for row in alone:
    print(f"water alone: {len(row['seeds'])} of {row['of']} {row['verdict']}, front {said(row, 'front_travel_m', 0)} m")
for row in every + alone:
    key = f"{row['values']['water']}_{row['values'][KEY]:g}".replace(".", "_") if KEY in row["values"] else "water"
    one = told.setdefault(key, {"packings": row["of"], "failed": 0, "stood": 0})
    kind = "failed" if row["verdict"].startswith("failed by") else "stood"
    one[kind] += len(row["seeds"])
    one[f"when_{kind}"] = {number: row["numbers"][number] for number in NAMES if number in row["numbers"]}
whole_files.write_json(folder / "shaken.json", told)
print(figures.means(every, KEY, ["moves_s", "front_travel_m"], folder / "shaken.png"))
if first:
    ends = {
        f"dry, shaken by {first[KEY]:g} m/s²": runs.open_run(folder / "dry" / "runs" / first["run"]),
        "under rising water": runs.open_run(folder / "water" / "runs" / f"seed={first['seed']}"),
    }
    cases = [(label, run.snapshot("t0"), run.snapshot("end")) for label, run in ends.items()]
    print(figures.runouts(cases, section.load(table.dry), folder / "shaken_runouts.png"))
